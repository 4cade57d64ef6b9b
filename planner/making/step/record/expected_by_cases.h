#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/model/plan/plan.h"

namespace capstan::casebase {
class CaseBase;
}

namespace capstan::step {

/// The row of a plan's record with its time by cases: "2 min 51 s +- 9.4 s".
inline constexpr std::string_view kTimeByCases = "time by cases";
/// The rows of one step, by its persistent id: its time, and the size of the bore that it mills.
[[nodiscard]] std::string time_row_of(std::string_view step);
[[nodiscard]] std::string bore_row_of(std::string_view step);
/// The row of that name; null: there is none.
[[nodiscard]] const model::Provenance* row_of(const model::Plan& plan, std::string_view what);

/// What measured cases of the plan's machine say of its time, of the times of its steps and of the bores that
/// it mills (casebase/tune/corrections.h), with the interval of 90 % for one further part: CASE-TIME, a note;
/// CASE-BORE, a warning where that interval leaves the zone of the tolerance, else a note. A step's time is
/// told where steps like it were measured: of the same operation with a tool of the same class. Bores are
/// heard of the same material, tool class and cutter diameter alone; all of it from three parts on. Gives a
/// row for the plan's record of each, with the cases by id, what came of them, and what is without them.
/// `cases` may be null.
[[nodiscard]] std::vector<model::Provenance> tell_expected(const model::Plan& plan,
                                                           const casebase::CaseBase* cases, Job& job);

}  // namespace capstan::step
