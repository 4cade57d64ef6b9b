#include "planner/making/piece/twins.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

#include "planner/ground/base/number.h"

// Separate features in one place. The same hole or pocket drawn twice is made once, and both are named. A
// hole wholly within another's leaves no wall of its own: drawing and file disagree, and the file cannot
// decide which is meant. Two on one axis, the narrower deeper, are a counterbore and made as one; so is a
// shallower one of the same width with its own tolerance: the fit of a bore's mouth.

namespace capstan::piece {
namespace {

using model::FeatureShape;
using model::ShapeKind;

constexpr double kSamePlaceMm = 0.001;  // default, unsourced: what files round
constexpr double kAligned = 1.0 - 1e-9;

bool straight(const FeatureShape& s) {
  return s.kind == ShapeKind::kHole && std::abs(s.bottom_diameter_mm - s.diameter.nominal_mm) < kSamePlaceMm;
}

bool near(double a, double b) { return std::abs(a - b) < kSamePlaceMm; }

bool same_size(const model::Toleranced& a, const model::Toleranced& b) {
  return near(a.nominal_mm, b.nominal_mm) && a.given == b.given && a.lower_mm == b.lower_mm &&
         a.upper_mm == b.upper_mm;
}

/// Of two holes along one direction, in the frame of the first: how far apart, and from where to where each.
struct Beside {
  double apart_mm = 0.0;
  double low_a = 0.0, high_a = 0.0, low_b = 0.0, high_b = 0.0;
};
std::optional<Beside> beside(const FeatureShape& a, const FeatureShape& b) {
  if (!straight(a) || !straight(b)) return std::nullopt;
  const auto rel = compose(inverse(a.frame), b.frame);
  if (std::abs(rel.z.z) < kAligned) return std::nullopt;
  const double end = rel.origin.z - b.depth_mm * rel.z.z;
  return Beside{std::hypot(rel.origin.x, rel.origin.y), -a.depth_mm, 0.0, std::min(rel.origin.z, end),
                std::max(rel.origin.z, end)};
}

/// The same removal, drawn twice.
bool twins(const FeatureShape& a, const FeatureShape& b) {
  if (a.feature == b.feature || a.kind != b.kind) return false;
  if (const auto at = beside(a, b))
    return at->apart_mm < kSamePlaceMm && same_size(a.diameter, b.diameter) && near(at->low_a, at->low_b) &&
           near(at->high_a, at->high_b) && a.through == b.through && (a.through || a.bottom == b.bottom);
  const bool area = a.kind == ShapeKind::kPocket || a.kind == ShapeKind::kSlot;
  return area && norm(a.frame.origin - b.frame.origin) < kSamePlaceMm && norm(a.frame.x - b.frame.x) < 1e-6 &&
         alike(a, b);
}

/// Whether all that `a` takes away lies within `b`, and it asks for nothing that `b` does not make.
bool within(const FeatureShape& a, const FeatureShape& b) {
  const auto at = beside(a, b);
  if (!at || a.feature == b.feature) return false;
  if (at->apart_mm > 0.5 * (b.diameter.nominal_mm - a.diameter.nominal_mm) + kSamePlaceMm) return false;
  if (at->low_a < at->low_b - kSamePlaceMm || at->high_a > at->high_b + kSamePlaceMm) return false;
  const bool mouth = near(a.diameter.nominal_mm, b.diameter.nominal_mm) && a.diameter.given &&
                     !same_size(a.diameter, b.diameter) && at->low_a > at->low_b + kSamePlaceMm;
  return !mouth;
}

/// Those of `all` whose areas may reach the place of a shape, seen along its axis; rising. Twins, and what a
/// hole lies within, are among them: both areas hold the place.
std::vector<std::size_t> about(const Around& here, geometry::Vec3 axis, const std::vector<FeatureShape>& all,
                               const Neighbours& index) {
  constexpr double kReachMm = 10.0 * kSamePlaceMm;
  if (index.size() == all.size()) return index.near(here, axis, kReachMm);
  std::vector<std::size_t> out(all.size());
  std::iota(out.begin(), out.end(), std::size_t{0});
  return out;
}

std::string where(const FeatureShape& s) {
  const auto& p = s.frame.origin;
  return "(" + trimmed(p.x, 3) + ", " + trimmed(p.y, 3) + ", " + trimmed(p.z, 3) + ")";
}

std::string size(const FeatureShape& s) {
  return trimmed(s.diameter.nominal_mm, 3) + " mm wide and " + trimmed(s.depth_mm, 3) + " mm deep";
}

}  // namespace

bool same_removal(const Shapes& shapes, const FeatureShape& a, const FeatureShape& b) {
  return shapes.twins.contains({Drawn{a.feature, a.member}, Drawn{b.feature, b.member}});
}

std::string lies_within_another(const Shapes& shapes, const FeatureShape& s) {
  for (const std::size_t i : about(around(s), s.frame.z, shapes.whole, shapes.near_whole)) {
    const FeatureShape& o = shapes.whole[i];
    if (!within(s, o) || twins(s, o)) continue;
    const bool of_one = near(s.diameter.nominal_mm, o.diameter.nominal_mm) && near(s.depth_mm, o.depth_mm);
    return of_one ? "'" + o.name + "' is a hole of the same size at the same place, " + where(s) +
                        ", with another tolerance or bottom, and nothing says which of them is meant: take "
                        "one of them out of the file"
                  : "'" + s.name + "', " + size(s) + " at " + where(s) + ", lies wholly within the hole '" +
                        o.name + "', " + size(o) +
                        ": nothing of its wall would be left; take one of them out of the file, or mend its "
                        "place or size";
  }
  return {};
}

std::set<std::pair<Drawn, Drawn>> twins_of(const std::vector<FeatureShape>& all, const Neighbours& index,
                                           Job& job) {
  std::set<std::pair<Drawn, Drawn>> out;
  for (std::size_t i = 0; i < all.size(); ++i) {
    bool told = false;
    const Around here = index.size() == all.size() ? index.ball(i) : around(all[i]);
    for (const std::size_t k : about(here, all[i].frame.z, all, index)) {
      if (k >= i) break;
      if (!twins(all[k], all[i])) continue;
      const Drawn first{all[k].feature, all[k].member}, second{all[i].feature, all[i].member};
      out.insert({{first, second}, {second, first}});
      if (std::exchange(told, true)) continue;
      job.warn("PIP-TWICE", "features '" + all[k].name + "' and '" + all[i].name +
                                "' are the same at the same place, " + where(all[i]) +
                                ": machined once; delete one of them, or correct its placement");
    }
  }
  return out;
}

}  // namespace capstan::piece
