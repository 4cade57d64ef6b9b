// A server under the requests that it was not made for: malformed, slow, oversized, too many, half closed.

#include "planner/door/transport/serve/server.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "planner/door/transport/serve/wire/http.h"
#include "tests/door/transport/serve/running_server.h"

namespace capstan::transport {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;

class Serve : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
  }
};

/// Whether a server still answers.
bool answers(const RunningServer& server) {
  return Client(server.socket()).ask("GET", "/health").status == 200;
}

TEST_F(Serve, RemovesItsSocketWhenItEnds) {
  RunningServer server;
  EXPECT_TRUE(answers(server));
  const std::string path = server.socket();
  server.end();
  EXPECT_FALSE(std::filesystem::exists(path));
}

TEST_F(Serve, RefusesWhereThereIsNoSuchPathOrMethod) {
  RunningServer server;
  Client client(server.socket());
  EXPECT_EQ(client.ask("GET", "/").status, 404);
  EXPECT_EQ(client.ask("GET", "/v1/sessions/s1/output/").status, 404);
  const auto reply = client.ask("DELETE", "/v1/sessions");
  EXPECT_EQ(reply.status, 405);
  EXPECT_THAT(reply.body, HasSubstr("use POST, GET"));
  EXPECT_EQ(client.ask("GET", "/v1/sessions/s9/result").status, 404);
}

TEST_F(Serve, EndsAConnectionThatIsNoHttpAndServesOn) {
  RunningServer server;
  for (const std::string& bytes :
       {std::string("\0\xff\x16\x03\x01 rubbish\r\n\r\n", 18), std::string("GET\r\n\r\n")}) {
    Client client(server.socket());
    client.send(bytes);
    EXPECT_EQ(client.reply().status, 400);
    EXPECT_EQ(client.reply().status, 0);  // the end
  }
  EXPECT_TRUE(answers(server));
}

TEST_F(Serve, RefusesWhatIsTooLong) {
  RunningServer server({.header_bytes = 500, .body_bytes = 1000, .json_bytes = 100});
  Client header(server.socket());
  header.send("GET /health HTTP/1.1\r\nX: " + std::string(5000, 'a'));
  EXPECT_EQ(header.reply().status, 431);
  Client body(server.socket());
  body.send("PUT /v1/sessions/s1/plan HTTP/1.1\r\nContent-Length: 100000000000\r\n\r\n");
  EXPECT_EQ(body.reply().status, 413);
  Client json(server.socket());
  EXPECT_EQ(json.ask("POST", "/v1/sessions", "{\"tool_table\": \"" + std::string(500, 'a') + "\"}").status,
            400);
  EXPECT_TRUE(answers(server));
}

TEST_F(Serve, GivesASlowClientItsTimeAndNoMore) {
  RunningServer server({.request = milliseconds(300)});
  Client slow(server.socket());
  // A byte now and then keeps no connection: the time counts from the request's first byte.
  slow.send("GET /health HTTP/1.1\r\n");
  for (int i = 0; i < 20 && slow.send("a"); ++i) std::this_thread::sleep_for(milliseconds(50));
  EXPECT_THAT(slow.until("too slowly"), HasSubstr("408"));
  EXPECT_TRUE(answers(server));
}

TEST_F(Serve, EndsAConnectionThatAsksNothing) {
  RunningServer server({.idle = milliseconds(100)});
  Client client(server.socket());
  EXPECT_EQ(client.ask("GET", "/health").status, 200);
  EXPECT_EQ(client.reply().status, 0);
}

TEST_F(Serve, AnswersAClientThatSendsNoMore) {
  RunningServer server;
  Client client(server.socket());
  client.send("POST /v1/sessions HTTP/1.1\r\nContent-Length: 2\r\n\r\n{}");
  client.send_no_more();
  EXPECT_EQ(client.reply().status, 201);
  Client cut(server.socket());
  cut.send("POST /v1/sessions HTTP/1.1\r\nContent-Length: 20\r\n\r\n{}");
  cut.send_no_more();
  EXPECT_EQ(cut.reply().status, 400);
}

TEST_F(Serve, RefusesMoreConnectionsThanItHas) {
  RunningServer server({.connections = 2});
  Client one(server.socket()), two(server.socket());
  EXPECT_EQ(one.ask("GET", "/health").status, 200);
  EXPECT_EQ(two.ask("GET", "/health").status, 200);
  Client three(server.socket());
  EXPECT_EQ(three.reply().status, 503);
  one.leave();
  bool answered = false;
  for (int i = 0; i < 100 && !answered; ++i) {
    std::this_thread::sleep_for(milliseconds(20));
    answered = answers(server);
  }
  EXPECT_TRUE(answered);
}

TEST_F(Serve, RefusesMoreSessionsThanItHas) {
  RunningServer server({.sessions_of_user = 2});
  Client client(server.socket());
  const std::string first = opened(client);
  opened(client);
  const auto third = client.ask("POST", "/v1/sessions");
  EXPECT_EQ(third.status, 429);
  EXPECT_THAT(third.body, HasSubstr("close one"));
  EXPECT_EQ(client.ask("DELETE", first).status, 200);
  EXPECT_EQ(client.ask("GET", first + "/result").status, 404);
  EXPECT_EQ(client.ask("POST", "/v1/sessions").status, 201);
}

TEST_F(Serve, ASessionThatNobodyAsksForIsClosed) {
  RunningServer server({.session = std::chrono::seconds(0)});
  Client client(server.socket());
  const std::string path = opened(client);
  EXPECT_EQ(client.ask("GET", path + "/result").status, 404);
}

TEST_F(Serve, TellsWhatIsOpenBeforeItIsBound) {
  RunningServer server;
  Client client(server.socket());
  const std::string path = opened(client);
  for (const char* what : {"/open", "/no-longer-valid", "/unsuited"})
    EXPECT_EQ(client.ask("GET", path + what).status, 409) << what;
  EXPECT_EQ(client.ask("POST", path + "/bind", R"({"deadline_ms": 1000})").status, 409);
  EXPECT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  const auto open = client.ask("GET", path + "/open").json()["open"];
  ASSERT_EQ(open.size(), 2U) << open;
  EXPECT_THAT(open[0].get<std::string>(), HasSubstr("MILLING_TECHNOLOGY"));
  const auto no_longer = client.ask("GET", path + "/no-longer-valid").json()["no_longer_valid"];
  ASSERT_EQ(no_longer.size(), 1U) << no_longer;
  EXPECT_THAT(no_longer[0].get<std::string>(),
              HasSubstr("'DRILL 9' (twist_drill 9 mm) is not in the magazine"));
  EXPECT_THAT(client.ask("GET", path + "/unsuited").body, HasSubstr("FIT-OPEN"));
  EXPECT_EQ(client.ask("POST", path + "/bind", "{}").status, 400);
  EXPECT_EQ(client.ask("POST", path + "/bind", R"({"deadline_ms": 600000})").status, 200);
  const auto result = client.ask("GET", path + "/result").json();
  EXPECT_EQ(result["status"], "OK");
  EXPECT_EQ(result["bound"], true);
  EXPECT_EQ(client.ask("PUT", path + "/plan", testing::slurp(testing::source_dir() + "/examples/bracket.p21"))
                .status,
            200);
  EXPECT_THAT(client.ask("GET", path + "/open").body, HasSubstr("there is no workingstep"));
}

// The options of a request are held before what it tells of the tools, which drops what was bound.
TEST_F(Serve, AStateThatIsRefusedTakesNothingOfTheTools) {
  RunningServer server;
  Client client(server.socket());
  const std::string path = opened(client);
  EXPECT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  EXPECT_EQ(client.ask("POST", path + "/bind", R"({"deadline_ms": 600000})").status, 200);
  const auto program = client.ask("GET", path + "/output/linuxcnc");
  ASSERT_EQ(program.status, 200);
  const auto reply =
      client.ask("PUT", path + "/state", R"({"options": {"margin": "wild"}, "tool_state": "T5 broken"})");
  EXPECT_EQ(reply.status, 400) << reply.body;
  EXPECT_EQ(client.ask("GET", path + "/output/linuxcnc").body, program.body);
}

TEST_F(Serve, TheQueueIsBoundedAndHealthAnswersBesideIt) {
  RunningServer server({.queue = 1});
  // Each client binds in a session of its own; one works, one waits, the others are refused at once.
  constexpr int kClients = 6;
  std::vector<std::string> paths;
  {
    Client client(server.socket());
    for (int i = 0; i < kClients; ++i) {
      paths.push_back(opened(client));
      ASSERT_EQ(client.ask("PUT", paths.back() + "/plan", plate()).status, 200);
    }
  }
  std::vector<int> statuses(kClients);
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < kClients; ++i)
    threads.emplace_back([&, i] {
      statuses[i] =
          Client(server.socket()).ask("POST", paths[i] + "/bind", R"({"deadline_ms": 600000})").status;
    });
  EXPECT_TRUE(answers(server));
  for (auto& t : threads) t.join();
  const std::set<int> seen(statuses.begin(), statuses.end());
  EXPECT_THAT(seen, ::testing::IsSubsetOf({200, 503}));
  EXPECT_TRUE(seen.contains(200));
  const std::string metrics = Client(server.socket()).ask("GET", "/metrics").body;
  const auto refused = std::count(statuses.begin(), statuses.end(), 503);
  if (refused > 0) {
    EXPECT_THAT(metrics,
                HasSubstr("capstan_refused_total{reason=\"queue\"} " + std::to_string(refused) + "\n"));
  }
  EXPECT_THAT(metrics,
              HasSubstr("capstan_binds_total{status=\"OK\"} " + std::to_string(kClients - refused) + "\n"));
  EXPECT_THAT(metrics, HasSubstr("capstan_queue_length 0\n"));
}

TEST_F(Serve, WhatComesWhenOneWorksAndOneWaitsIsRefused) {
  RunningServer server({.queue = 1});
  Client client(server.socket());
  std::vector<std::string> paths;
  for (int i = 0; i < 3; ++i) {
    paths.push_back(opened(client));
    // A part that takes longer than what is asked meanwhile.
    ASSERT_EQ(client
                  .ask("PUT", paths.back() + "/plan",
                       testing::slurp(testing::source_dir() + "/examples/bracket.p21"))
                  .status,
              200);
  }
  const auto bind = [&](const std::string& path) {
    return Client(server.socket()).ask("POST", path + "/bind", R"({"deadline_ms": 600000})").status;
  };
  std::thread works([&] { EXPECT_NE(bind(paths[0]), 503); });
  bool busy = false, queued = false;
  for (int i = 0; i < 10'000 && !busy; ++i) busy = client.ask("GET", paths[0] + "/result").json()["busy"];
  std::thread waits([&] { EXPECT_NE(bind(paths[1]), 503); });
  for (int i = 0; i < 10'000 && !queued; ++i)
    queued = client.ask("GET", "/metrics").body.find("capstan_queue_length 1\n") != std::string::npos;
  EXPECT_TRUE(busy && queued);
  EXPECT_EQ(bind(paths[2]), 503);
  EXPECT_THAT(client.ask("GET", "/metrics").body, HasSubstr("capstan_refused_total{reason=\"queue\"} 1\n"));
  works.join();
  waits.join();
  EXPECT_NE(bind(paths[2]), 503);
}

TEST_F(Serve, ASessionServesOneCallAtATimeAndCanBeCancelled) {
  RunningServer server({.workers = 2});
  Client client(server.socket());
  const std::string path = opened(client);
  ASSERT_EQ(client.ask("PUT", path + "/plan", testing::slurp(testing::source_dir() + "/examples/bracket.p21"))
                .status,
            200);
  std::thread binder([&] {
    const auto reply = Client(server.socket()).ask("POST", path + "/bind", R"({"deadline_ms": 600000})");
    EXPECT_EQ(reply.json()["status"], "IMPOSSIBLE") << reply.body;
  });
  bool busy = false;
  for (int i = 0; i < 10'000 && !busy; ++i) busy = client.ask("GET", path + "/result").json()["busy"];
  EXPECT_TRUE(busy);
  EXPECT_EQ(client.ask("GET", path + "/open").status, 409);
  // A stop is of the call that runs: until it began to bind there is none.
  for (int i = 0; i < 10'000 && client.ask("GET", path + "/result").json()["busy"]; ++i)
    EXPECT_EQ(client.ask("POST", path + "/cancel").status, 200);
  binder.join();
}

TEST_F(Serve, EndsTheBindOfAClientThatIsGone) {
  RunningServer server;
  Client client(server.socket());
  const std::string path = opened(client);
  ASSERT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  Client gone(server.socket());
  gone.send("POST " + path + "/bind HTTP/1.1\r\nContent-Length: 23\r\n\r\n{\"deadline_ms\": 600000} ");
  while (!client.ask("GET", path + "/result").json()["busy"] &&
         client.ask("GET", "/metrics").body.find("capstan_binds_total{") == std::string::npos) {
  }
  gone.leave();
  for (int i = 0; i < 3000 && client.ask("GET", path + "/result").json()["busy"]; ++i)
    std::this_thread::sleep_for(milliseconds(10));
  EXPECT_FALSE(client.ask("GET", path + "/result").json()["busy"]);
  EXPECT_TRUE(answers(server));
}

TEST_F(Serve, EndsWhileItIsAskedAndAnswersWhoAsked) {
  auto server = std::make_unique<RunningServer>();
  Client client(server->socket());
  const std::string path = opened(client);
  ASSERT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  std::thread binder([&, socket = server->socket()] {
    const auto reply = Client(socket).ask("POST", path + "/bind", R"({"deadline_ms": 600000})");
    EXPECT_THAT((std::set{200, 409, 503}), ::testing::Contains(reply.status)) << reply.body;
  });
  for (bool busy = false;
       !busy && client.ask("GET", "/metrics").body.find("binds_total{") == std::string::npos;)
    busy = client.ask("GET", path + "/result").json()["busy"];
  server->end();
  binder.join();
}

TEST_F(Serve, SessionsBeginWithTheOptionsOfTheServer) {
  RunningServer server({}, {{"machine", "generic_vmc"}, {"tools", magazine_file()}});
  Client client(server.socket());
  const auto reply = client.ask("POST", "/v1/sessions");
  ASSERT_EQ(reply.status, 201) << reply.body;
  const std::string path = "/v1/sessions/" + reply.json()["session"].get<std::string>();
  ASSERT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  EXPECT_EQ(client.ask("POST", path + "/bind", R"({"deadline_ms": 600000})").status, 200);
  EXPECT_EQ(client.ask("GET", path + "/output/nothing").status, 404);
}

}  // namespace
}  // namespace capstan::transport
