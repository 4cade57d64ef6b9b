// Broadcasts through a server: as a stream, to a file and to a FIFO, and the replies that a control waits
// for.

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <array>
#include <chrono>
#include <string>
#include <thread>

#include "planner/door/transport/serve/wire/http.h"
#include "planner/files/exchange/exchange.h"
#include "planner/model/nouns/all.h"
#include "tests/door/transport/serve/running_server.h"

namespace capstan::transport {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

class ServeBroadcast : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
  }
  /// A session with the plate's plan and these broadcasts; its path.
  static std::string ready(Client& client, const Json& broadcast) {
    const std::string path = opened(client);
    EXPECT_EQ(client.ask("PUT", path + "/state", Json{{"broadcast", broadcast}}.dump()).status, 200);
    EXPECT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
    return path;
  }
  static Client::Reply tell(Client& client, const std::string& path, const std::string& event, double speed) {
    return client.ask("POST", path + "/measured",
                      Json{{"event", event},
                           {"workingstep", "ROUGH POCKET"},
                           {"time", "12:00"},
                           {"measured", {{"spindle speed", speed}, {"location", {1.0, 2.0, 3.0}}}}}
                          .dump());
  }
};

TEST_F(ServeBroadcast, StreamsEachLineToItsReader) {
  RunningServer server;
  Client client(server.socket());
  const std::string path = ready(client, {{"at", "start,end"}, {"measured", "spindle speed"}});
  Client reader(server.socket());
  reader.send("GET " + path + "/broadcast HTTP/1.1\r\n\r\n");
  EXPECT_THAT(reader.until("\r\n\r\n"), HasSubstr("application/x-ndjson"));
  EXPECT_EQ(Client(server.socket()).ask("GET", path + "/broadcast").status, 409);  // one reader
  const auto told = tell(client, path, "start", 3000.0);
  EXPECT_EQ(told.status, 200) << told.body;
  EXPECT_EQ(told.json()["lines"].size(), 1U);
  EXPECT_THAT(reader.until("12:00"), HasSubstr(R"("measured":{"spindle speed":3000.0})"));
  EXPECT_EQ(tell(client, path, "end", 2990.0).status, 200);
  EXPECT_THAT(reader.until("2990"), HasSubstr("ROUGH POCKET"));
  EXPECT_EQ(client.ask("DELETE", path).status, 200);
  EXPECT_THAT(reader.until("\r\n0\r\n\r\n"), HasSubstr("\r\n0\r\n\r\n"));  // the stream ends with its session
}

TEST_F(ServeBroadcast, TheControlWaitsForAReplyAndIsToldWhenThereIsNone) {
  RunningServer server({.reply = std::chrono::milliseconds(200)});
  Client client(server.socket());
  const std::string path = ready(client, {{"at", "start,end"}, {"wait_for_reply", "yes"}});
  const auto alone = tell(client, path, "start", 1.0);
  EXPECT_EQ(alone.status, 504);
  EXPECT_EQ(alone.json()["status"], "LATE");
  EXPECT_EQ(client.ask("POST", path + "/reply", R"({"reply_to": 1})").status, 409);  // nobody waits any more
  std::thread reader([&] {
    Client other(server.socket());
    while (other.ask("POST", path + "/reply", R"({"reply_to": 2})").status == 409) {
    }
  });
  const auto replied = tell(client, path, "end", 1.0);
  reader.join();
  EXPECT_EQ(replied.status, 200) << replied.body;
}

TEST_F(ServeBroadcast, GoToAFileLineByLine) {
  RunningServer server;
  Client client(server.socket());
  const testing::ScratchFolder folder;
  const std::string path =
      ready(client, {{"at", "start,end"}, {"only_if_changed", "yes"}, {"file", folder.file("b.jsonl")}});
  tell(client, path, "start", 3000.0);
  EXPECT_EQ(tell(client, path, "end", 3000.0).json()["lines"].size(), 0U);  // nothing changed
  tell(client, path, "start", 2000.0);
  const std::string text = testing::slurp(folder.file("b.jsonl"));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 2);
  EXPECT_EQ(Json::parse(text.substr(0, text.find('\n')))["measured"]["spindle speed"], 3000.0);
}

TEST_F(ServeBroadcast, AFifoWithoutAReaderHoldsNobody) {
  RunningServer server;
  Client client(server.socket());
  const testing::ScratchFolder folder;
  const std::string fifo = folder.file("fifo");
  ASSERT_EQ(::mkfifo(fifo.c_str(), 0600), 0);
  const std::string path = ready(client, {{"at", "start,end"}, {"file", fifo}});
  const auto alone = tell(client, path, "start", 1.0);
  EXPECT_EQ(alone.status, 200);
  EXPECT_THAT(alone.json()["message"].get<std::string>(), HasSubstr("nobody reads it"));
  const int fd = ::open(fifo.c_str(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
  ASSERT_GE(fd, 0);
  EXPECT_EQ(tell(client, path, "end", 1.0).json()["message"], "");
  std::array<char, 4096> bytes;
  const ssize_t n = ::read(fd, bytes.data(), bytes.size());
  ASSERT_GT(n, 0);
  EXPECT_EQ(bytes[static_cast<std::size_t>(n) - 1], '\n');
  ::close(fd);
}

/// The plate as AP238, whose first workingstep says when it begins, and where its spindle is when it ends.
std::string plate_with_broadcasts() {
  Job job;
  auto plan = exchange::read_bytes(plate(), "plate.p21", {}, job);
  EXPECT_TRUE(plan);
  auto& m = plan->model;
  model::BroadcastContent begins, ends;
  begins.its_id = "begins";
  begins.message = "roughing begins";
  ends.its_id = "ends";
  ends.cbm_measurements.given = true;
  ends.cbm_measurements.items = {"spindle speed"};
  ends.only_if_changed = true;
  model::Broadcast b;
  b.its_id = "b";
  b.end_content = m.add(ends);
  for (const auto at : m.all_below(model::TypeId::kWorkingstep)) {
    auto& step = m.at<model::Executable>(at);
    if (step.its_id != "ROUGH POCKET") continue;
    step.start_content = m.add(begins);
    step.its_broadcasts.push_back(m.add(b));
  }
  const auto written = exchange::write_ap238(*plan, job);
  EXPECT_TRUE(written);
  return written ? written->bytes : std::string();
}

TEST_F(ServeBroadcast, AreThoseThatThePlansFileStatesAlsoWhenItIsBound) {
  RunningServer server;
  Client client(server.socket());
  const std::string path = opened(client);
  ASSERT_EQ(client.ask("PUT", path + "/plan", plate_with_broadcasts()).status, 200);
  for (const bool bound : {false, true}) {
    if (bound) {
      ASSERT_EQ(client.ask("POST", path + "/bind", R"({"deadline_ms": 600000})").status, 200);
    }
    EXPECT_EQ(tell(client, path, "start", 1.0).json()["lines"],
              Json::parse(R"([{"content": "begins", "message": "roughing begins"}])"));
    EXPECT_EQ(tell(client, path, "end", bound ? 3000.0 : 2990.0).json()["lines"].size(), 1U);
  }
}

TEST_F(ServeBroadcast, RefuseWhatTheyDoNotKnow) {
  RunningServer server;
  Client client(server.socket());
  const std::string path = opened(client);
  EXPECT_EQ(tell(client, path, "start", 1.0).status, 409);  // no plan
  EXPECT_EQ(client.ask("PUT", path + "/state", R"({"broadcast": {"at": "noon"}})").status, 400);
  EXPECT_EQ(client.ask("PUT", path + "/state", R"({"broadcast": {"colour": "red"}})").status, 400);
  EXPECT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  EXPECT_EQ(tell(client, path, "noon", 1.0).status, 400);
  EXPECT_EQ(tell(client, path, "end", 1.0).status, 409);  // has not begun
  EXPECT_EQ(client
                .ask("POST", path + "/measured",
                     R"({"event": "start", "workingstep": "ROUGH POCKET", "measured": {"location": [1, 2]}})")
                .status,
            400);
}

}  // namespace
}  // namespace capstan::transport
