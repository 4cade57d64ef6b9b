#include "planner/making/step/path/surface_rest.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "planner/ground/base/stopping.h"
#include "planner/making/piece/mesh/surface_form.h"
#include "planner/making/step/path/freeform.h"
#include "planner/model/nouns/all.h"

// The mesh grown by a length R is the highest of spheres of radius R about its points: of the height map of
// the mesh, over each cell the highest of the heights around it plus those of the sphere. That holds on walls
// and floors alike, where a vertical height tells nothing of steep ones. Only cells that stand higher than R
// over the mesh below are looked at around.

namespace capstan::step {
namespace {

using draft::StepDraft;

constexpr float kAnything = 1e30F;
/// A rest of less than this is left to the next step, whose feed is lowered there: a change of tools takes
/// longer. Default, unsourced.
constexpr double kWorthMm3 = 10.0;
/// So little is worth a way only where it is deep: the next step would bite twice as deep as it may. Less
/// than the second is what the cells' rounding leaves. Defaults, unsourced.
constexpr double kDeep = 2.0, kWorthDeepMm3 = 1.0;

/// A place of the sphere against its middle.
struct Around {
  int dx = 0, dy = 0;
  float height = 0.0F;
};

std::vector<Around> sphere(double radius_mm, double cell_mm) {
  std::vector<Around> out;
  const int n = static_cast<int>(radius_mm / cell_mm);
  for (int dy = -n; dy <= n; ++dy) {
    for (int dx = -n; dx <= n; ++dx) {
      const double h2 = radius_mm * radius_mm - cell_mm * cell_mm * (dx * dx + dy * dy);
      if (h2 >= 0.0) out.push_back({dx, dy, static_cast<float>(std::sqrt(h2))});
    }
  }
  // The middle first, then outwards: what is high enough is found soon.
  std::stable_sort(out.begin(), out.end(),
                   [](const Around& a, const Around& b) { return a.height > b.height; });
  return out;
}

/// Lets the rests stay that are not worth a way: cells that touch, together. `deep(cell)`: whether so much
/// stands there that the rest is worth one though it is small.
template <class F>
void drop_small(const stock::HeightMap& map, SurfaceRest& rest, const F& deep) {
  const double cell_mm2 = map.cell_mm * map.cell_mm;
  const auto over = [&](std::size_t i) {
    return static_cast<double>(map.at(i).mean()) - static_cast<double>(rest.may_stay.top[i]);
  };
  std::vector<char> seen(map.cells());
  std::vector<std::size_t> group;
  for (std::size_t first = 0; first < map.cells(); ++first) {
    if (seen[first] != 0 || !(over(first) > 0.0)) continue;
    group.assign(1, first);
    seen[first] = 1;
    double mm3 = 0.0, deepest = 0.0;
    for (std::size_t k = 0; k < group.size(); ++k) {
      tick();
      const std::size_t i = group[k];
      mm3 += over(i) * cell_mm2;
      deepest = std::max(deepest, over(i));
      const int x = static_cast<int>(i % static_cast<std::size_t>(map.nx));
      const int y = static_cast<int>(i / static_cast<std::size_t>(map.nx));
      for (const auto& [dx, dy] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        if (x + dx < 0 || y + dy < 0 || x + dx >= map.nx || y + dy >= map.ny) continue;
        const std::size_t j = map.index(x + dx, y + dy);
        if (seen[j] != 0 || !(over(j) > 0.0)) continue;
        seen[j] = 1;
        group.push_back(j);
      }
    }
    if (mm3 < kWorthMm3 && (mm3 < kWorthDeepMm3 || std::none_of(group.begin(), group.end(), deep))) {
      for (const std::size_t i : group) rest.may_stay.top[i] = kAnything;
      continue;
    }
    rest.mm3 += mm3;
    rest.deepest_mm = std::max(rest.deepest_mm, deepest);
  }
}

}  // namespace

std::optional<SurfaceRest> surface_rest(const PlanSoFar& p, const StepDraft& step,
                                        const stock::HeightMap& map) {
  const std::optional<double> most = most_for_next_mm(p, step);
  if (!most) return std::nullopt;
  const geometry::Mesh mesh = mesh_in_setup(p, step.setup);
  const bool beside_stays = !piece::surface_form(mesh, p.setups[step.setup].stock).walls;
  // Heights are above 0 where the mesh has a triangle, and then told from the stock's floor.
  const stock::HeightMap own = stock::from_mesh(mesh, geometry::bounds(mesh).lo.z - 1.0, map);
  const auto lower = static_cast<float>(own.origin.z - map.origin.z);
  SurfaceRest out;
  out.may_stay = own;
  out.may_stay.origin.z = map.origin.z;
  const auto most_mm = static_cast<float>(*most);
  const std::vector<Around> around = sphere(*most, map.cell_mm);
  // The highest of spheres around a cell, or as soon as one is as high as what stands there.
  const auto grown = [&](int ix, int iy, float from, float stands, const std::vector<Around>& by) {
    for (const Around& a : by) {
      const int x = ix + a.dx, y = iy + a.dy;
      if (x < 0 || y < 0 || x >= map.nx || y >= map.ny) continue;
      tick();
      const float height = own.top[own.index(x, y)];
      if (height > 0.0F) from = std::max(from, height + lower + a.height);
      if (stands <= from) break;
    }
    return from;
  };
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const std::size_t i = map.index(ix, iy);
      float& stays = out.may_stay.top[i];
      const bool beside = own.top[i] <= 0.0F;
      stays = beside ? (beside_stays ? kAnything : most_mm) : own.top[i] + lower + most_mm;
      const float stands = map.at(i).mean();
      if (stands > stays) stays = grown(ix, iy, stays, stands, around);
    }
  }
  std::vector<Around> farther;  // made for the first small rest
  drop_small(map, out, [&](std::size_t i) {
    if (own.top[i] <= 0.0F) return false;
    const float stands = map.at(i).mean(), may = own.top[i] + lower + static_cast<float>(kDeep * *most);
    if (stands <= may) return false;
    if (farther.empty()) farther = sphere(kDeep * *most, map.cell_mm);
    const auto nx = static_cast<std::size_t>(map.nx);
    return stands > grown(static_cast<int>(i % nx), static_cast<int>(i / nx), may, stands, farther);
  });
  return out;
}

double mm3_above(const stock::HeightMap& map, const stock::HeightMap& may_stay) {
  double out = 0.0;
  for (std::size_t i = 0; i < map.cells(); ++i)
    out += std::max(0.0, static_cast<double>(map.at(i).mean()) - static_cast<double>(may_stay.top[i]));
  return out * map.cell_mm * map.cell_mm;
}

// The nouns do not tell a rest from another rough; that rules proposed both does, for these rough all of a
// surface once. A plan of ours that is read again has that in its record.
const model::Cutter* roughed_before(const PlanSoFar& p, const StepDraft& step) {
  const model::Model& m = p.plan.model;
  const auto by_rules = [&](const StepDraft& s) {
    if (!m.holds<model::FreeformRoughMilling>(s.operation)) return false;
    const auto* d = p.plan.ledger.find(s.step, "its_operation");
    return s.proposed || (d != nullptr && d->binder == model::Binder::kRule);
  };
  if (!by_rules(step)) return nullptr;
  const model::Cutter* out = nullptr;
  for (const StepDraft& s : p.steps) {
    if (s.step == step.step) break;
    const bool kept = std::any_of(p.plan.steps.begin(), p.plan.steps.end(),
                                  [&](const model::StepResult& r) { return r.step == s.step; });
    if (kept && s.feature == step.feature && by_rules(s)) out = &s.cutter;
  }
  return out;
}

}  // namespace capstan::step
