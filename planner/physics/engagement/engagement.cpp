#include "planner/physics/engagement/engagement.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/physics/engagement/front.h"
#include "planner/physics/stock/sweep.h"

// Cross sections on a height map, measured by volume. A move is divided into steps. `stock::sweep` lowers the
// cells under each step and tallies what it removed: volume, moments, and the lowest and highest contact in
// bins across the feed. For one step of length s:
//
//     CSA = removed volume / s           centre of gravity = moments / removed volume
//     ADmax = tallest contact of a bin   RDmax = right - left contact, within the outline's width there
//     entry, exit = acos(-x / R) of the left and the right contact; a plunge is the whole circle
//
// A plunge takes the same section at each step from where all of the cutter is in material until it goes
// through the piece: those steps are swept as one.
//
// A rapid straight back where the cutter has been takes nothing (stock::Upright), also from cells that are
// coarse for it. The lateral contact is known to a cell. Where a flat cutter takes an even layer, CSA / ADmax
// is more exact, so that the side away from the cutter's edge is set by it (`sharpen`). Moves above all
// material are skipped. Source  definitions of the seven numbers: AP238 edition 2, 4.2.379.4; the method:
// derived.

namespace capstan::engagement {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::CutterClass;
using model::CutterPath;
using model::MoveKind;
using stock::Tally;

constexpr double kSlack = 1e-3;    // mm: heights are single precision
constexpr double kFarthest = 1e5;  // mm, from the set-up's origin: no machine is a hundred metres long

bool usable(const geometry::CutterProfile& p) {
  const auto sound = [](const geometry::ProfilePiece& piece) {
    for (const double v :
         {piece.r0_mm, piece.r1_mm, piece.z0_mm, piece.slope, piece.radius_mm, piece.rc_mm, piece.zc_mm}) {
      if (!std::isfinite(v)) return false;
    }
    return true;
  };
  return p.radius_mm > 0.0 && p.radius_mm <= kFarthest && !p.pieces.empty() &&
         std::all_of(p.pieces.begin(), p.pieces.end(), sound);
}

struct Extent {
  double size = 0.0, middle = 0.0;
};

/// The tallest contact over the bins of X; `tip`: height of the tip above the map's floor.
Extent axial_extent(const Tally& t, double tip) {
  Extent best;
  for (std::size_t b = 0; b < Tally::kBins; ++b) {
    const double size = static_cast<double>(t.high[b]) - static_cast<double>(t.low[b]);
    if (size > best.size) {
      best = {size, 0.5 * (static_cast<double>(t.high[b]) + static_cast<double>(t.low[b])) - tip};
    }
  }
  return best;
}

/// What lies under a move, or may: a band about the line from a to b, or a disc about a.
struct Band {
  Vec2 a, b;
  double radius_mm = 0.0;
  bool disc = false;
};
Band band_over(const CutterPath& path, std::size_t i, double r) {
  const Vec2 a = xy(path.point(i - 1));
  const Vec2 b = xy(path.point(i));
  if (!is_arc(path.kind[i])) return {a, b, r};
  const Vec2 centre{path.cx[i], path.cy[i]};
  const double arc = std::max(norm(a - centre), norm(b - centre));
  const double half = 0.5 * model::arc_sweep(path, i);
  if (half > 0.5 * std::numbers::pi) return {centre, centre, arc + r, true};
  return {a, b, r + arc * (1.0 - std::cos(half))};
}

class Measurer {
 public:
  Measurer(const CutterPath& path, geometry::CutterProfile profile, stock::HeightMap& map, double step)
      : path_(path), profile_(std::move(profile)), nose_(round_nose(profile_)), map_(map), step_(step) {}

  Measurement run() {
    for (std::size_t i = 0; i < path_.size(); ++i) move(i);
    out_.known_to_mm = map_.cell_mm;
    return std::move(out_);
  }

 private:
  void move(std::size_t i) {
    const double length = model::move_length(path_, i);
    const bool back = upright_.goes_back(path_, i);
    if (i == 0 || path_.kind[i] == MoveKind::kDwell || length <= 0.0) {
      if (i == 0) out_.rapid_removed_mm3 += stock::cut(map_, profile_, path_, 0);
      return;
    }
    if (path_.kind[i] == MoveKind::kRapid) {
      if (back) return;
      turn_to(path_.point(i) - path_.point(i - 1));
      if (ceiling_over(i) > std::min(path_.z[i - 1], path_.z[i]))
        out_.rapid_removed_mm3 += stock::cut(map_, profile_, path_, i);
      return;
    }
    const double ceiling = ceiling_over(i);
    if (ceiling <= std::min(path_.z[i - 1], path_.z[i])) {
      if (!is_arc(path_.kind[i])) turn_to(path_.point(i) - path_.point(i - 1));
      return close(i, length);
    }
    feed(i, length, ceiling);
  }

  /// Highest material under the move, judged by the whole disc.
  [[nodiscard]] double ceiling_over(std::size_t i) const {
    const Band over = band_over(path_, i, profile_.radius_mm);
    return over.disc ? stock::max_height(map_, over.a, over.radius_mm)
                     : stock::max_height(map_, over.a, over.b, over.radius_mm);
  }

  void turn_to(Vec3 d) {
    if (norm(xy(d)) > 1e-9) heading_ = xy(d);
  }

  void feed(std::size_t i, double length, double ceiling) {
    const bool arc = is_arc(path_.kind[i]);
    int n = std::max(1, static_cast<int>(std::ceil(length / step_ - 1e-9)));
    if (arc)
      n = std::max(n, static_cast<int>(std::ceil(model::arc_sweep(path_, i) / (std::numbers::pi / 6.0))));
    Vec3 from = path_.point(i - 1);
    const auto end_of = [&](int k) {
      return k == n ? path_.point(i) : model::point_on_move(path_, i, static_cast<double>(k) / n);
    };
    const Steady steady = arc || n == 1 ? Steady{} : steady_from(from, path_.point(i));
    for (int k = 1; k <= n; ++k) {
      const Vec3 to = end_of(k);
      Tally tally;
      turn_to(to - from);
      const bool plunge = !arc && norm(xy(to) - xy(from)) < 1e-9;
      const double chip = arc || plunge ? 0.0 : thickest_chip(from, to, ceiling);
      stock::sweep(map_, profile_,
                   {.from = from,
                    .to = to,
                    .arc = arc,
                    .centre = {path_.cx[i], path_.cy[i]},
                    .clockwise = path_.kind[i] == MoveKind::kArcCw,
                    .ceiling_mm = ceiling},
                   true, heading_, tally);
      const double at = length * k / n;
      if (tally.removed_mm3 > 0.0) {
        add(i, at, length / n, plunge, std::min(from.z, to.z) - map_.origin.z, chip, tally);
      } else {
        close(i, at);
      }
      if (from.z <= steady.highest_mm && tally.removed_mm3 > 0.0) {
        int last = k;
        while (last < n && end_of(last + 1).z >= steady.lowest_mm) ++last;
        if (last > k) {
          const Vec3 down = end_of(last);
          go_on(i, to, down, k, last, length / n, tally);
          k = last;
          from = down;
          continue;
        }
      }
      from = to;
    }
  }

  /// Heights of the tip from `highest_mm`, where all of the cutter is in material, down to `lowest_mm`, below
  /// which it goes through the piece: there a plunge takes one section.
  struct Steady {
    double highest_mm = -1e300, lowest_mm = 1e300;
  };
  [[nodiscard]] Steady steady_from(Vec3 from, Vec3 to) const {
    if (norm(xy(to) - xy(from)) >= 1e-9 || to.z >= from.z) return {};
    return {
        stock::min_height(map_, xy(from), profile_.radius_mm) - profile_.height(profile_.radius_mm) - kSlack,
        map_.origin.z};
  }

  /// The steps after the kth up to the last of a plunge as steady as its kth, in one sweep.
  void go_on(std::size_t i, Vec3 from, Vec3 to, int k, int last, double step, const Tally& kth) {
    Tally all;
    stock::sweep(map_, profile_, {.from = from, .to = to, .centre = {}}, true, heading_, all);
    const int n = last - k;
    for (int next = k + 1; next <= last; ++next) {
      const double down = step * (next - k);
      Tally t = kth;
      t.removed_mm3 = all.removed_mm3 / n;
      t.sum_x = kth.sum_x * (t.removed_mm3 / kth.removed_mm3);
      t.sum_y = kth.sum_y * (t.removed_mm3 / kth.removed_mm3);
      for (float* bins : {t.low.data(), t.high.data()})
        for (std::size_t b = 0; b < Tally::kBins; ++b) bins[b] -= static_cast<float>(down);
      add(i, step * next, step, true, from.z - down - map_.origin.z, 0.0, t);
    }
  }

  /// Of a step about to be swept, over the feed per tooth: the larger of its middle and its end.
  [[nodiscard]] double thickest_chip(Vec3 from, Vec3 to, double ceiling) const {
    if (!nose_) return 0.0;
    const Vec3 feed = (1.0 / norm(to - from)) * (to - from);
    const double middle = chip_over_feed(map_, *nose_, 0.5 * (from + to), feed, ceiling);
    const double found = chip_over_feed(map_, *nose_, to, feed, ceiling, middle);
    constexpr double kDoubt = 1.1;  // of a cell: rows lie beside the way, heights are rounded
    return std::min(1.0, found + kDoubt * map_.cell_mm / nose_->round_mm);
  }

  /// One sample without contact after the last with it.
  void close(std::size_t i, double at) {
    if (out_.engagement.empty() || out_.engagement.back().removed_mm3 <= 0.0) return;
    push(i, at, {}, {}, 0.0, 0.0, {});
  }

  void add(std::size_t i, double at, double step, bool plunge, double tip, double chip, const Tally& t) {
    const double csa = t.removed_mm3 / step;
    const Extent axial = axial_extent(t, tip);
    double highest = 0.0;  // above the tip
    for (const float high : t.high) highest = std::max(highest, static_cast<double>(high) - tip);
    // Contact lies within the outline's radius at its highest point.
    const double reach = profile_.radius_at(highest);
    double left = std::max(t.left_mm, -reach);
    double right = std::min(t.right_mm, reach);
    if (!plunge) sharpen(csa, axial.size, left, right);
    const Extent radial{right - left, 0.5 * (left + right)};
    Engagement e{.ap_mm = axial.size,
                 .ae_mm = radial.size,
                 .csa_mm2 = csa,
                 .removed_mm3 = t.removed_mm3,
                 .step_mm = step,
                 .plunge = plunge,
                 .chip_over_feed = chip};
    if (plunge) {
      e.exit_rad = 2.0 * std::numbers::pi;
    } else {
      const double r = profile_.radius_mm;
      const auto angle = [&](double x) { return std::acos(std::clamp(-x / r, -1.0, 1.0)); };
      e.entry_rad = angle(left);
      e.exit_rad = angle(right);
    }
    e.arc_rad = e.exit_rad - e.entry_rad;
    if (!plunge) e.arc_rad -= gaps(t, left, right);
    out_.highest_contact_mm = std::max(out_.highest_contact_mm, highest);
    out_.removed_mm3 += t.removed_mm3;
    push(i, at, axial, radial, t.sum_x / t.removed_mm3, t.sum_y / t.removed_mm3, e);
  }

  /// Angle between entry and exit at which nothing was touched, at the full radius, rad. A gap narrower than
  /// a bin and a half or a cell and a half does not count: it may be the spacing of cells.
  [[nodiscard]] double gaps(const Tally& t, double left, double right) const {
    const double r = profile_.radius_mm;
    const double bin = 2.0 * r / static_cast<double>(Tally::kBins);
    const double narrow = std::max(1.5 * map_.cell_mm, 1.5 * bin);
    const auto touched = [&](std::size_t b) { return t.high[b] >= t.low[b]; };
    double sum = 0.0;
    for (std::size_t b = 0; b < Tally::kBins; ++b) {
      if (touched(b)) continue;
      std::size_t end = b;
      while (end < Tally::kBins && !touched(end)) ++end;
      const double lo = std::max(left, bin * static_cast<double>(b) - r);
      const double hi = std::min(right, bin * static_cast<double>(end) - r);
      if (b > 0 && end < Tally::kBins && hi - lo > narrow) sum += std::acos(-hi / r) - std::acos(-lo / r);
      b = end;
    }
    return sum;
  }

  /// X extents are known to a cell. Where a flat cutter takes an even layer, area over depth says it better;
  /// the side that is not at the cutter's own edge gives way.
  void sharpen(double csa, double depth, double& left, double& right) const {
    if (!is_flat(profile_) || depth <= 0.0) return;
    const double width = csa / depth;
    if (std::abs(width - (right - left)) > 2.0 * map_.cell_mm || width > 2.0 * profile_.radius_mm) return;
    if (profile_.radius_mm - right <= profile_.radius_mm + left) {
      left = right - width;
    } else {
      right = left + width;
    }
  }

  void push(std::size_t i, double at, Extent axial, Extent radial, double x, double y, const Engagement& e) {
    auto& s = out_.sections;
    s.move.push_back(static_cast<std::uint32_t>(i));
    s.at_mm.push_back(at);
    s.ad_max_mm.push_back(axial.size);
    s.rd_max_mm.push_back(radial.size);
    s.x_max_ofs_mm.push_back(radial.middle);
    s.y_max_ofs_mm.push_back(axial.middle);
    s.csa_mm2.push_back(e.csa_mm2);
    s.x_cg_ofs_mm.push_back(x);
    s.y_cg_ofs_mm.push_back(y);
    s.removed_mm3.push_back(e.removed_mm3);
    out_.engagement.push_back(e);
  }

  const CutterPath& path_;
  geometry::CutterProfile profile_;
  std::optional<RoundNose> nose_;
  stock::HeightMap& map_;
  double step_;
  Vec2 heading_{1.0, 0.0};
  stock::Upright upright_;
  Measurement out_;
};

}  // namespace

geometry::Box3 looked_at(const CutterPath& path, double radius_mm) {
  geometry::Box3 out;
  const auto add = [&](Vec2 p, double r) {
    out.add({p.x - r, p.y - r, 0.0});
    out.add({p.x + r, p.y + r, 0.0});
  };
  const geometry::Box3 way = model::bounds(path);
  add(xy(way.lo), radius_mm);
  add(xy(way.hi), radius_mm);
  for (std::size_t i = 1; i < path.size(); ++i) {
    if (!is_arc(path.kind[i])) continue;
    const Band over = band_over(path, i, radius_mm);
    add(over.a, over.radius_mm);
    add(over.b, over.radius_mm);
  }
  return out;
}

std::optional<double> head_height(const model::Cutter& c) {
  if (c.cutter_class == CutterClass::kSideMill && c.cutting_width_mm > 0.0) return c.cutting_width_mm;
  if (c.cutter_class == CutterClass::kSideMill || model::mills_threads(c.cutter_class)) {
    return c.maximum_depth_of_cut_mm;
  }
  return std::nullopt;
}

Result<Measurement> measure(const CutterPath& path, const model::Cutter& cutter, stock::HeightMap& map,
                            const Options& options) {
  if (model::has(cutter.cutter_class, model::CutterTrait::kUndercuts)) {
    return fail("ENG-UNDERCUT", "the cut of " + std::string(model::to_text(cutter.cutter_class)) + " '" +
                                    cutter.id + "' lies under an overhang; it is not measured");
  }
  geometry::CutterProfile profile = model::profile_of(cutter);
  if (!usable(profile)) {
    return fail("ENG-PROFILE", "cutter '" + cutter.id + "' has no cutting diameter, or no shape that cuts");
  }
  for (std::size_t i = 0; i < path.size(); ++i) {
    for (const double v : {path.x[i], path.y[i], path.z[i], path.cx[i], path.cy[i]}) {
      if (std::abs(v) <= kFarthest) continue;  // not so for what is not a number
      return fail("ENG-NUMBER",
                  "point " + std::to_string(i) + " of the path is not finite or beyond any machine");
    }
  }
  if (map.cells() == 0) return Measurement{};
  const double step =
      options.step_mm > 0.0 ? options.step_mm : std::max(profile.radius_mm / 20.0, 2.0 * map.cell_mm);
  const std::optional<double> head = head_height(cutter);
  if (!head) return Measurer(path, std::move(profile), map, step).run();
  stock::HeightMap trial = map;
  Measurement out = Measurer(path, std::move(profile), trial, step).run();
  if (out.highest_contact_mm > *head + kSlack) {
    return fail("ENG-UNDERCUT", "material stands over the head of " +
                                    std::string(model::to_text(cutter.cutter_class)) + " '" + cutter.id +
                                    "' (" + trimmed(*head, 3) + " mm high): its cut is not measured");
  }
  map = std::move(trial);
  return out;
}

}  // namespace capstan::engagement
