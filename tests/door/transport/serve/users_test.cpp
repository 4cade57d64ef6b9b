// Who may ask: the kernel says who a peer is. Another user is a process of the test that gave up its own.

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include <filesystem>
#include <functional>
#include <string>

#include "planner/door/transport/serve/wire/http.h"
#include "tests/door/transport/serve/running_server.h"

namespace capstan::transport {
namespace {

constexpr std::uint32_t kNobody = 65534;
constexpr int kNotConnected = -1;

class ServeUsers : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
    if (::geteuid() != 0) GTEST_SKIP() << "only root can become another user";
  }
  /// What another user is answered: the HTTP status, or kNotConnected.
  static int as_nobody(const RunningServer& server, const std::function<int(Client&)>& ask) {
    std::filesystem::permissions(std::filesystem::path(server.socket()).parent_path(),
                                 std::filesystem::perms(0755));
    int ends[2] = {};
    EXPECT_EQ(::pipe(ends), 0);
    const pid_t child = ::fork();
    if (child == 0) {
      int status = -2;
      if (::setgid(kNobody) == 0 && ::setuid(kNobody) == 0) {
        Client client(server.socket());
        status = client.connected() ? ask(client) : kNotConnected;
      }
      (void)!::write(ends[1], &status, sizeof(status));
      ::_exit(0);
    }
    int status = -3;
    EXPECT_EQ(::read(ends[0], &status, sizeof(status)), static_cast<ssize_t>(sizeof(status)));
    ::waitpid(child, nullptr, 0);
    ::close(ends[0]);
    ::close(ends[1]);
    return status;
  }
};

TEST_F(ServeUsers, TheSocketIsClosedToOthersWhereNobodyIsNamed) {
  RunningServer server;
  EXPECT_EQ(as_nobody(server, [](Client& c) { return c.ask("GET", "/health").status; }), kNotConnected);
}

TEST_F(ServeUsers, AUserWhoIsNotNamedIsRefused) {
  RunningServer server({}, {}, {12345});
  EXPECT_EQ(as_nobody(server, [](Client& c) { return c.reply().status; }), 403);
  EXPECT_NE(
      Client(server.socket()).ask("GET", "/metrics").body.find("capstan_refused_total{reason=\"uid\"} 1\n"),
      std::string::npos);
}

TEST_F(ServeUsers, AUserWhoIsNamedHasSessionsOfItsOwnAndNamesNoFile) {
  RunningServer server({}, {}, {kNobody});
  Client client(server.socket());
  const std::string mine = opened(client);
  const auto nobody = [&](const std::string& method, const std::string& path, const std::string& body = {}) {
    return as_nobody(server, [=](Client& c) { return c.ask(method, path, body).status; });
  };
  EXPECT_EQ(nobody("GET", "/health"), 200);
  EXPECT_EQ(nobody("GET", mine + "/result"), 404);
  EXPECT_EQ(nobody("DELETE", mine), 404);
  EXPECT_EQ(nobody("POST", "/v1/sessions", R"({"options": {"machine": "generic_vmc"}})"), 201);
  EXPECT_EQ(nobody("POST", "/v1/sessions", R"({"options": {"tools": "/etc/shadow"}})"), 403);
  EXPECT_EQ(nobody("POST", "/v1/sessions", R"({"options": {"profile": "/etc/shadow"}})"), 403);
  EXPECT_EQ(nobody("POST", "/v1/sessions", R"({"options": {"cache": "anything"}})"), 403);
  EXPECT_EQ(nobody("POST", "/v1/sessions", R"({"broadcast": {"file": "/var/x"}})"), 403);
  EXPECT_EQ(client.ask("GET", mine + "/result").status, 200);
}

}  // namespace
}  // namespace capstan::transport
