#include "casebase/key/normalisation.h"

#include <cmath>

#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

double apart(const Question& a, const Question& b) {
  const Point p = point_of(key_of(a)), q = point_of(key_of(b));
  double sum = 0.0;
  for (std::size_t i = 0; i < kDimensions; ++i) sum += (p[i] - q[i]) * (p[i] - q[i]);
  return std::sqrt(sum);
}

/// Every number stated.
Question full() {
  Question q = sample().asked;
  q.width_mm = 30.0;
  q.tolerance_mm = 0.02;
  q.asked_ra_um = 0.8;
  q.stick_out_mm = 50.0;
  q.hardness_hb = 200.0;
  return q;
}

TEST(Normalisation, MeasuresEachNumberByItsRatio) {
  // What is one apart, by the table of version 2.
  for (const auto change : std::vector<void (*)(Question&)>{
           [](Question& q) { q.diameter_mm *= 2.0; }, [](Question& q) { q.depth_mm *= 2.0; },
           [](Question& q) { q.width_mm *= 2.0; }, [](Question& q) { q.tolerance_mm *= 4.0; },
           [](Question& q) { q.asked_ra_um *= 4.0; }, [](Question& q) { q.cutter_diameter_mm *= 2.0; },
           [](Question& q) { q.teeth *= 2; }, [](Question& q) { q.stick_out_mm *= 2.0; },
           [](Question& q) { q.hardness_hb *= std::sqrt(2.0); }}) {
    Question other = full();
    change(other);
    EXPECT_NEAR(apart(full(), other), 1.0, 1e-12);
  }
}

TEST(Normalisation, HoldsDryAndFloodedApart) {
  Question dry = full();
  dry.coolant = Coolant::kDry;
  EXPECT_EQ(apart(full(), dry), kPrecedentDistance);
}

TEST(Normalisation, KnowsBrinellOfRockwell) {  // rows of ASTM E140, table 1
  EXPECT_EQ(hb_of_hrc(30.0), 286.0);
  EXPECT_EQ(hb_of_hrc(45.0), 421.0);
  EXPECT_DOUBLE_EQ(hb_of_hrc(32.5), 0.5 * (286.0 + 327.0));
  EXPECT_EQ(hb_of_hrc(10.0), 0.0);
  Question hrc = full();
  hrc.hardness_hb = 0.0;
  hrc.hardness_hrc = 30.0;
  Question hb = full();
  hb.hardness_hb = 286.0;
  EXPECT_EQ(key_of(hrc), key_of(hb));
}

TEST(Normalisation, NeverMatchesASizeThatDoesNotApply) {
  for (double Question::*const size : {&Question::diameter_mm, &Question::depth_mm, &Question::width_mm}) {
    Question q = full();
    q.*size = 0.0;
    EXPECT_FALSE(comparison(key_of(q).known, key_of(full()).known).comparable);
    EXPECT_FALSE(comparison(key_of(full()).known, key_of(q).known).comparable);
  }
}

TEST(Normalisation, CountsWhatTheCaseDoesNotKnowAndNotWhatIsNotAsked) {
  Question less = full();
  less.stick_out_mm = 0.0;
  const Comparison asked = comparison(key_of(full()).known, key_of(less).known);
  EXPECT_TRUE(asked.comparable);
  EXPECT_EQ(asked.added2, kUnknownDistance * kUnknownDistance);
  const Comparison not_asked = comparison(key_of(less).known, key_of(full()).known);
  EXPECT_EQ(not_asked.added2, 0.0);
  EXPECT_EQ(not_asked.counted, asked.counted);
}

}  // namespace
}  // namespace capstan::casebase
