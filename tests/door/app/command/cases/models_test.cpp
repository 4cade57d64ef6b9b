#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/retain/join/import.h"
#include "casebase/retain/join/steps.h"
#include "casebase/tune/card.h"
#include "planner/door/pipeline/cases/corrected_card.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/physics/motion/time.h"
#include "tests/casebase/sample.h"
#include "tests/door/app/command/cases/case_models.h"

// What measured cases say of the planner's models, in the next plan: through the whole command.

namespace capstan::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST_F(CaseModels, ForcesThatWereMeasuredReplaceTheCardsAndNarrowTheMargin) {
  const Ran ran = planned_with(cut(6, 0.9));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("[CASE-MODEL]"));
  const model::Plan tuned = plan("tuned.json");
  ASSERT_FALSE(tuned.material.mechanistic.empty());
  EXPECT_THAT(tuned.material.mechanistic.front().source, HasSubstr("on 6 edges"));
  EXPECT_LT(margin_of(tuned), margin_of(plain_));
  const Ran checked = run("check tuned.json");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
  const Ran told = run("explain tuned.json 'POCKET area_rough'");
  EXPECT_THAT(told.out, HasSubstr("cutting force of carbide mills as those of its set: cases say 0.9"));
  // Which cases, and what the plan would be without them: as it was planned without.
  const std::string all = run("explain tuned.json").out;
  EXPECT_THAT(all, HasSubstr("cutting force of carbide mills as those of its set: cases say 0.9"));
  EXPECT_THAT(all, HasSubstr(tuned_case_.substr(0, 12)));
  EXPECT_THAT(all, HasSubstr("time without cases"));
  const auto without = motion::time_of(plain_);
  ASSERT_TRUE(without);
  EXPECT_THAT(all, HasSubstr(motion::duration_text(without->total_s())));
}

TEST_F(CaseModels, ACorrectedCardIsCorrectedOnceHoweverOftenThePlanIsPlannedAnew) {
  ASSERT_EQ(planned_with(cut(6, 0.9)).code, 0);
  ASSERT_EQ(run("plan tuned.json --reopen all --cases base.db -o again.json").code, 0);
  EXPECT_EQ(plan("again.json").material, plan("tuned.json").material);
}

TEST_F(CaseModels, APlanThatIsPlannedAnewWithoutItsCasesHasTheCardsOwnForcesAndSaysSo) {
  ASSERT_EQ(planned_with(cut(6, 0.9)).code, 0);
  const Ran ran = run("plan tuned.json --reopen all -o again.json");
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("forces, margins and lives are the card's own again"));
  EXPECT_EQ(plan("again.json").material, plain_.material);
}

TEST_F(CaseModels, ForcesWithoutTheFeedThatWasExecutedAreNamedAndChangeNothing) {
  auto cases = cut(6, 0.9);
  for (Case& c : cases) c.observed.executed_fz_mm.reset();
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("no case says with which feed its force was measured"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, APlanThatIsCutAsWrittenWithTheForcesExpectedGivesAFactorOfOne) {
  // A schedule that varies: three moves of four slower by three tenths than planning has them.
  model::Plan varied = plain_;
  for (model::StepResult& s : varied.steps) {
    if (!s.schedule) continue;
    auto slower = std::make_shared<model::FeedSchedule>(*s.schedule);
    for (std::size_t i = 0; i < slower->feed_mm_min.size(); ++i)
      if (i % 4 != 0) slower->feed_mm_min[i] *= 0.7;
    s.schedule = slower;
  }
  Job job;
  const auto steps = casebase::retain::steps_of(varied, job);
  std::istringstream log(log_of(varied));
  const auto cases = casebase::retain::import_log(log, casebase::retain::LogFormat::kCsv, steps,
                                                  {.part = "1", .machine = "M1", .file = "log"}, {}, job);
  ASSERT_TRUE(cases) << to_text(cases.error());
  std::vector<Case> milled;
  std::size_t elsewhere = 0;
  for (Case c : *cases) {
    if (!(c.predicted.specific_force_n_mm2 > 0.0)) continue;
    ASSERT_TRUE(c.observed.executed_fz_mm) << c.from.workingstep;
    EXPECT_NEAR(c.observed.executed_fz_mm->value, c.predicted.held_fz_mm, 1e-3 * c.predicted.held_fz_mm)
        << c.from.workingstep;
    EXPECT_TRUE(c.observed.executed_vc_m_min) << c.from.workingstep;
    elsewhere += std::abs(c.predicted.held_fz_mm / c.bound.fz_mm - 1.0) > 0.1 ? 1 : 0;
    c.observed.peak_force_n = casebase::Figure{.value = c.predicted.peak_force_n / c.predicted.force_margin};
    c.from.tool_instance = "E1";
    milled.push_back(c);
  }
  EXPECT_GT(elsewhere, 0U) << "no schedule holds another feed than the step's own: nothing is tested";
  const auto found =
      casebase::tune::card_corrections(milled, plain_.material, [](model::Substrate) { return 1.5; });
  ASSERT_FALSE(found.empty());
  for (const auto& c : found) {
    EXPECT_EQ(c.unfed + c.far, 0U) << c.words();
    EXPECT_NEAR(c.factor, 1.0, 1e-3) << c.words();
  }
}

TEST_F(CaseModels, AStepWhosePathTheFileGaveSaysNotWhatItAimsAt) {
  std::size_t computed = 0;
  for (const Case& c : planned_) computed += c.bound.aimed_over_mm ? 1 : 0;
  EXPECT_GT(computed, 0U);
  model::Plan given = plain_;
  for (const model::StepResult& s : given.steps) {
    const auto* ws = given.model.get<model::MachiningWorkingstep>(s.step);
    if (ws == nullptr) continue;
    if (auto* path = given.ledger.find(ws->its_operation, "its_toolpath"))
      path->binder = model::Binder::kGiven;
  }
  Job job;
  for (const Case& c : casebase::cases_of(given, job))
    EXPECT_FALSE(c.bound.aimed_over_mm) << c.from.workingstep;
}

TEST_F(CaseModels, ATrialWithoutCasesThatFailsIsNamedWithItsReason) {
  ASSERT_EQ(planned_with(cut(6, 0.9)).code, 0);
  model::Plan made = plan("tuned.json");
  const std::size_t rows = made.provenance.size();
  Job job;
  auto base = casebase::CaseBase::open((folder_ / "base.db").string(), job);
  ASSERT_TRUE(base);
  pipeline::Inputs inputs;
  inputs.cases = std::make_shared<const casebase::CaseBase>(*std::move(base));
  inputs.objective = pipeline::Objective::kProfit;  // and no revenue: refused before anything is planned
  pipeline::tell_without_cases(made, plain_, inputs, {}, job);
  ASSERT_EQ(job.diagnostics().size(), 1U);
  EXPECT_EQ(job.diagnostics().front().code, "CASE-WITHOUT");
  EXPECT_EQ(job.diagnostics().front().severity, Severity::kNote);
  EXPECT_THAT(job.diagnostics().front().message, HasSubstr("could not be planned: planning for most profit"));
  EXPECT_EQ(made.provenance.size(), rows);
}

TEST_F(CaseModels, OneToolThatBrokeForbidsToNarrowAndIsNamed) {
  auto cases = cut(6, 0.9);
  cases.front().observed.breakage = casebase::Figure{.value = 1.0};
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("1 case is of a tool that broke or chattered heavily"));
  EXPECT_THAT(ran.err, HasSubstr("nothing is lowered or narrowed where tools broke"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, OneEdgeOfMuchMoreForceForbidsToNarrowAndIsNamed) {
  auto cases = cut(6, 0.9);
  for (Case& c : cases)
    if (c.from.tool_instance == "E3") c.observed.peak_force_n->value *= 2.0;
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("6 cases lie beyond what the others explain"));
  const model::MechanisticSet tuned = plan("tuned.json").material.mechanistic.front(),
                              plain = plain_.material.mechanistic.front();
  EXPECT_GE(tuned.uncertainty, plain.uncertainty);
  EXPECT_GE(tuned.ktc_n_mm2, plain.ktc_n_mm2);
}

TEST_F(CaseModels, LargerForcesRaiseThoseOfThePlan) {
  const Ran ran = planned_with(cut(6, 1.4));
  ASSERT_LE(ran.code, 1) << ran.err;
  const model::Plan tuned = plan("tuned.json");
  ASSERT_FALSE(tuned.material.mechanistic.empty());
  ASSERT_FALSE(plain_.material.mechanistic.empty());
  EXPECT_GT(tuned.material.mechanistic.front().ktc_n_mm2,
            1.3 * plain_.material.mechanistic.front().ktc_n_mm2);
  // A step that they make another says what it would be without.
  ASSERT_EQ(tuned.steps.size(), plain_.steps.size());
  std::string changed;
  for (std::size_t i = 0; i < tuned.steps.size(); ++i) {
    ASSERT_EQ(model::step_id(tuned, tuned.steps[i]), model::step_id(plain_, plain_.steps[i]));
    if (tuned.steps[i].cutting_s != plain_.steps[i].cutting_s)
      changed = model::step_id(tuned, tuned.steps[i]);
  }
  ASSERT_NE(changed, "");
  EXPECT_THAT(run("explain tuned.json '" + changed + "'").out, HasSubstr("not the plan without cases: "));
}

TEST_F(CaseModels, ForcesThatEdgesRaisedStayRaisedWhileARowIsGone) {
  planned_with(cut(3, 1.6));
  const double whole = plan("tuned.json").material.mechanistic.front().ktc_n_mm2;
  const double card = plain_.material.mechanistic.front().ktc_n_mm2;
  ASSERT_GT(whole, 1.4 * card);
  // All rows of the third edge: two are left, which is too few where all is there.
  const std::size_t rows = cut(3, 1.6).size(), one = rows / 3;
  casebase::tamper((folder_ / "base.db").string(),
                   "DELETE FROM capstan_head WHERE number > " + std::to_string(rows - one));
  const Ran ran = run("plan '" + part() + "' --reopen all --cases base.db -o tuned.json");
  ASSERT_LE(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("[CASE-LOST]"));
  EXPECT_NEAR(plan("tuned.json").material.mechanistic.front().ktc_n_mm2, whole, 0.1 * card);
}

TEST_F(CaseModels, ForcesThatCasesLoweredAreTheCardsWhileARowIsGone) {
  planned_with(cut(6, 0.8));
  ASSERT_FALSE(plan("tuned.json").material == plain_.material);
  casebase::tamper((folder_ / "base.db").string(), "DELETE FROM capstan_head WHERE number = 2");
  const Ran ran = run("plan '" + part() + "' --reopen all --cases base.db -o tuned.json");
  ASSERT_LE(ran.code, 1) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("nothing is lowered or narrowed while cases of the base are lost"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, ALifeThatSixEdgesDidNotReachShortensTheCardsAndTwoDoNot) {
  // Half of the card's life; its exponent stays, for one speed says nothing of it.
  put("card.yaml",
      "capstan_materials: 1\nkc_uncertainty: 0.3\nmaterials:\n"
      "  - {id: shop_alloy, source: a test, iso_group: N, kc11_n_mm2: 830, mc: 0.23, vc_hss_m_min: 90,\n"
      "     vc_carbide_m_min: 250,\n"
      "     life: [{substrate: carbide, v0_m_min: 250, life_min: 20, n: 0.3, scatter: 0.2, source: a "
      "test}]}\n");
  const std::string planning = "plan '" + part() + "' --reopen all --material card.yaml ";
  ASSERT_LE(run(planning + "-o card.json").code, 1);
  const model::Plan with_card = plan("card.json");
  ASSERT_EQ(with_card.material.life.size(), 1U);
  const model::ToolLifeLaw law = with_card.material.life.front();
  const auto tuned = [&](int edges, Ran& ran) {
    const std::string base = "base" + std::to_string(edges) + ".db";
    Job job;
    auto db = casebase::CaseBase::open_or_create((folder_ / base).string(), job);
    EXPECT_TRUE(db && db->add(worn(with_card, law, edges, 0.5)));
    ran = run(planning + "--cases " + base + " -o tuned.json");
    EXPECT_LE(ran.code, 1) << ran.err;
    return plan("tuned.json").material.life.at(0);
  };
  Ran two, six;
  EXPECT_EQ(tuned(2, two), law);
  EXPECT_THAT(two.err, HasSubstr("not taken: measured on 2 edges"));
  const model::ToolLifeLaw shorter = tuned(6, six);
  EXPECT_THAT(six.err, HasSubstr("[CASE-MODEL]"));
  EXPECT_NEAR(shorter.life_min / law.life_min, 0.5, 0.1);
  EXPECT_EQ(shorter.n, law.n);
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("life of carbide tools: cases say 0.5"));
  const Ran checked = run("check tuned.json");
  EXPECT_EQ(checked.code, 0) << checked.out << checked.err;
}

TEST_F(CaseModels, TwoEdgesNarrowNothing) {
  const Ran ran = planned_with(cut(2, 0.9));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("not taken: measured on 2 edges"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, AForceTenTimesTooLowIsNamedAndNotTaken) {
  const Ran ran = planned_with(cut(6, 0.1));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("further from the card than 2 standard deviations"));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

TEST_F(CaseModels, TimesOfThreePartsAreToldWithTheirIntervalAndChangeNoPath) {
  Ran ran = planned_with(timed(2, 1.25));
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-TIME")));
  ran = planned_with(timed(4, 1.25));
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, HasSubstr("[CASE-TIME]"));
  EXPECT_THAT(ran.err, HasSubstr("of 4 parts measured on this machine"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("time by cases"));
  // In the last line, too. Steps took 1.25 to 1.28 of their time; the rest of the plan is as planned.
  const std::size_t at = ran.err.rfind(" (by cases ");
  ASSERT_NE(at, std::string::npos) << ran.err;
  double min = 0.0, s = 0.0;
  ASSERT_EQ(std::sscanf(ran.err.c_str() + at, " (by cases %lf min %lf s +- ", &min, &s), 2) << ran.err;
  double steps_s = 0.0;
  for (const Case& c : planned_) steps_s += c.predicted.time_s;
  const double whole_s = motion::time_of(plain_).value().total_s();
  EXPECT_GT(60.0 * min + s, whole_s + 0.23 * steps_s);
  EXPECT_LT(60.0 * min + s, whole_s + 0.30 * steps_s);
  const model::Plan tuned = plan("tuned.json");
  ASSERT_EQ(tuned.steps.size(), plain_.steps.size());
  for (std::size_t i = 0; i < tuned.steps.size(); ++i)
    EXPECT_EQ(tuned.steps[i].cutting_s, plain_.steps[i].cutting_s);
}

TEST_F(CaseModels, TimesOfCutsThatBrokeChatteredOrWereJudgedBadSayNothing) {
  const auto with = [&](void (*change)(casebase::Observed&)) {
    auto cases = timed(4, 1.25);
    for (Case& c : cases) change(c.observed);
    std::filesystem::remove(folder_ / "base.db");
    return planned_with(cases).err;
  };
  for (const auto change : {+[](casebase::Observed& o) { o.breakage = casebase::Figure{.value = 1.0}; },
                            +[](casebase::Observed& o) { o.chatter = casebase::Figure{.value = 1.0}; },
                            +[](casebase::Observed& o) { o.verdict = casebase::Verdict::kBad; }})
    EXPECT_THAT(with(change), Not(HasSubstr("CASE-TIME")));
  EXPECT_THAT(with([](casebase::Observed&) {}), HasSubstr("CASE-TIME"));
}

TEST_F(CaseModels, TimesOfAnotherMachineSayNothing) {
  auto cases = timed(4, 1.25);
  for (Case& c : cases) c.asked.machine_class = "another_machine";
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-TIME")));
}

TEST_F(CaseModels, APlanThatIsPlannedAgainStatesItsTimeOnce) {
  ASSERT_EQ(planned_with(timed(4, 1.25)).code, 0);
  ASSERT_EQ(run("plan tuned.json --reopen all --cases base.db -o again.json").code, 0);
  int stated = 0;
  for (const model::Provenance& p : plan("again.json").provenance) stated += p.what == "time by cases";
  EXPECT_EQ(stated, 1);
}

TEST_F(CaseModels, ABoreThatCasesExpectBeyondItsZoneIsAWarning) {
  const Ran ran = planned_with(bored(2.0));
  EXPECT_THAT(ran.err, HasSubstr("warning: step 'CAP SCREW HOLE"));
  EXPECT_THAT(ran.err, HasSubstr("[CASE-BORE]"));
  EXPECT_THAT(run("explain tuned.json").out, HasSubstr("by cases"));
}

TEST_F(CaseModels, ABoreIsHeldAgainstItsZoneAsDrawn) {
  // A counterbore of 11 H12, 0 to +0.18 mm, in place of 11 +-0.2: its path aims at 11.09.
  std::string text = capstan::testing::slurp(part());
  const std::string wide = "#133=TOLERANCED_LENGTH_MEASURE(11.,#55);";
  ASSERT_NE(text.find(wide), std::string::npos);
  text.replace(text.find(wide), wide.size(),
               "#9001=PLUS_MINUS_VALUE(0.18,0.,3);\n#133=TOLERANCED_LENGTH_MEASURE(11.,#9001);");
  std::ofstream(folder_ / "h12.p21") << text;
  ASSERT_EQ(run("plan h12.p21 -o h12.json").code, 0);
  Job job;
  planned_ = casebase::cases_of(plan("h12.json"), job);
  const auto about = [&](double off_mm) {
    auto cases = bored(off_mm);
    EXPECT_TRUE(cases.front().bound.aimed_over_mm);
    EXPECT_NEAR(cases.front().bound.aimed_over_mm.value_or(casebase::Figure{}).value, 0.09, 1e-12);
    EXPECT_NEAR(cases.front().asked.tolerance_mm, 0.18, 1e-12);
    std::filesystem::remove(folder_ / "base.db");
    auto base = casebase::CaseBase::open_or_create((folder_ / "base.db").string(), job);
    EXPECT_TRUE(base && base->add(cases));
    return run("plan h12.p21 --reopen all --cases base.db -o tuned.json").err;
  };
  // Measured from the nominal size: in the middle of the zone; at the nominal size, where half of the parts
  // are too small; and below it by as much as the middle lies above.
  const std::string middle = about(0.09);
  EXPECT_THAT(middle, HasSubstr("[CASE-BORE]"));
  EXPECT_THAT(middle, HasSubstr("its bore comes out +0.09"));
  EXPECT_THAT(middle, Not(HasSubstr("beyond its zone")));
  EXPECT_THAT(about(0.0), HasSubstr("beyond its zone of +0.000 mm to +0.180 mm"));
  EXPECT_THAT(about(-0.09), HasSubstr("beyond its zone of +0.000 mm to +0.180 mm"));
}

TEST_F(CaseModels, ABoreThatWasJudgedBadForItsSizeIsHeard) {
  auto cases = bored(2.0);
  for (Case& c : cases) c.observed.verdict = casebase::Verdict::kBad;
  EXPECT_THAT(planned_with(cases).err, HasSubstr("[CASE-BORE]"));
}

TEST_F(CaseModels, BoresOfAnotherMaterialToolClassOrCutterSayNothing) {
  for (const int other : {0, 1, 2}) {
    auto cases = bored(2.0);
    for (Case& c : cases) {
      if (other == 0) c.asked.material_group = "K/grey_iron";
      if (other == 1) c.asked.tool_class = "hss/endmill";
      if (other == 2) c.asked.cutter_diameter_mm *= 1.2;
    }
    std::filesystem::remove(folder_ / "base.db");
    EXPECT_THAT(planned_with(cases).err, Not(HasSubstr("CASE-BORE"))) << other;
  }
}

TEST_F(CaseModels, ForcesOfAnotherMachineChangeNothing) {
  auto cases = cut(6, 0.9);
  for (Case& c : cases) c.asked.machine_class = "another_machine";
  const Ran ran = planned_with(cases);
  ASSERT_EQ(ran.code, 0) << ran.err;
  EXPECT_THAT(ran.err, Not(HasSubstr("CASE-MODEL")));
  EXPECT_EQ(plan("tuned.json").material, plain_.material);
}

}  // namespace
}  // namespace capstan::app
