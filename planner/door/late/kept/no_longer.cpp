#include "planner/door/late/kept/no_longer.h"

#include <algorithm>
#include <set>
#include <utility>

#include "planner/door/late/kept/other_material.h"
#include "planner/door/late/next.h"
#include "planner/door/pipeline/stages.h"
#include "planner/ground/base/number.h"
#include "planner/making/given/listed_steps.h"
#include "planner/making/given/magazine.h"
#include "planner/model/plan/field_differences.h"
#include "planner/model/plan/resources/machine_fields.h"

namespace capstan::late {
namespace {

std::string tool_words(const model::Cutter& c) {
  return "T" + std::to_string(c.pocket) + " (" + std::string(model::to_text(c.cutter_class)) + " " +
         trimmed(c.cutting_diameter_mm, 3) + " mm)";
}

/// How a tool that the plan's steps use stands in the spindle otherwise than it did.
std::string stands_otherwise(const model::Cutter& then, const model::Cutter& now) {
  std::string out;
  const auto add = [&](const std::string& words) { out += (out.empty() ? "" : ", ") + words; };
  if (now.pocket != then.pocket)
    add("is T" + std::to_string(now.pocket) + " and was T" + std::to_string(then.pocket));
  const auto length = [&](const char* what, double was, double is) {
    if (trimmed(was, 3) != trimmed(is, 3))
      add(std::string(what) + " " + trimmed(is, 3) + " mm in place of " + trimmed(was, 3) + " mm");
  };
  length("has length", model::length_offset_mm(then), model::length_offset_mm(now));
  length("stands out", then.stick_out_mm, now.stick_out_mm);
  return out;
}

}  // namespace

Result<std::vector<std::string>> no_longer_valid(const model::Plan& plan, pipeline::Inputs inputs,
                                                 const std::vector<ToolState>& tools, Job& job) {
  std::vector<std::string> out;
  if (!plan.steps.empty()) {
    if (plan.machine.id != inputs.machine.id) {
      out.push_back("the machine is " + inputs.machine.id + ", the plan was made for " + plan.machine.id);
    } else if (const std::string differ = model::told_differences(plan.machine, inputs.machine);
               !differ.empty()) {
      out.push_back("the machine " + inputs.machine.id + " is another than the plan was made for (" + differ +
                    ")");
    }
  }
  Job unsaid;  // a bind says it
  const auto material = pipeline::material_of(plan, inputs, unsaid);
  if (!material) return tl::unexpected(material.error());
  if (!plan.steps.empty()) {
    if (const std::string other = other_material(plan, *material); !other.empty()) out.push_back(other);
  }
  const auto told = take_tool_states(tools, plan, inputs.library, job);
  if (!told) return tl::unexpected(told.error());
  // Of a plan that is bound step by step those that are bound are cut: what they were cut with is over.
  const std::vector<model::AnyRef> steps = given::steps_in_order(plan);
  const bool part = plan.steps.size() < steps.size();
  const std::set<model::AnyRef> to_come =
      part ? operations_of(plan, {plan.steps.size(), steps.size() - plan.steps.size()}, steps)
           : std::set<model::AnyRef>{};
  auto matched = given::match_loaded(plan, inputs.library, job, part ? &to_come : nullptr, told->out_of_use);
  if (!matched) return tl::unexpected(matched.error());
  std::move(matched->why.begin(), matched->why.end(), std::back_inserter(out));
  if (part) return out;
  std::set<std::string> used;
  for (const model::StepResult& s : plan.steps) used.insert(s.cutter_id);
  for (const model::Cutter& then : plan.cutters) {
    if (!used.contains(then.id)) continue;
    const auto now = std::find_if(inputs.library.begin(), inputs.library.end(),
                                  [&](const model::Cutter& c) { return c.loaded && c.id == then.id; });
    if (now == inputs.library.end()) continue;  // said above
    if (const std::string how = stands_otherwise(then, *now); !how.empty())
      out.push_back("tool " + tool_words(then) + " " + how + ": its steps are checked anew");
  }
  return out;
}

}  // namespace capstan::late
