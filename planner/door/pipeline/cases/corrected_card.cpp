#include "planner/door/pipeline/cases/corrected_card.h"

#include <fmt/format.h>

#include <limits>
#include <map>
#include <optional>
#include <type_traits>
#include <utility>

#include "casebase/casebase.h"
#include "casebase/recall/advice.h"
#include "casebase/tune/card.h"
#include "planner/door/pipeline/trial.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/resources/by_cases.h"
#include "planner/model/plan/resources/material_fields.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/motion/time.h"

namespace capstan::pipeline {
namespace {

namespace tune = casebase::tune;

/// All cases are heard: in a sample the one force that forbids to lower anything might be missing.
constexpr std::size_t kMostHeard = std::numeric_limits<std::size_t>::max();

void take(const tune::CardCorrection& c, model::WorkMaterial& card) {
  const std::string source = std::string(model::kByCases) + c.words();
  if (c.model == tune::CardModel::kForce) {
    auto set = mechanics::corrected_set(
        card, c.substrate, {.factor = c.factor, .spread = c.spread, .chip_mm = c.chip_mm, .source = source});
    card.mechanistic.insert(card.mechanistic.begin(), std::move(set));
    return;
  }
  model::ToolLifeLaw law = c.law;
  law.source = source;
  card.life.insert(card.life.begin(), std::move(law));
}

/// "310.5 m/min, 0.08 mm per tooth, 2 mm deep with endmill_8: 12.5 s".
std::string words_of(const model::StepResult& s) {
  return casebase::words_of(casebase::Values{s.vc_m_min, s.fz_mm, s.axial_depth_mm, s.radial_depth_mm}) +
         " with " + s.cutter_id + ": " + motion::duration_text(s.cutting_s);
}

bool same_cut(const model::StepResult& a, const model::StepResult& b) {
  return a.cutter_id == b.cutter_id && a.vc_m_min == b.vc_m_min && a.fz_mm == b.fz_mm &&
         a.axial_depth_mm == b.axial_depth_mm && a.radial_depth_mm == b.radial_depth_mm &&
         a.cutting_s == b.cutting_s;
}

/// Where the decision on the speed of a step stands.
model::Decision* speed_of(model::Plan& plan, model::AnyRef step) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(step);
  const auto* op = ws == nullptr ? nullptr : plan.model.get<model::MachiningOperation>(ws->its_operation);
  if (op == nullptr || !op->its_technology.set()) return nullptr;
  return plan.ledger.find(op->its_technology, "spindle");
}

/// Its fields that count, one behind the other.
template <class T>
void write(std::string& out, const T& value) {
  if constexpr (model::HasFields<T>) {
    model::for_each_field(value, [&](const auto& row, const auto& v) {
      if (row.not_told == nullptr) write(out, v);
    });
  } else if constexpr (std::is_floating_point_v<T>) {
    out += fmt::format("{:.9g};", value);
  } else if constexpr (std::is_convertible_v<T, std::string_view>) {
    out.append(value).push_back(';');
  } else if constexpr (requires { value.first; }) {
    write(out, value.first);
    write(out, value.second);
  } else {
    for (const auto& one : value) write(out, one);
    out.push_back(';');
  }
}

std::string time_text(const model::Plan& plan) {
  const auto time = motion::time_of(plan);
  std::string out = time ? motion::duration_text(time->total_s()) : std::string("an unknown time");
  if (!plan.unplanned.empty())
    out += ", " + counted(plan.unplanned.size(), "feature", "features") + " not planned";
  return out;
}

}  // namespace

CorrectedCard corrected_card(const casebase::CaseBase& cases, const model::WorkMaterial& card,
                             const std::string& machine_id) {
  CorrectedCard out{.of = model::without_cases(card), .card = {}, .rows = {}, .told = {}};
  out.card = out.of;
  const std::string group = casebase::material_group_of(out.of);
  const auto heard = cases.measured_in(group, machine_id, kMostHeard);
  const bool all = cases.whole() && heard.size() == cases.state_of_measured(group, machine_id, {}).cases;
  const auto spread_of = [&](model::Substrate s) { return mechanics::force_margin(out.of, s).spread; };
  for (const tune::CardCorrection& c :
       tune::card_corrections(heard, out.of, spread_of, all ? tune::Given::kAll : tune::Given::kSome)) {
    const std::string far = c.far_words();
    if (!far.empty())
      out.told.push_back({.code = "CASE-FEED",
                          .severity = c.cases == 0 ? Severity::kWarning : Severity::kNote,
                          .message = far,
                          .hint = "measure forces at the planned feed, with the override at 100 %"});
    if (c.taken()) {
      take(c, out.card);
      out.rows.push_back({"model by cases", c.all_words(), "cases " + c.named()});
      out.told.push_back(
          {.code = "CASE-MODEL",
           .severity = c.beyond.empty() && c.cut_short.empty() ? Severity::kNote : Severity::kWarning,
           .message = c.words() + "; by cases " + c.named()});
    } else {
      const bool few = all && c.edges < tune::kLeastEdges && c.beyond.empty();
      out.told.push_back({.code = "CASE-MODEL",
                          .severity = few ? Severity::kNote : Severity::kWarning,
                          .message = c.words() + "; not taken: " + c.why_not});
    }
  }
  if (!all) return out;  // what the base says of itself is not all that it was given
  if (std::string state = state_of_card(cases, out.card, machine_id, heard.size()); !state.empty())
    out.rows.push_back({std::string(kCardByCases), std::move(state),
                        counted(heard.size(), "measured case", "measured cases")});
  return out;
}

std::string state_of_card(const casebase::CaseBase& cases, const model::WorkMaterial& card,
                          const std::string& machine_id, std::optional<std::size_t> heard) {
  std::string bytes = fmt::format("rules {};", tune::kCardRules);
  write(bytes, card);
  const auto state = cases.state_of_measured(casebase::material_group_of(card), machine_id, bytes);
  return state.cases == 0 || state.cases != heard.value_or(state.cases) ? std::string() : state.sum;
}

void tell_without_cases(model::Plan& made, const model::Plan& read, const Inputs& inputs,
                        const Policy& policy, Job& job) {
  const bool bound = policy.bind == Bind::kAll && !policy.window;
  if (!bound || !inputs.cases || !model::corrected_by_cases(made.material)) return;
  if (job.deadline() || job.stop_requested()) return;
  Inputs without = inputs;
  without.cases = nullptr;
  std::erase_if(without.provenance, [](const model::Provenance& p) { return p.what == "cases"; });
  Job trial;
  begin_trial(trial, job);
  const auto other = bind_checked(read, without, policy, trial, {.tells_needed = false});
  if (job.stop_requested()) return;
  if (!other) {
    job.note("CASE-WITHOUT",
             "what the plan would be without cases is not known, for that could not be planned: " +
                 other.error().message);
    return;
  }
  std::map<std::string, const model::StepResult*> then;
  for (const model::StepResult& s : other->plan.steps) then.emplace(model::step_id(other->plan, s), &s);
  std::size_t changed = 0;
  for (const model::StepResult& s : made.steps) {
    const auto at = then.find(model::step_id(made, s));
    if (at != then.end() && same_cut(s, *at->second)) continue;
    ++changed;
    if (auto* d = speed_of(made, s.step); d != nullptr)
      d->rejected.push_back(
          {"the plan without cases",
           at == then.end() ? "it has no such step" : words_of(*at->second) + ", instead of " + words_of(s)});
  }
  const std::string value = time_text(other->plan);
  const std::string steps = std::to_string(changed) + " of " + counted(made.steps.size(), "step", "steps");
  made.provenance.push_back({"time without cases", value, "planned once more; " + steps + " differ"});
  job.note("CASE-WITHOUT", "without cases the plan would take " + value + " in place of " + time_text(made) +
                               "; " + steps + " differ");
}

}  // namespace capstan::pipeline
