#include "planner/making/draft/candidates.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace capstan::draft {
namespace {

model::Candidate candidate(const std::string& id, double score = 0.0) {
  model::Candidate c;
  c.cutter.id = id;
  c.score = score;
  return c;
}

std::string ids(const Candidates& list) {
  std::string out;
  for (const model::Candidate& c : list) out += c.cutter.id;
  return out;
}

TEST(Candidates, OfEqualCuttersAreSharedBetweenLists) {
  CandidatePool pool;
  const Candidates a = pool.list({candidate("a"), candidate("b")});
  const Candidates b = pool.list({candidate("b"), candidate("a")});
  EXPECT_EQ(&a[0], &b[1]);
  EXPECT_EQ(&a[1], &b[0]);
}

TEST(Candidates, OfOneCutterThatDifferInTheirStartValuesAreTwo) {
  CandidatePool pool;
  const Candidates a = pool.list({candidate("a", 1.0)});
  const Candidates b = pool.list({candidate("a", 2.0)});
  EXPECT_NE(&a[0], &b[0]);
  EXPECT_EQ(b.front().score, 2.0);
}

TEST(Candidates, KeepTheOrderOfTheOthersWhenOneIsPreferred) {
  Candidates list = CandidatePool().list({candidate("a"), candidate("b"), candidate("c"), candidate("d")});
  list.prefer(2);
  EXPECT_EQ(ids(list), "cabd");
}

TEST(Candidates, BeginWithTheOnesThatArePreferredInTheirOrder) {
  Candidates list = CandidatePool().list({candidate("a"), candidate("b"), candidate("c"), candidate("d")});
  list.prefer(std::vector<std::size_t>{2, 0});
  EXPECT_EQ(ids(list), "cabd");
  list.prefer(std::vector<std::size_t>{1, 3});
  EXPECT_EQ(ids(list), "adcb");
}

TEST(Candidates, AreReplacedInOneListOnly) {
  CandidatePool pool;
  Candidates one = pool.list({candidate("a"), candidate("b")});
  const Candidates other = one;
  one.replace([](const Candidates::Shared& c) {
    return c->cutter.id == "b" ? std::make_shared<const model::Candidate>(candidate("x")) : nullptr;
  });
  EXPECT_EQ(ids(one), "ax");
  EXPECT_EQ(ids(other), "ab");
}

}  // namespace
}  // namespace capstan::draft
