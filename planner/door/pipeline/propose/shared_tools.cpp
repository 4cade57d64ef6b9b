#include "planner/door/pipeline/propose/shared_tools.h"

#include <algorithm>
#include <map>
#include <set>

#include "planner/door/pipeline/propose/members.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/making/piece/surroundings.h"
#include "tooling/selection/select.h"

// The second look at the tools, when every step has one: fewer of them.

namespace capstan::pipeline {
namespace {

using model::Candidate;
using model::FeatureShape;
using model::ShapeKind;
using model::TypeId;

/// What a finishing pass finds on walls and floors, mm. Default, unsourced: the usual allowance.
constexpr double kLeftOnWalls = 0.5;

double perimeter(const geometry::Region& area) {
  double out = 0.0;
  for (const auto& loop : area.loops) {
    for (std::size_t i = 0; i < loop.size(); ++i) out += norm(loop[(i + 1) % loop.size()] - loop[i]);
  }
  return out;
}

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

class Sharer {
 public:
  explicit Sharer(Work& w) : w_(w) {
    magazine_known_ = std::any_of(w.inputs.library.begin(), w.inputs.library.end(),
                                  [](const model::Cutter& c) { return c.loaded; });
  }

  void run() {
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
    // What gave way is not used any more.
    w_.used_cutters.clear();
    for (const StepDraft& s : w_.steps) {
      if (!s.cutter.id.empty()) tooling::use(w_.used_cutters, s.cutter.id);
    }
  }

 private:
  using Uses = std::vector<std::pair<std::string, std::vector<std::size_t>>>;

  /// Tools with their steps, the least used first, then by name.
  [[nodiscard]] Uses by_use() const {
    std::map<std::string, std::vector<std::size_t>> steps;
    for (std::size_t i = 0; i < w_.steps.size(); ++i) {
      if (!w_.steps[i].cutter.id.empty()) steps[w_.steps[i].cutter.id].push_back(i);
    }
    Uses out(steps.begin(), steps.end());
    std::stable_sort(out.begin(), out.end(),
                     [](const auto& a, const auto& b) { return a.second.size() < b.second.size(); });
    return out;
  }

  /// The best of the tools that the rest of the plan uses; of the same class, so that what the rules prefer
  /// stays.
  [[nodiscard]] std::optional<Instead> instead(std::size_t i, const std::set<std::string>& others) const {
    const StepDraft& s = w_.steps[i];
    const Candidate* mine = own(s);
    if (mine == nullptr) return std::nullopt;
    std::optional<Instead> best;
    for (std::size_t k = 0; k < s.candidates.size(); ++k) {
      const Candidate& c = s.candidates[k];
      if (!others.contains(c.cutter.id) || c.cutter.cutter_class != mine->cutter.cutter_class) continue;
      // A tool that is set to a size is not the same at another size.
      if (c.cutter.adjustable_to_mm > 0.0) continue;
      const double loss =
          std::max(1, static_cast<int>(s.shapes.size())) * (c.estimated_s - mine->estimated_s);
      if (!best || loss < best->loss_s) best = Instead{i, k, loss};
    }
    return best;
  }

  bool give_way(const std::string& id, const std::vector<std::size_t>& steps) {
    std::set<std::string> others;
    for (const StepDraft& s : w_.steps) {
      if (s.cutter.id != id) others.insert(s.cutter.id);
    }
    std::vector<Instead> taken;
    double loss = 0.0;
    for (const std::size_t i : steps) {
      // Tools that a file binds stay.
      if (!w_.steps[i].proposed && !w_.steps[i].open_tool) return false;
      const auto other = instead(i, others);
      if (!other) return false;
      loss += other->loss_s;
      taken.push_back(*other);
    }
    const double saved = saved_s(w_.steps[steps.front()].cutter);
    if (loss >= saved) return false;
    for (const Instead& t : taken) swap(t, id, loss, saved);
    return true;
  }

  [[nodiscard]] double saved_s(const model::Cutter& c) const {
    const model::Machine& m = w_.plan.machine;
    const double loading =
        magazine_known_ && !c.loaded ? tooling::kLoadingS / std::max(1, w_.inputs.batch) : 0.0;
    return m.tool_change_s + m.spindle.spin_up_s + loading;
  }

  void swap(const Instead& t, const std::string& id, double loss_s, double saved_s) {
    StepDraft& s = w_.steps[t.step];
    std::rotate(s.candidates.begin(), s.candidates.begin() + static_cast<std::ptrdiff_t>(t.candidate),
                s.candidates.begin() + static_cast<std::ptrdiff_t>(t.candidate) + 1);
    const Candidate& now = s.candidates.front();
    s.cutter = now.cutter;
    fit_to_cutter(w_, s);
    const std::string why = "gives way to " + now.cutter.id +
                            ", which the plan uses already: that costs about " +
                            trimmed(std::max(0.0, loss_s), 1) + " s of cutting and saves " +
                            trimmed(saved_s, 1) + " s of changing tools";
    s.rejected_tools.push_back({id, why});
    const auto tool = tool_noun(w_, s.cutter);
    w_.plan.model.get<model::MachiningOperation>(s.operation)->its_tool = tool;
    w_.plan.ledger.bind(
        s.operation, "its_tool", model::Binder::kToolSelection,
        {"tooling.fewer_changes", now.why.text + "; in place of " + id + ", which " + why, now.why.source},
        {{s.step, "its_operation"}}, s.rejected_tools);
  }

  Work& w_;
  bool magazine_known_ = false;
};

}  // namespace

tooling::Preferences preferences_of(const Work& w, const model::ProposedStep& step, const FeatureShape& s) {
  tooling::Preferences p;
  p.batch = w.inputs.batch;
  p.pre_hole_mm = step.start_diameter_mm;
  const double above = piece::stock_above(w.piece(), s);
  const double depth = s.kind == ShapeKind::kFace ? std::max(above, s.depth_mm) : s.depth_mm + above;
  if (model::is_a(step.operation, TypeId::kDrillingTypeOperation)) {
    p.depth_mm = step.depth_mm > 0.0 ? step.depth_mm + above : depth;
    return p;
  }
  if (model::is_a(step.operation, TypeId::kPlaneFinishMilling)) {
    p.depth_mm = std::min(depth, kLeftOnWalls);
    p.volume_mm3 = geometry::area(s.area) * p.depth_mm;
    return p;
  }
  if (model::has(step.operation, model::OperationTrait::kFinishes)) {  // planes have returned
    p.width_mm = kLeftOnWalls;
    p.depth_mm = depth;
    p.volume_mm3 = perimeter(s.area) * depth * kLeftOnWalls;
    return p;
  }
  if (!model::has(s.kind, model::ShapeTrait::kClears))
    return p;  // chamfers, rounds, threads: little, and nobody says how much
  p.depth_mm = depth;
  p.volume_mm3 = geometry::area(s.area) * depth;
  if (s.kind == ShapeKind::kHole) {
    constexpr double kQuarterPi = 0.78539816339744831;
    const double d = s.diameter.nominal_mm, hole = step.start_diameter_mm;
    p.volume_mm3 = kQuarterPi * std::max(0.0, d * d - hole * hole) * depth;
  }
  return p;
}

void share_tools(Work& w) { Sharer(w).run(); }

}  // namespace capstan::pipeline
