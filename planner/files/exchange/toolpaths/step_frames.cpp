#include "planner/files/exchange/toolpaths/step_frames.h"

#include <cstddef>
#include <utility>
#include <vector>

#include "planner/model/features/resolve.h"
#include "planner/model/features/setup_place.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/standing.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange {

using geometry::Placement;
using model::AnyRef;

namespace {

/// Of workplans within workplans: a file may nest them in a circle.
constexpr std::size_t kMostOrientations = 1000;

/// Set-up and orientations of the workplans around a step.
struct Around {
  AnyRef setup;                      ///< the innermost
  std::vector<AnyRef> orientations;  ///< of toolpaths, outermost first
};

/// A walk down from the main workplan.
Around around(const model::Plan& plan, AnyRef step) {
  const auto& m = plan.model;
  std::vector<AnyRef> plans = m.all(model::TypeId::kWorkplan);
  if (const auto* project = m.get<model::Project>(plan.project);
      project != nullptr && project->main_workplan) {
    plans.insert(plans.begin(), project->main_workplan);
  }
  for (const AnyRef root : plans) {
    std::vector<std::pair<AnyRef, Around>> pending(1);
    pending.front().first = root;
    std::size_t visited = 0;
    while (!pending.empty() && ++visited < 10'000'000) {
      const AnyRef at = pending.back().first;
      Around here = std::move(pending.back().second);
      pending.pop_back();
      if (at == step) return here;
      if (const auto* w = m.get<model::Workplan>(at); w != nullptr) {
        if (w->its_setup) here.setup = w->its_setup;
        if (w->toolpath_orientation && here.orientations.size() < kMostOrientations) {
          here.orientations.push_back(w->toolpath_orientation);
        }
      }
      if (!m.holds<model::ProgramStructure>(at)) continue;
      model::for_each_reference(m, at, [&](AnyRef to) {
        if (m.holds<model::Executable>(to)) pending.emplace_back(to, here);
      });
    }
  }
  return {};
}

AnyRef feature_of(const model::Model& m, AnyRef step) {
  const auto* w = m.get<model::MachiningWorkingstep>(step);
  return w == nullptr ? AnyRef{} : AnyRef(w->its_feature);
}

}  // namespace

Result<Placement> toolpath_frame(const model::Model& m, AnyRef feature) {
  // A chamfer or an edge round has the place of the feature whose edge it is.
  AnyRef stands = feature;
  if (const auto* f = m.get<model::TransitionFeature>(feature)) stands = f->first_feature;
  AnyRef at;
  if (const auto* f = m.get<model::Two5dManufacturingFeature>(stands)) at = f->feature_placement;
  if (const auto* f = m.get<model::Region>(stands)) at = f->feature_placement;
  auto own = model::placement_or_identity(m, model::Ref<model::Axis2Placement3d>(at));
  if (!own) return own;
  // An element has the place where its compound or pattern puts it.
  const auto outer = model::coordinates_of(m, stands);
  if (!outer) return fail(outer.error());
  return *outer == Placement{} ? *own : geometry::compose(*outer, *own);
}

Result<Placement> frame_of_step(const model::Plan& plan, model::Ref<model::Executable> step) {
  const auto& m = plan.model;
  const auto read = [&](AnyRef at) {
    return model::placement_or_identity(m, model::Ref<model::Axis2Placement3d>(at));
  };
  const AnyRef feature = feature_of(m, step);
  const auto* workingstep = m.get<model::Workingstep>(step);
  const AnyRef own = workingstep != nullptr ? AnyRef(workingstep->toolpath_orientation) : AnyRef{};
  auto local = own.set() ? read(own) : toolpath_frame(m, feature);
  if (!local) return fail(local.error());
  const Around where = around(plan, step);
  for (auto at = where.orientations.rbegin(); at != where.orientations.rend(); ++at) {
    const auto outer = read(*at);
    if (!outer) return fail(outer.error());
    *local = geometry::compose(*outer, *local);
  }
  if (!m.holds<model::Setup>(where.setup)) return *local;
  const auto* f = m.get<model::ManufacturingFeature>(feature);
  if (f == nullptr) {
    const auto turn = model::turn_of_setup(m, where.setup);
    if (!turn) return fail(turn.error());
    return *turn == Placement{} ? *local : geometry::compose(*turn, *local);
  }
  const auto outer = model::workpiece_in_program(m, where.setup, m.get<model::Workpiece>(f->its_workpiece));
  if (!outer) return fail(outer.error());
  return *outer ? geometry::compose(**outer, *local) : *local;
}

}  // namespace capstan::exchange
