#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <netinet/in.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <future>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <thread>

#include "planner/door/transport/serve/server.h"
#include "tests/support/corpus.h"

/// A server in a thread of the test, and a client of few lines that shares nothing with it.
namespace capstan::transport {

/// A connection of a client.
class Client {
 public:
  explicit Client(const std::string& path) : fd_(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0)) {
    sockaddr_un address = {};
    address.sun_family = AF_UNIX;
    std::memcpy(address.sun_path, path.c_str(), path.size());
    connected_ = ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof(address)) == 0;
  }
  /// Over TCP at an address in numbers, without TLS.
  static Client tcp(const std::string& address) { return Client(connected_to(address)); }
  static int connected_to(const std::string& address) {
    sockaddr_in at = {};
    at.sin_family = AF_INET;
    const auto colon = address.find(':');
    at.sin_port = htons(static_cast<std::uint16_t>(std::stoi(address.substr(colon + 1))));
    ::inet_pton(AF_INET, address.substr(0, colon).c_str(), &at.sin_addr);
    const int fd = ::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0);
    EXPECT_EQ(::connect(fd, reinterpret_cast<const sockaddr*>(&at), sizeof(at)), 0);
    return fd;
  }
  Client(const Client&) = delete;
  Client& operator=(const Client&) = delete;
  ~Client() { leave(); }

  [[nodiscard]] bool connected() const { return connected_; }
  void leave() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  bool send(std::string_view bytes) {
    while (!bytes.empty()) {
      const ssize_t n = ::send(fd_, bytes.data(), bytes.size(), MSG_NOSIGNAL);
      if (n <= 0) return false;
      bytes.remove_prefix(static_cast<std::size_t>(n));
    }
    return true;
  }
  void send_no_more() { ::shutdown(fd_, SHUT_WR); }

  struct Reply {
    int status = 0;  ///< 0: none came
    std::string head, body;
    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
  };
  /// Reads one reply whole: what its Content-Length says.
  Reply reply() {
    Reply out;
    std::size_t end = 0;
    while ((end = came_.find("\r\n\r\n")) == std::string::npos)
      if (!more()) return out;
    out.head = came_.substr(0, end + 2);
    std::size_t size = 0;
    if (const auto at = out.head.find("Content-Length: "); at != std::string::npos)
      size = std::stoul(out.head.substr(at + 16));
    while (came_.size() < end + 4 + size)
      if (!more()) return out;
    out.body = came_.substr(end + 4, size);
    came_.erase(0, end + 4 + size);
    out.status = std::stoi(out.head.substr(9, 3));
    return out;
  }
  Reply ask(const std::string& method, const std::string& path, const std::string& body = {}) {
    send(method + " " + path +
         " HTTP/1.1\r\nHost: capstan\r\nContent-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body);
    return reply();
  }
  /// What comes until a text is there, or the peer ends.
  std::string until(const std::string& text) {
    while (came_.find(text) == std::string::npos)
      if (!more()) break;
    return came_;
  }

 private:
  explicit Client(int connected) : fd_(connected), connected_(true) {}
  bool more() {
    pollfd of = {fd_, POLLIN, 0};
    if (::poll(&of, 1, 120'000) <= 0) return false;
    std::array<char, 65536> bytes;
    const ssize_t n = ::recv(fd_, bytes.data(), bytes.size(), 0);
    if (n <= 0) return false;
    came_.append(bytes.data(), static_cast<std::size_t>(n));
    return true;
  }

  int fd_;
  bool connected_ = false;
  std::string came_;
};

class RunningServer {
 public:
  explicit RunningServer(Limits limits = {}, std::vector<std::pair<std::string, std::string>> options = {},
                         std::vector<std::uint32_t> users = {}) {
    settings_.users = std::move(users);
    settings_.socket = folder_.file("s");
    settings_.limits = limits;
    settings_.options = std::move(options);
    begin();
  }
  explicit RunningServer(ServeSettings settings) : settings_(std::move(settings)) { begin(); }
  RunningServer(const RunningServer&) = delete;
  RunningServer& operator=(const RunningServer&) = delete;
  ~RunningServer() { end(); }

  void end() {
    if (!thread_.joinable()) return;
    const std::uint64_t one = 1;
    EXPECT_EQ(::write(stop_, &one, sizeof(one)), static_cast<ssize_t>(sizeof(one)));
    thread_.join();
    ::close(stop_);
    EXPECT_TRUE(status_) << to_text(status_.error());
  }
  [[nodiscard]] const std::string& socket() const { return settings_.socket; }
  [[nodiscard]] const std::string& tcp() const { return serving_.tcp; }

 private:
  void begin() {
    std::promise<Serving> ready;
    auto is_ready = ready.get_future();
    thread_ = std::thread([this, &ready] {
      status_ = serve(settings_, stop_, [&](const Serving& where) { ready.set_value(where); });
      if (!status_) ready.set_value({});
    });
    serving_ = is_ready.get();
  }

  testing::ScratchFolder folder_;
  ServeSettings settings_;
  int stop_ = ::eventfd(0, EFD_CLOEXEC);
  Status status_;
  Serving serving_;
  std::thread thread_;
};

inline std::string plate() { return testing::slurp(testing::source_dir() + "/examples/plate_bound.p21"); }
inline std::string magazine_file() { return testing::source_dir() + "/tests/door/late/magazine.tbl"; }

/// Opens a session for the plate's machine and magazine; its path.
inline std::string opened(Client& client) {
  const nlohmann::json state = {{"options", {{"machine", "generic_vmc"}}},
                                {"tool_table", testing::slurp(magazine_file())}};
  const auto reply = client.ask("POST", "/v1/sessions", state.dump());
  EXPECT_EQ(reply.status, 201) << reply.body;
  return reply.status == 201 ? "/v1/sessions/" + reply.json()["session"].get<std::string>() : "";
}

}  // namespace capstan::transport
