#include "planner/door/transport/serve/wire/json_request.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <utility>

namespace capstan::transport {
namespace {

using Json = nlohmann::json;

constexpr int kDeepest = 8;  // no request needs more than three

tl::unexpected<Diagnostic> wrong(std::string what, std::string expected = {}) {
  return fail(
      {.code = "SERVE-JSON", .message = std::move(what), .file = "request", .expected = std::move(expected)});
}

/// Before it is read: what nests deeper takes memory and means nothing here.
bool too_deep(const std::string& text) {
  int depth = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c == '\\') ++i;
      if (c == '"') quoted = false;
    } else if (c == '"') {
      quoted = true;
    } else if (c == '{' || c == '[') {
      if (++depth > kDeepest) return true;
    } else if (c == '}' || c == ']') {
      --depth;
    }
  }
  return false;
}

std::string names_of(const std::vector<Member>& members) {
  std::string out;
  for (const Member& m : members) out += (out.empty() ? "" : ", ") + std::string(m.name);
  return out;
}

Status take(const Member& m, const Json& value, JsonRequest& out) {
  const std::string name = m.name;
  switch (m.kind) {
    case Member::Kind::kText:
      if (!value.is_string()) return wrong("'" + name + "' is no text", "a text");
      out.texts[name] = value.get<std::string>();
      return {};
    case Member::Kind::kWhole:
      if (!value.is_number_unsigned()) return wrong("'" + name + "' is no whole number", "0 or more");
      out.wholes[name] = value.get<std::uint64_t>();
      return {};
    case Member::Kind::kTexts:
    case Member::Kind::kValues:
      break;
  }
  if (!value.is_object()) return wrong("'" + name + "' is no object", "an object");
  auto& object = out.objects[name];
  for (const auto& [key, one] : value.items()) {
    if (m.kind == Member::Kind::kTexts && !one.is_string())
      return wrong("'" + key + "' of '" + name + "' is no text", "a text");
    object[key] = m.kind == Member::Kind::kTexts ? one.get<std::string>() : one.dump();
  }
  return {};
}

}  // namespace

Result<JsonRequest> read_json_request(const std::string& body, const std::vector<Member>& members,
                                      std::size_t most) {
  JsonRequest out;
  if (body.empty()) return out;
  if (body.size() > most)
    return wrong("the JSON has " + std::to_string(body.size()) + " bytes", "at most " + std::to_string(most));
  if (too_deep(body))
    return wrong("the JSON is nested too deep", "at most " + std::to_string(kDeepest) + " levels");
  std::vector<std::set<std::string>> names;
  std::string twice;
  const auto seen = [&](int /*depth*/, Json::parse_event_t event, Json& value) {
    if (event == Json::parse_event_t::object_start) names.emplace_back();
    if (event == Json::parse_event_t::object_end) names.pop_back();
    if (event == Json::parse_event_t::key && !names.back().insert(value.get<std::string>()).second)
      twice = value.get<std::string>();
    return true;
  };
  const Json json = Json::parse(body, seen, false);
  if (json.is_discarded()) return wrong("the body is no JSON", "an object with " + names_of(members));
  if (!twice.empty()) return wrong("a name occurs twice in one object: '" + twice + "'", "each once");
  if (!json.is_object()) return wrong("the JSON is no object", "an object with " + names_of(members));
  for (const auto& [name, value] : json.items()) {
    const auto member =
        std::find_if(members.begin(), members.end(), [&](const Member& m) { return name == m.name; });
    if (member == members.end()) return wrong("'" + name + "' is not known here", names_of(members));
    if (auto ok = take(*member, value, out); !ok) return tl::unexpected(ok.error());
  }
  return out;
}

}  // namespace capstan::transport
