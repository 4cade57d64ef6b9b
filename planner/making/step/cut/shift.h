#pragma once

#include <optional>
#include <string>

#include "planner/making/draft/draft.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/toolpath/path_job.h"
#include "planner/physics/stock/height_map.h"

// Cuts that nobody would run because they last longer than a shift.

namespace capstan::step {

/// A proposed cut of one prismatic feature lasts no longer, s. Default, unsourced: a day's shift.
inline constexpr double kShiftS = 8.0 * 3600.0;

/// A time that the clearing of the job's area with this cut cannot fall below, s; 0 where none is known. What
/// lies over an island counts as staying.
/// Needs  a path of levels and passes no deeper and no wider than the cut, in material of `map` (set-up's
///        frame).
[[nodiscard]] double least_clearing_s(const toolpath::PathJob& job, const optimise::CutQuestion& question,
                                      const optimise::CutAnswer& cut, const stock::HeightMap& map);

/// Why a proposed cut is refused before it has a path; nothing: it is not, or only its path can tell.
[[nodiscard]] std::optional<std::string> surely_longer_than_a_shift(const draft::StepDraft& step,
                                                                    const toolpath::PathJob& job,
                                                                    const optimise::CutQuestion& question,
                                                                    const optimise::CutAnswer& cut,
                                                                    const stock::HeightMap& map);

/// The refusal's words. `hours`: how long it cuts, for people.
[[nodiscard]] std::string longer_than_a_shift_text(const std::string& hours);

}  // namespace capstan::step
