#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/sweep/step_checks.h"

// How a mill goes down into solid material: straight, on a slope, along a helix.

namespace capstan::verify {

using model::MoveRole;

namespace {

/// Centres of a helix's arcs in a program agree to this, mm: a few of its last digits.
constexpr double kSameCentre = 0.01;
constexpr double kJudgedAloneMm = 1.0;  ///< rounding at 3 decimals is 0.1 degrees of it; default, unsourced

bool cuts_to_centre(const model::Cutter& c) {
  return verify::cuts_to_centre(c.cutter_class) || c.centre_cutting;
}

/// Whether a maker or the shop states how steep the cutter may ramp.
bool states_ramp(const model::Cutter& c) {
  for (const std::string_view of : {"maximum_ramp_angle_rad", "*"}) {
    for (const auto& [field, source] : c.sources)
      if (field == of) return source.starts_with("stated");
  }
  return false;
}

}  // namespace

bool chose_ramp(const model::Plan& plan, const model::MachiningWorkingstep& ws) {
  const auto* made = plan.ledger.find(ws.its_operation, "its_toolpath");
  if (made == nullptr || made->binder == model::Binder::kGiven || made->pinned) return false;
  const auto* op = plan.model.get<model::Two5dMillingOperation>(ws.its_operation);
  if (op == nullptr) return true;
  if (const auto* r = plan.model.get<model::PlungeRamp>(op->approach)) return !(r->angle.value_or(0.0) > 0.0);
  if (const auto* h = plan.model.get<model::PlungeHelix>(op->approach))
    return !(h->angle.value_or(0.0) > 0.0);
  if (const auto* z = plan.model.get<model::PlungeZigzag>(op->approach))
    return !(z->angle.value_or(0.0) > 0.0);
  return true;
}

void StepChecks::entry(const Move& m, const Bite& bite) {
  const double dz = m.to.z - m.from.z;
  if (dz >= -1e-9) {
    helix_turned_ = 0.0;
    descent_ = {};
    return;
  }
  const double along = is_arc(m.kind) ? norm(xy(m.to) - m.centre) * sweep_of(m) : norm(xy(m.to) - xy(m.from));
  // Both ends are rounded: the move that was meant may have been as much flatter. What rounding does to short
  // moves does not add up along them: they are judged together, a millimetre of them at a time.
  const auto flattest = [&](double drop, double way) {
    return std::atan2(std::max(0.0, drop - 2.0 * m.rounding_mm), way + 2.0 * m.rounding_mm);
  };
  const double angle = std::atan2(-dz, along);
  double least = flattest(-dz, along);
  const bool core = bite.core_mm > 0.05;
  if (along < 1e-6 || angle > 1.5533) {  // steeper than 89 degrees
    descent_ = {};
    if (core && !cuts_to_centre(cutter_)) {
      out_.error(14, "CHK-PLUNGE", at(m),
                 "the tool does not cut to its centre, but plunges " + mm(-dz) + " into solid material", -dz);
    }
    return;
  }
  // Following a surface down with a ball, or down a thread, is not an entry; a mill whose end cuts is.
  const bool ramp = m.role_known && m.role == MoveRole::kRamp;
  const bool shaped = is_ball(cutter_.cutter_class) || plan_.target_mesh != nullptr;
  if (!core) descent_ = {};
  if (!core || mills_threads(cutter_.cutter_class) || (shaped && !ramp)) return;
  if (along >= kJudgedAloneMm || descent_.along_mm >= kJudgedAloneMm) descent_ = {};
  if (along < kJudgedAloneMm) {
    descent_.drop_mm -= dz;
    descent_.along_mm += along;
    least = std::max(least, flattest(descent_.drop_mm, descent_.along_mm));
  }
  const double most = cutter_.maximum_ramp_angle_rad;
  const double degrees = 180.0 / std::numbers::pi;
  if (least > most + 1e-4) {
    out_.error(14, "CHK-RAMP", at(m),
               "a ramp of " + plain(angle * degrees) + " degrees; the tool may " +
                   (most > 0.0 ? "ramp at " + plain(most * degrees) +
                                     " degrees at most: ramp over a longer way, or use a tool that allows it"
                               : "not ramp: use one that cuts to its centre, or drill a hole to enter by"),
               angle);
  } else if (ramp && ramp_chosen_) {
    chosen_ramp(m, least);
  }
  if (!is_arc(m.kind)) return;
  // A helix turns round one centre, or near it by less than its core is wide; the corners of a ramp along a
  // ring turn round several and leave no core by it.
  const double helix = norm(xy(m.to) - m.centre);
  if (norm(m.centre - helix_centre_) > std::max(kSameCentre, helix - radius_)) {
    helix_turned_ = 0.0;
    helix_centre_ = m.centre;
  }
  helix_turned_ += sweep_of(m);
  if (helix_turned_ > 2.0 * std::numbers::pi - 1e-6 && helix > radius_ + 1e-6) {
    out_.error(14, "CHK-HELIX", at(m),
               "a helix of diameter " + mm(2.0 * helix) + " leaves a core; the cutter's diameter is " +
                   mm(2.0 * radius_),
               helix);
  }
}

// What planning chooses by itself is no steeper than its table by material says; steeper only where somebody
// states the cutter's angle, and then at half of the feed (sources: model/plan/cutter/ramp.cpp). Which feed
// that is a half of is not known here: the largest that the cutter bears, or that of the step.
void StepChecks::chosen_ramp(const Move& m, double angle) {
  constexpr double kHalf = 0.5;
  const double usual = usual_ramp(cutter_, plan_.material.iso_group), degrees = 180.0 / std::numbers::pi;
  if (angle <= usual + 1e-4) return;
  const double fz = feed_per_tooth(m);
  const double slow =
      std::max(kHalf * std::max(feed_limit_.mm, step_.planned->fz_mm), least_chip_mm_) * (1.0 + kWritten);
  if (states_ramp(cutter_) && fz <= slow) return;
  out_.error(
      14, "CHK-RAMP", at(m),
      "a ramp of " + plain(angle * degrees) + " degrees at " + mm(fz) + " per tooth; in " +
          plan_.material.id + " one of more than " + plain(usual * degrees) + " degrees is " +
          (states_ramp(cutter_) ? "fed at " + mm(slow) + " at most" : "for cutters whose data allow it") +
          ": ramp flatter, feed slower, or state the tool's largest ramp angle",
      angle);
}

}  // namespace capstan::verify
