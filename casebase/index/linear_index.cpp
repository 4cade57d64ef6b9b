#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "casebase/index/index.h"

namespace capstan::casebase {
namespace {

class LinearIndex final : public Index {
 public:
  explicit LinearIndex(Points points) : points_(std::move(points)) { expect_finite(points_); }

  std::vector<Hit> nearest(const Place& q, std::size_t k) const override {
    return look(q, std::numeric_limits<double>::infinity(), k);
  }
  std::vector<Hit> within(const Place& q, double limit2) const override {
    return look(q, limit2, points_.size());
  }

 private:
  std::vector<Hit> look(const Place& q, double limit2, std::size_t k) const {
    expect_place(q, points_);
    std::vector<Hit> hits;
    for (std::size_t row = 0; row < points_.size(); ++row) {
      const double d2 = distance2(q.at.data(), points_.row(row), q.weight.data(), points_.dimensions);
      if (d2 <= limit2) hits.push_back({row, d2});
    }
    put_in_order(hits, k);
    return hits;
  }

  Points points_;
};

}  // namespace

void expect_finite(const Points& points) {
  if (!std::all_of(points.values.begin(), points.values.end(), [](double v) { return std::isfinite(v); }))
    throw std::logic_error("a point of the case base's index is not finite");
}

void expect_place(const Place& q, const Points& points) {
  if (q.at.size() != q.weight.size() || (points.size() != 0 && q.at.size() != points.dimensions))
    throw std::logic_error("a place of other dimensions than the case base's index");
  for (std::size_t i = 0; i < q.at.size(); ++i) {
    if (!std::isfinite(q.at[i]) || !(q.weight[i] >= 0.0) || !std::isfinite(q.weight[i]))
      throw std::logic_error("a place in the case base's index is not finite");
  }
}

bool before(const Hit& a, const Hit& b) {
  return a.distance2 != b.distance2 ? a.distance2 < b.distance2 : a.row < b.row;
}

void put_in_order(std::vector<Hit>& hits, std::size_t k) {
  const std::size_t keep = std::min(k, hits.size());
  std::partial_sort(hits.begin(), hits.begin() + static_cast<std::ptrdiff_t>(keep), hits.end(), before);
  hits.resize(keep);
}

std::unique_ptr<Index> make_linear_index(Points points) {
  return std::make_unique<LinearIndex>(std::move(points));
}

}  // namespace capstan::casebase
