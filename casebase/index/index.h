#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

namespace capstan::casebase {

/// Points of one number of dimensions, row by row.
struct Points {
  std::size_t dimensions = 0;
  std::vector<double> values;
  [[nodiscard]] std::size_t size() const { return dimensions == 0 ? 0 : values.size() / dimensions; }
  [[nodiscard]] const double* row(std::size_t i) const { return values.data() + i * dimensions; }
};

/// A point to search from, and how much each dimension counts: 0 not at all. As long as the points' rows.
struct Place {
  std::span<const double> at, weight;
};

struct Hit {
  std::size_t row = 0;
  double distance2 = 0.0;
  friend bool operator==(const Hit&, const Hit&) = default;
};

/// Finds near points exactly. Every implementation gives the same rows and the same bits: nearest first,
/// equal distances by row. May hold no point. The const members may be called from many threads.
/// Throws std::logic_error on a point that is not finite, a weight below zero, or a place of other
/// dimensions: what is stored and asked was checked before.
class Index {
 public:
  Index() = default;
  Index(const Index&) = delete;
  Index& operator=(const Index&) = delete;
  virtual ~Index() = default;
  /// The k nearest, or all when there are fewer.
  [[nodiscard]] virtual std::vector<Hit> nearest(const Place& q, std::size_t k) const = 0;
  /// All with distance2 <= limit2.
  [[nodiscard]] virtual std::vector<Hit> within(const Place& q, double limit2) const = 0;
};

/// Looks at every point: the referee.
[[nodiscard]] std::unique_ptr<Index> make_linear_index(Points points);
/// The built-in KD-tree.
[[nodiscard]] std::unique_ptr<Index> make_tree_index(Points points);
/// FLANN's exact single tree; the built-in one in a build without FLANN.
[[nodiscard]] std::unique_ptr<Index> make_index(Points points);
[[nodiscard]] bool built_with_flann();

/// The one formula of all indices: the sum of (w (a - b))^2, in four sums of every fourth dimension. Each of
/// its steps rounds monotonically.
[[nodiscard]] inline double distance2(const double* a, const double* b, const double* w, std::size_t n) {
  double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
  const auto term = [&](std::size_t i) {
    const double d = w[i] * (a[i] - b[i]);
    return d * d;
  };
  std::size_t i = 0;
  for (; i + 4 <= n; i += 4) {
    s0 += term(i);
    s1 += term(i + 1);
    s2 += term(i + 2);
    s3 += term(i + 3);
  }
  if (i < n) s0 += term(i);
  if (i + 1 < n) s1 += term(i + 1);
  if (i + 2 < n) s2 += term(i + 2);
  return (s0 + s1) + (s2 + s3);
}

/// Throws std::logic_error unless finite, and unless the place fits the points.
void expect_finite(const Points& points);
void expect_place(const Place& q, const Points& points);
/// The order that all promise: nearest first, equal distances by row.
[[nodiscard]] bool before(const Hit& a, const Hit& b);
/// Puts hits in that order and keeps the first k.
void put_in_order(std::vector<Hit>& hits, std::size_t k);

}  // namespace capstan::casebase
