#include "casebase/recall/evidence.h"

#include <algorithm>
#include <optional>

#include "casebase/record/failing.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase {
namespace {

double value_of(const std::optional<Figure>& f) { return f ? f->value : 0.0; }

Blame blame_of(const Case& c) {
  Blame out;
  if (value_of(c.observed.wear_mm) >= kWornMm) out.speed = true;
  if (value_of(c.observed.breakage) >= kBroken) out.feed = out.depth = true;
  if (value_of(c.observed.chatter) >= kHeavyChatter) out.depth = true;
  if (out == Blame{}) out.speed = out.feed = true;
  return out;
}

/// Figures that, equal in two cases, make them one cut though part or time differ. Fewer are often equal: the
/// times of repeats in whole seconds. Default, unsourced.
constexpr int kTellsAlone = 3;

/// Empty where nothing was observed: two cuts by the same values are two cuts then. Figures that were
/// computed are the same for every cut by a plan, and tell of none that was made.
std::string told_of(const Case& c) {
  const Observed& o = c.observed;
  std::string out;
  int figures = 0;
  for (const auto* f :
       {&o.time_s, &o.spindle_load_percent, &o.peak_force_n, &o.torque_nm, &o.power_w, &o.size_deviation_mm,
        &o.position_deviation_mm, &o.lag_mm, &o.surface_ra_um, &o.wear_mm}) {
    out += '/';
    if (!*f || ((*f)->origin == Origin::kSimulated && c.origin != Origin::kSimulated)) continue;
    ++figures;
    out += shortest((*f)->value);
  }
  if (figures == 0) return {};
  if (figures < kTellsAlone) out += '\n' + c.from.part + '\n' + c.from.time_utc;
  for (const double v : {c.bound.vc_m_min, c.bound.fz_mm, c.bound.ap_mm, c.bound.ae_mm, c.asked.diameter_mm,
                         c.asked.depth_mm, c.asked.width_mm, c.asked.cutter_diameter_mm})
    out += '/' + shortest(v);
  return out + '/' + std::string(to_text(o.verdict)) + '/' + std::string(to_text(c.origin));
}

}  // namespace

Evidence evidence_of(const Case& c, double distance, double cutter_diameter_mm) {
  Evidence out;
  out.id = c.id;
  out.run = c.from.source + '\n' + c.from.part + '\n' + c.from.workingstep + '\n' + c.from.time_utc;
  out.told = told_of(c);
  out.origin = c.origin;
  out.verdict = c.observed.verdict;
  out.blame = blame_of(c);
  out.distance = distance;
  out.cut = {c.bound.vc_m_min, c.bound.fz_mm, c.bound.ap_mm, c.bound.ae_mm};
  const double theirs = c.asked.cutter_diameter_mm;
  if (theirs > 0.0 && cutter_diameter_mm > 0.0) out.cut.fz_mm *= std::min(1.0, cutter_diameter_mm / theirs);
  return out;
}

}  // namespace capstan::casebase
