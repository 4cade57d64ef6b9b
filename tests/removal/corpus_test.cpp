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

// The raw piece that a plan says it takes: the file states none.
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
  const Box raw = raw_of(o.plan.json);
  RandomPart part{{"example2", "", raw, example2(raw), {0.7, 0.3, 0.2}, options}, {}};
  const auto space = [&](const char* name, double x0, double y0, double x1, double y1) {
    part.features.push_back({name, {{x0, y0, raw.lo.z}, {x1, y1, raw.hi.z}}});
  };
  space("TEE_SLOT1 ", 0, 74, 66, 106);
  space("SIDE-SLOT1", 138, 68, 182, 112);
  space("STEP1", 230, 40, 260, 140);
  space("PATTERN_HOLE6", 238, 63, 252, 117);
  o.verdict = simulate({o.plan.linuxcnc, o.plan.tool_table, o.plan.json, o.plan.iso14649}, raw,
                       part.part.target, part.part.grid);
  EXPECT_EQ(broken_promise(part, o), "") << o.text();
  EXPECT_LE(o.plan.unplanned, 3U);
}

}  // namespace
}  // namespace capstan::testing::removal
