#include "planner/door/report/picture/picture.h"

#include <gmock/gmock.h>

#include <cmath>
#include <memory>

#include "planner/door/pipeline/pipeline.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/order/step_ids.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

namespace capstan::report::picture {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

model::Plan planned() {
  Job job;
  auto in = pipeline::load_shop({}, job);
  auto read = pipeline::read_plan(testing::slurp(testing::source_dir() + "/examples/reference_pocket.p21"),
                                  "parts/part.p21", job);
  EXPECT_TRUE(in && read);
  auto plan = pipeline::bind(*std::move(read), *in, {}, job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? *std::move(plan) : model::Plan();
}
const model::Plan& pocket() {
  static const model::Plan kPlan = planned();
  return kPlan;
}

std::vector<std::size_t> steps_in(const Drawing& d) {
  std::vector<std::size_t> out;
  for (const Group& g : d.groups) {
    for (const auto& shape : g.shapes) {
      const auto* dots = std::get_if<Dots>(&shape);
      if (g.step != 0 && dots != nullptr && !dots->at.empty()) out.push_back(g.step);
    }
  }
  return out;
}

TEST(Picture, DrawsThePathOfEachStepAndNamesItWithToolAndTime) {
  const std::string text = svg(pocket(), {}).value();
  const auto ids = model::step_ids(pocket());
  ASSERT_GT(ids.size(), 1U);
  EXPECT_EQ(steps_in(drawing_of(pocket(), {}).value()).size(), ids.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    EXPECT_THAT(text, HasSubstr("<g data-step=\"" + std::to_string(i + 1) + "\"><title>" +
                                std::to_string(i + 1) + " " + ids[i] + ", T"));
    EXPECT_THAT(text, HasSubstr(">" + ids[i] + "</text>"));
  }
  EXPECT_THAT(text, HasSubstr("Plan of part.p21 on "));
}

TEST(Picture, DrawsTheStepsThatAreAskedForByNumberOrPattern) {
  const auto ids = model::step_ids(pocket());
  EXPECT_EQ(steps_in(drawing_of(pocket(), {"2"}).value()), (std::vector<std::size_t>{2}));
  EXPECT_EQ(steps_in(drawing_of(pocket(), {ids[0]}).value()), (std::vector<std::size_t>{1}));
  EXPECT_EQ(steps_in(drawing_of(pocket(), {"2", "*"}).value()).size(), ids.size());
}

TEST(Picture, RefusesAStepThatIsNotThereAndNamesThoseThatAre) {
  const auto none = svg(pocket(), {"1", "no such step"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "PIC-STEP");
  EXPECT_THAT(none.error().message, HasSubstr("'no such step'"));
  EXPECT_THAT(none.error().expected, HasSubstr(model::step_ids(pocket())[0]));
}

TEST(Picture, IsTheSameBytesForTheSamePlan) { EXPECT_EQ(svg(pocket(), {}), svg(pocket(), {})); }

TEST(Picture, EscapesNamesOfAnyBytes) {
  model::Plan plan = pocket();
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(plan.steps[0].step);
  ASSERT_NE(ws, nullptr);
  const std::string name = "<script>\x01 & \"\xFF";
  plan.model.get<model::ManufacturingFeature>(ws->its_feature)->its_id = name;
  plan.file_name = name;
  const std::string text = svg(plan, {}).value();
  EXPECT_THAT(text, Not(HasSubstr("<script")));
  EXPECT_THAT(text, HasSubstr("<g><title>&lt;script&gt;  &amp; &quot;\xEF\xBF\xBD</title>"));
  EXPECT_THAT(text, HasSubstr("<title>Plan of &lt;script&gt;  &amp; &quot;\xEF\xBF\xBD on "));
  EXPECT_EQ(text.find('\x01'), std::string::npos);
}

TEST(Picture, OfAPlanWithoutSetupsSaysSo) {
  EXPECT_THAT(svg({}, {}).value(), HasSubstr("No set-up is planned"));
}

TEST(Picture, OfAMillionPointsTakesAFewMegabytes) {
  model::Plan plan;
  plan.stock.box = {{0.0, 0.0, -20.0}, {500.0, 500.0, 0.0}};
  plan.setups.emplace_back();
  model::CutterPath path;
  path.start({0.0, 0.0, 0.0});
  for (int i = 0; i < 1'000'000; ++i) {
    const double row = i / 1000;
    path.line({0.5 * (i % 1000), 0.5 * row + 0.4 * std::sin(1.3 * i), -10.0 + 5.0 * std::sin(0.7 * i)},
              model::MoveRole::kCut);
  }
  model::StepResult step;
  step.path = std::make_shared<model::CutterPath>(std::move(path));
  plan.steps.push_back(std::move(step));
  const std::string text = svg(plan, {}).value();
  EXPECT_LT(text.size(), 3'000'000U);
  EXPECT_GT(text.size(), 100'000U);
}

TEST(Picture, OfMoreSetupsThanPixelsHoldIsSvgAlone) {
  model::Plan plan = pocket();
  plan.setups.resize(200, plan.setups[0]);
  EXPECT_TRUE(svg(plan, {}).has_value());
  const auto none = png(plan, {});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "PIC-SIZE");
  EXPECT_THAT(none.error().message, HasSubstr("200 set-ups"));
  EXPECT_TRUE(png(plan, {"1"}).has_value());  // of its set-up alone
}

TEST(Picture, OfManyStepsNamesTheFirstAndCountsTheOthers) {
  model::Plan plan = pocket();
  const model::StepResult one = plan.steps[0];
  plan.steps.assign(kMostInLegend + 7, one);
  EXPECT_THAT(svg(plan, {}).value(), HasSubstr(">and 7 more</text>"));
}

}  // namespace
}  // namespace capstan::report::picture
