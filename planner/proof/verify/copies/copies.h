#pragma once

#include <string>

#include "planner/ground/geometry/profile.h"
#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/ground/vocabulary/noun_kind.h"
#include "planner/model/plan/cutter/cutter.h"

/// What the check says of kinds of things by itself: a wrong row of the vocabulary must not pass it. Copies
/// on purpose; tests/proof/verify/copies_test.cpp holds each against the vocabulary's column. What is said of
/// a class of cutter is a row of class_copies.cpp, with its outline.
namespace capstan::verify {

/// Feeds along its axis.
[[nodiscard]] bool works_along_axis(model::CutterClass c);
/// Its head is wider than what stands above it: heights do not tell what it cuts.
[[nodiscard]] bool undercuts(model::CutterClass c);
/// Cuts under the walls of its own feature.
[[nodiscard]] bool under_overhangs(model::CutterClass c);
/// Its diameter is the hole's.
[[nodiscard]] bool sizes_hole(model::CutterClass c);
/// A cone that breaks edges along the side of a feature.
[[nodiscard]] bool breaks_edges(model::CutterClass c);
/// Cuts with a part of its cone: how wide it is there is not known.
[[nodiscard]] bool cuts_by_point(model::CutterClass c);
/// Moves along walls, and so leaves its radius in their corners.
[[nodiscard]] bool mills(model::CutterClass c);
/// Cuts at its centre whatever is stated of it, and so goes straight down into solid material.
[[nodiscard]] bool cuts_to_centre(model::CutterClass c);
/// A solid mill, whose edges are ground with a rake.
[[nodiscard]] bool is_raked(model::CutterClass c);
/// Its corner radius is half its diameter, stated or not.
[[nodiscard]] bool is_ball(model::CutterClass c);
/// The radius of its rounded end, by which its speed is counted, mm.
[[nodiscard]] double end_radius_of(const model::Cutter& c);
/// Operations of one feature in the order of the craft: a lower one never follows a higher one. 0: any order.
/// Judged by where ISO 14649-11 derives the operation from, and by its keyword (..._ROUGH_MILLING); the table
/// of the vocabulary states a rank for each.
[[nodiscard]] int order_rank(model::TypeId operation);
/// Makes the surface that stays.
[[nodiscard]] bool finishes(model::TypeId operation);
/// Makes a thread by a helix about its axis.
[[nodiscard]] bool mills_threads(model::CutterClass c);
/// How much faster than a table's speed an edge of carbide may be where its cut is this wide, over the
/// diameter, for the same life; in a group of ISO 513. The copy of mechanics::speed_by_arc; source there.
[[nodiscard]] double speed_by_arc(double width_ratio, const std::string& iso_group);
/// The steepest ramp that planning chooses at the feed of slots, rad: the lesser of the cutter's own angle
/// and that of its substrate in a group of ISO 513. The copy of the table of model::ramp_of; sources there.
[[nodiscard]] double usual_ramp(const model::Cutter& c, const std::string& iso_group);
/// What a cutter's edges sweep, by its class and its stated sizes: a cone to a point, a cone over a flat tip,
/// a ball, else a flat end with rounded corners.
[[nodiscard]] geometry::CutterProfile outline_of(const model::Cutter& c);

}  // namespace capstan::verify
