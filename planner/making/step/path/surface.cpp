#include "planner/making/step/path/surface.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/limit.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/step/cut/question.h"
#include "planner/making/step/cut_samples.h"
#include "planner/making/workholding/clear_of_fixtures.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/life/life.h"

namespace capstan::step {
namespace {

/// How far above the table's speed the widest contact of a path may run, where most of it runs below.
/// Default, unsourced: as far as a cutter's slowest speed may exceed its preset (tooling/selection).
constexpr double kOverTable = 1.25;

/// A ball or a bull nose: it touches a wall that leans.
bool mills_round(const model::Cutter& c) {
  return model::has(c.cutter_class, model::CutterTrait::kBall) ||
         (model::has(c.cutter_class, model::CutterTrait::kEndMill) && c.corner_radius_mm > 0.0);
}

}  // namespace

void ask_as_measured(const std::vector<optimise::CutSample>& samples, optimise::CutQuestion& q) {
  const model::Cutter& c = q.cutter;
  const double d = c.cutting_diameter_mm;
  const double corner = mechanics::tooth_of(c).corner_radius_mm;
  const double n = mechanics::taylor_exponent(c.substrate);
  std::vector<const optimise::CutSample*> cut;
  double volume = 0.0, length = 0.0, wear = 0.0, widest = 0.0;
  for (const optimise::CutSample& s : samples) {
    if (s.plunge || !(s.ap_mm > 0.0) || !(s.csa_mm2 > 0.0) || !(s.step_mm > 0.0)) continue;
    cut.push_back(&s);
    volume += s.csa_mm2 * s.step_mm;
    length += s.step_mm;
    const double contact = mechanics::effective_diameter_mm(std::max(s.top_mm, s.ap_mm), d, corner);
    wear += s.step_mm * std::pow(contact / d, 1.0 / n);
    widest = std::max(widest, contact);
  }
  if (cut.empty() || !(volume > 0.0)) return;
  std::stable_sort(cut.begin(), cut.end(),
                   [](const auto* a, const auto* b) { return a->csa_mm2 < b->csa_mm2; });
  double below = 0.0;
  const auto middle = std::find_if(cut.begin(), cut.end(), [&](const auto* s) {
    below += s->csa_mm2 * s->step_mm;
    return below >= 0.5 * volume;
  });
  const optimise::CutSample& typical = middle != cut.end() ? **middle : *cut.back();
  q.ap_mm = q.depth_mm = typical.ap_mm;
  q.width_mm = std::clamp(typical.csa_mm2 / typical.ap_mm, 1e-3, d);
  q.as_measured = true;
  q.speed_diameter_mm = std::max(d * std::pow(wear / length, n), widest / kOverTable);
  // Where spindle or axes lowered the speed at the full diameter, take the table's speed at the contact
  // diameter again. The optimiser keeps the machine's limits.
  if (q.speed_diameter_mm < d) q.vc_start_m_min = std::max(q.vc_start_m_min, q.vc_table_m_min);
}

bool finishes_in_passes(const model::Model& m, const draft::StepDraft& step,
                        const model::FeatureShape& shape) {
  if (m.holds<model::FreeformFinishMilling>(step.operation)) return !draft::cuts_levels(m, step);
  if (!model::has(step.operation.type, model::OperationTrait::kFinishes) || !mills_round(step.cutter))
    return false;
  return leaves_terraces(shape);
}

Result<toolpath::GeneratedPath> pass_over(const PlanSoFar& p, const draft::StepDraft& step,
                                          const toolpath::PathJob& path, Stocks& stocks,
                                          optimise::CutQuestion& q, const MakePath& make) {
  auto made = workholding::kept_clear(p.setups[step.setup], step.cutter, path, make);
  if (!made) return made;
  const auto before = stocks.before(step.setup);
  if (const auto m = stocks.measure(step.setup, made->path, step.cutter))
    ask_as_measured(samples_of(*m, made->path, step.cutter), q);
  stocks.put_back(step.setup, before);
  return made;
}

std::optional<double> bent_too_much(const model::Cutter& cutter, std::string_view why_not) {
  static const std::string bending =
      model::limit_words(std::string(model::row_of(model::Limit::kToolDeflection).name));
  if (why_not.find(bending) == std::string_view::npos) return std::nullopt;
  const auto out = mechanics::tip_compliance_mm_n(cutter);
  return out ? std::optional(*out) : std::nullopt;
}

std::optional<std::string> surely_bends(const model::Model& m, const draft::StepDraft& step,
                                        std::size_t candidate, std::optional<double> bent_mm_n) {
  // A narrower ball's forces are less, but not so much: the next size at the same stick-out (8 to 6 mm: 3.2
  // times) is tried. Default, unsourced.
  constexpr double kSurely = 4.0;
  if (candidate >= step.candidates.size() || !step.proposed || !bent_mm_n ||
      !m.holds<model::FreeformFinishMilling>(step.operation))
    return std::nullopt;
  const double own = mechanics::tip_compliance_mm_n(step.candidates[candidate].cutter).value_or(0.0);
  if (!(own > kSurely * *bent_mm_n)) return std::nullopt;
  return "it bends " + trimmed(own / *bent_mm_n, 1) +
         " times as far by the same force as one that bends too much";
}

}  // namespace capstan::step
