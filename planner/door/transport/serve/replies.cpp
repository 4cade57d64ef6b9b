#include "planner/door/transport/serve/replies.h"

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>

namespace capstan::transport {

using Json = nlohmann::ordered_json;
using service::Code;

namespace {

struct ReplyStatus {
  Code code;
  std::string_view status;
  unsigned http;
};
constexpr std::array kStatuses{
    ReplyStatus{Code::kDone, "OK", 200},
    ReplyStatus{Code::kUsage, "USAGE", 400},
    ReplyStatus{Code::kUnreadable, "UNREADABLE", 422},
    ReplyStatus{Code::kImpossible, "IMPOSSIBLE", 409},
    ReplyStatus{Code::kLate, "LATE", 504},
    ReplyStatus{Code::kFault, "FAULT", 500},
};
const ReplyStatus& reply_of(Code code) {
  const auto* at =
      std::find_if(kStatuses.begin(), kStatuses.end(), [&](const ReplyStatus& s) { return s.code == code; });
  return at == kStatuses.end() ? kStatuses.back() : *at;
}

std::string spelled(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

}  // namespace

std::string json_of(const std::string& text) { return spelled(text); }
std::string json_of(double value) { return spelled(value); }
std::string json_of(const std::vector<std::string>& texts) { return spelled(texts); }

std::string_view status_of(Code code) { return reply_of(code).status; }

HttpReply object_reply(unsigned status, const Members& members) {
  std::string body;
  for (const auto& [name, json] : members) body += (body.empty() ? "" : ",") + json_of(name) + ":" + json;
  return {.status = status, .body = "{" + body + "}\n"};
}

HttpReply of_call(Code code, const std::string& message, const Members& more, unsigned status) {
  Members members = {{"code", std::to_string(static_cast<int>(code))},
                     {"status", json_of(std::string(reply_of(code).status))},
                     {"message", json_of(message)}};
  members.insert(members.end(), more.begin(), more.end());
  return object_reply(status == 0 ? reply_of(code).http : status, members);
}

HttpReply refused(unsigned status, const Diagnostic& what) {
  return of_call(Code::kUsage, to_text(what) + "\n", {}, status);
}

HttpReply refused(unsigned status, std::string code, std::string message, std::string hint) {
  return refused(status, {.code = std::move(code), .message = std::move(message), .hint = std::move(hint)});
}

HttpReply no_session() { return refused(404, "SERVE-SESSION", "this user has no session of that name"); }

}  // namespace capstan::transport
