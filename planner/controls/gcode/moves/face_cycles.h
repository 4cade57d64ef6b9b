#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls::gcode {

/// A face as a control's own cycle mills it, in straight strokes along an axis of the set-up. What is stated
/// bounds any path that the cycle takes: the rectangle over whose edge the cutter may go, the floor, the
/// depth of a level, the distance of strokes, and a feed that keeps the step's loads where the cutter is in a
/// slot as wide as it is (slot_feed.h), which a first stroke may be. Frame  the set-up's, the rectangle's
/// sides along its axes. Units  mm, mm/min.
struct FaceCycle {
  geometry::Vec2 lo, hi;               ///< of the rectangle that is milled off whole
  bool along_y = false;                ///< the strokes, as the plan's; else along X
  double out_mm = 0.0;                 ///< from the edge to the cutter, where strokes begin and end
  double back_z = 0.0, start_z = 0.0;  ///< where the tool comes from, and down to by rapid beside the piece
  double reference_z = 0.0;            ///< nothing of the piece is higher
  double floor_z = 0.0;                ///< of the finished face
  double bottom_mm = 0.0;              ///< what the step leaves
  int levels = 1;                      ///< alike, from `reference_z` to what is left
  double level_mm = 0.0;
  double over_mm = 0.0;  ///< from stroke to stroke at most
  double feed_mm_min = 0.0;
  double cutter_mm = 0.0;               ///< its diameter
  int tool = 0;                         ///< its number
  int decimals = 0, feed_decimals = 0;  ///< of the control
  double planned_s = 0.0;               ///< time of the plan's own path
  geometry::Vec2 free_lo, free_hi;      ///< where nothing may stand that is as high as its floor
};

/// The cycle for step `n` of the plan, or why its face is explicit moves. A cycle is for the first step of a
/// planar face that is a rectangle along the axes of its set-up, without anything standing on it, beyond
/// which the raw piece does not reach, and around which nothing that holds the piece is as high as its floor,
/// within what the cutter, its shank and its holder may come to.
struct FaceOfStep {
  std::optional<FaceCycle> cycle;
  std::string why_not;  ///< empty: a cycle, or the step mills no face at all
  std::string text;     ///< the cycle in the control's words (`asked_faces`)
};
[[nodiscard]] FaceOfStep face_of(const model::Plan& plan, std::size_t n);

/// What a control says of faces in its own way.
struct FaceWords {
  /// A face as a cycle, the tool at `back_z`; where it ends, too, somewhere over the face or beside it.
  std::string (*text)(const FaceCycle& face) = nullptr;
};

/// By step, the faces of a plan that are asked for as cycles. `words`: null where the control has none.
[[nodiscard]] std::vector<FaceOfStep> asked_faces(const model::Plan& plan, const FaceWords* words);

/// Seconds that strokes at the cycle's feed take: an estimate, for the path is the control's.
[[nodiscard]] double estimated_s(const FaceCycle& c);

}  // namespace capstan::controls::gcode
