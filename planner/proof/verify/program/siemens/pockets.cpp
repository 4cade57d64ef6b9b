#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/siemens/interpreter.h"

// POCKET3 and POCKET4, roughing along a helix, by the description of their parameters. The order of both
// lists: a public table of the control's cycles (POCKET3(RTP, RFP, SDIS, DP, LENG, WID, CRAD, PA, PO, STA,
// MID, FAL, FALD, FFP1, FFD, CDIR, VARI, MIDA, AP1, AP2, AD, RAD1, DP1) and POCKET4 likewise) and cnc.wiki,
// POCKET3 and POCKET4. What the figures mean (user's guide cycles 11.02, 6FC5298-6AB40): remembered.

namespace capstan::verify::siemens {

namespace {

constexpr double kDegrees = 180.0 / std::numbers::pi;
/// _MIDA left out: 80 % of the mill's diameter.
constexpr double kMidaShare = 0.8;

/// The parameters by name, in the order of each list.
constexpr std::array<std::string_view, 23> kRectangle = {
    "RTP",  "RFP",  "SDIS", "DP",   "LENG", "WID",  "CRAD", "PA",  "PO", "STA",  "MID", "FAL",
    "FALD", "FFP1", "FFD",  "CDIR", "VARI", "MIDA", "AP1",  "AP2", "AD", "RAD1", "DP1"};
constexpr std::array<std::string_view, 19> kCircle = {"RTP",  "RFP", "SDIS", "DP",   "PRAD", "PA",   "PO",
                                                      "MID",  "FAL", "FALD", "FFP1", "FFD",  "CDIR", "VARI",
                                                      "MIDA", "AP1", "AD",   "RAD1", "DP1"};

}  // namespace

void Interpreter::pocket(const Item& call, bool modal) {
  const bool circle = call.name == "POCKET4";
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", call.name + ": " + why); };
  const auto unfollowed = [&](const std::string& why) {
    fault(33, "CHK-UNVERIFIABLE", call.name + ": " + why, true);
  };
  if (modal || modal_)
    return unfollowed("a pocket called modally is not followed; call it where it is meant");
  if (!absolute_) return fault(26, "CHK-CYCLE", "cycles in G91 are not followed", true);
  std::array<std::optional<double>, kRectangle.size()> values{};
  const std::size_t known = circle ? kCircle.size() : kRectangle.size();
  for (std::size_t i = 0; i < call.params.size(); ++i) {
    const std::string& text = call.params[i];
    if (text.empty()) continue;
    const auto value = parse_double(text.front() == '+' ? text.substr(1) : text);
    if (!value || !std::isfinite(*value) || (i >= known && *value != 0.0))
      return unfollowed("parameter " + std::to_string(i + 1) + ", " + text.substr(0, 20) +
                        ", is no number or a mode that is not followed");
    if (i < known) values[i] = value;
  }
  std::string missing;
  const auto find = [&](std::string_view name) {
    for (std::size_t i = 0; i < known; ++i) {
      if ((circle ? kCircle[i] : kRectangle[i]) == name) return values[i];
    }
    return std::optional<double>();
  };
  const auto of = [&](std::string_view name) {
    const auto value = find(name);
    if (!value && missing.empty()) missing = name;
    return value.value_or(0.0);
  };
  const double u = units();
  Pocket p;
  p.round = circle;
  p.back_z = of("RTP") * u;
  p.reference_z = of("RFP") * u;
  p.start_z = p.reference_z + of("SDIS") * u;
  p.floor_z = of("DP") * u;
  p.length_mm = circle ? 2.0 * of("PRAD") * u : of("LENG") * u;
  p.width_mm = circle ? p.length_mm : of("WID") * u;
  p.corner_mm = circle ? of("PRAD") * u : of("CRAD") * u;
  p.centre = {of("PA") * u, of("PO") * u};
  p.angle_rad = find("STA").value_or(0.0) / kDegrees;
  p.level_mm = of("MID") * u;
  p.side_mm = find("FAL").value_or(0.0) * u;
  p.bottom_mm = find("FALD").value_or(0.0) * u;
  p.feed_mm_min = of("FFP1") * u;
  p.ramp_feed_mm_min = of("FFD") * u;
  const double direction = of("CDIR"), kind = of("VARI");
  if (!missing.empty()) return wrong("_" + missing + " is missing");
  if (kind != 21.0)
    return unfollowed("_VARI " + plain(kind) + " is not followed; roughing along a helix, 21, is");
  p.helix_mm = of("RAD1") * u;
  p.turn_mm = of("DP1") * u;
  if (!missing.empty()) return wrong("_" + missing + " is missing");
  // Of a tool whose diameter the header does not say nothing is followed anyway.
  const double cutter = called_diameter_mm();
  const double over = find("MIDA").value_or(0.0) * u;
  p.over_mm = over != 0.0 ? over : kMidaShare * cutter;
  for (const auto name : {"AP1", "AP2", "AD"}) {
    if (find(name).value_or(0.0) != 0.0)
      return unfollowed(std::string("_") + name + ", a blank that is there already, is not followed");
  }
  for (const double v : {p.start_z - p.reference_z, p.length_mm, p.width_mm, p.level_mm, p.side_mm,
                         p.bottom_mm, p.over_mm, p.helix_mm, p.turn_mm}) {
    if (v < 0.0) return wrong("a size is below zero; dimensions from a corner are not followed");
  }
  // 0 climbing and 1 up-cut, by the way the spindle turns; 2 G2, 3 G3.
  if (direction != 0.0 && direction != 1.0 && direction != 2.0 && direction != 3.0)
    return wrong("_CDIR is " + plain(direction) + "; it says 0 to 3");
  if (direction < 2.0 && spindle_ == 0) return wrong("_CDIR hangs on the spindle, which does not turn");
  p.clockwise = direction >= 2.0 ? direction == 2.0 : (direction == 0.0) == (spindle_ < 0);
  mill(p);
}

}  // namespace capstan::verify::siemens
