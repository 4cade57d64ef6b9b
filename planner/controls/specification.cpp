#include "planner/controls/specification.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/decision/speeds_agree.h"

namespace capstan::controls {
namespace {

using model::AnyRef;
using model::Finding;
using model::TypeId;

class Specification {
 public:
  Specification(const model::Plan& plan, const Conformance& control) : plan_(plan), can_(control) {}

  std::vector<Finding> all(bool part) {
    if (!part) under_specified();
    missing();
    contradictory();
    speeds();
    over_specified();
    return std::move(out_);
  }

 private:
  void add(const char* code, Severity severity, std::string step, std::string message) {
    out_.push_back({.property = kSaysWhatThePlanDoes,
                    .code = code,
                    .severity = severity,
                    .step = std::move(step),
                    .message = std::move(message)});
  }
  std::string name(AnyRef object) const {
    const auto instance = plan_.model.origin(object).instance;
    return (instance > 0 ? "#" + std::to_string(instance) + " " : std::string()) +
           std::string(model::noun_type(object.type).keyword);
  }

  void under_specified() {
    std::vector<AnyRef> roots = {plan_.project};
    const auto steps = plan_.model.all_below(TypeId::kExecutable);
    roots.insert(roots.end(), steps.begin(), steps.end());
    const auto all = model::reachable(plan_.model, roots);
    const std::set<AnyRef> reached(all.begin(), all.end());
    std::size_t open = 0;
    std::string first;
    for (const auto& [key, d] : plan_.ledger.entries()) {
      if (d.state != model::DecisionState::kOpen || !reached.contains(key.object)) continue;
      if (open++ == 0) first = key.attribute + " of " + name(key.object);
    }
    if (open > 0)
      add("FIT-OPEN", Severity::kError, {},
          "under-specified: " + std::to_string(open) + (open == 1 ? " decision is" : " decisions are") +
              " open, the first " + first + "; a control closes none (`capstan bind`)");
    if (plan_.model.all_below(TypeId::kWorkingstep).empty())
      add("FIT-OPEN", Severity::kError, {}, "under-specified: there is no workingstep (`capstan plan`)");
  }

  void missing() {
    const auto ids = model::step_ids(plan_);
    for (std::size_t i = 0; i < plan_.steps.size(); ++i) {
      const model::StepResult& s = plan_.steps[i];
      std::string what;
      const auto lacks = [&](bool lacking, const char* thing) {
        if (lacking) what += (what.empty() ? "" : ", ") + std::string(thing);
      };
      const model::Cutter* cutter = model::find_cutter(plan_, s.cutter_id);
      lacks(cutter == nullptr, "its cutter");
      lacks(cutter != nullptr && cutter->pocket <= 0, "its cutter's tool number");
      lacks(!s.path || s.path->size() == 0, "its path");
      lacks(!s.schedule && !(s.feed_mm_min > 0.0), "its feed");
      lacks(s.setup >= plan_.setups.size() || plan_.setups[s.setup].work_offset.empty(), "its work offset");
      if (!what.empty()) add("FIT-MISSING", Severity::kError, ids[i], "missing: " + what);
    }
  }

  void contradictory() {
    for (const model::Contradiction& c : model::contradictions(plan_))
      add("FIT-CONTRADICTION", Severity::kError, {}, "contradictory: " + c.why);
  }

  /// Speed and feed, each stated in two ways.
  void speeds() {
    for (const AnyRef at : plan_.model.all_below(TypeId::kMillingTechnology)) {
      const auto& t = plan_.model.at<model::MillingTechnology>(at);
      if (t.feedrate && t.feedrate_per_tooth && t.spindle && *t.feedrate_per_tooth > 0.0 &&
          *t.spindle != 0.0) {
        const double teeth = *t.feedrate / (*t.feedrate_per_tooth * std::abs(*t.spindle));
        // Whole numbers of teeth agree with the two; which cutter it is the file may leave open.
        const bool whole = teeth > 0.5 && std::abs(teeth - std::round(teeth)) < 0.1;  // default, unsourced
        add(whole ? "FIT-OVER" : "FIT-CONTRADICTION", whole ? Severity::kNote : Severity::kError, {},
            (whole ? "over-specified: " : "contradictory: ") + name(at) +
                " states feedrate, feedrate_per_tooth and spindle" +
                (whole ? "; the first follows from the others"
                       : ", which would be " + trimmed(teeth, 2) + " teeth"));
      }
      if (t.spindle && t.cutspeed) cut_speed(at, *t.spindle, *t.cutspeed);
    }
  }

  /// The cutters that use a technology with spindle and cutspeed tell whether the two agree.
  void cut_speed(AnyRef technology, double spindle_rpm, double cutspeed_mm_min) {
    for (const model::StepResult& s : plan_.steps) {
      const model::Cutter* cutter = model::find_cutter(plan_, s.cutter_id);
      const auto* step = s.step.set() ? plan_.model.get<model::MachiningWorkingstep>(s.step) : nullptr;
      if (cutter == nullptr || step == nullptr || !step->its_operation.set()) continue;
      const auto* op = plan_.model.get<model::MachiningOperation>(step->its_operation);
      if (op == nullptr || AnyRef(op->its_technology) != technology) continue;
      const double follows = std::numbers::pi * cutter->cutting_diameter_mm * std::abs(spindle_rpm);
      const double stated = std::abs(cutspeed_mm_min);
      const bool agree = model::speeds_agree(stated, follows);
      add(agree ? "FIT-OVER" : "FIT-CONTRADICTION", agree ? Severity::kNote : Severity::kError, {},
          (agree ? "over-specified: " : "contradictory: ") + name(technology) +
              " states spindle and cutspeed" +
              (agree ? "; one follows from the other"
                     : ", which differ by a factor of " + trimmed(follows / stated, 2) + " at the cutter's diameter"));
      return;
    }
    add("FIT-OVER", Severity::kNote, {},
        "over-specified: " + name(technology) + " states spindle and cutspeed; one follows from the other");
  }

  void over_specified() {
    const auto broadcasts = plan_.model.all_below(TypeId::kBroadcastContent);
    if (!broadcasts.empty() && !can_.broadcasts)
      add("FIT-OVER", Severity::kNote, {},
          "over-specified: the plan has " +
              counted(broadcasts.size(), "broadcast content", "broadcast contents") +
              ", which the control does not send");
    if (!can_.splines) {
      std::size_t splines = 0;
      const auto curves = plan_.model.all_below(TypeId::kBSplineCurve);
      const std::set<AnyRef> all(curves.begin(), curves.end());
      for (const AnyRef at : plan_.model.all_below(TypeId::kCutterLocationTrajectory)) {
        const auto curve = plan_.model.at<model::CutterLocationTrajectory>(at).basiccurve;
        if (curve.set() && all.contains(curve)) ++splines;
      }
      if (splines > 0)
        add("FIT-OVER", Severity::kNote, {},
            "over-specified: " + counted(splines, "path is a B-spline", "paths are B-splines") +
                "; the control has lines and arcs, which leave it by path_maximum_deviation");
    }
    const auto contact = plan_.model.all_below(TypeId::kCutterContactTrajectory);
    if (!contact.empty() && !can_.compensation)
      add("FIT-COMPENSATION", Severity::kError, {},
          counted(contact.size(), "path is", "paths are") +
              " of the contact; the control does not offset them by the cutter's radius");
  }

  const model::Plan& plan_;
  const Conformance& can_;
  std::vector<Finding> out_;
};

}  // namespace

std::vector<Finding> specification(const model::Plan& plan, const Conformance& control, bool part) {
  return Specification(plan, control).all(part);
}

}  // namespace capstan::controls
