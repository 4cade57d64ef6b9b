#include "planner/app/files/inputs.h"

#include <string>

#include "planner/base/number.h"
#include "planner/optimise/solver/ipopt_backend.h"
#include "rules/rules.h"
#include "tooling/catalogue/generic.h"
#include "tooling/catalogue/library.h"
#include "tooling/catalogue/machine.h"
#include "tooling/catalogue/material.h"

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

void name_choices(const InputOptions& o, pipeline::Inputs& in) {
  auto& p = in.provenance;
  if (o.material) p.push_back({"material", *o.material, "--material"});
  if (!o.stock_text.empty()) p.push_back({"stock", o.stock_text, "--stock"});
  p.push_back({"objective", objective_text(in.objective), o.objective ? "--objective" : kDefault});
  p.push_back({"solver", in.solver == optimise::Solver::kIpopt ? "ipopt" : "nlopt",
               o.solver ? "--solver" : kDefault});
}

}  // namespace

Result<pipeline::Inputs> gather(const InputOptions& o, Job& job) {
  pipeline::Inputs in;
  auto machine = tooling::load_machine(o.machine.value_or(std::string(tooling::kDefaultMachine)), job);
  if (!machine) return tl::unexpected(machine.error());
  in.machine = *std::move(machine);
  in.provenance.push_back({"machine", in.machine.id, o.machine ? "--machine " + *o.machine : kDefault});

  auto library = tooling::load_library(o.tools.value_or("generic"), job);
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

  in.material_name = o.material;
  in.stock = o.stock;
  in.stock_allowance_mm = o.stock_allowance_mm;
  in.objective = o.objective.value_or(pipeline::Objective::kTime);
  in.solver = o.solver.value_or(optimise::Solver::kNlopt);
  in.backends.ipopt = &optimise::solve_with_ipopt;
  name_choices(o, in);
  return in;
}

}  // namespace capstan::app
