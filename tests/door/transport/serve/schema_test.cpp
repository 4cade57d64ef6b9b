// docs/serve.md names every endpoint, and what a server answers is as docs/serve.schema.json has it.

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
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

#include "planner/door/transport/serve/endpoints.h"
#include "planner/door/transport/serve/wire/http.h"
#include "tests/door/transport/serve/running_server.h"

namespace capstan::transport {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

/// What is wrong with a body that should be this definition of the schema; empty: nothing.
std::string faults(const std::string& definition, const std::string& body) {
  Json schema = Json::parse(testing::slurp(testing::source_dir() + "/docs/serve.schema.json"));
  schema["$ref"] = "#/definitions/" + definition;
  valijson::Schema made;
  valijson::SchemaParser parser(valijson::SchemaParser::kDraft7);
  parser.populateSchema(valijson::adapters::NlohmannJsonAdapter(schema), made);
  const Json json = Json::parse(body, nullptr, false);
  valijson::Validator validator;
  valijson::ValidationResults results;
  if (validator.validate(made, valijson::adapters::NlohmannJsonAdapter(json), &results)) return {};
  std::string out = body;
  for (valijson::ValidationResults::Error e; results.popError(e);) out += e.description + "\n";
  return out;
}

TEST(ServeDocument, NamesEveryEndpoint) {
  const std::string text = testing::slurp(testing::source_dir() + "/docs/serve.md");
  for (const Endpoint& e : Endpoints::all()) {
    std::string path;
    for (const char c : e.path)
      path += c == '*' ? (path.find("ID") == std::string::npos ? "ID" : "FORMAT") : std::string(1, c);
    EXPECT_THAT(text, HasSubstr("| " + std::string(e.method) + " | `" + path + "` |"));
  }
}

TEST(ServeSchema, KnowsWhatIsAnsweredAndNothingElse) {
  if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
  RunningServer server;
  Client client(server.socket());
  const auto answer = [&](const std::string& definition, const char* method, const std::string& path,
                          const std::string& body = {}) {
    const auto reply = client.ask(method, path, body);
    EXPECT_EQ(faults(definition, reply.body), "") << method << " " << path;
  };
  EXPECT_NE(faults("answer", "{}"), "");
  EXPECT_NE(faults("health", R"({"status": "ok", "sessions": 1, "more": 2})"), "");
  answer("health", "GET", "/health");
  answer("answer", "GET", "/nothing");
  Client wrong(server.socket());
  wrong.send("no HTTP\r\n\r\n");
  EXPECT_EQ(faults("answer", wrong.reply().body), "");
  answer("answer", "POST", "/v1/sessions", "no JSON");
  const std::string path = opened(client);
  answer("sessions", "GET", "/v1/sessions");
  answer("answer", "PUT", path + "/state", R"({"broadcast": {"at": "start", "wait_for_reply": "no"}})");
  answer("answer", "PUT", path + "/plan", plate());
  answer("open", "GET", path + "/open");
  answer("answer", "GET", path + "/no-longer-valid");
  answer("answer", "GET", path + "/unsuited");
  answer("answer", "POST", path + "/bind", R"({"deadline_ms": 600000})");
  answer("answer", "POST", path + "/bind", R"({"deadline_ms": 0})");
  answer("answer", "GET", path + "/result");
  answer("answer", "POST", path + "/measured", R"({"event": "start", "workingstep": "ROUGH POCKET"})");
  answer("answer", "POST", path + "/reply", R"({"reply_to": 1})");
  answer("answer", "POST", path + "/cancel");
  answer("answer", "DELETE", path);
}

}  // namespace
}  // namespace capstan::transport
