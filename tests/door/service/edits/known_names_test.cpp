#include "planner/door/service/edits/known_names.h"

#include <gtest/gtest.h>

#include "planner/model/plan/edit/edit.h"

namespace capstan::service {
namespace {

model::Edit edit(model::EditKind kind, const char* text) { return *model::parse_edit(kind, text, "--x"); }

TEST(KnownNames, AreLookedUpBeforeAnythingIsPlanned) {
  model::Cutter em;
  em.id = "em8";
  const std::vector<model::Cutter> library = {em};
  const model::Plan plan;
  using model::EditKind;
  EXPECT_TRUE(known_names({edit(EditKind::kSet, "tool=em8"), edit(EditKind::kForbid, "tool=em*"),
                           edit(EditKind::kForbid, "operation=*_rough_milling"),
                           edit(EditKind::kForbid, "strategy=constant_engagement"),
                           edit(EditKind::kSet, "HOLE*/cycles=explicit")},
                          library, plan));
  const auto tool = known_names({edit(EditKind::kSet, "tool=em9")}, library, plan);
  ASSERT_FALSE(tool);
  EXPECT_EQ(tool.error().code, "NAME-UNKNOWN");
  EXPECT_NE(tool.error().message.find("Did you mean 'em8'?"), std::string::npos) << tool.error().message;
  const auto operation = known_names({edit(EditKind::kForbid, "operation=reeming")}, library, plan);
  ASSERT_FALSE(operation);
  EXPECT_NE(operation.error().message.find("'reaming'"), std::string::npos) << operation.error().message;
  EXPECT_EQ(known_names({edit(EditKind::kForbid, "strategy=zigzag")}, library, plan).error().code,
            "NAME-UNKNOWN");
  EXPECT_EQ(known_names({edit(EditKind::kSet, "cycles=explicitly")}, library, plan).error().code,
            "NAME-UNKNOWN");
}

// The numbers of tools that no list numbers are known once the plan is made.
TEST(KnownNames, ATNumberIsSetWhereThePlanWillHaveItAndNotForbidden) {
  model::Cutter em;
  em.id = "em8";
  using model::EditKind;
  EXPECT_TRUE(known_names({edit(EditKind::kSet, "tool=T5")}, {em}, {}));
  EXPECT_EQ(known_names({edit(EditKind::kForbid, "tool=T5")}, {em}, {}).error().code, "EDIT-NUMBER");
  em.pocket = 5;
  EXPECT_TRUE(known_names({edit(EditKind::kForbid, "tool=T5")}, {em}, {}));
  EXPECT_EQ(known_names({edit(EditKind::kSet, "tool=T6")}, {em}, {}).error().code, "NAME-UNKNOWN");
}

// A number belongs to one table: the library's, else the plan's.
TEST(ToolNames, StandForTheNumbersOfToolsThatAreForbidden) {
  using model::EditKind;
  model::Cutter here, there;
  here.id = "here";
  there.id = "there";
  here.pocket = there.pocket = 5;
  model::Plan plan;
  plan.cutters = {there};
  const auto named = [&](const char* text, const std::vector<model::Cutter>& library) {
    return with_tool_names({edit(EditKind::kForbid, text)}, library, plan).front();
  };
  EXPECT_EQ(text_of(named("SLOT/tool=T5", {here})), "SLOT/tool=here");
  here.pocket = 0;
  EXPECT_EQ(text_of(named("SLOT/tool=T5", {here})), "SLOT/tool=there");
  EXPECT_EQ(words_of(named("SLOT/tool=T5", {here})), "--x (T5): forbid SLOT/tool=there");
  here.id = "T5";
  EXPECT_EQ(text_of(named("tool=T5", {here})), "tool=T5") << "a name is none";
  EXPECT_EQ(text_of(named("tool=T6", {here})), "tool=T6");
}

}  // namespace
}  // namespace capstan::service
