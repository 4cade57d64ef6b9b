#include "planner/model/plan/cutter/ramp.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "planner/model/plan/cutter/stated.h"

// How steep and how fast. The cutter goes down by feed x sin(angle), so that of two ways, a flat one at more
// feed and a steep one at less, the one that goes down faster is taken (Dormer Pramet, Milling 2021-22 p.
// 775: some tools descend at a lower angle and a higher feed, or at a higher angle and a lower feed).

namespace capstan::model {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

struct Row {
  std::string_view iso_group;
  double carbide_deg, hss_deg;
  double bore_in_d;
  [[nodiscard]] double slot_in_d() const { return std::min(bore_in_d, kDeepestSlotRatio); }
};
/// Source  N: 3 to 10 degrees in soft, non-ferrous materials; M, S, H and HSS in ferrous ones: 1 to 3 (Harvey
///         Performance, In the Loupe, "Ramping to success"; the upper ends). P, K with carbide: standard end
///         mills bear 2 to 5 degrees by their flutes and core (carbide-tooling.com, ramping angle calculator;
///         the upper end: what a mill with more flutes bears is its own). Depth in diameters: that of slots
///         milled in one cut by solid carbide (Tungaloy catalogue 2020-21 p. 1084) is taken for a bore along
///         a helix, which is wider, so that its chips come out more easily; a slot is no deeper than either
///         maker says.
constexpr std::array kRows = {Row{"P", 5.0, 3.0, 2.0},   Row{"M", 3.0, 3.0, 1.0}, Row{"K", 5.0, 3.0, 2.0},
                              Row{"N", 10.0, 10.0, 2.0}, Row{"S", 3.0, 3.0, 1.0}, Row{"H", 3.0, 3.0, 0.5}};
/// Of a material whose group is not known.
constexpr Row kUnknown{"", 3.0, 3.0, 0.5};

/// Of cutters whose edges reach the centre, of the feed of milling a slot: 75 % (Sandvik Coromant, milling of
/// holes and cavities, ramping). Other makers say 50 to 75 % (lamina-tech.ch, linear ramping down) and less.
constexpr double kThreeQuarters = 0.75;
/// Of those whose edges do not, and at the steepest angle that a maker states: half the recommended feed
/// (Kyocera, catalogue 2021-22 p. M136, ramping up to RMPX and helical milling).
constexpr double kHalf = 0.5;

const Row& row_of(const WorkMaterial& m) {
  for (const Row& row : kRows) {
    if (row.iso_group == m.iso_group) return row;
  }
  return kUnknown;
}

}  // namespace

bool cuts_hard_steel(const Cutter& c, const WorkMaterial& m) {
  // A card of the group that states no hardness is taken for hard.
  const bool softer = m.hardness_hb > 0.0 && m.hardness_hb <= kHardHb;
  return m.iso_group == "H" && !softer && c.cutter_class != CutterClass::kFacemill;
}

double hard_level_mm(const Cutter& c, const WorkMaterial& m) {
  if (!cuts_hard_steel(c, m)) return std::numeric_limits<double>::infinity();
  return std::max(kHardCut.level * c.cutting_diameter_mm, kThinnestHardMm);
}

Ramp ramp_of(const Cutter& c, const WorkMaterial& m) {
  const double most = c.maximum_ramp_angle_rad;
  const Row& row = row_of(m);
  const double slot = std::min(row.slot_in_d() * c.cutting_diameter_mm, hard_level_mm(c, m));
  const double bore = row.bore_in_d * c.cutting_diameter_mm;
  if (!(most > 0.0))
    return {.angle_rad = 0.0, .feed_share = kHalf, .slot_depth_mm = slot, .bore_depth_mm = bore};
  const double usual_rad = kDegree * (c.substrate == Substrate::kCarbide ? row.carbide_deg : row.hss_deg);
  const Ramp usual{std::min(most, usual_rad), c.centre_cutting ? kThreeQuarters : kHalf, slot, bore};
  const Ramp steep{most, kHalf, slot, bore};
  const bool faster =
      steep.feed_share * std::sin(steep.angle_rad) > usual.feed_share * std::sin(usual.angle_rad);
  return faster && is_stated(c, "maximum_ramp_angle_rad") ? steep : usual;
}

}  // namespace capstan::model
