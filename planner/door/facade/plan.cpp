#include <map>
#include <optional>
#include <utility>

#include "capstan/capstan.h"
#include "planner/controls/linuxcnc/linuxcnc.h"
#include "planner/door/pipeline/given/shop.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/files/exchange/exchange.h"
#include "planner/files/json/json.h"
#include "planner/ground/base/file.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/physics/motion/time.h"
#include "planner/proof/verify/verify.h"
#include "rules/rules.h"
#include "tooling/library/library.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan {
namespace {

constexpr const char* kDefault = "built-in default";

PlanMessage message_of(const model::Plan& plan, const model::Condemnation& c) {
  return {to_text(Severity::kError), c.code, model::text_of(plan, c)};
}
PlanMessage message(const Diagnostic& d) { return {to_text(d.severity), d.code, to_text(d)}; }

template <class T>
Status pick(const std::map<std::string, T>& of, const std::string& text, const char* what, T& into) {
  if (text.empty()) return {};
  const auto at = of.find(text);
  if (at == of.end()) {
    std::string names;
    for (const auto& [name, value] : of) names += (names.empty() ? "" : ", ") + name;
    return fail(
        {.code = "API-OPTION", .message = std::string(what) + " is '" + text + "'", .expected = names});
  }
  into = at->second;
  return {};
}

Result<pipeline::Policy> policy_of(const PlanOptions& o) {
  using pipeline::Reopen;
  pipeline::Policy policy;
  auto ok = pick<Reopen>({{"operations", Reopen::kOperations},
                          {"tools", Reopen::kTools},
                          {"technology", Reopen::kTechnology},
                          {"all", Reopen::kAll}},
                         o.reopen, "reopen", policy.reopen);
  if (!ok) return tl::unexpected(ok.error());
  return policy;
}

Result<pipeline::Inputs> inputs_of(const PlanOptions& o, Job& job) {
  using pipeline::Objective;
  pipeline::Inputs in;
  auto ok = pick<Objective>(
      {{"time", Objective::kTime}, {"cost", Objective::kCost}, {"profit", Objective::kProfit}}, o.objective,
      "objective", in.objective);
  if (!ok) return tl::unexpected(ok.error());
  std::map<std::string, std::optional<mechanics::MarginPolicy>> margins;
  for (const auto& policy : mechanics::kMarginPolicies) margins.emplace(policy.name, policy);
  ok = pick<std::optional<mechanics::MarginPolicy>>(margins, o.margin, "margin", in.margin);
  if (!ok) return tl::unexpected(ok.error());
  auto feeds = pick<bool>({{"scheduled", false}, {"constant", true}}, o.feeds, "feeds", in.constant_feeds);
  if (!feeds) return tl::unexpected(feeds.error());
  if (o.revenue > 0.0) in.revenue = o.revenue;
  const auto named = [&](const char* what, const std::string& given, const std::string& other) {
    in.provenance.push_back({what, given.empty() ? other : given, given.empty() ? kDefault : "caller"});
    return given.empty() ? other : given;
  };
  auto machine =
      tooling::load_machine(named("machine", o.machine, std::string(tooling::kDefaultMachine)), job);
  if (!machine) return tl::unexpected(machine.error());
  in.machine = *std::move(machine);
  auto library = tooling::load_library(
      named("tools", o.tools, "generic"), job,
      {.mm_per_unit = {}, .offsets_against_reference = in.machine.control.offsets_against_reference});
  if (!library) return tl::unexpected(library.error());
  in.library = *std::move(library);
  auto materials = tooling::shipped_materials();
  if (!materials) return tl::unexpected(materials.error());
  in.materials = *std::move(materials);
  named("rules", o.rules, "shipped tables");
  auto rules = rules::load_rules(o.rules, job);
  if (!rules) return tl::unexpected(rules.error());
  in.rules = *std::move(rules);
  if (!o.material.empty()) {
    if (auto taken = pipeline::name_material(in, o.material, job); !taken)
      return tl::unexpected(taken.error());
    (void)named("material", *in.material_name, "");
  }
  if (o.stock_allowance_mm >= 0.0) in.stock_allowance_mm = o.stock_allowance_mm;
  return in;
}

Result<model::Plan> part_of(std::string bytes, const std::string& name, Job& job) {
  const auto first = bytes.find_first_not_of(" \t\r\n");
  if (first != std::string::npos && bytes[first] == '{') return json::read_json(std::move(bytes), name, job);
  return exchange::read_bytes(std::move(bytes), name, exchange::ReadOptions{}, job);
}

Result<pipeline::Checked> planned(std::string part, const std::string& name, const PlanOptions& o, Job& job) {
  const auto policy = policy_of(o);
  if (!policy) return tl::unexpected(policy.error());
  auto read = part_of(std::move(part), name, job);
  if (!read) return tl::unexpected(read.error());
  const auto inputs = inputs_of(o, job);
  if (!inputs) return tl::unexpected(inputs.error());
  return pipeline::bind_checked(*read, *inputs, *policy, job);
}

void forms(const model::Plan& plan, PlanOutput& out, Job& job) {
  out.json = json::write_json(plan);
  if (auto written = exchange::write_iso14649(plan, job)) {
    out.iso14649 = std::move(written->bytes);
  } else {
    job.report(written.error());
  }
  if (auto written = exchange::write_ap238(plan, job)) {
    out.ap238 = std::move(written->bytes);
  } else {
    job.report(written.error());
  }
  if (plan.steps.empty()) return;
  if (auto text = controls::write_linuxcnc(plan, job)) {
    out.linuxcnc = *std::move(text);
    out.tool_table = controls::write_tool_table(plan);
  } else {
    job.report(text.error());
  }
}

/// Checks the program, with what is known of the plan. One that is condemned is taken back, or written again
/// with its stops and checked as it then is.
void checked(const pipeline::Checked& bound, bool allow_findings, PlanOutput& out, Job& job) {
  const model::Plan& plan = bound.plan;
  const auto add = [&](const std::vector<model::Finding>& findings, const std::string& of) {
    for (const auto& f : findings) {
      const std::string step = f.step.empty() ? std::string() : "step '" + f.step + "': ";
      out.findings.push_back({to_text(f.severity), f.code, of + step + f.message});
    }
  };
  const auto of_program = [&] {
    return verify::check_program({"program", out.linuxcnc, out.tool_table}, &plan, plan.machine, plan.cutters,
                                 job);
  };
  auto all = bound.findings;
  add(all, "");
  std::vector<model::Finding> program;
  if (!out.linuxcnc.empty()) program = of_program();
  all.insert(all.end(), program.begin(), program.end());
  const auto condemned = model::condemned(plan, all);
  for (const auto& c : condemned) out.condemned.push_back(message_of(plan, c));
  if (!condemned.empty() && allow_findings && !model::never_written(condemned) && !out.linuxcnc.empty()) {
    Job silent;  // the writer's warnings are told already
    auto text = controls::write_linuxcnc(plan, silent, condemned);
    out.linuxcnc = text ? *std::move(text) : std::string();
    if (!out.linuxcnc.empty()) program = of_program();
  } else if (!condemned.empty()) {
    out.linuxcnc.clear();
    out.tool_table.clear();
  }
  add(program, "program: ");
}

}  // namespace

PlanOutput plan_bytes(std::string part, const std::string& name, const PlanOptions& options) {
  PlanOutput out;
  Job job;
  job.threads = options.threads == 0 ? 1 : options.threads;
  const auto plan = planned(std::move(part), name, options, job);
  if (plan) {
    out.planned = true;
    out.steps = plan->plan.steps.size();
    out.unplanned = plan->plan.unplanned.size();
    forms(plan->plan, out, job);
    checked(*plan, options.allow_findings, out, job);
    if (const auto t = motion::time_of(plan->plan)) out.time_s = t->total_s();
  } else {
    job.report(plan.error());
  }
  for (const Diagnostic& d : job.diagnostics()) out.diagnostics.push_back(message(d));
  return out;
}

PlanOutput plan_file(const std::string& path, const PlanOptions& options) {
  auto bytes = read_file(path);
  if (bytes) return plan_bytes(*std::move(bytes), path, options);
  PlanOutput out;
  out.diagnostics.push_back(message(bytes.error()));
  return out;
}

}  // namespace capstan
