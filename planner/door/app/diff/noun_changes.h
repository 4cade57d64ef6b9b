#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::app {

/// "what: from -> to"
[[nodiscard]] std::string change(const std::string& what, const std::string& from, const std::string& to);

/// What differs below two nouns of one type, one line each: values, who bound them and why. Executables,
/// features, workpieces and given toolpaths below them count by name only: they have headings of their own.
[[nodiscard]] std::vector<std::string> noun_changes(const model::Plan& a, const model::Plan& b,
                                                    model::AnyRef x, model::AnyRef y);

}  // namespace capstan::app
