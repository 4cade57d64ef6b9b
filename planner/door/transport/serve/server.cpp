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
#include <system_error>
#include <thread>
#include <utility>

#include "planner/door/transport/serve/endpoints.h"
#include "planner/door/transport/serve/replies.h"
#include "planner/door/transport/serve/wire/connection.h"
#include "planner/door/transport/serve/wire/http.h"
#include "planner/door/transport/serve/wire/socket_file.h"
#include "planner/door/transport/serve/workers.h"

// Connections, each with a thread that reads requests and sends replies; the work itself is done by few
// workers behind a bounded queue. A thread that waits for a worker sees its peer go, and ends the work.

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
  explicit Server(const ServeSettings& settings)
      : settings_(settings),
        limits_(settings.limits),
        own_user_(::geteuid()),
        endpoints_(limits_, settings.socket + ".d", settings.options, own_user_, metrics_,
                   [this] { return gauges(); }),
        workers_(limits_.workers, limits_.queue) {}

  void run(int listener, int stop) {
    for (;;) {
      std::array<pollfd, 2> of = {pollfd{listener, POLLIN, 0}, pollfd{stop, POLLIN, 0}};
      if (::poll(of.data(), of.size(), -1) < 0 && errno != EINTR) break;
      if (of[1].revents != 0) break;
      if (of[0].revents == 0) continue;
      const int fd = ::accept4(listener, nullptr, nullptr, SOCK_CLOEXEC);
      if (fd >= 0) {
        begin(fd);
      } else if (errno == EMFILE || errno == ENFILE || errno == ENOMEM) {
        // Until a connection ends there is nothing to accept with.
        std::this_thread::sleep_for(std::chrono::milliseconds(10));
      }
    }
    endpoints_.end();
    stopping_.tell();
    std::unique_lock lock(mutex_);
    ended_.wait(lock, [&] { return connections_ == 0; });
  }

 private:
  std::vector<Metrics::Gauge> gauges() {
    std::size_t connections = 0;
    {
      const std::lock_guard lock(mutex_);
      connections = connections_;
    }
    return {{"capstan_connections", "Connections that are open.", connections},
            {"capstan_queue_length", "Requests that wait for a worker.", workers_.waiting()},
            {"capstan_queue_limit", "Requests that may wait.", limits_.queue}};
  }

  void begin(int fd) {
    auto connection = std::make_unique<Connection>(fd, stopping_.fd());
    {
      const std::lock_guard lock(mutex_);
      if (connections_ >= limits_.connections) {
        metrics_.refused("connections");
        connection->write(to_bytes(turned_away(503, "too many connections are open", 1), false), {});
        return;
      }
      ++connections_;
    }
    try {
      std::thread([this, c = std::move(connection)]() mutable {
        try {
          converse(*c);
        } catch (const std::exception&) {
          metrics_.refused("fault");  // no memory for what the peer sends: the connection ends
        }
        c.reset();
        leave();
      }).detach();
    } catch (const std::system_error&) {
      metrics_.refused("threads");
      leave();
    }
  }
  void leave() {
    const std::lock_guard lock(mutex_);
    --connections_;
    ended_.notify_all();
  }

  bool may_ask(const Connection& c, std::uint32_t& user) const {
    return c.peer(user) && (user == own_user_ || std::find(settings_.users.begin(), settings_.users.end(),
                                                           user) != settings_.users.end());
  }

  void end_with(Connection& c, const HttpReply& reply, const char* reason) {
    metrics_.refused(reason);
    if (c.write(to_bytes(reply, false), limits_.write)) c.finish();
  }

  void converse(Connection& c) {
    std::uint32_t user = 0;
    if (!may_ask(c, user)) return end_with(c, turned_away(403, "this user may not ask here"), "uid");
    RequestReader reader(limits_.header_bytes, limits_.body_bytes);
    while (next(c, reader)) {
      const Caller caller{user, Clock::now()};
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
  Metrics metrics_;
  Event stopping_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::size_t connections_ = 0;
  Endpoints endpoints_;
  Workers workers_;
};

}  // namespace

Status serve(const ServeSettings& settings, int stop, const std::function<void()>& ready) {
  if (!http_is_built())
    return fail({.code = "SERVE-BEAST",
                 .message = "this build has no HTTP: it was configured without Boost.Beast",
                 .hint = "install libboost-dev and configure again; `capstan bind` and the C interface serve "
                         "without it"});
  auto socket = SocketFile::listen(settings.socket, !settings.users.empty());
  if (!socket) return tl::unexpected(socket.error());
  // What a server left that was killed.
  std::error_code ignored;
  std::filesystem::remove_all(settings.socket + ".d", ignored);
  Server server(settings);
  if (ready) ready();
  server.run(socket->fd(), stop);
  return {};
}

}  // namespace capstan::transport
