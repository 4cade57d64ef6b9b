#include <flann/algorithms/dist.h>
#include <flann/algorithms/kdtree_single_index.h>

#include <algorithm>

#include "casebase/index/index.h"

namespace capstan::casebase {
namespace {

/// Squared distance with weights, as FLANN asks for it. It keeps one functor for all searches, so each thread
/// sets the weights of its search in a variable of its own.
struct Weighted {
  using is_kdtree_distance = bool;
  using ElementType = double;
  using ResultType = double;
  static thread_local const double* weight;

  template <class A, class B>
  double operator()(A a, B b, std::size_t n, double = -1.0) const {
    return distance2(&*a, &*b, weight, n);
  }
  template <class U, class V>
  double accum_dist(const U& a, const V& b, int i) const {
    const double d = weight[i] * (a - b);
    return d * d;
  }
};
thread_local const double* Weighted::weight = nullptr;

using Tree = flann::KDTreeSingleIndex<Weighted>;

/// FLANN's single tree is exact but for rounding and for which of equal distances it keeps. So it only
/// gathers candidates, a little beyond the limit; distance, limit and order are ours.
/// Never saved nor loaded: it is rebuilt from the points.
class FlannIndex final : public Index {
 public:
  explicit FlannIndex(Points points) : points_(std::move(points)) {
    expect_finite(points_);
    if (points_.size() == 0) return;  // FLANN crashes without a point
    tree_ = std::make_unique<Tree>(
        flann::Matrix<double>(points_.values.data(), points_.size(), points_.dimensions),
        flann::KDTreeSingleIndexParams(kLeafSize));
    tree_->buildIndex();
  }

  std::vector<Hit> nearest(const Place& q, std::size_t k) const override {
    expect_place(q, points_);
    const std::size_t n = std::min(k, points_.size());
    if (n == 0) return {};
    if (n > kManyAsked) return all(q, n);
    Weighted::weight = q.weight.data();
    flann::KNNSimpleResultSet<double> found(n);
    tree_->findNeighbors(found, q.at.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    std::vector<Hit> hits = gather(q, found.worstDist());
    put_in_order(hits, n);
    return hits;
  }

  std::vector<Hit> within(const Place& q, double limit2) const override {
    expect_place(q, points_);
    if (points_.size() == 0 || !(limit2 >= 0.0)) return {};
    std::vector<Hit> hits = gather(q, limit2);
    std::erase_if(hits, [&](const Hit& h) { return h.distance2 > limit2; });
    put_in_order(hits, hits.size());
    return hits;
  }

 private:
  // Rounding in FLANN's pruning is some units in the last place of sums up to about 1e4.
  static constexpr double kRelative = 1e-9, kAbsolute = 1e-9;
  static constexpr int kLeafSize = 10;
  static constexpr std::size_t kManyAsked = 256;  // FLANN's list of results is sorted by insertion

  [[nodiscard]] Hit hit(const Place& q, std::size_t row) const {
    return {row, distance2(q.at.data(), points_.row(row), q.weight.data(), points_.dimensions)};
  }

  std::vector<Hit> all(const Place& q, std::size_t n) const {
    std::vector<Hit> hits;
    hits.reserve(points_.size());
    for (std::size_t row = 0; row < points_.size(); ++row) hits.push_back(hit(q, row));
    put_in_order(hits, n);
    return hits;
  }

  /// Every point to `limit2`, and perhaps some a hair beyond it.
  std::vector<Hit> gather(const Place& q, double limit2) const {
    Weighted::weight = q.weight.data();
    flann::RadiusResultSet<double> found(limit2 * (1.0 + kRelative) + kAbsolute);
    tree_->findNeighbors(found, q.at.data(), flann::SearchParams(flann::FLANN_CHECKS_UNLIMITED));
    const std::size_t n = found.size();
    std::vector<std::size_t> rows(n);
    std::vector<double> theirs(n);
    if (n != 0) found.copy(rows.data(), theirs.data(), n, false);
    std::vector<Hit> hits;
    hits.reserve(n);
    for (const std::size_t row : rows) hits.push_back(hit(q, row));
    return hits;
  }

  Points points_;
  std::unique_ptr<Tree> tree_;
};

}  // namespace

std::unique_ptr<Index> make_index(Points points) { return std::make_unique<FlannIndex>(std::move(points)); }
bool built_with_flann() { return true; }

}  // namespace capstan::casebase
