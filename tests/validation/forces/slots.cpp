// Slots in C45 and AISI 304 with the generic four-flute mills, half a diameter deep: the feed that planning
// chooses beside a maker's, and what held it.
//
// The maker's: Sandvik Coromant, CoroMill Plura, feed recommendations, p. D 155
// (scribd.com/document/453603772), by the diameter: of cuts with ap ae above D mm2, and of lighter ones. "By
// 0.1 mm" is the feed at which the tip bends by 0.1 mm, which was the limit of all roughing; "now" is bound
// by the endurance of the tool (mechanics::enduring_bend_mm), less what runout takes of it, and by what an
// allowance of 0.3 mm leaves over the thinnest pass.

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/making/optimise/cut.h"
#include "planner/making/optimise/cut/limits.h"
#include "planner/physics/mechanics/constants.h"
#include "tests/support/shop.h"
#include "tests/validation/studies.h"
#include "tooling/selection/select.h"
#include "tooling/shop/material/material.h"

namespace capstan::validation {
namespace {

struct Maker {
  double d_mm, heavy_mm, light_mm;  ///< feed per tooth
};
constexpr Maker kMaker[] = {{2, 0.004, 0.003},  {3, 0.006, 0.007},  {4, 0.008, 0.014},  {5, 0.011, 0.021},
                            {6, 0.014, 0.030},  {8, 0.020, 0.033},  {10, 0.027, 0.055}, {12, 0.036, 0.071},
                            {16, 0.055, 0.090}, {20, 0.078, 0.110}, {25, 0.110, 0.110}};

constexpr double kAllowanceMm = 0.3, kWasMm = 0.1, kDepthRatio = 0.5;

optimise::CutQuestion slot(const model::Cutter& c, const model::WorkMaterial& w, const model::Machine& m) {
  optimise::CutQuestion q;
  q.cutter = c;
  q.material = w;
  q.machine = m;
  const auto start = tooling::start_values(c, w, m);
  q.vc_start_m_min = start.vc_m_min;
  q.vc_table_m_min = start.wanted_vc_m_min;
  q.fz_start_mm = start.fz_mm;
  q.slot = true;
  q.width_mm = c.cutting_diameter_mm;
  q.depth_mm = kDepthRatio * c.cutting_diameter_mm;
  q.ap_mm = q.depth_mm;
  q.deflection_limit_mm = kAllowanceMm - mechanics::least_depth_mm(c.cutting_diameter_mm, false, w.iso_group);
  return q;
}

std::string named(std::string limit) {
  std::replace(limit.begin(), limit.end(), '_', ' ');
  return limit;
}

}  // namespace

Comparison slots() {
  Comparison out{.name = "slots"};
  Job job;
  const auto shop = pipeline::load_shop({}, job);
  if (!shop) {
    out.skipped = shop.error().message;
    return out;
  }
  double most = 0.0;
  for (const char* material : {"C45", "AISI 304"}) {
    const auto card = tooling::find_material(material, shop->materials, job);
    if (!card) continue;
    Table table{{"D, mm", "1/min", "maker, heavy, mm", "maker, light, mm", "by 0.1 mm, mm", "now, mm",
                 "bending, mm", "of at most, mm", "held by"},
                {}};
    for (const Maker& k : kMaker) {
      const std::string id = "generic/endmill_4f_short/" + shortest(k.d_mm);
      const auto c =
          std::find_if(shop->library.begin(), shop->library.end(), [&](const auto& x) { return x.id == id; });
      if (c == shop->library.end()) continue;
      const optimise::CutQuestion q = slot(*c, *card, shop->machine);
      optimise::CutQuestion was = q;
      // The limit of now, eased to what it was.
      const double bears = optimise::fixed_limits(q).deflection_mm;
      was.eased = {"tool_deflection", kWasMm / bears};
      const auto now = optimise::cut(q, {}, job);
      const auto before = optimise::cut(was, {}, job);
      if (!now || !before) continue;
      std::string held;
      for (const auto& a : now->active) held += (held.empty() ? "" : ", ") + named(a.name);
      const auto fz = [](const optimise::CutAnswer& a) {
        return a.feasible ? fixed(a.fz_mm, 4) : std::string("none");
      };
      table.rows.push_back({shortest(k.d_mm), fixed(now->n_rpm, 0), fixed(k.heavy_mm, 3),
                            fixed(k.light_mm, 3), fz(*before), fz(*now), fixed(now->loads.deflection_mm, 3),
                            fixed(bears, 3), held});
      if (now->feasible) most = std::max(most, now->fz_mm / std::max(k.heavy_mm, k.light_mm));
    }
    out.text += std::string(out.text.empty() ? "" : "\n") + material + ":\n\n" + markdown(table);
  }
  out.headline = "no feed above " + fixed(most, 2) + " of a maker's";
  return out;
}

}  // namespace capstan::validation
