#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wshadow"
#pragma GCC diagnostic ignored "-Wpedantic"
#include <valijson/adapters/nlohmann_json_adapter.hpp>
#include <valijson/schema.hpp>
#include <valijson/schema_parser.hpp>
#include <valijson/validator.hpp>
#pragma GCC diagnostic pop

#include "planner/door/service/edits/edits_file.h"
#include "tests/support/corpus.h"

// docs/edits.schema.json says what the reader takes: each document is judged by both.

namespace capstan::service {
namespace {

class EditsSchema : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto document = nlohmann::json::parse(
        capstan::testing::slurp(capstan::testing::source_dir() + "/docs/edits.schema.json"));
    valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
    parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(document), schema_);
  }
  bool holds(const std::string& text) const {
    const auto tree = nlohmann::json::parse(text);
    valijson::Validator validator;
    return validator.validate(schema_, valijson::adapters::NlohmannJsonAdapter(tree), nullptr);
  }
  static bool is_read(const std::string& text) {
    Job job;
    return read_edits(text, "e.json", job).has_value();
  }
  valijson::Schema schema_;
};

std::string with(const std::string& edit) { return R"({"capstan_edits": 1, "edits": [)" + edit + "]}"; }

TEST_F(EditsSchema, HoldsForWhatIsRead) {
  for (const char* edit :
       {"", R"({"set": "tool=em8"})", R"({"set": "A/B/feed = 900.5"})", R"({"pin": "SLOT/tool"})",
        R"({"pin": "SLOT/depth=2"})", R"({"limit": "feed<=2000"})", R"({"limit": "P*/tool.diameter >= 3"})",
        R"({"forbid": "H?/operation=reaming"}, {"order": "A<B"})", R"({"set": "\"A=B\"/feed=900"})",
        R"({"order": "\"A<B\" < \"C\"" })"}) {
    EXPECT_TRUE(is_read(with(edit))) << edit;
    EXPECT_TRUE(holds(with(edit))) << edit;
  }
}

TEST_F(EditsSchema, RefusesWhatIsRefused) {
  for (const char* edit : {R"({"sett": "tool=em8"})", R"({"set": "tool"})", R"({"set": "tool.diameter=8"})",
                           R"({"pin": "feeds"})", R"({"limit": "feed>=20"})", R"({"limit": "depth<=2"})",
                           R"({"limit": "operation<=2"})", R"({"forbid": "feed=3"})", R"({"order": "A"})",
                           R"({"order": "A<B<C"})", "7", R"({"set": "tool=a", "pin": "tool"})", "{}"}) {
    EXPECT_FALSE(is_read(with(edit))) << edit;
    EXPECT_FALSE(holds(with(edit))) << edit;
  }
  for (const char* text : {"{}", R"({"capstan_edits": 2, "edits": []})", R"({"capstan_edits": 1})",
                           R"({"capstan_edits": 1, "edits": [], "more": 1})"}) {
    EXPECT_FALSE(is_read(text)) << text;
    EXPECT_FALSE(holds(text)) << text;
  }
}

}  // namespace
}  // namespace capstan::service
