#include "planner/door/late/next.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "planner/door/late/unbound.h"
#include "planner/making/given/listed_steps.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/field_differences.h"

// A workingstep is bound when its turn comes. What was cut before it is no question any more: its paths, with
// the cutters that they were cut with, say what the next tool meets. What comes after it may wait.

namespace capstan::late {
namespace {

using model::AnyRef;
using model::Plan;
using model::StepResult;

Diagnostic no_such(const Plan& plan, const std::string& what, const std::string& expected) {
  return {.code = "LATE-NEXT", .message = what, .file = plan.file_name, .expected = expected};
}

/// Whether two cutters of one name cut the same.
bool cuts_alike(const model::Cutter& a, const model::Cutter& b) {
  return model::told_differences(a, b,
                                 {"pocket", "loaded", "table_line", "functional_length_mm", "stick_out_mm",
                                  "usable_length_mm", "sources", "life_used_min"})
      .empty();
}

}  // namespace

Result<pipeline::Window> window_of(const Plan& plan, const Next& next, const std::vector<AnyRef>& steps) {
  std::size_t first = 0;
  if (next.from) {
    if (*next.from == 0 || *next.from > steps.size())
      return tl::unexpected(no_such(plan, "there is no workingstep " + std::to_string(*next.from),
                                    "a number from 1 to " + std::to_string(steps.size())));
    first = *next.from - 1;
  } else {
    while (first < steps.size() && has_result(plan, first, steps) && !is_open(plan, steps[first])) ++first;
    if (first == steps.size()) first = 0;
  }
  for (std::size_t k = 0; k < first; ++k) {
    if (has_result(plan, k, steps)) continue;
    return tl::unexpected(no_such(plan,
                                  "workingstep " + std::to_string(k + 1) +
                                      " of the plan has no path, so that what "
                                      "workingstep " +
                                      std::to_string(first + 1) + " meets is not known",
                                  "the plan that the steps before were bound in"));
  }
  return pipeline::Window{first, std::min(next.count, steps.size() - first)};
}

bool operations_open(const Plan& plan, const std::vector<AnyRef>& steps) {
  if (!plan.steps.empty()) return false;
  std::set<AnyRef> made = model::parts_of_others(plan.model);
  for (const AnyRef r : steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(r);
    if (ws == nullptr) continue;
    if (!plan.model.holds<model::MachiningOperation>(ws->its_operation)) return true;
    made.insert(ws->its_feature);
    made.insert(ws->final_features.items.begin(), ws->final_features.items.end());
  }
  const auto features = plan.model.all_below(model::TypeId::kManufacturingFeature);
  return std::any_of(features.begin(), features.end(), [&](AnyRef f) { return !made.contains(f); });
}

std::set<AnyRef> operations_of(const Plan& plan, const pipeline::Window& window,
                               const std::vector<AnyRef>& steps) {
  std::set<AnyRef> out;
  for (std::size_t k = window.first; k < std::min(steps.size(), window.first + window.count); ++k) {
    if (const auto* ws = plan.model.get<model::MachiningWorkingstep>(steps[k])) out.insert(ws->its_operation);
  }
  return out;
}

Plan joined(const Plan& brought, const Plan& bound, const pipeline::Window& window) {
  Plan out = bound;
  const auto cut = std::min(window.first, brought.steps.size());
  const auto later = std::min(window.first + window.count, brought.steps.size());
  out.steps.assign(brought.steps.begin(), brought.steps.begin() + static_cast<std::ptrdiff_t>(cut));
  out.steps.insert(out.steps.end(), bound.steps.begin(), bound.steps.end());
  out.steps.insert(out.steps.end(), brought.steps.begin() + static_cast<std::ptrdiff_t>(later),
                   brought.steps.end());
  // Set-ups that the steps bound so far have not reached.
  for (std::size_t i = out.setups.size(); i < brought.setups.size(); ++i)
    out.setups.push_back(brought.setups[i]);
  std::map<std::string, std::string> as_cut;  // names of cutters that are others now
  for (std::size_t i = 0; i < out.steps.size(); ++i) {
    StepResult& s = out.steps[i];
    const bool is_cut = i < cut;
    if (!is_cut && i < cut + bound.steps.size()) continue;
    const model::Cutter* was = model::find_cutter(brought, s.cutter_id);
    if (was == nullptr) continue;
    const model::Cutter* is = model::find_cutter(out, s.cutter_id);
    if (is == nullptr) {
      out.cutters.push_back(*was);
    } else if (is_cut && !cuts_alike(*is, *was)) {
      auto [name, is_new] = as_cut.try_emplace(s.cutter_id, s.cutter_id + std::string(kAsCut));
      while (is_new && model::find_cutter(out, name->second) != nullptr) name->second += " before";
      if (is_new) {
        model::Cutter gone = *was;
        gone.id = name->second;
        gone.pocket = 0;
        gone.loaded = false;
        out.cutters.push_back(std::move(gone));
      }
      s.cutter_id = name->second;
    }
  }
  // Steps to come that have no result know their tools by name alone: nouns hold less of them.
  const auto is_there = [&](const model::Cutter& c) { return model::find_cutter(out, c.id) != nullptr; };
  if (std::all_of(brought.cutters.begin(), brought.cutters.end(), is_there)) return out;
  for (const AnyRef step : given::steps_in_order(brought)) {
    const auto* ws = brought.model.get<model::MachiningWorkingstep>(step);
    const auto* op =
        ws == nullptr ? nullptr : brought.model.get<model::MachiningOperation>(ws->its_operation);
    const auto* tool = op == nullptr ? nullptr : brought.model.get<model::MachiningTool>(op->its_tool);
    if (tool == nullptr || brought.ledger.is_open(ws->its_operation, "its_tool")) continue;
    const model::Cutter* named = model::find_cutter(brought, tool->its_id.value_or(""));
    if (named != nullptr && !is_there(*named)) out.cutters.push_back(*named);
  }
  return out;
}

}  // namespace capstan::late
