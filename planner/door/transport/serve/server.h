#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/transport/serve/limits.h"
#include "planner/door/transport/serve/wire/tls.h"
#include "planner/ground/base/result.h"

namespace capstan::transport {

/// The options of `capstan serve`. A socket, an address of TCP, or both.
struct ServeSettings {
  std::string socket;                ///< path of the UNIX socket; empty: none
  std::string tcp;                   ///< address of TCP (wire/tcp_listener.h); empty: none
  TlsFiles tls;                      ///< of TCP, all three
  std::vector<std::uint32_t> users;  ///< who may connect beside the server's own user
  /// Options that each session begins with, by name (service/options.h).
  std::vector<std::pair<std::string, std::string>> options;
  Limits limits;
  /// A line for each peer of TCP that connects or is refused; of many that are refused at once some lines
  /// are left out, and counted. Called by any thread, one at a time.
  /// False: it could not be written, and is counted.
  std::function<bool(const std::string& line)> log = {};
};

/// Where a server answers.
struct Serving {
  std::string socket, tcp;  ///< `tcp`: with the port that it has
};

/// Answers requests of HTTP/1.1 on a UNIX socket and over TCP until `stop` (a file descriptor) can be read;
/// then ends what runs, answers it, and removes the socket. `ready` is called once, when requests are taken.
///
/// Who      of the socket: the peer's user, as the kernel tells it (SO_PEERCRED), must be the server's own or
///          one of `users`; another gets 403 and counts. Of TCP: whose certificate is verified (wire/tls.h)
///          before a byte of a request is read; another gets an alert of TLS and counts.
/// Half open  a peer of TCP that is not known yet counts among `limits.half_open`, not among the connections;
///          where those are all taken, the oldest gives way, so that who is quick is served. Where those who
///          give way are as many again, others wait outside until one is gone; nobody else waits for that.
/// Threads  one for each connection, at most `limits.connections` and twice `limits.half_open`, and
///          `limits.workers`; signals are as the caller has them blocked.
/// Fails    SERVE-BEAST: this build has no HTTP; SERVE-SOCKET; SERVE-TCP; SERVE-TLS.
[[nodiscard]] Status serve(const ServeSettings& settings, int stop,
                           const std::function<void(const Serving&)>& ready);

}  // namespace capstan::transport
