#pragma once

#include <string>
#include <vector>

#include "planner/ground/vocabulary/cutter_class.h"

namespace capstan::model {

/// What an operation needs of its tool. A zero means "does not matter".
struct ToolRequirement {
  std::vector<CutterClass> classes;  ///< in order of preference
  double diameter_min_mm = 0.0, diameter_max_mm = 0.0;
  double diameter_exact_mm = 0.0;  ///< drills, reamers, taps: this size (within diameter_tolerance_mm)
  double diameter_tolerance_mm = 0.0;
  double reach_mm = 0.0;              ///< usable length at least
  double depth_of_cut_mm = 0.0;       ///< flute length at least
  double corner_radius_max_mm = 0.0;  ///< with corner_radius_limited
  bool corner_radius_limited = false;
  double corner_radius_exact_mm = -1.0;  ///< >= 0: ball or bull of this radius
  bool centre_cutting = false;           ///< or a ramp the tool allows
  double point_angle_rad = 0.0;
  /// Drills: blunter points than the one wanted will do up to this, and leave rest material in the bottom's
  /// cone. Spots: the bluntest point, whose mark is no wider than the hole. 0: does not matter.
  double point_angle_most_rad = 0.0;
  /// Drills: of solid carbide, with a point that centres itself.
  bool solid_carbide = false;
  /// Drills: the full angle of the spot that they start in; 0: there is none.
  double spot_angle_rad = 0.0;
  double thread_pitch_mm = 0.0;
  double thread_size_mm = 0.0;        ///< nominal, thread mills and taps
  double lead_threads_max = 0.0;      ///< taps: threads in the chamfer, where the tap states them; 0: any
  double taper_angle_rad = 0.0;       ///< tapered end mills: half angle
  double cutting_width_max_mm = 0.0;  ///< side mills, heads of T-slot cutters
  double neck_diameter_max_mm = 0.0;  ///< what must pass above the head, over `reach_mm`
  double neck_step_min_mm = 0.0;     ///< head less neck, on the diameter, over `reach_mm`: undercuts in holes
  double tip_diameter_max_mm = 0.0;  ///< flat at the tip at most: it leaves a core below a cone
  bool coolant_through = false;
  bool left_hand = false;   ///< taps of left-hand threads
  std::string thread_form;  ///< "M", "UN"; empty: any of the pitch
  std::string words;        ///< "a 6 mm end mill with 22 mm reach"
  bool operator==(const ToolRequirement&) const = default;
};

/// Sizes are compared after the printer's rounding; below this two are one.
inline constexpr double kSizeSlackMm = 1e-6;
/// Pitches of threads this near are one: inch pitches in mm are rounded. Default, unsourced.
inline constexpr double kPitchSlackMm = 1e-3;

/// The diameters that will do, mm; 0: any.
[[nodiscard]] double lower_size(const ToolRequirement& r);
[[nodiscard]] double upper_size(const ToolRequirement& r);
/// "a 6 mm end mill with 22 mm reach, cutting to centre"
[[nodiscard]] std::string words_of(const ToolRequirement& requirement);

}  // namespace capstan::model
