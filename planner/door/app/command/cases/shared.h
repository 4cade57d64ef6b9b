#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/casebase.h"
#include "planner/door/app/command/session.h"
#include "planner/door/service/logs/import_logs.h"

/// What the verbs of `capstan cases` have in common.
namespace capstan::app {

/// Reports what was found altered or gone in a base; whether all of it is what was stored, as far as it was
/// read.
bool report_faults(Session& s, const casebase::CaseBase& base);
/// A warning of times that lie on a day after today, by this computer's clock in UTC; nothing where none
/// does. `one`, `more`: "case is", "cases are".
[[nodiscard]] std::optional<Diagnostic> of_the_future(const std::vector<std::string_view>& times_utc,
                                                      std::string_view one, std::string_view more);
/// Fails   OUT-KIND: an output that is no .svg file; by its name, before any work.
[[nodiscard]] Status are_pictures(const std::vector<std::string>& outputs);
/// Whether a case holds all words of a filter: each is its origin, its verdict, or a part of a category, of
/// its source, part, workingstep or tool.
[[nodiscard]] bool wanted(const casebase::Case& c, const std::vector<std::string>& words);
using service::PlannedSteps;
using service::read_marks;
using service::read_steps;
/// A number of a table; "-" for one that is not known.
[[nodiscard]] std::string number_text(double v);
/// The same for an observed figure, with its standard deviation where it is known.
[[nodiscard]] std::string figure_text(const std::optional<casebase::Figure>& f);
/// A text of a case as JSON has it.
[[nodiscard]] std::string json_text(std::string_view text);
/// A case as one JSON object, fields that are known alone, with the names of the table of fields.
[[nodiscard]] std::string case_json(const casebase::Case& c);
/// Cases as a JSON array, one a line.
[[nodiscard]] std::string cases_json(const std::vector<casebase::Case>& cases);

}  // namespace capstan::app
