#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/controls/controls.h"
#include "planner/proof/verify/program/program_checks.h"
#include "tests/proof/verify/plans.h"

// What rounding to a control's decimals makes of a path is blamed on nobody.

namespace capstan::mutation {
namespace {

namespace plans = verify::testing;
using model::MoveRole;

std::string program_of(const model::Plan& plan) {
  Job job;
  const auto text = controls::write_program(plan, job);
  EXPECT_TRUE(text) << (text ? "" : to_text(text.error()));
  return text.value_or("");
}

/// A pocket whose path has an arc of half a micrometre, with a feed of its own behind it.
model::Plan with_a_short_arc(const char* control) {
  auto k = plans::good_plan();
  const std::size_t before = k.plan.steps[0].path->size();
  plans::edit_path(k.plan, 0, [](auto& p) {
    const auto at = p.point(p.size() - 1);
    p.line({at.x - 2.0, at.y, at.z}, MoveRole::kLink);
    p.arc({at.x - 2.0 + 0.0003, at.y, at.z}, {at.x - 2.0 + 0.00015, at.y - 4.0}, true, MoveRole::kLink);
    p.line({at.x - 4.0, at.y, at.z}, MoveRole::kLink);
    p.rapid(at, MoveRole::kRetract);
  });
  plans::edit_schedule(k.plan, 0, [&](auto& s) {
    for (std::size_t i = before; i < before + 4; ++i) {
      s.feed_mm_min.push_back(i == before + 2 ? 900 : 600);
      s.spindle_rpm.push_back(3000);
      s.dwell_s.push_back(0.0);
    }
  });
  k.plan.machine = controls::with_control(k.plan.machine, control);
  k.plan.setups[0].work_offset = controls::find_dialect(control)->work_offsets.front();
  return k.plan;
}

TEST(Rounding, AnArcShorterThanTheLastDecimalIsNoWholeTurn) {
  for (const char* control : {"fanuc", "haas", "siemens", "heidenhain", "grbl", "mach3"}) {
    const model::Plan plan = with_a_short_arc(control);
    const auto findings =
        verify::check_program_text({"part", program_of(plan), ""}, &plan, plan.machine, plan.cutters);
    for (const auto& f : findings)
      EXPECT_EQ(f.severity, Severity::kNote) << control << ": " << f.code << " " << f.message;
  }
}

/// An arc of 2 mm radius: its start is rounded by half a unit and its centre to three decimals, so that its
/// text turns by 0.001 rad less.
model::Plan with_a_small_arc(const char* control) {
  auto k = plans::good_plan();
  const std::size_t before = k.plan.steps[0].path->size();
  plans::edit_path(k.plan, 0, [](auto& p) {
    const auto at = p.point(p.size() - 1);
    constexpr double kRadius = 2.00560582854, kTurn = 2.49785;
    const geometry::Vec2 c{at.x + 0.99991, at.y - 0.00011525};
    p.line({c.x + kRadius, c.y, at.z}, MoveRole::kLink);
    p.arc({c.x + kRadius * std::cos(kTurn), c.y + kRadius * std::sin(kTurn), at.z}, c, false,
          MoveRole::kLink);
    p.rapid(at, MoveRole::kRetract);
  });
  plans::edit_schedule(k.plan, 0, [&](auto& s) {
    for (std::size_t i = before; i < before + 3; ++i) {
      s.feed_mm_min.push_back(600);
      s.spindle_rpm.push_back(3000);
      s.dwell_s.push_back(0.0);
    }
  });
  k.plan.machine = controls::with_control(k.plan.machine, control);
  k.plan.setups[0].work_offset = controls::find_dialect(control)->work_offsets.front();
  return k.plan;
}

TEST(Rounding, ASmallArcWhoseCentreIsRoundedEndsWhereItIsMeant) {
  for (const char* control : {"fanuc", "haas", "siemens", "heidenhain", "grbl", "mach3"}) {
    const model::Plan plan = with_a_small_arc(control);
    const auto findings =
        verify::check_program_text({"part", program_of(plan), ""}, &plan, plan.machine, plan.cutters);
    for (const auto& f : findings)
      EXPECT_EQ(f.severity, Severity::kNote) << control << ": " << f.code << " " << f.message;
  }
}

constexpr double kDegree = std::numbers::pi / 180.0;

/// Whether the program of a ramp of so many degrees has CHK-RAMP; the tool may ramp at 3. Its last piece is
/// 1.204 mm long: from Z-1.00045, written -1, to -1.06355, written -1.064, is 3.04 degrees in the text.
constexpr double kPiece = 1.204;
bool ramp_is_blamed(double degrees) {
  auto k = plans::empty_plan();
  model::Cutter& c = k.plan.cutters[0];
  c.maximum_ramp_angle_rad = 3.0 * kDegree;
  const double z = -1.00045, along = (0.2 - z) / std::tan(3.0 * kDegree);
  model::CutterPath p;
  p.start({36, 50, 10});
  p.rapid({36, 50, 0.2});
  p.line({36 + along, 50, z}, MoveRole::kRamp);
  p.line({36 + along + kPiece, 50, z - kPiece * std::tan(degrees * kDegree)}, MoveRole::kRamp);
  p.rapid({36 + along + kPiece, 50, 10}, MoveRole::kRetract);
  auto& s =
      k.step<model::BottomAndSideRoughMilling>("pocket", k.pocket("P", 50, 50, 40, 20), "em10", p, 600, 3000);
  const auto op = k.plan.model.get<model::MachiningWorkingstep>(s.step)->its_operation;
  k.plan.ledger.bind(op, "its_toolpath", model::Binder::kGiven, {"path.given", "given", "here"});
  k.plan.machine = controls::with_control(k.plan.machine, "fanuc");
  Job job;
  const auto found = verify::check_program({"part.nc", program_of(k.plan), ""}, &k.plan, k.plan.machine,
                                           k.plan.cutters, job);
  return std::any_of(found.begin(), found.end(), [](const auto& f) { return f.code == "CHK-RAMP"; });
}

TEST(Rounding, AShortRampIsAsSteepAsItIsMeant) {
  EXPECT_FALSE(ramp_is_blamed(3.0));
  EXPECT_TRUE(ramp_is_blamed(3.3));
}

}  // namespace
}  // namespace capstan::mutation
