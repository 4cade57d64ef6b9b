#include "tests/sweep/catalogue.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/vocabulary/cutter_class.h"

// n = vc / (pi D), vf = n z fz and Q = ap ae vf of every maker's formulas (Dormer Pramet, milling catalogue
// 2021-22 p. 210, docs.steelcam.org). vc and fz are the start values that the library states for a generic
// tool and the material's group. Roughing takes ap = D and ae = D / 2, in hardened steel ap = D / 2: Tungaloy
// catalogue 2020-21 p. 1084 (docs.steelcam.org; solid carbide, slotting and roughing at ae = 0.4 D or over:
// ap up to 2 D in steel, cast iron and aluminium, D in stainless steel and titanium, D / 2 in hardened
// steel), Dormer Pramet p. 115 (ae from D / 2 on: no higher feed for thin chips; a slot D deep: 0.75 of the
// feed). Finishing passes run at the same feed, walls as deep as the flute at once, floors in rows of D / 2
// (Tungaloy, same page: ae up to D / 10, ap as long as the edge). A tool is brought down from 20 mm above the
// piece at the rapid of Z, the last 2 mm at its feed, and back. What a machine cannot run at it does not:
// speeds end at its spindle's, feeds at its axes'.

namespace capstan::testing::sweep {
namespace {

using model::Cutter;
using model::CutterClass;

constexpr double kAboveMm = 20.0, kAtFeedMm = 2.0;
constexpr double kWidth = 0.5, kDepth = 1.0, kDepthOfHardened = 0.5;  ///< of the diameter

CutterClass class_of(Work w) {
  switch (w) {
    case Work::kRough:
    case Work::kFinish:
      return CutterClass::kEndmill;
    case Work::kFace:
      return CutterClass::kFacemill;
    case Work::kDrill:
      return CutterClass::kTwistDrill;
    case Work::kReam:
      return CutterClass::kReamer;
    case Work::kTap:
      return CutterClass::kTap;
    case Work::kChamfer:
      return CutterClass::kChamferMill;
    case Work::kBall:
      return CutterClass::kBallEndmill;
  }
  return CutterClass::kEndmill;
}

const model::CuttingPreset* start_of(const Cutter& c, const model::WorkMaterial& m) {
  for (const std::string& name : {m.id, m.iso_group}) {
    for (const auto& p : c.presets)
      if (p.material_group == name && p.vc_m_min > 0.0) return &p;
  }
  return nullptr;
}

/// The one with most teeth of the size; carbide before high-speed steel.
const Cutter* tool_for(const CatalogueWork& w, const std::vector<Cutter>& library,
                       const model::WorkMaterial& m) {
  const Cutter* best = nullptr;
  const auto rank = [](const Cutter& c) {
    return std::pair(c.substrate == model::Substrate::kCarbide, c.teeth);
  };
  for (const Cutter& c : library) {
    if (c.cutter_class != class_of(w.work) || std::abs(c.cutting_diameter_mm - w.diameter_mm) > 1e-6)
      continue;
    if (start_of(c, m) != nullptr && (best == nullptr || rank(c) > rank(*best))) best = &c;
  }
  return best;
}

}  // namespace

double catalogue_s(const std::vector<CatalogueWork>& work, const std::vector<Cutter>& library,
                   const model::WorkMaterial& material, const model::Machine& machine) {
  double total_s = 0.0;
  const Cutter* last = nullptr;
  for (const CatalogueWork& w : work) {
    const Cutter* c = tool_for(w, library, material);
    if (c == nullptr) return 0.0;
    const model::CuttingPreset& p = *start_of(*c, material);
    const double d = c->cutting_diameter_mm;
    const double rpm = std::min(machine.spindle.rpm_max, 1000.0 * p.vc_m_min / (std::numbers::pi * d));
    const auto& axis = machine.axes[w.work == Work::kDrill || w.work == Work::kReam ? 2 : 0];
    const double feed = std::min(axis.feed_max_mm_min, rpm * c->teeth * p.fz_mm);
    double minutes = w.amount / feed;
    if (w.work == Work::kTap) minutes = 2.0 * w.amount / (rpm * c->thread_pitch_mm);
    if (w.work == Work::kRough) {
      const double deepest = (material.iso_group == "H" ? kDepthOfHardened : kDepth) * d;
      minutes = w.amount / (feed * kWidth * d * std::min(w.depth_mm, deepest));
    }
    if (c != last) minutes += 2.0 * kAboveMm / machine.axes[2].rapid_mm_min + kAtFeedMm / feed;
    last = c;
    total_s += 60.0 * minutes;
  }
  return total_s;
}

}  // namespace capstan::testing::sweep
