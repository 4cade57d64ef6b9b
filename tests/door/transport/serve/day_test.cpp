// A day at a control, as fast as it goes: sessions, tables that are measured anew, binds with deadlines, and
// clients that do not behave. In `./dev soak` each seed is half an hour of it; CAPSTAN_SOAK_HOURS=24 is the
// whole day of one server.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <random>
#include <set>
#include <string>
#include <thread>

#include "planner/door/transport/serve/wire/http.h"
#include "tests/door/transport/serve/running_server.h"
#include "tests/support/soak.h"

namespace capstan::transport {
namespace {

constexpr int kRequestsOfHalfAnHour = 360;  // one in five seconds
constexpr int kSample = 40;
constexpr double kMostGrowthMb =
    64.0;  // default, unsourced: a leak of one plan a request would be ten times that

int requests_of_a_run() {
  const char* const hours = std::getenv("CAPSTAN_SOAK_HOURS");
  if (hours != nullptr) return static_cast<int>(2.0 * std::atof(hours) * kRequestsOfHalfAnHour);
  return soaking() ? kRequestsOfHalfAnHour : kSample;
}

double resident_mb() {
  std::ifstream file("/proc/self/statm");
  double pages = 0.0, resident = 0.0;
  file >> pages >> resident;
  return resident * static_cast<double>(::sysconf(_SC_PAGESIZE)) / 1e6;
}
long open_files() {
  namespace fs = std::filesystem;
  return std::distance(fs::directory_iterator("/proc/self/fd"), fs::directory_iterator());
}

/// The magazine with another length of the end mill T7.
std::string table_with(int tenths) {
  std::string table = testing::slurp(magazine_file());
  const auto at = table.find("Z+", table.find("T7 ")) + 2;
  return table.replace(at, table.find(' ', at) - at,
                       "11" + std::to_string(5 + tenths / 10) + "." + std::to_string(tenths % 10));
}

/// Clients that do not behave; each is over when this returns.
void misbehave(const std::string& socket, const std::string& session, std::uint64_t how) {
  Client client(socket);
  switch (how % 5) {
    case 0:
      client.send("\x16\x03\x01 no HTTP\r\n\r\n");
      EXPECT_EQ(client.reply().status, 400);
      break;
    case 1:
      client.send("PUT " + session + "/plan HTTP/1.1\r\nContent-Length: 99999999999\r\n\r\n");
      EXPECT_EQ(client.reply().status, 413);
      break;
    case 2:
      client.send("POST /v1/sess");
      break;
    case 3:
      client.send("POST " + session + "/bind HTTP/1.1\r\nContent-Length: 9\r\n\r\n{\"dead");
      client.send_no_more();
      EXPECT_EQ(client.reply().status, 400);
      break;
    default:
      client.send("GET " + session + "/output/json HTTP/1.1\r\n\r\n");  // and does not wait for it
  }
}

TEST(ServeProperty, OfADayOfRequestsEachIsAnsweredAndNothingIsLeft) {
  if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
  std::mt19937_64 random(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  const int requests = requests_of_a_run();
  std::map<int, std::string> programs;  // by the length of the tool
  int bound = 0, late = 0;
  double before_mb = 0.0;
  const long files = open_files();
  {
    RunningServer server;
    Client client(server.socket());
    std::string path = opened(client);
    int tenths = 0;
    ASSERT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
    for (int i = 0; i < requests; ++i) {
      if (i == requests / 4) before_mb = resident_mb();
      switch (random() % 8) {
        case 0:
          EXPECT_EQ(client.ask("GET", "/health").status, 200);
          break;
        case 1:
          EXPECT_EQ(client.ask("GET", "/metrics").status, 200);
          break;
        case 2:
          tenths = static_cast<int>(random() % 20);
          EXPECT_EQ(
              client.ask("PUT", path + "/state", nlohmann::json{{"tool_table", table_with(tenths)}}.dump())
                  .status,
              200);
          break;
        case 3:  // a new shift
          EXPECT_EQ(client.ask("DELETE", path).status, 200);
          path = opened(client);
          tenths = 0;
          ASSERT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
          break;
        case 4: {  // too little time: late, never wrong
          const auto reply = client.ask("POST", path + "/bind", R"({"deadline_ms": 1})");
          EXPECT_EQ(reply.status, 504) << reply.body;
          ++late;
          break;
        }
        case 5:
          misbehave(server.socket(), path, random());
          break;
        case 6:
          for (auto reply = client.ask("GET", path + "/changes"); reply.status == 409;
               reply = client.ask("GET", path + "/changes")) {
            if (reply.body.find("SERVE-BUSY") == std::string::npos) break;  // nothing is bound yet
          }
          break;
        default: {
          const auto reply = client.ask("POST", path + "/bind", R"({"deadline_ms": 60000})");
          if (reply.status == 409 && reply.body.find("SERVE-BUSY") != std::string::npos) break;
          ASSERT_EQ(reply.status, 200) << reply.body;
          ++bound;
          const auto program = client.ask("GET", path + "/output/linuxcnc");
          ASSERT_EQ(program.status, 200);
          const auto [at, first] = programs.emplace(tenths, program.body);
          EXPECT_EQ(at->second, program.body) << "the same question got another answer";
        }
      }
    }
    EXPECT_EQ(client.ask("DELETE", path).status, 200);
    EXPECT_NE(client.ask("GET", "/metrics").body.find("\ncapstan_sessions 0\n"), std::string::npos);
  }
  EXPECT_EQ(open_files(), files);
  const double growth_mb = resident_mb() - before_mb;
  EXPECT_LT(growth_mb, kMostGrowthMb);
  RecordProperty("bound", bound);
  RecordProperty("late", late);
  std::printf("%d requests: %d bound, %d late; %.1f MB more than after the first quarter\n", requests, bound,
              late, growth_mb);
}

}  // namespace
}  // namespace capstan::transport
