#include "planner/door/app/files/inputs.h"

#include <algorithm>
#include <string>

#include "planner/door/pipeline/given/shop.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/making/optimise/solver/ipopt_backend.h"
#include "rules/rules.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/library.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

namespace capstan::app {
namespace {

constexpr const char* kDefault = "built-in default";

std::string objective_text(pipeline::Objective o) {
  switch (o) {
    case pipeline::Objective::kTime:
      return "time";
    case pipeline::Objective::kCost:
      return "cost";
    case pipeline::Objective::kProfit:
      return "profit";
  }
  return "time";
}

/// What the plan says it was made with under that name, or null.
const model::Provenance* made_with(const model::Plan& plan, std::string_view what) {
  for (const auto& p : plan.provenance) {
    if (p.what == what) return &p;
  }
  return nullptr;
}

Status material_of(const InputOptions& o, const model::Plan& plan, pipeline::Inputs& in, Job& job) {
  auto& p = in.provenance;
  if (o.material) {
    if (auto ok = pipeline::name_material(in, *o.material, job); !ok) return ok;
    p.push_back({"material", *in.material_name,
                 *in.material_name == *o.material ? "--material" : "--material " + *o.material});
    return {};
  }
  const auto* before = made_with(plan, "material");
  if (before == nullptr) return {};
  in.material_of_plan = true;
  const bool shipped = std::any_of(in.materials.begin(), in.materials.end(),
                                   [&](const auto& m) { return m.id == before->value; });
  if (!shipped && plan.material.id == before->value) {
    // A shop's own: the plan has what its file said.
    if (auto ok = pipeline::name_material(in, plan.material); !ok) return ok;
  } else {
    in.material_name = before->value;
  }
  p.push_back(*before);
  return {};
}

/// The option that a plan was made with still holds when it is planned again, unless another is given.
void choices(const InputOptions& o, const model::Plan& plan, pipeline::Inputs& in) {
  auto& p = in.provenance;
  in.stock = o.stock;
  in.stock_allowance_mm = o.stock_allowance_mm;
  if (!o.stock_text.empty()) {
    p.push_back({"stock", o.stock_text, "--stock"});
  } else if (const auto* before = made_with(plan, "stock"); before != nullptr && !plan.stock.box.empty()) {
    in.stock = plan.stock.box;
    in.stock_of_plan = true;
    p.push_back(*before);
  }
  in.objective = o.objective.value_or(pipeline::Objective::kTime);
  p.push_back({"objective", objective_text(in.objective), o.objective ? "--objective" : kDefault});
  if (o.margin) in.margin = mechanics::margin_policy(*o.margin);
  in.revenue = o.revenue;
  if (o.revenue) p.push_back({"revenue", trimmed(*o.revenue, 4) + " a piece", "--revenue"});
  const auto carried = [&](const char* what, const std::optional<std::string>& given, std::string& into) {
    if (given) {
      into = *given;
      p.push_back({what, into, std::string("--") + what});
    } else if (const auto* before = made_with(plan, what)) {
      into = before->value;
      constexpr std::string_view kKept = ", of the plan";
      p.push_back({what, into,
                   before->source.ends_with(kKept) ? before->source : before->source + std::string(kKept)});
    }
  };
  carried("general-tolerance", o.general_tolerance, in.general_tolerance);
  carried("workholding", o.workholding, in.workholding);
  std::string feeds = "scheduled";
  carried("feeds", o.feeds, feeds);
  in.constant_feeds = feeds == "constant";
  in.batch = o.batch;
  if (o.batch > 1) p.push_back({"batch", std::to_string(o.batch), "--batch"});
  in.edge_break_mm = o.edge_break_mm;
  if (o.edge_break_mm > 0.0) p.push_back({"edges", trimmed(o.edge_break_mm, 4) + " mm", "--edges"});
  in.solver = o.solver.value_or(optimise::Solver::kNlopt);
  p.push_back({"solver", in.solver == optimise::Solver::kIpopt ? "ipopt" : "nlopt",
               o.solver ? "--solver" : kDefault});
}

Status machine_of(const InputOptions& o, const model::Plan& plan, pipeline::Inputs& in, Job& job) {
  const auto shipped = tooling::shipped_machines();
  const bool known = std::find(shipped.begin(), shipped.end(), plan.machine.id) != shipped.end();
  const auto* before = made_with(plan, "machine");
  if (!o.machine && has_data(plan.machine)) {
    in.machine = plan.machine;
    in.provenance.push_back(
        before != nullptr ? *before : model::Provenance{"machine", in.machine.id, "the plan's own"});
    return {};
  }
  const bool named = !o.machine && known;
  if (!o.machine && !named && !plan.machine.id.empty()) {
    Diagnostic d = unknown_name("machine", plan.machine.id, shipped, "capstan machines list");
    d.file = plan.file_name;
    d.hint = "the plan was made for it and does not hold its data: name one with --machine; " + d.hint;
    return fail(std::move(d));
  }
  auto machine = tooling::load_machine(o.machine ? *o.machine
                                       : named   ? plan.machine.id
                                                 : std::string(tooling::kDefaultMachine),
                                       job);
  if (!machine) return tl::unexpected(machine.error());
  in.machine = *std::move(machine);
  if (named && before != nullptr) {
    in.provenance.push_back(*before);
  } else {
    in.provenance.push_back({"machine", in.machine.id, o.machine ? "--machine " + *o.machine : kDefault});
  }
  return {};
}

}  // namespace

bool has_data(const model::Machine& machine) { return !machine.axes[0].name.empty(); }

Result<pipeline::Inputs> gather(const InputOptions& o, const model::Plan& plan, Job& job) {
  pipeline::Inputs in;
  if (auto ok = machine_of(o, plan, in, job); !ok) return tl::unexpected(ok.error());

  auto library = tooling::load_library(
      o.tools.value_or("generic"), job,
      {.mm_per_unit = {}, .offsets_against_reference = in.machine.control.offsets_against_reference});
  if (!library) return tl::unexpected(library.error());
  in.library = *std::move(library);
  in.provenance.push_back(
      {"tools", o.tools.value_or("generic") + ", " + std::to_string(in.library.size()) + " cutters",
       o.tools ? "--tools " + *o.tools : kDefault});

  auto materials = tooling::shipped_materials();
  if (!materials) return tl::unexpected(materials.error());
  in.materials = *std::move(materials);
  in.provenance.push_back(
      {"materials", "shipped table, " + std::to_string(in.materials.size()) + " materials", kDefault});

  auto rules = rules::load_rules(o.rules.value_or(""), job);
  if (!rules) return tl::unexpected(rules.error());
  in.rules = *std::move(rules);
  in.provenance.push_back({"rules",
                           o.rules ? "shipped tables and " + *o.rules : std::string("shipped tables"),
                           o.rules ? "--rules " + *o.rules : kDefault});

  in.backends.ipopt = &optimise::solve_with_ipopt;
  if (auto ok = material_of(o, plan, in, job); !ok) return tl::unexpected(ok.error());
  choices(o, plan, in);
  return in;
}

}  // namespace capstan::app
