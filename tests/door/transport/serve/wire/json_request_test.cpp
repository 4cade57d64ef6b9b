#include "planner/door/transport/serve/wire/json_request.h"

#include <gtest/gtest.h>

namespace capstan::transport {
namespace {

using Kind = Member::Kind;
const std::vector<Member> kMembers = {
    {Kind::kTexts, "options"}, {Kind::kText, "tool_table"}, {Kind::kWhole, "n"}};

TEST(JsonRequest, ReadsWhatIsKnown) {
  const auto read =
      read_json_request(R"({"options": {"a": "b"}, "tool_table": "T1", "n": 7})", kMembers, 1000);
  ASSERT_TRUE(read) << to_text(read.error());
  EXPECT_EQ(read->objects.at("options").at("a"), "b");
  EXPECT_EQ(read->texts.at("tool_table"), "T1");
  EXPECT_EQ(read->wholes.at("n"), 7U);
  EXPECT_TRUE(read_json_request("", kMembers, 1000));
}

TEST(JsonRequest, RefusesWithOneClearErrorWhatItDoesNotKnow) {
  const std::pair<std::string, const char*> wrong[] = {
      {R"({"colour": "red"})", "'colour' is not known here"},
      {R"({"n": -1})", "'n' is no whole number"},
      {R"({"n": 1.5})", "'n' is no whole number"},
      {R"({"n": 99999999999999999999})", "'n' is no whole number"},
      {R"({"n": 1, "n": 2})", "a name occurs twice"},
      {R"({"options": {"a": "b", "a": "c"}})", "a name occurs twice"},
      {R"({"options": {"a": 1}})", "'a' of 'options' is no text"},
      {R"({"options": []})", "'options' is no object"},
      {R"({"tool_table": null})", "'tool_table' is no text"},
      {R"([1])", "the JSON is no object"},
      {R"({"n": 1)", "the body is no JSON"},
      {R"({"n": 1e400})", "the body is no JSON"},
      {"\xff\xfe", "the body is no JSON"},
      {std::string(100'000, '['), "nested too deep"},
      {std::string(200'000, ' '), "the JSON has 200000 bytes"},
  };
  for (const auto& [body, what] : wrong) {
    const auto read = read_json_request(body, kMembers, 150'000);
    ASSERT_FALSE(read) << body.substr(0, 50);
    EXPECT_NE(read.error().message.find(what), std::string::npos) << read.error().message;
  }
}

}  // namespace
}  // namespace capstan::transport
