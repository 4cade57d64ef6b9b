#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "planner/ground/base/number.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/siemens/interpreter.h"

// CYCLE71, roughing in strokes back and forth, by the description of its parameters: SINUMERIK 808D,
// programming and operating manual (milling), 07/2018, 6FC5398-4DP10-0BA7, 12.6.2, whose list a published
// translator of such programs agrees with. Which way strokes lie where the rectangle is turned, and one-way
// strokes, are not followed.

namespace capstan::verify::siemens {
namespace {

/// _MIDA left out: 80 % of the mill's diameter.
constexpr double kMidaShare = 0.8;

constexpr std::array<std::string_view, 16> kFace = {"RTP",  "RFP",  "SDIS", "DP",  "PA",   "PO",
                                                    "LENG", "WID",  "STA",  "MID", "MIDA", "FDP",
                                                    "FALD", "FFP1", "VARI", "FDP1"};

}  // namespace

void Interpreter::face(const Item& call, bool modal) {
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", "CYCLE71: " + why); };
  const auto unfollowed = [&](const std::string& why) {
    fault(33, "CHK-UNVERIFIABLE", "CYCLE71: " + why, true);
  };
  if (modal || modal_) return unfollowed("a face called modally is not followed; call it where it is meant");
  if (!absolute_) return fault(26, "CHK-CYCLE", "cycles in G91 are not followed", true);
  std::array<std::optional<double>, kFace.size()> values{};
  for (std::size_t i = 0; i < call.params.size(); ++i) {
    const std::string& text = call.params[i];
    if (text.empty()) continue;
    const auto value = parse_double(text.front() == '+' ? text.substr(1) : text);
    if (!value || !std::isfinite(*value) || (i >= kFace.size() && *value != 0.0))
      return unfollowed("parameter " + std::to_string(i + 1) + ", " + text.substr(0, 20) +
                        ", is no number or a mode that is not followed");
    if (i < kFace.size()) values[i] = value;
  }
  std::string missing;
  const auto find = [&](std::string_view name) {
    return values[static_cast<std::size_t>(std::find(kFace.begin(), kFace.end(), name) - kFace.begin())];
  };
  const auto of = [&](std::string_view name) {
    const auto value = find(name);
    if (!value && missing.empty()) missing = name;
    return value.value_or(0.0);
  };
  const double u = units();
  FacedArea f;
  f.back_z = of("RTP") * u;
  f.reference_z = of("RFP") * u;
  f.start_z = f.reference_z + of("SDIS") * u;
  f.floor_z = of("DP") * u;
  const geometry::Vec2 corner{of("PA") * u, of("PO") * u}, size{of("LENG") * u, of("WID") * u};
  f.lo = {std::min(corner.x, corner.x + size.x), std::min(corner.y, corner.y + size.y)};
  f.hi = {std::max(corner.x, corner.x + size.x), std::max(corner.y, corner.y + size.y)};
  f.level_mm = of("MID") * u;
  f.out_mm = of("FDP") * u;
  f.bottom_mm = find("FALD").value_or(0.0) * u;
  f.feed_mm_min = of("FFP1") * u;
  f.beyond_mm = find("FDP1").value_or(0.0) * u;
  const double kind = of("VARI");
  if (!missing.empty()) return wrong("_" + missing + " is missing");
  if (find("STA").value_or(0.0) != 0.0)
    return unfollowed("_STA " + plain(*find("STA")) + " is not followed; a rectangle along the axes, 0, is");
  if (kind != 31.0 && kind != 41.0)
    return unfollowed("_VARI " + plain(kind) +
                      " is not followed; roughing back and forth along an axis, 31 and 41, is");
  f.along_y = kind == 41.0;
  const double over = find("MIDA").value_or(0.0) * u;
  f.over_mm = over != 0.0 ? over : kMidaShare * called_diameter_mm();
  for (const double v :
       {f.start_z - f.reference_z, f.level_mm, f.out_mm, f.bottom_mm, f.beyond_mm, f.over_mm}) {
    if (v < 0.0) return wrong("a distance is below zero");
  }
  if (spindle_ == 0) return fault(15, "CHK-SPINDLE", "CYCLE71: the spindle stands");
  mill(f);
}

}  // namespace capstan::verify::siemens
