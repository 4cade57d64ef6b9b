#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>

#include "planner/files/json/json.h"
#include "planner/files/json/objects.h"
#include "planner/files/json/seal.h"
#include "planner/files/json/summary.h"
#include "planner/files/json/tree/columns.h"
#include "planner/files/json/tree/tree.h"
#include "planner/files/json/values.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/no_number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/order/workplan_order.h"

namespace capstan::json {
namespace {

using model::Plan;
using Tree = nlohmann::json;
using Values = ValueReader<Tree>;

constexpr int kDeepest = 32;

class Reader {
 public:
  Plan run(const Tree& tree) {
    const Place top;
    need_object(tree, top);
    known_keys(tree, top);
    const Place objects{&top, "objects"};
    make_objects(child(tree, "objects", top), objects, plan_.model);
    values_.shared_columns(tree, top);
    fill_objects(child(tree, "objects", top), objects, plan_.model, values_);
    Values::FieldReader each{values_, tree, top};
    fields(each, plan_);
    ledger(tree, top);
    if (const auto it = tree.find("target_mesh"); it != tree.end()) {
      auto mesh = std::make_shared<geometry::Mesh>();
      values_.get(*it, *mesh, {&top, "target_mesh"});
      plan_.target_mesh = std::move(mesh);
    }
    compare_seals(child(tree, "seals", top), {&top, "seals"});
    compare_derived(tree);
    return std::move(plan_);
  }

  /// The parts of the file that were edited since it was written.
  [[nodiscard]] const std::vector<std::string>& edited() const { return edited_; }

 private:
  static void known_keys(const Tree& tree, const Place& at) {
    Names known;
    const Plan empty;
    fields(known, empty);
    for (const char* name : {"capstan_plan", "summary", "objects", "reasons", "decisions", "paths",
                             "schedules", "sections", "target_mesh", "seals"}) {
      known.names.emplace_back(name);
    }
    only(tree, known.names, at);
  }

  void ledger(const Tree& tree, const Place& top) {
    const Place reasons_at{&top, "reasons"};
    std::vector<model::Reason> reasons;
    values_.get(child(tree, "reasons", top), reasons, reasons_at);
    for (std::size_t i = 0; i < reasons.size(); ++i) {
      if (plan_.ledger.reason(std::move(reasons[i])) != i)
        fault({&reasons_at, {}, i}, "each reason once, \"given\" first");
    }
    const Tree& decisions = child(tree, "decisions", top);
    const Place here{&top, "decisions"};
    need_array(decisions, here);
    for (std::size_t i = 0; i < decisions.size(); ++i) {
      tick();
      const Place at{&here, {}, i};
      need_object(decisions[i], at);
      model::DecisionKey key;
      model::Decision decision;
      Values::FieldReader each{values_, decisions[i], at};
      fields(each, key);
      fields(each, decision);
      Names known;
      fields(known, key);
      fields(known, decision);
      only(decisions[i], known.names, at);
      if (decision.reason >= plan_.ledger.reasons().size()) fault({&at, "reason"}, "the number of a reason");
      plan_.ledger.set(std::move(key), std::move(decision));
    }
  }

  void compare_seals(const Tree& seals, const Place& at) {
    need_object(seals, at);
    std::map<std::string, std::uint64_t> then;
    for (const auto& item : seals.items())
      Values::hash(item.value(), then[unquoted_bytes(item.key())], {&at, item.key()});
    edited_ = model::edited_parts(seals_of(plan_), std::move(then));
  }

  /// Compares values that the file states for mere readers with the data from which they follow.
  void compare_derived(const Tree& tree) {
    const auto differs = [](const Tree& t, const char* name, double v) {
      const auto it = t.find(name);
      return it == t.end() || !it->is_number() || it->get<double>() != v;
    };
    const Summary expected = summary_of(plan_);
    bool other = false;
    if (const auto it = tree.find("summary"); it != tree.end() && it->is_object()) {
      other = std::any_of(expected.totals.begin(), expected.totals.end(),
                          [&](const auto& part) { return differs(*it, part.first.c_str(), part.second); });
      const auto waiting = it->find("to_load");
      if (other || (waiting != it->end() && *waiting != Tree(to_load(plan_))))
        edited_.emplace_back("the summary");
    }
    const Tree& steps = *tree.find("steps");
    for (std::size_t i = 0; i < expected.steps.size(); ++i) {
      const StepSummary& look = expected.steps[i];
      // A plan of an earlier build states fewer.
      const auto word = [&](std::string_view name, const std::string& text) {
        const auto at = steps[i].find(std::string(name));
        return at == steps[i].end() ||
               (at->is_string() && unquoted_bytes(at->template get_ref<const std::string&>()) == text);
      };
      const auto number = [&](std::string_view name, double value) {
        const auto at = steps[i].find(std::string(name));
        return at == steps[i].end() || (at->is_number() && at->template get<double>() == value);
      };
      if (!word("id", look.id)) edited_.push_back("the id of step '" + look.id + "'");
      bool as_derived = number("tool_number", look.tool_number);
      for (const auto& [name, text] : look.words) as_derived = as_derived && word(name, text);
      // Where the whole takes another time, something was edited from which it follows.
      for (const auto& [name, seconds] : look.times)
        as_derived = as_derived && (other || number(name, seconds));
      if (!as_derived) edited_.push_back("what follows for step '" + look.id + "'");
      const auto peak = steps[i].find("peak");
      const auto& sections = plan_.steps[i].sections;
      if (peak == steps[i].end() || !peak->is_object() || !sections) continue;
      const auto most = [](const std::vector<double>& column) {
        return column.empty() ? 0.0 : *std::max_element(column.begin(), column.end());
      };
      if (differs(*peak, "csa_mm2", most(sections->csa_mm2)) ||
          differs(*peak, "ad_max_mm", most(sections->ad_max_mm)) ||
          differs(*peak, "rd_max_mm", most(sections->rd_max_mm)))
        edited_.push_back("the peak of step '" + look.id + "'");
    }
  }

  Plan plan_;
  Values values_{plan_.model};
  std::vector<std::string> edited_;
};

/// The file's name for its lists.
constexpr const char* kCalled = "the plan's JSON";

/// Refuses the steps whose path was edited: the trajectory that holds it was, too. Gives the other parts.
std::vector<std::string> refuse_paths(const std::vector<std::string>& edited, model::Plan& plan) {
  const std::string trajectories = part_of_kind(model::TypeId::kCutterLocationTrajectory);
  if (std::find(edited.begin(), edited.end(), trajectories) == edited.end()) return edited;
  std::map<std::string, model::AnyRef> step_of;
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < ids.size(); ++i) step_of.emplace(part_of_step(ids[i]), plan.steps[i].step);
  std::vector<std::string> rest;
  for (const std::string& part : edited) {
    const auto it = step_of.find(part);
    if (it == step_of.end() || !model::refuse_edited_path(plan, it->second, kCalled)) rest.push_back(part);
  }
  return rest;
}

/// Ends a tree part by part: at once it may take as long as making it.
void take_apart(Tree& tree) {
  for (auto& list : tree) {
    if (!list.is_structured()) continue;
    for (auto& part : list) {
      tick(16);
      part = nullptr;
    }
  }
}

std::uint64_t line_of(std::string_view text, std::size_t byte) {
  const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size()));
  return 1 + static_cast<std::uint64_t>(std::count(text.begin(), end, '\n'));
}

}  // namespace

Result<model::Plan> read_json(std::string bytes, std::string file_name, Job& job, std::size_t cap) {
  const auto refuse = [&](const char* code, std::string message, std::uint64_t line = 0) {
    return fail(Diagnostic{.code = code, .message = std::move(message), .file = file_name, .line = line});
  };
  if (bytes.size() > cap)
    return refuse("JSON-SIZE", "the file is larger than " + std::to_string(cap) + " bytes");
  Columns taken = take_columns(bytes);
  const std::string text = taken.rest;
  // The parser destroys values recursively: depth is bounded before it sees the text.
  if (taken.deepest > kDeepest)
    return refuse("JSON-DEPTH", "the file nests deeper than " + std::to_string(kDeepest) + " levels");
  bytes = {};
  Tree tree;
  if (TreeFault why; !make_tree(std::move(taken), tree, why)) {
    return refuse("JSON-SYNTAX", why.too_large.empty() ? "the file is not JSON" : no_number(why.too_large),
                  line_of(text, why.byte));
  }
  const auto version = tree.is_object() ? tree.find("capstan_plan") : tree.end();
  if (!tree.is_object() || version == tree.end())
    return refuse("JSON-VERSION", "the file is not a Capstan plan");
  if (*version != kPlanJsonVersion) {
    return refuse("JSON-VERSION", "the plan's capstan_plan is " + version->dump().substr(0, 20) +
                                      "; this program reads version " + std::to_string(kPlanJsonVersion));
  }
  try {
    Reader reader;
    model::Plan plan = reader.run(tree);
    take_apart(tree);
    for (const model::Edited& e : model::take_edits(plan.model, plan.ledger)) {
      job.report({.code = std::string(model::kEditedCode),
                  .severity = Severity::kNote,
                  .message = e.key.attribute + " of " + object_id(e.key.object) + " " + text_of(e),
                  .file = file_name});
    }
    if (!reader.edited().empty()) {
      job.report(model::parts_edited(std::string(model::kEditedJsonCode), reader.edited(), file_name));
      model::refuse_edited(plan, listed_among(refuse_paths(reader.edited(), plan)), kCalled);
    }
    if (const std::string how = model::follow_workplan(plan); !how.empty())
      job.report(model::steps_disagree(how, file_name));
    return plan;
  } catch (const Fault& f) {
    Diagnostic d{
        .code = "JSON-VALUE", .message = "the plan's JSON is not as its schema says", .file = file_name};
    d.path = f.place;
    d.expected = f.expected;
    if (f.expected == "this field") d.hint = "a plan of an earlier build may lack it: plan the part anew";
    return fail(std::move(d));
  }
}

}  // namespace capstan::json
