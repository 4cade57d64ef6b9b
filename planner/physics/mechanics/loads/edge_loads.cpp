// Forces of all teeth over a pitch (section.h has the model). The shape of the tangential force over the arc,
// sin^(1 - mc), is integrated once on a grid of the arc; what a piece of the edge adds at an angle is the
// mean over its lag, a difference of two running integrals. Forces are linear in these integrals, with
// factors of the piece and of the law. All that a feed changes is one factor of the chips' part, so that the
// moments at each angle, and by Kienzle's law their peaks, serve at every feed.
#include "planner/physics/mechanics/loads/edge_loads.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kCells = 32;    // of the arc
constexpr int kSamples = 32;          // of a tooth pitch
constexpr double kNoLagRad = 1e-6;    // below, an edge is straight to within rounding
constexpr double kJustInside = 1e-9;  // keeps rounding from losing a tooth that is about to leave
/// And one at its entry: more than the rounding of an angle of some turns, less than kJustInside, so that the
/// tooth a pitch behind one about to leave is not in yet.
constexpr double kEntryRad = 1e-12;

/// Integrals of a shape: times cos, times sin, and alone.
struct Integrals {
  double c = 0.0, s = 0.0, one = 0.0;
  Integrals& operator+=(const Integrals& o) {
    c += o.c;
    s += o.s;
    one += o.one;
    return *this;
  }
  Integrals& operator-=(const Integrals& o) {
    c -= o.c;
    s -= o.s;
    one -= o.one;
    return *this;
  }
  friend Integrals operator-(const Integrals& a, const Integrals& b) {
    return {a.c - b.c, a.s - b.s, a.one - b.one};
  }
};

/// A shape over the arc and its running integrals on a grid; linear between, so that the mean over a lag goes
/// to the value without a jump as the lag goes to nothing.
class ArcTable {
 public:
  /// sin^(1 - mc): of chips.
  ArcTable(double from, double to, double mc) : ArcTable(from, to) {
    const bool exact = mc == 0.0;
    Point p, before;
    each([&](std::size_t i, double a, double sine, double cosine) {
      const double safe = std::max(sine, 0.0);
      const double shape = exact ? safe : (safe > 0.0 ? std::exp((1.0 - mc) * std::log(safe)) : 0.0);
      p.value = {shape * cosine, shape * safe, shape};
      p.running.c = shape * safe / (2.0 - mc);  // exact
      if (exact) {
        p.running.s = 0.5 * (a - sine * cosine);
        p.running.one = -cosine;
      } else if (i > 0) {
        p.running.s = before.running.s + 0.5 * step_ * (before.value.s + p.value.s);
        p.running.one = before.running.one + 0.5 * step_ * (before.value.one + p.value.one);
      }
      if (i > 0) cells_[i - 1] = cell(before, p);
      before = p;
    });
  }
  /// 1: of edges.
  static ArcTable of_edges(double from, double to) {
    ArcTable out(from, to);
    Point p, before;
    out.each([&](std::size_t i, double a, double sine, double cosine) {
      p = {{cosine, sine, 1.0}, {sine, -cosine, a}};
      if (i > 0) out.cells_[i - 1] = out.cell(before, p);
      before = p;
    });
    return out;
  }

  [[nodiscard]] double from() const { return from_; }
  [[nodiscard]] double to() const { return from_ + step_ * static_cast<double>(kCells); }
  [[nodiscard]] Integrals upto(double a) const {
    const auto [i, t] = place(a);
    const Cell& k = cells_[i];
    return {k.at.c + t * (k.by.c + t * k.twice.c), k.at.s + t * (k.by.s + t * k.twice.s),
            k.at.one + t * (k.by.one + t * k.twice.one)};
  }

  /// The shape itself, times cos, times sin, and alone.
  [[nodiscard]] Integrals at(double a) const {
    const auto [i, t] = place(a);
    const Cell& k = cells_[i];
    const double more = 2.0 * t / step_;
    return {k.value.c + more * k.twice.c, k.value.s + more * k.twice.s, k.value.one + more * k.twice.one};
  }

 private:
  ArcTable(double from, double to)
      : from_(from), step_((to - from) / static_cast<double>(kCells)), per_step_(1.0 / step_) {}
  struct Point {
    Integrals value, running;
  };
  /// The running integral in a cell, t = 0 .. 1 along it: at + t (by + t twice).
  struct Cell {
    Integrals at, by, twice, value;
  };
  /// f(i, a, sin a, cos a) at the grid's points.
  template <class F>
  void each(const F& f) const {
    const double turn_c = std::cos(step_);
    const double turn_s = std::sin(step_);
    double sine = std::sin(from_);
    double cosine = std::cos(from_);
    for (std::size_t i = 0; i <= kCells; ++i) {
      f(i, from_ + step_ * static_cast<double>(i), sine, cosine);
      const double next = sine * turn_c + cosine * turn_s;
      cosine = cosine * turn_c - sine * turn_s;
      sine = next;
    }
  }
  /// What the trapezium between two points lacks of the integral is spread evenly.
  [[nodiscard]] Cell cell(const Point& p, const Point& q) const {
    const double half = 0.5 * step_;
    const Integrals &f = p.value, &g = q.value;
    const Integrals gained = q.running - p.running;
    const Integrals bent{half * (g.c - f.c), half * (g.s - f.s), half * (g.one - f.one)};
    return {p.running, gained - bent, bent, f};
  }
  [[nodiscard]] std::pair<std::size_t, double> place(double a) const {
    constexpr auto kLast = static_cast<int>(kCells) - 1;
    const double s = std::clamp((a - from_) * per_step_, 0.0, static_cast<double>(kCells));
    const int i = s > 0.0 ? std::min(static_cast<int>(s), kLast) : 0;  // what is no number stays none
    return {static_cast<std::size_t>(i), s - i};
  }

  double from_, step_, per_step_;
  std::array<Cell, kCells> cells_;
};

void add(Moment& m, double t, double r, double a, double radius, const Integrals& i, double weight) {
  m.force.fx_n += weight * (-t * i.c - r * i.s);
  m.force.fy_n += weight * (t * i.s - r * i.c);
  m.force.fz_n += weight * (a * i.one);
  m.torque_nmm += weight * (radius * (t * i.one));
}

/// A piece with its forces per integral of the chip's shape (at the factor 1) and of the edge.
struct Loaded {
  const Piece* p = nullptr;
  bool straight = false;                ///< without a lag: all of it is at the lag's middle
  double middle = 0.0;                  ///< of the lag
  double weight = 1.0;                  ///< of its integrals over the lag
  double ct = 0.0, cr = 0.0, ca = 0.0;  ///< tangential, radial in the plane, axial
  double et = 0.0, er = 0.0, ea = 0.0;
  Integrals from, to, edge_from, edge_to;  ///< the running integrals at the ends of its arc
};

/// All teeth of a section.
class Teeth {
 public:
  Teeth(const Pieces& all, const ForceLaw& law, const Tooth& tooth)
      : all_(all), exact_(law.mechanistic || law.kienzle.mc == 0.0), chips_(chips_of(all, law)) {
    if (law.mechanistic) edges_ = ArcTable::of_edges(chips_.from(), chips_.to());
    for (std::size_t i = 0; i < all.count; ++i) {
      const Piece& p = all.item[i];
      Loaded& k = loaded_[i];
      k.p = &p;
      k.straight = p.lag_high - p.lag_low < kNoLagRad;
      k.middle = 0.5 * (p.lag_low + p.lag_high);
      if (!k.straight) k.weight = 1.0 / (p.lag_high - p.lag_low);
      first_ = std::min(first_, p.from + (k.straight ? k.middle : p.lag_low));
      last_ = std::max(last_, p.to + (k.straight ? k.middle : p.lag_high));
      force(k, law, tooth.helix_rad);
      k.from = chips_.upto(p.from);
      k.to = chips_.upto(p.to);
      if (!edges_) continue;
      k.edge_from = edges_->upto(p.from);
      k.edge_to = edges_->upto(p.to);
    }
  }

  [[nodiscard]] bool has_edge() const { return edges_.has_value(); }
  /// Each piece over its whole arc.
  [[nodiscard]] MomentAtFeeds mean(double per_turn) const {
    MomentAtFeeds out;
    for (std::size_t i = 0; i < all_.count; ++i) {
      const Loaded& k = loaded_[i];
      take(out, k, k.to - k.from, k.edge_to - k.edge_from, per_turn);
    }
    return out;
  }
  /// With the tip of one tooth at an angle. Where a piece's lag begins as the last one's ends, the integral
  /// up to there is taken once.
  [[nodiscard]] MomentAtFeeds at(double tip, double pitch) const {
    std::array<Integrals, kCornerPieces + 1> chip, edge;
    double a = tip - pitch * std::floor((tip - first_ + kEntryRad) / pitch);
    for (; a <= last_; a += pitch) {
      Upto before;
      for (std::size_t i = 0; i < all_.count; ++i) {
        const Loaded& k = loaded_[i];
        const Piece& p = *k.p;
        if (k.straight) {
          const double at = a - k.middle;
          if (at < p.from - kEntryRad || at > p.to) continue;
          const double c = std::cos(at), s = std::sin(at);
          chip[i] += exact_ ? Integrals{s * c, s * s, s} : chips_.at(at);
          edge[i] += {c, s, 1.0};
          continue;
        }
        const double to = a - p.lag_low, from = a - p.lag_high;
        if (!(to > p.from && from < p.to)) continue;
        const bool begins = from <= p.from, ends = to >= p.to;
        if (!ends && before.angle != to) before = upto(to);
        chip[i] += ends ? k.to : before.chip;
        if (edges_) edge[i] += ends ? k.edge_to : before.edge;
        if (!begins) before = upto(from);
        chip[i] -= begins ? k.from : before.chip;
        if (edges_) edge[i] -= begins ? k.edge_from : before.edge;
      }
    }
    MomentAtFeeds out;
    for (std::size_t i = 0; i < all_.count; ++i) take(out, loaded_[i], chip[i], edge[i], loaded_[i].weight);
    return out;
  }

 private:
  struct Upto {
    double angle = std::numeric_limits<double>::quiet_NaN();
    Integrals chip, edge;
  };
  [[nodiscard]] Upto upto(double angle) const {
    return {angle, chips_.upto(angle), edges_ ? edges_->upto(angle) : Integrals{}};
  }
  static ArcTable chips_of(const Pieces& all, const ForceLaw& law) {
    double from = all.item[0].from;
    double to = all.item[0].to;
    for (std::size_t i = 1; i < all.count; ++i) {
      from = std::min(from, all.item[i].from);
      to = std::max(to, all.item[i].to);
    }
    return {from, to, law.mechanistic ? 0.0 : law.kienzle.mc};
  }
  static void force(Loaded& k, const ForceLaw& law, double helix_rad) {
    const Piece& p = *k.p;
    double kt = 1.0, kr = 0.0, ka = 0.0;
    if (law.mechanistic) {
      const CuttingCoefficients& c = *law.mechanistic;
      kt = c.ktc_n_mm2;
      kr = c.krc_n_mm2;
      ka = c.kac_n_mm2;
      k.et = c.kte_n_mm * p.edge;
      k.er = (c.kre_n_mm * p.sin_kappa + c.kae_n_mm * p.cos_kappa) * p.edge;
      k.ea = (c.kae_n_mm * p.sin_kappa - c.kre_n_mm * p.cos_kappa) * p.edge;
    } else {
      kt = p.sin_kappa == 1.0 ? 1.0 : std::pow(p.sin_kappa, -law.kienzle.mc);
      kr = kRadialToTangentialRatio * kt;
      ka = kAxialToTangentialRatio * std::tan(helix_rad) * kt;
    }
    k.ct = kt * p.depth;
    k.cr = (kr * p.sin_kappa + ka * p.cos_kappa) * p.depth;
    k.ca = (ka * p.sin_kappa - kr * p.cos_kappa) * p.depth;
  }
  void take(MomentAtFeeds& m, const Loaded& k, const Integrals& chip, const Integrals& edge,
            double weight) const {
    add(m.chip, k.ct, k.cr, k.ca, k.p->radius, chip, weight);
    if (edges_) add(m.edge, k.et, k.er, k.ea, k.p->radius, edge, weight);
  }

  const Pieces& all_;
  bool exact_;
  ArcTable chips_;
  std::optional<ArcTable> edges_;         ///< of a law with forces on the edge
  double first_ = 1e300, last_ = -1e300;  ///< angles between which a tooth is in the cut
  std::array<Loaded, kCornerPieces + 1> loaded_;
};

void keep_larger(double& largest, double value) {
  if (std::abs(value) > std::abs(largest)) largest = value;
}

}  // namespace

void Peak::take(const Moment& m) {
  keep_larger(force.fx_n, m.force.fx_n);
  keep_larger(force.fy_n, m.force.fy_n);
  keep_larger(force.fz_n, m.force.fz_n);
  plane_sq = std::max(plane_sq, m.force.fx_n * m.force.fx_n + m.force.fy_n * m.force.fy_n);
  torque_nmm = std::max(torque_nmm, m.torque_nmm);
}

Peak EdgeLoads::peak_at(double factor) const {
  Peak out;
  if (angles.empty()) {
    out.force = {factor * peak.force.fx_n, factor * peak.force.fy_n, factor * peak.force.fz_n};
    out.plane_sq = factor * factor * peak.plane_sq;
    out.torque_nmm = factor * peak.torque_nmm;
    return out;
  }
  for (const MomentAtFeeds& m : angles) out.take(m.at(factor));
  return out;
}

EdgeLoads edge_loads(const Pieces& all, const ForceLaw& law, const Tooth& tooth) {
  const Teeth teeth(all, law, tooth);
  EdgeLoads out;
  out.mean = teeth.mean(tooth.teeth / (2.0 * kPi));
  const double pitch = 2.0 * kPi / tooth.teeth;
  if (teeth.has_edge()) out.angles.reserve(kSamples + 3 * all.count);
  const auto at = [&](double tip) {
    const MomentAtFeeds m = teeth.at(tip, pitch);
    if (teeth.has_edge()) {
      out.angles.push_back(m);
    } else {
      out.peak.take(m.chip);
    }
  };
  // Without a lag a tooth is in at once, where climbing with its thickest chip: the first angle is that one.
  const Piece& first = all.item[0];
  const bool straight = first.lag_high - first.lag_low < kNoLagRad;
  const double start = first.from + (straight ? 0.5 * (first.lag_low + first.lag_high) : 0.0);
  for (int i = 0; i < kSamples; ++i) at(start + pitch * i / kSamples);
  // Extremes also sit where a piece of edge enters or leaves.
  for (std::size_t k = 0; k < all.count; ++k) {
    const Piece& p = all.item[k];
    at(p.to + p.lag_low - kJustInside);
    if (p.lag_high - p.lag_low < kNoLagRad) continue;
    at(p.from + p.lag_high);
    at(p.to + p.lag_high - kJustInside);
  }
  return out;
}

}  // namespace capstan::mechanics
