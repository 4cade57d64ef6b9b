#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/controls/heidenhain/heidenhain.h"
#include "planner/ground/base/number.h"

// Pockets as cycles 251 and 252, slots as 253. Which parameters they have, and in which order: a public table
// of the control's cycles; Q439 of later versions, to which of the feeds it refers, is left out. What they
// mean: remembered, as tests/controls/heidenhain/golden/README.md says.

namespace capstan::controls::heidenhain {
namespace {

using gcode::PocketCycle;

/// Q370: the control refuses more than 1.414, and less than 0.1.
constexpr double kMostOverlap = 1.4, kLeastOverlap = 0.1;
constexpr int kOverlapDecimals = 3;
/// Of the cutter's diameter that 253 has at least to go back and forth on its way in. Default, unsourced.
constexpr double kLeastWay = 0.5;

/// "+10.5", "-3", "+0".
std::string with_sign(double value, int decimals) {
  std::string text = trimmed(value, decimals);
  return text.front() == '-' ? text : "+" + text;
}

/// ANGLE is rounded down: no steeper than planned.
std::string table_text(int tool, double slope) {
  const double degrees = std::floor(std::atan(slope) * 180.0 / std::numbers::pi * 100.0) / 100.0;
  if (!(degrees > 0.0)) return {};
  return "ANGLE of T" + std::to_string(tool) + " in the tool table: " + trimmed(degrees, 2) +
         " degrees at most";
}

/// Cycle 253 states no distance from pass to pass: it is for a slot in which the passes along both walls
/// leave nothing between them, whatever lies there.
bool slot_milling(const PocketCycle& p) {
  return p.slot && p.length_mm - p.width_mm >= kLeastWay * p.cutter_mm &&
         0.5 * p.width_mm - 0.5 * p.cutter_mm - p.side_mm <= 0.5 * p.flat_mm;
}

std::optional<std::string> pocket_text(const PocketCycle& p) {
  const bool slot = slot_milling(p);
  if (!slot && p.helix_mm == 0.0) return std::nullopt;
  const double overlap =
      std::floor(std::min(kMostOverlap, p.over_mm / (0.5 * p.cutter_mm)) * 1000.0 + 1e-6) / 1000.0;
  if (overlap < kLeastOverlap) return std::nullopt;
  std::string out;
  out += "L X" + with_sign(p.centre.x, p.decimals) + " Y" + with_sign(p.centre.y, p.decimals) + " R0 FMAX\n";
  out += slot      ? "CYCL DEF 253 SLOT MILLING"
         : p.round ? "CYCL DEF 252 CIRCULAR POCKET"
                   : "CYCL DEF 251 RECTANGULAR POCKET";
  const auto q = [&](int number, const std::string& value, const char* meaning) {
    out += " ~\n  Q" + std::to_string(number) + "=" + value + " ;" + meaning;
  };
  const auto n = [&](double v) { return with_sign(v, p.decimals); };
  const std::string feed = trimmed(p.feed_mm_min, p.feed_decimals);
  q(215, "+1", "MACHINING OPERATION");
  if (p.round) {
    q(223, n(p.length_mm), "CIRCLE DIAMETER");
  } else {
    q(218, n(p.length_mm), slot ? "SLOT LENGTH" : "FIRST SIDE LENGTH");
    q(219, n(p.width_mm), slot ? "SLOT WIDTH" : "2ND SIDE LENGTH");
    if (!slot) q(220, n(p.corner_mm), "CORNER RADIUS");
  }
  q(368, n(p.side_mm), "ALLOWANCE FOR SIDE");
  if (!p.round) {
    q(slot ? 374 : 224, with_sign(p.angle_deg, kMostDecimals), "ANGLE OF ROTATION");
    q(367, "+0", slot ? "SLOT POSITION" : "POCKET POSITION");
  }
  q(207, feed, "FEED RATE FOR MILLNG");
  q(351, p.climbs ? "+1" : "-1", "CLIMB OR UP-CUT");
  q(201, n(p.floor_z - p.reference_z), "DEPTH");
  q(202, n(p.level_mm), "PLUNGING DEPTH");
  q(369, n(p.bottom_mm), "ALLOWANCE FOR FLOOR");
  q(206, trimmed(p.ramp_feed_mm_min, p.feed_decimals), "FEED RATE FOR PLNGNG");
  q(338, "+0", "INFEED FOR FINISHING");
  q(200, n(p.start_z - p.reference_z), "SET-UP CLEARANCE");
  q(203, n(p.reference_z), "SURFACE COORDINATE");
  q(204, n(p.back_z - p.reference_z), "2ND SET-UP CLEARANCE");
  if (!slot) q(370, with_sign(overlap, kOverlapDecimals), "TOOL PATH OVERLAP");
  q(366, "+1", "PLUNGE");
  q(385, feed, "FINISHING FEED RATE");
  return out + "\nCYCL CALL";
}

}  // namespace

constinit const gcode::PocketWords kPockets{.text = &pocket_text, .table = &table_text};

}  // namespace capstan::controls::heidenhain
