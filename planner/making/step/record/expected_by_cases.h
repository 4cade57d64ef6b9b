#pragma once

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

/// What measured cases of the plan's machine say of its time and of the bores that it mills
/// (casebase/tune/corrections.h), with the interval of 90 % for one further part: CASE-TIME, a note;
/// CASE-BORE, a warning where that interval leaves the zone of the tolerance, else a note. Bores are
/// heard of the same material, tool class and cutter diameter alone, and either from three parts on. Paths
/// and feeds stay as they are. Gives a row for the plan's record of each. `cases` may be null.
[[nodiscard]] std::vector<model::Provenance> tell_expected(const model::Plan& plan,
                                                           const casebase::CaseBase* cases, Job& job);

}  // namespace capstan::step
