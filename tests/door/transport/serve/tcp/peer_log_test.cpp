#include "planner/door/transport/serve/peer_log.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <future>
#include <string>
#include <thread>
#include <vector>

namespace capstan::transport {
namespace {

using std::chrono::milliseconds;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::SizeIs;

TEST(PeerLog, OfManyWhoAreRefusedInASecondOneIsToldAndTheOthersAreCounted) {
  std::vector<std::string> lines;
  PeerLog log([&](const std::string& line) {
    lines.push_back(line);
    return true;
  });
  const PeerLog::Clock::time_point then = PeerLog::Clock::now();
  for (int i = 0; i < 5; ++i) log.refused("a:1", "why", then + milliseconds(100 * i));
  log.connected("b:2", "CN=mill 3");
  log.refused("c:3", "other", then + milliseconds(1001));
  EXPECT_THAT(lines, ElementsAre("a:1 is refused: why", "b:2 is 'CN=mill 3'",
                                 "c:3 is refused: other (4 more since the last such line)"));
}

TEST(PeerLog, OfManyWhoConnectInASecondSixteenAreTold) {
  std::vector<std::string> lines;
  PeerLog log([&](const std::string& line) {
    lines.push_back(line);
    return true;
  });
  const PeerLog::Clock::time_point then = PeerLog::Clock::now();
  for (int i = 0; i < 100; ++i) log.connected("b:2", "CN=mill 3", then + milliseconds(i));
  EXPECT_THAT(lines, SizeIs(16));
  EXPECT_THAT(lines, Each("b:2 is 'CN=mill 3'"));
  log.connected("b:2", "CN=mill 3", then + milliseconds(1000));
  EXPECT_EQ(lines.back(), "b:2 is 'CN=mill 3' (84 more since the last such line)");
}

TEST(PeerLog, AWriterThatIsHeldHoldsNoOtherThreadAndWhatWaitsIsBounded) {
  std::promise<void> begun, go;
  std::vector<std::string> lines;
  PeerLog log([&](const std::string& line) {
    if (lines.empty()) {
      begun.set_value();
      go.get_future().wait();
    }
    lines.push_back(line);
    return true;
  });
  const PeerLog::Clock::time_point then = PeerLog::Clock::now();
  std::thread held([&] { log.refused("a:1", "first", then); });
  begun.get_future().wait();
  // These return while the first is being written; 64 of them wait.
  for (int i = 1; i <= 100; ++i) log.refused("a:1", "later", then + std::chrono::seconds(i));
  go.set_value();
  held.join();
  EXPECT_THAT(lines, SizeIs(65));
  log.refused("a:1", "last", then + std::chrono::seconds(101));
  EXPECT_EQ(lines.back(), "a:1 is refused: last (36 more since the last such line)");
}

TEST(PeerLog, ALineThatIsNotWrittenIsCountedWithTheNext) {
  bool writes = false;
  std::vector<std::string> lines;
  PeerLog log([&](const std::string& line) {
    if (writes) lines.push_back(line);
    return writes;
  });
  const PeerLog::Clock::time_point then = PeerLog::Clock::now();
  log.refused("a:1", "lost", then);
  writes = true;
  log.refused("a:1", "told", then + std::chrono::seconds(1));
  EXPECT_THAT(lines, ElementsAre("a:1 is refused: told (1 more since the last such line)"));
}

TEST(PeerLog, ALineIntoAPipeThatNobodyReadsIsLeftOutAndHoldsNobody) {
  std::array<int, 2> ends = {};
  ASSERT_EQ(::pipe2(ends.data(), O_CLOEXEC), 0);
  int written = 0;
  while (written < 100000 && write_line(ends[1], std::string(10000, 'a'))) ++written;
  EXPECT_GT(written, 0);
  EXPECT_LT(written, 100000);
  std::array<char, 8192> bytes = {};
  ASSERT_EQ(::read(ends[0], bytes.data(), bytes.size()), 8192);
  EXPECT_TRUE(write_line(ends[1], "there is room"));
  ::close(ends[0]);
  ::close(ends[1]);
}

}  // namespace
}  // namespace capstan::transport
