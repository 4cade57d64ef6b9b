#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "casebase/index/index.h"

namespace capstan::casebase {
namespace {

class LinearIndex final : public Index {
 public:
  explicit LinearIndex(std::vector<Point> points) : points_(std::move(points)) {
    for (const Point& p : points_) expect_finite(p);
  }

  std::vector<Hit> nearest(const Point& q, std::size_t k) const override {
    return look(q, std::numeric_limits<double>::infinity(), k);
  }
  std::vector<Hit> within(const Point& q, double limit2) const override {
    return look(q, limit2, points_.size());
  }

 private:
  std::vector<Hit> look(const Point& q, double limit2, std::size_t k) const {
    expect_finite(q);
    std::vector<Hit> hits;
    for (std::size_t row = 0; row < points_.size(); ++row) {
      const double d2 = distance2(q, points_[row]);
      if (d2 <= limit2) hits.push_back({row, d2});
    }
    put_in_order(hits, k);
    return hits;
  }

  std::vector<Point> points_;
};

}  // namespace

void expect_finite(const Point& p) {
  if (!std::all_of(p.begin(), p.end(), [](double v) { return std::isfinite(v); })) {
    throw std::logic_error("a point of the case base's index is not finite");
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

std::unique_ptr<Index> make_linear_index(std::vector<Point> points) {
  return std::make_unique<LinearIndex>(std::move(points));
}

}  // namespace capstan::casebase
