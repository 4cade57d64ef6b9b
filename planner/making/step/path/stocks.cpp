#include "planner/making/step/path/stocks.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/making/optimise/feeds.h"
#include "planner/making/step/path/remembered/cells.h"
#include "planner/making/step/path/remembered/planar.h"
#include "planner/model/plan/path/own_frame.h"
#include "planner/model/plan/resources/setup_position.h"
#include "planner/physics/stock/sweep.h"
#include "planner/physics/stock/turned.h"

namespace capstan::step {
namespace {

using geometry::Vec2;

constexpr double kCellsPerDiameter = 30.0;  // of the stock map, for the smallest cutter of the set-up
constexpr double kMaximumCells = 600e3;     // keeps a set-up's map near 7 MB
constexpr int kMostOtherCells = 2;      // times that cutters may change with the cells; default, unsourced
constexpr double kContradiction = 0.1;  // of a step's volume, between map and geometry; default, unsourced
constexpr double kFairCells = 10.0;     // per diameter, from which a map tells so much; default, unsourced
constexpr double kTraceMm3 = 1.0;       // the same of next to nothing

SameSetup same_setup(const draft::SetupDraft& s) {
  const geometry::Placement& at = s.workpiece;
  return {s.setup, {at.origin.x, at.origin.y, at.origin.z, at.x.x, at.x.y, at.x.z, at.z.x, at.z.y, at.z.z}};
}

/// How far apart sections are, mm. On a large piece the cells are coarse; the sections stay as close as the
/// shortest piece that has a feed.
double step_of(const stock::HeightMap& map, const model::Cutter& cutter) {
  const double step_mm = std::min(2.0 * map.cell_mm, optimise::kLeastPiece * cutter.cutting_diameter_mm);
  return std::max(model::profile_of(cutter).radius_mm / 20.0, step_mm);
}

/// Empties the columns beside a box that is turned about Z; a column that it may touch stays.
void clear_beside(stock::HeightMap& map, const geometry::Box3& raw, const geometry::Placement& workpiece) {
  const double reach = 0.5 * std::sqrt(2.0) * map.cell_mm;
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const geometry::Vec3 p = workpiece.to_local({map.x_of(ix), map.y_of(iy), workpiece.origin.z});
      if (p.x < raw.lo.x - reach || p.x > raw.hi.x + reach || p.y < raw.lo.y - reach ||
          p.y > raw.hi.y + reach)
        map.set(ix, iy, {});
    }
  }
}

}  // namespace

double Stocks::smallest(std::size_t setup) const {
  double mm = 1e300;
  for (const draft::StepDraft& s : steps_) {
    // A point that marks a place is no measure of the sections of others.
    if (model::has(s.cutter.cutter_class, model::CutterTrait::kMarks)) continue;
    if (s.setup == setup && s.cutter.cutting_diameter_mm > 0.0 && !left_out_.contains(s.step))
      mm = std::min(mm, s.cutter.cutting_diameter_mm);
  }
  return mm > 1e200 ? 10.0 : mm;
}

double Stocks::cell(std::size_t setup, double smallest_mm) const {
  return stock::cell_for(smallest_mm, setups_[setup].stock, kCellsPerDiameter, kMaximumCells);
}

Stocks::OtherCells Stocks::other_cells() const {
  OtherCells out{known_, false};
  for (std::size_t i = 0; i < maps_.size(); ++i) {
    const double mm = smallest(i);
    if (!maps_[i] || cell(i, mm) == cell(i, smallest_[i])) continue;
    Smallest& known = out.cutters[same_setup(setups_[i])];
    if (known.times++ >= kMostOtherCells) continue;
    known.mm = mm;
    out.again = true;
  }
  return out;
}

stock::HeightMap& Stocks::of(std::size_t setup) {
  auto& map = maps_[setup];
  if (!map) {
    const auto known = known_.find(same_setup(setups_[setup]));
    smallest_[setup] = known != known_.end() ? known->second.mm : smallest(setup);
    const auto& box = setups_[setup].stock;
    const double cell = this->cell(setup, smallest_[setup]);
    const bool upright = std::abs(setups_[setup].workpiece.z.z) > 1.0 - 1e-9;
    const auto& round = raw_.cylinder_radius_mm;
    map = round && upright ? stock::from_cylinder(box, *round, cell) : stock::from_box(box, cell);
    exact_[setup] =
        round && upright ? stock::PlanarStock::from_cylinder(box, *round) : stock::PlanarStock::from_box(box);
    if (!round && upright && !model::faces_axes(setups_[setup].workpiece)) {
      clear_beside(*map, raw_.box, setups_[setup].workpiece);
      exact_[setup]->lose("the raw piece's sides face no axis");
    }
  }
  if (setup != last_) {
    // Another clamping: what the others took away is gone here, too.
    last_ = setup;
    std::optional<double> before;  // summing a map is as much work as making it
    for (std::size_t i = 0; i < maps_.size(); ++i) {
      if (i == setup || !maps_[i]) continue;
      if (!before) before = stock::volume(*map);
      stock::take_over(*map, setups_[setup].workpiece, *maps_[i], setups_[i].workpiece);
    }
    if (exact_[setup] && before && stock::volume(*map) != *before)
      exact_[setup]->lose("cut in another clamping");
  }
  return *map;
}

Stocks::Before Stocks::before(std::size_t setup) {
  (void)of(setup);
  return {patches_[setup].size(), exact_[setup]->mark()};
}

void Stocks::put_back(std::size_t setup, const Before& before) {
  auto& patches = patches_[setup];
  while (patches.size() > before.patches) {
    stock::put_back(*maps_[setup], patches.back());
    patches.pop_back();
  }
  exact_[setup]->put_back(before.exact);
}

Stocks::Undone Stocks::take_out(std::size_t setup, const Before& before) {
  auto& patches = patches_[setup];
  Undone out;
  while (patches.size() > before.patches) {
    stock::exchange(*maps_[setup], patches.back());
    out.patches.push_back(std::move(patches.back()));
    patches.pop_back();
  }
  out.exact = exact_[setup]->take_out(before.exact);
  return out;
}

void Stocks::put_in(std::size_t setup, Undone undone) {
  for (auto p = undone.patches.rbegin(); p != undone.patches.rend(); ++p) {
    stock::exchange(*maps_[setup], *p);
    patches_[setup].push_back(std::move(*p));
  }
  exact_[setup]->put_in(std::move(undone.exact));
}

void Stocks::keep(std::size_t setup) {
  patches_[setup].clear();
  if (exact_[setup]) exact_[setup]->forget();
}

Result<engagement::Measurement> Stocks::measure(std::size_t setup, const model::CutterPath& path,
                                                const model::Cutter& cutter) {
  auto& map = of(setup);
  auto& exact = exact_[setup];
  const auto profile = model::profile_of(cutter);
  patches_[setup].push_back(columns_under(map, path, profile));
  poll();
  if (!exact || !exact->lost().empty()) return measure_again(map, path, cutter, memo_);
  if (engagement::head_height(cutter) || !geometry::is_flat(profile)) {
    auto cells = measure_again(map, path, cutter, memo_);
    if (!cells) return cells;
    if (engagement::head_height(cutter)) {
      exact->lose("cut by a cutter that is thinner behind its head");
    } else if (auto held = exact->cut(profile, path); !held) {
      exact->lose(held.error().message);
    }
    return cells;
  }
  const engagement::Options options{.step_mm = step_of(map, cutter)};
  auto measured = measure_again(*exact, path, cutter, options, memo_);
  if (!measured) {
    if (exact->lost().empty()) exact->lose(measured.error().message);
    return measure_again(map, path, cutter, memo_);
  }
  poll();
  // Two accounts of one cut: where they contradict each other the map's is kept. A map whose cells are coarse
  // for the cutter, as that of a large piece is, is off by itself in proportion.
  const double cells_mm3 = stock::cut(map, profile, path);
  poll();
  const double exact_mm3 = measured->removed_mm3 + measured->rapid_removed_mm3;
  const double fair = std::max(1.0, kFairCells * map.cell_mm / cutter.cutting_diameter_mm);
  if (std::abs(cells_mm3 - exact_mm3) > fair * kContradiction * std::max(cells_mm3, exact_mm3) + kTraceMm3) {
    exact->lose("it contradicts the height map");
    stock::put_back(map, patches_[setup].back());
    return measure_again(map, path, cutter, memo_);
  }
  return measured;
}

std::optional<stock::PlanarPart> Stocks::part(std::size_t setup, const geometry::Box3& cut, Vec2 origin,
                                              const model::Cutter& cutter) {
  const stock::HeightMap& map = of(setup);
  const auto& exact = exact_[setup];
  if (!exact || !exact->lost().empty()) return std::nullopt;
  // As far beyond its path as remembered/planar.cpp looks, which ends a radius before what is cut.
  const double radius = model::profile_of(cutter).radius_mm, beyond = radius + step_of(map, cutter);
  const Vec2 more{beyond, beyond};
  return exact->part(model::on_own_grid(xy(cut.lo) - origin - more),
                     model::on_own_grid(xy(cut.hi) - origin + more), origin);
}

void Stocks::cut(std::size_t setup, const model::CutterPath& path, const model::Cutter& cutter) {
  // What stays above a head is told by its measuring alone.
  if (engagement::head_height(cutter)) return (void)measure(setup, path, cutter);
  const auto profile = model::profile_of(cutter);
  stock::cut(of(setup), profile, path);
  auto& exact = exact_[setup];
  if (!exact || !exact->lost().empty()) return;
  if (auto held = exact->cut(profile, path); !held) exact->lose(held.error().message);
}

double top_over(const stock::HeightMap& map, const toolpath::PathJob& job) {
  geometry::Box3 box;
  const auto b = geometry::bounds(job.shape.area);
  for (const geometry::Vec2 c :
       {b.lo, geometry::Vec2{b.hi.x, b.lo.y}, b.hi, geometry::Vec2{b.lo.x, b.hi.y}}) {
    box.add(job.feature_in_setup.to_parent({c.x, c.y, 0.0}));
  }
  const int x0 = std::max(0, static_cast<int>(std::floor((box.lo.x - map.origin.x) / map.cell_mm)));
  const int x1 = std::min(map.nx - 1, static_cast<int>(std::floor((box.hi.x - map.origin.x) / map.cell_mm)));
  const int y0 = std::max(0, static_cast<int>(std::floor((box.lo.y - map.origin.y) / map.cell_mm)));
  const int y1 = std::min(map.ny - 1, static_cast<int>(std::floor((box.hi.y - map.origin.y) / map.cell_mm)));
  float top = 0.0F;
  for (int y = y0; y <= y1; ++y) {
    for (int x = x0; x <= x1; ++x) top = std::max(top, map.at(x, y).top_mm);
  }
  return map.origin.z + static_cast<double>(top);
}

}  // namespace capstan::step
