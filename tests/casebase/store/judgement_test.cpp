#include "casebase/casebase.h"
#include "casebase/recall/recall.h"

#include <utility>

#include "tests/casebase/sample.h"

namespace capstan::casebase {
namespace {

const Remark kSaid{"A. Smith", "2016-06-29T08:00:00Z", "chatter marks"};

class Judgement : public testing::Test {
 protected:
  CaseBase reopened() {
    Job job;
    auto base = CaseBase::open(folder_.file(), job).value();
    EXPECT_EQ(job.count(Severity::kWarning), 0u);
    return base;
  }
  Folder folder_;
  Job job_;
  CaseBase base_ = CaseBase::open_or_create(folder_.file(), job_).value();
};

TEST_F(Judgement, SupersedesTheVerdictAndKeepsTheId) {
  ASSERT_TRUE(base_.add(sample()).has_value());
  const std::vector<std::string> ids = {sample().id};
  ASSERT_TRUE(base_.judge(ids, Verdict::kBad, kSaid).has_value());
  const CaseBase again = reopened();
  for (const CaseBase* base : {&std::as_const(base_), &again}) {
    const Case c = base->get(ids[0]).value();
    EXPECT_EQ(c.observed.verdict, Verdict::kBad);
    EXPECT_EQ(c.id, sample().id);
    EXPECT_FALSE(advise(evidence_near(*base, sample().asked).value(), {}).leads);
    const auto said = base->later_verdicts(ids[0]);
    ASSERT_EQ(said.size(), 1u);
    EXPECT_EQ(said[0].verdict, Verdict::kBad);
    EXPECT_EQ(said[0].by, "A. Smith");
    EXPECT_EQ(said[0].reason, "chatter marks");
  }
}

TEST_F(Judgement, IsSaidOnce) {
  ASSERT_TRUE(base_.add(sample()).has_value());
  const std::vector<std::string> ids = {sample().id};
  for (int i = 0; i < 3; ++i) ASSERT_TRUE(base_.judge(ids, Verdict::kBad, kSaid).has_value());
  EXPECT_EQ(reopened().later_verdicts(ids[0]).size(), 1u);
  ASSERT_TRUE(base_.judge(ids, Verdict::kGood, kSaid).has_value());
  EXPECT_EQ(reopened().get(ids[0])->observed.verdict, Verdict::kGood);
}

TEST_F(Judgement, RefusesWhatIsNoCase) {
  const std::vector<std::string> ids = {sample().id};
  EXPECT_EQ(base_.judge(ids, Verdict::kBad, kSaid).error().code, "CASE-UNKNOWN");
  ASSERT_TRUE(base_.add(sample()).has_value());
  EXPECT_EQ(base_.judge(ids, Verdict::kBad, {"a\nb", "", ""}).error().code, "CASE-INVALID");
  EXPECT_EQ(base_.judge(ids, Verdict::kBad, {"", "yesterday", ""}).error().code, "CASE-INVALID");
}

TEST_F(Judgement, ARemovedCaseCountsNoMoreAndStaysAwayWhenItIsAddedAgain) {
  ASSERT_TRUE(base_.add(std::vector{sample(10.0), sample(10.5)}).has_value());
  EXPECT_EQ(base_.nearest(sample().asked, 5)->size(), 2u);
  const std::vector<std::string> ids = {sample(10.0).id};
  ASSERT_TRUE(base_.remove(ids, kSaid).has_value());
  EXPECT_EQ(base_.nearest(sample().asked, 5)->size(), 1u);
  ASSERT_TRUE(base_.add(sample(10.0)).has_value());
  EXPECT_EQ(base_.size(), 1u);
  const CaseBase again = reopened();
  EXPECT_EQ(again.cases(), std::vector{sample(10.5)});
  EXPECT_EQ(again.nearest(sample().asked, 5)->size(), 1u);
  EXPECT_FALSE(again.later_verdicts(ids[0]).at(0).verdict.has_value());
}

TEST_F(Judgement, FindsAnIdByItsFirstDigits) {
  ASSERT_TRUE(base_.add(random_cases(100, 3)).has_value());
  const std::string id = base_.cases()[50].id;
  EXPECT_EQ(base_.find(id.substr(0, 12)).value(), id);
  EXPECT_EQ(base_.find("").error().code, "CASE-UNKNOWN");
  EXPECT_EQ(base_.find("xyz").error().code, "CASE-UNKNOWN");
}

}  // namespace
}  // namespace capstan::casebase
