#include "casebase/recall/evidence.h"

#include <algorithm>

#include "planner/ground/base/number.h"

namespace capstan::casebase {
namespace {

/// Flank wear that ends a tool's life, mm: ISO 8688-2:1989 (uniform wear of end mills).
constexpr double kWornMm = 0.3;

Origin origin_of(const std::string& provenance) {
  for (const Origin o : {Origin::kMeasured, Origin::kEntered}) {
    if (provenance == to_text(o)) return o;
  }
  return Origin::kSimulated;
}

Verdict verdict_of(const std::string& verdict) {
  for (const Verdict v : {Verdict::kGood, Verdict::kBad}) {
    if (verdict == to_text(v)) return v;
  }
  return Verdict::kUnknown;
}

/// Empty where nothing was observed: two cuts with the same values are two cuts then.
std::string told_of(const Case& c) {
  std::string out;
  bool any = false;
  for (const double v : {c.cycle_s, c.peak_force_n, c.surface_ra_um, c.deviation_mm, c.wear_mm}) {
    any = any || v != 0.0;
    out += '/' + shortest(v);
  }
  if (!any) return {};
  for (const double v : {c.vc_m_min, c.fz_mm, c.ap_mm, c.ae_mm, c.cutting_diameter_mm, c.asked.diameter_mm,
                         c.asked.depth_mm, c.asked.width_mm, c.asked.tolerance_mm})
    out += '/' + shortest(v);
  return out + '/' + c.verdict + '/' + c.provenance;
}

}  // namespace

std::string_view to_text(Origin o) {
  return o == Origin::kMeasured ? "measured" : o == Origin::kEntered ? "entered" : "simulated";
}

std::string_view to_text(Verdict v) {
  return v == Verdict::kGood ? "good" : v == Verdict::kBad ? "bad" : "unknown";
}

Evidence evidence_of(const Case& c, double distance, double cutter_diameter_mm) {
  Evidence out;
  out.id = c.id;
  out.run = c.source;
  out.told = told_of(c);
  out.origin = origin_of(c.provenance);
  out.verdict = verdict_of(c.verdict);
  out.blame = c.wear_mm >= kWornMm ? Blame{.speed = true} : Blame{.speed = true, .feed = true};
  out.distance = distance;
  out.cut = {c.vc_m_min, c.fz_mm, c.ap_mm, c.ae_mm};
  if (cutter_diameter_mm > 0.0 && c.cutting_diameter_mm > 0.0)
    out.cut.fz_mm *= std::min(1.0, cutter_diameter_mm / c.cutting_diameter_mm);
  return out;
}

}  // namespace capstan::casebase
