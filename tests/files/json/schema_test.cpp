#include <gtest/gtest.h>

#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validation_results.hpp>
#include <valijson/validator.hpp>
#pragma GCC diagnostic pop

#include "planner/files/json/json.h"
#include "planner/ground/base/file.h"
#include "tests/files/json/filler.h"
#include "tests/support/corpus.h"
#include "tests/support/empty_plan.h"

namespace capstan::json {
namespace {

class PlanSchema : public ::testing::Test {
 protected:
  void SetUp() override {
    document_ = nlohmann::json::parse(json_schema());
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document_), schema_);
  }
  std::string faults(const std::string& plan) {
    const nlohmann::json tree = nlohmann::json::parse(plan);
    valijson::Validator validator;
    valijson::ValidationResults results;
    std::string out;
    if (validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(tree), &results)) return out;
    valijson::ValidationResults::Error error;
    while (results.popError(error)) {
      for (const std::string& place : error.context) out += place;
      out += ": " + error.description + "\n";
    }
    return out.empty() ? "invalid" : out;
  }
  nlohmann::json document_;
  valijson::Schema schema_;
};

TEST_F(PlanSchema, HoldsForWrittenPlans) {
  EXPECT_EQ(faults(write_json(testing::empty_plan())), "");
  EXPECT_EQ(faults(write_json(json::Filler(7, 1.0).plan(1))), "");
  EXPECT_EQ(faults(write_json(json::Filler(8, 0.5).plan(2))), "");
}

TEST_F(PlanSchema, DoesNotHoldForOtherDocuments) {
  const std::string good = write_json(testing::empty_plan());
  const auto with = [&](const std::string& what, const std::string& by) {
    std::string text = good;
    const auto at = text.find(what);
    EXPECT_NE(at, std::string::npos);
    return faults(text.replace(at, what.size(), by));
  };
  EXPECT_NE(with("\"teeth\":0", "\"teeth\":\"0\""), "");
  EXPECT_NE(with("\"teeth\":0", "\"tooth\":0"), "");
  EXPECT_NE(with("\"endmill\"", "\"end mill\""), "");
  EXPECT_NE(with("\"capstan_plan\":1", "\"capstan_plan\":2"), "");
  EXPECT_NE(with("\"project:1\"", "\"plane:1\""), "");
  EXPECT_NE(faults("{}"), "");
}

/// Calls `each` with the name and the schema of every number in a schema; items have their list's name.
template <class F>
void each_number(const nlohmann::json& schema, const std::string& name, const F& each) {
  if (!schema.is_object()) return;
  const auto type = schema.find("type");
  if (type != schema.end() && *type == "number") each(name, schema);
  for (const auto& item : schema.items()) {
    if (item.key() == "properties")
      for (const auto& field : item.value().items()) each_number(field.value(), field.key(), each);
    else
      each_number(item.value(), item.key() == "items" ? name : item.key(), each);
  }
}

TEST_F(PlanSchema, SaysTheUnitOfEveryNumber) {
  std::size_t seen = 0;
  std::map<std::string, std::set<std::string>> said;
  each_number(document_, "", [&](const std::string& name, const nlohmann::json& schema) {
    ++seen;
    EXPECT_FALSE(schema.value("description", "").empty()) << name;
    said[name].insert(schema.value("description", ""));
  });
  EXPECT_GT(seen, 300U);
  using Words = std::set<std::string>;
  EXPECT_EQ(said["cutting_diameter_mm"], Words{"mm"});
  EXPECT_EQ(said["feed_mm_min"], Words{"mm/min"});
  EXPECT_EQ(said["removed_mm3"], Words{"mm3"});
  EXPECT_EQ(said["ktc_n_mm2"], Words{"N/mm2"});
  EXPECT_EQ(said["kte_n_mm"], Words{"N/mm"});
  EXPECT_EQ(said["torque_nm"], Words{"Nm"});
  EXPECT_EQ(said["peak_force_n"], Words{"N"});
  EXPECT_EQ(said["tool_life_min"], Words{"min"});
  EXPECT_EQ(said["rpm_min"], Words{"1/min"});  // the least speed, no minutes
  EXPECT_EQ(said["cutting_s"], Words{"s"});
  EXPECT_EQ(said["point_angle_rad"], Words{"rad"});
  EXPECT_EQ(said["depth_of_step"], Words{"mm"});
}

TEST_F(PlanSchema, SaysTheUnitOfANameThatSeveralThingsHaveByWhoseItIs) {
  const auto description = [&](const char* place) {
    return document_.at(nlohmann::json::json_pointer(place)).value("description", "");
  };
  const std::string word =
      description("/properties/cutters/items/properties/table_line/properties/words/items/properties/value");
  EXPECT_EQ(word, "mm of lengths; other numbers as the tool table writes them");
  EXPECT_EQ(description("/properties/steps/items/properties/active/items/properties/value"),
            "in the unit that stands beside it (unit)");
  EXPECT_EQ(description("/definitions/nc_constant/properties/its_value"), "as the program uses it");
  EXPECT_EQ(description("/definitions/surface_texture_parameter/properties/its_value"),
            "in the unit of its parameter (parameter_name)");
}

// Run with CAPSTAN_UPDATE=1 in the environment after the model has changed.
TEST(PlanSchemaFile, IsCurrent) {
  const std::string path = capstan::testing::source_dir() + "/docs/plan.schema.json";
  if (std::getenv("CAPSTAN_UPDATE") != nullptr) {
    ASSERT_TRUE(write_file(path, json_schema()));
  }
  EXPECT_TRUE(testing::slurp(path) == json_schema())
      << "run json_test with CAPSTAN_UPDATE=1 to renew " << path;
}

}  // namespace
}  // namespace capstan::json
