#include "planner/door/service/explain/computed.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/thread_mill.h"
#include "planner/making/piece/workpiece.h"
#include "planner/making/step/record/expected_by_cases.h"
#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::service {

using model::Plan;

namespace {

/// The chain of factors of the margin: "usual, exp(1 sqrt(ln^2 1.29 + ln^2 1.3 + ln^2 1.15)) of the spread of
/// the coefficients, a worn edge and the feed turned up". The feed's is what the other two leave of the
/// whole, and has to be one that the machine allows: else the plan's card, or what cases say of it, was
/// another than this one, and its factors are not known.
std::string margin_text(const Plan& plan, const StepView& v) {
  const auto margin = piece::margin_said(plan);
  const auto* cutter = model::find_cutter(plan, v.result->cutter_id);
  const double whole = v.result->loads.force_margin;
  if (!margin || cutter == nullptr || !v.operation.set() || !(whole > 1.0))
    return "spread, wear and override together";
  const mechanics::MarginAsked turned_up{.feed_up = std::max(1.0, plan.machine.abilities.feed_override_max)};
  const mechanics::ForceMargin of_card =
      mechanics::is_milled(v.operation.type, *cutter)
          ? mechanics::force_margin(plan.material, cutter->substrate, turned_up)
          : mechanics::kienzle_margin(plan.material, turned_up);
  const double k = margin->deviations;
  const double ln_whole = std::log(whole) / k, ln_spread = std::log(of_card.spread);
  const double ln_wear = std::log(of_card.wear);
  const double rest = ln_whole * ln_whole - ln_spread * ln_spread - ln_wear * ln_wear;
  const double override_up = std::exp(std::sqrt(std::max(0.0, rest)));
  constexpr double kTold = 0.002;  // of the three decimals that are told
  // 1: where the feed cannot be turned up.
  const bool known = rest > -kTold * kTold && (std::abs(override_up - of_card.override_up) <= kTold ||
                                               std::abs(override_up - 1.0) <= kTold);
  if (!known) return "spread, wear and override together, of another card than the plan's";
  return "margin " + margin->name + ", exp(" + trimmed(k, 2) + " sqrt(ln^2 " + trimmed(of_card.spread, 3) +
         " + ln^2 " + trimmed(of_card.wear, 3) + " + ln^2 " + trimmed(override_up, 3) +
         ")) of the spread of the coefficients, a worn edge and the feed turned up";
}

}  // namespace

std::vector<Computed> computed_of(const Plan& plan, const StepView& v) {
  std::vector<Computed> out;
  const auto* r = v.result;
  if (r == nullptr) return out;
  const auto add = [&](std::string name, double value, const std::string& unit, std::string how) {
    if (value != 0.0) out.push_back({std::move(name), trimmed(value, kDecimals) + unit, std::move(how)});
  };
  if (!r->cutter_id.empty()) {
    const auto* c = model::find_cutter(plan, r->cutter_id);
    std::string value = r->cutter_id;
    if (c != nullptr)
      value += " (" + cutter_text(plan, r->cutter_id) + ", T" + std::to_string(c->pocket) + ")";
    out.push_back({"cutter", value, "see its_tool"});
  }
  add("axial_depth", r->axial_depth_mm, " mm", "as cut; the operation's depth divided into equal levels");
  add("radial_depth", r->radial_depth_mm, " mm", "as cut");
  add("spindle_rpm", std::abs(r->spindle_rpm), r->spindle_rpm < 0.0 ? " 1/min, counter-clockwise" : " 1/min",
      "see spindle of its_technology");
  add("vc", r->vc_m_min, " m/min", "pi D n / 1000, D the whole diameter");
  add("feed", r->feed_mm_min, " mm/min",
      "before the schedule along the path; see feedrate of its_technology");
  const auto* cutting = model::find_cutter(plan, r->cutter_id);
  // Makers state that of the edge (mechanics/force/thread_cut.h).
  add("fz", r->fz_mm, " mm",
      cutting != nullptr && model::mills_threads(cutting->cutter_class)
          ? "feed per tooth of the cutter's centre: feed / (teeth n); at the thread's diameter D the edge of "
            "a mill of diameter d goes D / (D - d) times as fast"
          : "feed per tooth: feed / (teeth n)");
  add("peak_force", r->loads.peak_force_n, " N", "largest cutting force along the path");
  const bool milled =
      cutting != nullptr && v.operation.set() && mechanics::is_milled(v.operation.type, *cutting);
  const char* any = milled ? "largest along the path; of a plunge by the area below the cutter's end, whose "
                             "forces across the axis are not in peak_force"
                           : "largest";
  add("torque", r->loads.torque_nm, " Nm", any);
  add("power", r->loads.power_w, " W", any);
  add("deflection", r->loads.deflection_mm, " mm", "of the tip, largest");
  add("chip_thickness", r->loads.chip_thickness_mm, " mm", "largest");
  const auto axes = [](const model::AxisForces& f) {
    return trimmed(f.x_n, 0) + ", " + trimmed(f.y_n, 0) + ", " + trimmed(f.z_n, 0) + " N";
  };
  const auto forces = [&](const char* name, const model::AxisForces& f, const char* how) {
    if (f.x_n != 0.0 || f.y_n != 0.0 || f.z_n != 0.0) out.push_back({name, axes(f), how});
  };
  forces("mean_forces", r->loads.mean_force,
         "along the feed, to its left, away from the work: largest means");
  forces("peak_forces", r->loads.peak_force, "the same, largest at any moment");
  if (cutting != nullptr && v.operation.set() && r->loads.force_margin > 0.0)
    out.push_back({"forces", "by coefficients",
                   mechanics::force_source(plan.material, cutting->substrate, milled)});
  if (r->loads.force_margin > 0.0) {
    const char* what = "of a sharp edge with mean coefficients at the planned feed: what a load meter shows";
    add("expected_force", r->loads.peak_force_n / r->loads.force_margin, " N", what);
    // Where a measured set gives the forces, power may be the card's, whose margin is another.
    if (!milled || mechanics::measured_set(plan.material, cutting->substrate) == nullptr)
      add("expected_power", r->loads.power_w / r->loads.force_margin, " W", what);
  }
  add("force_margin", r->loads.force_margin, "",
      "factor in these loads on the expected ones of a sharp edge: " + margin_text(plan, v));
  add("wall_error", r->loads.wall_error_mm, " mm", "that bending leaves on the wall; above 0: material");
  add("surface_rz", 1000.0 * r->loads.surface_rz_mm, " um", "feed marks by geometry alone");
  add("edge_life", r->loads.tool_life_min, " min", "cutting time of an edge at this speed and feed");
  add("removal_rate", r->loads.mrr_mm3_min, " mm3/min", "largest");
  if (r->cutting_s + r->rapid_s > 0.0) {
    out.push_back({"time", duration(r->cutting_s + r->rapid_s),
                   "cutting " + duration(r->cutting_s) + ", rapids " + duration(r->rapid_s)});
  }
  for (const auto& [name, what] :
       {std::pair{"time_by_cases", step::time_row_of(v.id)}, {"bore_by_cases", step::bore_row_of(v.id)}}) {
    if (const auto* row = step::row_of(plan, what)) out.push_back({name, row->value, row->source});
  }
  return out;
}

}  // namespace capstan::service
