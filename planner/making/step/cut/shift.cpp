#include "planner/making/step/cut/shift.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/making/step/cut/perimeter.h"

// How long clearing an area takes at the least. Passes of width ae lie ae apart, so that per level
//
//     length of all passes * ae >= area - outline * D
//
// : the outline takes half the diameter at each wall, and the first pass, a slot, half of it on both sides.
// Of the volume V of material in the area the passes so take at the least V - outline * D * depth, at no more
// than
//
//     Q = ap ae v      v = min(kMostThinning n z fz, 2 v of the cut)
//
// The first is the ceiling of every schedule (optimise/feeds.h). The second: depth and width were chosen for
// the largest rate, so that no thinner section within the limits takes more per minute; twice as much is
// allowed for what a search on few starts may have missed.

namespace capstan::step {
namespace {

constexpr double kMissed = 2.0;  // default, unsourced

/// Material over the area above this height of the set-up, mm3. Over an island all is counted as staying.
double material_mm3(const toolpath::PathJob& job, const stock::HeightMap& map, double floor_z_mm) {
  double out = 0.0;
  for (int iy = 0; iy < map.ny; ++iy) {
    for (int ix = 0; ix < map.nx; ++ix) {
      const double high = map.origin.z + map.at(ix, iy).mean() - floor_z_mm;
      if (!(high > 0.0)) continue;
      const auto at = job.feature_in_setup.to_local({map.x_of(ix), map.y_of(iy), 0.0});
      const geometry::Vec2 p{at.x, at.y};
      const auto stays = [&](const model::Island& i) { return geometry::contains(i.area, p); };
      const auto& islands = job.shape.islands;
      if (geometry::contains(job.shape.area, p) && std::none_of(islands.begin(), islands.end(), stays))
        out += high;
    }
  }
  return out * map.cell_mm * map.cell_mm;
}

}  // namespace

double least_clearing_s(const toolpath::PathJob& job, const optimise::CutQuestion& q,
                        const optimise::CutAnswer& cut, const stock::HeightMap& map) {
  const double floor = job.feature_in_setup.origin.z - job.shape.depth_mm + job.allowance_bottom_mm;
  const double depth = job.start_z_mm - floor;
  const double highest = std::max(cut.feed_mm_min, optimise::kMostThinning * optimise::largest_fz(q) *
                                                       std::max(1, q.cutter.teeth) * std::abs(cut.n_rpm));
  const double feed = q.aim == optimise::Aim::kTime ? std::min(highest, kMissed * cut.feed_mm_min) : highest;
  const double rate = cut.ap_mm * cut.ae_mm * feed;
  if (!(rate > 0.0) || !(depth > 0.0) || job.cleared_by || job.shape.area.empty()) return 0.0;
  // Islands stay: of an outside they are the part. Their walls are outlines as the area's.
  double outline = perimeter(job.shape.area), free_mm2 = geometry::area(job.shape.area);
  for (const model::Island& island : job.shape.islands) {
    outline += perimeter(island.area);
    free_mm2 -= geometry::area(island.area);
  }
  const double beside = outline * (q.cutter.cutting_diameter_mm + job.allowance_side_mm);
  const double most = (free_mm2 - beside) * depth;
  // The map is asked only where a solid block would last longer than a shift.
  if (!(60.0 * most / rate > kShiftS)) return std::max(0.0, 60.0 * most / rate);
  return std::max(0.0, 60.0 * (material_mm3(job, map, floor) - beside * depth) / rate);
}

std::optional<std::string> surely_longer_than_a_shift(const draft::StepDraft& step,
                                                      const toolpath::PathJob& job,
                                                      const optimise::CutQuestion& q,
                                                      const optimise::CutAnswer& cut,
                                                      const stock::HeightMap& map) {
  const bool clears = model::has(step.operation.type, model::OperationTrait::kRoughs) &&
                      model::has(step.operation.type, model::OperationTrait::kWalls) &&
                      q.kind == optimise::CutKind::kRough && !q.slot;
  if (!step.proposed || !clears) return std::nullopt;
  const double seconds = least_clearing_s(job, q, cut, map);
  if (!(seconds > kShiftS)) return std::nullopt;
  return longer_than_a_shift_text("at least " + trimmed(seconds / 3600.0, 1) + " h");
}

std::string longer_than_a_shift_text(const std::string& hours) {
  return "it cuts " + hours + ", longer than a shift of " + trimmed(kShiftS / 3600.0, 0) +
         " h; take a machine that turns a wider tool in this material (--machine), or change the feature";
}

}  // namespace capstan::step
