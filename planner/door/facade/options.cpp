#include "planner/door/facade/options.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "planner/door/service/options.h"
#include "planner/door/service/shop_file/shop_file.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/number.h"
#include "planner/making/optimise/solver/solvers.h"

namespace capstan::facade {
namespace {

/// An option of the service, and its field as text; empty: it is not given.
struct Field {
  std::string_view name;
  std::string (*text)(const PlanOptions& o);
};

/// A number in the service's form. The service refuses a number that is not finite like any other text.
std::string number(double v) { return std::isfinite(v) ? shortest(v) : "not finite"; }
/// Where a number below it means none, too.
std::string above_zero(double v) { return v <= 0.0 ? std::string() : number(v); }
std::string unless_zero(double v) { return v == 0.0 ? std::string() : number(v); }
std::string flag(bool v) { return v ? "yes" : ""; }

/// An option that may be repeated, and its field.
struct ListField {
  std::string_view name;
  const std::vector<std::string> PlanOptions::*texts;
};
constexpr std::array kListFields = {
    ListField{"set", &PlanOptions::set},     ListField{"pin", &PlanOptions::pin},
    ListField{"limit", &PlanOptions::limit}, ListField{"forbid", &PlanOptions::forbid},
    ListField{"order", &PlanOptions::order}, ListField{"tapped", &PlanOptions::tapped},
    ListField{"draw", &PlanOptions::draw},
};

constexpr std::array kFields = {
    Field{"machine", [](const PlanOptions& o) { return o.machine; }},
    Field{"control", [](const PlanOptions& o) { return o.control; }},
    Field{"tools", [](const PlanOptions& o) { return o.tools; }},
    Field{"material", [](const PlanOptions& o) { return o.material; }},
    Field{"stock",
          [](const PlanOptions& o) {
            if (!o.stock.empty() || o.stock_allowance_mm < 0.0) return o.stock;
            return "block:+" + number(o.stock_allowance_mm);
          }},
    Field{"mesh-unit", [](const PlanOptions& o) { return o.mesh_unit; }},
    Field{"body", [](const PlanOptions& o) { return o.body; }},
    Field{"features-only", [](const PlanOptions& o) { return flag(o.features_only); }},
    Field{"objective", [](const PlanOptions& o) { return o.objective; }},
    Field{"margin", [](const PlanOptions& o) { return o.margin; }},
    Field{"revenue", [](const PlanOptions& o) { return above_zero(o.revenue); }},
    Field{"feeds", [](const PlanOptions& o) { return o.feeds; }},
    Field{"rules", [](const PlanOptions& o) { return o.rules; }},
    Field{"cases", [](const PlanOptions& o) { return o.cases; }},
    Field{"cache", [](const PlanOptions& o) { return o.cache; }},
    Field{"solver", [](const PlanOptions& o) { return o.solver; }},
    Field{"workholding", [](const PlanOptions& o) { return o.workholding; }},
    Field{"general-tolerance", [](const PlanOptions& o) { return o.general_tolerance; }},
    Field{"assume", [](const PlanOptions& o) { return o.assume; }},
    Field{"may", [](const PlanOptions& o) { return o.may; }},
    Field{"time", [](const PlanOptions& o) { return o.time; }},
    Field{"batch", [](const PlanOptions& o) { return std::to_string(o.batch); }},
    Field{"edges",
          [](const PlanOptions& o) { return o.edge_break_mm == 0.0 ? "" : number(o.edge_break_mm); }},
    Field{"shop", [](const PlanOptions& o) { return o.shop; }},
    Field{"edits", [](const PlanOptions& o) { return o.edits; }},
    Field{"bind", [](const PlanOptions& o) { return o.bind; }},
    Field{"reopen", [](const PlanOptions& o) { return o.reopen; }},
    Field{"deadline", [](const PlanOptions& o) { return o.deadline; }},
    Field{"next", [](const PlanOptions& o) { return o.next == 0 ? "" : std::to_string(o.next); }},
    Field{"from", [](const PlanOptions& o) { return o.from == 0 ? "" : std::to_string(o.from); }},
    Field{"stop-at-deadline", [](const PlanOptions& o) { return flag(o.stop_at_deadline); }},
    Field{"measured", [](const PlanOptions& o) { return o.measured; }},
    Field{"spindle-power", [](const PlanOptions& o) { return unless_zero(o.spindle_power_kw); }},
    Field{"tool-state", [](const PlanOptions& o) { return o.tool_state; }},
    Field{"axis-limits", [](const PlanOptions& o) { return o.axis_limits; }},
    Field{"work-offset", [](const PlanOptions& o) { return o.work_offset; }},
    Field{"feed-override",
          [](const PlanOptions& o) { return o.feed_override == 0 ? "" : std::to_string(o.feed_override); }},
    Field{"strict", [](const PlanOptions& o) { return flag(o.strict); }},
    Field{"allow-findings", [](const PlanOptions& o) { return flag(o.allow_findings); }},
    Field{"without", [](const PlanOptions& o) { return o.without; }},
    Field{"profile", [](const PlanOptions& o) { return o.profile; }},
    Field{"schema", [](const PlanOptions& o) { return flag(o.schema); }},
    Field{"threads", [](const PlanOptions& o) { return std::to_string(std::clamp(o.threads, 1U, 256U)); }},
};

}  // namespace

Result<service::Request> request_of(const PlanOptions& options) {
  service::Request request;
  request.sign.clear();
  request.backends = optimise::all_backends();
  for (const Field& field : kFields) {
    const std::string text = field.text(options);
    if (text.empty()) continue;
    if (auto ok = service::set(request, field.name, text); !ok) return tl::unexpected(ok.error());
  }
  for (const ListField& field : kListFields) {
    for (const std::string& text : options.*field.texts) {
      if (auto ok = service::set(request, field.name, text); !ok) return tl::unexpected(ok.error());
    }
  }
  if (std::string wrong = service::contradiction(request); !wrong.empty())
    return fail({.code = "OPTION-VALUE", .message = std::move(wrong)});
  Job job;
  return service::with_shop(std::move(request), job);
}

std::vector<std::string> option_names() {
  std::vector<std::string> out;
  for (const Field& field : kFields) out.emplace_back(field.name);
  for (const ListField& field : kListFields) out.emplace_back(field.name);
  return out;
}

}  // namespace capstan::facade
