#include <random>

#include "casebase/recall/recall.h"
#include "tests/casebase/sample.h"
#include "tests/support/soak.h"

// A shop whose cuts follow a law, and whose records are wrong in one case of ten.

namespace capstan::casebase {
namespace {

class Shop {
 public:
  explicit Shop(unsigned seed) : random_(seed) {}

  /// A drilled hole of 3 to 20 mm, 1 to 5 diameters deep.
  Question question() {
    Question q = sample().asked;
    q.diameter_mm = q.cutter_diameter_mm = 3.0 * std::pow(20.0 / 3.0, share());
    q.depth_mm = q.diameter_mm * std::pow(5.0, share());
    q.tolerance_mm = 0.01 * std::pow(20.0, share());
    return q;
  }

  /// What cuts well: speed falls with the depth in diameters, feed rises with the diameter.
  static Values law(const Question& q) {
    const double depth = q.depth_mm / q.diameter_mm;
    return {.vc_m_min = 100.0 * std::pow(q.diameter_mm / 10.0, 0.15) * std::pow(depth, -0.1),
            .fz_mm = 0.011 * q.diameter_mm * std::pow(depth, -0.15)};
  }

  /// A cut about the law: harder than 1.35 times it, it fails. Every tenth is wrong: half of these have the
  /// other verdict, half were cut, or written down, by up to ten times off.
  Case cut(std::size_t number) {
    constexpr double kFails = 1.35, kWrong = 0.1;
    Case c = sample();
    c.asked = question();
    c.from.source = "part " + std::to_string(number);
    c.observed.time_s.reset();
    double speed = std::exp(0.1 * normal_(random_)), feed = std::exp(0.1 * normal_(random_));
    if (share() < 0.15) {
      speed *= 1.4;
      feed *= 1.4;
    }
    bool bad = std::max(speed, feed) > kFails;
    const double wrong = share();
    if (wrong < 0.5 * kWrong) {
      bad = !bad;
    } else if (wrong < kWrong) {
      speed *= std::pow(10.0, 2.0 * share() - 1.0);
      feed *= std::pow(10.0, 2.0 * share() - 1.0);
      bad = share() < 0.5;
    }
    c.bound.vc_m_min = speed * law(c.asked).vc_m_min;
    c.bound.fz_mm = feed * law(c.asked).fz_mm;
    c.observed.verdict = bad ? Verdict::kBad : Verdict::kGood;
    return c;
  }

  double share() { return share_(random_); }

 private:
  std::mt19937 random_;
  std::uniform_real_distribution<double> share_{0.0, 1.0};
  std::normal_distribution<double> normal_{0.0, 1.0};
};

// The issue asks for 95 % of queries and a tenth at 1e5 cases; a sixth of them are measured here, and all in
// soak.
TEST(RecallPropertyOfNoise, OneWrongCaseInTenLeavesPrecedentsAndTheirSpeed) {
  const std::size_t cases = soaking() ? 100'000 : 16'000;
  constexpr int kQueries = 400;
  Shop shop(static_cast<unsigned>(testing::UnitTest::GetInstance()->random_seed()) + 3U);
  std::vector<Case> all;
  while (all.size() < cases) {
    all.push_back(shop.cut(all.size()));
    if (fault_of(all.back())) all.pop_back();  // what cannot be is never added
  }
  const Folder folder;
  Job job;
  auto base = CaseBase::open_or_create(folder.file(), job).value();
  ASSERT_TRUE(base.add(all));
  int led = 0, near_law = 0, kept = 0;
  for (int i = 0; i < kQueries; ++i) {
    const Question q = shop.question();
    const Values law = Shop::law(q);
    const auto near = evidence_near(base, q).value();
    const Advice a = advise(near, {});
    const auto off = [&](const Values& v) {
      return std::max(std::abs(v.vc_m_min / law.vc_m_min - 1.0), std::abs(v.fz_mm / law.fz_mm - 1.0));
    };
    led += a.leads ? 1 : 0;
    near_law += a.leads && off(a.start) <= 0.1 ? 1 : 0;
    kept += off(advise(near, law).start) <= 0.1 ? 1 : 0;
  }
  RecordProperty("led", led);
  RecordProperty("near_law", near_law);
  EXPECT_GE(led, 0.95 * kQueries);
  EXPECT_GE(near_law, 0.95 * kQueries);
  EXPECT_GE(kept, 0.95 * kQueries) << "a table that is the law is not lowered by wrong cases";
}

}  // namespace
}  // namespace capstan::casebase
