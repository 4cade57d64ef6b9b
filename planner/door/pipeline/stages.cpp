#include <algorithm>

#include "planner/door/pipeline/work.h"
#include "planner/making/piece/workpiece.h"

// The stages whose work is done in rooms of `making`: what they read, and where their results go.

namespace capstan::pipeline {

Status resolve_workpiece(Work& w) {
  const piece::WorkpieceWish wish{w.inputs.material_name, w.inputs.materials, w.inputs.stock,
                                  w.inputs.stock_allowance_mm, w.inputs.margin};
  auto material = piece::material_of(w.plan, wish, w.job);
  if (!material) return tl::unexpected(material.error());
  w.plan.material = *std::move(material);
  w.plan.machine = w.inputs.machine;
  auto margin = piece::margin_of(w.plan, wish, w.job);
  if (!margin) return tl::unexpected(margin.error());
  w.margin = margin->policy;
  // What else the plan was made with before is said anew.
  w.plan.provenance = w.inputs.provenance;
  w.plan.provenance.push_back(std::move(margin->said));
  auto raw = piece::raw_piece_of(w.plan, wish, w.job);
  if (!raw) return tl::unexpected(raw.error());
  w.plan.stock = *std::move(raw);
  if (w.inputs.stock) piece::state_raw_piece(w.plan.model, w.plan.stock.box);
  return {};
}

Status take_requirements(Work& w) {
  auto demands = piece::demands_of(w.plan, w.inputs.general_tolerance, w.inputs.edge_break_mm,
                                   w.inputs.batch, w.job);
  if (!demands) return tl::unexpected(demands.error());
  w.demands = *std::move(demands);
  if (w.demands.general)
    w.plan.provenance.push_back({"general tolerance", w.demands.general->text, w.demands.general_from});
  w.shapes =
      piece::shapes_of_all(w.plan, w.inputs.stock_allowance_mm.value_or(0.0), w.tries.bans, w.job);
  return {};
}

}  // namespace capstan::pipeline
