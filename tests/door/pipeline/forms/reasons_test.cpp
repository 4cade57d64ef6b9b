#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "planner/making/optimise/cut.h"
#include "planner/making/step/cut/cuts.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/shop.h"

// What a plan says of why is what held: limits, coefficients, alternatives; and what is stated once is used
// everywhere.

namespace capstan::pipeline {
namespace {

const Inputs& shop() {
  static const Inputs kShop = [] {
    Job job;
    return load_shop({}, job).value();
  }();
  return kShop;
}

model::Plan planned(const std::string& text) {
  Job job;
  auto plan = read_plan(text, "part.p21", job);
  return bind(std::move(plan).value(), shop(), {}, job).value();
}

/// Examples, and plates with holes, pockets and fits as they are generated.
const std::vector<model::Plan>& plans() {
  static const std::vector<model::Plan> kPlans = [] {
    std::vector<model::Plan> out;
    for (const char* name : {"bracket.p21", "two_setups.p21", "plate_bound.p21"})
      out.push_back(planned(testing::slurp(capstan::testing::source_dir() + "/examples/" + name)));
    for (const std::size_t n : {3U, 6U}) out.push_back(planned(testing::plate(n).text));
    return out;
  }();
  return kPlans;
}

/// The widest circle that cuts: a spot of 90 degrees is twice as wide as it is deep, a face mill whose edges
/// lean wider where they leave the material than at its tip.
double widest_mm(const model::Plan& plan, const model::StepResult& s, const model::Cutter& c) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
  const auto* spot = plan.model.get<model::CenterDrilling>(ws->its_operation);
  if (c.cutter_class == model::CutterClass::kFacemill)
    return c.cutting_diameter_mm + 2.0 * s.axial_depth_mm * std::tan(c.lead_angle_rad);
  if (spot == nullptr) return c.cutting_diameter_mm;
  EXPECT_NEAR(c.point_angle_rad, 0.5 * std::numbers::pi, 1e-9) << c.id;
  return std::min(c.cutting_diameter_mm, 2.0 * spot->cutting_depth.value());
}

TEST(ReasonsProperty, ALimitThatIsNamedIsAtItsBoundAtTheSpeedAndFeedThatWereChosen) {
  std::size_t named = 0;
  std::map<std::string, std::size_t> by_name;
  for (const model::Plan& plan : plans()) {
    for (const model::StepResult& s : plan.steps) {
      const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
      ASSERT_NE(c, nullptr);
      const double n = std::abs(s.spindle_rpm);
      for (const model::ActiveConstraint& a : s.active) {
        SCOPED_TRACE(model::step_id(plan, s) + ": " + a.name);
        ++named;
        ++by_name[a.name];
        // Numbers are rounded to whole turns and mm/min, to the safe side: a hundredth is more than that.
        EXPECT_NEAR(a.value, a.limit, 0.01 * a.limit);
        const double vc = std::numbers::pi * widest_mm(plan, s, *c) * n / 1000.0;
        if (a.name == "cutting_speed") {
          EXPECT_NEAR(vc, a.limit, 0.01 * a.limit);
          EXPECT_LT(n, plan.machine.spindle.rpm_max * (1.0 - 1e-9)) << "what held is the spindle";
        }
        if (a.name == "spindle_speed_most") {
          EXPECT_NEAR(n, plan.machine.spindle.rpm_max, 1.0);
        }
        if (a.name == "feed_per_tooth") {
          EXPECT_NEAR(s.fz_mm, a.limit, 0.01 * a.limit);
        }
        if (a.name == "radial_cutting_depth") {
          EXPECT_NEAR(s.radial_depth_mm, a.limit, 0.01 * a.limit);
        }
      }
    }
  }
  EXPECT_GT(named, 60U);  // two or so in each of some 45 steps
  for (const char* looked_at :
       {"cutting_speed", "spindle_speed_most", "feed_per_tooth", "radial_cutting_depth"})
    EXPECT_GT(by_name[looked_at], 0U) << looked_at;
}

TEST(ReasonsProperty, ForcesNameTheCoefficientsThatGaveThem) {
  std::size_t milled = 0;
  for (const model::Plan& plan : plans()) {
    for (const model::StepResult& s : plan.steps) {
      const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
      const auto* op = plan.model.get<model::MachiningOperation>(ws->its_operation);
      const auto* d = plan.ledger.find(op->its_technology, "feedrate");
      if (d == nullptr || d->binder != model::Binder::kOptimiser) continue;
      const std::string source = plan.ledger.reason(d->reason).source;
      const model::Cutter* c = model::find_cutter(plan, s.cutter_id);
      const bool drills = plan.model.holds<model::DrillingTypeOperation>(ws->its_operation);
      const model::MechanisticSet* set = nullptr;
      for (const auto& m : plan.material.mechanistic) {
        if (set == nullptr && m.substrate == model::to_text(c->substrate)) set = &m;
      }
      if (drills || set == nullptr) {
        EXPECT_NE(source.find("Kienzle's kc1.1 and mc of " + plan.material.id), std::string::npos) << source;
      } else {
        ++milled;
        EXPECT_NE(source.find(set->source), std::string::npos) << source;
        EXPECT_EQ(source.find("Kienzle"), std::string::npos) << source;
      }
    }
  }
  EXPECT_GT(milled, 5U);  // of the bracket's face, pocket, slot and counterbore alone
}

TEST(ReasonsProperty, ALosingChainIsNamedByItsStepsAndItsTimeOrWhyItFails) {
  std::size_t timed = 0;
  for (const model::Plan& plan : plans()) {
    for (const auto& [key, d] : plan.ledger.entries()) {
      if (key.attribute != "its_operation") continue;
      for (const model::Rejected& r : d.rejected) {
        EXPECT_NE(r.what, plan.ledger.reason(d.reason).id);
        EXPECT_EQ(r.why.find("an alternative;"), std::string::npos) << r.why;
        if (r.why.find("the rules prefer the chain taken") == std::string::npos) continue;
        ++timed;
        EXPECT_NE(r.what.find(" ["), std::string::npos) << r.what;
        EXPECT_NE(r.why.find(" s of cutting"), std::string::npos) << r.why;
      }
    }
  }
  EXPECT_GT(timed, 5U);  // each pocket, slot and fit has a second chain
}

optimise::CutQuestion asked() {
  optimise::CutQuestion q;
  for (const model::Cutter& c : shop().library) {
    if (c.cutter_class == model::CutterClass::kEndmill && c.cutting_diameter_mm == 8.0) q.cutter = c;
  }
  for (const auto& m : shop().materials) {
    if (m.id == "wrought_aluminium") q.material = m;
  }
  q.machine = shop().machine;
  q.vc_start_m_min = 200.0;
  q.fz_start_mm = 0.06;
  q.depth_mm = 16.0;
  q.width_mm = 30.0;
  return q;
}

TEST(Efficiency, OfOneIsOptimisedAsOne) {
  // At half of the speed range the curve gives P; a load of 0.9 P is within it where all of it reaches the
  // cut, and above it by 0.9 / 0.8 - 1 = 0.125 where four fifths do.
  auto q = asked();
  constexpr double kRpm = 5000.0, kShare = 0.9;
  q.machine.spindle.curve = {{60.0, 1000.0, 200.0}, {10000.0, 1000.0, 200.0}};
  model::StepLoads loads;
  loads.power_w = kShare * 1000.0;
  q.machine.spindle.efficiency = 0.8;
  EXPECT_NEAR(optimise::worst_excess(q, loads, kRpm), kShare / 0.8 - 1.0, 0.01);
  q.machine.spindle.efficiency = 1.0;
  EXPECT_LT(optimise::worst_excess(q, loads, kRpm), 0.0);
}

TEST(Answers, OfOneNameWithTwoStickOutsAreTwo) {
  Job job;
  const Inputs inputs = shop();
  optimise::Options options;
  options.solver = inputs.solver;
  options.backends = inputs.backends;
  step::KnownCuts known;
  step::Cuts cuts(known, options, job);
  auto q = asked();
  const auto close = cuts.answer(q);
  q.cutter.stick_out_mm *= 2.0;  // bends eight times as much
  const auto far = cuts.answer(q);
  ASSERT_TRUE(close && far);
  EXPECT_LT(far->ap_mm * far->ae_mm * far->feed_mm_min, close->ap_mm * close->ae_mm * close->feed_mm_min);
}

}  // namespace
}  // namespace capstan::pipeline
