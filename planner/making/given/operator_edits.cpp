#include "planner/making/given/operator_edits.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/making/draft/draft.h"
#include "planner/making/given/listed_steps.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/record/record.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/by_planning.h"
#include "planner/model/plan/decision/reopen_all.h"
#include "planner/model/plan/edit/restrictions.h"
#include "tooling/library/nouns/nouns.h"

namespace capstan::given {
namespace {

using draft::StepDraft;
using model::AnyRef;
using model::Cutter;
using model::DecisionKey;
using model::Edit;
using model::EditKind;
using model::EditOf;
using model::Model;
using model::StepNames;

constexpr const char* kTool = "its_tool";
constexpr const char* kDepth = "axial_cutting_depth";

/// The workingsteps of a plan that have an operation, as drafts: step, feature, operation.
std::vector<StepDraft> steps_of(const model::Plan& plan) {
  std::vector<StepDraft> out;
  for (const AnyRef r : steps_in_order(plan)) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(r);
    if (ws == nullptr || !plan.model.holds<model::MachiningOperation>(ws->its_operation)) continue;
    StepDraft s;
    s.step = model::Ref<model::Executable>(r);
    s.feature = ws->its_feature;
    s.operation = ws->its_operation;
    out.push_back(std::move(s));
  }
  return out;
}

model::Real* depth_of(Model& m, AnyRef operation) {
  if (auto* o = m.get<model::PlaneMilling>(operation)) return &o->axial_cutting_depth;
  if (auto* o = m.get<model::SideMilling>(operation)) return &o->axial_cutting_depth;
  if (auto* o = m.get<model::BottomAndSideMilling>(operation)) return &o->axial_cutting_depth;
  return nullptr;
}

std::string_view strategy_word(const Model& m, AnyRef operation) {
  const auto* o = m.get<model::Two5dMillingOperation>(operation);
  if (o == nullptr || !o->its_machining_strategy.set()) return {};
  const AnyRef s = o->its_machining_strategy;
  if (m.holds<model::ExplicitStrategy>(s)) return model::kConstantEngagementWord;
  static constexpr std::pair<model::TypeId, model::StrategyKind> kKinds[] = {
      {model::TypeId::kBidirectionalMilling, model::StrategyKind::kBidirectional},
      {model::TypeId::kUnidirectionalMilling, model::StrategyKind::kUnidirectional},
      {model::TypeId::kContourParallel, model::StrategyKind::kContourParallel},
      {model::TypeId::kContourSpiral, model::StrategyKind::kContourSpiral},
      {model::TypeId::kContourBidirectional, model::StrategyKind::kContourBidirectional},
      {model::TypeId::kCenterMilling, model::StrategyKind::kCenterMilling}};
  for (const auto& [type, kind] : kKinds) {
    if (s.type == type) return model::word_of(kind);
  }
  return {};
}

AnyRef technology_of(const Model& m, AnyRef operation) {
  const auto* op = m.get<model::MachiningOperation>(operation);
  return op == nullptr ? AnyRef{} : AnyRef(op->its_technology);
}

bool is_pinned(const model::Ledger& ledger, AnyRef object, std::string_view attribute) {
  const auto* d = object.set() ? ledger.find(object, attribute) : nullptr;
  return d != nullptr && d->pinned && d->state == model::DecisionState::kBound;
}

std::string called(const Model& m, const StepDraft& s) { return "step '" + draft::name_of(m, s) + "'"; }

Diagnostic conflict(const model::Plan& plan, const std::string& what) {
  return {
      .code = "EDIT-CONFLICT", .message = what, .file = plan.file_name, .hint = "take one of the two back"};
}

/// The cutter of a step, as its nouns or the plan say; nothing: it is open.
std::optional<Cutter> cutter_of(const model::Plan& plan, AnyRef operation,
                                const std::vector<Cutter>& library) {
  const auto* op = plan.model.get<model::MachiningOperation>(operation);
  if (op == nullptr || !op->its_tool.set() || plan.ledger.is_open(operation, kTool) ||
      !plan.model.holds<model::MachiningTool>(op->its_tool) ||
      tooling::is_requirement(plan.model, op->its_tool))
    return std::nullopt;
  Job silent;  // what is to be said of the tool is said when it is used
  auto cutter = tooling::cutter_from_nouns(plan.model, op->its_tool, silent, library);
  if (!cutter) return std::nullopt;
  return *std::move(cutter);
}

/// "features TOP FACE, POCKET; steps TOP FACE mill, ...".
std::string all_there_is(const std::vector<std::string>& features, const std::vector<std::string>& steps) {
  constexpr std::size_t kMost = 40;
  const auto list = [&](const std::vector<std::string>& names) {
    std::string out;
    for (std::size_t i = 0; i < std::min(kMost, names.size()); ++i) out += (i == 0 ? "" : ", ") + names[i];
    return out + (names.size() > kMost ? ", ..." : "");
  };
  return "features: " + list(features) + "; workingsteps: " + list(steps);
}

/// Takes the edits one by one.
class Taker {
 public:
  Taker(model::Plan& plan, const std::vector<Edit>& edits, const std::vector<Cutter>& library)
      : plan_(plan), edits_(edits), library_(library), steps_(steps_of(plan)) {}

  Result<Taken> run(bool all) {
    for (const Edit& e : edits_) {
      if (auto ok = names_something(e.where, e); !ok) return tl::unexpected(ok.error());
      if (e.kind == EditKind::kOrder) {
        if (auto ok = names_something(e.before, e); !ok) return tl::unexpected(ok.error());
      }
      if (auto ok = take(e); !ok) return tl::unexpected(ok.error());
    }
    if (all) release();
    return std::move(out_);
  }

 private:
  StepNames names_of(const StepDraft& s) const { return draft::edit_names(plan_.model, s); }

  Status names_something(const std::string& pattern, const Edit& e) {
    if (pattern == "*") return {};
    std::vector<std::string> features, steps;
    bool found = false;
    for (const AnyRef f : plan_.model.all_below(model::TypeId::kManufacturingFeature)) {
      const auto name = draft::feature_name(plan_.model, f);
      if (name.empty()) continue;
      features.emplace_back(name);
      found = found || model::names(pattern, name);
    }
    for (const StepDraft& s : steps_) {
      const StepNames n = names_of(s);
      steps.emplace_back(n.step);
      found = found || model::names(pattern, n);
    }
    if (found) return {};
    std::vector<std::string> known = features;
    known.insert(known.end(), steps.begin(), steps.end());
    std::string near;
    for (const std::string& n : nearest_names(pattern, known)) near += (near.empty() ? "" : ", ") + n;
    return fail({.code = "EDIT-NOTHING",
                 .message = model::words_of(e) + ": '" + pattern + "' names no feature and no workingstep" +
                            (near.empty() ? "" : ". Did you mean " + near + "?"),
                 .file = plan_.file_name,
                 .expected = all_there_is(features, steps)});
  }

  Status take(const Edit& e) {
    if (e.kind != EditKind::kSet && e.kind != EditKind::kPin) {
      out_.edits.push_back(e);
      return {};
    }
    std::vector<std::size_t> meant;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (model::names(e.where, names_of(steps_[i]))) meant.push_back(i);
    }
    // A number is set where there is one: the depth of the mills among the steps that a pattern names.
    if (e.of == EditOf::kDepth && meant.size() > 1)
      std::erase_if(meant,
                    [&](std::size_t i) { return depth_of(plan_.model, steps_[i].operation) == nullptr; });
    if (meant.empty()) return no_value(e, "'" + e.where + "' names no workingstep that has it");
    const Edit* as_said = &e;
    std::optional<Edit> resolved;
    for (const std::size_t i : meant) {
      auto held = e.value.empty() ? held_value(e, steps_[i]) : Result<Edit>(resolved ? *resolved : e);
      if (!held) return tl::unexpected(held.error());
      if (auto ok = set(*as_said, *held, i); !ok) return ok;
      if (e.value.empty()) {
        out_.edits.push_back(*held);
      } else {
        resolved = *held;
      }
    }
    if (resolved) out_.edits.push_back(*resolved);
    return {};
  }

  tl::unexpected<Diagnostic> no_value(const Edit& e, const std::string& why) const {
    return fail({.code = "EDIT-VALUE", .message = model::words_of(e) + ": " + why, .file = plan_.file_name});
  }

  /// A pin without a value holds what is there.
  Result<Edit> held_value(const Edit& e, const StepDraft& s) {
    Edit out = e;
    const Model& m = plan_.model;
    out.where = draft::name_of(m, s);
    const AnyRef technology = technology_of(m, s.operation);
    const auto* t = m.get<model::MillingTechnology>(technology);
    const auto open = [&](AnyRef o, const char* a) { return plan_.ledger.is_open(o, a); };
    std::optional<double> number;
    if (e.of == EditOf::kTool) {
      if (const auto c = cutter_of(plan_, s.operation, plan_.cutters)) out.value = c->id;
    } else if (e.of == EditOf::kFeed) {
      if (t != nullptr && t->feedrate && !open(technology, "feedrate")) number = *t->feedrate;
    } else if (e.of == EditOf::kSpeed) {
      if (t != nullptr && t->spindle && !open(technology, "spindle")) number = std::abs(*t->spindle);
    } else if (const auto* depth = depth_of(plan_.model, s.operation)) {
      if (*depth && !open(s.operation, kDepth)) number = **depth;
    }
    if (number) {
      out.value = shortest(*number);
      out.number = *number;
    }
    if (out.value.empty())
      return no_value(e, called(m, s) + " has no " + std::string(model::word_of(e.of)) + " to hold");
    return out;
  }

  Status set(const Edit& said, Edit& e, std::size_t i) {
    switch (e.of) {
      case EditOf::kTool:
        return set_tool(said, e, i);
      case EditOf::kFeed:
        return set_feed(said, e, steps_[i]);
      case EditOf::kSpeed:
        return set_speed(said, e, steps_[i]);
      default:
        return set_depth(said, e, steps_[i]);
    }
  }

  /// Who holds it now, and why. `changed`: what depends on the value is open again.
  void hold(const Edit& said, AnyRef object, const char* attribute, bool changed) {
    model::Ledger& ledger = plan_.ledger;
    const DecisionKey key{object, attribute};
    held_.insert(key);
    model::Decision d;
    if (const auto* now = ledger.find(object, attribute)) {
      d.depends_on = now->depends_on;
      if (now->state == model::DecisionState::kOpen) changed = true;
    }
    if (changed) {
      if (auto* now = ledger.find(object, attribute)) now->pinned = false;
      model::reopen_all(ledger, {key});
      out_.opened = true;
    }
    // What it was chosen from no longer decides it.
    d.depends_on.clear();
    d.binder = model::Binder::kOperator;
    d.pinned = true;
    d.reason = ledger.reason(model::reason_of(said));
    ledger.set(key, std::move(d));
  }

  Result<Cutter> find_tool(const Edit& e) const {
    const auto numbered = [&](const Cutter& c) {
      return c.pocket > 0 && e.value == "T" + std::to_string(c.pocket);
    };
    const auto named = [&](const Cutter& c) { return c.id == e.value; };
    for (const std::vector<Cutter>* cutters : {&library_, &std::as_const(plan_.cutters)}) {
      const auto by_name = std::find_if(cutters->begin(), cutters->end(), named);
      if (by_name != cutters->end()) return *by_name;
    }
    for (const std::vector<Cutter>* cutters : {&library_, &std::as_const(plan_.cutters)}) {
      const auto by_number = std::find_if(cutters->begin(), cutters->end(), numbered);
      if (by_number != cutters->end()) return *by_number;
    }
    std::vector<std::string> known;
    std::string numbers;
    for (const std::vector<Cutter>* cutters : {&std::as_const(plan_.cutters), &library_}) {
      for (const Cutter& c : *cutters) {
        known.push_back(c.id);
        if (c.pocket <= 0) continue;
        known.push_back("T" + std::to_string(c.pocket));
        numbers += (numbers.empty() ? "" : ", ") + known.back() + " " + c.id;
      }
    }
    Diagnostic d = unknown_name("tool", e.value, known, "capstan tools list");
    d.message = model::words_of(e) + ": " + d.message;
    if (!numbers.empty()) d.expected = "a tool's name, or one of " + numbers;
    return fail(std::move(d));
  }

  Status set_tool(const Edit& said, Edit& e, std::size_t i) {
    const StepDraft& s = steps_[i];
    auto tool = find_tool(e);
    if (!tool) return tl::unexpected(tool.error());
    if (const auto no = model::barred(edits_, names_of(s), *tool))
      return fail(conflict(plan_, called(plan_.model, s) + ": " + model::words_of(said) + " sets '" +
                                      tool->id + "', against " + no->why));
    e.value = tool->id;
    auto* op = plan_.model.get<model::MachiningOperation>(s.operation);
    const auto now = cutter_of(plan_, s.operation, plan_.cutters);
    const bool same = now && now->id == tool->id;
    if (!same && step::has_given_path(plan_, s))
      return no_value(said,
                      called(plan_.model, s) +
                          " has a path of its file, which fixes the tool; re-open it (--reopen operations)");
    if (!same) {
      const auto noun = tooling::tool_noun(plan_.model, *tool);
      op = plan_.model.get<model::MachiningOperation>(s.operation);
      op->its_tool = noun;
      if (model::find_cutter(plan_, tool->id) == nullptr) plan_.cutters.push_back(*tool);
    }
    hold(said, s.operation, kTool, !same);
    if (!same) open_later_cuts(i);
    return {};
  }

  /// The cuts of later steps of the feature meet what this tool leaves.
  void open_later_cuts(std::size_t i) {
    const Model& m = plan_.model;
    std::vector<DecisionKey> open;
    for (std::size_t k = i + 1; k < steps_.size(); ++k) {
      if (!steps_[i].feature.set() || steps_[k].feature != steps_[i].feature) continue;
      const AnyRef op = steps_[k].operation, technology = technology_of(m, op);
      for (const DecisionKey& key :
           {DecisionKey{op, kDepth}, DecisionKey{op, "radial_cutting_depth"},
            DecisionKey{technology, "spindle"}, DecisionKey{technology, "feedrate"}}) {
        const auto* d = key.object.set() ? plan_.ledger.find(key.object, key.attribute) : nullptr;
        // Depths that a rule fixed are those of its chain.
        if (d == nullptr || d->pinned) continue;
        if (d->binder == model::Binder::kOptimiser || d->binder == model::Binder::kCase) open.push_back(key);
      }
    }
    model::reopen_all(plan_.ledger, open);
  }

  Status within_limits(const Edit& said, const Edit& e, const StepDraft& s) const {
    const model::EditLimits limits = model::limits_of(edits_, names_of(s));
    const auto& [most, by] = e.of == EditOf::kFeed    ? std::pair(limits.feed_mm_min, limits.feed_by)
                             : e.of == EditOf::kSpeed ? std::pair(limits.speed_rpm, limits.speed_by)
                                                      : std::pair(limits.depth_mm, limits.depth_by);
    if (!most || e.number <= *most) return {};
    return fail(conflict(plan_, called(plan_.model, s) + ": " + model::words_of(said) + " sets " +
                                    trimmed(e.number, 4) + " " + std::string(model::unit_of(e.of)) +
                                    ", against " + by));
  }

  Status set_feed(const Edit& said, const Edit& e, const StepDraft& s) {
    if (plan_.model.holds<model::Tapping>(s.operation))
      return no_value(said,
                      called(plan_.model, s) + " taps: its feed is the pitch times the speed; set the speed");
    if (auto ok = within_limits(said, e, s); !ok) return ok;
    const auto technology = step::own_technology(plan_, s.operation);
    auto* t = plan_.model.get<model::MillingTechnology>(technology);
    const bool same = t->feedrate && *t->feedrate == e.number && !t->feedrate_per_tooth;
    t->feedrate = e.number;
    t->feedrate_per_tooth.reset();
    hold(said, technology, "feedrate", !same);
    return {};
  }

  Status set_speed(const Edit& said, const Edit& e, const StepDraft& s) {
    if (auto ok = within_limits(said, e, s); !ok) return ok;
    const auto cutter = cutter_of(plan_, s.operation, plan_.cutters);
    const auto technology = step::own_technology(plan_, s.operation);
    auto* t = plan_.model.get<model::MillingTechnology>(technology);
    const bool left = cutter && cutter->hand == model::Hand::kLeft;
    // ISO 14649: negative is clockwise, as a right-hand cutter turns.
    const double speed = left ? e.number : -e.number;
    const bool same = t->spindle && *t->spindle == speed && !t->cutspeed;
    t->spindle = speed;
    t->cutspeed.reset();
    hold(said, technology, "spindle", !same);
    return {};
  }

  Status set_depth(const Edit& said, const Edit& e, const StepDraft& s) {
    model::Real* depth = depth_of(plan_.model, s.operation);
    if (depth == nullptr)
      return no_value(said,
                      called(plan_.model, s) + " has no depth of its levels: it is no milling with levels");
    if (auto ok = within_limits(said, e, s); !ok) return ok;
    const bool same = *depth && **depth == e.number;
    *depth = e.number;
    hold(said, s.operation, kDepth, !same);
    return {};
  }

  /// What an edit held and none holds now.
  void release() {
    std::vector<DecisionKey> open;
    for (const auto& [key, d] : plan_.ledger.entries()) {
      if (d.pinned && plan_.ledger.reason(d.reason).id == model::kByEdit && !held_.contains(key))
        open.push_back(key);
    }
    for (const DecisionKey& key : open) plan_.ledger.find(key.object, key.attribute)->pinned = false;
    if (!open.empty()) out_.opened = true;
    model::reopen_all(plan_.ledger, open);
  }

  model::Plan& plan_;
  const std::vector<Edit>& edits_;
  const std::vector<Cutter>& library_;
  const std::vector<StepDraft> steps_;
  Taken out_;
  std::set<DecisionKey> held_;
};

}  // namespace

Result<Taken> take_edits(model::Plan& plan, const std::vector<Edit>& edits,
                         const std::vector<Cutter>& library, bool all) {
  return Taker(plan, edits, library).run(all);
}

Status open_beyond_edits(model::Plan& plan, const std::vector<Edit>& edits,
                         const std::vector<Cutter>& library, std::size_t cut, Job& job) {
  const bool any = std::any_of(edits.begin(), edits.end(), [](const Edit& e) {
    return e.kind == EditKind::kLimit || e.kind == EditKind::kForbid;
  });
  if (!any) return {};
  const auto kept = [&](const std::string& what, const std::string& why) {
    return fail({.code = "EDIT-KEPT",
                 .message = what + " is the file's, against " + why,
                 .file = plan.file_name,
                 .hint = "re-open the operations (--reopen operations), or take the edit back"});
  };
  const std::vector<StepDraft> steps = steps_of(plan);
  for (std::size_t i = cut; i < steps.size(); ++i) {
    const StepDraft& s = steps[i];
    const StepNames names = draft::edit_names(plan.model, s);
    const std::string what = called(plan.model, s);
    if (const auto no = model::barred_operation(edits, names, s.operation.type))
      return kept("the operation of " + what, no->why);
    if (const auto no = model::barred_strategy(edits, names, strategy_word(plan.model, s.operation)))
      return kept("the strategy of " + what, no->why);
    const auto cutter = cutter_of(plan, s.operation, library);
    if (const auto no = cutter ? model::barred(edits, names, *cutter) : std::nullopt) {
      if (is_pinned(plan.ledger, s.operation, kTool))
        return fail(conflict(plan, what + ": its tool '" + cutter->id + "' is pinned (" +
                                       plan.ledger.reason(plan.ledger.find(s.operation, kTool)->reason).text +
                                       "), against " + no->why));
      if (step::has_given_path(plan, s))
        return kept("the path of " + what + " with '" + cutter->id + "'", no->why);
      model::reopen_all(plan.ledger, {{s.operation, kTool}});
      job.warn("EDIT-OPENED", what + ": its tool is chosen anew: " + no->why);
    }
    const model::EditLimits limits = model::limits_of(edits, names);
    if (!limits.any()) continue;
    const auto given = step::given_technology(plan.model, s.operation, cutter.value_or(Cutter{}));
    const auto beyond = [](const std::optional<double>& value, const std::optional<double>& most) {
      return value && most && std::abs(*value) > *most;
    };
    const auto open = [&](AnyRef object, const char* attribute, const std::string& by) -> Status {
      if (is_pinned(plan.ledger, object, attribute))
        return fail(conflict(plan, what + ": its " + attribute + " is pinned, against " + by));
      const auto* d = plan.ledger.find(object, attribute);
      if (d != nullptr && d->state == model::DecisionState::kOpen) return {};
      const std::string said = what + ": its " + attribute + " is chosen anew: " + by;
      // What a file gives is changed openly; what planning chose is its own to change.
      model::by_planning(d) ? job.note("EDIT-OPENED", said, "") : job.warn("EDIT-OPENED", said);
      model::reopen_all(plan.ledger, {{object, attribute}});
      return {};
    };
    if (beyond(given.rpm, limits.speed_rpm)) {
      if (auto ok = open(step::own_technology(plan, s.operation), "spindle", limits.speed_by); !ok) return ok;
    }
    if (beyond(given.feed_mm_min, limits.feed_mm_min)) {
      if (auto ok = open(step::own_technology(plan, s.operation), "feedrate", limits.feed_by); !ok) return ok;
    }
    const model::Real* depth = depth_of(plan.model, s.operation);
    if (depth != nullptr && *depth && beyond(**depth, limits.depth_mm)) {
      if (auto ok = open(s.operation, kDepth, limits.depth_by); !ok) return ok;
    }
  }
  return {};
}

namespace {

/// The set edit that holds of a step's attribute: the last that means it; null: none.
const Edit* last_set(const std::vector<Edit>& edits, EditOf of, const StepNames& names) {
  const Edit* out = nullptr;
  for (const Edit& e : edits) {
    if (e.kind == EditKind::kSet && e.of == of && model::names(e.where, names)) out = &e;
  }
  return out;
}

}  // namespace

std::vector<model::Finding> broken_edits(const model::Plan& plan, const std::vector<Edit>& edits) {
  std::vector<model::Finding> out;
  std::vector<StepDraft> steps;
  for (const model::StepResult& r : plan.steps) {
    StepDraft s;
    s.step = r.step;
    if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(r.step)) {
      s.feature = ws->its_feature;
      s.operation = ws->its_operation;
    }
    steps.push_back(std::move(s));
  }
  const auto broken = [&](std::size_t i, const std::string& what) {
    out.push_back({.code = "EDIT-BROKEN", .step = model::step_id(plan, plan.steps[i]), .message = what});
  };
  const auto above = [](double value, double most) { return value > most * (1.0 + 1e-9); };
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const model::StepResult& r = plan.steps[i];
    const StepDraft& s = steps[i];
    if (!s.operation.set()) continue;
    const StepNames names = draft::edit_names(plan.model, s);
    if (const Cutter* c = model::find_cutter(plan, r.cutter_id)) {
      if (const auto no = model::barred(edits, names, *c))
        broken(i, "tool '" + c->id + "' against " + no->why);
    }
    if (const auto no = model::barred_operation(edits, names, s.operation.type))
      broken(i, "its operation is against " + no->why);
    if (const auto no = model::barred_strategy(edits, names, strategy_word(plan.model, s.operation)))
      broken(i, "its strategy is against " + no->why);
    const model::EditLimits limits = model::limits_of(edits, names);
    double feed = r.feed_mm_min, speed = std::abs(r.spindle_rpm);
    if (r.schedule != nullptr && r.path != nullptr) {
      for (std::size_t k = 0; k < r.path->size() && k < r.schedule->feed_mm_min.size(); ++k) {
        if (r.path->kind[k] != model::MoveKind::kRapid && r.path->kind[k] != model::MoveKind::kDwell)
          feed = std::max(feed, r.schedule->feed_mm_min[k]);
        if (k < r.schedule->spindle_rpm.size()) speed = std::max(speed, std::abs(r.schedule->spindle_rpm[k]));
      }
    }
    if (limits.feed_mm_min && above(feed, *limits.feed_mm_min))
      broken(i, "feed " + trimmed(feed, 1) + " mm/min against " + limits.feed_by);
    if (const Edit* set = last_set(edits, EditOf::kSpeed, names);
        set != nullptr && std::abs(std::abs(r.spindle_rpm) - set->number) > 1e-3)
      broken(i, "speed " + trimmed(std::abs(r.spindle_rpm), 1) + " 1/min against " + model::words_of(*set));
    if (const Edit* set = last_set(edits, EditOf::kDepth, names);
        set != nullptr && depth_of(const_cast<Model&>(plan.model), s.operation) != nullptr &&
        above(r.axial_depth_mm, set->number))
      broken(i, "depth " + trimmed(r.axial_depth_mm, 3) + " mm against " + model::words_of(*set));
    if (limits.speed_rpm && above(speed, *limits.speed_rpm))
      broken(i, "speed " + trimmed(speed, 1) + " 1/min against " + limits.speed_by);
    auto& m = const_cast<Model&>(plan.model);  // read only
    if (limits.depth_mm && depth_of(m, s.operation) != nullptr && above(r.axial_depth_mm, *limits.depth_mm))
      broken(i, "depth " + trimmed(r.axial_depth_mm, 3) + " mm against " + limits.depth_by);
  }
  for (const Edit& e : edits) {
    if (e.kind != EditKind::kOrder) continue;
    bool any_first = false, any_second = false;
    std::optional<std::size_t> later;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const StepNames n = draft::edit_names(plan.model, steps[i]);
      const bool first = model::names(e.where, n), second = model::names(e.before, n);
      any_first = any_first || (first && !second);
      any_second = any_second || (second && !first);
      if (second && !first && !later) later = i;
      if (first && !second && later) {
        broken(i, "it comes after '" + draft::name_of(plan.model, steps[*later]) + "', against " +
                      model::words_of(e));
        break;
      }
    }
    if (!any_first || !any_second)
      out.push_back({.code = "EDIT-BROKEN",
                     .severity = Severity::kWarning,
                     .step = {},
                     .message = model::words_of(e) +
                                " orders nothing: no planned step is named by one of its patterns and not by "
                                "both; name those that come first, and those that come later, apart"});
  }
  return out;
}

}  // namespace capstan::given
