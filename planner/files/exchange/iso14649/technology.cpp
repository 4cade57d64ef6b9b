#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <vector>

#include "planner/files/exchange/iso14649/deviations_internal.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/speeds_agree.h"

namespace capstan::exchange::deviations {

using model::AnyRef;

namespace {

// Limits of what is possible at all, not of what is good: defaults, unsourced.
constexpr double kMaxRpm = 60000.0;
constexpr double kMinVc = 1.0, kMaxVcMilling = 2000.0, kMaxVcDrilling = 300.0;  // m/min
constexpr double kMaxFeedPerTooth = 0.5;      // mm, and at most a tenth of the diameter
constexpr double kMaxFeedPerRevDrill = 0.06;  // of the diameter

/// One technology and the tools it is used with.
struct Use {
  AnyRef technology;
  std::vector<AnyRef> operations;
  double diameter_mm = 0.0;  // 0: unknown, or tools of several diameters
  std::int64_t teeth = 0;
  bool drilling = false;
  bool tapping = false;  // one turn is one pitch, whatever the diameter
  model::Enumerated<model::Hand> hand;
};

const model::MillingToolBody* body_of(const model::Model& m, AnyRef tool) {
  const auto* t = m.get<model::CuttingTool>(tool);
  return t == nullptr ? nullptr : m.get<model::MillingToolBody>(t->its_tool_body);
}

double diameter_of(const model::Model& m, const model::MillingToolBody* body) {
  const auto* d = body == nullptr ? nullptr : m.get<model::MillingToolDimension>(body->dimension);
  return d == nullptr || !d->diameter || !(*d->diameter > 0.0) ? 0.0 : *d->diameter;
}

std::vector<Use> uses(const Reading& r) {
  const auto& m = r.plan.model;
  std::map<AnyRef, Use> by_technology;
  for (const AnyRef at : m.all_below(model::TypeId::kMachiningOperation)) {
    const auto& op = m.at<model::MachiningOperation>(at);
    if (!m.holds<model::MillingTechnology>(op.its_technology)) continue;
    const auto* body = body_of(m, op.its_tool);
    Use& use = by_technology[op.its_technology];
    const double d = diameter_of(m, body);
    if (use.operations.empty()) {
      use.technology = op.its_technology;
      use.diameter_mm = d;
      use.drilling =
          m.holds<model::DrillingTypeOperation>(at) ||
          (body != nullptr && m.holds<model::Drill>(m.get<model::CuttingTool>(op.its_tool)->its_tool_body));
      use.tapping = m.holds<model::Tapping>(at);
      if (body != nullptr) {
        use.teeth = body->number_of_teeth.value_or(0);
        use.hand = body->hand_of_cut;
      }
    } else if (use.diameter_mm != d) {
      use.diameter_mm = 0.0;
    }
    use.operations.push_back(at);
  }
  std::vector<Use> out;
  for (auto& [key, use] : by_technology) out.push_back(std::move(use));
  std::sort(out.begin(), out.end(), [&](const Use& a, const Use& b) {
    return m.origin(a.technology).instance < m.origin(b.technology).instance;
  });
  return out;
}

double vc_of(double diameter_mm, double rpm) {
  return std::numbers::pi * diameter_mm * std::abs(rpm) / 1000.0;
}

// How far a pair of readings (1/min; m/min; 0 where not given) is from making sense; infinite when it cannot
// be.
double cost(const Use& use, double rpm, double vc, int repairs) {
  const double vc_max = use.drilling ? kMaxVcDrilling : kMaxVcMilling;
  const double never = std::numeric_limits<double>::infinity();
  const double v = vc_of(use.diameter_mm, rpm);
  if (std::abs(rpm) > kMaxRpm) return never;
  if (v != 0.0 && (v < kMinVc || v > vc_max)) return never;
  if (vc != 0.0 && (vc < kMinVc || vc > vc_max)) return never;
  const double c = repairs * std::log(2.0);  // the standard's own reading is preferred up to a factor of two
  return v > 0.0 && vc > 0.0 ? c + std::abs(std::log(v / vc)) : c;
}

std::string show(double v) { return trimmed(v, 1); }

void say_spindle(Reading& r, const Use& use, double rpm) {
  const std::string given = in_file(r, use.technology, "spindle");
  std::string why =
      given + " is taken as revolutions per minute: per second it would be " + show(60.0 * rpm) + " 1/min";
  if (use.diameter_mm > 0.0) {
    why += ", or " + show(vc_of(use.diameter_mm, 60.0 * rpm)) + " m/min for a diameter of " +
           trimmed(use.diameter_mm, 3) + " mm";
  }
  note(r, use.technology, "spindle", true, "EXC-UNIT-SPINDLE", why);
}

// Chooses among the four readings of a spindle speed and a cutting speed.
void check_units(Reading& r, const Use& use) {
  auto& t = r.plan.model.at<model::MillingTechnology>(use.technology);
  const double rpm = t.spindle.value_or(0.0);
  const double vc = t.cutspeed.value_or(0.0) / 1000.0;
  double best = std::numeric_limits<double>::infinity();
  bool per_minute = false, metres_per_minute = false;
  for (const bool s : {false, true}) {
    for (const bool c : {false, true}) {
      if ((s && rpm == 0.0) || (c && vc == 0.0)) continue;
      const double k = cost(use, s ? rpm / 60.0 : rpm, c ? vc / 60.0 : vc, int{s} + int{c});
      if (k < best) {
        best = k;
        per_minute = s;
        metres_per_minute = c;
      }
    }
  }
  if (!std::isfinite(best)) {
    note(r, use.technology, rpm != 0.0 ? "spindle" : "cutspeed", false, "EXC-SPEED",
         "neither the standard's units nor revolutions and metres per minute make a speed that can be cut "
         "with; "
         "kept as it is");
    return;
  }
  if (per_minute) {
    t.spindle = rpm / 60.0;
    say_spindle(r, use, rpm / 60.0);
  }
  if (metres_per_minute) {
    t.cutspeed = *t.cutspeed / 60.0;
    note(r, use.technology, "cutspeed", true, "EXC-UNIT-CUTSPEED",
         in_file(r, use.technology, "cutspeed") + " is taken as m/min: in m/s it would be " + show(vc) +
             " m/min");
  }
}

void check_agreement(Reading& r, const Use& use) {
  const auto& t = r.plan.model.at<model::MillingTechnology>(use.technology);
  if (!t.cutspeed || !t.spindle || *t.spindle == 0.0 || !(*t.cutspeed > 0.0)) return;
  const double vc = *t.cutspeed / 1000.0;
  std::string why =
      "given beside the spindle speed, where the standard allows one of them; the spindle is used";
  if (use.diameter_mm > 0.0) {
    const double n = vc_of(use.diameter_mm, *t.spindle);
    const bool agree = model::speeds_agree(vc, n);
    why += agree ? ", and agrees"
                 : ", though " + show(std::abs(*t.spindle)) + " 1/min make " + show(n) +
                       " m/min of a diameter of " + trimmed(use.diameter_mm, 3) + " mm, not " + show(vc);
  }
  note(r, use.technology, "cutspeed", false, "EXC-SPEED-CONFLICT", why);
}

void check_direction(Reading& r, const Use& use) {
  const auto& t = r.plan.model.at<model::MillingTechnology>(use.technology);
  if (!t.spindle || *t.spindle == 0.0 || !use.hand.set() || use.hand == model::Hand::kNeutral) return;
  const bool clockwise = *t.spindle < 0.0;  // ISO 14649-11: positive is counter-clockwise, from the spindle
  const bool right = use.hand == model::Hand::kRight;
  if (clockwise == right) return;
  note(r, use.technology, "spindle", false, "EXC-SPINDLE-DIRECTION",
       in_file(r, use.technology, "spindle") + " turns " + (clockwise ? "clockwise" : "counter-clockwise") +
           " (ISO 14649: positive is counter-clockwise), against a " + (right ? "right" : "left") +
           "-hand cutter; kept as it is");
}

// Of an operation; a toolpath may well stop the spindle.
void check_standing(Reading& r, const Use& use) {
  auto& t = r.plan.model.at<model::MillingTechnology>(use.technology);
  if (!t.spindle || *t.spindle != 0.0) return;
  t.spindle.reset();
  note(r, use.technology, "spindle", true, "EXC-ZERO",
       in_file(r, use.technology, "spindle") + " cuts nothing; taken as open");
}

void check_feed(Reading& r, const Use& use) {
  auto& t = r.plan.model.at<model::MillingTechnology>(use.technology);
  if (!t.feedrate) return;
  if (*t.feedrate == 0.0) {
    t.feedrate.reset();
    note(r, use.technology, "feedrate", true, "EXC-ZERO",
         in_file(r, use.technology, "feedrate") + " moves nothing; taken as open");
    return;
  }
  if (!t.spindle || *t.spindle == 0.0 || use.diameter_mm == 0.0 || use.tapping) return;
  const double per_rev = *t.feedrate / std::abs(*t.spindle);
  const auto teeth = static_cast<double>(std::max<std::int64_t>(1, use.teeth));
  const double f = use.drilling ? per_rev : per_rev / teeth;
  const double limit = use.drilling ? kMaxFeedPerRevDrill * use.diameter_mm
                                    : std::min(kMaxFeedPerTooth, 0.1 * use.diameter_mm);
  if (std::abs(f) <= limit) return;
  note(r, use.technology, "feedrate", false, "EXC-FEED",
       in_file(r, use.technology, "feedrate") + " m/s is " + show(*t.feedrate) + " mm/min, or " +
           (std::isfinite(f) ? trimmed(f, 3) : std::string("more than any number of")) + " mm per " +
           (use.drilling ? "revolution" : "tooth") + " at " + show(std::abs(*t.spindle)) +
           " 1/min with a diameter of " + trimmed(use.diameter_mm, 3) +
           " mm; kept as it is, and hardly meant");
}

}  // namespace

void check_technology(Reading& r) {
  for (const Use& use : uses(r)) {
    check_standing(r, use);
    check_units(r, use);
    check_agreement(r, use);
    check_direction(r, use);
    check_feed(r, use);
  }
}

}  // namespace capstan::exchange::deviations
