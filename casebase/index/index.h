#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "casebase/normalisation.h"

namespace capstan::casebase {

struct Hit {
  std::size_t row = 0;
  double distance2 = 0.0;
  friend bool operator==(const Hit&, const Hit&) = default;
};

/// Finds near points exactly. Every implementation gives the same rows and the same bits: nearest first,
/// equal distances by row. May hold no point. The const members may be called from many threads.
/// Throws std::logic_error on a point that is not finite: what is stored and asked was checked before.
class Index {
 public:
  Index() = default;
  Index(const Index&) = delete;
  Index& operator=(const Index&) = delete;
  virtual ~Index() = default;
  /// The k nearest, or all when there are fewer.
  [[nodiscard]] virtual std::vector<Hit> nearest(const Point& q, std::size_t k) const = 0;
  /// All with distance2 <= limit2.
  [[nodiscard]] virtual std::vector<Hit> within(const Point& q, double limit2) const = 0;
};

/// Looks at every point: the referee.
[[nodiscard]] std::unique_ptr<Index> make_linear_index(std::vector<Point> points);
/// The built-in KD-tree.
[[nodiscard]] std::unique_ptr<Index> make_tree_index(std::vector<Point> points);
/// FLANN's exact single tree; the built-in one in a build without FLANN.
[[nodiscard]] std::unique_ptr<Index> make_index(std::vector<Point> points);

/// Throws std::logic_error unless finite.
void expect_finite(const Point& p);
/// The order that all promise: nearest first, equal distances by row.
[[nodiscard]] bool before(const Hit& a, const Hit& b);
/// Puts hits in that order and keeps the first k.
void put_in_order(std::vector<Hit>& hits, std::size_t k);

}  // namespace capstan::casebase
