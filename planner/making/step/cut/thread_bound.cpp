#include "planner/making/step/cut/thread_bound.h"

#include <cstdint>

namespace capstan::step {

ThreadBound thread_bound(const model::Cutter& cutter, const model::FeatureShape& thread) {
  const double depth = thread.thread_depth_mm > 0.0 ? thread.thread_depth_mm : thread.depth_mm;
  return mechanics::thread_bound(
      cutter.cutting_diameter_mm, cutter.maximum_depth_of_cut_mm,
      {thread.thread_major_mm, thread.thread_pitch_mm, depth, thread.diameter.nominal_mm});
}

std::vector<optimise::CutSample> bound_samples(const ThreadBound& bound, const model::CutterPath& path) {
  std::vector<optimise::CutSample> out;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const bool arc = path.kind[i] == model::MoveKind::kArcCw || path.kind[i] == model::MoveKind::kArcCcw;
    if (!arc || path.role[i] != model::MoveRole::kCut) continue;
    const double length = model::move_length(path, i);
    out.push_back({.move = static_cast<std::uint32_t>(i),
                   .ap_mm = bound.ap_mm,
                   .ae_mm = bound.ae_mm,
                   .at_mm = length,
                   .step_mm = length,
                   .csa_mm2 = bound.ap_mm * bound.ae_mm});
  }
  return out;
}

}  // namespace capstan::step
