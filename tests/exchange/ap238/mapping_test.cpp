#include "planner/exchange/ap238/mapping.h"

#include <array>

#include "planner/exchange/ap238/codecs.h"
#include "tests/exchange/ap238/support.h"

namespace capstan::exchange::ap238 {
namespace {

TEST(MappingTables, AreWellFormedAndNameOnlyWhatExists) { EXPECT_NO_THROW((void)Mapping::instance()); }

TEST(MappingTables, NameAttributesThatTheNounOrOneBelowItHas) {
  for (const Row& row : Mapping::instance().rows()) {
    if (row.attribute.empty()) continue;
    bool any = false;
    for (std::size_t t = 1; t < model::kTypeCount && !any; ++t) {
      const auto type = static_cast<model::TypeId>(t);
      any = model::is_a(type, row.noun) && model::find_attribute(type, row.attribute.front()) != nullptr;
    }
    EXPECT_TRUE(any) << row.place << ": no attribute " << row.attribute.front();
    if (!row.codec.empty()) {
      EXPECT_NE(find_codec(row.codec), nullptr) << row.place;
    }
  }
}

TEST(MappingTables, RefuseWhatTheyDoNotKnow) {
  const auto parse = [](const std::string& text) {
    const std::array<std::pair<std::string, std::string>, 1> tables{std::pair("t.map", text)};
    return Mapping(tables);
  };
  EXPECT_THROW(parse("object NO_SUCH_NOUN = machining_workplan"), std::logic_error);
  EXPECT_THROW(parse("object WORKPLAN = no_such_entity"), std::logic_error);
  EXPECT_THROW(parse("row WORKPLAN its_id = <machining_workplan.no_such_attribute"), std::logic_error);
  EXPECT_THROW(parse("row WORKPLAN its_id .name"), std::logic_error);
  EXPECT_NO_THROW(parse("object WORKPLAN = machining_workplan\nrow WORKPLAN its_id = .action_method.name"));
}

TEST(Exchange, AnEmptyProjectComesBackEqual) {
  Bench bench;
  bench.plan.model.at<model::Workplan>(bench.workplan)
      .its_elements.push_back(bench.plan.model.add<model::Workplan>({}));
  EXPECT_EQ(lost_on_the_way(bench.plan), "");
}

}  // namespace
}  // namespace capstan::exchange::ap238
