#include "planner/door/late/tools/tool_life.h"

#include <algorithm>
#include <set>
#include <utility>

#include "planner/door/late/next.h"
#include "planner/ground/base/number.h"
#include "planner/making/given/magazine.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"

// Which tool a step has is decided before anybody knows how long it cuts. So a plan is bound first, and where
// a life ends within it a tool of the same kind takes the steps that are left over: their paths stand.

namespace capstan::late {
namespace {

using model::Cutter;
using model::Plan;
using model::StepResult;

constexpr double kSecondsPerMin = 60.0;
constexpr double kTraceMin = 1e-6;  ///< less than any clock of a control counts
constexpr const char* kTool = "its_tool";

std::string minutes(double m) { return trimmed(m, 3) + " min"; }
std::string name_of(int number) { return "T" + std::to_string(number); }

/// The lives as the steps use them up.
class Lives {
 public:
  explicit Lives(const OfLives& of) : left_(of.told.life_left_min), used_(of.used_min) {}

  [[nodiscard]] bool lasts(int number, double min) const {
    const auto at = left_.find(number);
    return at == left_.end() || used(number) + min <= at->second + kTraceMin;
  }
  void use(int number, double min) { used_[number] += min; }
  [[nodiscard]] std::string words(int number, double min) const {
    return "it cuts " + minutes(min) + ", and of the " + minutes(left_.at(number)) + " of life that " +
           name_of(number) + " has left, steps before it use " + minutes(used(number));
  }

 private:
  [[nodiscard]] double used(int number) const {
    const auto at = used_.find(number);
    return at == used_.end() ? 0.0 : at->second;
  }
  std::map<int, double> left_, used_;
};

/// The plan's tool as the sister that takes its place, under a name that no other tool has.
Cutter as_sister(const Plan& plan, const Cutter& tool, const Cutter& sister) {
  for (const Cutter& c : plan.cutters)
    if (c.pocket == sister.pocket) return c;  // the plan has it
  Cutter out = tool;
  out.pocket = sister.pocket;
  out.loaded = true;
  given::take_length(sister, out);
  out.id = sister.id;
  for (int n = 2; model::find_cutter(plan, out.id) != nullptr; ++n)
    out.id = sister.id + "~" + std::to_string(n);
  return out;
}

model::AnyRef operation_of(const Plan& plan, const StepResult& s) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
  return ws == nullptr ? model::AnyRef{} : model::AnyRef(ws->its_operation);
}

void give(Plan& plan, const StepResult& step, const Cutter& tool, const Cutter& sister,
          const std::string& why) {
  const Cutter now = as_sister(plan, tool, sister);
  given::give_tool(plan, operation_of(plan, step), now,
                   {"tool-state", why, "the life that the control tells"}, {{tool.id, why}});
  for (StepResult& s : plan.steps)
    if (s.step == step.step) s.cutter_id = now.id;
}

void open(Relieved& out, const StepResult& step, const Cutter& tool, const std::string& why) {
  const auto operation = operation_of(out.plan, step);
  out.plan.ledger.reopen({operation, kTool});
  const auto* e = out.plan.model.get<model::Executable>(step.step);
  model::Edit off;
  off.kind = model::EditKind::kForbid;
  off.of = model::EditOf::kTool;
  off.where = e == nullptr ? "*" : e->its_id.value_or("*");
  off.value = name_of(tool.pocket);
  off.from = "tool-state (" + why + ")";
  out.kept_off.push_back(std::move(off));
}

/// The number of a step's tool; of one that was another when it cut, the number that it has now.
int number_of(const Plan& plan, const std::string& id) {
  const Cutter* c = model::find_cutter(plan, id);
  const std::size_t as_cut = id.rfind(kAsCut);
  if (c != nullptr && c->pocket <= 0 && as_cut != std::string::npos)
    c = model::find_cutter(plan, id.substr(0, as_cut));
  return c == nullptr ? 0 : c->pocket;
}

}  // namespace

std::map<int, double> minutes_of(const Plan& plan, std::size_t from, std::size_t to) {
  std::map<int, double> out;
  for (std::size_t k = from; k < std::min(to, plan.steps.size()); ++k) {
    const int number = number_of(plan, plan.steps[k].cutter_id);
    if (number > 0) out[number] += plan.steps[k].cutting_s / kSecondsPerMin;
  }
  return out;
}

std::optional<Relieved> relieve(const LateOutcome& bound, const OfLives& of) {
  const Plan& made = bound.part ? *bound.part : bound.plan;
  Lives lives(of);
  std::optional<Relieved> out;
  std::set<int> ended;
  const std::vector<std::string> ids = model::step_ids(made);
  for (std::size_t k = 0; k < made.steps.size(); ++k) {
    const StepResult& step = made.steps[k];
    const Cutter* tool = model::find_cutter(made, step.cutter_id);
    if (tool == nullptr) continue;
    const double min = step.cutting_s / kSecondsPerMin;
    const bool lasts = lives.lasts(tool->pocket, min);
    // A tool that was left is not called again while its sister lasts.
    if (lasts && !ended.contains(tool->pocket)) {
      lives.use(tool->pocket, min);
      continue;
    }
    const std::vector<const Cutter*> sisters = given::sisters_of(of.magazine, *tool);
    const auto sister = std::find_if(sisters.begin(), sisters.end(),
                                     [&](const Cutter* c) { return lives.lasts(c->pocket, min); });
    if (sister == sisters.end() && lasts) {
      lives.use(tool->pocket, min);
      continue;
    }
    ended.insert(tool->pocket);
    if (!out) out = Relieved{bound.plan, {}, {}, {}};
    const std::string at =
        "step '" + ids[k] +
        "': " + (lasts ? name_of(tool->pocket) + " was left before it" : lives.words(tool->pocket, min));
    if (out->first.empty()) out->first = at;
    if (sister != sisters.end()) {
      out->why.push_back(at + "; " + name_of((*sister)->pocket) + " of the same kind takes it");
      give(out->plan, step, *tool, **sister, out->why.back());
      lives.use((*sister)->pocket, min);
    } else {
      out->why.push_back(at + "; no tool of the same kind takes it: its tool is re-opened");
      open(*out, step, *tool, at);
    }
  }
  return out;
}

}  // namespace capstan::late
