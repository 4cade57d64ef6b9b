#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "casebase/casebase.h"

/// The words of a case's categories: what plans write there, and what a base has.
namespace capstan::app {

/// What plans can write as operation ("REAMING"), and as class of tool ("carbide/reamer").
[[nodiscard]] std::vector<std::string> planned_operations();
[[nodiscard]] std::vector<std::string> planned_tool_classes();

/// Words of these cases that no plan ever writes, each once, with those that may be meant: operations,
/// classes of tools, and materials without the letter of ISO 513. A case of them is never found by planning.
[[nodiscard]] std::vector<Diagnostic> unplanned_words(const std::vector<casebase::Case>& cases);

/// Fails   NAME-UNKNOWN: an operation or a class of tools that neither plans nor this base know.
[[nodiscard]] Status known_categories(const casebase::Question& q, const casebase::CaseBase& base);

/// Why no case of the base shares the categories of a question: those that differ in the fewest of them.
[[nodiscard]] std::string no_shared_categories(const casebase::Question& q, const casebase::CaseBase& base);

}  // namespace capstan::app
