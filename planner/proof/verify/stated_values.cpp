#include "planner/proof/verify/stated_values.h"

#include <algorithm>

#include "planner/model/plan/preset_feeds.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/proof/verify/sweep/step_checks.h"

namespace capstan::verify {

const model::CuttingPreset* stated_for(const model::Cutter& c, const model::WorkMaterial& m, bool of_its_like,
                                       Wanted what) {
  // The nearer the name, the lower the rank; the group's letter comes last.
  const std::size_t group = m.names.size() + 1;
  const bool hss = c.substrate == model::Substrate::kHss;
  const double card = hss ? m.vc_hss_m_min : m.vc_carbide_m_min;
  const bool has_speeds = m.vc_hss_m_min > 0.0 || m.vc_carbide_m_min > 0.0;
  const bool group_counts = card > 0.0 || !has_speeds;
  const auto rank_of = [&](const std::string& name) -> std::size_t {
    if (name == m.id) return 0;
    const auto it = std::find(m.names.begin(), m.names.end(), name);
    if (it != m.names.end()) return 1 + static_cast<std::size_t>(it - m.names.begin());
    return name == m.iso_group && group_counts ? group : group + 1;
  };
  const model::CuttingPreset* best = nullptr;
  std::size_t best_rank = group + 1;
  for (const model::CuttingPreset& p : c.presets) {
    if (what == Wanted::kFeed && !(p.fz_mm > 0.0)) continue;
    if (what == Wanted::kSpeed && !(p.vc_m_min > 0.0)) continue;
    // Sources are long, and most presets are for other materials: these are passed over first.
    const std::size_t rank = rank_of(p.material_group);
    if (rank >= best_rank || model::borrowed(p) != of_its_like) continue;
    best = &p;
    best_rank = rank;
  }
  return best;
}

double least_chip_of(const model::Cutter& c, const model::WorkMaterial& m) {
  const bool hss = c.substrate == model::Substrate::kHss;
  const double by_edge = mechanics::least_chip_mm(c.cutting_diameter_mm, hss, m.iso_group);
  for (const bool of_its_like : {false, true}) {
    const auto* p = stated_for(c, m, of_its_like, Wanted::kFeed);
    if (p == nullptr) continue;
    // Only who has seen it cut may say that it cuts at less.
    const bool seen = !of_its_like && p->source.find("default") == std::string::npos;
    return std::min(by_edge, seen ? model::kCutsDownTo * p->fz_mm : p->fz_mm);
  }
  return by_edge;
}

double coated_over_bare(const model::Cutter& c) {
  // The least of tooling/data/cutters.yaml, `edges` (with its sources): coated_drill 1.3, coated_mill 1.7. No
  // table of coated reamers or taps was found.
  constexpr double kDrill = 1.3, kMill = 1.7;
  if (c.cutter_class == model::CutterClass::kReamer || c.cutter_class == model::CutterClass::kTap) return 1.0;
  return works_along_axis(c) ? kDrill : kMill;
}

}  // namespace capstan::verify
