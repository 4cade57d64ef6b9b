#pragma once

#include <chrono>
#include <cstddef>

namespace capstan::transport {

/// What a server takes at most; a request beyond it is refused, never cut. Defaults, unsourced.
struct Limits {
  std::size_t header_bytes = 8 << 10;
  std::size_t body_bytes = std::size_t{64} << 20;  ///< of a plan
  std::size_t json_bytes = std::size_t{1} << 20;   ///< of a request in JSON
  std::chrono::milliseconds request{10'000};       ///< from a request's first byte to its last
  std::chrono::milliseconds idle{60'000};          ///< between two requests of a connection
  std::chrono::milliseconds write{10'000};         ///< for the peer to take a piece of the reply
  std::chrono::milliseconds deadline{600'000};     ///< the longest that a bind may be given
  std::chrono::milliseconds reply{10'000};         ///< for a broadcast's reader to reply
  std::chrono::seconds session{3600};              ///< after so long without a request it is closed
  std::size_t connections = 64;
  std::chrono::milliseconds handshake{5'000};  ///< of TLS, from the connection to its end
  std::size_t half_open = 32;                  ///< connections of TCP whose peer is not known yet
  std::size_t queue = 16;                      ///< requests that wait for a worker
  unsigned workers = 1;                        ///< requests worked on at once
  std::size_t sessions = 16;                   ///< of all users
  std::size_t sessions_of_user = 8;            ///< of one
  std::size_t broadcast_lines = 1000;          ///< kept of a session for a reader that is not there yet
};

}  // namespace capstan::transport
