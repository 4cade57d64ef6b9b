#include "planner/door/transport/serve/wire/http.h"

#include <gtest/gtest.h>

#include <random>

namespace capstan::transport {
namespace {

using State = RequestReader::State;

class Http : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!http_is_built()) GTEST_SKIP() << "no Boost.Beast";
  }
};

TEST_F(Http, ReadsARequestInAnyPieces) {
  const std::string bytes =
      "PUT /v1/sessions/s1/plan?x=1 HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\n\r\nhello";
  for (std::size_t piece = 1; piece <= bytes.size(); ++piece) {
    RequestReader reader(1000, 1000);
    auto state = State::kMore;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      ASSERT_EQ(state, State::kMore) << piece;
      state = reader.take(std::string_view(bytes).substr(at, piece));
    }
    ASSERT_EQ(state, State::kWhole) << piece;
    const HttpRequest request = reader.request();
    EXPECT_EQ(request.method, "PUT");
    EXPECT_EQ(request.path, "/v1/sessions/s1/plan");
    EXPECT_EQ(request.body, "hello");
    EXPECT_TRUE(reader.keeps_alive());
    EXPECT_TRUE(reader.idle());
  }
}

TEST_F(Http, KeepsWhatCameAfterARequestForTheNext) {
  RequestReader reader(1000, 1000);
  const std::string two = "GET /health HTTP/1.1\r\n\r\nGET /metrics HTTP/1.1\r\nConnection: close\r\n\r\n";
  ASSERT_EQ(reader.take(two), State::kWhole);
  EXPECT_EQ(reader.request().path, "/health");
  EXPECT_FALSE(reader.idle());
  ASSERT_EQ(reader.take({}), State::kWhole);
  EXPECT_EQ(reader.request().path, "/metrics");
  EXPECT_FALSE(reader.keeps_alive());
  EXPECT_EQ(reader.take({}), State::kMore);
}

TEST_F(Http, RefusesWhatIsTooLongWithoutKeepingIt) {
  RequestReader header(100, 1000);
  auto state = State::kMore;
  std::size_t sent = 0;
  for (; state == State::kMore && sent < 10'000; ++sent) state = header.take("a");
  EXPECT_EQ(state, State::kWrong);
  EXPECT_LE(sent, 102U);
  RequestReader body(1000, 10);
  ASSERT_EQ(body.take("POST / HTTP/1.1\r\nContent-Length: 11\r\n\r\n"), State::kWrong);
  EXPECT_EQ(body.fault().status, 413U);
  RequestReader chunks(1000, 10);
  ASSERT_EQ(chunks.take("POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nb\r\n"), State::kWrong);
  EXPECT_EQ(chunks.fault().status, 413U);
  RequestReader most(1000, 10);
  EXPECT_EQ(most.take("POST / HTTP/1.1\r\nContent-Length: 10\r\n\r\n0123456789"), State::kWhole);
}

TEST_F(Http, TheFirstLineOfAChunkHasAnEnd) {
  RequestReader reader(200, 1000);
  auto state = reader.take("PUT /v1/sessions/s1/plan HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n");
  std::size_t sent = 0;
  for (; state == State::kMore && sent < 10'000; ++sent) state = reader.take("1");
  EXPECT_EQ(state, State::kWrong);
  EXPECT_LT(sent, 1000u);
}

TEST_F(Http, RefusesALongHeaderAs431) {
  RequestReader reader(100, 1000);
  ASSERT_EQ(reader.take("GET / HTTP/1.1\r\nX: " + std::string(200, 'a') + "\r\n\r\n"), State::kWrong);
  EXPECT_EQ(reader.fault().status, 431U);
}

TEST_F(Http, RefusesWhatIsNoRequest) {
  for (const char* bytes :
       {"\r\n\r\nnonsense\r\n\r\n", "GET /\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "{\"deadline_ms\": 1}\r\n\r\n",
        "POST / HTTP/1.1\r\nContent-Length: -1\r\n\r\n", "POST / HTTP/1.1\r\nContent-Length: 1e3\r\n\r\n",
        "POST / HTTP/1.1\r\nContent-Length: 99999999999999999999\r\n\r\n",
        "POST / HTTP/1.1\r\nContent-Length: 1\r\nContent-Length: 2\r\n\r\n",
        "POST / HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\nzz\r\n",
        "GET / HTTP/1.1\r\nbad header\r\n\r\n"}) {
    RequestReader reader(1000, 1000);
    EXPECT_EQ(reader.take(bytes), State::kWrong) << bytes;
    EXPECT_GE(reader.fault().status, 400U) << bytes;
  }
}

TEST_F(Http, AsksOnceWhetherTheBodyMayCome) {
  RequestReader reader(1000, 1000);
  EXPECT_FALSE(reader.asks_to_continue());
  ASSERT_EQ(reader.take("PUT / HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 2\r\n\r\n"), State::kMore);
  EXPECT_TRUE(reader.asks_to_continue());
  EXPECT_FALSE(reader.asks_to_continue());
  EXPECT_EQ(reader.take("ab"), State::kWhole);
}

TEST_F(Http, RepliesAreSpelledAsTheStandardSays) {
  const std::string reply = to_bytes({.status = 503, .body = "late\n", .retry_after_s = 1}, false);
  EXPECT_EQ(reply.substr(0, reply.find("\r\n")), "HTTP/1.1 503 Service Unavailable");
  for (const char* line : {"Content-Length: 5\r\n", "Connection: close\r\n", "Retry-After: 1\r\n"})
    EXPECT_NE(reply.find(line), std::string::npos) << reply;
  EXPECT_EQ(reply.substr(reply.size() - 9), "\r\n\r\nlate\n");
}

// Bytes that were changed at random: read in one piece and in many, the same requests come of them. (That
// what follows will never be one may be seen sooner in one of them.)
TEST_F(Http, PropertyOfAnyBytesIsTheSameRequestsInAnyPieces) {
  std::mt19937_64 random(static_cast<std::uint64_t>(::testing::UnitTest::GetInstance()->random_seed()));
  const std::string good =
      "PUT /v1/sessions/s1/plan HTTP/1.1\r\nHost: a\r\nContent-Length: 5\r\nExpect: 100-continue\r\n\r\nhello"
      "POST /v1/sessions HTTP/1.1\r\nTransfer-Encoding: chunked\r\n\r\n3\r\nabc\r\n0\r\n\r\n";
  const auto all = [&](const std::string& bytes, std::size_t piece) {
    RequestReader reader(200, 100);
    std::string out;
    for (std::size_t at = 0; at < bytes.size(); at += piece) {
      auto state = reader.take(std::string_view(bytes).substr(at, piece));
      for (; state == State::kWhole; state = reader.take({})) {
        const HttpRequest r = reader.request();
        out += r.method + " " + r.path + " " + r.body + "\n";
      }
      if (state == State::kWrong) {
        EXPECT_GE(reader.fault().status, 400U);
        return out;
      }
    }
    return out;
  };
  EXPECT_EQ(all(good, 1), "PUT /v1/sessions/s1/plan hello\nPOST /v1/sessions abc\n");
  for (int i = 0; i < 2000; ++i) {
    std::string bytes = good;
    const auto edits = 1 + random() % 3;
    for (std::uint64_t k = 0; k < edits; ++k)
      bytes[random() % bytes.size()] = static_cast<char>(random() % 256);
    const std::string once = all(bytes, bytes.size());
    EXPECT_EQ(all(bytes, 1), once) << ::testing::PrintToString(bytes);
    EXPECT_EQ(all(bytes, 7), once) << ::testing::PrintToString(bytes);
  }
}

}  // namespace
}  // namespace capstan::transport
