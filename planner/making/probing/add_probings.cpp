#include "planner/making/probing/add_probings.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/probing/touch_starts.h"
#include "planner/making/step/middle_of_tolerance.h"
#include "planner/model/nouns/placed_nouns.h"
#include "planner/model/plan/measured.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::probing {
namespace {

using draft::ProbingDraft;
using draft::StepDraft;
using geometry::Vec3;
using model::AnyRef;
using model::Binder;
using model::FeatureShape;
using model::Model;
using model::Ref;
using model::ShapeKind;

/// The deviations of a size: its own, else the general ones.
std::optional<model::Deviations> deviations(const piece::Demands& demands, const model::Toleranced& t) {
  if (t.given) return model::Deviations{t.lower_mm, t.upper_mm};
  const auto half = demands.general ? model::general_size(*demands.general, t.nominal_mm) : std::nullopt;
  if (!half) return std::nullopt;
  return model::Deviations{-*half, *half};
}

/// Allowance on wall and floor before the last step: what the step before it leaves.
Left left_at(const std::vector<model::ProposedStep>& chain, std::size_t at, const FeatureShape& s) {
  Left out;
  if (at > 0 && model::is_a(chain[at - 1].operation, model::TypeId::kMillingTypeOperation)) {
    out.side_mm = chain[at - 1].allowance_side_mm;
    out.bottom_mm = chain[at - 1].allowance_bottom_mm;
  }
  if (s.kind == ShapeKind::kHole && at + 1 < chain.size() && chain[at + 1].start_diameter_mm > 0.0)
    out.side_mm = std::max(0.0, 0.5 * (s.diameter.middle() - chain[at + 1].start_diameter_mm));
  return out;
}

/// The touches before a step, and the largest deviation of its walls from where they are expected.
struct Measured {
  Touches found;
  std::string of;  ///< "datum A, 'H2'"
  std::optional<double> lower_mm, upper_mm;
};

/// Facts of the part that a message about probing needs.
struct Known {
  const std::vector<StepDraft>& steps;
  const piece::Shapes& shapes;
  const piece::Demands& demands;
  const geometry::Box3& raw;
};

/// The datum that the position of this step's feature refers to, when it is done before in the same set-up.
std::optional<Measured> datum_of(const Known& known, std::size_t at, double ball) {
  const std::vector<StepDraft>& steps = known.steps;
  const StepDraft& step = steps[at];
  for (const model::Tie& tie : known.demands.ties) {
    if (tie.letter.empty() || tie.second != step.feature || tie.first == step.feature) continue;
    const auto is_datum = [&](const StepDraft& s) { return s.feature == tie.first; };
    const auto here = steps.begin() + static_cast<std::ptrdiff_t>(at);
    if (std::none_of(steps.begin(), here, is_datum) || std::any_of(here, steps.end(), is_datum)) continue;
    if (std::any_of(steps.begin(), here, [&](const auto& s) { return is_datum(s) && s.setup != step.setup; }))
      continue;
    // As it is cut: a hole right through may be entered from its other side.
    const auto last = std::find_if(std::make_reverse_iterator(here), steps.rend(), is_datum);
    if (last->shapes.size() != 1) continue;
    const FeatureShape& s = last->shapes.front();
    const bool placed = s.kind == ShapeKind::kHole || s.kind == ShapeKind::kOutside ||
                        (s.kind == ShapeKind::kPocket && !s.open);
    if (!placed || dot(s.frame.z, step.shapes.front().frame.z) < 1.0 - 1e-6) continue;
    Measured out{touches_of({known.shapes.all, known.raw}, s, {}, ball),
                 "datum " + tie.letter + ", '" + s.name + "'",
                 {},
                 {}};
    if (out.found.touches.empty()) continue;
    if (const auto d = s.kind == ShapeKind::kHole ? deviations(known.demands, s.diameter) : std::nullopt) {
      out.lower_mm = 0.5 * (d->lower_mm - d->middle());
      out.upper_mm = 0.5 * (d->upper_mm - d->middle());
    }
    return out;
  }
  return std::nullopt;
}

/// Whether the chain leans on what is measured: its own row wants it between two cuts, for the size. Else a
/// demand of position wants it.
bool for_size(const ProbingDraft& p) {
  const std::string& row = p.chain[p.at].why.id;
  return std::any_of(p.chain.begin(), p.chain.end(), [&](const model::ProposedStep& s) {
    return s.operation != model::TypeId::kWorkpieceProbing && s.why.id == row;
  });
}

/// How far one of two walls that face each other may be from the middle of the tolerance: a quarter of its
/// width, for the size changes at both. Of a length and a width the closer one.
std::optional<double> wall_slack(const FeatureShape& s) {
  std::optional<double> out;
  const auto closer = [&](const model::Toleranced& t) {
    if (t.given) out = std::min(out.value_or(t.width()), t.width());
  };
  if (s.kind == ShapeKind::kHole) {
    closer(s.diameter);
  } else if (s.kind == ShapeKind::kPocket || s.kind == ShapeKind::kSlot || s.kind == ShapeKind::kOutside) {
    closer(s.width);
    closer(s.length);
  }
  if (out) *out *= 0.25;
  return out;
}

Measured measured_before(const Known& known, std::size_t at, const std::optional<model::Candidate>& probe) {
  const StepDraft& step = known.steps[at];
  const ProbingDraft& p = *step.probing;
  const double ball = probe ? 0.5 * probe->cutter.cutting_diameter_mm : 0.0;
  if (!for_size(p)) {
    if (auto datum = datum_of(known, at, ball)) return *std::move(datum);
  }
  // Where the walls are when each step is cut to the middle of the tolerance, as the paths are.
  FeatureShape s = step.shapes.front();
  step::aim_at_the_middle(s);
  Measured out{touches_of({known.shapes.all, known.raw}, s, left_at(p.chain, p.at, s), ball),
               "'" + s.name + "' as it is cut so far",
               {},
               {}};
  if (const auto off = for_size(p) ? wall_slack(s) : std::nullopt) {
    out.lower_mm = -*off;
    out.upper_mm = *off;
  }
  if (step.shapes.size() > 1) out.of += ", the first of " + std::to_string(step.shapes.size());
  return out;
}

Ref<model::TouchProbe> probe_noun(Model& m, const model::Cutter* c) {
  const std::string id = c == nullptr ? "by hand" : c->id;
  for (const AnyRef r : m.all(model::TypeId::kTouchProbe)) {
    if (m.origin(r).instance == 0 && m.at<model::TouchProbe>(r).its_id == id)
      return Ref<model::TouchProbe>(r);
  }
  if (c != nullptr) return Ref<model::TouchProbe>(AnyRef(tooling::nouns_from_cutter(m, *c)));
  model::TouchProbe probe;
  probe.its_id = id;
  return m.add(probe);
}

Ref<model::Executable> touch_noun(model::Plan& plan, const StepDraft& next, const Measured& what,
                                  std::size_t at) {
  Model& m = plan.model;
  const ProbingDraft& wanted = *next.probing;
  const model::ProposedStep& step = wanted.chain[wanted.at];
  const Touch& touch = what.found.touches[at];

  geometry::Placement start;
  start.origin = touch.start;
  start.z = touch.reference;
  start.x = touch.direction;
  const auto start_position = model::add_placement(m, start);

  model::TolerancedLengthMeasure expected;
  expected.theoretical_size = touch.distance_mm;
  if (what.lower_mm && what.upper_mm) {
    model::PlusMinusValue t;
    t.upper_limit = *what.upper_mm;
    t.lower_limit = -*what.lower_mm;  // what is subtracted, as ISO 14649-10 has it
    t.significant_digits = 4;
    expected.implicit_tolerance = m.add(t);
  }
  model::NcVariable result;
  result.its_name = std::string(for_size(wanted) ? model::kMeasuredSize : model::kProbedPlace) +
                    std::to_string(m.all(model::TypeId::kWorkpieceProbing).size() + 1);

  model::WorkpieceProbing p;
  p.its_id = step.name + " " + touch.side;
  p.measured_offset = m.add(result);
  p.start_position = start_position;
  if (const auto* f = m.get<model::ManufacturingFeature>(next.feature)) p.its_workpiece = f->its_workpiece;
  p.direction = model::add_direction(m, touch.direction);
  p.expected_value = m.add(expected);
  p.its_probe = probe_noun(m, wanted.probe ? &wanted.probe->cutter : nullptr);
  const auto made = m.add(p);

  model::Reason why = step.why;
  why.text += (why.text.empty() ? "" : "; ") + what.of + ", " + touch.side + ": expected after " +
              trimmed(touch.distance_mm, 4) + " mm, " +
              (wanted.probe ? "the ball's radius of " +
                                  trimmed(0.5 * wanted.probe->cutter.cutting_diameter_mm, 4) + " mm taken off"
                            : "from the start to the wall itself");
  if (what.found.touches.size() > 1)
    why.text += "; half the difference of two touches facing each other is what the middle is off";
  plan.ledger.bind(made, "expected_value", Binder::kRule, why);
  if (wanted.probe)
    plan.ledger.bind(made, "its_probe", Binder::kToolSelection, wanted.probe->why,
                     {{made, "expected_value"}});
  return made;
}

}  // namespace

Added add_probings(model::Plan plan, std::vector<StepDraft> steps, const piece::Shapes& shapes,
                   const piece::Demands& demands, Job& job) {
  const Known known{steps, shapes, demands, plan.stock.box};
  Added added;
  std::vector<StepDraft>& out = added.steps;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].probing) {
      StepDraft& next = steps[i];
      ProbingDraft& probing = *next.probing;
      const model::ProposedStep& wanted = probing.chain[probing.at];
      Measured what = measured_before(known, i, probing.probe);
      std::string not_by_probe = "machine or library has no touch probe";
      if (what.found.touches.empty() && probing.probe) {
        // Where its ball does not come, a gauge may.
        not_by_probe = what.found.why_not;
        what = measured_before(known, i, std::nullopt);
        if (!what.found.touches.empty()) probing.probe.reset();
      }
      if (what.found.touches.empty()) {
        // A last cut without a measured setting is no more accurate than the cut before it, and a place that
        // is not measured is arbitrary: such a chain is rejected.
        added.given_up.push_back(
            {next.member, next.chain,
             "'" + wanted.name + "' cannot be made (" + what.found.why_not + "), and without it " +
                 (for_size(probing)
                      ? std::string("the last cut does not hold the tolerance")
                      : "nothing holds the requirement: " + wanted.why.text + " [" + wanted.why.id +
                            "]; give the tolerance a datum or a wall that a probe reaches, or "
                            "measure the piece on another machine and take the tolerance out "
                            "of this plan")});
      } else if (!probing.probe) {
        job.warn("PIP-PROBE", "step '" + wanted.name + "': " + not_by_probe +
                                  ": the program stops there; measure by hand");
      }
      for (std::size_t k = 0; k < what.found.touches.size(); ++k) {
        StepDraft step;
        step.feature = next.feature;
        step.setup = next.setup;
        step.shapes = next.shapes;
        step.proposed = true;
        step.proposal = wanted;
        step.proposal.feature = next.feature;
        if (probing.probe) step.cutter = probing.probe->cutter;
        step.step = touch_noun(plan, next, what, k);
        out.push_back(std::move(step));
      }
    }
    out.push_back(steps[i]);
  }
  added.plan = std::move(plan);
  return added;
}

}  // namespace capstan::probing
