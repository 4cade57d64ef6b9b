#include "planner/files/exchange/ap238/tables/mapping.h"

#include <array>
#include <set>

#include "planner/files/exchange/ap238/codecs/codecs.h"
#include "tests/files/exchange/ap238/support.h"

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

/// What a row's attribute may be, whichever of the kinds below its noun has it.
std::vector<const model::Attribute*> attributes_of(const Row& row) {
  const auto below = [](model::TypeId ancestor, std::vector<model::TypeId>& out) {
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      const auto type = static_cast<model::TypeId>(t);
      if (model::is_a(type, ancestor)) out.push_back(type);
    }
  };
  std::vector<model::TypeId> holders;
  below(row.noun, holders);
  std::vector<const model::Attribute*> out;
  for (std::size_t i = 0; i < row.attribute.size(); ++i) {
    out.clear();
    std::vector<model::TypeId> next;
    for (const auto type : holders) {
      const model::Attribute* a = model::find_attribute(type, row.attribute[i]);
      if (a == nullptr) continue;
      out.push_back(a);
      if (i + 1 == row.attribute.size()) continue;
      if (row.only[i] != model::TypeId::kNone) {
        below(row.only[i], next);
      } else {
        for (const auto target : a->targets) below(target, next);
      }
    }
    holders = std::move(next);
  }
  return out;
}

TEST(MappingTables, HaveATextForEveryTruthValueAndEnumerator) {
  std::size_t booleans = 0, enumerations = 0;
  for (const Row& row : Mapping::instance().rows()) {
    if (row.attribute.empty() || !row.codec.empty()) continue;
    for (const model::Attribute* a : attributes_of(row)) {
      if (a->storage == model::Storage::kBoolean) {
        ++booleans;
        const bool plain = row.texts.empty() && !row.value_of.empty();  // the attribute is a Boolean, too
        EXPECT_TRUE(plain || row.texts.size() == 2) << row.place << ": " << a->name;
      } else if (a->storage == model::Storage::kEnum) {
        ++enumerations;
        EXPECT_EQ(row.texts.size(), a->enumerators.size()) << row.place << ": " << a->name;
      } else {
        continue;
      }
      const std::set<std::string> distinct(row.texts.begin(), row.texts.end());
      EXPECT_EQ(distinct.size(), row.texts.size()) << row.place << ": one text for two values";
    }
  }
  EXPECT_GT(booleans, 50U);
  EXPECT_GT(enumerations, 10U);
}

TEST(MappingTables, NeedCodeOnlyWhereTheyNameIt) {
  for (const Row& row : Mapping::instance().rows()) {
    if (row.attribute.empty()) continue;
    const auto kinds = attributes_of(row);
    EXPECT_FALSE(kinds.empty()) << row.place << ": leads to no attribute";
    if (!row.codec.empty()) continue;
    for (const model::Attribute* a : kinds) {
      const bool table = a->storage == model::Storage::kRefTable ||
                         a->storage == model::Storage::kRealTable || a->storage == model::Storage::kPath;
      EXPECT_FALSE(table) << row.place << ": " << a->name << " needs a codec";
      const bool number = a->storage == model::Storage::kReal || a->storage == model::Storage::kRealList ||
                          a->storage == model::Storage::kInteger ||
                          a->storage == model::Storage::kIntegerList;
      EXPECT_TRUE(row.texts.empty() || !number) << row.place << ": texts for a number";
    }
    if (!row.written) continue;
    // Always kept as they are: they say themselves what they refer to, and the writer makes nothing there.
    if (row.attribute.back() == "its_styled_models") continue;
    // What stands at the end is made by the value; what is on the way there by the tables.
    const std::size_t made = row.steps.size() - (row.value_of.empty() && !row.steps.empty() ? 1 : 0);
    for (std::size_t k = 0; k < made; ++k)
      EXPECT_FALSE(row.steps[k].entities.empty())
          << row.place << ": nothing to make at " << row.steps[k].attribute;
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
