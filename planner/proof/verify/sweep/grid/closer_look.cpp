// A place is looked at on points of its own that lie closer than the set-up's cells. Only points that may
// decide are made: those from which the move can take a thick enough chip whatever stands there (way.h), in
// blocks of which no earlier cut leaves too little anywhere, where so much stood at the beginning. The cuts
// since take them down, the latest first, for it has mostly been there just before; a point is done with as
// soon as what is left of it decides nothing, the look as soon as no point is left. Heights do not depend on
// the order of the cuts, so that what is left is as if all had been made again.
#include "planner/proof/verify/sweep/grid/closer_look.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <span>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/proof/verify/sweep/grid/way.h"

namespace capstan::verify {

using geometry::Vec2;

namespace {

constexpr double kPoints = 40e3;  ///< of one look, at most; default, unsourced: a compromise of time
constexpr double kCloser = 8.0;   ///< than the set-up's cells, at most
constexpr double kWorthwhile = 1.4;

/// Pieces of a way that are looked at one by one: four radii long.
int pieces_of_way(const Move& m, double radius_mm) {
  return is_arc(m.kind) ? 1 : std::max(1, static_cast<int>(std::ceil(length_of(m) / (4.0 * radius_mm))));
}

/// Rows of points that count: those in front of the way, or all that it reaches.
template <class Way>
std::pair<int, int> rows(const Raster& local, const Way& way, const Front* front) {
  const auto [a, b] = front != nullptr ? way.front_y(*front) : way.reach_y();
  return local.rows(a, b);
}
/// Those of one row.
template <class Way>
std::pair<int, int> columns(const Raster& local, const Way& way, const Front* front, int iy) {
  const double y = local.centre(0, iy).y;
  const auto [a, b] = front != nullptr ? way.front_x(*front, y) : way.reach_x(y);
  return local.columns(a, b);
}

}  // namespace

/// One piece of a way, and the points that it is looked at on.
struct EarlierCuts::Place {
  Move part;
  Vec2 lo, hi;
  double cell = 0.0;

  Place(const Move& m, int i, int n, double radius_mm, double cell_mm) : part(m) {
    if (n > 1) {
      part.from = point_of(m, static_cast<double>(i) / n);
      part.to = point_of(m, static_cast<double>(i + 1) / n);
    }
    const geometry::Box3 box = box_of(part);
    lo = {box.lo.x - radius_mm, box.lo.y - radius_mm};
    hi = {box.hi.x + radius_mm, box.hi.y + radius_mm};
    cell = std::max(cell_mm / kCloser, std::sqrt((hi.x - lo.x) * (hi.y - lo.y) / kPoints));
  }
  [[nodiscard]] Raster raster() const { return {lo, hi, cell, static_cast<long>(2.0 * kPoints)}; }
};

/// Points that stand beside each other, from here eight columns and rows.
struct EarlierCuts::Block {
  static constexpr int kWide = 8;
  int x = 0, y = 0;
};

/// What stands at a point, and what of it stays under the move that is looked at.
struct EarlierCuts::Point {
  Vec2 at;
  double stock = 0.0, base = 0.0, under = 0.0;
};

void EarlierCuts::begin(const Grid& grid) {
  stock_.keep(grid.stock);
  base_.keep(grid.base);
  cuts_.clear();
  squares_.assign(std::size_t{kSquares} * kSquares, {});
  indexed_ = 0;
  lo_ = grid.centre(0, 0);
  const Vec2 size = grid.centre(grid.nx(), grid.ny()) - lo_;
  square_ = {size.x / kSquares, size.y / kSquares};
}

void EarlierCuts::add(const Move& m, std::shared_ptr<const CutterOutline> cutter) {
  geometry::Box3 box = box_of(m);
  cuts_.push_back({m, std::move(cutter), box});
}

template <class F>
void EarlierCuts::squares(Vec2 lo, Vec2 hi, const F& f) {
  const auto at = [](double v, double begin, double wide) {
    return static_cast<std::size_t>(std::clamp((v - begin) / wide, 0.0, kSquares - 1.0));
  };
  const std::size_t x1 = at(hi.x, lo_.x, square_.x), y1 = at(hi.y, lo_.y, square_.y);
  for (std::size_t y = at(lo.y, lo_.y, square_.y); y <= y1; ++y)
    for (std::size_t x = at(lo.x, lo_.x, square_.x); x <= x1; ++x) f(squares_[y * kSquares + x]);
}

/// The cuts before the mark that may reach a place, the latest first.
std::vector<const EarlierCuts::Cut*> EarlierCuts::met(const Place& place, std::size_t mark) {
  for (; indexed_ < cuts_.size(); ++indexed_) {
    const Cut& c = cuts_[indexed_];
    const double r = c.cutter->radius();
    squares({c.box.lo.x - r, c.box.lo.y - r}, {c.box.hi.x + r, c.box.hi.y + r},
            [&](auto& square) { square.push_back(static_cast<std::uint32_t>(indexed_)); });
  }
  std::vector<const Cut*> out;
  squares(place.lo, place.hi, [&](const auto& square) {
    for (const std::uint32_t i : square) {
      const Cut& c = cuts_[i];
      const double r = c.cutter->radius();
      if (i >= mark || c.box.lo.x - r > place.hi.x || c.box.hi.x + r < place.lo.x ||
          c.box.lo.y - r > place.hi.y || c.box.hi.y + r < place.lo.y) {
        continue;
      }
      out.push_back(&c);
    }
  });
  std::sort(out.begin(), out.end(), std::greater<>());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

/// The blocks of a place with points that count, by rows, but those of which an earlier cut leaves no more
/// than `least_mm` above the move that is looked at.
template <class Way>
std::vector<EarlierCuts::Block> EarlierCuts::blocks(const Raster& local, const Way& way, const Front* front,
                                                    double least_mm, const std::vector<const Cut*>& cuts) {
  constexpr int kWide = Block::kWide;
  std::vector<Block> out;
  const auto [y0, y1] = rows(local, way, front);
  for (int y = y0; y < y1; y += kWide) {
    int begin = local.nx(), end = 0;
    for (int iy = y; iy < std::min(y1, y + kWide); ++iy) {
      const auto [x0, x1] = columns(local, way, front, iy);
      begin = std::min(begin, x0);
      end = std::max(end, x1);
    }
    for (int x = begin; x < end; x += kWide) out.push_back({x, y});
  }
  const double apart = local.cell() * 0.5 * (kWide - 1) * std::numbers::sqrt2;
  for (const Cut* c : cuts) {
    if (out.empty()) break;
    tick();
    along_way(*c->cutter, c->move, [&](const auto& earlier) {
      if (earlier.zmin() - way.zmin() > least_mm) return;
      std::erase_if(out, [&](const Block& b) {
        const Vec2 middle = 0.5 * (local.centre(b.x, b.y) + local.centre(b.x + kWide - 1, b.y + kWide - 1));
        return earlier.leaves(earlier.distance(middle), apart) - way.zmin() <= least_mm;
      });
    });
  }
  return out;
}

/// The points of these blocks where the move would take more than `least_mm` off what stood at the beginning:
/// of those in front of it, where all cells around have it; without a front of all, where any cell has it.
template <class Way>
std::vector<EarlierCuts::Point> EarlierCuts::begun(const Grid& grid, const Raster& local, const Way& way,
                                                   const Front* front, double least_mm,
                                                   std::span<const Block> blocks) const {
  const bool all = front != nullptr;
  const double reach = 1.01 * grid.cell();
  const auto around = [&](std::pair<int, int> x, std::pair<int, int> y) {
    Point out;
    // Not beside the piece.
    out.stock = all && x.second - x.first >= 2 && y.second - y.first >= 2 ? 1e300 : Grid::kNothing;
    out.base = all ? Grid::kNothing : 1e300;
    for (int jy = y.first; jy < y.second; ++jy) {
      for (int jx = x.first; jx < x.second; ++jx) {
        const double s = stock_[grid.index(jx, jy)], b = base_[grid.index(jx, jy)];
        out.stock = all ? std::min(out.stock, s) : std::max(out.stock, s);
        out.base = all ? std::max(out.base, b) : std::min(out.base, b);
      }
    }
    return out;
  };
  std::vector<Point> row(static_cast<std::size_t>(local.nx())), out;
  while (!blocks.empty()) {
    const int y = blocks.front().y;
    const auto beyond = std::find_if(blocks.begin(), blocks.end(), [&](const Block& b) { return b.y != y; });
    const std::span<const Block> beside(blocks.begin(), beyond);
    std::pair<int, int> last{-1, -1};
    for (int iy = y; iy < std::min(y + Block::kWide, local.ny()); ++iy) {
      tick();
      const Vec2 begin = local.centre(0, iy);
      const std::pair<int, int> about = grid.rows(begin.y - reach, begin.y + reach);
      const auto [x0, x1] = columns(local, way, front, iy);
      for (const Block& b : beside) {
        std::pair<int, int> before{-1, -1};
        for (int ix = b.x; ix < std::min(b.x + Block::kWide, local.nx()); ++ix) {
          Point& p = row[static_cast<std::size_t>(ix)];
          p.at = local.centre(ix, iy);
          if (about != last) {
            const std::pair<int, int> here = grid.columns(p.at.x - reach, p.at.x + reach);
            const Vec2 at = p.at;
            p = here == before ? row[static_cast<std::size_t>(ix - 1)] : around(here, about);
            p.at = at;
            before = here;
          }
          Over over;
          if (ix < x0 || ix >= x1 || p.stock <= p.base || (all && !way.in_front(*front, p.at)) ||
              !way.meets(p.at, p.stock, over)) {
            continue;
          }
          p.under = std::max(all ? over.bound : over.z, p.base);
          if (p.stock - p.under > least_mm) out.push_back(p);
        }
      }
      last = about;
    }
    blocks = {beyond, blocks.end()};
  }
  return out;
}

/// Leaves the points that still have more than `least_mm` after a cut.
void EarlierCuts::lower(std::vector<Point>& points, const Move& m, const CutterOutline& cutter,
                        double least_mm) {
  along_way(cutter, m, [&](const auto& way) {
    std::size_t left = 0;
    for (Point p : points) {
      Over over;
      if (p.stock > way.zmin() && way.meets(p.at, p.stock, over))
        p.stock = over.z <= p.base ? Grid::kNothing : std::min(p.stock, over.z);
      if (p.stock - p.under > least_mm) points[left++] = p;
    }
    points.resize(left);
  });
}

/// The points that still have more than `least_mm` above the move after these cuts.
template <class Way>
std::vector<EarlierCuts::Point> EarlierCuts::left(const Grid& grid, const Place& place, const Way& way,
                                                  const Front* front, double least_mm,
                                                  const std::vector<const Cut*>& cuts) const {
  const Raster local = place.raster();
  const std::vector<Block> of = blocks(local, way, front, least_mm, cuts);
  std::vector<Point> points = begun(grid, local, way, front, least_mm, of);
  for (const Cut* c : cuts) {
    if (points.empty()) break;
    tick();
    lower(points, c->move, *c->cutter, least_mm);
  }
  return points;
}

Chip EarlierCuts::look(const Grid& grid, const Move& m, const std::shared_ptr<const CutterOutline>& cutter,
                       double advance_mm, double least_mm, int& pieces) {
  Chip worst;
  Cut before{m, cutter, {}};  // what of the way lies before a piece
  if (stock_.cells() != grid.stock.size()) return worst;
  const int n = pieces_of_way(m, cutter->radius());
  for (int i = 0; i < n && pieces > 0; ++i) {
    const Place place(m, i, n, cutter->radius(), grid.cell());
    if (place.cell * kWorthwhile > grid.cell()) continue;
    --pieces;
    along_way(*cutter, place.part, [&](const auto& way) {
      if (!way.has_front()) return;
      const Front front = way.front(least_mm, advance_mm);
      std::vector<const Cut*> cuts = met(place, cuts_.size());
      before.move.to = place.part.from;
      if (i > 0) cuts.insert(cuts.begin(), &before);
      for (const Point& p : left(grid, place, way, &front, least_mm, cuts)) {
        Over over;
        if (!way.meets(p.at, p.stock, over)) continue;
        way.find_tip(p.at, p.stock, over);
        const double thick = way.chip(p.at, p.stock, p.stock - p.under, advance_mm, over);
        if (thick > std::max(worst.mm, least_mm)) worst = {thick, p.at};
      }
    });
  }
  return worst;
}

bool EarlierCuts::takes(const Grid& grid, const std::vector<Move>& moves, const CutterOutline& cutter,
                        std::size_t mark, double& cell_mm) {
  constexpr int kLooks = 400;  // default, unsourced: a compromise of time
  cell_mm = 0.0;
  int looks = kLooks;
  for (const Move& m : moves) {
    if (m.kind == model::MoveKind::kRapid || m.kind == model::MoveKind::kDwell) continue;
    if (stock_.cells() != grid.stock.size()) return true;  // not known
    const int n = pieces_of_way(m, cutter.radius());
    for (int i = 0; i < n; ++i) {
      if (looks-- <= 0) return false;  // so many places, and nothing in any of them
      const Place place(m, i, n, cutter.radius(), grid.cell());
      cell_mm = std::max(cell_mm, place.raster().cell());
      const std::vector<const Cut*> cuts = met(place, mark);
      if (along_way(cutter, place.part,
                    [&](const auto& way) { return !left(grid, place, way, nullptr, 0.0, cuts).empty(); }))
        return true;
    }
  }
  return false;
}

/// The lowest that the beginning had around a point; kNothing beside the piece.
double EarlierCuts::least_begun(const Grid& grid, Vec2 at) const {
  const double reach = 1.01 * grid.cell();
  const auto [x0, x1] = grid.columns(at.x - reach, at.x + reach);
  const auto [y0, y1] = grid.rows(at.y - reach, at.y + reach);
  if (x1 - x0 < 2 || y1 - y0 < 2) return Grid::kNothing;
  double least = 1e300;
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) least = std::min(least, stock_[grid.index(x, y)]);
  return least;
}

std::optional<Touch> EarlierCuts::meets(const Grid& grid, const Move& m, const CutterOutline& cutter,
                                        double close_mm, int& pieces) {
  if (stock_.cells() != grid.stock.size()) return std::nullopt;
  Move fed = m;
  fed.kind = model::MoveKind::kLine;
  const int n = pieces_of_way(fed, cutter.radius());
  Touch out;
  for (int i = 0; i < n; ++i) {
    const Place place(fed, i, n, cutter.radius(), grid.cell());
    if (pieces-- <= 0 || place.raster().cell() > close_mm) return std::nullopt;
    const std::vector<const Cut*> cuts = met(place, cuts_.size());
    along_way(cutter, place.part, [&](const auto& way) {
      for (const Point& p : left(grid, place, way, nullptr, kRapidClearanceMm, cuts)) {
        if (!out.at) out.at = p.at;
        out.sure = least_begun(grid, p.at) - p.under > kRapidClearanceMm;
        if (!out.sure) continue;
        out.at = p.at;
        return;
      }
    });
    if (out.sure) return out;
  }
  return out;
}

}  // namespace capstan::verify
