#include "planner/making/step/record/record.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::step {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::Binder;
using model::DecisionKey;
using model::Model;
using model::Ref;

/// Where the numbers of a cut come from: first of all whose coefficients gave its forces.
std::string mechanics_of(const model::WorkMaterial& material, const StepDraft& step) {
  const bool milled = mechanics::is_milled(step.operation.type, step.cutter);
  return "forces by " + mechanics::force_source(material, step.cutter.substrate, milled) +
         ", tool bending as a stepped beam, the machine's spindle curve";
}

std::string percent(double fraction) { return trimmed(100.0 * fraction, 2) + " %"; }

/// "limited by chip_thickness (0.05 of 0.05 mm; 1 % more saves 0.9 % of the time)"
std::string words(const optimise::CutAnswer& a) {
  if (a.method == "given") return "as given; the numbers follow from the values in the file";
  if (a.active.empty()) return "no limit is reached; the search ended inside all limits";
  std::string out = "limited by ";
  for (std::size_t i = 0; i < a.active.size(); ++i) {
    const auto& c = a.active[i];
    if (i > 0) out += ", ";
    out += c.name + " (" + trimmed(c.value, 4) + " of " + trimmed(c.limit, 4) + " " + c.unit;
    if (c.shadow_price > 0.0) out += "; 1 % more saves " + percent(c.shadow_price) + " of the cutting time";
    out += ")";
  }
  return out;
}

/// Who decided the values of one technology, for another that holds the same; what the file states is given.
void take_over_decisions(model::Plan& plan, AnyRef from, AnyRef to) {
  model::Ledger& ledger = plan.ledger;
  for (const char* name : {"spindle", "cutspeed", "feedrate", "feedrate_per_tooth"}) {
    const auto* a = model::find_attribute(from.type, name);
    if (a == nullptr || !model::has_value(*a, plan.model.object(from))) continue;
    const model::Decision* known = ledger.find(from, name);
    model::Decision d = known == nullptr ? model::Decision{} : *known;
    for (DecisionKey& k : d.depends_on) {
      if (k.object == from) k.object = to;
    }
    ledger.set({to, name}, std::move(d));
  }
}

/// ISO 14649 signs the spindle: negative is clockwise seen from the spindle towards the work, which a
/// right-hand cutter wants.
double noun_sense(const model::Cutter& c) { return c.hand == model::Hand::kLeft ? 1.0 : -1.0; }

/// Decisions that a step's cut depends on: its tool, the sizes of its chain, the allowances that earlier
/// steps of its feature leave on walls and floor. Only decisions in the ledger can be named.
std::vector<DecisionKey> decided_before(const model::Plan& plan, const std::vector<StepDraft>& steps,
                                        const StepDraft& step) {
  std::vector<DecisionKey> out = {{step.operation, "its_tool"}};
  const auto add = [&](AnyRef operation, const char* attribute) {
    if (operation.set() && plan.ledger.find(operation, attribute) != nullptr)
      out.push_back({operation, attribute});
  };
  for (const char* name : {"allowance_side", "allowance_bottom", "cutting_depth", "previous_diameter"})
    add(step.operation, name);
  for (const StepDraft& s : steps) {
    if (s.step == step.step) break;
    if (!step.feature.set() || s.feature != step.feature) continue;
    for (const char* name : {"allowance_side", "allowance_bottom"}) add(s.operation, name);
  }
  return out;
}

/// The attribute that holds the width of a cut: of the operation, or the overlap of its strategy.
DecisionKey width_key(const Model& m, AnyRef operation) {
  const auto* o = m.get<model::PlaneMilling>(operation);
  return o != nullptr ? DecisionKey{o->its_machining_strategy, "overlap"}
                      : DecisionKey{operation, "radial_cutting_depth"};
}

}  // namespace

Ref<model::MillingTechnology> own_technology(model::Plan& plan, AnyRef operation) {
  Model& m = plan.model;
  auto* op = m.get<model::MachiningOperation>(operation);
  const AnyRef now = op->its_technology;
  if (m.holds<model::MillingTechnology>(now) && m.origin(now).instance == 0)
    return Ref<model::MillingTechnology>(now);
  model::MillingTechnology t;
  if (const auto* given = m.get<model::MillingTechnology>(now)) t = *given;
  if (!t.feedrate_reference.set()) t.feedrate_reference = model::ToolReferencePoint::kTcp;
  if (!t.synchronize_spindle_with_feed) t.synchronize_spindle_with_feed = false;
  if (!t.inhibit_feedrate_override) t.inhibit_feedrate_override = false;
  if (!t.inhibit_spindle_override) t.inhibit_spindle_override = false;
  const auto made = m.add(t);
  m.get<model::MachiningOperation>(operation)->its_technology = made;
  if (m.holds<model::MillingTechnology>(now)) take_over_decisions(plan, now, made);
  return made;
}

GivenTechnology given_technology(const Model& m, AnyRef operation, const model::Cutter& cutter) {
  GivenTechnology out;
  const auto* op = m.get<model::MachiningOperation>(operation);
  const auto* t = op != nullptr ? m.get<model::MillingTechnology>(op->its_technology) : nullptr;
  if (t == nullptr) return out;
  if (t->spindle) {
    out.rpm = -*t->spindle;
  } else if (t->cutspeed && cutter.cutting_diameter_mm > 0.0) {
    out.rpm = -noun_sense(cutter) * *t->cutspeed / (std::numbers::pi * cutter.cutting_diameter_mm);
  }
  if (t->feedrate) {
    out.feed_mm_min = t->feedrate;
  } else if (t->feedrate_per_tooth && out.rpm) {
    out.feed_mm_min = *t->feedrate_per_tooth * std::max(1, cutter.teeth) * std::abs(*out.rpm);
  }
  return out;
}

void let_go(const Model& m, StepDraft& step, const std::string& word, Job& job) {
  if (word.empty()) return;
  step.keep_speed = step.keep_feed = false;
  job.warn("PIP-CHANGED", "step '" + draft::name_of(m, step) + "': " + word);
}

void turn_with_the_cutter(model::Plan& plan, const StepDraft& step, Job& job) {
  Model& m = plan.model;
  const auto* op = m.get<model::MachiningOperation>(step.operation);
  const auto* t = op != nullptr ? m.get<model::MillingTechnology>(op->its_technology) : nullptr;
  if (t == nullptr || !t->spindle || !(step.cutter.cutting_diameter_mm > 0.0)) return;
  const double sense = noun_sense(step.cutter);
  if (*t->spindle * sense >= 0.0) return;
  const double rpm = std::abs(*t->spindle);
  const std::string name = op->its_id.value_or("");
  const model::Origin at = m.origin(op->its_technology);
  const auto made = own_technology(plan, step.operation);
  m.get<model::MillingTechnology>(made)->spindle = sense * rpm;
  const bool right = sense < 0.0;
  const std::string text =
      "the spindle would turn " + std::string(right ? "counter-clockwise" : "clockwise") +
      " (ISO 14649: " + (right ? "positive" : "negative") + "), but " + step.cutter.id + " cuts " +
      (right ? "right" : "left") + "-hand; it turns " + (right ? "clockwise" : "counter-clockwise") +
      " at the same " + trimmed(rpm, 3) + " 1/min";
  job.report({.code = "PIP-CHANGED",
              .severity = Severity::kWarning,
              .message = "operation '" + name + "': " + text,
              .file = plan.file_name,
              .line = at.line,
              .instance = at.instance});
  plan.ledger.bind(
      made, "spindle", Binder::kRule,
      {"safety.spindle_direction", text, "the cutter's hand_of_cut; safety: an edge cuts forwards"});
}

void record_cut(model::Plan& plan, const std::vector<StepDraft>& steps, const StepDraft& step,
                const optimise::CutAnswer& a, bool depth_open, bool width_open,
                const std::optional<FromCases>& cases) {
  Model& m = plan.model;
  model::Ledger& ledger = plan.ledger;
  const std::vector<DecisionKey> before = decided_before(plan, steps, step);
  const auto with = [&](std::initializer_list<DecisionKey> more) {
    std::vector<DecisionKey> out = before;
    for (const DecisionKey& k : more) {
      if (ledger.find(k.object, k.attribute) != nullptr) out.push_back(k);
    }
    return out;
  };
  const DecisionKey depth{step.operation, "axial_cutting_depth"};
  const std::string first = a.active.empty() ? "search" : a.active.front().name;
  const std::string held = step.limits.any() ? "; within " + step.limits.words() : "";
  const model::Reason why{"limit." + first, words(a) + held, mechanics_of(plan.material, step)};
  const auto bind = [&](AnyRef object, const char* attribute, std::vector<DecisionKey> on) {
    ledger.bind(object, attribute, Binder::kOptimiser, why, std::move(on));
  };
  if (depth_open) {
    const double ap = a.ap_mm;
    bool has = true;
    if (auto* o = m.get<model::PlaneMilling>(step.operation)) {
      o->axial_cutting_depth = ap;
    } else if (auto* s = m.get<model::SideMilling>(step.operation)) {
      s->axial_cutting_depth = ap;
    } else if (auto* b = m.get<model::BottomAndSideMilling>(step.operation)) {
      b->axial_cutting_depth = ap;
    } else {
      has = false;
    }
    if (has) bind(step.operation, "axial_cutting_depth", with({}));
  }
  if (width_open) {
    bool has = true;
    if (auto* s = m.get<model::SideMilling>(step.operation)) {
      s->radial_cutting_depth = a.ae_mm;
    } else if (auto* b = m.get<model::BottomAndSideMilling>(step.operation)) {
      b->radial_cutting_depth = a.ae_mm;
    } else {
      has = false;
    }
    if (has) bind(step.operation, "radial_cutting_depth", with({depth}));
    if (const auto* o = m.get<model::PlaneMilling>(step.operation)) {
      const AnyRef strategy = o->its_machining_strategy;
      if (auto* t = m.get<model::Two5dMillingStrategy>(strategy);
          t != nullptr && step.cutter.cutting_diameter_mm > 0.0) {
        t->overlap = std::max(0.0, 1.0 - a.ae_mm / step.cutter.cutting_diameter_mm);
        bind(strategy, "overlap", with({depth}));
      }
    }
  }
  if (!step.open_technology) return;
  const auto made = own_technology(plan, step.operation);
  auto* t = m.get<model::MillingTechnology>(made);
  if (!step.keep_speed) {
    t->spindle = noun_sense(step.cutter) * a.n_rpm;
    t->cutspeed.reset();
  }
  if (!step.keep_feed) {
    t->feedrate = a.feed_mm_min;
    t->feedrate_per_tooth.reset();
  }
  if (m.holds<model::Tapping>(step.operation)) {
    // Feed and speed of a tap belong together: no override may part them.
    t->synchronize_spindle_with_feed = true;
    t->inhibit_feedrate_override = true;
    t->inhibit_spindle_override = true;
  }
  const std::vector<DecisionKey> sizes = with({depth, width_key(m, step.operation)});
  if (!step.keep_speed) bind(made, "spindle", sizes);
  if (!step.keep_feed) {
    std::vector<DecisionKey> on = sizes;
    on.push_back({made, "spindle"});
    bind(made, "feedrate", std::move(on));
  }
  if (!cases || !cases->bind()) return;
  const auto from_cases = [&](AnyRef object, const char* attribute) {
    model::Reason from = reason_of(*cases);
    from.text += "; " + why.text;
    auto* d = ledger.find(object, attribute);
    if (d == nullptr) return;
    d->binder = Binder::kCase;
    d->reason = ledger.reason(std::move(from));
  };
  if (!step.keep_speed) from_cases(made, "spindle");
  if (!step.keep_feed) from_cases(made, "feedrate");
  if (depth_open && cases->advice.lowered && cases->advice.start.ap_mm > 0.0)
    from_cases(step.operation, depth.attribute.c_str());
}

void state_path(Model& m, const StepDraft& step, const std::shared_ptr<const model::CutterPath>& path) {
  if (!m.holds<model::MachiningOperation>(step.operation)) return;
  model::CutterLocationTrajectory t;
  t.its_priority = true;
  t.its_type = model::ToolpathType::kTrajectoryPath;
  t.path = path;
  model::ToolpathList list;
  list.its_list.push_back(m.add(std::move(t)));
  const auto made = m.add(std::move(list));
  m.get<model::MachiningOperation>(step.operation)->its_toolpath = made;
}

void record_path(model::Plan& plan, const std::vector<StepDraft>& steps, const StepDraft& step,
                 const std::shared_ptr<const model::CutterPath>& path, const std::string& deviation) {
  Model& m = plan.model;
  state_path(m, step, path);
  std::vector<DecisionKey> on = decided_before(plan, steps, step);
  for (const DecisionKey& k :
       {DecisionKey{step.operation, "its_machining_strategy"},
        DecisionKey{step.operation, "axial_cutting_depth"}, width_key(m, step.operation)}) {
    if (plan.ledger.find(k.object, k.attribute) != nullptr) on.push_back(k);
  }
  plan.ledger.bind(
      step.operation, "its_toolpath", Binder::kRule,
      {"path.generated",
       "computed from feature, cutter, depths and strategy" + (deviation.empty() ? "" : "; " + deviation),
       "planner/making/toolpath"},
      std::move(on));
}

}  // namespace capstan::step
