#include "planner/files/json/json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "planner/files/json/printer.h"
#include "planner/ground/base/file.h"
#include "planner/model/nouns/all.h"
#include "tests/files/json/filler.h"
#include "tests/support/empty_plan.h"

namespace capstan::json {
namespace {

using model::Plan;
using ::testing::HasSubstr;

Result<Plan> read(const std::string& bytes) {
  Job job;
  return read_json(bytes, "plan.json", job);
}

std::string again(const std::string& bytes) {
  const auto plan = read(bytes);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  return plan ? write_json(*plan) : "";
}

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const auto at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

TEST(PlanJson, OfAPlanThatFillsEverythingIsReadBackWhole) {
  const Plan plan = json::Filler(1, 1.0).plan(2);
  const std::string bytes = write_json(plan);
  EXPECT_EQ(again(bytes), bytes);
}

TEST(PlanJson, GivesEveryAttributeOfEveryObjectBack) {
  const Plan plan = json::Filler(2, 1.0).plan(2);
  const auto back = read(write_json(plan));
  ASSERT_TRUE(back) << to_text(back.error());
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<model::TypeId>(t);
    ASSERT_EQ(back->model.count(type), plan.model.count(type));
    for (const model::AnyRef r : plan.model.all(type)) {
      EXPECT_EQ(back->model.origin(r), plan.model.origin(r));
      for (const model::Attribute& a : model::noun_type(type).attributes) {
        EXPECT_EQ(hash_attribute(back->model, r, a.name), hash_attribute(plan.model, r, a.name)) << a.name;
        EXPECT_EQ(has_value(a, back->model.object(r)), has_value(a, plan.model.object(r))) << a.name;
      }
    }
  }
  EXPECT_EQ(back->machine, plan.machine);
  EXPECT_EQ(back->material, plan.material);
  EXPECT_EQ(back->cutters, plan.cutters);
  EXPECT_EQ(back->provenance, plan.provenance);
  EXPECT_EQ(back->kept, plan.kept);
  EXPECT_EQ(back->file_name, plan.file_name);
  ASSERT_EQ(back->steps.size(), plan.steps.size());
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    EXPECT_EQ(*back->steps[i].path, *plan.steps[i].path);
    EXPECT_EQ(*back->steps[i].schedule, *plan.steps[i].schedule);
    EXPECT_EQ(*back->steps[i].sections, *plan.steps[i].sections);
    EXPECT_EQ(back->steps[i].loads, plan.steps[i].loads);
    EXPECT_EQ(back->steps[i].active, plan.steps[i].active);
  }
  ASSERT_EQ(back->ledger.entries().size(), plan.ledger.entries().size());
  EXPECT_EQ(back->ledger.reasons(), plan.ledger.reasons());
  for (const auto& [key, d] : plan.ledger.entries()) {
    const model::Decision* other = back->ledger.find(key.object, key.attribute);
    ASSERT_NE(other, nullptr);
    EXPECT_EQ(other->state, d.state);
    EXPECT_EQ(other->binder, d.binder);
    EXPECT_EQ(other->pinned, d.pinned);
    EXPECT_EQ(other->reason, d.reason);
    EXPECT_EQ(other->lexeme, d.lexeme);
    EXPECT_EQ(other->value_hash, model::hash_attribute(plan.model, key.object, key.attribute));
    EXPECT_EQ(other->depends_on, d.depends_on);
    EXPECT_EQ(other->rejected, d.rejected);
  }
}

TEST(PlanJsonProperty, AnyPlanIsReadBackToTheSameBytes) {
  for (unsigned seed = 10; seed < 40; ++seed) {
    const std::string bytes = write_json(json::Filler(seed, 0.05 * (seed % 20)).plan(1 + seed % 3));
    ASSERT_EQ(again(bytes), bytes) << seed;
  }
}

TEST(PlanJson, WithoutSectionsIsThePlanWithoutThem) {
  const model::Plan plan = json::Filler(5, 1.0).plan(2);
  ASSERT_TRUE(std::ranges::any_of(plan.steps, [](const auto& s) { return s.sections != nullptr; }));
  const std::string bytes = write_json(plan, {.sections = true});
  Job job;
  const auto back = read_json(bytes, "plan.json", job);
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(job.count(Severity::kWarning), 0U);  // nobody edited it
  for (const auto& step : back->steps) EXPECT_EQ(step.sections, nullptr);
  EXPECT_EQ(write_json(*back), write_json(without_sections(plan)));
}

TEST(PlanJson, TellsWhatWasEditedOfWhatFollowsForAStep) {
  const model::Plan plan = json::Filler(5, 1.0).plan(1);
  std::string bytes = write_json(plan);
  const auto at = bytes.find("\"tool_number\"");
  ASSERT_NE(at, std::string::npos);
  const auto colon = bytes.find(':', at), end = bytes.find_first_of(",\n}", colon);
  bytes.replace(colon + 1, end - colon - 1, "9999");
  Job job;
  const auto back = read_json(bytes, "plan.json", job);
  ASSERT_TRUE(back) << to_text(back.error());
  ASSERT_EQ(job.count(Severity::kWarning), 1U);
  EXPECT_NE(job.diagnostics().back().message.find("what follows for step"), std::string::npos)
      << to_text(job.diagnostics().back());
}

TEST(PlanJson, KnowsEveryFieldOfThePlansStructs) {
  // A field added to one of these must be named in fields.h, too; then correct the size here.
#if defined(__x86_64__) && defined(__GLIBCXX__) && !defined(_GLIBCXX_DEBUG)
  EXPECT_EQ(sizeof(model::Cutter), 680U);
  EXPECT_EQ(sizeof(model::Machine), 704U);
  EXPECT_EQ(sizeof(model::WorkMaterial), 216U);
  EXPECT_EQ(sizeof(model::StepResult), 384U);
  EXPECT_EQ(sizeof(model::SetupResult), 240U);
  EXPECT_EQ(sizeof(model::Decision), 96U);
  EXPECT_EQ(sizeof(Plan) - sizeof(model::Model) - sizeof(model::Ledger), 1328U);
#else
  GTEST_SKIP() << "sizes are known for x86-64 with libstdc++ only";
#endif
}

TEST(PlanJson, SharesAPathThatTwoStepsRun) {
  Plan plan = testing::empty_plan();
  model::CutterPath path;
  path.start({0, 0, 5});
  path.line({1, 0, 5}, model::MoveRole::kCut);
  testing::add_step(plan, "a", "em18", path);
  plan.steps.push_back(plan.steps[0]);
  const std::string bytes = write_json(plan);
  EXPECT_THAT(bytes, HasSubstr("\"kind\":\"RL\""));
  const auto back = read(bytes);
  ASSERT_TRUE(back);
  EXPECT_EQ(back->steps[0].path, back->steps[1].path);
}

TEST(PlanJson, NamesThePlaceOfAFault) {
  Plan plan = testing::empty_plan();
  plan.model.add(model::RoundHole{});
  plan.model.add(model::Plane{});
  model::CutterPath path;
  path.start({0, 0, 5});
  testing::add_step(plan, "a", "em18", path);
  const std::string good = write_json(plan);
  const auto fault = [&](const std::string& what, const std::string& by) {
    const auto r = read(replaced(good, what, by));
    return r ? "accepted" : r.error().code + " " + r.error().path;
  };
  EXPECT_EQ(fault("\"teeth\":0", "\"teeth\":0.5"), "JSON-VALUE /cutters/0/teeth");
  EXPECT_EQ(fault("\"teeth\":0", "\"teeth\":4294967296"), "JSON-VALUE /cutters/0/teeth");
  EXPECT_EQ(fault("\"teeth\":0,", ""), "JSON-VALUE /cutters/0/teeth");
  EXPECT_EQ(fault("\"teeth\":0", "\"teeth\":0,\"tooth\":1"), "JSON-VALUE /cutters/0/tooth");
  EXPECT_EQ(fault("\"endmill\"", "\"end mill\""), "JSON-VALUE /cutters/0/cutter_class");
  EXPECT_EQ(fault("\"project\":\"project:1\"", "\"project\":\"project:2\""), "JSON-VALUE /project");
  EXPECT_EQ(fault("\"project\":\"project:1\"", "\"project\":\"plane:1\""), "JSON-VALUE /project");
  EXPECT_EQ(fault("\"@id\":\"round_hole:1\"", "\"@id\":\"round_hole:1\",\"depth\":\"project:1\""),
            "JSON-VALUE /objects/round_hole/0/depth");
  EXPECT_EQ(fault("\"@id\":\"round_hole:1\"", "\"@id\":\"round_hole:1\",\"deep\":1"),
            "JSON-VALUE /objects/round_hole/0/deep");
  EXPECT_EQ(fault("\"@id\":\"round_hole:1\"", "\"@id\":\"round_hole:7\""),
            "JSON-VALUE /objects/round_hole/0/@id");
  EXPECT_EQ(fault("\"round_hole\":[", "\"machining_feature\":["), "JSON-VALUE /objects/machining_feature");
  EXPECT_EQ(fault("\"path\":\"path:1\"", "\"path\":\"path:2\""), "JSON-VALUE /steps/0/path");
  EXPECT_EQ(fault("\"kind\":\"R\"", "\"kind\":\"RR\""), "JSON-VALUE /paths/0");
  EXPECT_EQ(fault("\"kind\":\"R\"", "\"kind\":\"?\""), "JSON-VALUE /paths/0/kind");
  EXPECT_EQ(fault("\"capstan_plan\":1", "\"capstan_plan\":2"), "JSON-VERSION ");
  EXPECT_EQ(fault("\"teeth\":0", "\"teeth\":1e999"), "JSON-SYNTAX ");
}

TEST(PlanJson, RefusesHostileFiles) {
  EXPECT_EQ(read(std::string(100000, '[')).error().code, "JSON-DEPTH");
  EXPECT_EQ(read("").error().code, "JSON-SYNTAX");
  EXPECT_EQ(read("{\n\n\"a\":}").error().line, 3U);
  EXPECT_EQ(read("[]").error().code, "JSON-VERSION");
  EXPECT_EQ(read("{\"capstan_plan\":1}").error().code, "JSON-VALUE");
  EXPECT_EQ(read("\"\\").error().code, "JSON-SYNTAX");
  Job job;
  EXPECT_EQ(read_json(std::string(11, ' '), "x", job, 10).error().code, "JSON-SIZE");
  // Cut anywhere, a plan is refused, never half read.
  const std::string whole = write_json(json::Filler(3, 0.3).plan(1));
  for (std::size_t n = 0; n + 2 < whole.size(); n += 1 + whole.size() / 200) {
    EXPECT_FALSE(read(whole.substr(0, n))) << n;
  }
}

TEST(PlanJson, RefusesToWriteWhatIsNoNumber) {
  Plan plan = testing::empty_plan();
  plan.cutters[0].cutting_diameter_mm = std::nan("");
  EXPECT_THROW((void)write_json(plan), std::logic_error);
}

TEST(JsonText, KeepsEveryByte) {
  for (int a = 0; a < 256; ++a) {
    for (int b = 0; b < 256; ++b) {
      const std::string bytes = {static_cast<char>(a), static_cast<char>(b), 'x'};
      const std::string text = json::quoted(bytes);
      if (text.find('\\') == std::string::npos) {
        EXPECT_EQ(json::unquoted_bytes(text.substr(1, text.size() - 2)), bytes);
      }
    }
  }
  EXPECT_EQ(json::quoted("a\"\\\n\xC3\xBC"), "\"a\\\"\\\\\\u000a\xC3\xBC\"");
}

}  // namespace
}  // namespace capstan::json
