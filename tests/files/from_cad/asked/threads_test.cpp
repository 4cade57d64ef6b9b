// Threads that a caller states of the plain holes of a CAD part.

#include "planner/files/from_cad/asked/threads.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/files/from_cad/from_cad.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "tests/files/exchange/brep/support.h"
#include "tests/files/from_cad/turned_part.h"

namespace capstan::testing {
namespace {

using from_cad::parse_thread;
using ::testing::HasSubstr;

TEST(StatedThread, ReadsSizePitchClassHandAndDepth) {
  const auto coarse = parse_thread("HOLE 3=M8");
  ASSERT_TRUE(coarse) << coarse.error().message;
  EXPECT_EQ(coarse->holes, "HOLE 3");
  EXPECT_EQ(coarse->major_mm, 8.0);
  EXPECT_EQ(coarse->pitch_mm, 1.25);
  EXPECT_EQ(coarse->grade, 6);
  EXPECT_FALSE(coarse->depth_mm);
  const auto fine = parse_thread("#120=M10x1-5H-LH:12.5");
  ASSERT_TRUE(fine) << fine.error().message;
  EXPECT_EQ(fine->holes, "#120");
  EXPECT_EQ(fine->pitch_mm, 1.0);
  EXPECT_EQ(fine->grade, 5);
  EXPECT_TRUE(fine->left_hand);
  EXPECT_EQ(fine->depth_mm, 12.5);
}

TEST(StatedThread, RefusesWhatIsNoThreadAndSaysWhatOneIs) {
  for (const auto& [text, what] :
       std::vector<std::pair<std::string, std::string>>{{"M8", "names no hole"},
                                                        {"=M8", "names no hole"},
                                                        {"HOLE=", "only metric"},
                                                        {"HOLE=UNC 1/4", "only metric"},
                                                        {"HOLE=M", "only metric"},
                                                        {"HOLE=Mx1", "no diameter"},
                                                        {"HOLE=M0", "no diameter"},
                                                        {"HOLE=M8x", "no pitch"},
                                                        {"HOLE=M8x0", "no pitch"},
                                                        {"HOLE=M8x1,25", "no pitch"},
                                                        {"HOLE=M9.5", "no coarse pitch"},
                                                        {"HOLE=M8-6G", "neither a class"},
                                                        {"HOLE=M8-9H", "neither a class"},
                                                        {"HOLE=M8:", "no depth"},
                                                        {"HOLE=M8:-3", "no depth"},
                                                        {"HOLE=M8:nan", "no depth"},
                                                        {"HOLE=M2x3", "no core"}}) {
    const auto t = parse_thread(text);
    ASSERT_FALSE(t) << text;
    EXPECT_EQ(t.error().code, "OPTION-THREAD") << text;
    EXPECT_THAT(t.error().message, HasSubstr(what)) << text;
    EXPECT_THAT(t.error().expected, HasSubstr("HOLE*=M10x1")) << text;
  }
}

TEST(StatedThread, HasTheCoreOfThePublishedLimits) {
  // ISO 965-2, minor diameter of internal threads 6H, mm.
  struct Row {
    const char* size;
    double least, most;
  };
  for (const Row& r : {Row{"M3", 2.459, 2.599}, Row{"M6", 4.917, 5.153}, Row{"M8", 6.647, 6.912},
                       Row{"M10", 8.376, 8.676}, Row{"M12", 10.106, 10.441}, Row{"M20", 17.294, 17.744}}) {
    const auto t = parse_thread("HOLE=" + std::string(r.size));
    ASSERT_TRUE(t) << r.size;
    EXPECT_NEAR(t->least_core_mm(), r.least, 6e-4) << r.size;
    EXPECT_NEAR(t->most_core_mm(), r.most, 1e-3) << r.size;
  }
}

class ThreadsOfCad : public ::testing::Test {
 protected:
  void SetUp() override {
    if (exchange::testing::helper().empty()) GTEST_SKIP() << "built without OpenCASCADE";
  }
  Result<model::Plan> planned(const std::string& step, const std::vector<std::string>& threads) {
    exchange::BrepLimits limits;
    limits.helper = exchange::testing::helper();
    auto brep = exchange::read_brep_bytes(step, "part.step", limits, job_);
    if (!brep) return tl::unexpected(brep.error());
    from_cad::Stated stated;
    for (const std::string& t : threads) stated.threads.push_back(*parse_thread(t));
    return from_cad::plan_of_part(*brep, "part.step", stated, job_);
  }
  [[nodiscard]] std::string said() const {
    std::string out;
    for (const auto& d : job_.diagnostics()) out += d.code == "CAD-THREAD" ? d.message + "\n" : "";
    return out;
  }
  Job job_;
};

/// Through, as the core of M8 is drilled; blind, 20 mm with a point of 118 degrees.
std::string through() { return bored({{3.4, 20}, {3.4, 0}}); }
std::string blind() {
  return bored({{3.4, 20}, {3.4, 4}, {0, 4 - 3.4 / std::tan(59 * 0.017453292519943295)}});
}

model::FeatureShape only_thread(const model::Plan& plan) {
  const auto all = plan.model.all(model::TypeId::kDefinedThread);
  EXPECT_EQ(all.size(), 1U);
  if (all.size() != 1) return {};
  const auto shapes = model::shapes_of(plan.model, model::Ref<model::ManufacturingFeature>(all.front()));
  EXPECT_TRUE(shapes) << (shapes ? "" : shapes.error().message);
  EXPECT_TRUE(!shapes || shapes->size() == 1);
  return shapes && !shapes->empty() ? shapes->front() : model::FeatureShape{};
}

TEST_F(ThreadsOfCad, OfAThroughHoleGoesToItsEndAndBindsTheCoresTolerance) {
  const auto plan = planned(through(), {"HOLE*=M8"});
  ASSERT_TRUE(plan) << plan.error().message;
  const auto thread = only_thread(*plan);
  EXPECT_EQ(thread.kind, model::ShapeKind::kThread);
  EXPECT_EQ(thread.thread_major_mm, 8.0);
  EXPECT_NEAR(thread.thread_pitch_mm, 1.25, 1e-12);
  EXPECT_NEAR(thread.thread_depth_mm, 20.0, 1e-9);
  EXPECT_TRUE(thread.through);
  // 6.8 mm of 6.647 to 6.912.
  EXPECT_NEAR(thread.diameter.lower_mm, 6.6468 - 6.8, 2e-4);
  EXPECT_NEAR(thread.diameter.upper_mm, 6.6468 + 0.265 - 6.8, 2e-4);
  EXPECT_NEAR(thread.frame.origin.z, 20.0, 1e-9);
  EXPECT_THAT(said(), HasSubstr("M8 x 1.25 - 6H is cut in HOLE 1 (6.8 mm)"));
  const auto of = plan->model.all(model::TypeId::kDefinedThread).front();
  const model::Decision* bound = plan->ledger.find(of, "feature_placement");
  ASSERT_NE(bound, nullptr);
  EXPECT_EQ(bound->binder, model::Binder::kOperator);
}

TEST_F(ThreadsOfCad, OfABlindHoleNeedsADepthThatTheHoleHas) {
  const auto unsaid = planned(blind(), {"HOLE 1=M8"});
  ASSERT_FALSE(unsaid);
  EXPECT_EQ(unsaid.error().code, "CAD-THREAD");
  EXPECT_THAT(unsaid.error().message, HasSubstr("HOLE 1 is blind"));
  EXPECT_THAT(unsaid.error().hint, HasSubstr("':9'"));  // 16 mm less five pitches, whole millimetres
  const auto deep = planned(blind(), {"HOLE 1=M8:16.5"});
  ASSERT_FALSE(deep);
  EXPECT_THAT(deep.error().message, HasSubstr("HOLE 1 is 16 mm deep"));
  const auto plan = planned(blind(), {"HOLE 1=M8:12"});
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_NEAR(only_thread(*plan).thread_depth_mm, 12.0, 1e-9);
}

TEST_F(ThreadsOfCad, OfAFaceIsThatOfItsHole) {
  const std::string step = through();
  const auto at = step.find("=ADVANCED_FACE('bore'");
  const auto hash = step.rfind('#', at);
  const auto plan = planned(step, {step.substr(hash, at - hash) + "=M8-LH"});
  ASSERT_TRUE(plan) << plan.error().message;
  EXPECT_TRUE(only_thread(*plan).thread_left_hand);
}

TEST_F(ThreadsOfCad, AHoleThatIsNoCoreIsRefusedByNameAndLeftPlainByAPattern) {
  const auto named = planned(through(), {"HOLE 1=M10"});
  ASSERT_FALSE(named);
  EXPECT_THAT(named.error().message,
              HasSubstr("HOLE 1 is drawn with 6.8 mm, and the core of M10 x 1.5 - 6H is 8.376 to"));
  const auto pattern = planned(through(), {"HOLE*=M10"});
  ASSERT_FALSE(pattern) << "not one of them fits";
  EXPECT_THAT(pattern.error().message, HasSubstr("HOLE 1 (6.8 mm)"));
  const auto unknown = planned(through(), {"BORE*=M8"});
  ASSERT_FALSE(unknown);
  EXPECT_THAT(unknown.error().message, HasSubstr("the holes are HOLE 1 (6.8 mm)"));
  const auto twice = planned(through(), {"HOLE 1=M8", "HOLE*=M8"});
  ASSERT_FALSE(twice);
  EXPECT_THAT(twice.error().message, HasSubstr("two threads"));
}

TEST_F(ThreadsOfCad, OfACountersunkHoleIsInItsBore) {
  const auto plan = planned(bored({{4.25, 20}, {3.4, 19.15}, {3.4, 0}}), {"HOLE*=M8"});
  ASSERT_TRUE(plan) << plan.error().message;
  const auto thread = only_thread(*plan);
  EXPECT_NEAR(thread.diameter.nominal_mm, 6.8, 1e-6);
  EXPECT_NEAR(thread.frame.origin.z, 20.0, 1e-6) << "below a countersink the bore is drawn from the mouth";
}

}  // namespace
}  // namespace capstan::testing
