#pragma once

#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/door/app/command/session.h"

/// What the verbs of `capstan cases` have in common.
namespace capstan::app {

/// Reports what was found altered or gone in a base.
void report_faults(Session& s, const casebase::CaseBase& base);
/// A number of a table; "-" for one that is not known.
[[nodiscard]] std::string number_text(double v);
/// The same for an observed figure, with its standard deviation where it is known.
[[nodiscard]] std::string figure_text(const std::optional<casebase::Figure>& f);
/// A case as one JSON object, fields that are known alone, with the names of the table of fields.
[[nodiscard]] std::string case_json(const casebase::Case& c);
/// Cases as a JSON array, one a line.
[[nodiscard]] std::string cases_json(const std::vector<casebase::Case>& cases);

}  // namespace capstan::app
