#pragma once

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/sweep/grid/line_cells.h"
#include "planner/proof/verify/sweep/grid/outline.h"

// How a move passes over a point: how low the cutter comes there, and how thick a chip its front takes. One
// account for the cells of a set-up and for the points of a closer look, so that both say the same of a
// point.
//
// Chips: the front meets a point where a circle about the axis, as wide as the cutter is at the height of the
// material, first passes through it. On a line that circle is `ahead` before the point; on an arc, seen from
// the arc's centre, `early`: the triangle of centre, axis and point. The chip is the advance of a tooth times
// the cosine between the way and the surface's normal there. A ball on a sloping line meets a point as a
// sphere meets it: at a distance d of the point from the way of its centre that cosine is
// sqrt(1 - d^2 / R^2). Up hill the contact stands high on the ball, but the way runs along the surface;
// down hill it may lie behind the axis. Derived: sphere and line.

namespace capstan::verify {

/// A point nearer to the rim than this at the start of a move is met by the move, not by what was before.
inline constexpr double kMetMm = 1e-6;

/// What a move does over one point.
struct Over {
  double z = 0.0;      ///< lowest height of the cutter
  double bound = 0.0;  ///< `z` is no lower; `z` itself where that costs no more
  double near = 0.0;   ///< from the axis at its nearest
  double tip = 0.0;    ///< the tip's height there; of an arc, where the edge meets the material
  double along = 0.0;  ///< the point's foot: mm along a line; rad along an arc
  double away = 0.0;   ///< of an arc: from its centre
};

/// Which points a move can take a chip of more than `least_mm` from, whatever stands there: those that its
/// front meets at a cosine of more than least / advance.
struct Front {
  double cosine = 0.0;   ///< least_mm / advance, below 1
  double narrow_mm = 0;  ///< the cutter is no narrower where it takes that chip
};

/// What both ways have in common.
class Way {
 public:
  Way(const CutterOutline& o, double from_z, double to_z, bool level)
      : o_(o), r_(o.radius()), z0_(from_z), level_(level), rise_(level ? 0.0 : to_z - from_z) {}
  /// The tip is nowhere lower.
  [[nodiscard]] double zmin() const { return zmin_; }
  /// Whatever lies within `apart_mm` of a point that is so near to the way is left no higher.
  [[nodiscard]] double leaves(double near_mm, double apart_mm) const {
    const double far = near_mm + apart_mm + kSlack;
    return far > r_ ? 1e300 : zmin_ + std::abs(rise_) + o_.height(far) + searched_ + kSlack;
  }
  /// Of a chip of more than `least_mm`, when a tooth advances by more than that.
  [[nodiscard]] Front front(double least_mm, double advance_mm) const {
    // Of a level way the material stands higher than the tip by the chip at least; half of it is taken for
    // what rounding may lose.
    return {least_mm / advance_mm, level_ ? o_.radius_at(0.5 * least_mm) : 0.0};
  }

 protected:
  static constexpr double kSlack = 1e-6;  ///< mm, mm2, rad: more than rounding, for points that are left out

  /// The chip where the surface stands `above` the tip and no more than `deep` is taken. `meets(rho)`: cosine
  /// between the way and the direction from the axis to the point, both level, as a circle of that radius
  /// meets it; below 0: it does not, or the cutter stood over it before the move.
  template <class Meets>
  [[nodiscard]] double thickness(double above, double deep, double advance, const Meets& meets) const {
    const double rho = o_.radius_at(above);
    if (rho <= 0.0) return 0.0;
    const double cosine = meets(rho);
    if (cosine < 0.0) return 0.0;
    // How upright the surface is there.
    constexpr double kStep = 1e-4;
    const double lean = above > kStep ? (rho - o_.radius_at(above - kStep)) / kStep : 0.0;
    return std::min(advance / std::sqrt(1.0 + lean * lean) * cosine, deep);
  }

  const CutterOutline& o_;
  double r_, z0_;
  bool level_;
  double rise_;
  double zmin_ = 0.0;
  double searched_ = 0.0;  ///< by which a search may miss the lowest height
};

class LineWay : public Way {
 public:
  LineWay(const CutterOutline& o, const Move& m)
      : Way(o, m.from.z, m.to.z, std::abs(m.to.z - m.from.z) < 1e-9 || norm(xy(m.to) - xy(m.from)) < 1e-9),
        a_(xy(m.from)),
        d_(xy(m.to) - xy(m.from)),
        length_(norm(d_)),
        dz_(m.to.z - m.from.z),
        way_(std::hypot(length_, dz_)),
        fall_(std::abs(dz_) / length_),
        cells_(o, a_, d_, m.from.z, m.to.z) {
    zmin_ = std::min(m.from.z, m.to.z);
    // Of a torus, by less than a thousandth of the radius along the way (`least_between`).
    if (!level_) searched_ = 1e-3 * r_ * std::abs(dz_) / length_;
  }

  /// The rows that it touches.
  [[nodiscard]] std::pair<double, double> reach_y() const {
    return {std::min(a_.y, a_.y + d_.y) - r_, std::max(a_.y, a_.y + d_.y) + r_};
  }
  /// What it touches of the row at y.
  [[nodiscard]] std::pair<double, double> reach_x(double y) const {
    const double apart = y - std::clamp(y, std::min(a_.y, a_.y + d_.y), std::max(a_.y, a_.y + d_.y));
    const double half = std::sqrt(std::max(0.0, r_ * r_ - apart * apart)) + kSlack;
    const auto [from, to] = beside(y, r_, 0.0);
    return {from + (r_ - half), to - (r_ - half)};
  }
  [[nodiscard]] bool has_front() const { return length_ > 1e-9; }
  /// The same of the points whose chips count.
  [[nodiscard]] std::pair<double, double> front_y(const Front& f) const {
    const double half = std::sqrt(half_squared(f));
    const double end = a_.y + d_.y + d_.y / length_ * r_;
    return {std::min(a_.y, end) - half, std::max(a_.y, end) + half};
  }
  [[nodiscard]] std::pair<double, double> front_x(const Front& f, double y) const {
    return beside(y, std::sqrt(half_squared(f)), r_);
  }
  [[nodiscard]] bool in_front(const Front& f, geometry::Vec2 p) const {
    const double along = dot(p - a_, d_) / length_;
    const double off2 = dot(p - a_, p - a_) - along * along;
    if (off2 > half_squared(f)) return false;
    const double begins = std::sqrt(std::max(0.0, f.narrow_mm * f.narrow_mm - off2));
    return along >= begins - kMetMm - kSlack && along <= length_ + r_ + kSlack;
  }

  /// How far a point is from the line.
  [[nodiscard]] double distance(geometry::Vec2 p) const {
    const double square = length_ * length_;
    const double t = square < 1e-18 ? 0.0 : std::clamp(dot(p - a_, d_) / square, 0.0, 1.0);
    return norm(p - (a_ + t * d_));
  }

  /// Calls f(ix) for the cells from..to - 1 of a row that it may lower; `first`: centre of cell 0.
  template <class F>
  void candidates(const double* stock, int from, int to, geometry::Vec2 first, double cell,
                  const F& f) const {
    cells_.each(stock, from, to, first, cell, f);
  }

  /// Whether the cutter may come below `stands` over p.
  [[nodiscard]] bool meets(geometry::Vec2 p, double stands, Over& at) const {
    const double foot = length_ < 1e-9 ? 0.0 : dot(p - a_, d_) / (length_ * length_);
    const double t = std::clamp(foot, 0.0, 1.0);
    const geometry::Vec2 apart = p - (a_ + t * d_);
    const double square = dot(apart, apart);
    if (square > r_ * r_ || stands <= zmin_ + o_.at_least(square)) return false;
    at.near = std::sqrt(square);
    // No lower than the cutter would be at its nearest, at the lower end.
    at.bound = zmin_ + o_.height(at.near);
    if (stands <= at.bound) return false;
    at.along = foot * length_;
    if (level_) {
      at.z = at.bound;
      at.tip = zmin_;
      return true;
    }
    const geometry::Vec2 aside = p - (a_ + foot * d_);
    const double off2 = dot(aside, aside);
    if (const geometry::ProfilePiece* ball = o_.ball()) {
      // On a line without ends it would come lower, to that; where it takes nothing it has no chip either.
      const double half = std::sqrt(std::max(0.0, ball->radius_mm * ball->radius_mm - off2));
      if (stands <= z0_ + foot * dz_ + ball->zc_mm - way_ / length_ * half - kSlack) return false;
      at.z = std::max(at.bound, lowest_of_ball(ball->radius_mm, at.along, std::sqrt(off2)));
    } else {
      at.z = std::max(at.bound, lowest_on_line(o_, z0_, dz_, at.along, std::sqrt(off2), length_));
    }
    at.tip = z0_ + t * dz_;
    return true;
  }
  /// The tip's height is known by `meets`.
  void find_tip(geometry::Vec2, double, Over&) const {}
  /// The chip off a point that the move meets, of material `deep` above what stays.
  [[nodiscard]] double chip(geometry::Vec2 p, double stands, double deep, double advance,
                            const Over& at) const {
    if (!has_front() || advance <= 0.0 || deep <= 0.0) return 0.0;
    if (!level_ && o_.ball() != nullptr) return std::min(ball_chip(p, stands, advance, at), deep);
    const double off2 = std::max(0.0, dot(p - a_, p - a_) - at.along * at.along);
    // Where the rim of the full radius meets the centre: the tip's height there.
    const double met = at.along - std::sqrt(std::max(0.0, r_ * r_ - off2));
    const double tip = z0_ + std::clamp(met / length_, 0.0, 1.0) * dz_;
    return thickness(stands - tip, deep, advance, [&](double rho) {
      if (off2 >= rho * rho) return -1.0;
      const double ahead = std::sqrt(rho * rho - off2);
      const double begins = at.along - ahead;
      return begins < -kMetMm || begins > length_ ? -1.0 : ahead / rho;
    });
  }

 private:
  /// Of a ball on a sloping line: the thickest chip off the column at p between the material's height and
  /// what stays. Material over the ball's middle is met by the shank, whose normal is level.
  [[nodiscard]] double ball_chip(geometry::Vec2 p, double stands, double advance, const Over& at) const {
    if (stands <= at.z) return 0.0;
    const double way = way_, down = dz_ / way, square = r_ * r_;
    const geometry::Vec2 side = p - a_;
    const double ahead = dot(side, d_) / way;
    const double top = stands - z0_ - r_;  // over the centre, at the start
    // Cosine where the ball meets the column's point at that height; 0: it never does.
    const auto squarely = [&](double z) {
      const double foot = ahead + z * down;
      return std::sqrt(std::max(0.0, 1.0 - (dot(side, side) + z * z - foot * foot) / square));
    };
    // Further down the column the ball may meet it more squarely.
    const double squarest = ahead * down / std::max(1.0 - down * down, kSlack);
    const double at_top = squarely(top);
    const double below =
        advance * (squarest >= top ? at_top : squarely(std::max(squarest, top - (stands - at.z))));
    const double met = ahead + top * down - r_ * at_top;
    if (at_top > 0.0 && top <= met * down)
      return met < -kMetMm || met > way ? 0.0 : below;  // before: the ball stood over it
    const double off2 = dot(side, side) - at.along * at.along;
    if (off2 >= square) return 0.0;
    const double reach = std::sqrt(square - off2), begins = at.along - reach;
    if (begins < -kMetMm || begins > length_) return 0.0;
    const double by_shank = advance * reach / r_ * length_ / way;
    return down < 0.0 ? std::max(by_shank, below) : by_shank;
  }
  /// `lowest_on_line` of an end that is one sphere: `d` beside a sloping line, with the foot `along` it.
  [[nodiscard]] double lowest_of_ball(double radius, double along, double d) const {
    const double square = d * d;
    const double reach = std::sqrt(std::max(0.0, r_ * r_ - square));
    const double from = std::clamp(along - reach, 0.0, length_), to = std::clamp(along + reach, 0.0, length_);
    const double begin = dz_ < 0.0 ? from - along : along - to, end = dz_ < 0.0 ? to - along : along - from;
    double past = end;
    if (end > 0.0) {
      const double first = std::max(begin, 0.0);
      past = std::clamp(fall_ * std::sqrt(std::max(0.0, radius * radius - square) / (1.0 + fall_ * fall_)),
                        first, std::max(first, end));
    }
    return z0_ + along / length_ * dz_ - fall_ * past + o_.height(std::sqrt(square + past * past));
  }
  /// How far to either side of the line such chips are cut, squared.
  [[nodiscard]] double half_squared(const Front& f) const {
    return r_ * r_ * (1.0 - f.cosine * f.cosine) + kSlack;
  }
  /// What of a row lies within `half` of the line, which goes on by `further`.
  [[nodiscard]] std::pair<double, double> beside(double y, double half, double further) const {
    const double more = further > 0.0 ? 1.0 + further / length_ : 1.0;
    double t0 = 0.0, t1 = more;
    if (std::abs(d_.y) > 1e-12) {
      t0 = (y - half - a_.y) / d_.y;
      t1 = (y + half - a_.y) / d_.y;
      if (t0 > t1) std::swap(t0, t1);
      t0 = std::clamp(t0, 0.0, more);
      t1 = std::clamp(t1, 0.0, more);
    }
    const double xa = a_.x + t0 * d_.x, xb = a_.x + t1 * d_.x;
    return {std::min(xa, xb) - half, std::max(xa, xb) + half};
  }

  geometry::Vec2 a_, d_;
  double length_, dz_;
  double way_;   ///< length in space
  double fall_;  ///< per mm of the length in XY
  LineCells cells_;
};

/// An arc whose ends are not as far from its centre runs at the mean of both.
class ArcWay : public Way {
 public:
  ArcWay(const CutterOutline& o, const Move& m)
      : Way(o, m.from.z, m.to.z, std::abs(m.from.z - m.to.z) < 1e-9),
        from_(xy(m.from)),
        to_(xy(m.to)),
        centre_(m.centre),
        sweep_(sweep_of(m)),
        start_(std::atan2(m.from.y - m.centre.y, m.from.x - m.centre.x)),
        sign_(m.kind == model::MoveKind::kArcCcw ? 1.0 : -1.0),
        box_(box_of(m)) {
    const double begins = norm(from_ - centre_), ends = norm(to_ - centre_);
    ra_ = 0.5 * (begins + ends);
    gap_ = std::abs(begins - ends);
    inner_ = std::max(0.0, ra_ - r_);
    outer_ = ra_ + r_;
    zmin_ = level_ ? m.to.z : std::min(m.from.z, m.to.z);
  }

  [[nodiscard]] std::pair<double, double> reach_y() const {
    return {box_.lo.y - gap_ - r_, box_.hi.y + gap_ + r_};
  }
  [[nodiscard]] std::pair<double, double> reach_x(double y) const {
    const double half = across(y);
    return {std::max(box_.lo.x - gap_ - r_, centre_.x - half),
            std::min(box_.hi.x + gap_ + r_, centre_.x + half)};
  }
  [[nodiscard]] bool has_front() const { return ra_ >= 1e-9; }
  [[nodiscard]] std::pair<double, double> front_y(const Front&) const { return reach_y(); }
  [[nodiscard]] std::pair<double, double> front_x(const Front&, double y) const { return reach_x(y); }
  [[nodiscard]] bool in_front(const Front& f, geometry::Vec2 p) const {
    // The cosine of a circle rho wide is sqrt(1 - c^2), c = (away^2 - ra^2 - rho^2) / (2 ra rho).
    const geometry::Vec2 q = p - centre_;
    const double square = dot(q, q), wide = std::sqrt(1.0 - f.cosine * f.cosine);
    const double inmost = std::clamp(ra_ * wide, f.narrow_mm, r_);
    if (square < ra_ * ra_ + inmost * (inmost - 2.0 * ra_ * wide) - kSlack ||
        square > ra_ * ra_ + r_ * (r_ + 2.0 * ra_ * wide) + kSlack) {
      return false;
    }
    const double twice = 2.0 * std::sqrt(square) * ra_, sum = square + ra_ * ra_;
    if (twice < 1e-9) return true;
    const auto turn = [&](double rho) { return std::acos(std::clamp((sum - rho * rho) / twice, -1.0, 1.0)); };
    const double ahead = ahead_of(q);
    return ahead >= turn(f.narrow_mm) - (kMetMm + kSlack) / ra_ - kSlack &&
           ahead <= sweep_ + turn(r_) + kSlack;
  }

  /// How far a point is from the arc, and as much more as its ends lie off it.
  [[nodiscard]] double distance(geometry::Vec2 p) const {
    const geometry::Vec2 q = p - centre_;
    const double ends = to_end(p), beside = std::abs(norm(q) - ra_);
    return gap_ + (ahead_of(q) <= sweep_ ? beside : std::max(beside, ends));
  }

  template <class F>
  void candidates(const double*, int from, int to, geometry::Vec2, double, const F& f) const {
    for (int ix = from; ix < to; ++ix) f(ix);
  }

  [[nodiscard]] bool meets(geometry::Vec2 p, double stands, Over& at) const {
    const geometry::Vec2 q = p - centre_;
    const double square = dot(q, q);
    if (square < inner_ * inner_ || square > outer_ * outer_) return false;
    at.away = std::sqrt(square);
    const double radial = std::abs(at.away - ra_);
    if (radial > r_ || stands <= zmin_ + o_.at_least(radial * radial)) return false;
    at.along = ahead_of(q);
    at.near = at.along <= sweep_ ? radial : to_end(p);
    if (at.near > r_) return false;
    at.z = level_ ? zmin_ + o_.height(at.near)
                  : std::max(zmin_, lowest_on_helix(o_, z0_, rise_, ra_, sweep_, at.away, at.along));
    at.bound = at.z;
    at.tip = zmin_;
    return stands > at.z;
  }
  void find_tip(geometry::Vec2 p, double stands, Over& at) const {
    if (level_) return;
    at.tip = z0_ + rise_ * std::min(at.along, sweep_) / sweep_;
    const double apart = norm(p - from_);
    // How far along the way the edge is when a circle about the axis meets the point, rad.
    const auto met_at = [&](double before) {
      const double met = at.along - before;
      // The circle is over the point where the way begins, and comes round to it once more or leaves it.
      if (met < 0.0) return met + kRadPerTurn <= sweep_ ? met + kRadPerTurn : 0.0;
      return met <= sweep_ ? met : apart <= r_ ? 0.0 : sweep_;
    };
    if (apart <= r_ && stands > z0_ + o_.height(apart)) {
      at.tip = z0_;  // it is cut where the way begins
      return;
    }
    // The tip's height where the edge that stands as high as the material first meets the point.
    for (double rho = r_; const int again : {0, 1}) {
      const double before = early(at.away, rho);
      if (before >= 0.0) at.tip = z0_ + rise_ * met_at(before) / sweep_;
      if (again == 0) rho = o_.radius_at(stands - at.tip);
    }
  }
  [[nodiscard]] double chip(geometry::Vec2, double stands, double deep, double advance,
                            const Over& at) const {
    if (advance <= 0.0 || deep <= 0.0) return 0.0;
    return thickness(stands - at.tip, deep, advance, [&](double rho) {
      const double before = early(at.away, rho);
      if (before < 0.0) return -1.0;
      const double met = at.along - before;
      if (met < -kMetMm / ra_ || met > sweep_) return -1.0;
      // Way and direction to the point at that time: away sin(before) / rho.
      return std::min(1.0, at.away * std::sin(before) / rho);
    });
  }

 private:
  /// The angle from the way's start to a direction, in the way's direction, rad, in [0, 2 pi).
  [[nodiscard]] double ahead_of(geometry::Vec2 q) const {
    const double ahead = std::fmod(sign_ * (std::atan2(q.y, q.x) - start_), kRadPerTurn);
    return ahead < 0.0 ? ahead + kRadPerTurn : ahead;
  }
  /// How far the nearer end is.
  [[nodiscard]] double to_end(geometry::Vec2 p) const {
    constexpr double kSurely = 1.0 - 1e-9;  // of a square: more than its rounding
    const geometry::Vec2 a = p - from_, b = p - to_;
    const double a2 = dot(a, a), b2 = dot(b, b);
    if (a2 < kSurely * b2) return norm(a);
    if (b2 < kSurely * a2) return norm(b);
    return std::min(norm(a), norm(b));
  }
  /// Half of what the widest circle has in a row.
  [[nodiscard]] double across(double y) const {
    const double dy = y - centre_.y, wide = outer_ + kSlack;
    return std::sqrt(std::max(0.0, wide * wide - dy * dy));
  }
  /// How early before the point the axis is when a circle of that radius meets it, rad; below 0: never.
  [[nodiscard]] double early(double away, double rho) const {
    if (away < 1e-9 || ra_ < 1e-9) return -1.0;
    const double c = (away * away + ra_ * ra_ - rho * rho) / (2.0 * away * ra_);
    return c >= 1.0 || c <= -1.0 ? -1.0 : std::acos(c);
  }

  geometry::Vec2 from_, to_, centre_;
  double sweep_, start_, sign_;
  geometry::Box3 box_;
  double ra_ = 0.0, gap_ = 0.0, inner_ = 0.0, outer_ = 0.0;
};

/// What `f` says of the way of a move that is neither a rapid nor a dwell.
template <class F>
decltype(auto) along_way(const CutterOutline& o, const Move& m, const F& f) {
  return is_arc(m.kind) ? f(ArcWay(o, m)) : f(LineWay(o, m));
}

}  // namespace capstan::verify
