#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/heidenhain/interpreter.h"

// Cycles 251 and 252, roughing along a helix, and 253, a slot with round ends, roughed back and forth on the
// way in; all called over the middle. Which parameters they
// have: a public table of the control's cycles. What these mean (TNC 640, cycle programming): Q215 1 roughs
// alone, Q218 and Q219 are the sides, Q220 the corners' radius, Q223 the diameter, Q224 how it is turned
// about its middle, Q367 0 that the tool stands there, Q368 and Q369 what is left, Q202 a level, Q370 times
// the tool's radius from ring to ring, Q351 1 climbing and -1 up-cut, Q366 1 in along a helix as steep as
// ANGLE of the tool table: remembered. Of 253 Q218 is the whole length and Q374 how it is turned; Q366 1 and
// 2 go in back and forth along it, as steep as ANGLE; how far its passes are apart no parameter says:
// remembered.

namespace capstan::verify::heidenhain {
namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// The helix's radius is the control's: a share of the tool's that leaves no core.
constexpr double kHelixShare = 0.9;

}  // namespace

/// "ANGLE of T2 in the tool table: 3.5 degrees at most": the table is the operator's, and is not read.
void Interpreter::table_angle(std::string_view comment) {
  constexpr std::string_view kBegin = "ANGLE of T",
                             kMiddle = " in the tool table: ", kEnd = " degrees at most";
  const std::size_t begin = comment.find(kBegin), middle = comment.find(kMiddle), end = comment.find(kEnd);
  if (begin == std::string_view::npos || middle == std::string_view::npos || end == std::string_view::npos ||
      middle < begin || end < middle)
    return;
  const std::size_t number = begin + kBegin.size(), angle = middle + kMiddle.size();
  const auto tool = parse_double(comment.substr(number, middle - number));
  const auto degrees = parse_double(comment.substr(angle, end - angle));
  if (!tool || !degrees) return;
  const auto [said, first] = table_angles_.emplace(static_cast<int>(*tool), *degrees);
  if (!first && said->second != *degrees)
    fault(26, "CHK-CYCLE",
          "ANGLE of T" + std::to_string(said->first) + " in the tool table is " + plain(*degrees) +
              " degrees at most here, and " + plain(said->second) +
              " before: the table has one, the least of both; say it once");
}

void Interpreter::pocket(const CycleDefinition& c, const Heights& h) {
  const std::string name = "cycle " + std::to_string(c.number) + ": ";
  const auto unfollowed = [&](const std::string& why) { fault(33, "CHK-UNVERIFIABLE", name + why, true); };
  const double u = units();
  const bool round = c.number == 252, slot = c.number == 253;
  if (c.of(215) != 1.0) return unfollowed("Q215 " + plain(c.of(215)) + " is not followed; roughing, 1, is");
  if (!round && c.of(367) != 0.0)
    return unfollowed("Q367 " + plain(c.of(367)) + " is not followed; the tool over the middle, 0, is");
  if (c.of(366) != 1.0 && !(slot && c.of(366) == 2.0))
    return unfollowed("Q366 " + plain(c.of(366)) + " is not followed; in " +
                      (slot ? "back and forth, 1 and 2, is" : "along a helix, 1, is"));
  if (c.of(351) != 1.0 && c.of(351) != -1.0)
    return fault(26, "CHK-CYCLE", name + "Q351 is " + plain(c.of(351)) + "; it says +1 or -1");
  // The control refuses factors beyond.
  if (!slot && (c.of(370) < 0.1 || c.of(370) > 1.414))
    return fault(26, "CHK-CYCLE", name + "Q370 is " + plain(c.of(370)) + "; it lies from 0.1 to 1.414");
  if (spindle_ == 0) return fault(15, "CHK-SPINDLE", name + "the spindle stands");
  const double cutter = called_diameter_mm();
  const auto angle = table_angles_.find(tool_);
  if (angle == table_angles_.end() || !(angle->second > 0.0) || angle->second > 90.0)
    return unfollowed("how steep it goes in is ANGLE of T" + std::to_string(tool_) +
                      " in the tool table, of which no comment says how large it may be");
  Pocket p;
  p.round = round;
  p.centre = xy(at_);
  p.length_mm = (round ? c.of(223) : c.of(218)) * u;
  p.width_mm = (round ? c.of(223) : c.of(219)) * u;
  p.corner_mm = round ? 0.5 * p.length_mm : slot ? 0.5 * p.width_mm : c.of(220) * u;
  if (!round && p.corner_mm == 0.0) p.corner_mm = 0.5 * cutter;  // the tool's radius
  p.angle_rad = c.of(slot ? 374 : 224) / kDegrees;
  p.back_z = h.back;
  p.start_z = h.start;
  p.reference_z = c.of(203) * u;
  p.floor_z = h.bottom;
  p.side_mm = c.of(368) * u;
  p.bottom_mm = c.of(369) * u;
  p.level_mm = c.of(202) * u;
  p.own_rings = slot;
  p.over_mm = 0.5 * c.of(370) * cutter;
  p.feed_mm_min = c.of(207) * u;
  p.ramp_feed_mm_min = c.of(206) * u;
  const double slope = std::tan(angle->second / kDegrees);
  if (slot) {
    p.slope = slope;
    if (p.length_mm < p.width_mm)
      return fault(26, "CHK-CYCLE", name + "the slot is shorter (Q218) than wide (Q219)");
  } else {
    p.helix_mm = std::min(0.5 * kHelixShare * cutter,
                          0.5 * std::min(p.length_mm, p.width_mm) - 0.5 * cutter - p.side_mm);
    p.turn_mm = 2.0 * std::numbers::pi * p.helix_mm * slope;
  }
  p.clockwise = (c.of(351) > 0.0) == (spindle_ < 0);
  for (const double v :
       {p.length_mm, p.width_mm, p.corner_mm, p.side_mm, p.bottom_mm, p.level_mm, p.helix_mm}) {
    if (v < 0.0) return fault(26, "CHK-CYCLE", name + "a size is below zero, or the tool is too wide");
  }
  mill(p);
}

}  // namespace capstan::verify::heidenhain
