#include "casebase/tune/from_case.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace capstan::casebase::tune {
namespace {

/// A pocket's finish step as planned: 120 m/min, 0.06 mm, proved with 900 N.
PlannedStep planned() {
  PlannedStep p;
  Case& c = p.step;
  c.asked.operation = "BOTTOM_AND_SIDE_FINISH_MILLING";
  c.asked.material_group = "P/mild_steel";
  c.asked.tool_class = "carbide/endmill";
  c.asked.machine_class = "mill";
  c.asked.depth_mm = 12.0;
  c.asked.width_mm = 40.0;
  c.asked.tolerance_mm = 0.1;
  c.asked.asked_ra_um = 3.2;
  c.asked.cutter_diameter_mm = 10.0;
  c.asked.teeth = 4;
  c.bound.vc_m_min = 120.0;
  c.bound.fz_mm = 0.06;
  c.bound.path_length_mm = 1000.0;
  c.bound.mean_chip_mm = 0.03;
  c.bound.aimed_over_mm = Figure{.value = 0.0, .origin = Origin::kSimulated};
  c.bound.path_blocks = 100;
  c.predicted.time_s = 60.0;
  c.predicted.peak_force_n = 900.0;
  c.predicted.power_w = 600.0;
  c.predicted.tool_life_min = 15.0;
  c.from.plan_hash = "abc";
  c.from.workingstep = "POCKET area_finish";
  p.force_margin = 1.8;
  p.power_limit_w = 3000.0;
  return p;
}

Case cut(int part) {
  Case c = planned().step;
  c.id = "id " + std::to_string(part);
  c.origin = Origin::kMeasured;
  c.observed.time_s = Figure{.value = 66.0};
  c.observed.peak_force_n = Figure{.value = 450.0};
  c.observed.surface_ra_um = Figure{.value = 1.6};
  c.observed.size_deviation_mm = Figure{.value = -0.01};
  c.observed.verdict = Verdict::kGood;
  c.from.machine = "7";
  c.from.tool_instance = "T" + std::to_string(part / 3);
  c.from.time_utc = "2016-06-2" + std::to_string(part % 10) + "T08:00:00Z";
  c.from.part = std::to_string(part);
  c.from.source = "log";
  return c;
}

double load(const Evidence& e, Watched w) { return std::exp(*e.ln_load[static_cast<std::size_t>(w)]); }

TEST(HandbookOf, WatchesWhatIsAskedAndKnown) {
  const Handbook h = handbook_of(planned());
  for (std::size_t i = 0; i < kWatchedCount; ++i) EXPECT_TRUE(h.loads[i].watched) << kWatchedNames[i];
  // The limit of the force is what the plan was proved with, its margin included.
  EXPECT_NEAR(std::exp(h.loads[0].ln_load.mean), 1.0 / 1.8, 1e-12);
  PlannedStep bare = planned();
  bare.step.asked.asked_ra_um = 0.0;
  bare.power_limit_w = 0.0;
  EXPECT_FALSE(handbook_of(bare).loads[static_cast<std::size_t>(Watched::kFinish)].watched);
  EXPECT_FALSE(handbook_of(bare).loads[static_cast<std::size_t>(Watched::kPower)].watched);
}

TEST(HandbookOf, ARoughStepIsAskedNeitherSizeNorSurface) {
  PlannedStep rough = planned();
  rough.step.asked.operation = "BOTTOM_AND_SIDE_ROUGH_MILLING";
  const Handbook h = handbook_of(rough);
  EXPECT_FALSE(h.loads[static_cast<std::size_t>(Watched::kSize)].watched);
  EXPECT_FALSE(h.loads[static_cast<std::size_t>(Watched::kFinish)].watched);
  EXPECT_TRUE(h.loads[static_cast<std::size_t>(Watched::kForce)].watched);
}

TEST(EvidenceOf, HoldsFiguresAgainstTheirLimits) {
  const Evidence e = evidence_of(cut(1), planned());
  EXPECT_EQ(e.at, Setting{});
  EXPECT_NEAR(std::exp(*e.ln_time), 1.1, 1e-12);
  EXPECT_NEAR(load(e, Watched::kForce), 0.5, 1e-12);
  EXPECT_NEAR(load(e, Watched::kFinish), 0.5, 1e-12);
  EXPECT_NEAR(load(e, Watched::kSize), 0.2, 1e-12);
  EXPECT_FALSE(e.ln_load[static_cast<std::size_t>(Watched::kWear)]);
  EXPECT_TRUE(e.judged);
  EXPECT_FALSE(e.failed);
  EXPECT_EQ(e.day, day_of("2016-06-21"));
}

TEST(EvidenceOf, ComputedFiguresAreNone) {
  Case c = cut(1);
  c.observed.peak_force_n->origin = Origin::kSimulated;
  EXPECT_FALSE(evidence_of(c, planned()).ln_load[static_cast<std::size_t>(Watched::kForce)]);
}

TEST(EvidenceOf, AFeedIsComparedPerDiameterOfTheCutter) {
  Case c = cut(1);
  c.asked.cutter_diameter_mm = 12.0;
  c.bound.fz_mm = 0.072;
  const Evidence e = evidence_of(c, planned());
  EXPECT_NEAR(e.at.ln_fz, 0.0, 1e-12);
  EXPECT_GT(e.question[5], 0.0);  // the cutter's diameter
}

/// Readings of one edge since it was new: 0.08 mm after two minutes, then t^0.7.
Series worn_edge(double until_min) {
  Series out{.samples = {{0.0, 0.0}}};
  for (double t = 2.0; t <= until_min; t += 1.0)
    out.samples.push_back({60.0 * t, 0.08 * std::pow(t / 2.0, kWearByTime)});
  return out;
}

TEST(HandbookOf, ExpectsTheWearOfAnEdgeThatIsChangedAfterHalfItsLife) {
  const Handbook usual = handbook_of(planned());
  const LoadPrior& wear = usual.loads[static_cast<std::size_t>(Watched::kWear)];
  EXPECT_NEAR(std::exp(wear.ln_load.mean), std::pow(0.5, kWearByTime), 1e-12);
  EXPECT_TRUE(wear.needs_evidence);
  PlannedStep longer = planned();
  longer.edge_min = 15.0;  // all of the life that is expected
  const Handbook stated = handbook_of(longer);
  EXPECT_NEAR(stated.loads[static_cast<std::size_t>(Watched::kWear)].ln_load.mean, 0.0, 1e-12);
  EXPECT_FALSE(stated.loads[static_cast<std::size_t>(Watched::kWear)].needs_evidence);
}

TEST(EvidenceOf, CarriesWearToTheChangeOfTheEdgeByTheLawOfTheHandbook) {
  PlannedStep p = planned();
  p.edge_min = 10.0;
  Case c = cut(1);
  c.observed.wear_series_mm = worn_edge(4.0);
  c.observed.wear_mm = Figure{.value = c.observed.wear_series_mm.samples.back().value};
  const double at_change = 0.08 * std::pow(10.0 / 2.0, kWearByTime);
  EXPECT_NEAR(load(evidence_of(c, p), Watched::kWear), at_change / kWornMm, 1e-3);
  // The same edge a few parts later says the same.
  c.observed.wear_series_mm = worn_edge(8.0);
  EXPECT_NEAR(load(evidence_of(c, p), Watched::kWear), at_change / kWornMm, 1e-3);
  // As many parts at twice the feed are half the time in the cut.
  c.bound.fz_mm *= 2.0;
  EXPECT_NEAR(load(evidence_of(c, p), Watched::kWear), 0.08 * std::pow(5.0 / 2.0, kWearByTime) / kWornMm,
              1e-3);
}

TEST(EvidenceOf, WearOfUnknownAgeCountsOnlyBeyondWhatIsAllowed) {
  Case c = cut(1);
  c.observed.wear_mm = Figure{.value = 0.1};
  EXPECT_FALSE(evidence_of(c, planned()).ln_load[static_cast<std::size_t>(Watched::kWear)]);
  c.observed.wear_mm = Figure{.value = 0.36};
  EXPECT_NEAR(load(evidence_of(c, planned()), Watched::kWear), 1.2, 1e-12);
  // A series that begins worn has the step's clock, not the edge's.
  c.observed.wear_mm.reset();
  c.observed.wear_series_mm = {.samples = {{0.0, 0.1}, {60.0, 0.12}}};
  EXPECT_FALSE(evidence_of(c, planned()).ln_load[static_cast<std::size_t>(Watched::kWear)]);
}

// Its loads are the largest there; those that are asked about are of an edge that is changed after the cut.
TEST(EvidenceOf, AnEdgeIsAsWornAsItIsAtTheEndOfTheCut) {
  Case c = cut(1);  // 66 s
  EXPECT_EQ(evidence_of(c, planned()).worn, 0.0);
  c.observed.wear_series_mm = {.samples = {{0.0, 0.0}, {66.0, 0.06}}};
  EXPECT_NEAR(evidence_of(c, planned()).worn, 0.06 / kWornMm, 1e-12) << "its first part";
  c.observed.wear_series_mm.samples.push_back({132.0, 0.09});
  EXPECT_NEAR(evidence_of(c, planned()).worn, 0.09 / kWornMm, 1e-12);
}

TEST(Advise, AnEdgeOfOnePartIsNoMoreWornAtItsChangeThanThatPartLeftIt) {
  // Each part on an edge of its own, which is changed after it: what was seen is what is to be expected.
  PlannedStep p = planned();
  p.edge_min = 1.1;  // 66 s
  std::vector<Evidence> evidence;
  for (int part = 1; part <= 12; ++part) {
    Case c = cut(part);
    c.observed.wear_series_mm = {.samples = {{0.0, 0.0}, {66.0, 0.15}}};
    c.from.tool_instance = "E" + std::to_string(part);
    evidence.push_back(evidence_of(c, p));
  }
  const Advice a = advise(evidence, handbook_of(p), {});
  for (const LimitView& l : a.handbook.limits) {
    if (l.name == kWatchedNames[static_cast<std::size_t>(Watched::kForce)]) {
      EXPECT_NEAR(l.load / load(evidence.front(), Watched::kForce), 1.0, 0.05);
    }
  }
}

TEST(EvidenceOf, NamesItsSourceInOneLine) {
  EXPECT_EQ(evidence_of(cut(1), planned()).source.find('\n'), std::string::npos);
}

TEST(Advise, AWearThatNobodyMeasuredIsNotWatched) {
  const Handbook handbook = handbook_of(planned());
  std::vector<Evidence> evidence = {evidence_of(cut(1), planned())};
  const auto watches = [&] {
    const Advice a = advise(evidence, handbook, {});
    return std::any_of(a.trial.limits.begin(), a.trial.limits.end(),
                       [](const LimitView& l) { return l.name == "wear of the edge"; });
  };
  EXPECT_FALSE(watches());
  Case measured = cut(2);
  measured.observed.wear_series_mm = worn_edge(4.0);
  evidence.push_back(evidence_of(measured, planned()));
  EXPECT_TRUE(watches());
}

TEST(EvidenceOf, BreakageAndBadVerdictsAreFailures) {
  Case broken = cut(1), bad = cut(2);
  broken.observed.breakage = Figure{.value = 1.0};
  bad.observed.verdict = Verdict::kBad;
  EXPECT_TRUE(evidence_of(broken, planned()).failed);
  EXPECT_TRUE(evidence_of(bad, planned()).failed);
}

TEST(DayOf, ReadsDatesAndNothingElse) {
  EXPECT_EQ(day_of("1970-01-02"), 1);
  EXPECT_EQ(day_of("2016-06-28T17:32:31Z"), 16980);
  EXPECT_FALSE(day_of("2016-02-30"));
  EXPECT_FALSE(day_of("yesterday"));
  EXPECT_FALSE(day_of(""));
}

TEST(CorrectionsOf, MeasuredCasesAlone) {
  const CorrectionHandbook handbook{.force = {1800.0, 0.2, 1.5}, .force_margin = 1.8, .life = {}};
  std::vector<Case> cases;
  for (int i = 0; i < 9; ++i) cases.push_back(cut(i));
  const Corrections c = corrections_of(cases, handbook);
  ASSERT_TRUE(c.force);
  EXPECT_EQ(c.force->how.groups, 3U);
  // 450 N were observed where 900 / 1.8 were expected.
  EXPECT_NEAR(c.force->kc11_n_mm2 * std::pow(0.03, -c.force->mc) / (1800.0 * std::pow(0.03, -0.2)), 0.9,
              0.02);
  ASSERT_TRUE(c.time);
  EXPECT_NEAR(c.time->factor(0.6), 1.1, 0.02);
  EXPECT_FALSE(c.life);
  for (Case& one : cases) one.origin = Origin::kSimulated;
  EXPECT_FALSE(corrections_of(cases, handbook).force);
}

TEST(CorrectionsOf, LivesOfOtherMaterialsTellExponentsAlone) {
  const CorrectionHandbook handbook{.force = {1800.0, 0.2, 1.5},
                                    .force_margin = 1.8,
                                    .life = {.substrate = "carbide",
                                             .v0_m_min = cut(1).bound.vc_m_min,
                                             .life_min = 15.0,
                                             .n = 0.25,
                                             .source = {}}};
  // An edge that is worn by 0.3 mm after a time, as VB ~ t^0.7.
  const auto edge = [](int number, const char* material, double depth_mm, double life_min) {
    Case c = cut(number);
    c.asked.material_group = material;
    c.bound.ap_mm = depth_mm;
    c.from.tool_instance = material + std::to_string(number);
    for (const double share : {0.3, 0.6, 1.0})
      c.observed.wear_series_mm.samples.push_back({60.0 * life_min * share, 0.3001 * std::pow(share, 0.7)});
    return c;
  };
  const std::vector<Case> own = {edge(1, "P/steel", 1.0, 15.0)};
  std::vector<Case> others;
  for (int i = 0; i < 4; ++i) others.push_back(edge(i, "K/iron", i % 2 + 1.0, 60.0 / (i % 2 + 1.0)));
  ASSERT_TRUE(corrections_of(own, handbook).life);
  EXPECT_EQ(corrections_of(own, handbook).life->law.q, 0.0);
  const Corrections c = corrections_of(own, handbook, others);
  ASSERT_TRUE(c.life);
  EXPECT_NEAR(1.0 / c.life->law.q, 1.0, 0.2);
  EXPECT_NEAR(c.life->law.life_min, 15.0, 0.5);
  EXPECT_EQ(c.life->how.cases, 1U);
}

TEST(CorrectionsOf, BoresThatAreMilledAloneByPart) {
  const CorrectionHandbook handbook{.force = {1800.0, 0.2, 1.5}, .force_margin = 1.8, .life = {}};
  const auto bores = [&](const char* operation, const char* feature) {
    std::vector<Case> cases;
    for (int i = 0; i < 8; ++i) {
      Case c = cut(i / 2);  // two of each part, on one edge
      c.asked.operation = operation;
      c.asked.feature = feature;
      c.asked.width_mm = 0.0;
      c.asked.diameter_mm = 20.0;
      c.asked.stick_out_mm = 40.0;
      c.from.tool_instance = "T1";
      cases.push_back(c);
    }
    return corrections_of(cases, handbook).bores;
  };
  const auto milled = bores("BOTTOM_AND_SIDE_FINISH_MILLING", "ROUND_HOLE");
  ASSERT_EQ(milled.size(), 1U);
  EXPECT_EQ(milled.at(10.0).how.groups, 4U);
  EXPECT_TRUE(bores("REAMING", "ROUND_HOLE").empty());
  EXPECT_TRUE(bores("DRILLING", "ROUND_HOLE").empty());
  EXPECT_TRUE(bores("SIDE_FINISH_MILLING", "DEFINED_THREAD").empty());
}

/// A bore that was milled on a part, 0.02 mm too wide, in 75 s instead of 60.
Case milled_bore(const std::string& part) {
  Case c = planned().step;
  c.origin = Origin::kMeasured;
  c.asked.width_mm = 0.0;
  c.asked.diameter_mm = 20.0;
  c.asked.stick_out_mm = 40.0;
  c.observed.time_s = Figure{.value = 75.0};
  c.observed.size_deviation_mm = Figure{.value = 0.02};
  c.from.part = part;
  c.from.source = "log";
  return c;
}

TEST(SamplesOfCases, LeaveOutTimesAndBoresOfToolsThatBrokeOrChattered) {
  const auto heard = [](const Observed& o) {
    Case c = milled_bore("1");
    c.observed = o;
    const std::vector<Case> cases = {c};
    return std::pair(times_of(cases).size(), bores_of(cases).size());
  };
  const Observed well = milled_bore("1").observed;
  EXPECT_EQ(heard(well), std::pair(1UL, 1UL));
  Observed o = well;
  o.breakage = Figure{.value = 1.0};
  EXPECT_EQ(heard(o), std::pair(0UL, 0UL));
  o = well;
  o.chatter = Figure{.value = 0.8};
  EXPECT_EQ(heard(o), std::pair(0UL, 0UL));
  o.chatter = Figure{.value = 0.2};  // light
  EXPECT_EQ(heard(o), std::pair(1UL, 1UL));
  o = well;
  o.verdict = Verdict::kBad;  // for its size, perhaps: the size is heard
  EXPECT_EQ(heard(o), std::pair(0UL, 1UL));
}

TEST(SamplesOfCases, OfBoresAreWhatThePathMissedOfTheSizeThatItAimedAt) {
  // 20 H7, aimed at 20.0105: 0.02 mm over the nominal size is 0.0095 over what was programmed.
  Case c = milled_bore("1");
  c.bound.aimed_over_mm->value = 0.0105;
  const std::vector<Case> cases = {c};
  ASSERT_EQ(bores_of(cases).size(), 1U);
  EXPECT_NEAR(bores_of(cases).front().deviation_mm, 0.0095, 1e-12);
}

TEST(SamplesOfCases, LeaveOutSizesOfPathsOfWhichNobodySaysWhatTheyAimAt) {
  Case c = milled_bore("1");
  c.bound.aimed_over_mm.reset();
  EXPECT_TRUE(bores_of(std::vector<Case>{c}).empty());
  Case pocket = cut(1);
  pocket.bound.aimed_over_mm.reset();
  EXPECT_FALSE(evidence_of(pocket, planned()).ln_load[static_cast<std::size_t>(Watched::kSize)]);
}

TEST(SamplesOfCases, OfBoresAreFittedCutterByCutter) {
  // One cutter makes bores 0.02 mm too small, the other 0.03 mm too large.
  std::vector<Case> cases;
  for (int part = 0; part < 6; ++part) {
    Case c = milled_bore(std::to_string(part));
    c.asked.cutter_diameter_mm = part % 2 == 0 ? 10.0 : 3.175;
    c.asked.stick_out_mm = 3.0 * c.asked.cutter_diameter_mm;
    c.observed.size_deviation_mm = Figure{.value = part % 2 == 0 ? -0.02 : 0.03};
    cases.push_back(c);
  }
  cases[3].asked.cutter_diameter_mm = 3.2;  // the next regrind of the same
  const Corrections made = corrections_of(cases, {});
  ASSERT_EQ(made.bores.size(), 2U);
  const double feed_mm = cases.front().bound.fz_mm * cases.front().asked.teeth;
  EXPECT_NEAR(made.bores.at(10.0).deviation_mm(feed_mm, 3.0), -0.02, 0.002);
  EXPECT_NEAR(made.bores.at(3.175).deviation_mm(feed_mm, 3.0), 0.03, 0.002);
  EXPECT_EQ(made.bores.at(3.175).how.cases, 3U);
  EXPECT_EQ(made.bores.at(3.175).how.model, "size of bores by a cutter of 3.175 mm");
}

TEST(EvidenceOf, HoldsASizeAgainstItsZoneAsDrawn) {
  // A zone of 0.1 mm on one side of the nominal size: its middle is no deviation, its edge is all of the
  // limit.
  Case c = cut(1);
  c.bound.aimed_over_mm->value = 0.05;
  c.observed.size_deviation_mm = Figure{.value = 0.05};
  EXPECT_LE(load(evidence_of(c, planned()), Watched::kSize), 0.02 + 1e-12);
  c.observed.size_deviation_mm = Figure{.value = 0.0};
  EXPECT_NEAR(load(evidence_of(c, planned()), Watched::kSize), 1.0, 1e-12);
}

}  // namespace
}  // namespace capstan::casebase::tune
