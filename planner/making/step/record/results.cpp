#include "planner/making/step/record/results.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/physics/motion/time.h"

namespace capstan::step {
namespace {

using draft::StepDraft;

/// Hours of cutting are worth another tool: said with what holds the step back.
void tell_slow(const model::Model& m, const StepDraft& step, const model::StepResult& r, Job& job) {
  constexpr double kSlowS = 4.0 * 3600.0;  // default, unsourced
  if (!step.open_technology || r.cutting_s < kSlowS) return;
  std::string limits;
  for (const auto& a : r.active) limits += (limits.empty() ? "" : ", ") + model::limit_words(a.name);
  job.warn("PIP-SLOW", "step '" + draft::name_of(m, step) + "' cuts " + trimmed(r.cutting_s / 3600.0, 1) +
                           " h with " + step.cutter.id + " (" + trimmed(step.cutter.cutting_diameter_mm, 3) +
                           " mm, stick-out " + trimmed(step.cutter.stick_out_mm, 1) +
                           " mm); limit: " + (limits.empty() ? "the given values" : limits) +
                           ". Use a larger or shorter cutter");
}

/// Whether forces and bending find the same in both.
bool as_large(const model::Cutter& a, const model::Cutter& b) {
  bool same = true;
  model::for_each_field(a, [&](const auto& row, const auto& value) {
    same = same && (!row.is_load || value == b.*row.member);
  });
  return same;
}

/// The result that the plan recorded for a step, if everything that its limits depend on is unchanged:
/// machine, material, cutter, speed, feed, depth and path. Its limits were found when these were chosen and
/// are not computed again. A plan that was read is compared by the machine's name and the times of its paths.
const model::StepResult* unchanged(const model::Plan& plan, const draft::Recorded& recorded,
                                   const StepDraft& step, const model::StepResult& r) {
  constexpr double kSame = 1e-6;  // of the value, what a file's units round; default, unsourced
  constexpr double kSameS =
      0.01;  // files of earlier versions have left-handed helices as points; default, unsourced
  if (step.open_technology || recorded.machine.id != plan.machine.id || recorded.material != plan.material)
    return nullptr;
  const auto cutter = std::find_if(recorded.cutters.begin(), recorded.cutters.end(),
                                   [&](const model::Cutter& c) { return c.id == r.cutter_id; });
  if (cutter == recorded.cutters.end() || !as_large(*cutter, step.cutter)) return nullptr;
  for (const model::StepResult& was : recorded.steps) {
    if (was.step != r.step) continue;
    const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * std::abs(a); };
    const bool as_before =
        was.cutter_id == r.cutter_id && same(was.spindle_rpm, r.spindle_rpm) &&
        same(was.feed_mm_min, r.feed_mm_min) && same(was.axial_depth_mm, r.axial_depth_mm) &&
        same(was.radial_depth_mm, r.radial_depth_mm) && std::abs(was.cutting_s - r.cutting_s) <= kSameS;
    return as_before ? &was : nullptr;
  }
  return nullptr;
}

}  // namespace

std::vector<model::ActiveConstraint> active_of(const optimise::CutAnswer& answer) {
  auto out = answer.active;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i].saves_s = i < answer.saved_by_tenth.size() ? answer.saved_by_tenth[i] : 0.0;
  return out;
}

void keep(model::Plan& plan, const draft::Recorded& recorded, const StepDraft& step, model::StepResult r,
          const optimise::FeedQuestion& fq, Job& job) {
  if (r.feed_mm_min == 0.0) r.feed_mm_min = fq.feed_mm_min;
  if (r.spindle_rpm == 0.0) r.spindle_rpm = fq.n_rpm;
  const double d = step.cutter.cutting_diameter_mm;
  r.vc_m_min = std::numbers::pi * d * std::abs(r.spindle_rpm) / 1000.0;
  if (r.spindle_rpm != 0.0)
    r.fz_mm = r.feed_mm_min / (std::abs(r.spindle_rpm) * std::max(1, step.cutter.teeth));
  const auto t = motion::time_of(*r.path, *r.schedule, plan.machine);
  if (t) {
    r.cutting_s = t->cutting_s + t->dwell_s;
    r.rapid_s = t->rapid_s;
    for (auto& a : r.active) a.saves_s = std::max(0.0, a.saves_s * t->cutting_s);
    tell_slow(plan.model, step, r, job);
  } else {
    for (auto& a : r.active) a.saves_s = 0.0;
    job.warn(t.error().code,
             "step '" + draft::name_of(plan.model, step) + "' has no time: " + t.error().message);
  }
  if (const auto* was = r.active.empty() ? unchanged(plan, recorded, step, r) : nullptr)
    r.active = was->active;
  plan.steps.push_back(std::move(r));
}

namespace {

bool was_planned(const model::Plan& plan, const StepDraft& step, const char* attribute) {
  const auto* op = plan.model.get<model::MachiningOperation>(step.operation);
  if (op == nullptr || !op->its_technology.set()) return false;
  const auto* d = plan.ledger.find(op->its_technology, attribute);
  return model::by_planning(d) && !d->pinned;
}

}  // namespace

bool feed_was_planned(const model::Plan& plan, const StepDraft& step) {
  return was_planned(plan, step, "feedrate");
}

bool speed_was_planned(const model::Plan& plan, const StepDraft& step) {
  return was_planned(plan, step, "spindle");
}

void keep_excess(const model::Model& m, const StepDraft& step, const optimise::FeedAnswer& feeds,
                 model::StepResult& r, Job& job) {
  if (!(feeds.worst_excess > kTolerableExcess)) return;
  r.exceeded.push_back(feeds.worst);
  job.warn("PIP-EXCESS", "step '" + draft::name_of(m, step) + "': " + model::text_of(feeds.worst) +
                             ", even at the least feed; use a smaller tool or depth");
}

model::StepResult result_of(const model::Model& m, const StepDraft& step) {
  model::StepResult r;
  r.step = step.step;
  r.setup = step.setup;
  r.cutter_id = step.cutter.id;
  const auto* op = m.get<model::MachiningOperation>(step.operation);
  if (op != nullptr) {
    if (const auto* f = m.get<model::MillingMachineFunctions>(op->its_machine_functions)) {
      r.flood = f->coolant.value_or(false);
      r.mist = f->mist.value_or(false);
      r.through = f->through_spindle_coolant.value_or(false);
    }
  }
  return r;
}

void append(toolpath::GeneratedPath& to, const toolpath::GeneratedPath& from) {
  auto& p = to.path;
  const auto& q = from.path;
  for (std::size_t i = 0; i < q.size(); ++i) {
    p.x.push_back(q.x[i]);
    p.y.push_back(q.y[i]);
    p.z.push_back(q.z[i]);
    p.cx.push_back(q.cx[i]);
    p.cy.push_back(q.cy[i]);
    p.kind.push_back(i == 0 ? model::MoveKind::kRapid : q.kind[i]);
    p.role.push_back(i == 0 ? model::MoveRole::kLink : q.role[i]);
    to.feed_factor.push_back(from.feed_factor[i]);
    to.speed_factor.push_back(from.speed_factor[i]);
    to.dwell_s.push_back(from.dwell_s[i]);
  }
}

std::optional<double> seconds_of(const model::Machine& machine, const model::CutterPath& path,
                                 const model::FeedSchedule& schedule) {
  const auto t = motion::time_of(path, schedule, machine);
  return t ? std::optional(t->cutting_s + t->dwell_s + t->rapid_s) : std::nullopt;
}

void no_path(model::Plan& plan, const StepDraft& step, const std::string& why, Job& job) {
  plan.unplanned.push_back({step.feature, "step '" + draft::name_of(plan.model, step) + "': " + why});
  job.report({.code = "PIP-NO-PATH",
              .severity = Severity::kError,
              .message = "step '" + draft::name_of(plan.model, step) + "' has no path: " + why,
              .file = plan.file_name,
              .instance = plan.model.origin(step.step).instance});
}

}  // namespace capstan::step
