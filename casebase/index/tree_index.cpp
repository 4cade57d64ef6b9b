#include <algorithm>
#include <limits>
#include <numeric>

#include "casebase/index/index.h"

// A KD-tree (Bentley, "Multidimensional binary search trees used for associative searching", CACM 18, 1975):
// the points are halved at the median of the widest side of their box until a few are left. A search walks
// the half that is nearer to the question first and leaves out a half whose box is farther than the limit.
//
// It is exact to the bit, without an allowance for rounding. A box is as far as its nearest point, and that
// is measured by the formula that measures the points. Each step of the formula (difference, square, sum of
// squares in one order) rounds monotonically, so no point of a box comes out nearer than its box.

namespace capstan::casebase {
namespace {

constexpr std::size_t kLeafPoints = 8;  // default, unsourced; no result depends on it

class TreeIndex final : public Index {
 public:
  explicit TreeIndex(std::vector<Point> points) : points_(std::move(points)), rows_(points_.size()) {
    for (const Point& p : points_) expect_finite(p);
    std::iota(rows_.begin(), rows_.end(), std::size_t{0});
    if (!points_.empty()) grow(0, points_.size());
  }

  std::vector<Hit> nearest(const Point& q, std::size_t k) const override {
    return search(q, std::numeric_limits<double>::infinity(), std::min(k, points_.size()));
  }
  std::vector<Hit> within(const Point& q, double limit2) const override {
    return search(q, limit2, points_.size());
  }

 private:
  /// The rows `rows_[first, last)` and their box. A leaf has no halves; the first half follows its node.
  struct Node {
    Point least, most;
    std::size_t first, last;
    std::size_t second_half = 0;  // 0: a leaf
  };

  /// What a search has found: the `most` best hits, the worst of them on top of the heap.
  struct Search {
    const Point& q;
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

  std::size_t grow(std::size_t first, std::size_t last) {
    Node node{points_[rows_[first]], points_[rows_[first]], first, last};
    for (std::size_t i = first; i < last; ++i) {
      for (std::size_t a = 0; a < node.least.size(); ++a) {
        node.least[a] = std::min(node.least[a], points_[rows_[i]][a]);
        node.most[a] = std::max(node.most[a], points_[rows_[i]][a]);
      }
    }
    const std::size_t at = nodes_.size();
    nodes_.push_back(node);
    if (last - first <= kLeafPoints) return at;
    std::size_t widest = 0;
    for (std::size_t a = 1; a < node.least.size(); ++a) {
      if (node.most[a] - node.least[a] > node.most[widest] - node.least[widest]) widest = a;
    }
    const std::size_t middle = first + (last - first) / 2;
    const auto row = [&](std::size_t i) { return rows_.begin() + static_cast<std::ptrdiff_t>(i); };
    std::nth_element(row(first), row(middle), row(last), [&](std::size_t a, std::size_t b) {
      const double x = points_[a][widest], y = points_[b][widest];
      return x != y ? x < y : a < b;
    });
    grow(first, middle);
    const std::size_t second = grow(middle, last);
    nodes_[at].second_half = second;
    return at;
  }

  [[nodiscard]] double box_distance2(const Point& q, const Node& node) const {
    Point nearest = q;
    for (std::size_t a = 0; a < q.size(); ++a) nearest[a] = std::clamp(q[a], node.least[a], node.most[a]);
    return distance2(q, nearest);
  }

  void walk(Search& search, std::size_t at) const {
    const Node& node = nodes_[at];
    if (node.second_half == 0) {
      for (std::size_t i = node.first; i < node.last; ++i)
        search.meet({rows_[i], distance2(search.q, points_[rows_[i]])});
      return;
    }
    std::size_t near = at + 1, far = node.second_half;
    double near2 = box_distance2(search.q, nodes_[near]), far2 = box_distance2(search.q, nodes_[far]);
    if (far2 < near2) {
      std::swap(near, far);
      std::swap(near2, far2);
    }
    if (search.may_hold(near2)) walk(search, near);
    if (search.may_hold(far2)) walk(search, far);
  }

  std::vector<Hit> search(const Point& q, double limit2, std::size_t most) const {
    expect_finite(q);
    if (most == 0) return {};
    Search search{q, limit2, most};
    walk(search, 0);
    std::sort(search.hits.begin(), search.hits.end(), before);
    return std::move(search.hits);
  }

  std::vector<Point> points_;
  std::vector<std::size_t> rows_;
  std::vector<Node> nodes_;
};

}  // namespace

std::unique_ptr<Index> make_tree_index(std::vector<Point> points) {
  return std::make_unique<TreeIndex>(std::move(points));
}

}  // namespace capstan::casebase
