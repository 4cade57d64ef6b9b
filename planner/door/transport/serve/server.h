#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/transport/serve/limits.h"
#include "planner/ground/base/result.h"

namespace capstan::transport {

/// The options of `capstan serve`.
struct ServeSettings {
  std::string socket;                ///< path of the UNIX socket
  std::vector<std::uint32_t> users;  ///< who may connect beside the server's own user
  /// Options that each session begins with, by name (service/options.h).
  std::vector<std::pair<std::string, std::string>> options;
  Limits limits;
};

/// Answers requests of HTTP/1.1 on a UNIX socket until `stop` (a file descriptor) can be read; then ends what
/// runs, answers it, and removes the socket. `ready` is called once, when requests are taken.
///
/// Who      the peer's user, as the kernel tells it (SO_PEERCRED), must be the server's own or one of
/// `users`;
///          another gets 403 and counts.
/// Threads  one for each connection, at most `limits.connections`, and `limits.workers`; signals are as the
///          caller has them blocked.
/// Fails    SERVE-BEAST: this build has no HTTP; SERVE-SOCKET.
[[nodiscard]] Status serve(const ServeSettings& settings, int stop, const std::function<void()>& ready);

}  // namespace capstan::transport
