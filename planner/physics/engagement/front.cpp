#include "planner/physics/engagement/front.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>

// The thickest chip is the largest share over all cells that stand over the round. Any order of looking finds
// the same one; what counts is how few cells are looked at. The largest share m so far bounds where a larger
// one may lie. With k the angle from the axis, A the feed's component towards the cell, h and f the feed's
// level and falling parts (h^2 + f^2 = 1):
//
//     share = sin k A + cos k f <= sqrt(A^2 + f^2)     so A > sqrt(m^2 - f^2)
//     share <= sin k A + f                             so sin k A > m - f
//     share <= sin k h + cos k f = sin(k + asin f)     so sin k > m h - f sqrt(1 - m^2)
//
// The cell lies rc + R sin k from the axis: the first two say how far it must lie ahead, which leaves a
// segment of the disc, and the third how far out, which leaves a ring. Rows outside the segment are not
// begun, and eight cells that do not stand over the cutter's plane are passed at once. Source  derived.

namespace capstan::engagement {
namespace {

constexpr double kSlack = 1e-3;        // mm: heights are single precision
constexpr double kInside = 1e-9;       // mm: more than rounding of a place
constexpr double kSure = 1.0 - 1e-12;  // of a bound: far more than its rounding
constexpr double kForemost = 0.8;      // of the radius ahead: the row that is looked at first

/// The cells along one side whose middles lie in [from, to].
struct Cells {
  int first = 0, last = -1;
};
Cells cells_in(double from, double to, double origin, double cell, int n) {
  const double lowest = std::clamp((from - origin) / cell - 0.5, 0.0, static_cast<double>(n));
  const double highest = std::clamp((to - origin) / cell - 0.5, -1.0, n - 1.0);
  const int first = static_cast<int>(lowest);
  return {first + (static_cast<double>(first) < lowest ? 1 : 0), static_cast<int>(highest + 1.0) - 1};
}

using Four = float __attribute__((vector_size(16)));
using FourInts = int __attribute__((vector_size(16)));
constexpr int kAtOnce = 8;

/// Whether one of kAtOnce heights is more than `floor`.
bool any_stands(const float* top, Four floor) {
  Four low, high;
  std::memcpy(&low, top, sizeof low);
  std::memcpy(&high, top + 4, sizeof high);
  const FourInts over = (low > floor) | (high > floor);
  std::uint64_t halves[2];
  std::memcpy(halves, &over, sizeof halves);
  return (halves[0] | halves[1]) != 0;
}

/// The largest share so far, and where a cell must lie to have more (see the top of this file).
class Most {
 public:
  Most(const RoundNose& nose, geometry::Vec3 feed, double known)
      : nose_(nose), falling_(-feed.z), level_(std::sqrt(feed.x * feed.x + feed.y * feed.y)) {
    take(known);
  }
  void take(double share) {
    if (!(share > most_)) return;
    most_ = share;
    const double fall = std::max(0.0, falling_);  // a feed that rises takes from the share
    if (!(most_ > fall)) return;
    square_ = kSure * (most_ * most_ - fall * fall);
    ahead_mm_ = kSure * (nose_.centre_mm * std::sqrt(square_) + nose_.round_mm * (most_ - fall));
  }
  [[nodiscard]] double most() const { return most_; }
  /// A cell with a smaller x f_x + y f_y has no more.
  [[nodiscard]] double ahead_mm() const { return ahead_mm_; }
  /// A cell with a smaller square of A, or that lies behind the axis, has no more.
  [[nodiscard]] bool has_no_more(double ahead_mm, double square) const {
    return ahead_mm * std::abs(ahead_mm) < square_ * square;
  }
  /// A cell nearer to the axis has no more; 0: none is.
  [[nodiscard]] double hollow_mm() const {
    if (most_ < falling_) return 0.0;
    const double sine = most_ * level_ - falling_ * std::sqrt(std::max(0.0, 1.0 - most_ * most_));
    return std::max(0.0, kSure * (nose_.centre_mm + nose_.round_mm * std::max(0.0, sine)) - kInside);
  }
  /// The y over which a disc of radius r about the axis lies so far ahead; lo > hi: none.
  struct Reach {
    double lo = 1.0, hi = -1.0;
  };
  [[nodiscard]] Reach rows(geometry::Vec3 feed, double r, double ahead_mm) const {
    if (level_ < kInside || ahead_mm <= -r * level_) return {-r, r};
    const double far = ahead_mm / level_;
    if (far > r + kInside) return {};
    const double half = std::sqrt(std::max(0.0, (r - far) * (r + far))) + kInside;
    const double middle = far * feed.y / level_, beside = half * std::abs(feed.x) / level_ + kInside;
    return {-r * feed.y >= ahead_mm ? -r : middle - beside, r * feed.y >= ahead_mm ? r : middle + beside};
  }

 private:
  RoundNose nose_;
  double falling_, level_;
  double most_ = 0.0, ahead_mm_ = -1e300, square_ = -1e300;
};

}  // namespace

std::optional<RoundNose> round_nose(const geometry::CutterProfile& profile) {
  if (profile.pieces.empty() || profile.pieces.size() > 2) return std::nullopt;
  const geometry::ProfilePiece& round = profile.pieces.back();
  if (!(round.radius_mm > 0.0) || !geometry::ends_upright(round)) return std::nullopt;
  const bool floor = profile.pieces.size() == 2;
  if (floor && (profile.pieces.front().radius_mm > 0.0 || profile.pieces.front().slope != 0.0))
    return std::nullopt;
  return RoundNose{profile.radius_mm, round.radius_mm, floor ? round.rc_mm : 0.0};
}

double chip_over_feed(const stock::HeightMap& map, const RoundNose& nose, geometry::Vec3 tip,
                      geometry::Vec3 feed, double ceiling_mm, double known) {
  const double round = nose.round_mm;
  const bool ball = nose.centre_mm == 0.0;
  // What is no higher than the ceiling lies within the outline's radius there.
  const double up = std::clamp(ceiling_mm - tip.z, 0.0, round);
  const double r = nose.centre_mm + std::sqrt(up * (2.0 * round - up));
  // A cell counts where sin k A > f_z cos k: ahead of the axis, down hill also behind it; of a ball no
  // farther than R f_z, while the plane of a bull nose comes down on all that stands below it.
  const double behind =
      ball ? std::min(0.0, nose.cutter_mm * feed.z) : (feed.z < 0.0 ? -nose.cutter_mm : 0.0);
  // Heights above the map's floor, less the tip's: what stands over the cutter's plane there.
  const double floor = tip.z - map.origin.z + kSlack;
  const Four under = Four{} + std::nextafter(static_cast<float>(floor), -1e30F);
  Most most(nose, feed, known);
  const auto cell = [&](double stands, double x, double y, double ahead) {
    const double square = x * x + y * y;
    // The round lies no lower than its parabola.
    if (ball && 2.0 * round * stands <= square) return;
    const double away = std::sqrt(square);
    const double out = std::min(away - nose.centre_mm, round);
    if (out <= 0.0) return most.take(-feed.z);
    const double cosine = std::sqrt(std::max(0.0, 1.0 - out * out / (round * round)));
    if (stands <= round * (1.0 - cosine)) return;
    most.take((away > 0.0 ? ahead / away : 0.0) * out / round - feed.z * cosine);
  };
  const auto row = [&](int iy) {
    const double y = map.y_of(iy) - tip.y;
    const double half = std::sqrt(std::max(0.0, r * r - y * y));
    double from = -half, to = half;
    const double counts = std::max(behind, most.ahead_mm()) - y * feed.y;  // x feed.x is more
    if (feed.x > 0.0) {
      from = std::max(from, counts / feed.x);
    } else if (feed.x < 0.0) {
      to = std::min(to, counts / feed.x);
    } else if (counts >= 0.0) {
      return;
    }
    if (from > to) return;
    const Cells columns = cells_in(tip.x + from, tip.x + to, map.origin.x, map.cell_mm, map.nx);
    const float* top = map.top.data() + map.index(0, iy);
    // From the front, so that the first that counts leaves few others.
    const auto scan = [&](int first, int last) {
      const bool back = feed.x > 0.0;
      while (first <= last) {
        const int n = std::min(kAtOnce, last - first + 1);
        // What follows the last cell of a map is its padding.
        const int begin = back ? last - n + 1 : first;
        if (any_stands(top + begin, under)) {
          for (int k = 0; k < n; ++k) {
            const int ix = back ? last - k : first + k;
            const double stands = static_cast<double>(top[ix]) - floor;
            if (stands <= 0.0) continue;
            const double x = map.x_of(ix) - tip.x;
            const double ahead = x * feed.x + y * feed.y;
            if (ahead < most.ahead_mm()) return;
            if (!most.has_no_more(ahead, x * x + y * y)) cell(stands, x, y, ahead);
          }
        }
        (back ? last : first) += back ? -n : n;
      }
    };
    const double hollow = most.hollow_mm();
    const double plane = hollow * hollow - y * y;
    if (!(plane > 0.0)) return scan(columns.first, columns.last);
    const double beside = std::sqrt(plane);
    const Cells level = cells_in(tip.x - beside, tip.x + beside, map.origin.x, map.cell_mm, map.nx);
    if (level.first > level.last) return scan(columns.first, columns.last);
    const int before = std::min(columns.last, level.first - 1),
              after = std::max(columns.first, level.last + 1);
    if (feed.x > 0.0) {
      scan(after, columns.last);
      scan(columns.first, before);
    } else {
      scan(columns.first, before);
      scan(after, columns.last);
    }
  };
  const auto rows = [&] {
    const Most::Reach reach = most.rows(feed, r, std::max(behind, most.ahead_mm()));
    return cells_in(tip.y + reach.lo, tip.y + reach.hi, map.origin.y, map.cell_mm, map.ny);
  };
  Cells open = rows();
  if (open.first > open.last) return most.most();
  const double front = (tip.y + kForemost * r * feed.y - map.origin.y) / map.cell_mm;
  const int foremost =
      static_cast<int>(std::clamp(front, static_cast<double>(open.first), static_cast<double>(open.last)));
  double before = most.most();
  const auto looked_at = [&](int iy) {
    row(iy);
    if (most.most() == before) return;
    before = most.most();
    open = rows();
  };
  for (int iy = foremost; iy <= open.last; ++iy) looked_at(iy);
  for (int iy = foremost - 1; iy >= open.first; --iy) looked_at(iy);
  return most.most();
}

}  // namespace capstan::engagement
