#include "planner/proof/verify/sweep/sweep.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>

#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/sweep/fixtures.h"
#include "planner/proof/verify/sweep/grid/carry.h"
#include "planner/proof/verify/sweep/grip.h"
#include "planner/proof/verify/sweep/known/known_steps.h"
#include "planner/proof/verify/sweep/step_checks.h"
#include "planner/proof/verify/sweep/target/corners.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {
namespace {

constexpr double kUsualCells = 250e3;  // default, unsourced: a compromise of time and resolution

/// One set-up's heights and finished part.
struct Scene {
  Target target;
  Grid grid;
  EarlierCuts earlier;
  CutSquares squares;
  Scene(const model::Plan& plan, const PartShapes& part, std::size_t setup, double cell,
        const KnownSteps& known, const std::optional<geometry::Box2>& near)
      : target(plan, part, setup, near),
        grid(xy(target.stock().lo), xy(target.stock().hi), cell, kMaximumCells) {
    poll();
    known.remember(target, grid);
    target.fill(grid);
    poll();
    earlier.begin(grid);
    poll();
  }
  [[nodiscard]] SweptSetup swept() { return {target, grid, earlier, squares}; }
};

/// The area that cutters of the steps in a set-up come near, with the features that they are for, set-up
/// frame.
geometry::Box2 near_moves(const model::Plan& plan, const PartShapes& part, const geometry::Placement& frame,
                          const std::vector<StepMoves>& earlier, const std::vector<StepMoves>& steps) {
  constexpr double kMoreMm = 5.0;  // tolerances and chords are hundredths; default, unsourced
  geometry::Box3 out;
  std::set<model::AnyRef> features;
  for (const auto* some : {&earlier, &steps}) {
    for (const StepMoves& step : *some) {
      if (step.cutter == nullptr || !(workpiece_in(plan, step.setup) == frame)) continue;
      const double r = outline_of(*step.cutter).radius_mm + kMoreMm;
      for (const Move& m : step.moves) {
        const geometry::Box3 box = box_of(m);
        out.add(box.lo - geometry::Vec3{r, r, 0.0});
        out.add(box.hi + geometry::Vec3{r, r, 0.0});
      }
      const auto* ws =
          step.planned == nullptr ? nullptr : plan.model.get<model::MachiningWorkingstep>(step.planned->step);
      if (ws == nullptr) continue;
      features.insert(ws->its_feature);
      features.insert(ws->final_features.items.begin(), ws->final_features.items.end());
    }
  }
  for (const PartShapes::Entry& e : part.entries) {
    if (!features.contains(e.feature)) continue;
    for (const volumes::Form& form : e.shapes) {
      const geometry::Box2 seen = seen_of(form, frame);
      if (seen.lo.x > seen.hi.x) continue;
      out.add({seen.lo.x, seen.lo.y, 0.0});
      out.add({seen.hi.x, seen.hi.y, 0.0});
    }
  }
  return {xy(out.lo), xy(out.hi)};
}

double cell_of(const model::Plan& plan) {
  const geometry::Vec3 size = plan.stock.box.size();
  // Whatever side lies below: the largest face of the box.
  const double area = std::max({size.x * size.y, size.y * size.z, size.x * size.z});
  double smallest = 1e300;
  for (const auto& c : plan.cutters) {
    if (c.cutting_diameter_mm > 0.0) smallest = std::min(smallest, c.cutting_diameter_mm);
  }
  return cell_for(area, smallest);
}

bool sound(const model::Cutter* c) {
  return c != nullptr && std::isfinite(c->cutting_diameter_mm) && c->cutting_diameter_mm > 0.0;
}

/// Each feature in the set-up of its last step, with what the others took away.
void check_left(const model::Plan& plan, const PartShapes& part,
                const std::vector<std::unique_ptr<Scene>>& scenes, const CutBefore* before,
                Findings& findings) {
  const std::vector<Asked> asked = asked_of(plan, before);
  const std::set<model::AnyRef> later =
      before == nullptr ? std::set<model::AnyRef>{} : to_come(plan, *before);
  check_corner_records(plan, part, asked, before != nullptr, findings);
  for (const auto& scene : scenes) {
    std::vector<Asked> here;
    for (const Asked& a : asked) {
      if (a.done_before || later.contains(a.feature)) continue;
      if (workpiece_in(plan, a.setup) == scene->target.frame()) here.push_back(a);
    }
    if (here.empty()) continue;
    for (const auto& s : scenes) {
      if (s != scene) carry(scene->grid, scene->target.frame(), s->grid, s->target.frame());
    }
    scene->target.left(scene->grid, here, asked, scenes.size() > 1, findings);
  }
}

}  // namespace

double cell_for(double area_mm2, double smallest_mm) {
  return std::max({0.02, std::sqrt(area_mm2 / static_cast<double>(kMaximumCells)),
                   std::min(std::sqrt(area_mm2 / kUsualCells), smallest_mm / kCellsPerCutter)});
}

bool check_removal(const model::Plan& plan, const ReadPart& read, const std::vector<StepMoves>& steps,
                   Findings& findings, Job& job, std::vector<double>* speed_shares, memo::Memo* known,
                   const CutBefore* before) {
  const PartShapes& part = read.shapes;
  if (speed_shares != nullptr) speed_shares->assign(steps.size(), 1.0);
  check_bodies(plan, steps, findings);
  check_fixtures(plan, steps, findings);
  if (plan.stock.box.empty()) {
    findings.unproved(Severity::kWarning, 11, "CHK-NO-STOCK", {0, "", -1},
                      "there is no raw piece, so that removal cannot be checked");
    return true;
  }
  const double cell = cell_of(plan);
  const KnownSteps known_steps(plan, read, known);
  // Set-ups that hold the piece alike go on with the same stock; others begin with what is left.
  std::vector<std::unique_ptr<Scene>> scenes;
  Scene* last = nullptr;
  std::optional<Grip> grip;
  std::size_t held = static_cast<std::size_t>(-1);
  std::set<model::AnyRef> begun;  // features of which something was cut
  Findings unsaid;
  const std::vector<StepMoves> earlier =
      before == nullptr ? std::vector<StepMoves>{} : moves_of_first(before->plan, before->steps, unsaid);
  for (std::size_t k = 0; k < earlier.size() + steps.size(); ++k) {
    const bool cut = k < earlier.size();
    const std::size_t i = cut ? 0 : k - earlier.size();
    const StepMoves& step = cut ? earlier[k] : steps[i];
    Findings& said = cut ? unsaid : findings;
    job.progress("check", static_cast<double>(i) / static_cast<double>(steps.size()));
    if (job.stop_requested()) {
      findings.error(11, std::string(kStopped), {Findings::kWhole, "", -1},
                     "the check was stopped before step " + std::to_string(i + 1) + " of " +
                         std::to_string(steps.size()) + ": nothing is proven of it and of what follows");
      return false;
    }
    const geometry::Placement frame = workpiece_in(plan, step.setup);
    Scene* scene = nullptr;
    for (const auto& s : scenes) {
      if (s->target.frame() == frame) scene = s.get();
    }
    if (scene == nullptr) {
      // Of a whole plan every place is near; then what is made serves other checks, too.
      std::optional<geometry::Box2> near;
      if (before != nullptr) near = near_moves(plan, part, frame, earlier, steps);
      scenes.push_back(std::make_unique<Scene>(plan, part, step.setup, cell, known_steps, near));
      scene = scenes.back().get();
    }
    if (scene != last) {
      for (const auto& s : scenes) {
        if (s.get() == scene) continue;
        carry(scene->grid, frame, s->grid, s->target.frame());
      }
      if (scenes.size() > 1) scene->earlier.begin(scene->grid);
      known_steps.begin(scene->swept(), scenes.size() > 1);
      last = scene;
    }
    if (step.setup != held && step.setup < plan.setups.size()) {
      held = step.setup;
      grip.emplace(plan.setups[held].holding, scene->grid, step, said);
    }
    if (!sound(step.cutter)) continue;
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(
        step.planned != nullptr ? step.planned->step : model::Ref<model::Executable>{});
    const SweptStep swept =
        known_steps.sweep(step, scene->swept(), ws != nullptr && begun.contains(ws->its_feature), said);
    if (speed_shares != nullptr && !cut) (*speed_shares)[i] = swept.speed_share;
    if (ws != nullptr && swept.cuts) begun.insert(ws->its_feature);
    scene->grid.find_top_after_cuts();
    if (grip && step.setup == held) grip->after(step, scene->grid, said);
  }
  check_left(plan, part, scenes, before, findings);
  return true;
}

}  // namespace capstan::verify
