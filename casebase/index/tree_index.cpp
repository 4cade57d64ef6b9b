#include <algorithm>
#include <limits>
#include <numeric>

#include "casebase/index/index.h"

// A KD-tree (Bentley, "Multidimensional binary search trees used for associative searching", CACM 18, 1975):
// the points are halved at the median of the widest side of their box until a few are left. A search walks
// the half that is nearer to the question first and leaves out a half whose box is farther than the limit.
//
// It is exact to the bit, without an allowance for rounding. A box is as far as its nearest point, and that
// is measured by the formula that measures the points. Each step of the formula (difference, weight, square,
// sums in one order) rounds monotonically, so no point of a box comes out nearer than its box.

namespace capstan::casebase {
namespace {

constexpr std::size_t kLeafPoints = 8;  // default, unsourced; no result depends on it

class TreeIndex final : public Index {
 public:
  explicit TreeIndex(Points points) : dimensions_(points.dimensions) {
    expect_finite(points);
    rows_.resize(points.size());
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    if (!rows_.empty()) grow(points, 0, rows_.size());
    // Leaves are read one after the other: the points in their order.
    points_.dimensions = dimensions_;
    points_.values.reserve(points.values.size());
    for (const std::size_t row : rows_)
      points_.values.insert(points_.values.end(), points.row(row), points.row(row) + dimensions_);
  }

  std::vector<Hit> nearest(const Place& q, std::size_t k) const override {
    return search(q, std::numeric_limits<double>::infinity(), std::min(k, rows_.size()));
  }
  std::vector<Hit> within(const Place& q, double limit2) const override {
    return search(q, limit2, rows_.size());
  }

 private:
  /// The rows `rows_[first, last)`. Its box is `box(node)`. A leaf has no halves; the first half follows its
  /// node.
  struct Node {
    std::size_t first, last;
    std::size_t second_half = 0;  // 0: a leaf
  };

  /// What a search has found: the `most` best hits, the worst of them on top of the heap.
  struct Search {
    const Place& q;
    double limit2;
    std::size_t most;
    std::vector<Hit> hits = {};

    void meet(Hit hit) {
      if (!(hit.distance2 <= limit2)) return;
      if (hits.size() == most) {
        if (!before(hit, hits.front())) return;
        std::pop_heap(hits.begin(), hits.end(), before);
        hits.pop_back();
      }
      hits.push_back(hit);
      std::push_heap(hits.begin(), hits.end(), before);
    }
    /// An equal distance may still be of a lower row.
    [[nodiscard]] bool may_hold(double box2) const {
      return box2 <= limit2 && (hits.size() < most || box2 <= hits.front().distance2);
    }
  };

  /// Lower corner, then upper corner, of a node's box.
  [[nodiscard]] const double* box(std::size_t node) const { return boxes_.data() + 2 * dimensions_ * node; }

  std::size_t grow(const Points& points, std::size_t first, std::size_t last) {
    const std::size_t at = nodes_.size();
    nodes_.push_back({first, last});
    boxes_.insert(boxes_.end(), points.row(rows_[first]), points.row(rows_[first]) + dimensions_);
    boxes_.insert(boxes_.end(), points.row(rows_[first]), points.row(rows_[first]) + dimensions_);
    double* least = boxes_.data() + 2 * dimensions_ * at;
    double* most = least + dimensions_;
    for (std::size_t i = first; i < last; ++i) {
      const double* p = points.row(rows_[i]);
      for (std::size_t a = 0; a < dimensions_; ++a) {
        least[a] = std::min(least[a], p[a]);
        most[a] = std::max(most[a], p[a]);
      }
    }
    if (last - first <= kLeafPoints) return at;
    std::size_t widest = 0;
    for (std::size_t a = 1; a < dimensions_; ++a) {
      if (most[a] - least[a] > most[widest] - least[widest]) widest = a;
    }
    const std::size_t middle = first + (last - first) / 2;
    const auto row = [&](std::size_t i) { return rows_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(row(first), row(middle), row(last), [&](std::size_t a, std::size_t b) {
      const double x = points.row(a)[widest], y = points.row(b)[widest];
      return x != y ? x < y : a < b;
    });
    grow(points, first, middle);
    const std::size_t second = grow(points, middle, last);
    nodes_[at].second_half = second;
    return at;
  }

  /// Distance of a node's box: the formula of `distance2` to its nearest point.
  [[nodiscard]] double box_distance2(const Place& q, std::size_t node) const {
    const double *least = box(node), *most = least + dimensions_;
    const auto term = [&](std::size_t i) {
      const double x = q.at[i];
      const double near = x < least[i] ? least[i] : x > most[i] ? most[i] : x;
      const double d = q.weight[i] * (x - near);
      return d * d;
    };
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    std::size_t i = 0;
    for (; i + 4 <= dimensions_; i += 4) {
      s0 += term(i);
      s1 += term(i + 1);
      s2 += term(i + 2);
      s3 += term(i + 3);
    }
    if (i < dimensions_) s0 += term(i);
    if (i + 1 < dimensions_) s1 += term(i + 1);
    if (i + 2 < dimensions_) s2 += term(i + 2);
    return (s0 + s1) + (s2 + s3);
  }

  void walk(Search& search, std::size_t at) const {
    const Node& node = nodes_[at];
    if (node.second_half == 0) {
      for (std::size_t i = node.first; i < node.last; ++i)
        search.meet(
            {rows_[i], distance2(search.q.at.data(), points_.row(i), search.q.weight.data(), dimensions_)});
      return;
    }
    std::size_t near = at + 1, far = node.second_half;
    double near2 = box_distance2(search.q, near), far2 = box_distance2(search.q, far);
    if (far2 < near2) {
      std::swap(near, far);
      std::swap(near2, far2);
    }
    if (search.may_hold(near2)) walk(search, near);
    if (search.may_hold(far2)) walk(search, far);
  }

  std::vector<Hit> search(const Place& q, double limit2, std::size_t most) const {
    expect_place(q, points_);
    if (most == 0) return {};
    Search search{q, limit2, most};
    walk(search, 0);
    std::sort(search.hits.begin(), search.hits.end(), before);
    return std::move(search.hits);
  }

  std::size_t dimensions_;
  Points points_;  // in the order of rows_
  std::vector<std::size_t> rows_;
  std::vector<Node> nodes_;
  std::vector<double> boxes_;
};

}  // namespace

std::unique_ptr<Index> make_tree_index(Points points) {
  return std::make_unique<TreeIndex>(std::move(points));
}

}  // namespace capstan::casebase
