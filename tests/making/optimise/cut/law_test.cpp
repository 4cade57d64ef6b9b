#include "planner/making/optimise/cut/law/law.h"

#include <gtest/gtest.h>

#include <set>

#include "planner/ground/vocabulary/operation.h"
#include "planner/model/nouns/arena/attribute.h"
#include "tests/making/optimise/cut/questions.h"

namespace capstan::optimise {
namespace {

TEST(AxialLaws, AreThoseThatOperationsAlongTheAxisName) {
  std::set<std::string_view> named, there;
  for (const model::OperationRow& r : model::operations()) {
    EXPECT_EQ(r.law.empty(), !model::is_a(r.value, model::TypeId::kDrillingTypeOperation))
        << static_cast<int>(r.value);
    if (!r.law.empty()) named.insert(r.law);
  }
  for (const AxialLaw& l : axial_laws()) EXPECT_TRUE(there.insert(l.name).second) << l.name;
  EXPECT_EQ(named, there);
}

TEST(AxialLaws, OfANameThatNoFileHasIsAnErrorOfOurs) {
  CutQuestion q = questions::drilling();
  q.law = "broaching";
  EXPECT_THROW((void)loads_of(q, 0.0, 0.0, 1000.0, 100.0), std::logic_error);
}

TEST(AxialLaws, ATapFeedsByItsPitchAndADrillDoesNot) {
  CutQuestion q = questions::drilling();
  EXPECT_FALSE(feeds_by_pitch(q));
  q.law = "tapping";
  EXPECT_TRUE(feeds_by_pitch(q));
  q.kind = CutKind::kFinish;  // a thread mill
  EXPECT_FALSE(feeds_by_pitch(q));
}

}  // namespace
}  // namespace capstan::optimise
