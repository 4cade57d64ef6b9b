#include "casebase/recall/recall.h"
#include "casebase/casebase.h"

#include <thread>

#include "casebase/index/index.h"
#include "casebase/key/normalisation.h"
#include "casebase/planned.h"
#include "casebase/record/sha256.h"
#include "planner/model/nouns/all.h"
#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

class Recall : public testing::Test {
 protected:
  void keep(std::vector<Case> cases) { ASSERT_TRUE(base_.add(cases).has_value()); }
  /// What the base says where nothing else says where to start.
  [[nodiscard]] Advice advised(const Question& q) const {
    return advise(evidence_near(base_, q).value(), {});
  }
  Folder folder_;
  Job job_;
  CaseBase base_ = CaseBase::open_or_create(folder_.file(), job_).value();
};

TEST(Sha256, MatchesThePublishedExamples) {  // FIPS 180-2, appendix B.1 and B.2
  EXPECT_EQ(sha256("abc"), "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  EXPECT_EQ(sha256("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq"),
            "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  EXPECT_EQ(sha256(""), "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
}

TEST_F(Recall, GivesNothingFromAnEmptyBase) {
  EXPECT_EQ(base_.size(), 0u);
  EXPECT_TRUE(base_.nearest(sample().asked, 3)->empty());
  const Advice a = advised(sample().asked);
  EXPECT_FALSE(a.any());
  EXPECT_FALSE(a.why.empty());
}

TEST_F(Recall, GivesTheCaseWithItsDistanceAndOrigin) {
  keep({sample(10.0, 30.0)});
  Question q = sample().asked;
  q.diameter_mm = 12.0;
  const Advice a = advised(q);
  ASSERT_TRUE(a.leads);
  EXPECT_NEAR(a.nearest, std::log2(1.2), 1e-12);
  EXPECT_EQ(a.origin, Origin::kMeasured);
  EXPECT_EQ(a.good, 1);
  EXPECT_EQ(a.start.vc_m_min, 30.0);
  EXPECT_EQ(a.start.fz_mm, 0.1);
  ASSERT_EQ(a.cases.size(), 1u);
  EXPECT_EQ(a.cases.front().id, sample(10.0, 30.0).id);
}

TEST_F(Recall, GivesNothingPastTheThreshold) {
  keep({sample(10.0)});
  Question q = sample().asked;
  q.diameter_mm = 14.0;  // log2(1.4) = 0.485
  EXPECT_TRUE(advised(q).leads);
  q.diameter_mm = 14.3;  // log2(1.43) = 0.516
  EXPECT_FALSE(advised(q).any());
  EXPECT_EQ(base_.nearest(q, 1)->size(), 1u);
}

TEST_F(Recall, TakesNoPrecedentOfAnotherCutter) {
  // The same pocket, by a mill of twice the diameter, of twice the teeth, or standing out twice as far.
  Case c = sample();
  c.asked.stick_out_mm = 40.0;
  keep({c});
  for (const auto change : std::vector<void (*)(Question&)>{[](Question& q) { q.cutter_diameter_mm *= 2.0; },
                                                            [](Question& q) { q.teeth *= 2; },
                                                            [](Question& q) { q.stick_out_mm *= 2.0; }}) {
    Question q = c.asked;
    EXPECT_TRUE(advised(q).leads);
    change(q);
    EXPECT_FALSE(advised(q).any());
    EXPECT_NEAR(base_.nearest(q, 1)->front().distance, 1.0, 1e-12);
  }
}

TEST_F(Recall, FindsWhatWasAddedSinceTheIndexWasMade) {
  keep({sample(10.0)});
  EXPECT_EQ(base_.nearest(sample().asked, 9)->size(), 1u);
  for (int i = 1; i <= 700; ++i) {  // beyond the tail that is looked at one by one
    keep({sample(10.0, 30.0, "part " + std::to_string(i + 1))});
    if (i % 100 != 0) continue;
    EXPECT_EQ(base_.nearest(sample().asked, 2000)->size(), static_cast<std::size_t>(i) + 1);
  }
}

TEST_F(Recall, AnswersManyThreadsAlike) {
  keep(random_cases(300, 13));
  std::vector<std::vector<Neighbour>> answers(4);
  std::vector<std::thread> threads;
  for (auto& mine : answers) {
    threads.emplace_back([&] {
      for (const Case& asked : random_cases(30, 14)) {
        const auto near = base_.nearest(asked.asked, 5).value();
        mine.insert(mine.end(), near.begin(), near.end());
        for (const Neighbour& n : near) mine.push_back({base_.get(n.found.id).value(), n.distance});
      }
    });
  }
  for (std::thread& t : threads) t.join();
  EXPECT_FALSE(answers.front().empty());
  for (const auto& other : answers) EXPECT_EQ(other, answers.front());
}

TEST_F(Recall, TakesTheFeedOfALargerCutterByItsDiameter) {
  keep({sample(10.0, 30.0)});
  const auto of = [&](double diameter_mm) {
    Question q = sample().asked;
    q.cutter_diameter_mm = diameter_mm;
    return evidence_near(base_, q)->front().cut.fz_mm;
  };
  EXPECT_DOUBLE_EQ(of(8.0), 0.08);
  EXPECT_DOUBLE_EQ(of(10.0), 0.1);
  EXPECT_DOUBLE_EQ(of(12.0), 0.1);
}

TEST_F(Recall, SeesPastAThousandCopiesOfOneCase) {
  std::vector<Case> all;
  for (int i = 0; i < 1000; ++i) {
    all.push_back(sample(10.0, 45.0, "pasted"));
    all.back().observed.time_s = Figure{6.5 + 1e-6 * i};
  }
  all.push_back(sample(10.5, 30.0, "part 1"));
  all.push_back(sample(10.6, 30.0, "part 2"));
  all[1001].observed.time_s = Figure{6.7};
  keep(all);
  const Advice a = advised(sample().asked);
  EXPECT_EQ(a.good, 3);
  EXPECT_EQ(a.start.vc_m_min, 30.0);
}

TEST_F(Recall, PartsWithOneLoggedTimeAreAsManyCuts) {
  std::vector<Case> all;
  for (int i = 0; i < 12; ++i) {
    all.push_back(sample());
    all.back().from.part = "part " + std::to_string(i);
    all.back().observed.time_s = Figure{6.0};  // in whole seconds
  }
  keep(all);
  EXPECT_EQ(advised(sample().asked).good, 12);
}

TEST_F(Recall, CopiesWithThreeEqualFiguresAreOneCutWhateverTheirParts) {
  std::vector<Case> all;
  for (int i = 0; i < 12; ++i) {
    all.push_back(sample());
    all.back().from.part = "part " + std::to_string(i);
    all.back().observed.peak_force_n = Figure{312.7};
    all.back().observed.power_w = Figure{418.2};
  }
  keep(all);
  EXPECT_EQ(advised(sample().asked).good, 1);
}

TEST_F(Recall, ComputedFiguresMakeNoTwoCutsOne) {
  std::vector<Case> all;
  for (int i = 0; i < 4; ++i) {
    all.push_back(sample());
    all.back().from.part = "part " + std::to_string(i);
    for (auto* f :
         {&all.back().observed.peak_force_n, &all.back().observed.power_w, &all.back().observed.torque_nm})
      *f = Figure{312.7, 0.0, Origin::kSimulated};
  }
  keep(all);
  EXPECT_EQ(advised(sample().asked).good, 4);
}

TEST_F(Recall, MatchesEveryCategoryExactly) {
  keep({sample()});
  for (std::string Question::*const category :
       {&Question::operation, &Question::material_group, &Question::tool_class, &Question::machine_class}) {
    Question q = sample().asked;
    q.*category += "x";
    EXPECT_FALSE(advised(q).any());
    EXPECT_TRUE(base_.nearest(q, 5)->empty());
  }
}

TEST_F(Recall, FindsWhatLookingAtEveryCaseFinds) {
  std::vector<Case> all = random_cases(500, 11), questions = random_cases(50, 12);
  // Twenty cuts of one question tie: it is asked as well, and the seven of the least ids are found.
  for (int part = 0; part < 20; ++part) {
    Case c = all[static_cast<std::size_t>(part % 2)];
    c.from.part = "repeat " + std::to_string(part);
    c.id = id_of(c);
    all.push_back(c);
  }
  questions.push_back(all[0]);
  questions.push_back(all[1]);
  keep(all);
  for (const Case& asked : questions) {
    std::vector<std::pair<double, std::string>> expected;
    const Key key = key_of(asked.asked);
    const Point at = point_of(key);
    for (const Case& c : base_.cases()) {
      if (categories_of(c.asked) != categories_of(asked.asked)) continue;
      const Comparison how = comparison(key.known, key_of(c.asked).known);
      if (!how.comparable) continue;
      const Point p = point_of(key_of(c.asked));
      double sum = how.added2;
      Point weight{};
      for (std::size_t i = 0; i < kDimensions; ++i) weight[i] = (how.counted >> i & 1U) != 0 ? 1.0 : 0.0;
      sum += distance2(at.data(), p.data(), weight.data(), kDimensions);
      expected.emplace_back(std::sqrt(sum), c.id);
    }
    std::sort(expected.begin(), expected.end());
    expected.resize(std::min<std::size_t>(expected.size(), 7));
    std::vector<std::pair<double, std::string>> found;
    const auto neighbours = base_.nearest(asked.asked, 7);
    ASSERT_TRUE(neighbours.has_value());
    for (const Neighbour& n : *neighbours) found.emplace_back(n.distance, n.found.id);
    EXPECT_EQ(found, expected);
  }
}

TEST_F(Recall, RefusesAQuestionThatCannotBe) {
  Question q = sample().asked;
  q.depth_mm = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(base_.nearest(q, 1).error().code, "CASE-INVALID");
  EXPECT_EQ(evidence_near(base_, q).error().code, "CASE-INVALID");
  q.depth_mm = -1.0;
  EXPECT_EQ(base_.nearest(q, 1).error().code, "CASE-INVALID");
}

TEST(Csv, SaysWhichLineIsWrong) {
  std::string text = to_csv(std::vector<Case>{sample(10.0), sample(11.0)});
  std::string altered = text;
  altered.replace(altered.rfind(",30,"), 4, ",31,");
  auto read = from_csv(altered, "cases.csv");
  ASSERT_FALSE(read.has_value());
  EXPECT_EQ(read.error().line, 3u);
  EXPECT_EQ(read.error().code, "CASE-CSV");
  altered = text;
  altered.replace(altered.rfind(",30,"), 4, ",30;");
  EXPECT_EQ(from_csv(altered, "cases.csv").error().line, 3u);
  EXPECT_FALSE(from_csv(altered, "cases.csv").error().expected.empty());
  EXPECT_FALSE(from_csv(altered, "cases.csv").error().hint.empty());
  EXPECT_FALSE(from_csv("", "cases.csv").has_value());
  EXPECT_FALSE(from_csv("id,operation\n", "cases.csv").has_value());
  EXPECT_FALSE(from_csv("\"", "cases.csv").has_value());
}

/// A plan of one drilled hole.
struct Planned {
  model::Plan plan;
  Planned() {
    model::TolerancedLengthMeasure size;
    size.theoretical_size = 10.0;
    model::RoundHole hole;
    hole.its_id = "HOLE";
    hole.diameter = plan.model.add(size);
    const auto feature = plan.model.add(hole);
    const auto operation = plan.model.add(model::Drilling{});
    model::MachiningWorkingstep ws;
    ws.its_id = "WS DRILL";
    ws.its_feature = feature;
    ws.its_operation = operation;
    plan.file_name = "part.stp";
    plan.machine.id = "generic_vmc";
    plan.material.id = "mild_steel";
    plan.material.iso_group = "P";
    model::Cutter drill;
    drill.id = "D10";
    drill.cutter_class = model::CutterClass::kTwistDrill;
    drill.substrate = model::Substrate::kHss;
    drill.cutting_diameter_mm = 10.0;
    drill.teeth = 2;
    plan.cutters = {drill};
    model::StepResult step;
    step.step = plan.model.add(ws);
    step.cutter_id = "D10";
    step.vc_m_min = 30.0;
    step.fz_mm = 0.1;
    step.cutting_s = 6.0;
    step.rapid_s = 0.5;
    step.flood = true;
    plan.steps = {step};
  }
};

TEST(Retain, MakesASimulatedCaseThatTheSameQuestionFinds) {
  const Planned p;
  const Sizes sizes{.diameter_mm = 10.0, .depth_mm = 20.0};
  const auto c = case_of(p.plan, p.plan.steps[0], sizes);
  ASSERT_TRUE(c.has_value()) << to_text(c.error());
  EXPECT_EQ(c->origin, Origin::kSimulated);
  EXPECT_EQ(c->observed.verdict, Verdict::kUnknown);
  EXPECT_EQ(c->from.source, "plan part.stp step WS DRILL");
  EXPECT_EQ(c->observed.time_s, (Figure{6.5, 0.0, Origin::kSimulated}));
  Question expected =
      question_of(model::TypeId::kDrilling, p.plan.material, p.plan.cutters[0], p.plan.machine, sizes);
  expected.coolant = Coolant::kFlood;
  expected.feature = "ROUND_HOLE";
  EXPECT_EQ(c->asked, expected);
  EXPECT_EQ(c->asked.cutter_diameter_mm, 10.0);

  const Folder folder;
  Job job;
  auto base = CaseBase::open_or_create(folder.file(), job).value();
  ASSERT_TRUE(base.add(*c).has_value());
  EXPECT_EQ(evidence_near(base, c->asked)->front().id, c->id);
}

TEST(Retain, AsksWithTheCoolantThatItKeeps) {
  const Planned p;
  const Sizes sizes{.diameter_mm = 10.0, .depth_mm = 20.0};
  const auto c = case_of(p.plan, p.plan.steps[0], sizes);
  ASSERT_TRUE(c.has_value()) << to_text(c.error());
  const auto& ws = *p.plan.model.get<model::MachiningWorkingstep>(p.plan.steps[0].step);
  const auto asked = [&](Coolant coolant) {
    return question_of(p.plan, {ws.its_operation.type, ws.its_feature, coolant}, p.plan.cutters[0], sizes);
  };
  EXPECT_EQ(asked(coolant_of(p.plan.steps[0])), c->asked);
  const Folder folder;
  Job job;
  auto base = CaseBase::open_or_create(folder.file(), job).value();
  ASSERT_TRUE(base.add(*c).has_value());
  EXPECT_EQ(base.nearest(asked(Coolant::kFlood), 1)->front().distance, 0.0);
  EXPECT_GT(base.nearest(asked(Coolant::kDry), 1)->front().distance, 0.0);
}

TEST(Retain, RefusesAStepWithoutACutter) {
  Planned p;
  p.plan.cutters.clear();
  EXPECT_EQ(case_of(p.plan, p.plan.steps[0], Sizes{}).error().code, "CASE-STEP");
}

TEST(Retain, RefusesAFeatureWhoseShapeIsUnknown) {
  const Planned p;  // the hole has no depth
  EXPECT_EQ(case_of(p.plan, p.plan.steps[0]).error().code, "CASE-STEP");
}

TEST(Retain, TakesTheSizesOfTheShape) {
  model::FeatureShape hole;
  hole.kind = model::ShapeKind::kHole;
  hole.depth_mm = 20.0;
  hole.diameter = {.nominal_mm = 10.0, .lower_mm = -0.005, .upper_mm = 0.01, .given = true};
  const Sizes s = sizes_of(hole);
  EXPECT_EQ(s.diameter_mm, 10.0);
  EXPECT_EQ(s.depth_mm, 20.0);
  EXPECT_EQ(s.width_mm, 0.0);
  EXPECT_DOUBLE_EQ(s.tolerance_mm, 0.015);
}

}  // namespace
}  // namespace capstan::casebase
