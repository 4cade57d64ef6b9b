#include <string>

#include "planner/controls/siemens/siemens.h"
#include "planner/ground/base/number.h"

// Pockets as cycles, their parameters as SINUMERIK 840D/840Di/810D, user's guide cycles 11.02, 6FC5298-6AB40,
// lists them (3.10 POCKET3, 3.11 POCKET4): remembered, as tests/controls/siemens/golden/README.md says.

namespace capstan::controls::siemens {
namespace {

// _CDIR: climbing or not, for the spindle's own sense. _VARI, tens: in along a helix; ones: roughing.
constexpr const char *kClimb = "0", *kUpCut = "1";
constexpr const char* kRoughAlongHelix = "21";

/// POCKET3(_RTP, _RFP, _SDIS, _DP, _LENG, _WID, _CRAD, _PA, _PO, _STA, _MID, _FAL, _FALD, _FFP1, _FFD, _CDIR,
/// _VARI, _MIDA, _AP1, _AP2, _AD, _RAD1, _DP1); POCKET4 has _PRAD in place of _LENG, _WID and _CRAD, neither
/// _STA nor _AP2.
///
/// A slot is POCKET3, too, a rectangle whose corners are half as wide as it is. SLOT1 says where a slot is by
/// a radius about a centre of a circle, and what of the slot lies there (its near end, the middle of its
/// end's round, or its own) could not be looked up: a slot in the wrong place would be the price.
std::optional<std::string> pocket_text(const gcode::PocketCycle& p) {
  if (p.helix_mm == 0.0) return std::nullopt;
  const auto n = [&](double v) { return trimmed(v, p.decimals) + ","; };
  const auto f = [&](double v) { return trimmed(v, p.feed_decimals) + ","; };
  const std::string planes = n(p.back_z) + n(p.reference_z) + n(p.start_z - p.reference_z) + n(p.floor_z);
  const std::string place = n(p.centre.x) + n(p.centre.y);
  const std::string cut = n(p.level_mm) + n(p.side_mm) + n(p.bottom_mm) + f(p.feed_mm_min) +
                          f(p.ramp_feed_mm_min) + (p.climbs ? kClimb : kUpCut) + "," + kRoughAlongHelix +
                          "," + n(p.over_mm);
  const std::string in = n(p.helix_mm) + trimmed(p.turn_mm, p.decimals) + ")";
  if (p.round) return "POCKET4(" + planes + n(0.5 * p.length_mm) + place + cut + ",," + in;
  return "POCKET3(" + planes + n(p.length_mm) + n(p.width_mm) + n(p.corner_mm) + place +
         trimmed(p.angle_deg, gcode::kMostDecimals) + "," + cut + ",,," + in;
}

}  // namespace

constinit const gcode::PocketWords kPockets{.text = &pocket_text};

}  // namespace capstan::controls::siemens
