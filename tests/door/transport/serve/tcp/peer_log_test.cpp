#include "planner/door/transport/serve/peer_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <vector>

namespace capstan::transport {
namespace {

using ::testing::ElementsAre;

TEST(PeerLog, OfManyWhoAreRefusedInASecondOneIsToldAndTheOthersAreCounted) {
  std::vector<std::string> lines;
  PeerLog log([&](const std::string& line) { lines.push_back(line); });
  const PeerLog::Clock::time_point then = PeerLog::Clock::now();
  for (int i = 0; i < 5; ++i) log.refused("a:1", "why", then + std::chrono::milliseconds(100 * i));
  log.connected("b:2", "CN=mill 3");
  log.refused("c:3", "other", then + std::chrono::milliseconds(1001));
  EXPECT_THAT(lines, ElementsAre("a:1 is refused: why", "b:2 is 'CN=mill 3'",
                                 "c:3 is refused: other (4 more since the last such line)"));
}

}  // namespace
}  // namespace capstan::transport
