#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <numbers>
#include <string>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/memo/memo.h"
#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/plate.h"
#include "tests/support/shop.h"

// Rings outwards or inwards, or constant engagement: the quickest is planned, the others stand beside it, and
// a plan that is read again keeps what was chosen. examples/reference_pocket.p21: 60 x 40 x 10 mm, corners of
// 6 mm.

namespace capstan::pipeline {
namespace {

using ::testing::HasSubstr;

/// A weak machine, on which rings must be shallow; its spindle could turn three times as fast as the table
/// says.
ShopFiles weak() {
  ShopFiles names;
  names.machine = "small_router";
  names.material = "42CrMo4";
  return names;
}

/// A strong machine with a material that is easily cut.
ShopFiles strong() {
  ShopFiles names;
  names.machine = "generic_vmc";
  names.material = "EN AW-6061";
  return names;
}

Inputs shop(const ShopFiles& names) {
  Job job;
  auto in = load_shop(names, job);
  EXPECT_TRUE(in) << (in ? "" : to_text(in.error()));
  return in ? *std::move(in) : Inputs{};
}

/// The weak machine with one end mill of 5 mm and two teeth: of several, another is chosen by its estimated
/// time, and a narrower or a finer one roughs as quickly by rings.
Inputs weak_with_one_mill() {
  Inputs in = shop(weak());
  std::erase_if(in.library, [](const model::Cutter& k) { return k.id != "generic/endmill_2f_short/5"; });
  return in;
}

model::Plan read(const std::string& text, const std::string& name = "part.p21") {
  Job job;
  auto plan = read_plan(text, name, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan{};
}

std::string pocket() { return testing::slurp(testing::source_dir() + "/examples/reference_pocket.p21"); }

/// The same pocket, 12 mm deep.
std::string deeper() {
  std::string text = pocket();
  const std::string floor = "(0.,0.,-10.)";
  const auto at = text.find(floor);
  EXPECT_NE(at, std::string::npos);
  return at == std::string::npos ? text : text.replace(at, floor.size(), "(0.,0.,-12.)");
}

model::Plan bound(model::Plan plan, const Inputs& in, unsigned threads = 1, const Policy& policy = {}) {
  Job job;
  job.threads = threads;
  auto made = bind(std::move(plan), in, policy, job);
  EXPECT_TRUE(made) << (made ? "" : to_text(made.error()));
  return made ? *std::move(made) : model::Plan{};
}

std::string written(const model::Plan& plan, Format format) {
  Job job;
  auto out = write_plan(plan, format, job);
  EXPECT_TRUE(out) << (out ? "" : to_text(out.error()));
  return out ? *std::move(out) : std::string();
}

/// The roughing operation of a plan's pocket.
model::AnyRef roughing(const model::Plan& plan) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps.front().step);
  return ws == nullptr ? model::AnyRef{} : model::AnyRef(ws->its_operation);
}

bool constant(const model::Plan& plan) {
  const auto* o = plan.model.get<model::Two5dMillingOperation>(roughing(plan));
  return o != nullptr && plan.model.holds<model::ExplicitStrategy>(o->its_machining_strategy);
}

const model::Decision* decided(const model::Plan& plan) {
  return plan.ledger.find(roughing(plan), "its_machining_strategy");
}

TEST(ConstantEngagementPlanned, StandsAsAnExplicitStrategyWithItsTimeAndThatOfTheRings) {
  const auto plan = bound(read(pocket()), weak_with_one_mill());
  ASSERT_TRUE(constant(plan));
  const auto* d = decided(plan);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(d->binder, model::Binder::kOptimiser);
  const model::Reason& why = plan.ledger.reason(d->reason);
  EXPECT_EQ(why.id, "path.constant_engagement");
  EXPECT_THAT(why.text, HasSubstr("constant engagement "));
  ASSERT_EQ(d->rejected.size(), 2u);
  EXPECT_THAT(d->rejected[0].what, HasSubstr("rings from the wall inwards "));
  EXPECT_THAT(d->rejected[1].what, HasSubstr("rings "));
  EXPECT_THAT(d->rejected[1].why, HasSubstr(" against "));
}

TEST(ConstantEngagementPlanned, IsNotTakenWhereRingsAreQuickerAndStandsBesideThemWithItsTime) {
  const auto plan = bound(read(pocket()), shop(strong()));
  ASSERT_FALSE(constant(plan));
  const auto* d = decided(plan);
  ASSERT_NE(d, nullptr);
  ASSERT_EQ(d->rejected.size(), 2u);
  EXPECT_THAT(d->rejected[1].what, HasSubstr("constant engagement "));
  EXPECT_THAT(d->rejected[1].why, HasSubstr(" against "));
}

TEST(ConstantEngagementPlanned, SaysWhyItHasNoPathWhereThereIsNone) {
  // A round of 2 mm along the bottom is left by rings only.
  std::string text = pocket();
  const std::string sharp = "CLOSED_POCKET('POCKET',#4,(),#32,#35,(),$,#36,$,#38,#42);";
  const auto at = text.find(sharp);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, sharp.size(),
               "CLOSED_POCKET('POCKET',#4,(),#32,#35,(),$,#36,#44,#38,#42);\n"
               "#44=TOLERANCED_LENGTH_MEASURE(2.,#37);");
  const auto plan = bound(read(text), shop(weak()));
  ASSERT_FALSE(constant(plan));
  const auto* d = decided(plan);
  ASSERT_NE(d, nullptr);
  ASSERT_EQ(d->rejected.size(), 2u);
  EXPECT_THAT(d->rejected[1].what, HasSubstr("constant engagement "));
  EXPECT_THAT(d->rejected[1].why, HasSubstr("no path of constant engagement: a round leads"));
}

const model::ContourParallel* rings_of(const model::Plan& plan) {
  const auto* o = plan.model.get<model::Two5dMillingOperation>(roughing(plan));
  return o == nullptr ? nullptr : plan.model.get<model::ContourParallel>(o->its_machining_strategy);
}

TEST(RingsInwardsPlanned, StandAsRingsWithASenseOfRotationAndAreKeptByEachForm) {
  ShopFiles names;
  names.machine = "generic_vmc";
  names.material = "C45";
  const Inputs in = shop(names);
  const auto plan = bound(read(deeper()), in);
  const auto* rings = rings_of(plan);
  ASSERT_NE(rings, nullptr);
  ASSERT_TRUE(rings->rotation_direction.set());
  EXPECT_EQ(rings->rotation_direction.value(), model::RotDirection::kCw);
  const auto* d = decided(plan);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(plan.ledger.reason(d->reason).id, "path.rings_inwards");
  ASSERT_FALSE(d->rejected.empty());
  EXPECT_THAT(d->rejected[0].what, HasSubstr("rings "));
  EXPECT_THAT(d->rejected[0].why, HasSubstr(" against "));
  for (const auto& [format, name] : {std::pair(Format::kJson, "p.json"), std::pair(Format::kAp238, "p.stpnc"),
                                     std::pair(Format::kIso14649, "p.p21")}) {
    const auto again = bound(read(written(plan, format), name), in);
    ASSERT_FALSE(again.steps.empty()) << name;
    ASSERT_NE(rings_of(again), nullptr) << name;
    EXPECT_TRUE(rings_of(again)->rotation_direction.set()) << name;
    EXPECT_EQ(again.steps.front().path->size(), plan.steps.front().path->size()) << name;
  }
}

// Corners of 18 mm are wider than what the centre of a helix may go round; a ramp along the wall turns round
// four of them and leaves no core.
TEST(RingsInwardsPlanned, PassTheCheckRoundWideCorners) {
  ShopFiles names;
  names.machine = "generic_vmc";
  names.material = "C45";
  Inputs in = shop(names);
  std::erase_if(in.library, [](const model::Cutter& k) {
    return k.cutter_class != model::CutterClass::kEndmill || k.cutting_diameter_mm != 10.0;
  });
  std::string text = deeper();
  const std::string corner = "#38=TOLERANCED_LENGTH_MEASURE(6.,#37);";
  const auto at = text.find(corner);
  ASSERT_NE(at, std::string::npos);
  text.replace(at, corner.size(), "#38=TOLERANCED_LENGTH_MEASURE(18.,#37);");
  Job job;
  const auto made = bind_checked(read(text), in, {}, job);
  ASSERT_TRUE(made) << to_text(made.error());
  const auto* d = decided(made->plan);
  ASSERT_NE(d, nullptr);
  EXPECT_EQ(made->plan.ledger.reason(d->reason).id, "path.rings_inwards");
  double turned = 0.0;  // of the ramp round centres farther away than the radius
  const model::CutterPath& p = *made->plan.steps.front().path;
  for (std::size_t i = 1; i < p.size(); ++i) {
    if (p.role[i] != model::MoveRole::kRamp || !model::is_arc(p.kind[i])) continue;
    const double radius = std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]);
    if (radius > 5.0) turned += model::move_length(p, i) / radius;
  }
  EXPECT_GT(turned, 2.0 * std::numbers::pi);
  for (const auto& f : made->findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(ConstantEngagementPlanned, TurnsFasterInItsNarrowCutsThanWhereItEnters) {
  const auto plan = bound(read(pocket()), weak_with_one_mill());
  ASSERT_TRUE(constant(plan));
  const auto& step = plan.steps.front();
  double entering = 0.0, cutting = 0.0;
  for (std::size_t i = 1; i < step.path->size(); ++i) {
    const double rpm = step.schedule->spindle_rpm[i];
    if (step.path->role[i] == model::MoveRole::kRamp) entering = std::max(entering, rpm);
    if (step.path->role[i] == model::MoveRole::kCut) cutting = std::max(cutting, rpm);
  }
  ASSERT_GT(entering, 0.0);
  EXPECT_GT(cutting, entering);
}

TEST(ConstantEngagementPlanned, IsKeptByEachFormThatAPlanIsReadAgainFrom) {
  const Inputs in = weak_with_one_mill();
  const auto plan = bound(read(pocket()), in);
  ASSERT_TRUE(constant(plan));
  const model::CutterPath& path = *plan.steps.front().path;
  for (const auto& [format, name] : {std::pair(Format::kJson, "p.json"), std::pair(Format::kAp238, "p.stpnc"),
                                     std::pair(Format::kIso14649, "p.p21")}) {
    const auto again = bound(read(written(plan, format), name), in);
    ASSERT_FALSE(again.steps.empty()) << name;
    EXPECT_TRUE(constant(again)) << name;
    const model::CutterPath& other = *again.steps.front().path;
    ASSERT_EQ(other.size(), path.size()) << name;
    for (std::size_t i = 0; i < path.size(); ++i) {
      EXPECT_NEAR(other.x[i], path.x[i], 1e-6) << name << " " << i;
      EXPECT_NEAR(other.y[i], path.y[i], 1e-6) << name << " " << i;
    }
    const auto* d = decided(again);
    ASSERT_NE(d, nullptr) << name;
    EXPECT_EQ(again.ledger.reason(d->reason).id, "path.constant_engagement") << name;
  }
}

TEST(ConstantEngagementPlanned, IsTheSameToTheByteOnTwoThreadsAndWithAMemo) {
  Inputs in = weak_with_one_mill();
  const std::string one = written(bound(read(pocket()), in), Format::kJson);
  EXPECT_EQ(written(bound(read(pocket()), in, 2), Format::kJson), one);
  in.memo = std::make_shared<memo::Memo>(0);  // keeps nothing
  EXPECT_EQ(written(bound(read(pocket()), in), Format::kJson), one);
  in.memo = std::make_shared<memo::Memo>();
  EXPECT_EQ(written(bound(read(pocket()), in), Format::kJson), one);
  EXPECT_EQ(written(bound(read(pocket()), in), Format::kJson), one);
}

// A plan whose strategy the operator states, rings, with the technology open again.
TEST(ConstantEngagementPlanned, DoesNotReplaceAStrategyThatAFileStates) {
  const Inputs in = weak_with_one_mill();
  model::Plan plan = bound(read(pocket()), in);
  ASSERT_TRUE(constant(plan));
  const auto operation = roughing(plan);
  model::ContourParallel rings;
  rings.cutmode = model::CutmodeType::kClimb;
  const auto made = plan.model.add(rings);
  plan.model.get<model::Two5dMillingOperation>(operation)->its_machining_strategy = made;
  plan.ledger.set({operation, "its_machining_strategy"}, {});  // bound, by the file
  const auto kept = bound(read(written(plan, Format::kIso14649)), in, 1, {.reopen = Reopen::kTools});
  ASSERT_FALSE(kept.steps.empty());
  const auto* o = kept.model.get<model::Two5dMillingOperation>(roughing(kept));
  ASSERT_NE(o, nullptr);
  EXPECT_TRUE(kept.model.holds<model::ContourParallel>(o->its_machining_strategy));
}

/// The ways that lost of each pocket of a plate, and how many paths were made that no step has.
struct Compared {
  std::vector<std::vector<model::Rejected>> lost;
  std::size_t in_vain = 0;
};
Compared compared(std::size_t features) {
  Inputs in = shop(strong());
  in.memo = std::make_shared<memo::Memo>();
  Job job;
  const auto plan = bind(read(testing::plate(features).text), in, {}, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  Compared out;
  if (!plan) return out;
  for (const model::StepResult& s : plan->steps) {
    const auto* ws = plan->model.get<model::MachiningWorkingstep>(s.step);
    const auto* d = plan->ledger.find(ws->its_operation, "its_machining_strategy");
    if (d != nullptr && !d->rejected.empty()) out.lost.push_back(d->rejected);
  }
  const std::size_t paths = in.memo->counts(memo::Stage::kPath).made;
  EXPECT_GE(paths, plan->steps.size());
  out.in_vain = paths - plan->steps.size();
  return out;
}

TEST(Strategy, OfEqualPocketsTheOtherWaysAreTriedForTheFirstAlone) {
  // Every fourth feature of the plate is a pocket; all of them are equal, in two rows of equal surroundings.
  const Compared one = compared(4), many = compared(33);
  ASSERT_EQ(one.lost.size(), 1U);
  ASSERT_GT(one.in_vain, 0U);
  ASSERT_EQ(many.lost.size(), 8U);
  for (const auto& lost : many.lost) EXPECT_EQ(lost, one.lost.front());
  EXPECT_LE(many.in_vain, 2 * one.in_vain);
}

}  // namespace
}  // namespace capstan::pipeline
