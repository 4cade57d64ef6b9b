#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "casebase/tune/advise.h"
#include "planner/door/service/reading.h"
#include "planner/door/service/tuning/planned_limits.h"
#include "planner/making/optimise/cut.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/physics/mechanics/holding_constants.h"
#include "planner/physics/mechanics/surface.h"
#include "tests/door/app/command/command.h"

// The limits that tuning holds, on steps of the bracket whose limit is near: whatever good parts say, the
// next speed and feed keep it. The loads of what is advised are counted here, not by the function under test.

namespace capstan::app {
namespace {

namespace tune = casebase::tune;

/// Of its limit, where a limit is said to be near: a force at a feed of 4 % more, which the cutter bears,
/// would exceed it.
constexpr double kNear = 0.98;

class CasesTuneLimits : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_EQ(run("plan '" + capstan::testing::source_dir() + "/examples/bracket.p21' -o plan.json").code, 0);
    Job quiet;
    auto plan = service::load_plan((folder_ / "plan.json").string(), quiet);
    ASSERT_TRUE(plan);
    plan_ = *std::move(plan);
  }
  [[nodiscard]] model::StepResult& step(const std::string& name) {
    const auto found = std::find_if(plan_.steps.begin(), plan_.steps.end(),
                                    [&](const auto& s) { return model::step_id(plan_, s) == name; });
    EXPECT_NE(found, plan_.steps.end());
    return *found;
  }
  /// What two dozen good parts advise that were cut as planned at a third of every load watched.
  [[nodiscard]] static tune::Advice advice_of(const tune::PlannedStep& planned) {
    std::vector<tune::Evidence> evidence;
    for (int i = 0; i < 24; ++i) {
      casebase::Case c = planned.step;
      c.origin = casebase::Origin::kMeasured;
      c.observed = {};
      c.observed.time_s = casebase::Figure{.value = planned.step.predicted.time_s};
      c.observed.peak_force_n = casebase::Figure{.value = 0.33 * planned.step.predicted.peak_force_n};
      c.observed.power_w = casebase::Figure{.value = 0.33 * planned.step.predicted.power_w};
      c.observed.size_deviation_mm = casebase::Figure{.value = 0.15 * planned.step.asked.tolerance_mm};
      c.observed.surface_ra_um = casebase::Figure{.value = 0.33 * planned.step.asked.asked_ra_um};
      c.observed.verdict = casebase::Verdict::kGood;
      c.from.tool_instance = "E" + std::to_string(i / 3);
      c.from.part = std::to_string(i);
      c.from.source = "log";
      c.from.time_utc = "2026-03-0" + std::to_string(1 + i / 8) + "T08:00:00Z";
      evidence.push_back(tune::evidence_of(c, planned));
    }
    return tune::advise(evidence, tune::handbook_of(planned), {});
  }
  [[nodiscard]] tune::Advice advice_of(const model::StepResult& step) const {
    const auto planned = service::planned_step(plan_, step);
    EXPECT_TRUE(planned);
    EXPECT_TRUE(planned->hard);
    return advice_of(*planned);
  }
  /// How a load of a straight cut of the step changes from what is planned to what is advised.
  [[nodiscard]] double grown(const model::StepResult& s, const tune::Setting& to,
                             double model::StepLoads::*load) const {
    optimise::CutQuestion q;
    q.cutter = *model::find_cutter(plan_, s.cutter_id);
    q.material = plan_.material;
    q.machine = plan_.machine;
    const auto at = [&](double vc, double fz) {
      const double n = s.spindle_rpm * vc;
      return optimise::loads_of(q, s.axial_depth_mm, s.radial_depth_mm, n, n * q.cutter.teeth * s.fz_mm * fz)
          .value();
    };
    return at(std::exp(to.ln_vc), std::exp(to.ln_fz)).*load / (at(1.0, 1.0).*load);
  }
  model::Plan plan_;
};

TEST_F(CasesTuneLimits, ARoughWhoseForceLimitIsNearKeepsIt) {
  model::StepResult& s = step("POCKET area_rough");
  ASSERT_TRUE(std::none_of(s.active.begin(), s.active.end(), [](const auto& a) {
    return a.name == "peak_force";
  })) << "the force is to be near its limit without binding";
  double& holds = plan_.setups[s.setup].holding.holding_force_n;
  holds = 10.0 * mechanics::kHoldingForceSafety * s.loads.peak_force_n;
  const tune::Advice far = advice_of(s);
  holds = mechanics::kHoldingForceSafety * s.loads.peak_force_n / kNear;
  const tune::Advice near = advice_of(s);
  EXPECT_GT(kNear * grown(s, far.trial.at, &model::StepLoads::peak_force_n), 1.0) << "no limit was tried";
  EXPECT_LE(kNear * grown(s, near.trial.at, &model::StepLoads::peak_force_n), 1.0 + 1e-9);
  EXPECT_LT(near.trial.time, 1.0) << "what loads no more is still taken: the speed";
}

TEST_F(CasesTuneLimits, AFinishWhoseRoughnessLimitIsNearKeepsIt) {
  const model::StepResult& s = step("POCKET area_finish");
  const double ra_um =
      1000.0 * optimise::kRoughnessOverGeometry * mechanics::kArcRaOverRz * s.loads.surface_rz_mm;
  ASSERT_GT(ra_um, 0.0);
  const auto* ws = plan_.model.get<model::MachiningWorkingstep>(s.step);
  model::SurfaceTextureParameter asked;
  asked.parameter_name = "Ra";
  asked.its_value = 10.0 * ra_um;
  asked.applied_to.push_back(ws->its_feature);
  const auto texture = plan_.model.add(asked);
  for (model::Cutter& c : plan_.cutters) {
    if (c.id == s.cutter_id) c.fz_max_mm = 3.0 * s.fz_mm;  // the surface, not the cutter, is to hold the feed
  }
  const tune::Advice far = advice_of(s);
  plan_.model.get<model::SurfaceTextureParameter>(texture)->its_value = ra_um / kNear;
  const tune::Advice near = advice_of(s);
  EXPECT_GT(kNear * grown(s, far.trial.at, &model::StepLoads::surface_rz_mm), 1.0) << "no limit was tried";
  EXPECT_LE(kNear * grown(s, near.trial.at, &model::StepLoads::surface_rz_mm), 1.0 + 1e-9);
}

TEST_F(CasesTuneLimits, NothingIsRaisedWhereThePlanKeepsNoLoads) {
  model::StepResult& s = step("POCKET area_rough");
  s.loads = {};
  const auto planned = service::planned_step(plan_, s);
  ASSERT_TRUE(planned);
  const tune::Advice a = advice_of(*planned);
  EXPECT_LE(a.trial.at.ln_vc, 0.0);
  EXPECT_LE(a.trial.at.ln_fz, 0.0);
}

TEST_F(CasesTuneLimits, TheValuesPlannedAreWithinTheLimitsAndFarBeyondThemNothingIs) {
  int asked = 0;
  for (const model::StepResult& s : plan_.steps) {
    const auto planned = service::planned_step(plan_, s);
    if (!planned || !planned->hard) continue;
    ++asked;
    EXPECT_LE(planned->hard({}), 1.0 + 1e-6) << model::step_id(plan_, s);
    EXPECT_GT(planned->hard({0.0, std::log(2.0)}), 1.0) << model::step_id(plan_, s);
    EXPECT_GT(planned->hard({3.0, 0.0}), 1.0) << model::step_id(plan_, s);
  }
  EXPECT_GE(asked, 6);
}

}  // namespace
}  // namespace capstan::app
