#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

// Our roughing of a pocket against FreeCAD's, at equal cutter, spindle speed, machine, material and limits.
//
// FreeCAD gives paths without feeds. Our engagement and force model goes along each of them, and the feed is
// the largest that keeps chip, force and deflection within the limits that our own path keeps: once one feed
// for the whole of its path, which is what FreeCAD's tool controller holds (plunges, ramps and air are
// forgiven: they have the feeds of the schedule), and once, more generous, our schedule of feeds on its path.
// Of its programs those are compared whose entries are no steeper, and whose levels no deeper, than what our
// own path keeps to (model::ramp_of).

namespace capstan::validation {

struct RivalCase {
  const char* material;
  int depth_mm;
  int boss_mm;  ///< diameter of the round boss in the pocket's middle; 0: none
};
/// Three materials, two depths, without and with a boss.
[[nodiscard]] std::vector<RivalCase> rival_cases();

/// The part of examples/reference_pocket.p21 with this depth and boss, as Part 21.
[[nodiscard]] std::string rival_part(const RivalCase& c);

/// One of FreeCAD's programs (make_programs.py) on our limits. Times of roughing alone, s.
struct Rival {
  std::string name;       ///< "pocket 60 % × 1": operation, step-over, levels
  bool adaptive = false;  ///< else its pocket operation, offset pattern
  double scheduled_s = 0.0, constant_s = 0.0;
  double removed_mm3 = 0.0;
  model::Plan scheduled, constant;
};

struct Match {
  model::Plan ours;
  std::size_t step = 0;  ///< the first roughing step
  double ours_s = 0.0, removed_mm3 = 0.0;
  std::vector<Rival> rivals;
};

/// Plans the case with end mills of 10 mm of the generic library, then each of FreeCAD's programs for it.
/// `machine`: an id or a file.
/// Fails  as planning and `path_of_program`; VAL-LIMIT where a rival's path breaks a limit at any feed.
[[nodiscard]] Result<Match> match(const RivalCase& c, const std::string& machine);

/// The fastest of the rivals: with the schedule's feeds, or with one feed; null if there is none such.
[[nodiscard]] const Rival* fastest(const Match& m, bool adaptive, bool constant);

}  // namespace capstan::validation
