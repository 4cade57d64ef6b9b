#pragma once

#include <optional>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

/// @file What people write into the names and comments of tools: class, material, teeth and sizes.

namespace capstan::tooling {

/// The class named by the words of a comment ("6mm endmill", "5mm tap drill", "16 mm schaftfraeser").
[[nodiscard]] std::optional<model::CutterClass> class_from_words(std::string_view comment);

/// Sizes in the words of a tool's name or comment, beside its class (see `class_from_words`); 0: not stated,
/// and not guessed.
struct CommentSizes {
  double pitch_mm = 0.0;  ///< taps, thread mills: "M6x0.75", "1/4-20", "20 TPI", "M6" (coarse, ISO 261)
  double corner_radius_mm = 0.0;  ///< bull noses: "R1.5"
  double point_angle_rad = 0.0;   ///< cones: "30 deg"; the full angle
  double tip_mm = 0.0;            ///< cones: "tip 0.5"
  bool pointed = false;           ///< a V-bit
};
/// Of a thread only what suits the diameter is taken: a tap of 6.35 mm is no M6. `mm_per_unit` is for radii
/// and tips without a unit. An angle below 60 degrees counts for a chamfer mill only when it is a V-bit or
/// the angle is called included: "45 deg" is often said of one side.
[[nodiscard]] CommentSizes sizes_of_words(std::string_view words, model::CutterClass c, double diameter_mm,
                                          double mm_per_unit = 1.0);

/// The nominal diameter of the one thread that the words name, mm: "M6" where ISO 261 has the size, "M8x1",
/// "1/4-20"; 0: none, or sizes that differ. A number without a pitch that may be the grade of the steel named
/// beside it is none ("HSS M2", "M4 high speed steel").
[[nodiscard]] double thread_size_of_words(std::string_view words);

/// Where what a comment says is from, behind "derived: " in Cutter::sources.
inline constexpr std::string_view kOfComment = "from the words of the comment";

struct CommentWords {
  int teeth = 0;  ///< "4 flute", "3fl", "Z4", "vierschneidig"; 0: not said, or said twice and differently
  std::optional<model::Substrate> substrate;  ///< "carbide", "VHM", "HSS-E"; of both the slower one
  CommentSizes sizes;
};
[[nodiscard]] CommentWords words_of_comment(std::string_view comment, model::CutterClass c,
                                            double diameter_mm, double mm_per_unit = 1.0);

}  // namespace capstan::tooling
