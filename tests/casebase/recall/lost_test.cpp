#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>

#include "casebase/recall/recall.h"
#include "tests/casebase/sample.h"

// What a base says while rows of it are altered or gone: never more than the table and what is left allow.

namespace capstan::casebase {
namespace {

using ::testing::HasSubstr;

constexpr Values kTable = {.vc_m_min = 30.0, .fz_mm = 0.1};

/// Cuts of one hole on parts of their own, at this share of the table's speed.
std::vector<Case> cuts(int n, Verdict verdict, double share, const std::string& name) {
  std::vector<Case> out;
  for (int i = 0; i < n; ++i) {
    Case c = sample(10.0, share * kTable.vc_m_min, name + " " + std::to_string(i));
    c.observed.verdict = verdict;
    c.observed.time_s = Figure{6.5 + 0.01 * i};
    c.from.part = name + " " + std::to_string(i);
    c.id = id_of(c);
    out.push_back(c);
  }
  return out;
}

std::vector<Case> operator+(std::vector<Case> a, const std::vector<Case>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

Advice advice_of(const std::string& path) {
  Job job;
  const auto base = CaseBase::open(path, job).value();
  return advise(evidence_near(base, sample().asked).value(), kTable);
}

class LostCases : public testing::Test {
 protected:
  void fill_with(const std::vector<Case>& cases) {
    fill(path(), cases);
    whole_ = advice_of(path());
  }
  [[nodiscard]] std::string path() const { return folder_.file(); }
  Folder folder_;
  Advice whole_;
};

TEST_F(LostCases, GoodCutsRaiseNothingWhileARowIsGone) {
  fill_with(cuts(6, Verdict::kGood, 1.2, "good") + cuts(1, Verdict::kBad, 1.2, "bad"));
  ASSERT_GT(whole_.start.vc_m_min, kTable.vc_m_min);
  tamper(path(), "DELETE FROM capstan_head WHERE number = 7");
  const Advice a = advice_of(path());
  EXPECT_EQ(a.start, kTable);
  EXPECT_TRUE(a.careful);
  EXPECT_THAT(a.why, HasSubstr("cases of the base are lost"));
}

TEST_F(LostCases, GoodCutsLiftNoFailureWhileARowIsGone) {
  const auto bad = cuts(3, Verdict::kBad, 0.9, "bad");
  fill_with(bad + cuts(40, Verdict::kGood, 1.0, "good"));
  EXPECT_FALSE(whole_.lowered);
  Folder alone;
  fill(alone.file(), bad);
  const Advice of_bad = advice_of(alone.file());
  ASSERT_TRUE(of_bad.lowered);
  tamper(path(), "DELETE FROM capstan_head WHERE number = 43");
  EXPECT_EQ(advice_of(path()).start, of_bad.start);
}

TEST_F(LostCases, SlowerGoodCutsStillSayWhereToStart) {
  fill_with(cuts(5, Verdict::kGood, 0.8, "good"));
  tamper(path(), "DELETE FROM capstan_head WHERE number = 5");
  EXPECT_DOUBLE_EQ(advice_of(path()).start.vc_m_min, 0.8 * kTable.vc_m_min);
}

TEST_F(LostCases, RowsBehindOneThatIsGoneStillBind) {
  fill_with(cuts(13, Verdict::kBad, 1.0, "bad"));
  ASSERT_TRUE(whole_.lowered);
  tamper(path(), "DELETE FROM capstan_head WHERE number = 1");
  const Advice a = advice_of(path());
  EXPECT_EQ(a.bad, 12);
  EXPECT_TRUE(a.lowered);
}

TEST_F(LostCases, AFailureOfWhichItsHeadAloneIsLeftCountsAsOneByTheTable) {
  fill_with(cuts(13, Verdict::kBad, 1.0, "bad"));
  tamper(path(), "UPDATE capstan_body SET body = x'00'");
  const Advice a = advice_of(path());
  EXPECT_EQ(a.bad, 13);
  EXPECT_EQ(a.start, whole_.start);  // they were cut by the table
}

TEST_F(LostCases, GoodCutsRaiseNothingNearABodyThatIsLostAndElsewhereTheyDo) {
  auto cases = cuts(6, Verdict::kGood, 1.2, "near");
  for (Case c : cuts(6, Verdict::kGood, 1.2, "far")) {
    c.asked.diameter_mm = c.asked.cutter_diameter_mm = 40.0;
    c.id = id_of(c);
    cases.push_back(c);
  }
  fill_with(cases);
  tamper(path(), "DELETE FROM capstan_body WHERE number = 3");
  EXPECT_EQ(advice_of(path()).start, kTable);
  Job job;
  const auto base = CaseBase::open(path(), job).value();
  EXPECT_TRUE(base.whole());
  EXPECT_GT(advise(evidence_near(base, sample(40.0).asked).value(), kTable).start.vc_m_min, kTable.vc_m_min);
  EXPECT_EQ(base.look(sample().asked, 6)->lost.size(), 1u);
}

TEST_F(LostCases, CopiesHideNothingBehindABodyThatIsLost) {
  // More copies of one cut than are looked at first, and a failure a little further away.
  std::vector<Case> copies;
  for (int i = 0; i < 200; ++i) {
    Case c = cuts(1, Verdict::kGood, 1.0, "one").front();
    c.from.source = "copy " + std::to_string(i);
    c.id = id_of(c);
    copies.push_back(c);
  }
  auto bad = cuts(13, Verdict::kBad, 1.0, "bad");
  for (Case& c : bad) {
    c.asked.diameter_mm = 10.1;
    c.id = id_of(c);
  }
  fill_with(copies + bad);
  ASSERT_TRUE(whole_.lowered);
  tamper(path(), "DELETE FROM capstan_body WHERE number = 1");
  EXPECT_TRUE(advice_of(path()).lowered);
}

TEST_F(LostCases, AreNamedWhereTheMetricIsWhatIsLost) {
  fill_with(cuts(6, Verdict::kGood, 1.2, "good"));
  Job job;
  ASSERT_TRUE(CaseBase::open(path(), job).value().learn_metric());
  EXPECT_TRUE(CaseBase::open(path(), job).value().whole());
  tamper(path(), "UPDATE capstan_body SET body = x'00' WHERE number = 7");
  const auto base = CaseBase::open(path(), job).value();
  EXPECT_FALSE(base.whole());
  EXPECT_EQ(advise(evidence_near(base, sample().asked).value(), kTable).start, kTable);
}

TEST_F(LostCases, AFlippedBitNeverRaisesAValue) {
  fill_with(cuts(6, Verdict::kGood, 1.2, "good") + cuts(2, Verdict::kBad, 1.2, "bad"));
  std::ifstream in(path(), std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(in), {}};
  constexpr std::size_t kAll = 8;
  std::mt19937 random(15);
  int lost = 0, raised = 0;
  for (int i = 0; i < 600; ++i) {
    std::string broken = bytes;
    const std::size_t at = random() % broken.size();
    broken[at] = static_cast<char>(broken[at] ^ (1 << (random() % 8)));
    const std::string file = folder_.file("broken.db");
    std::ofstream(file, std::ios::binary) << broken;
    Job job;
    if (const auto base = CaseBase::open(file, job)) {
      const auto near = evidence_near(*base, sample().asked).value();
      const Advice a = advise(near, kTable);
      const bool less = near.size() < kAll || a.careful;
      lost += less ? 1 : 0;
      raised += a.start.vc_m_min > (less ? kTable.vc_m_min : whole_.start.vc_m_min) ? 1 : 0;
      EXPECT_LE(a.start.vc_m_min, std::max(kTable.vc_m_min, whole_.start.vc_m_min)) << at;
    }
    for (const char* beside : {"-wal", "-shm"}) std::filesystem::remove(file + beside);
  }
  EXPECT_EQ(raised, 0);
  EXPECT_GT(lost, 20);  // slack between the rows is most of a page
}

}  // namespace
}  // namespace capstan::casebase
