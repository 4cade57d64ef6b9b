#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/service/session.h"
#include "planner/door/transport/serve/broadcast_queue.h"
#include "planner/door/transport/serve/limits.h"
#include "planner/ground/base/result.h"

namespace capstan::transport {

using Clock = std::chrono::steady_clock;

/// The name of a user of this machine as a peer; a subject of a certificate never begins so.
[[nodiscard]] inline std::string peer_of_user(std::uint32_t user) { return "user " + std::to_string(user); }

/// How the last call of a session ended, for whoever asks while another call runs.
struct Ending {
  service::Code code = service::Code::kDone;
  std::string message;
  double machining_s = 0.0;
  bool bound = false;  ///< a plan can be fetched
};

/// A session of late binding that a server keeps for a peer.
struct ServedSession {
  std::string id;
  std::string owner;   ///< the peer who opened it
  std::string folder;  ///< private to the server, for what a session reads from files
  service::Session session;
  std::string plan;   ///< as it was brought
  std::mutex in_use;  ///< of `session` and `plan`: held for a call, but for `session.stop`
  std::mutex ended;   ///< of `ending`
  Ending ending;
  BroadcastQueue broadcasts;
  Clock::time_point used;  ///< guarded by Sessions
};

/// The sessions of a server: bounded, each with an owner, closed when nobody asks for them any more.
///
/// Thread safety  any thread.
class Sessions {
 public:
  /// `folder`: for what sessions read from files; made with the first, and removed with what is in it.
  Sessions(const Limits& limits, std::string folder) : limits_(limits), folder_(std::move(folder)) {}
  Sessions(const Sessions&) = delete;
  Sessions& operator=(const Sessions&) = delete;
  ~Sessions();

  /// Fails  SERVE-SESSIONS: too many are open, of this user or in all; SERVE-FOLDER.
  [[nodiscard]] Result<std::shared_ptr<ServedSession>> open(const std::string& owner, Clock::time_point now);
  /// That session of this peer; null when there is none. Another peer's is none.
  [[nodiscard]] std::shared_ptr<ServedSession> find(const std::string& id, const std::string& peer,
                                                    Clock::time_point now);
  /// Ends what runs in it, and forgets it.
  void close(const ServedSession& session);
  /// Ends what runs in any.
  void stop_all();
  [[nodiscard]] std::vector<std::string> ids_of(const std::string& peer) const;
  [[nodiscard]] std::size_t count() const;

 private:
  void forget_unused(Clock::time_point now);

  Limits limits_;
  mutable std::mutex mutex_;
  std::map<std::string, std::shared_ptr<ServedSession>> all_;
  std::uint64_t last_ = 0;
  std::string folder_;
};

}  // namespace capstan::transport
