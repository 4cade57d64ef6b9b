#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/ground/base/memory/grow.h"
#include "planner/ground/base/stopping.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace capstan::verify {

using geometry::Vec2;

namespace {

/// Heights of grids that are gone, for the next ones.
class Spare {
 public:
  /// Empty heights with room for n of them.
  std::vector<double> take(std::size_t n) {
    std::vector<double>* best = nullptr;
    for (std::vector<double>& s : spare_) {
      if (s.capacity() >= n && (best == nullptr || s.capacity() < best->capacity())) best = &s;
    }
    std::vector<double> out;
    if (best != nullptr) {
      out.swap(*best);
      numbers_ -= out.capacity();
    }
    out.clear();
    out.reserve(n);
    return out;
  }
  /// Keeps these, in place of the smallest where all places are taken.
  void keep(std::vector<double>& heights) noexcept {
    std::vector<double>& place =
        *std::min_element(spare_.begin(), spare_.end(),
                          [](const auto& a, const auto& b) { return a.capacity() < b.capacity(); });
    if (place.capacity() >= heights.capacity()) return;
    const std::size_t others = numbers_ - place.capacity();
    if (heights.capacity() > kMost - std::min(kMost, others)) return;
    std::vector<double>().swap(place);
    place.swap(heights);
    numbers_ = others + place.capacity();
  }

 private:
  static constexpr auto kMost = static_cast<std::size_t>(kMostSpareMb * 1e6) / sizeof(double);
  std::array<std::vector<double>, 6> spare_;
  std::size_t numbers_ = 0;
};
thread_local Spare spare;

}  // namespace

Raster::Raster(Vec2 lo, Vec2 hi, double cell_mm, long maximum_cells) : lo_(lo) {
  const double w = std::max(hi.x - lo.x, 1e-3);
  const double h = std::max(hi.y - lo.y, 1e-3);
  cell_ = std::max(cell_mm, std::sqrt(w * h / static_cast<double>(maximum_cells)));
  cell_ = std::max({cell_, w / static_cast<double>(maximum_cells), h / static_cast<double>(maximum_cells)});
  const auto count = [&](double size) {
    return std::max(1, static_cast<int>(std::floor(size / cell_ + 0.5)));
  };
  nx_ = count(w);
  ny_ = count(h);
}

Grid::Grid(Vec2 lo, Vec2 hi, double cell_mm, long maximum_cells) : Raster(lo, hi, cell_mm, maximum_cells) {
  for (std::vector<double>* heights : {&stock, &part, &base}) {
    const std::size_t n = index(0, ny_);
    *heights = spare.take(n);
    grow(*heights, n, kNothing);
  }
  row_top_.assign(static_cast<std::size_t>(ny_), kNothing);
  blocks_ = (nx_ + kBlock - 1) / kBlock;
  block_top_.assign(static_cast<std::size_t>(ny_) * static_cast<std::size_t>(blocks_), kNothing);
  cut_blocks_.assign(static_cast<std::size_t>(ny_), {blocks_, 0});
  cut_from_ = ny_;
}

Grid::~Grid() {
  for (std::vector<double>* heights : {&stock, &part, &base}) spare.keep(*heights);
}

std::pair<int, int> Raster::columns(double a, double b) const {
  const double first = std::ceil((a - lo_.x) / cell_ - 0.5);
  const double last = std::floor((b - lo_.x) / cell_ - 0.5);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(nx_))),
          static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(nx_)))};
}

std::pair<int, int> Raster::rows(double a, double b) const {
  const double first = std::ceil((a - lo_.y) / cell_ - 0.5);
  const double last = std::floor((b - lo_.y) / cell_ - 0.5);
  return {static_cast<int>(std::clamp(first, 0.0, static_cast<double>(ny_))),
          static_cast<int>(std::clamp(last + 1.0, 0.0, static_cast<double>(ny_)))};
}

void Grid::begin_level(double stock_mm, double base_mm) {
  for (int iy = 0; iy < ny_; ++iy) {
    tick(8);
    const auto from = static_cast<std::ptrdiff_t>(index(0, iy));
    std::fill_n(stock.begin() + from, nx_, stock_mm);
    std::fill_n(base.begin() + from, nx_, base_mm);
  }
  std::fill(row_top_.begin(), row_top_.end(), stock_mm);
  std::fill(block_top_.begin(), block_top_.end(), stock_mm);
  for (int iy = 0; iy < ny_; ++iy) nothing_cut(iy);
  cut_from_ = ny_;
  cut_to_ = 0;
  top_ = stock_mm;
}

void Grid::find_top() {
  for (int iy = 0; iy < ny_; ++iy) cut_cells(iy, 0, nx_);
  find_top_after_cuts();
}

void Grid::find_top_after_cuts() {
  for (int iy = cut_from_; iy < cut_to_; ++iy) {
    const Blocks cut = cut_blocks_[static_cast<std::size_t>(iy)];
    if (cut.from >= cut.to) continue;
    nothing_cut(iy);
    const auto row = stock.begin() + static_cast<std::ptrdiff_t>(index(0, iy));
    double* const tops = block_top_.data() + static_cast<std::ptrdiff_t>(iy) * blocks_;
    for (int b = cut.from; b < cut.to; ++b) {
      // Four at a time: each waits for its own last comparison only.
      double top[4] = {kNothing, kNothing, kNothing, kNothing};
      const std::ptrdiff_t end = std::min((b + 1) * kBlock, nx_);
      std::ptrdiff_t i = b * kBlock;
      for (; i + 4 <= end; i += 4)
        for (std::ptrdiff_t k = 0; k < 4; ++k) top[k] = std::max(top[k], row[i + k]);
      for (; i < end; ++i) top[0] = std::max(top[0], row[i]);
      tops[b] = std::max(std::max(top[0], top[1]), std::max(top[2], top[3]));
    }
    row_top_[static_cast<std::size_t>(iy)] = *std::max_element(tops, tops + blocks_);
  }
  cut_from_ = ny_;
  cut_to_ = 0;
  top_ = *std::max_element(row_top_.begin(), row_top_.end());
}

double Grid::highest(Vec2 at, double radius_mm) const {
  double best = kNothing;
  const auto [y0, y1] = rows(at.y - radius_mm, at.y + radius_mm);
  for (int iy = y0; iy < y1; ++iy) {
    const double dy = centre(0, iy).y - at.y;
    const double half = std::sqrt(std::max(0.0, radius_mm * radius_mm - dy * dy));
    const auto [x0, x1] = columns(at.x - half, at.x + half);
    for (int ix = x0; ix < x1; ++ix) best = std::max(best, stock[index(ix, iy)]);
  }
  return best;
}

bool Grid::stands(Vec2 at, double radius_mm, double lo_mm, double hi_mm) const {
  const auto [y0, y1] = rows(at.y - radius_mm, at.y + radius_mm);
  for (int iy = y0; iy < y1; ++iy) {
    const double dy = centre(0, iy).y - at.y;
    const double half = std::sqrt(std::max(0.0, radius_mm * radius_mm - dy * dy));
    const auto [x0, x1] = columns(at.x - half, at.x + half);
    for (int ix = x0; ix < x1; ++ix) {
      const std::size_t i = index(ix, iy);
      if (stock[i] > lo_mm && base[i] < hi_mm) return true;
    }
  }
  return false;
}

double Grid::normal_depth(Vec2 at, double z_mm) const {
  const auto [x0, x1] = columns(at.x - 0.5 * cell_, at.x + 0.5 * cell_);
  const auto [y0, y1] = rows(at.y - 0.5 * cell_, at.y + 0.5 * cell_);
  if (x0 >= x1 || y0 >= y1) return 0.0;
  const double here = part[index(x0, y0)];
  double steepest = 0.0;
  for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
    const int ix = x0 + dx;
    const int iy = y0 + dy;
    if (ix < 0 || iy < 0 || ix >= nx_ || iy >= ny_) continue;
    steepest = std::max(steepest, std::abs(part[index(ix, iy)] - here) / cell_);
  }
  return (here - z_mm) / std::sqrt(1.0 + 2.0 * steepest * steepest);
}

double rapid_collision(const Grid& grid, const Move& m, const CutterOutline& o, double clearance_mm,
                       Vec2& at) {
  constexpr double kGrazing = 0.01;  // mm: a wall the cutter has just made is not hit by leaving it
  const double zmin = std::min(m.from.z, m.to.z);
  const bool vertical = norm(xy(m.to) - xy(m.from)) < 1e-9;
  if (vertical && m.to.z >= m.from.z) return 0.0;
  if (zmin >= grid.top() + clearance_mm) return 0.0;
  const double r = std::max(0.0, o.radius() - kGrazing);
  const double xa = std::min(m.from.x, m.to.x), xb = std::max(m.from.x, m.to.x);
  const double ya = std::min(m.from.y, m.to.y), yb = std::max(m.from.y, m.to.y);
  double worst = 0.0;
  const auto [y0, y1] = grid.rows(ya - r, yb + r);
  for (int iy = y0; iy < y1; ++iy) {
    const double y = grid.centre(0, iy).y;
    const double dy = y - std::clamp(y, ya, yb);
    const double half = std::sqrt(std::max(0.0, r * r - dy * dy));
    const auto [x0, x1] = grid.columns(xa - half, xb + half);
    for (int ix = x0; ix < x1; ++ix) {
      const double s = grid.stock[grid.index(ix, iy)];
      if (s + clearance_mm <= zmin) continue;
      const double x = grid.centre(ix, iy).x;
      // A point may stand anywhere in the cell: the tip of a cone is taken as that much nearer.
      const double d = std::hypot(x - std::clamp(x, xa, xb), dy);
      const double z = zmin + o.height(std::max(0.0, d - 0.71 * grid.cell()));
      const double dip = s + clearance_mm - z;
      if (dip > worst) {
        worst = dip;
        at = grid.centre(ix, iy);
      }
    }
  }
  return worst;
}

}  // namespace capstan::verify
