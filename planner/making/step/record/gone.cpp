#include "planner/making/step/record/gone.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/geometry/moved.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/piece/twins.h"
#include "planner/model/nouns/all.h"
#include "planner/physics/engagement/engagement.h"

// Leaves out a step whose material other features' steps have removed already. Its feature stays.

namespace capstan::step {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::Ref;

constexpr double kSameMm = 0.02;      // of outlines and heights; default, unsourced
constexpr double kRemnantMm2 = 0.01;  // slivers of outlines; default, unsourced
constexpr double kAligned = 1.0 - 1e-9;

/// Where a feature takes all of another's height away, in that one's frame; nothing where it ends above.
geometry::Region gone_with(const model::FeatureShape& a, const model::FeatureShape& b) {
  const auto rel = compose(inverse(b.frame), a.frame);
  if (std::abs(rel.z.z) < kAligned) return {};
  const double end = rel.origin.z - a.depth_mm * rel.z.z;
  const double top = a.kind == model::ShapeKind::kFace ? 1e300 : std::max(rel.origin.z, end);
  const double bottom = std::min(rel.origin.z, end);
  if (bottom > -b.depth_mm + kSameMm || top < -kSameMm) return {};
  geometry::Region out = a.area;
  for (const auto& island : a.islands) out = geometry::subtract(out, island.area);
  return geometry::moved(out, rel);
}

/// The last of the steps with a path, in whichever set-up, in whose areas together this one's lies: what it
/// would cut is gone with these. Nothing when some of it lies beyond them.
Ref<model::Executable> made_by(const PlanSoFar& p, const StepDraft& step) {
  Ref<model::Executable> out;
  for (const model::FeatureShape& b : step.shapes) {
    const geometry::Box3 raw = transformed(p.plan.stock.box, inverse(b.frame));
    geometry::Region left = geometry::intersect(
        geometry::offset(b.area, -kSameMm), geometry::rectangle(geometry::xy(raw.lo), geometry::xy(raw.hi)));
    for (const auto& island : b.islands) left = geometry::subtract(left, island.area);
    for (const model::StepResult& kept : p.plan.steps) {
      const auto it = std::find_if(p.steps.begin(), p.steps.end(),
                                   [&](const StepDraft& s) { return s.step == kept.step; });
      if (it == p.steps.end()) continue;
      for (const model::FeatureShape& a : it->shapes) {
        const geometry::Region gone = gone_with(a, b);
        if (gone.empty() || geometry::intersect(left, gone).empty()) continue;
        left = geometry::subtract(left, gone);
        out = kept.step;
      }
    }
    if (geometry::area(left) > kRemnantMm2) return {};
  }
  return out;
}

/// True if a kept step of another feature, with the same operation, machines a twin of each of these shapes,
/// and no step of this feature is kept. The feature that came first is machined; the other is its twin.
bool twin_made(const PlanSoFar& p, const StepDraft& step) {
  if (p.piece.shapes.twins.empty()) return false;
  const auto kept = [&](const StepDraft& s) {
    return std::any_of(p.plan.steps.begin(), p.plan.steps.end(),
                       [&](const model::StepResult& r) { return r.step == s.step; });
  };
  bool found = false;
  for (const StepDraft& s : p.steps) {
    if (s.step == step.step || !kept(s)) continue;
    if (s.feature == step.feature) return false;
    if (s.operation.type != step.operation.type) continue;
    found = found || std::all_of(step.shapes.begin(), step.shapes.end(), [&](const model::FeatureShape& b) {
              return std::any_of(s.shapes.begin(), s.shapes.end(), [&](const model::FeatureShape& a) {
                return piece::same_removal(p.piece.shapes, a, b);
              });
            });
  }
  return found;
}

/// The feature itself if its own steps make all of it; a boss if the steps around it have made it.
std::string made_with(const PlanSoFar& p, const StepDraft& step, const model::MachiningWorkingstep& maker) {
  const auto* of = p.plan.model.get<model::ManufacturingFeature>(maker.its_feature);
  const auto* own = p.plan.model.get<model::ManufacturingFeature>(step.feature);
  if (of == nullptr || AnyRef(maker.its_feature) == step.feature) return {};
  const std::string by = "'" + of->its_id.value_or("") + "'";
  if (!p.plan.model.holds<model::Boss>(step.feature)) return " with " + by;
  return ", for " + by + " is cut around the boss '" + own->its_id.value_or("") + "', which stands";
}

/// True if a step cuts around a boss no finer than roughing and finishing do, and kept steps of other
/// features remove all of that material.
bool cut_around(const PlanSoFar& p, const StepDraft& step) {
  const model::Model& m = p.plan.model;
  const auto boss = [&](const model::FeatureShape& s) {
    return m.holds<model::Boss>(s.made_of.empty() ? s.feature : s.made_of.back());
  };
  if (step.shapes.empty() || !std::all_of(step.shapes.begin(), step.shapes.end(), boss)) return false;
  // A chain of more than roughing and a finish asks for a size that others' steps do not aim at.
  const bool finer = std::any_of(p.steps.begin(), p.steps.end(), [&](const StepDraft& s) {
    return s.member == step.member && s.chain == step.chain && s.in_chain >= 2;
  });
  const auto* maker = finer ? nullptr : m.get<model::MachiningWorkingstep>(made_by(p, step));
  return maker != nullptr && AnyRef(maker->its_feature) != step.feature;
}

/// Roughing, of whatever but a surface.
bool roughs(const StepDraft& step) {
  return model::has(step.operation.type, model::OperationTrait::kRoughs) &&
         !model::has(step.operation.type, model::OperationTrait::kSurface);
}

}  // namespace

bool may_cut_nothing(const PlanSoFar& p, const StepDraft& step) {
  const bool finished = std::any_of(p.steps.begin(), p.steps.end(), [&](const StepDraft& s) {
    return s.member == step.member && s.chain == step.chain && s.in_chain > step.in_chain && !roughs(s);
  });
  return (finished && roughs(step)) || cut_around(p, step);
}

bool in_air(const PlanSoFar& p, const StepDraft& step, double removed_mm3) {
  constexpr double kNothingMm3 =
      0.01;  // default, unsourced: the height map cannot distinguish less from nothing
  const model::Model& m = p.plan.model;
  if (step.proposed && twin_made(p, step)) return true;
  if (!step.proposed || removed_mm3 > kNothingMm3 || engagement::head_height(step.cutter)) return false;
  const int rank = model::craft_rank(step.operation.type);
  if (rank == model::craft::kMarks || rank == model::craft::kDrills) return true;
  if (roughs(step)) return true;
  if (!m.holds<model::Two5dMillingOperation>(step.operation)) return false;
  // A finish stays after other steps of what it finishes: of the same element, where there are several.
  return std::none_of(p.steps.begin(), p.steps.end(), [&](const StepDraft& other) {
    const auto is_other = [&](const model::StepResult& r) { return r.step == other.step; };
    return other.feature == step.feature && (!other.proposed || other.member == step.member) &&
           std::any_of(p.plan.steps.begin(), p.plan.steps.end(), is_other);
  });
}

bool leave_out(model::Plan& plan, const PlanSoFar& p, const StepDraft& step, const std::string& why,
               Job& job) {
  model::Model& m = plan.model;
  // Steps of the feature that are kept, or still to come: without any, and made by no other's, it is not
  // made.
  const auto kept = [&](const StepDraft& s) {
    return std::any_of(plan.steps.begin(), plan.steps.end(),
                       [&](const model::StepResult& r) { return r.step == s.step; });
  };
  bool later = false, others = false;
  for (const StepDraft& s : p.steps) {
    if (s.step == step.step) {
      later = true;
    } else if (s.feature == step.feature) {
      others = others || later || kept(s);
    }
  }
  auto* maker = m.get<model::MachiningWorkingstep>(made_by(p, step));
  if (maker == nullptr && !others) return false;
  const std::string with = maker == nullptr ? std::string() : made_with(p, step, *maker);
  if (maker != nullptr && AnyRef(maker->its_feature) != step.feature) {
    auto& made = maker->final_features;
    if (std::find(made.items.begin(), made.items.end(), step.feature) == made.items.end())
      made.push_back(Ref<model::ManufacturingFeature>(step.feature));
  }
  take_out(m, step);
  job.note("PIP-GONE", "step '" + draft::name_of(m, step) + "' is left out: its material is removed already" +
                           with + "; " + why);
  return true;
}

void take_out(model::Model& m, const StepDraft& step) {
  for (const AnyRef w : m.all(model::TypeId::kWorkplan))
    std::erase(m.get<model::Workplan>(w)->its_elements.items, AnyRef(step.step));
  if (auto* f = m.get<model::MachiningFeature>(step.feature))
    std::erase(f->its_operations.items, step.operation);
}

}  // namespace capstan::step
