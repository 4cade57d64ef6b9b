#include "planner/making/propose/shared_tools.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/step/cut/drilled_hole.h"
#include "planner/making/step/cut/question.h"
#include "planner/model/nouns/all.h"
#include "tooling/library/nouns/nouns.h"
#include "tooling/selection/select.h"

// The second look at the tools, when every step has one: fewer of them.

namespace capstan::propose {
namespace {

using draft::StepDraft;
using model::Candidate;

/// A tool that fits a step in place of its own.
struct Instead {
  std::size_t step = 0, candidate = 0;
  double loss_s = 0.0;
};

const Candidate* own(const StepDraft& s) {
  for (const Candidate& c : s.candidates) {
    if (c.cutter.id == s.cutter.id) return &c;
  }
  return nullptr;
}

class ToolSharing {
 public:
  ToolSharing(model::Plan& plan, std::vector<StepDraft>& steps, const Sharing& how)
      : plan_(plan), steps_(steps), how_(how) {}

  std::vector<std::string> run() {
    std::set<std::string> stay;
    for (bool changed = true; changed;) {
      changed = false;
      for (const auto& [id, steps] : by_use()) {
        if (stay.contains(id)) continue;
        if (give_way(id, steps)) {
          changed = true;
          break;
        }
        stay.insert(id);
      }
    }
    if (how_.back) {
      while (give_back()) {
      }
    }
    for (const auto& [id, steps] : by_use()) take_smallest_point(steps);
    return draft::cutters_of(steps_);
  }

 private:
  using Uses = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

  /// Tools with their steps, the least used first, then by name.
  [[nodiscard]] Uses by_use() const {
    std::map<std::string, std::vector<std::size_t>> steps;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      if (!steps_[i].cutter.id.empty()) steps[steps_[i].cutter.id].push_back(i);
    }
    Uses out(steps.begin(), steps.end());
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    return out;
  }

  [[nodiscard]] bool thrifty() const { return how_.thrift != Thrift::kNone; }

  /// The best of the tools that the rest of the plan uses; of the same class, so that what the rules prefer
  /// stays, but for thrift.
  [[nodiscard]] std::optional<Instead> instead(std::size_t i, const std::set<std::string>& others) const {
    const StepDraft& s = steps_[i];
    const Candidate* mine = own(s);
    if (mine == nullptr) return std::nullopt;
    std::optional<Instead> best;
    for (std::size_t k = 0; k < s.candidates.size(); ++k) {
      const Candidate& c = s.candidates[k];
      if (!others.contains(c.cutter.id)) continue;
      if (!thrifty() && c.cutter.cutter_class != mine->cutter.cutter_class) continue;
      // A tool that is set to a size is not the same at another size.
      if (c.cutter.adjustable_to_mm > 0.0) continue;
      const double loss =
          std::max(1, static_cast<int>(s.shapes.size())) * (c.estimated_s - mine->estimated_s);
      if (thrifty() && loss > kMostForFewerS) continue;
      if (!best || loss < best->loss_s) best = Instead{i, k, loss};
    }
    return best;
  }

  bool give_way(const std::string& id, const std::vector<std::size_t>& steps) {
    std::set<std::string> others;
    for (const StepDraft& s : steps_) {
      if (s.cutter.id != id) others.insert(s.cutter.id);
    }
    std::vector<Instead> taken;
    double loss = 0.0;
    for (const std::size_t i : steps) {
      // Tools that a file binds stay.
      if (!steps_[i].proposed && !steps_[i].open_tool) return false;
      const auto other = instead(i, others);
      if (!other) return false;
      loss += other->loss_s;
      taken.push_back(*other);
    }
    const double saved = saved_s(steps_[steps.front()].cutter);
    if (loss >= saved && !thrifty()) return false;
    for (const Instead& t : taken) swap(t, id, loss, saved);
    return true;
  }

  /// Thrift may leave pockets free: one more tool where it gains most. Whether one was taken.
  bool give_back() {
    const auto pockets = static_cast<std::size_t>(std::max(0, plan_.machine.magazine_pockets));
    const std::vector<std::string> used = draft::cutters_of(steps_);
    if (!thrifty() || used.size() >= pockets) return false;
    std::map<std::string, std::vector<Instead>> gains;  // by the further tool; losses below zero
    for (std::size_t i = 0; i < steps_.size(); ++i) {
      const StepDraft& s = steps_[i];
      const Candidate* mine = own(s);
      if (mine == nullptr || !(s.proposed || s.open_tool)) continue;
      for (std::size_t k = 0; k < s.candidates.size(); ++k) {
        const Candidate& c = s.candidates[k];
        if (c.cutter.adjustable_to_mm > 0.0 || std::count(used.begin(), used.end(), c.cutter.id) > 0)
          continue;
        const double loss =
            std::max(1, static_cast<int>(s.shapes.size())) * (c.estimated_s - mine->estimated_s);
        if (loss < 0.0) gains[c.cutter.id].push_back({i, k, loss});
      }
    }
    const std::vector<Instead>* most = nullptr;
    double of_most = 0.0;
    for (const auto& [id, all] : gains) {
      double sum = saved_s(steps_[all.front().step].candidates[all.front().candidate].cutter);
      for (const Instead& t : all) sum += t.loss_s;
      if (sum < of_most) of_most = sum, most = &all;
    }
    if (most == nullptr) return false;
    for (const Instead& t : *most) {
      const std::string was = steps_[t.step].cutter.id;
      take(t.step, t.candidate, was, "tooling.free_pocket",
           "gives way to " + steps_[t.step].candidates[t.candidate].cutter.id +
               ", for which the magazine has a pocket left: that saves about " + trimmed(-t.loss_s, 1) +
               " s");
    }
    return true;
  }

  /// A point that only marks places is as small as all its steps bear: the larger one was taken first, so
  /// that one serves them all, and no more of it ever cuts than its tip.
  void take_smallest_point(const std::vector<std::size_t>& steps) {
    const model::Cutter& now = steps_[steps.front()].cutter;
    if (!model::has(now.cutter_class, model::CutterTrait::kMarks) || now.loaded) return;
    const Candidate* best = nullptr;
    for (const Candidate& c : steps_[steps.front()].candidates) {
      const bool smaller = c.cutter.cutting_diameter_mm <
                           (best == nullptr ? now.cutting_diameter_mm : best->cutter.cutting_diameter_mm);
      if (!smaller || c.cutter.cutter_class != now.cutter_class) continue;
      const auto serves = [&](std::size_t i) {
        const StepDraft& s = steps_[i];
        if (!s.proposed || !index_of(s, c.cutter.id)) return false;
        const double width = step::engaged_diameter_mm(s.operation.type, c.cutter, s.proposal.depth_mm);
        return width > 0.0 && width <= c.cutter.cutting_diameter_mm;
      };
      if (std::all_of(steps.begin(), steps.end(), serves)) best = &c;
    }
    if (best == nullptr) return;
    const std::string id = best->cutter.id, was = now.id;
    const std::string why = "gives way to " + id + ": no more of a point than its tip marks a place";
    for (const std::size_t i : steps) take(i, *index_of(steps_[i], id), was, "tooling.smallest_point", why);
  }

  static std::optional<std::size_t> index_of(const StepDraft& s, const std::string& id) {
    for (std::size_t k = 0; k < s.candidates.size(); ++k) {
      if (s.candidates[k].cutter.id == id) return k;
    }
    return std::nullopt;
  }

  [[nodiscard]] double saved_s(const model::Cutter& c) const {
    const model::Machine& m = plan_.machine;
    const double loading =
        how_.magazine_known && !c.loaded ? tooling::kLoadingS / std::max(1, how_.batch) : 0.0;
    return m.tool_change_s + m.spindle.spin_up_s + loading;
  }

  void swap(const Instead& t, const std::string& id, double loss_s, double saved_s) {
    const std::string now = steps_[t.step].candidates[t.candidate].cutter.id;
    take(t.step, t.candidate, id, "tooling.fewer_changes",
         "gives way to " + now + ", which the plan uses already: that costs about " +
             trimmed(std::max(0.0, loss_s), 1) + " s of cutting and saves " + trimmed(saved_s, 1) +
             " s of changing tools");
  }

  /// The step gets this candidate in place of the tool `was`.
  void take(std::size_t step, std::size_t candidate, const std::string& was, const char* rule,
            const std::string& why) {
    StepDraft& s = steps_[step];
    s.candidates.prefer(candidate);
    const Candidate& now = s.candidates.front();
    s.cutter = now.cutter;
    step::fit_to_cutter(plan_.model, steps_, s);
    s.rejected_tools.push_back({was, why});
    const auto tool = tooling::tool_noun(plan_.model, s.cutter);
    plan_.model.get<model::MachiningOperation>(s.operation)->its_tool = tool;
    plan_.ledger.bind(s.operation, "its_tool", model::Binder::kToolSelection,
                      {rule, now.why.text + "; in place of " + was + ", which " + why, now.why.source},
                      {{s.step, "its_operation"}}, s.rejected_tools);
  }

  model::Plan& plan_;
  std::vector<StepDraft>& steps_;
  const Sharing& how_;
};

}  // namespace

bool magazine_known(const std::vector<model::Cutter>& cutters) {
  return std::any_of(cutters.begin(), cutters.end(), [](const model::Cutter& c) { return c.loaded; });
}

std::vector<std::string> share_tools(model::Plan& plan, std::vector<StepDraft>& steps, const Sharing& how) {
  return ToolSharing(plan, steps, how).run();
}

}  // namespace capstan::propose
