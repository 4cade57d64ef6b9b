#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/door/service/code.h"
#include "planner/door/transport/serve/wire/http.h"
#include "planner/ground/base/result.h"

/// @file Answers in JSON: docs/serve.schema.json has their members.

namespace capstan::transport {

/// Members of an object: names, and values that are JSON already.
using Members = std::vector<std::pair<std::string, std::string>>;

/// A text as JSON; bytes that are no UTF-8 become U+FFFD.
[[nodiscard]] std::string json_of(const std::string& text);
[[nodiscard]] std::string json_of(double value);
[[nodiscard]] std::string json_of(const std::vector<std::string>& texts);

/// "OK", "LATE", ...: a code as capstan_late.h has it, without CAPSTAN_LATE_.
[[nodiscard]] std::string_view status_of(service::Code code);

[[nodiscard]] HttpReply object_reply(unsigned status, const Members& members);
/// How a call ended: its code and words, and more. `status`: 0: that of the code, 400 or above for all but
/// OK.
[[nodiscard]] HttpReply of_call(service::Code code, const std::string& message, const Members& more = {},
                                unsigned status = 0);
/// A request that is refused before a session sees it: USAGE, with what is wrong.
[[nodiscard]] HttpReply refused(unsigned status, const Diagnostic& what);
[[nodiscard]] HttpReply refused(unsigned status, std::string code, std::string message,
                                std::string hint = {});
/// 404: this user has no session of that name.
[[nodiscard]] HttpReply no_session();

}  // namespace capstan::transport
