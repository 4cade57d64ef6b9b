#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/decision/unreadable.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// One wrong reference in a file: what needs it is not planned, everything else is.

namespace capstan::pipeline {
namespace {

const Inputs& shop() {
  static const Inputs one = [] {
    Job job;
    return load_shop({}, job).value();
  }();
  return one;
}

std::string example(const std::string& name) {
  const std::string path = capstan::testing::source_dir();
  return testing::slurp(path + "/examples/" + name);
}

struct Made {
  Job read, bound;
  model::Plan plan;
};

void plan_of(const std::string& text, Made& out) {
  auto read = read_plan(text, "part.p21", out.read);
  ASSERT_TRUE(read) << to_text(read.error());
  auto plan = bind(*std::move(read), shop(), {}, out.bound);
  ASSERT_TRUE(plan) << to_text(plan.error());
  out.plan = *std::move(plan);
}

bool has_step_of(const model::Plan& plan, const std::string& feature) {
  return std::any_of(plan.steps.begin(), plan.steps.end(), [&](const model::StepResult& s) {
    return model::step_id(plan, s).starts_with(feature);
  });
}

const model::Unplanned* unplanned(const model::Plan& plan, const std::string& feature) {
  for (const auto& u : plan.unplanned) {
    const auto* f = plan.model.get<model::ManufacturingFeature>(u.feature);
    if (f != nullptr && f->its_id == feature) return &u;
  }
  return nullptr;
}

/// The text with the first `from` replaced.
std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

// A pocket's boss is the project: the pocket without it would cut it away.
std::string with_wrong_boss() {
  return edited(example("bracket.p21"), "CLOSED_POCKET('POCKET',#4,(),#50,#53,(),",
                "CLOSED_POCKET('POCKET',#4,(),#50,#53,(#1),");
}

TEST(WrongReference, LeavesThePocketUnplannedWhoseBossItMightHaveBeen) {
  Made made;
  ASSERT_NO_FATAL_FAILURE(plan_of(with_wrong_boss(), made));
  const auto& all = made.read.diagnostics();
  const auto said = std::find_if(all.begin(), all.end(), [](const Diagnostic& d) {
    return d.code == "EXC-REFERENCE" && d.severity == Severity::kError;
  });
  ASSERT_NE(said, all.end());
  EXPECT_EQ(said->file, "part.p21");
  EXPECT_GT(said->line, 0u);
  EXPECT_GT(said->instance, 0u);
  EXPECT_NE(said->message.find("CLOSED_POCKET.its_boss points to #1"), std::string::npos) << said->message;
  EXPECT_EQ(said->expected, "BOSS");
  EXPECT_FALSE(has_step_of(made.plan, "POCKET"));
  const auto* u = unplanned(made.plan, "POCKET");
  ASSERT_NE(u, nullptr);
  EXPECT_NE(u->reason.find("its_boss"), std::string::npos) << u->reason;
  EXPECT_TRUE(has_step_of(made.plan, "SLOT"));
  EXPECT_TRUE(has_step_of(made.plan, "TOP FACE"));
}

TEST(WrongReference, StaysWrongInEachFormThatThePlanIsWrittenIn) {
  Made made;
  ASSERT_NO_FATAL_FAILURE(plan_of(with_wrong_boss(), made));
  for (const Format form : {Format::kJson, Format::kIso14649, Format::kAp238}) {
    SCOPED_TRACE(static_cast<int>(form));
    Job job;
    const auto text = write_plan(made.plan, form, job);
    ASSERT_TRUE(text);
    Made again;
    ASSERT_NO_FATAL_FAILURE(plan_of(*text, again));
    EXPECT_NE(unplanned(again.plan, "POCKET"), nullptr) << "the pocket without its boss is another";
    EXPECT_FALSE(has_step_of(again.plan, "POCKET"));
  }
}

TEST(WrongReference, KeepsTheFileFromBeingReadWhereThatIsAskedFor) {
  Job job;
  exchange::ReadOptions options;
  options.strict = true;
  EXPECT_FALSE(exchange::read_bytes(with_wrong_boss(), "part.p21", options, job));
}

// The mill's body is the project: neither roughing nor finishing with it is made, the holes are.
TEST(WrongReference, ToAToolLeavesItsStepUnplannedAndNoOther) {
  const std::string text = example("plate_bound.p21");
  Made sound, made;
  ASSERT_NO_FATAL_FAILURE(plan_of(text, sound));
  ASSERT_NO_FATAL_FAILURE(plan_of(
      edited(text, "MILLING_CUTTING_TOOL('END MILL 12',#57,", "MILLING_CUTTING_TOOL('END MILL 12',#1,"),
      made));
  EXPECT_LT(made.plan.steps.size(), sound.plan.steps.size());
  EXPECT_FALSE(made.plan.steps.empty());
  for (const auto& s : made.plan.steps)
    EXPECT_FALSE(model::step_id(made.plan, s).starts_with("POCKET")) << model::step_id(made.plan, s);
  EXPECT_TRUE(std::any_of(made.plan.unplanned.begin(), made.plan.unplanned.end(), [](const auto& u) {
    return u.reason.find("its_tool_body points to #1") != std::string::npos;
  }));
}

// Its placement is no placement: where the pocket lies is not known.
TEST(WrongReference, ToAPlacementLeavesItsFeatureUnplanned) {
  Made made;
  ASSERT_NO_FATAL_FAILURE(plan_of(
      edited(example("bracket.p21"), "CLOSED_POCKET('POCKET',#4,(),#50,", "CLOSED_POCKET('POCKET',#4,(),#1,"),
      made));
  EXPECT_FALSE(has_step_of(made.plan, "POCKET"));
  EXPECT_NE(unplanned(made.plan, "POCKET"), nullptr);
  EXPECT_TRUE(has_step_of(made.plan, "SLOT"));
}

// What the whole plan rests on: the piece's raw shape.
TEST(WrongReference, ToWhatTheWholePlanRestsOnIsNamedAndCondemnsThePlan) {
  const std::string text = example("bracket.p21");
  const auto at = text.find("=WORKPIECE(");
  ASSERT_NE(at, std::string::npos);
  const auto ref = text.find('#', text.find(',', text.find(',', at) + 1));  // its_rawpiece
  std::string wrong = text;
  wrong.replace(ref, text.find_first_of(",)", ref) - ref, "#1");
  Made made;
  plan_of(wrong, made);
  const auto said = made.read.take_diagnostics();
  EXPECT_TRUE(std::any_of(said.begin(), said.end(), [](const Diagnostic& d) {
    return d.severity == Severity::kError && d.message.find("WORKPIECE.its_rawpiece") != std::string::npos;
  }));
  const auto reasons = model::condemned(made.plan, {});
  EXPECT_TRUE(std::any_of(reasons.begin(), reasons.end(), [](const model::Condemnation& c) {
    return c.code == "PIP-UNREADABLE" && c.step.empty();
  }));
}

}  // namespace
}  // namespace capstan::pipeline
