#include "planner/model/in_piece.h"

#include <algorithm>

#include "planner/pipeline/work.h"

// Features that the raw piece does not let be made as they are drawn.

namespace capstan::pipeline {
namespace {

using model::FeatureShape;
using model::ShapeKind;

model::PieceForm raw_piece(const Work& w) { return {w.plan.stock.box, w.plan.stock.cylinder_radius_mm}; }

/// All features, each once: elements and bosses count with what holds them.
std::vector<FeatureShape> whole_features(const Work& w) {
  const std::set<AnyRef> parts = parts_of_others(w.plan.model);
  std::vector<FeatureShape> out;
  std::copy_if(w.shapes.begin(), w.shapes.end(), std::back_inserter(out),
               [&](const FeatureShape& s) { return !parts.contains(s.feature); });
  return out;
}

}  // namespace

std::string not_in_piece(const Work& w, const FeatureShape& s) {
  if (w.plan.target_mesh) return {};
  const model::PieceForm part{part_box(w), w.plan.stock.cylinder_radius_mm};
  if (const std::string through = model::point_runs_through(s, raw_piece(w), part); !through.empty())
    return through;
  const std::vector<FeatureShape> all = whole_features(w);
  if (model::buried(s, {}, part)) {
    if (const auto lid = model::buried(s, all, part)) return "solid stands above it: " + model::to_text(*lid);
  }
  return model::square_corner(w.plan.model, s, all, part);
}

model::Proposal without_drills_at_edges(const Work& w, const FeatureShape& hole, const model::Proposal& p) {
  model::Proposal out = p;
  const std::string why = model::cuts_an_edge(hole, raw_piece(w));
  if (why.empty()) return out;
  std::erase_if(out.chains, [](const std::vector<model::ProposedStep>& chain) {
    return std::any_of(chain.begin(), chain.end(), [](const model::ProposedStep& s) {
      return model::is_a(s.operation, model::TypeId::kDrillingTypeOperation);
    });
  });
  if (out.chains.size() < p.chains.size())
    out.rejected.push_back({"drilling at an edge", why + "; mill it, move it, or give a larger raw piece"});
  return out;
}

}  // namespace capstan::pipeline
