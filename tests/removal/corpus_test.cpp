#include <gtest/gtest.h>

#include <cstdlib>

#include "tests/removal/parts.h"
#include "tests/removal/random_part.h"
#include "tests/support/corpus.h"
#include "tests/support/rs274.h"

namespace capstan::testing::removal {
namespace {

// The number after a key of the plan's text.
double number_after(const std::string& text, const std::string& key, std::size_t from) {
  const auto at = text.find(key, from);
  return at == std::string::npos ? 0.0 : std::strtod(text.c_str() + at + key.size(), nullptr);
}

// The raw piece that a plan takes: the file states none.
Box raw_of(const std::string& json) {
  const auto at = json.find("\"stock\":");
  const auto lo = json.find("\"lo\":", at), hi = json.find("\"hi\":", at);
  const auto point = [&](std::size_t from) {
    return Point{number_after(json, "\"x\":", from), number_after(json, "\"y\":", from),
                 number_after(json, "\"z\":", from)};
  };
  return {point(lo), point(hi)};
}

TEST(RemovalCorpus, Example2ComesOutAsItsFiguresSay) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2_mended.p21");
  CAPSTAN_NEEDS_RS274();
  PlanOptions options;
  options.reopen = "all";
  options.threads = 2;
  Outcome o;
  o.plan = plan_file(path, options);
  ASSERT_TRUE(o.written()) << o.text();
  // The plate of 260 x 180, 5 mm of stock over its head, 50 mm deep as its side is, 5 mm before that side.
  const Box raw{{0, -5, -50}, {260, 180, 5}};
  const Box taken = raw_of(o.plan.json);
  EXPECT_NEAR(taken.lo.x, raw.lo.x, 1e-9);
  EXPECT_NEAR(taken.lo.y, raw.lo.y, 1e-9);
  EXPECT_NEAR(taken.lo.z, raw.lo.z, 1e-9);
  EXPECT_NEAR(taken.hi.x, raw.hi.x, 1e-9);
  EXPECT_NEAR(taken.hi.y, raw.hi.y, 1e-9);
  EXPECT_NEAR(taken.hi.z, raw.hi.z, 1e-9);
  RandomPart part{{"example2", "", raw, example2(raw), {0.7, 0.3, 0.2}, options}, {}};
  const auto space = [&](const char* name, double x0, double y0, double x1, double y1) {
    part.features.push_back({name, {{x0, y0, raw.lo.z}, {x1, y1, raw.hi.z}}});
  };
  space("SIDE-SLOT1", 138, 68, 182, 112);
  o.verdict = simulate({o.plan.linuxcnc, o.plan.tool_table, o.plan.json, o.plan.iso14649}, raw,
                       part.part.target, part.part.grid);
  EXPECT_EQ(broken_promise(part, o), "") << o.text();
  EXPECT_EQ(o.plan.unplanned, 1U) << "the side slot alone";
}

}  // namespace
}  // namespace capstan::testing::removal
