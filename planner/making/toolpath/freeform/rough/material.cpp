#include "planner/making/toolpath/freeform/rough/material.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/making/toolpath/freeform/rough/levels.h"

namespace capstan::toolpath::freeform {
namespace {

using geometry::Vec2;

/// Thinner than this under a corner or a ball is what rounding to cells leaves, and not worth a way. Default,
/// unsourced.
constexpr double kWorthMm = 0.05;
constexpr int kPerCell = 8;

bool is_rest(const stock::HeightMap& material, const stock::HeightMap& may_stay, std::size_t cell) {
  return material.at(cell).mean() > may_stay.top[cell];
}

}  // namespace

stock::HeightMap block_under(const FreeformJob& task, const Hatch& hatch) {
  geometry::Box3 box;
  for (const Stripe& s : hatch.stripes) {
    for (const double u : {s.lo, s.hi}) {
      const Vec2 p = hatch.place(u, s.v);
      box.add({p.x, p.y, task.top_z_mm});
    }
  }
  const double low = std::max(task.bottom_z_mm, geometry::bounds(*task.surface).lo.z);
  box.add({box.lo.x, box.lo.y, std::min(low, task.top_z_mm)});
  return stock::from_box(box, stock::cell_for(task.cutter.cutting_diameter_mm, box, 40.0));
}

bool ends_with(const stock::HeightMap& material, const geometry::Box3& surface) {
  const double within = 1.5 * material.cell_mm;  // the map's last cells are cut through
  return material.origin.x > surface.lo.x - within && material.origin.y > surface.lo.y - within &&
         material.origin.x + material.nx * material.cell_mm < surface.hi.x + within &&
         material.origin.y + material.ny * material.cell_mm < surface.hi.y + within;
}

geometry::Region around_rests(const stock::HeightMap& material, const stock::HeightMap& may_stay,
                              double radius_mm) {
  // In blocks, for an area needs no finer border: what is cut there is told cell by cell.
  constexpr double kBlock = 0.5;  // of the radius
  const double block = std::max(material.cell_mm, kBlock * radius_mm);
  const int nx = static_cast<int>(std::ceil(material.nx * material.cell_mm / block));
  const int ny = static_cast<int>(std::ceil(material.ny * material.cell_mm / block));
  std::vector<char> held(static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny));
  const auto at = [&](int x, int y) -> char& {
    return held[static_cast<std::size_t>(y) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(x)];
  };
  const auto block_of = [&](int cell, int n) {
    return std::min(n - 1, static_cast<int>((cell + 0.5) * material.cell_mm / block));
  };
  for (int iy = 0; iy < material.ny; ++iy) {
    for (int ix = 0; ix < material.nx; ++ix) {
      if (is_rest(material, may_stay, material.index(ix, iy))) at(block_of(ix, nx), block_of(iy, ny)) = 1;
    }
  }
  std::vector<geometry::Loop> loops;
  for (int y = 0; y < ny; ++y) {
    for (int x = 0; x < nx; ++x) {
      if (at(x, y) == 0) continue;
      int end = x;
      while (end < nx && at(end, y) != 0) ++end;
      const Vec2 lo{material.origin.x + x * block, material.origin.y + y * block};
      const Vec2 hi{material.origin.x + end * block, lo.y + block};
      loops.push_back({lo, {hi.x, lo.y}, hi, {lo.x, hi.y}});
      x = end;
    }
  }
  if (loops.empty()) return {};
  constexpr double kArcMm = 0.05;
  return geometry::offset(geometry::clean(loops), radius_mm, kArcMm);
}

Material::Material(stock::HeightMap stock, const model::Cutter& cutter, const stock::HeightMap* may_stay)
    : map(std::move(stock)), profile(model::profile_of(cutter)), may_stay_(may_stay) {
  flat_mm_ = std::max(0.0, profile.radius_at(kNothing) - map.cell_mm);
  const auto n = static_cast<std::size_t>(std::ceil(profile.radius_mm / map.cell_mm * kPerCell)) + 1;
  for (std::size_t i = 0; i < n; ++i) {
    const double r = std::min(profile.radius_mm, static_cast<double>(i) * map.cell_mm / kPerCell);
    outline_.push_back(static_cast<float>(profile.height(r)));
  }
}

bool Material::is_below(Vec2 p, double z) const {
  return stock::max_height(map, p, profile.radius_mm) <= z + kNothing;
}

template <class F>
bool Material::any(Vec2 p, double radius_mm, const F& f) const {
  const auto cell = [&](double at, double origin, int n) {
    return std::clamp(static_cast<int>(std::floor((at - origin) / map.cell_mm)), 0, n - 1);
  };
  const int y1 = cell(p.y + radius_mm, map.origin.y, map.ny);
  for (int iy = cell(p.y - radius_mm, map.origin.y, map.ny); iy <= y1; ++iy) {
    const double dy = map.y_of(iy) - p.y;
    const double half = radius_mm * radius_mm - dy * dy;
    if (half <= 0.0) continue;
    const double dx_most = std::sqrt(half);
    const int x1 = cell(p.x + dx_most, map.origin.x, map.nx);
    for (int ix = cell(p.x - dx_most, map.origin.x, map.nx); ix <= x1; ++ix) {
      const double r = std::hypot(map.x_of(ix) - p.x, dy);
      if (r <= radius_mm && f(map.index(ix, iy), r)) return true;
    }
  }
  return false;
}

double Material::outline(double r_mm) const {
  const auto k = static_cast<std::size_t>(std::max(0.0, r_mm) * kPerCell / map.cell_mm);
  return static_cast<double>(outline_[std::min(outline_.size() - 1, k)]);
}

bool Material::meets(Vec2 p, double z) const {
  if (is_below(p, z)) return false;
  if (may_stay_ != nullptr) return meets_wanted(p, z);
  if (flat_mm_ > 0.0 && stock::max_height(map, p, flat_mm_) > z + kNothing) return true;
  // Beyond the plane of the tip cell by cell, at the middle of each and with the mean of its column; what a
  // cell's far side has more is within kWorthMm or cut from the next place.
  return profile.radius_mm - map.cell_mm > flat_mm_ && higher(p, z, flat_mm_);
}

bool Material::meets_wanted(Vec2 p, double z) const {
  const double above = z - map.origin.z + kWorthMm;
  const double part = map.cell_mm / kPerCell;
  return any(p, profile.radius_mm - map.cell_mm, [&](std::size_t cell, double r) {
    return is_rest(map, *may_stay_, cell) && map.at(cell).mean() > above + outline(r + part);
  });
}

bool Material::stands(Vec2 p, double z) const { return higher(p, z, 0.0); }

bool Material::higher(Vec2 p, double z, double from_mm) const {
  const double above = z - map.origin.z + kWorthMm;
  const double part = map.cell_mm / kPerCell;
  return any(p, profile.radius_mm - map.cell_mm, [&](std::size_t cell, double r) {
    const stock::Column c = map.at(cell);
    return r >= from_mm && c.top_mm > above && c.mean() > above + outline(r + part);
  });
}

bool Material::is_clear(Vec2 p, double z) const {
  if (is_below(p, z)) return true;
  // To a cell's corner from its middle.
  const double corner = std::sqrt(0.5) * map.cell_mm;
  const double above = z - map.origin.z + kNothing;
  return !any(p, profile.radius_mm + corner, [&](std::size_t cell, double r) {
    const stock::Column c = map.at(cell);
    return c.top_mm > above && c.top_mm > above + outline(r - corner);
  });
}

}  // namespace capstan::toolpath::freeform
