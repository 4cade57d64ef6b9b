// Random questions: whatever is answered keeps every limit when measured again from the formulas, not through
// the optimiser's own bookkeeping; nothing throws; nonsense is an outcome or a refusal.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "planner/making/optimise/cut.h"
#include "planner/physics/mechanics/bending/beam.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/drilling.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/force/immersion.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/loads/section.h"
#include "planner/physics/mechanics/loads/side_section.h"
#include "planner/physics/mechanics/spindle.h"
#include "tests/making/optimise/cut/questions.h"
#include "tests/support/mechanics/section_loads.h"

namespace capstan::optimise {
namespace {

using std::numbers::pi;

class Dice {
 public:
  explicit Dice(unsigned seed) : random_(seed) {}
  double between(double lo, double hi) {  // evenly in the logarithm
    return lo * std::pow(hi / lo, static_cast<double>(random_()) / 4294967295.0);
  }
  bool maybe(double chance) { return static_cast<double>(random_()) / 4294967295.0 < chance; }
  std::size_t one_of(std::size_t n) { return random_() % n; }

 private:
  std::mt19937 random_;
};

CutQuestion any_question(Dice& d) {
  CutQuestion q = questions::roughing();
  constexpr CutKind kKinds[] = {CutKind::kRough, CutKind::kRough, CutKind::kRough, CutKind::kFinish,
                                CutKind::kAxial};
  q.kind = kKinds[d.one_of(5)];
  auto& c = q.cutter;
  c.cutting_diameter_mm = d.between(0.5, 63.0);
  c.shank_diameter_mm = c.cutting_diameter_mm * d.between(0.7, 1.5);
  c.maximum_depth_of_cut_mm = c.cutting_diameter_mm * d.between(0.5, 4.0);
  c.stick_out_mm = c.maximum_depth_of_cut_mm * d.between(1.0, 3.0);
  c.teeth = 1 + static_cast<int>(d.one_of(6));
  c.helix_rad = d.maybe(0.2) ? 0.0 : d.between(0.1, 0.9);
  if (d.maybe(0.2)) c.corner_radius_mm = c.cutting_diameter_mm * d.between(0.01, 0.4);
  if (d.maybe(0.15)) c.cutter_class = model::CutterClass::kBallEndmill;
  if (q.kind == CutKind::kAxial) c.point_angle_rad = d.between(1.5, 3.0);
  if (d.maybe(0.3)) c.substrate = model::Substrate::kHss;
  if (d.maybe(0.3)) c.runout_mm = d.between(0.001, 0.02);
  q.fz_start_mm = c.cutting_diameter_mm * d.between(0.001, 0.02);
  c.fz_max_mm = d.maybe(0.5) ? q.fz_start_mm * d.between(0.8, 3.0) : 0.0;
  c.fz_min_mm = d.maybe(0.3) ? q.fz_start_mm * d.between(0.05, 0.9) : 0.0;
  c.price = d.maybe(0.5) ? d.between(1.0, 500.0) : 0.0;
  c.life_min = d.maybe(0.5) ? d.between(5.0, 100.0) : 0.0;
  q.vc_start_m_min = d.between(10.0, 800.0);
  q.material.kc11_n_mm2 = d.between(300.0, 4000.0);
  q.material.mc = d.between(0.05, 0.45);
  if (d.maybe(0.3))
    q.material.mechanistic = {{.substrate = d.maybe(0.7) ? "carbide" : "hss",
                               .ktc_n_mm2 = d.between(200.0, 2000.0),
                               .kte_n_mm = d.between(1.0, 40.0),
                               .krc_n_mm2 = d.between(50.0, 900.0),
                               .kre_n_mm = d.between(1.0, 40.0),
                               .kac_n_mm2 = d.between(50.0, 300.0),
                               .kae_n_mm = d.between(0.5, 5.0),
                               .uncertainty = d.maybe(0.5) ? 0.2 : 0.0,
                               .source = "dice"}};
  auto& s = q.machine.spindle;
  s.rpm_min = d.between(10.0, 500.0);
  s.rpm_max = s.rpm_min * d.between(2.0, 300.0);
  s.efficiency = d.between(0.5, 1.0);
  const double power = d.between(5.0, 40000.0);
  const double base = s.rpm_min * d.between(1.1, 0.9 * s.rpm_max / s.rpm_min);
  s.curve = {{s.rpm_min, power * s.rpm_min / base, 0.0}, {base, power, 0.0}};
  if (d.maybe(0.8)) s.curve.push_back({s.rpm_max, power * d.between(0.4, 1.0), 0.0});
  if (d.maybe(0.1)) s.curve.clear();
  for (auto& a : q.machine.axes) a.feed_max_mm_min = d.between(200.0, 40000.0);
  q.machine.abilities.feed_override_max = d.maybe(0.5) ? 1.2 : 1.0;
  q.depth_mm = d.between(0.05, 60.0);
  q.width_mm = d.between(0.05, 200.0);
  q.slot = q.kind == CutKind::kRough && d.maybe(0.3);
  q.deflection_limit_mm = d.maybe(0.5) ? d.between(0.002, 0.5) : 0.0;
  if (d.maybe(0.2)) q.surface_ra_um = d.between(0.01, 10.0);
  if (d.maybe(0.2)) q.peak_force_limit_n = d.between(10.0, 5000.0);
  // A draw without a use, so that the numbers after it are those of the seeds that found faults.
  if (d.maybe(0.1)) (void)d.between(0.0005, 0.02);
  if (d.maybe(0.1)) q.wall_error_limit_mm = d.between(0.002, 0.1);
  if (d.maybe(0.2)) q.ap_mm = d.between(0.05, 10.0);
  if (d.maybe(0.1)) q.ae_mm = d.between(0.05, 60.0);
  if (d.maybe(0.1)) q.n_rpm = d.between(50.0, 20000.0);
  if (d.maybe(0.1)) q.feed_mm_min = d.between(1.0, 20000.0);
  q.override_locked = d.maybe(0.2);
  q.aim = static_cast<Aim>(d.one_of(3));
  q.earning_per_min = d.maybe(0.5) ? d.between(0.1, 10.0) : 0.0;
  return q;
}

/// The limits again, from the formulas of mechanics and the fields of the question alone.
void expect_kept(const CutQuestion& q, const CutAnswer& a, int number) {
  SCOPED_TRACE(number);
  constexpr double kHair = 1.0 + 2e-6;
  const auto& c = q.cutter;
  const bool mills = q.kind != CutKind::kAxial;
  const bool given = q.feed_mm_min.has_value();
  const double up = q.override_locked || given ? 1.0 : std::max(1.0, q.machine.abilities.feed_override_max);
  const double fz = a.feed_mm_min / (a.n_rpm * c.teeth);
  EXPECT_NEAR(a.fz_mm, fz, 1e-12);
  EXPECT_NEAR(a.vc_m_min, pi * c.cutting_diameter_mm * a.n_rpm / 1000.0, 1e-9 * a.vc_m_min);
  EXPECT_LE(a.n_rpm, q.machine.spindle.rpm_max * kHair);
  EXPECT_GE(a.n_rpm * kHair, q.machine.spindle.rpm_min);
  EXPECT_LE(a.feed_mm_min,
            (mills ? std::min(q.machine.axes[0].feed_max_mm_min, q.machine.axes[1].feed_max_mm_min)
                   : q.machine.axes[2].feed_max_mm_min) *
                kHair);
  double torque = 0.0, force = 0.0, chip = 0.0;
  if (mills) {
    EXPECT_LE(a.ap_mm, c.maximum_depth_of_cut_mm * kHair);
    EXPECT_LE(a.ae_mm, c.cutting_diameter_mm * kHair);
    mechanics::Tooth tooth = mechanics::tooth_of(c);
    const auto law = mechanics::force_law(q.material, c);
    for (const auto side : {mechanics::CutDirection::kUp, mechanics::CutDirection::kDown}) {
      // A flat cutter's arc is known; a corner or ball has to remove what the cut removes.
      mechanics::Section section{.ap_mm = a.ap_mm,
                                 .arc = mechanics::immersion_arc(a.ae_mm, c.cutting_diameter_mm, side)};
      const bool round = tooth.corner_radius_mm > 0.0;
      if (round) section = mechanics::side_section(a.ap_mm, a.ae_mm, tooth, side);
      const auto l = mechanics::section_loads(section, tooth, law, fz, a.n_rpm);
      ASSERT_TRUE(l);
      const auto planned_loads = mechanics::section_loads(section, tooth, law, fz, a.n_rpm);
      ASSERT_TRUE(planned_loads);
      torque = std::max(torque, l->torque_nm);
      force = std::max(force, l->peak_force_n);
      chip = std::max(chip, planned_loads->h_max_mm);
    }
    const double width = std::min(
        a.ae_mm, mechanics::effective_diameter_mm(a.ap_mm, c.cutting_diameter_mm, tooth.corner_radius_mm));
    const double law_n_mm2 =
        law.mechanistic ? law.mechanistic->ktc_n_mm2 : mechanics::specific_force_n_mm2(law.kienzle, fz);
    EXPECT_GE(torque * 2.0 * pi * a.n_rpm / 60.0,
              0.99 * mechanics::cutting_power_w(a.ap_mm * width * a.feed_mm_min, law_n_mm2));
    const double margin = mechanics::force_margin(q.material, c.substrate, {.feed_up = up}).factor();
    torque *= margin;
    force *= margin;
    const double planned = c.fz_max_mm > 0.0 ? std::min(q.fz_start_mm, c.fz_max_mm / up) : q.fz_start_mm;
    EXPECT_LE(chip, planned * kHair);
    if (q.deflection_limit_mm > 0.0) {
      EXPECT_LE(a.loads.deflection_mm, q.deflection_limit_mm * kHair);
    }
    if (const auto bears = mechanics::enduring_bend_mm(c);
        bears && c.cutter_class != model::CutterClass::kFacemill) {
      EXPECT_LE(a.loads.deflection_mm, *bears * kHair);
    }
    EXPECT_NEAR(a.loads.peak_force_n, force, 1e-9 * force);
    if (q.surface_ra_um > 0.0) {
      EXPECT_LE(1.24 * 256.6 * fz * fz / (4.0 * c.cutting_diameter_mm), q.surface_ra_um * 1.001);
    }
    if (q.wall_error_limit_mm > 0.0) {
      EXPECT_LE(std::abs(a.loads.wall_error_mm), q.wall_error_limit_mm * kHair);
    }
  } else {
    const auto l = mechanics::drilling_loads({.diameter_mm = c.cutting_diameter_mm,
                                              .feed_mm_per_rev = a.feed_mm_min / a.n_rpm,
                                              .n_rpm = a.n_rpm,
                                              .teeth = c.teeth,
                                              .point_angle_rad = c.point_angle_rad},
                                             {q.material.kc11_n_mm2, q.material.mc});
    ASSERT_TRUE(l);
    const double spread = std::max(mechanics::kForceUncertaintyFactor, 1.0 + q.material.kc_uncertainty);
    const double margin = std::exp(std::hypot(std::log(spread), std::log(mechanics::kWearForceFactor),
                                              (1.0 - q.material.mc) * std::log(up)));
    torque = l->torque_nm * margin;
    force = l->thrust_n * margin;
  }
  if (q.peak_force_limit_n > 0.0) {
    EXPECT_LE(force, q.peak_force_limit_n * kHair);
  }
  if (!q.machine.spindle.curve.empty()) {
    std::vector<mechanics::SpindlePoint> points;
    for (const auto& p : q.machine.spindle.curve) points.push_back({p.rpm, p.power_w, p.torque_nm});
    const auto curve = mechanics::SpindleCurve::make(points);
    ASSERT_TRUE(curve);
    const auto has = curve->at(std::clamp(a.n_rpm, curve->min_rpm(), curve->max_rpm()));
    ASSERT_TRUE(has);
    EXPECT_LE(torque, has->torque_nm * q.machine.spindle.efficiency * kHair);
    EXPECT_LE(torque * 2.0 * pi * a.n_rpm / 60.0, has->power_w * q.machine.spindle.efficiency * kHair);
  }
  if (c.fz_min_mm > 0.0 && !given) {
    EXPECT_GE(fz + 1.0 / (a.n_rpm * c.teeth), c.fz_min_mm * (1.0 - 1e-6));
  }
  ASSERT_EQ(a.active.size(), a.saved_by_tenth.size());
  for (const auto& l : a.active) {
    EXPECT_FALSE(l.name.empty());
    EXPECT_FALSE(l.unit.empty());
    EXPECT_GE(l.shadow_price, 0.0);
    EXPECT_TRUE(std::isfinite(l.shadow_price) && std::isfinite(l.limit));
  }
}

TEST(CutProperty, WhatIsAnsweredKeepsEveryLimitMeasuredAgain) {
  Dice dice(20240615);
  int feasible = 0;
  constexpr int kQuestions = 200;
  Options o;
  o.starts = 1;
  for (int i = 0; i < kQuestions; ++i) {
    const CutQuestion q = any_question(dice);
    Job job;
    const auto a = cut(q, o, job);
    if (!a && a.error().code == "OPT-BACKEND-ABSENT") GTEST_SKIP() << a.error().message;
    ASSERT_TRUE(a) << i << " " << to_text(a.error());
    if (a->feasible) {
      ++feasible;
      expect_kept(q, *a, i);
    } else {
      EXPECT_FALSE(a->violated.empty()) << i;
    }
    if (HasFailure()) break;
  }
  EXPECT_GT(feasible, kQuestions / 4);
  EXPECT_LT(feasible, kQuestions);
}

TEST(CutProperty, NumbersThatAreNoneThrowNothing) {
  Dice dice(77);
  constexpr double kNone[] = {0.0,
                              -1.0,
                              1e-320,
                              1e300,
                              std::numeric_limits<double>::quiet_NaN(),
                              std::numeric_limits<double>::infinity()};
  Options o;
  o.starts = 1;
  for (int i = 0; i < 300; ++i) {
    CutQuestion q = any_question(dice);
    auto& s = q.machine.spindle;
    double* fields[] = {&q.vc_start_m_min,
                        &q.fz_start_mm,
                        &q.depth_mm,
                        &q.width_mm,
                        &q.pre_hole_mm,
                        &q.deflection_limit_mm,
                        &q.least_feed_ratio,
                        &q.ap_most_mm,
                        &q.surface_ra_um,
                        &q.peak_force_limit_n,
                        &q.wall_error_limit_mm,
                        &q.earning_per_min,
                        &q.cutter.cutting_diameter_mm,
                        &q.cutter.stick_out_mm,
                        &q.cutter.maximum_depth_of_cut_mm,
                        &q.cutter.fz_max_mm,
                        &q.cutter.fz_min_mm,
                        &q.cutter.helix_rad,
                        &q.cutter.corner_radius_mm,
                        &q.cutter.price,
                        &q.cutter.life_min,
                        &q.cutter.runout_mm,
                        &q.cutter.point_angle_rad,
                        &q.cutter.lead_angle_rad,
                        &q.cutter.maximum_speed_rpm,
                        &q.material.kc11_n_mm2,
                        &q.material.mc,
                        &s.rpm_min,
                        &s.rpm_max,
                        &s.efficiency,
                        &q.machine.axes[0].feed_max_mm_min,
                        &q.machine.axes[2].feed_max_mm_min,
                        &q.machine.cost_per_hour,
                        &q.machine.tool_change_s,
                        &q.machine.abilities.feed_override_max};
    for (std::size_t k = 0; k <= dice.one_of(2); ++k)
      *fields[dice.one_of(std::size(fields))] = kNone[dice.one_of(6)];
    if (dice.maybe(0.1)) q.feed_mm_min = kNone[dice.one_of(6)];
    if (dice.maybe(0.1)) q.ap_mm = kNone[dice.one_of(6)];
    if (dice.maybe(0.1)) q.n_rpm = kNone[dice.one_of(6)];
    Job job;
    EXPECT_NO_THROW({
      const auto a = cut(q, o, job);
      if (a && a->feasible) {
        EXPECT_TRUE(std::isfinite(a->feed_mm_min) && a->feed_mm_min > 0.0) << i;
        EXPECT_TRUE(std::isfinite(a->n_rpm) && a->n_rpm > 0.0) << i;
        EXPECT_TRUE(std::isfinite(a->loads.torque_nm)) << i;
      }
    }) << i;
  }
}

}  // namespace
}  // namespace capstan::optimise
