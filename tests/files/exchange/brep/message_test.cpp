#include "planner/files/exchange/brep/message.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/files/exchange/brep/support.h"

namespace capstan::exchange {
namespace {

using testing::some_message;

TEST(BrepMessage, WhatIsEncodedIsDecoded) {
  std::mt19937 random(1);
  for (int i = 0; i < 500; ++i) {
    const BrepMessage m = some_message(random);
    const auto back = decoded(encoded(m));
    ASSERT_TRUE(back) << to_text(back.error());
    ASSERT_EQ(*back, m) << "message " << i;
  }
}

TEST(BrepMessage, RefusalsAreKept) {
  BrepMessage m;
  m.remarks.push_back(
      {.code = "BREP-EMPTY", .message = "no shape", .instance = 12, .hint = "export a solid"});
  const auto back = decoded(encoded(m));
  ASSERT_TRUE(back) << to_text(back.error());
  EXPECT_EQ(*back, m);
}

TEST(BrepMessage, NeitherShapeNorErrorIsRefused) {
  BrepMessage m;
  m.remarks.push_back({.code = "BREP-PLACED", .severity = Severity::kNote, .message = "placed twice"});
  const auto back = decoded(encoded(m));
  ASSERT_FALSE(back);
  EXPECT_NE(back.error().message.find("neither"), std::string::npos) << back.error().message;
}

TEST(BrepMessage, EveryTruncationIsRefused) {
  std::mt19937 random(2);
  const std::string whole = encoded(some_message(random));
  for (std::size_t n = 0; n < whole.size(); ++n) {
    const auto back = decoded(std::string_view(whole).substr(0, n));
    ASSERT_FALSE(back) << n << " of " << whole.size() << " bytes";
    ASSERT_EQ(back.error().code, "BREP-MESSAGE");
  }
  EXPECT_FALSE(decoded(whole + '\0'));
}

// A byte changed gives a refusal, or a message that is spelt by just these bytes.
TEST(BrepMessage, ChangedBytesAreRefusedOrSpeltTheSameAgain) {
  std::mt19937 random(3);
  std::size_t refused = 0;
  for (int round = 0; round < 3000; ++round) {
    std::string bytes = encoded(some_message(random));
    for (int k = 0; k < 3; ++k)
      bytes[std::uniform_int_distribution<std::size_t>(0, bytes.size() - 1)(random)] =
          static_cast<char>(std::uniform_int_distribution<int>(0, 255)(random));
    const auto back = decoded(bytes);
    if (back) {
      ASSERT_EQ(encoded(*back), bytes);
    } else {
      ++refused;
    }
  }
  EXPECT_GT(refused, 0U);
}

TEST(BrepMessage, ALengthThatLiesIsRefusedWithoutItsMemory) {
  BrepMessage m;
  m.brep.emplace();
  std::string bytes = encoded(m);
  // The list of remarks stands first, behind 8 of magic, 4 of version and 8 of size.
  for (std::size_t i = 20; i < 27; ++i) bytes[i] = '\x7f';
  const auto back = decoded(bytes);
  ASSERT_FALSE(back);
  EXPECT_NE(back.error().message.find("longer than the message"), std::string::npos) << back.error().message;
}

TEST(BrepMessage, AnotherVersionIsNamed) {
  BrepMessage m;
  m.brep.emplace();
  std::string bytes = encoded(m);
  bytes[8] = 9;
  const auto back = decoded(bytes);
  ASSERT_FALSE(back);
  EXPECT_NE(back.error().message.find("version is 9"), std::string::npos) << back.error().message;
}

struct LooseEnd {
  const char* name;
  void (*make)(Brep&);
};
void PrintTo(const LooseEnd& l, std::ostream* out) { *out << l.name; }

class LooseEnds : public ::testing::TestWithParam<LooseEnd> {};

TEST_P(LooseEnds, AreRefused) {
  std::mt19937 random(4);
  BrepMessage m = some_message(random);
  m.brep->faces.front().loops = {{.edges = {0}, .forward = {true}}};
  ASSERT_TRUE(decoded(encoded(m)));
  GetParam().make(*m.brep);
  EXPECT_FALSE(decoded(encoded(m)));
}

INSTANTIATE_TEST_SUITE_P(
    Each, LooseEnds,
    ::testing::Values(
        LooseEnd{"bodies_short", [](Brep& b) { b.bodies.back().face_count -= 1; }},
        LooseEnd{"bodies_long", [](Brep& b) { b.bodies.back().face_count += 1; }},
        LooseEnd{"body_apart", [](Brep& b) { b.bodies.front().first_face = 1; }},
        LooseEnd{"edge_of_loop", [](Brep& b) { b.faces[0].loops[0].edges[0] = 1U << 20; }},
        LooseEnd{"sense_missing", [](Brep& b) { b.faces[0].loops[0].forward.clear(); }},
        LooseEnd{"face_of_edge",
                 [](Brep& b) { b.edges[0].face[1] = static_cast<std::uint32_t>(b.faces.size()); }},
        LooseEnd{"triangles_apart", [](Brep& b) { b.faces[0].first_triangle = 1; }},
        LooseEnd{"triangle_left_over",
                 [](Brep& b) {
                   b.triangles.push_back({0, 0, 0});
                 }},
        LooseEnd{"point_of_triangle",
                 [](Brep& b) {
                   b.triangles.push_back({0, 0, static_cast<std::uint32_t>(b.points.size())});
                   b.faces.back().triangle_count += 1;
                 }},
        LooseEnd{"nan", [](Brep& b) { b.edges[0].radius = std::numeric_limits<double>::quiet_NaN(); }},
        LooseEnd{"infinite", [](Brep& b) { b.points[0].y = std::numeric_limits<double>::infinity(); }}),
    [](const auto& row) { return row.param.name; });

}  // namespace
}  // namespace capstan::exchange
