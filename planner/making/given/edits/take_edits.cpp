#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/control_options.h"
#include "planner/making/given/edits/edited_steps.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/making/given/edits/value_limits.h"
#include "planner/making/step/path/job_of.h"
#include "planner/making/step/record/record.h"
#include "planner/model/plan/decision/reopen_all.h"
#include "planner/model/plan/edit/cycles.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/restrictions.h"
#include "planner/model/plan/range/ranges.h"
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
  Taker(model::Plan& plan, const std::vector<Edit>& edits, const std::vector<Cutter>& library,
        const model::Machine& machine, Job& job)
      : plan_(plan),
        edits_(edits),
        library_(library),
        machine_(machine),
        job_(job),
        steps_(edited_steps(plan)) {}

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
    leave_without(e, meant);
    if (meant.empty()) return no_value(e, "'" + e.where + "' names no workingstep that has it");
    if (e.of == EditOf::kCycles) return take_cycles(e);
    std::optional<Edit> resolved;
    std::set<const Edit*> yielded;
    for (const std::size_t i : meant) {
      const Edit* decides = model::deciding(edits_, e.of, names_of(steps_[i]));
      if (decides != &e) {
        // Who gives the general one last may take it for the one that holds.
        if (decides < &e && yielded.insert(decides).second)
          job_.note("EDIT-YIELDS",
                    model::words_of(e) + " yields to " + model::words_of(*decides) +
                        ", which names its workingsteps more closely",
                    "");
        continue;
      }
      auto held = e.value.empty() ? held_value(e, steps_[i]) : Result<Edit>(resolved ? *resolved : e);
      if (!held) return tl::unexpected(held.error());
      if (auto ok = set(e, *held, i); !ok) return ok;
      if (e.value.empty()) {
        out_.edits.push_back(*held);
      } else {
        resolved = *held;
      }
    }
    if (!e.value.empty()) out_.edits.push_back(resolved ? *resolved : e);
    return {};
  }

  /// The plan keeps it, and whoever writes its program asks for it: no value of the part changes.
  Status take_cycles(const Edit& e) {
    const std::string& control = machine_.control.dialect;
    if (e.value != model::kExplicitMoves && model::find_control_option(control, "cycles") == nullptr)
      return no_value(e, "the control of machine '" + machine_.id + "' (" + control +
                             ") has no cycles; take the edit back, or name another control (--control)");
    out_.edits.push_back(e);
    return {};
  }

  /// A number is set where there is one: of several workingsteps that a pattern names, a depth of those that
  /// mill in levels, a feed of those that do not tap.
  void leave_without(const Edit& e, std::vector<std::size_t>& meant) {
    if (meant.size() < 2) return;
    std::string taps;
    std::erase_if(meant, [&](std::size_t i) {
      const AnyRef op = steps_[i].operation;
      if (e.of == EditOf::kDepth) return depth_of(std::as_const(plan_.model), op) == nullptr;
      if (e.of != EditOf::kFeed || !plan_.model.holds<model::Tapping>(op)) return false;
      taps += (taps.empty() ? "" : ", ") + draft::name_of(plan_.model, steps_[i]);
      return true;
    });
    if (!taps.empty())
      job_.note("EDIT-TAPS",
                model::words_of(e) + ": the feed of taps stays the pitch times the speed (" + taps +
                    "); set their speed, if that is meant",
                "");
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
      if (*depth && !open(s.operation, kDepthAttribute)) number = **depth;
    }
    if (number) {
      out.value = shortest(*number);
      out.number = *number;
    }
    if (out.value.empty())
      return no_value(e, called(m, s) + " has no " + std::string(model::word_of(e.of)) + " to hold");
    // The plan and a file of edits keep it as text.
    const auto again = model::parse_edit(out.kind, model::text_of(out), out.from);
    if (!again || !(*again == out))
      return no_value(e,
                      called(m, s) +
                          " cannot be named in an edit: its name has control characters or is longer than " +
                          std::to_string(model::kLongestEdit) + " bytes; rename it in the part");
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
    hold(said, s.operation, kToolAttribute, !same);
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
           {DecisionKey{op, kDepthAttribute}, DecisionKey{op, "radial_cutting_depth"},
            DecisionKey{technology, "spindle"}, DecisionKey{technology, "feedrate"}}) {
        const auto* d = key.object.set() ? plan_.ledger.find(key.object, key.attribute) : nullptr;
        // Depths that a rule fixed are those of its chain.
        if (d == nullptr || d->pinned) continue;
        if (d->binder == model::Binder::kOptimiser || d->binder == model::Binder::kCase) open.push_back(key);
      }
    }
    model::reopen_all(plan_.ledger, open);
  }

  /// That neither a limit of the operator rules a number out nor machine, control and cutter.
  Status can_be(const Edit& said, const Edit& e, const StepDraft& s) const {
    const std::string what = called(plan_.model, s) + ": " + model::words_of(said) + " sets ";
    const std::string value = model::value_text(e.number) + " " + std::string(model::unit_of(e.of));
    const model::EditLimits limits = model::limits_of(edits_, names_of(s));
    const auto& [most, by] = e.of == EditOf::kFeed ? std::pair(limits.feed_mm_min, limits.feed_by)
                                                   : std::pair(limits.speed_rpm, limits.speed_by);
    if (e.of != EditOf::kDepth && most && e.number > *most)
      return fail(conflict(plan_, what + value + ", against " + by));
    const auto cutter = cutter_of(plan_, s.operation, plan_.cutters);
    const auto no = beyond(e, machine_, plan_.material, cutter ? &*cutter : nullptr);
    if (!no) return {};
    return fail({.code = "EDIT-VALUE",
                 .message = what + value + ", " + *no,
                 .file = plan_.file_name,
                 .hint = "set another value, or leave it to planning"});
  }

  Status set_feed(const Edit& said, const Edit& e, const StepDraft& s) {
    if (plan_.model.holds<model::Tapping>(s.operation))
      return no_value(said,
                      called(plan_.model, s) + " taps: its feed is the pitch times the speed; set the speed");
    if (auto ok = can_be(said, e, s); !ok) return ok;
    const auto technology = step::own_technology(plan_, s.operation);
    auto* t = plan_.model.get<model::MillingTechnology>(technology);
    const bool same = t->feedrate && *t->feedrate == e.number && !t->feedrate_per_tooth;
    t->feedrate = e.number;
    t->feedrate_per_tooth.reset();
    hold(said, technology, "feedrate", !same);
    return {};
  }

  Status set_speed(const Edit& said, const Edit& e, const StepDraft& s) {
    if (auto ok = can_be(said, e, s); !ok) return ok;
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
    if (auto ok = can_be(said, e, s); !ok) return ok;
    const bool same = *depth && **depth == e.number;
    *depth = e.number;
    hold(said, s.operation, kDepthAttribute, !same);
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
  const model::Machine& machine_;
  Job& job_;
  const std::vector<StepDraft> steps_;
  Taken out_;
  std::set<DecisionKey> held_;
};

}  // namespace

Result<Taken> take_edits(model::Plan& plan, const std::vector<Edit>& edits,
                         const std::vector<Cutter>& library, const model::Machine& machine, bool all,
                         Job& job) {
  return Taker(plan, edits, library, machine, job).run(all);
}

}  // namespace capstan::given
