#pragma once

#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

/// @file Conversion between the planner's paths and AP238's toolpaths. All functions work on a copy, or on a
/// model that was just read.

namespace capstan::exchange::ap238 {

/// Gives every trajectory that has a model::CutterPath and no basiccurve its curves: one
/// CUTTER_LOCATION_TRAJECTORY per run of equal purpose and spindle speed, in the place of the one that had
/// the path. A step whose path stands only in `plan.steps` gets toolpaths first.
///
///     basiccurve   POLYLINE, arcs and helices by via points; lines with points named "section" where their
///                  cross sections change inside; where the feed jumps, its point stands twice, so that what
///                  follows the parameter may jump, too
///     its_speed    RAPID; a ratio of the technology's feed; where the feed varies, a polyline of ratios, a
///                  point for each of the basic curve
///     cross_section_area_parameters   a polyline of seven numbers, a point for each of the basic curve:
///                  those of the measured step in which the point lies, none where nothing is cut
///     its_material_removal_total_volume, path_maximum_deviation (what the machine may round corners by),
///     its_toolaxis where the curve's z is not the set-up's; FEEDSTOP for a dwell
///
/// Losses  sentences about what this cannot say.
/// Fails   when a step's frame cannot be found.
[[nodiscard]] Status write_paths(model::Plan& plan, std::vector<std::string>& losses);

/// Toolpaths are in their feature's frame unless a toolpath_orientation says otherwise. AP238 places features
/// elsewhere than the model does, so the written file states it: each workingstep with curves gets the
/// toolpath_orientation that is its feature's placement. Call it while placements are the model's.
void state_frames(model::Plan& plan);

/// The same for a model that was just read, while placements are still AP238's.
void adopt_frames(model::Plan& plan);

/// Drops what `state_frames` says and the model says anyway. To be called when placements are the model's.
void drop_stated_frames(model::Plan& plan);

}  // namespace capstan::exchange::ap238
