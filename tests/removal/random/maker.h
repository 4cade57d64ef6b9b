#pragma once

#include <algorithm>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "tests/removal/random_part.h"

namespace capstan::testing::removal {

constexpr double kOver = 2.0;    // mm that a hollow stands out of the block, where it is open
constexpr double kField = 24.0;  // mm, side of the field of one feature
constexpr double kDeg = 3.14159265358979323846 / 180.0;

/// Draws one part: a row of square fields, each with a feature or a few that belong together, perhaps a strip
/// beside them in which one runs from side to side. File and target come from the same numbers.
class Maker {
 public:
  explicit Maker(unsigned seed);
  RandomPart done(unsigned seed);

 private:
  // Drawn without the library's distributions, which differ between libraries.
  int whole(int lo, int hi) {
    return lo + static_cast<int>(random_() % static_cast<std::uint32_t>(hi - lo + 1));
  }
  double half(double lo, double hi) { return lo + 0.5 * whole(0, static_cast<int>(2.0 * (hi - lo))); }
  bool chance(double p) { return random_() % 1000U < static_cast<std::uint32_t>(1000.0 * p); }
  template <class T>
  T one_of(const std::vector<T>& all) {
    return all[static_cast<std::size_t>(whole(0, static_cast<int>(all.size()) - 1))];
  }
  void keep(const std::string& name, Point lo, Point hi) { spaces_.push_back({name, {lo, hi}}); }
  void keep_field(const std::string& name);
  Drawing::Id at(double dx = 0.0, double dy = 0.0, double z = 0.0) {
    return drawing_.placement({x_ + dx, y_ + dy, z});
  }
  /// Its x axis turned, degrees counter-clockwise.
  Drawing::Id turned_at(double dx, double dy, double turn_deg, double z = 0.0);
  /// (u, v) of a frame turned so about the field's middle, as the block sees it.
  Point seen(double u, double v, double turn_deg) const;

  void feature(int i);
  // areas.cpp
  void pocket(const std::string& name);
  void round_pocket(const std::string& name);
  void drawn_pocket(const std::string& name);
  void closed_slot(const std::string& name);
  void stacked(const std::string& name);
  void crossing(const std::string& name);
  void outside(const std::string& name);
  void beneath(const std::string& name);
  void top_face(bool with_boss);
  Drawing::Id rounded(double l, double w, double r, Depth2& inside);
  // holes.cpp
  void bored(double x, double y, double d, double below, double top, double tolerance);
  void hole(const std::string& name);
  void counterbored(const std::string& name);
  void counterbore_in_pocket(const std::string& name);
  void countersunk(const std::string& name);
  void thread(const std::string& name);
  // patterns.cpp
  void circle(const std::string& name);
  void rows(const std::string& name);
  void nested(const std::string& name);
  // strips.cpp
  void strip(double x0);
  void undercut(double x0);

  std::mt19937 random_;
  int fields_ = 1;
  double raw_ = 0.0, height_ = 0.0;
  Box block_;
  std::string name_;
  Drawing drawing_{"", {}};
  Target target_{[](const Point&) { return 0.0; }};
  Depth boss_;  ///< stands on the block's top; null: none
  std::vector<Space> spaces_;
  double x_ = 0.0, y_ = 0.0;
};

/// Width of a tolerance of this grade (ISO 286-1, table 1), mm, for more than 1 up to 18 mm.
double standard_tolerance(int grade, double size);

}  // namespace capstan::testing::removal
