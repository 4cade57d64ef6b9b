#include "planner/door/service/explain/tables.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "planner/door/report/tool_use.h"
#include "planner/door/service/explain/values.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/model/plan/cutter/generic_holder.h"
#include "planner/model/plan/resources/setup_position.h"

namespace capstan::service {
namespace {

using model::Plan;
using Rows = std::vector<std::vector<std::string>>;

std::string positive(double v, int decimals) { return v > 0.0 ? trimmed(v, decimals) : "-"; }

/// "1 to 6", "3", "1 to 2, 5": the numbers of the steps of a set-up, from 1.
std::string steps_in(const Plan& plan, std::size_t setup) {
  std::string out;
  for (std::size_t n = 0; n < plan.steps.size(); ++n) {
    if (plan.steps[n].setup != setup) continue;
    const std::size_t from = n;
    while (n + 1 < plan.steps.size() && plan.steps[n + 1].setup == setup) ++n;
    out += (out.empty() ? "" : ", ") + std::to_string(from + 1);
    if (n > from) out += " to " + std::to_string(n + 1);
  }
  return out.empty() ? "none" : out;
}

std::optional<double> least_z(const Plan& plan, std::size_t setup) {
  std::optional<double> out;
  for (const model::StepResult& s : plan.steps) {
    if (s.setup != setup || s.path == nullptr || s.path->size() == 0) continue;
    const double z = model::bounds(*s.path).lo.z;
    out = out ? std::min(*out, z) : z;
  }
  return out;
}

}  // namespace

std::string setups_text(const Plan& plan) {
  Rows rows;
  for (std::size_t n = 0; n < plan.setups.size(); ++n) {
    const model::SetupResult& s = plan.setups[n];
    const geometry::Placement piece = model::placed_in(plan, n);
    bool first = true;
    const auto row = [&](const char* what, const std::string& text) {
      if (text.empty()) return;
      rows.push_back({first ? std::to_string(n + 1) : "", what, text});
      first = false;
    };
    const std::string zero = model::zero_text(plan.stock.box, piece, 3);
    row("zero", s.work_offset + (zero.empty() ? "" : ": " + zero));
    row("lies", model::axis_text(piece, {0.0, 0.0, 1.0}) + " up, " +
                    model::axis_text(piece, {1.0, 0.0, 0.0}) + " to the right" +
                    (n == 0 ? "" : "; " + model::turn_text(model::placed_in(plan, n - 1), piece)));
    row("pick-up", s.holding.pickup_text);
    row("held by", s.holding.id.empty()
                       ? "not stated: fixtures and clamps are not checked"
                       : s.holding.id + (s.holding.description.empty() ? "" : ", " + s.holding.description));
    row("security plane", "Z " + trimmed(s.security_z_mm, 3));
    const auto z = least_z(plan, n);
    row("steps", steps_in(plan, n) + (z ? ", least Z " + trimmed(*z, 3) : ""));
  }
  return rows.empty() ? std::string() : "\nSet-ups, in order\n" + table(rows);
}

std::string tools_text(const Plan& plan) {
  if (plan.cutters.empty()) return {};
  Rows rows = {{"T", "tool", "kind", "made of", "D mm", "R mm", "teeth", "flutes mm", "stick-out mm",
                "length mm", "least Z", "edge used, of its life"}};
  const auto held = [](const model::Cutter& c) { return !model::stated_holder(c).empty(); };
  const bool named = std::any_of(plan.cutters.begin(), plan.cutters.end(), held);
  if (named) rows.front().emplace_back("holder");
  for (const model::Cutter& c : plan.cutters) {
    const report::ToolUse use = report::use_of(plan, c);
    const double used = use.used_before_min + use.used_min;
    rows.push_back(
        {c.pocket > 0 ? std::to_string(c.pocket) : "-", c.id, std::string(model::words_of(c.cutter_class)),
         std::string(model::to_text(c.substrate)), trimmed(c.cutting_diameter_mm, 3),
         positive(c.corner_radius_mm, 3), c.teeth > 0 ? std::to_string(c.teeth) : "-",
         positive(c.maximum_depth_of_cut_mm, 2), positive(c.stick_out_mm, 2),
         positive(c.functional_length_mm, 3), use.least_z_mm ? trimmed(*use.least_z_mm, 3) : "-",
         trimmed(used, 2) + (use.life_min > 0.0 ? " of " + trimmed(use.life_min, 1) : "") + " min"});
    if (named) rows.back().push_back(held(c) ? c.holder_id : "assumed");
  }
  return "\nTools; a length offset H has the number of its tool\n" + table(rows);
}

}  // namespace capstan::service
