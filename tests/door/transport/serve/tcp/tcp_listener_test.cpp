#include "planner/door/transport/serve/wire/tcp_listener.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace capstan::transport {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(TcpListener, TakesAddressesInNumbersAndSaysThePortThatItHas) {
  for (const auto& [address, begins] :
       {std::pair<std::string, std::string>{"127.0.0.1:0", "127.0.0.1:"}, {"0.0.0.0:0", "0.0.0.0:"}}) {
    const auto made = TcpListener::listen(address);
    ASSERT_TRUE(made) << to_text(made.error());
    EXPECT_THAT(made->address(), StartsWith(begins));
    EXPECT_GT(std::stoi(made->address().substr(begins.size())), 0);
  }
}

TEST(TcpListener, WhatIsNoAddressWithAPortIsRefusedWithWhatWasExpected) {
  for (const char* text :
       {"", ":8443", "8443", "127.0.0.1", "127.0.0.1:", "127.0.0.1:x", "127.0.0.1:65536", "127.0.0.1:-1",
        "::1:8443", "[::1]", "[]:8443", "localhost:8443", "127.0.0.1:999999999999999999"}) {
    const auto made = TcpListener::listen(text);
    ASSERT_FALSE(made) << text;
    EXPECT_EQ(made.error().code, "SERVE-TCP") << text;
    EXPECT_THAT(made.error().expected, HasSubstr("127.0.0.1:8443")) << text;
  }
}

TEST(TcpListener, APortThatIsInUseIsRefused) {
  const auto first = TcpListener::listen("127.0.0.1:0");
  ASSERT_TRUE(first);
  const auto second = TcpListener::listen(first->address());
  ASSERT_FALSE(second);
  EXPECT_THAT(second.error().hint, HasSubstr("another port"));
}

}  // namespace
}  // namespace capstan::transport
