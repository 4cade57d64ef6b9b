#include "planner/door/pipeline/stages.h"

#include <algorithm>
#include <utility>

#include "planner/making/given/open_tools.h"
#include "planner/making/propose/shared_tools.h"
#include "tooling/library/cutters/generic.h"

namespace capstan::pipeline {
namespace {

/// The cutters that may be used: the library, or what of it is loaded, which `loaded` keeps.
const std::vector<model::Cutter>& usable(const Asked& asked, std::vector<model::Cutter>& loaded) {
  if (!asked.policy.only_loaded_cutters) return asked.inputs.library;
  for (const auto& c : asked.inputs.library) {
    if (c.loaded) loaded.push_back(c);
  }
  return loaded;
}

}  // namespace

std::vector<model::Edit> restrictions_of(const Inputs& inputs) {
  std::vector<model::Edit> out = inputs.edits;
  out.insert(out.end(), inputs.kept_off.begin(), inputs.kept_off.end());
  return out;
}

const std::vector<model::Edit>* edits_of(const Inputs& inputs) {
  return inputs.edits.empty() ? nullptr : &inputs.edits;
}

double grown_mm(const Inputs& inputs) { return inputs.stock_allowance_mm.value_or(0.0); }

optimise::Options options_of(const Inputs& inputs) {
  optimise::Options out;
  out.solver = inputs.solver;
  out.backends = inputs.backends;
  return out;
}

namespace {

piece::WorkpieceWish wish_of(const Inputs& inputs) {
  return {inputs.material_name, inputs.materials, inputs.stock, inputs.stock_allowance_mm, inputs.margin};
}

}  // namespace

Result<model::WorkMaterial> material_of(const model::Plan& plan, const Inputs& inputs, Job& job) {
  return piece::material_of(plan, wish_of(inputs), job);
}

Status take_start_values(const model::WorkMaterial& card, std::vector<model::Cutter>& cutters) {
  return tooling::add_start_values(card, cutters);
}

Result<Resolved> resolve_workpiece(const model::Plan& plan, const Inputs& inputs, Job& job) {
  const piece::WorkpieceWish wish = wish_of(inputs);
  auto material = piece::material_of(plan, wish, job);
  if (!material) return tl::unexpected(material.error());
  auto margin = piece::margin_of(plan, wish, job);
  if (!margin) return tl::unexpected(margin.error());
  auto raw = piece::raw_piece_of(plan, wish, job);
  if (!raw) return tl::unexpected(raw.error());
  return Resolved{*std::move(material), *std::move(raw), *std::move(margin)};
}

Result<Required> take_requirements(const model::Plan& plan, const Asked& asked, piece::StatedShapes stated,
                                   Job& job) {
  const Inputs& inputs = asked.inputs;
  auto demands = piece::demands_of(plan, inputs.general_tolerance, inputs.edge_break_mm, inputs.batch, job);
  if (!demands) return tl::unexpected(demands.error());
  return Required{*std::move(demands),
                  piece::shapes_of_all(plan, std::move(stated), grown_mm(inputs), asked.bans, job)};
}

step::Wishes wishes_of(const Asked& asked) {
  const Inputs& inputs = asked.inputs;
  return {inputs.objective,   asked.earning_per_min, asked.margin.deviations, inputs.constant_feeds,
          inputs.cases.get(), inputs.library,        edits_of(inputs)};
}

std::size_t cut_before(const Asked& asked, const Drafts& drafts) {
  return asked.policy.window ? std::min(asked.policy.window->first, drafts.steps.size()) : 0;
}

Drafted propose_missing(model::Plan plan, Drafts drafts, const Required& required, const Asked& asked,
                        Job& job) {
  std::vector<model::Cutter> loaded;
  const std::vector<model::Cutter>& cutters = usable(asked, loaded);
  const optimise::Options options = options_of(asked.inputs);
  const piece::Piece piece{plan, required.shapes, grown_mm(asked.inputs)};
  const propose::Choice choice{piece,
                               cutters,
                               asked.bans,
                               options,
                               asked.margin.deviations,
                               required.demands.batch,
                               asked.inputs.cases.get(),
                               asked.thrift,
                               edits_of(asked.inputs)};
  const propose::Sources sources{asked.inputs.rules, required.demands, asked.unreadable, choice,
                                 asked.policy.reopen >= Reopen::kOperations};
  auto made = propose::propose_missing(plan, std::move(drafts), sources, job);
  Learned learned;
  learned.left_out = std::move(made.left_out);
  learned.again = made.again;
  if (made.full && asked.thrift != propose::Thrift::kChains) {
    learned.thrift =
        asked.thrift == propose::Thrift::kNone ? propose::Thrift::kShared : propose::Thrift::kChains;
    learned.left_out.clear();  // with other tools they may be made
    learned.again = true;
  }
  return {std::move(plan), std::move(made.drafts), std::move(learned)};
}

Drafted select_open_tools(model::Plan plan, Drafts drafts, const Required& required, const Asked& asked,
                          Job& job) {
  std::vector<model::Cutter> loaded;
  const std::vector<model::Cutter>& cutters = usable(asked, loaded);
  const std::vector<model::Cutter>& library = asked.inputs.library;
  const std::vector<model::Edit> restrictions = restrictions_of(asked.inputs);
  const piece::Piece piece{plan, required.shapes, grown_mm(asked.inputs)};
  const given::Choice choice{library,
                             cutters,
                             asked.inputs.rules,
                             piece,
                             required.demands,
                             asked.recorded.cutters,
                             asked.inputs.tool_materials,
                             asked.inputs.holders,
                             asked.inputs.cases.get(),
                             restrictions.empty() ? nullptr : &restrictions};
  given::select_open_tools(plan, drafts.steps, drafts.used, drafts.needed, choice, job);
  drafts.used = propose::share_tools(
      plan, drafts.steps,
      {propose::magazine_known(library), required.demands.batch, asked.thrift, /*back=*/true});
  given::stand_out_alike(drafts.steps);
  return {std::move(plan), std::move(drafts)};
}

Result<workholding::Held> hold_workpieces(const model::Plan& plan, const Drafts& drafts, const Asked& asked,
                                          Job& job) {
  const bool asked_now = std::any_of(
      plan.provenance.begin(), plan.provenance.end(),
      [](const model::Provenance& p) { return p.what == "workholding" && p.source == "--workholding"; });
  return workholding::hold(
      plan, drafts.setups, drafts.steps,
      {asked.inputs.workholding, asked_now, asked.recorded.holdings, asked.inputs.own_fixtures}, job);
}

}  // namespace capstan::pipeline
