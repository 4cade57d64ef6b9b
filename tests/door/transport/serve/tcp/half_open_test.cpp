#include "planner/door/transport/serve/half_open.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>

namespace capstan::transport {
namespace {

/// A connected pair; the second end sees whether the first was shut down.
class Pair {
 public:
  Pair() { EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends_.data()), 0); }
  Pair(const Pair&) = delete;
  Pair& operator=(const Pair&) = delete;
  ~Pair() {
    ::close(ends_[0]);
    ::close(ends_[1]);
  }
  [[nodiscard]] int fd() const { return ends_[0]; }
  [[nodiscard]] bool shut() const {
    pollfd of = {ends_[1], POLLIN, 0};
    return ::poll(&of, 1, 0) == 1;
  }

 private:
  std::array<int, 2> ends_ = {};
};

TEST(HalfOpen, TheOldestThatStaysGivesWayToANewOne) {
  HalfOpen places(2);
  const Pair one, two, three, four;
  EXPECT_TRUE(places.enter(one.fd()));
  EXPECT_TRUE(places.enter(two.fd()));
  EXPECT_FALSE(one.shut());
  EXPECT_TRUE(places.enter(three.fd()));
  EXPECT_TRUE(one.shut());
  EXPECT_FALSE(two.shut());
  EXPECT_TRUE(places.enter(four.fd()));
  EXPECT_TRUE(two.shut());
  EXPECT_TRUE(places.leave(one.fd()));
  EXPECT_FALSE(places.leave(three.fd()));
  EXPECT_EQ(places.count(), 2U);
}

TEST(HalfOpen, WhereTwiceAsManyAreStillThereNobodyEnters) {
  HalfOpen places(1);
  const Pair one, two, three;
  EXPECT_TRUE(places.enter(one.fd()));
  EXPECT_TRUE(places.enter(two.fd()));
  EXPECT_TRUE(places.full());
  EXPECT_FALSE(places.enter(three.fd())) << "at once: who accepts waits for nobody";
  EXPECT_FALSE(two.shut());
  places.leave(one.fd());
  EXPECT_FALSE(places.full());
  EXPECT_TRUE(places.enter(three.fd()));
}

}  // namespace
}  // namespace capstan::transport
