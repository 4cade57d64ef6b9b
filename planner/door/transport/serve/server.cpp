#include "planner/door/transport/serve/server.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <condition_variable>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <system_error>
#include <thread>
#include <utility>

#include "planner/door/transport/serve/endpoints.h"
#include "planner/door/transport/serve/half_open.h"
#include "planner/door/transport/serve/peer_log.h"
#include "planner/door/transport/serve/replies.h"
#include "planner/door/transport/serve/wire/connection.h"
#include "planner/door/transport/serve/wire/http.h"
#include "planner/door/transport/serve/wire/socket_file.h"
#include "planner/door/transport/serve/wire/tcp_listener.h"
#include "planner/door/transport/serve/wire/tls.h"
#include "planner/door/transport/serve/workers.h"

// Connections, each with a thread that reads requests and sends replies; the work itself is done by few
// workers behind a bounded queue. A thread that waits for a worker sees its peer go, and ends the work.
// A connection of TCP is none of them before its peer is known.

namespace capstan::transport {
namespace {

/// A file descriptor that can be read once it was told.
class Event {
 public:
  Event() : fd_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { ::close(fd_); }
  void tell() const {
    const std::uint64_t one = 1;
    (void)!::write(fd_, &one, sizeof(one));
  }
  /// It cannot be read before it is told again.
  void hear() const {
    std::uint64_t told = 0;
    (void)!::read(fd_, &told, sizeof(told));
  }
  [[nodiscard]] int fd() const { return fd_; }

 private:
  int fd_;
};

/// What is refused before a request is there.
HttpReply turned_away(unsigned status, const char* why, unsigned retry_after_s = 0) {
  HttpReply reply = refused(status, "SERVE-REFUSED", why);
  reply.retry_after_s = retry_after_s;
  return reply;
}

class Server {
 public:
  /// `folder`: of the sessions. `tls`: of TCP; null: none.
  Server(const ServeSettings& settings, const std::string& folder, const TlsContext* tls)
      : settings_(settings),
        limits_(settings.limits),
        own_user_(::geteuid()),
        tls_(tls),
        log_(settings.log),
        half_open_(limits_.half_open),
        endpoints_(limits_, folder, settings.options, peer_of_user(own_user_), metrics_,
                   [this] { return gauges(); }),
        workers_(limits_.workers, limits_.queue) {}

  /// Either may be null.
  void run(const SocketFile* socket, const TcpListener* tcp, int stop) {
    for (;;) {
      // A descriptor of -1 is not looked at: strangers wait in the kernel until one of them has left, and
      // nobody waits for them here.
      left_.hear();
      std::array<pollfd, 4> of = {pollfd{stop, POLLIN, 0},
                                  pollfd{socket == nullptr ? -1 : socket->fd(), POLLIN, 0},
                                  pollfd{tcp == nullptr || half_open_.full() ? -1 : tcp->fd(), POLLIN, 0},
                                  pollfd{left_.fd(), POLLIN, 0}};
      if (::poll(of.data(), of.size(), -1) < 0) {
        if (errno != EINTR) break;
        continue;
      }
      if (of[0].revents != 0) break;
      if (of[1].revents != 0) {
        if (const int fd = ::accept4(socket->fd(), nullptr, nullptr, SOCK_CLOEXEC); fd >= 0) {
          begin(fd);
        } else {
          without_descriptors();
        }
      }
      if (of[2].revents != 0) {
        if (auto [fd, address] = tcp->accept(); fd >= 0) {
          begin_tcp(fd, std::move(address));
        } else {
          without_descriptors();
        }
      }
    }
    endpoints_.end();
    stopping_.tell();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return threads_ == 0; });
  }

 private:
  std::vector<Metrics::Gauge> gauges() {
    std::size_t connections = 0;
    {
      const std::lock_guard lock(mutex_);
      connections = connections_;
    }
    return {{"capstan_connections", "Connections that are open.", connections},
            {"capstan_half_open", "Connections of TCP whose peer is not known yet.", half_open_.count()},
            {"capstan_queue_length", "Requests that wait for a worker.", workers_.waiting()},
            {"capstan_queue_limit", "Requests that may wait.", limits_.queue}};
  }

  /// Until a connection ends there is nothing to accept with.
  static void without_descriptors() {
    if (errno == EMFILE || errno == ENFILE || errno == ENOMEM)
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }

  /// One connection more; false: there are as many as there may be.
  bool enter() {
    const std::lock_guard lock(mutex_);
    if (connections_ >= limits_.connections) return false;
    ++connections_;
    return true;
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --connections_;
  }
  static HttpReply too_many() { return turned_away(503, "too many connections are open", 1); }

  /// Runs `body` in a thread that the server waits for; false: there is none.
  template <class Body>
  bool in_thread(Body body) {
    {
      const std::lock_guard lock(mutex_);
      ++threads_;
    }
    const auto ended = [this] {
      const std::lock_guard lock(mutex_);
      --threads_;
      ended_.notify_all();
    };
    try {
      std::thread([this, body = std::move(body), ended]() mutable {
        try {
          Body mine = std::move(body);  // its connection is closed before the thread counts as ended
          mine();
        } catch (const std::exception&) {
          metrics_.refused("fault");  // no memory for what the peer sends: the connection ends
        }
        ended();
      }).detach();
      return true;
    } catch (const std::system_error&) {
      metrics_.refused("threads");
      ended();
      return false;
    }
  }

  /// A place among the connections that was entered.
  struct Place {
    Server& server;
    ~Place() { server.leave(); }
  };

  void begin(int fd) {
    auto connection = std::make_unique<Connection>(fd, stopping_.fd());
    if (!enter()) {
      metrics_.refused("connections");
      connection->write(to_bytes(too_many(), false), {});
      return;
    }
    const bool begun = in_thread([this, c = std::move(connection)]() mutable {
      const Place place{*this};
      const auto connected = std::move(c);  // closed before its place is free
      std::uint32_t user = 0;
      if (!may_ask(*connected, user))
        return end_with(*connected, turned_away(403, "this user may not ask here"), "uid");
      converse(*connected, peer_of_user(user));
    });
    if (!begun) leave();
  }

  void begin_tcp(int fd, std::string address) {
    auto connection = std::make_unique<Connection>(fd, stopping_.fd(), std::make_unique<TlsStream>(*tls_));
    if (!half_open_.enter(fd)) return metrics_.refused("half-open");
    const auto until = Clock::now() + limits_.handshake;
    const bool begun =
        in_thread([this, c = std::move(connection), fd, until, from = std::move(address)]() mutable {
          auto ended = Connection::Shake::kEnd;
          try {
            ended = c->shake_hands(until);
          } catch (const std::exception&) {
            leave_half_open(fd);
            throw;
          }
          const bool told_to_go = leave_half_open(fd);
          if (ended != Connection::Shake::kDone || told_to_go)
            return refuse(*c->tls(), ended, told_to_go, from);
          if (!enter()) return end_with(*c, too_many(), "connections");
          const Place place{*this};
          const auto connected = std::move(c);
          log_.connected(from, connected->tls()->subject());
          converse(*connected, connected->tls()->identity());
        });
    if (!begun) leave_half_open(fd);
  }

  bool leave_half_open(int fd) {
    const bool told = half_open_.leave(fd);
    left_.tell();
    return told;
  }

  /// A peer that is not known: counts and says why.
  void refuse(const TlsStream& tls, Connection::Shake ended, bool told_to_go, const std::string& address) {
    const char* reason = "tls-end";
    std::string why = "it ended its handshake";
    if (told_to_go) {
      reason = "half-open";
      why = "too many others began a handshake after it";
    } else if (ended == Connection::Shake::kTime) {
      reason = "tls-slow";
      why = "its handshake took longer than " + std::to_string(limits_.handshake.count()) + " ms";
    } else if (ended == Connection::Shake::kStop) {
      return;
    } else if (ended == Connection::Shake::kRefused) {
      const bool none = tls.fault() == TlsStream::Fault::kNoCertificate;
      reason = none                                            ? "tls-no-certificate"
               : tls.fault() == TlsStream::Fault::kCertificate ? "tls-certificate"
                                                               : "tls-protocol";
      why = tls.why();
    }
    metrics_.refused(reason);
    log_.refused(address, why);
  }

  bool may_ask(const Connection& c, std::uint32_t& user) const {
    return c.peer(user) && (user == own_user_ || std::find(settings_.users.begin(), settings_.users.end(),
                                                           user) != settings_.users.end());
  }

  void end_with(Connection& c, const HttpReply& reply, const char* reason) {
    metrics_.refused(reason);
    if (c.write(to_bytes(reply, false), limits_.write)) c.finish();
  }

  void converse(Connection& c, const std::string& peer) {
    RequestReader reader(limits_.header_bytes, limits_.body_bytes);
    while (next(c, reader)) {
      const Caller caller{peer, Clock::now()};
      if (c.tls() != nullptr) metrics_.asked(c.tls()->subject());
      const HttpRequest request = reader.request();
      const Endpoints::Found found = Endpoints::find(request);
      HttpReply reply = found.refusal;
      if (found.endpoint == nullptr) {
        metrics_.answered("none", reply.status, 0.0);
      } else if (!found.endpoint->works) {
        reply = endpoints_.answer(found, request, caller);
        if (found.endpoint->streams && reply.status == 200) return stream(c, found, caller, reply);
      } else if (!worked(c, found, request, caller, reply)) {
        return;
      }
      if (!c.write(to_bytes(reply, reader.keeps_alive()), limits_.write)) return metrics_.refused("write");
      if (!reader.keeps_alive()) return c.finish();
    }
  }

  /// Sends lines as they come, until the session ends, the server does, or the reader is gone.
  void stream(Connection& c, const Endpoints::Found& found, const Caller& caller, const HttpReply& reply) {
    bool there = c.write(stream_header(reply.media), limits_.write);
    while (there) {
      const auto lines = endpoints_.next_lines(found, caller);
      if (!lines) {
        if (c.write(stream_end(), limits_.write)) c.finish();
        break;
      }
      there = lines->empty() ? c.wait(stopping_.fd(), Clock::now())
                             : c.write(stream_chunk(*lines), limits_.write);
    }
    endpoints_.end_stream(found, caller);
  }

  /// Reads one request whole; false: the connection has ended.
  bool next(Connection& c, RequestReader& reader) {
    auto state = reader.take({});
    auto until = Clock::now() + (reader.idle() ? limits_.idle : limits_.request);
    while (state == RequestReader::State::kMore) {
      const bool idle = reader.idle();
      std::string bytes;
      switch (c.read(bytes, until)) {
        case Connection::Read::kBytes:
          break;
        case Connection::Read::kEnd:
          if (!idle) end_with(c, turned_away(400, "the request ends in its middle"), "cut");
          return false;
        case Connection::Read::kTime:
          if (!idle) end_with(c, turned_away(408, "the request comes too slowly"), "slow");
          return false;
        case Connection::Read::kStop:
          if (!idle) end_with(c, turned_away(503, "the server is stopping"), "stop");
          return false;
      }
      if (idle) until = Clock::now() + limits_.request;
      state = reader.take(bytes);
      if (state == RequestReader::State::kMore && reader.asks_to_continue() &&
          !c.write("HTTP/1.1 100 Continue\r\n\r\n", limits_.write))
        return false;
    }
    if (state == RequestReader::State::kWrong) end_with(c, reader.fault(), "malformed");
    return state == RequestReader::State::kWhole;
  }

  /// What a worker and the thread that waits for it share.
  struct Task {
    Event done;
    HttpReply reply;
    std::atomic<bool> abandoned{false};
  };

  /// Has a worker answer; false: the peer is gone.
  bool worked(Connection& c, const Endpoints::Found& found, const HttpRequest& request, const Caller& caller,
              HttpReply& reply) {
    const auto task = std::make_shared<Task>();
    // Both outlive the task: this waits for it.
    if (!workers_.submit([this, task, &found, &request, &caller] {
          if (!task->abandoned) task->reply = endpoints_.answer(found, request, caller);
          task->done.tell();
        })) {
      metrics_.refused("queue");
      reply = turned_away(503, "too many requests wait", 1);
      return true;
    }
    bool there = true;
    for (pollfd of = {task->done.fd(), POLLIN, 0}; ::poll(&of, 1, 0) == 0;) {
      if (!there) {
        ::poll(&of, 1, -1);
      } else if (!c.wait(task->done.fd(), Clock::now() + std::chrono::seconds(60))) {
        there = false;
        task->abandoned = true;
        metrics_.refused("gone");
        endpoints_.gone(found, caller);
      }
    }
    reply = std::move(task->reply);
    return there;
  }

  const ServeSettings& settings_;
  Limits limits_;
  std::uint32_t own_user_;
  const TlsContext* tls_;
  Metrics metrics_;
  PeerLog log_;
  HalfOpen half_open_;
  Event left_;  ///< one of `half_open_`
  Event stopping_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t connections_ = 0, threads_ = 0;
  Endpoints endpoints_;
  Workers workers_;
};

/// A folder for the sessions of a server without a socket.
Result<std::string> folder_of_its_own() {
  std::error_code ec;
  std::string path = (std::filesystem::temp_directory_path(ec) / "capstan-serve-XXXXXX").string();
  if (ec || ::mkdtemp(path.data()) == nullptr)
    return fail({.code = "SERVE-FOLDER",
                 .message = "no folder for sessions can be made: " +
                            (ec ? ec.message() : std::string(std::strerror(errno))),
                 .file = path,
                 .hint = "name one in TMPDIR that this user may write to"});
  return path;
}

}  // namespace

Status serve(const ServeSettings& settings, int stop, const std::function<void(const Serving&)>& ready) {
  if (!http_is_built())
    return fail({.code = "SERVE-BEAST",
                 .message = "this build has no HTTP: it was configured without Boost.Beast",
                 .hint = "install libboost-dev and configure again; `capstan bind` and the C interface serve "
                         "without it"});
  std::optional<TlsContext> tls;
  std::optional<TcpListener> tcp;
  if (!settings.tcp.empty()) {
    auto loaded = TlsContext::load(settings.tls);
    if (!loaded) return tl::unexpected(loaded.error());
    tls = *std::move(loaded);
    auto listening = TcpListener::listen(settings.tcp);
    if (!listening) return tl::unexpected(listening.error());
    tcp.emplace(*std::move(listening));
  }
  std::optional<SocketFile> socket;
  std::string folder = settings.socket + ".d";
  if (!settings.socket.empty()) {
    auto listening = SocketFile::listen(settings.socket, !settings.users.empty());
    if (!listening) return tl::unexpected(listening.error());
    socket.emplace(*std::move(listening));
    // What a server left that was killed.
    std::error_code ignored;
    std::filesystem::remove_all(folder, ignored);
  } else {
    auto made = folder_of_its_own();
    if (!made) return tl::unexpected(made.error());
    folder = *std::move(made);
  }
  Server server(settings, folder, tls ? &*tls : nullptr);
  if (ready) ready({settings.socket, tcp ? tcp->address() : std::string()});
  server.run(socket ? &*socket : nullptr, tcp ? &*tcp : nullptr, stop);
  return {};
}

}  // namespace capstan::transport
