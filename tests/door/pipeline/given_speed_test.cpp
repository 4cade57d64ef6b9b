#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "planner/model/plan/decision/condemned.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// Speeds that a file gives are held against the material, as chosen ones are: examples/plate_bound.p21 mills
// its pocket of C45 at 1260 1/min with a mill of 12 mm, 47.5 m/min. The card bears 20 m/min with HSS, 78 with
// carbide.

namespace capstan::pipeline {
namespace {

constexpr const char* kEdge = "#91=MATERIAL('ISO 513','CARBIDE',());\n";

struct Judged {
  model::Plan plan;
  std::vector<model::Finding> findings;
  [[nodiscard]] std::vector<std::string> codes(Severity severity) const {
    std::vector<std::string> out;
    for (const auto& f : findings)
      if (f.severity == severity) out.push_back(f.step + ": " + f.code);
    return out;
  }
};

/// The plate with another edge of its mill.
Judged plate(const std::string& edge, const std::string& material = "") {
  std::string text = testing::slurp(capstan::testing::source_dir() + "/examples/plate_bound.p21");
  const auto at = text.find(kEdge);
  EXPECT_NE(at, std::string::npos);
  text.replace(at, std::string(kEdge).size(), edge);
  if (edge.empty()) {
    const std::string points = "(60.,#91,";
    text.replace(text.find(points), points.size(), "(60.,$,");
  }
  Job job;
  ShopFiles names;
  names.material = material;
  auto in = load_shop(names, job);
  EXPECT_TRUE(in) << (in ? "" : to_text(in.error()));
  auto read = read_plan(text, "plate.p21", job);
  EXPECT_TRUE(read);
  auto bound = bind(*std::move(read), *in, {}, job);
  EXPECT_TRUE(bound);
  Judged out;
  out.plan = *std::move(bound);
  out.findings = verify::check_plan(out.plan, job);
  return out;
}

TEST(GivenSpeed, ThatCarbideBearsIsNoFinding) {
  const auto judged = plate(kEdge);
  EXPECT_TRUE(judged.codes(Severity::kError).empty());
  EXPECT_TRUE(judged.codes(Severity::kWarning).empty());
}

// 15 min x (1.5 x 20 / 47.5)^8 = 0.38 min, and the roughing cuts for five.
TEST(GivenSpeed, ThatBurnsAnEdgeOfHssWritesNoProgram) {
  const auto judged = plate("#91=MATERIAL('ISO 4957','HSS',());\n");
  const auto errors = judged.codes(Severity::kError);
  EXPECT_NE(std::find(errors.begin(), errors.end(), "ROUGH POCKET: CHK-EDGE-LIFE"), errors.end());
  EXPECT_FALSE(model::condemned(judged.plan, judged.findings).empty());
}

TEST(GivenSpeed, OfAMillThatNobodySaysIsHssIsToldAndNotCondemned) {
  const auto judged = plate("");
  EXPECT_TRUE(judged.codes(Severity::kError).empty());
  const auto told = judged.codes(Severity::kWarning);
  // By that speed it is taken for carbide: what is told is the plan's, not a step's.
  EXPECT_NE(std::find(told.begin(), told.end(), ": CHK-TOOL-MATERIAL"), told.end());
}

TEST(GivenSpeed, InHardenedSteelIsRefused) {
  for (const char* edge : {kEdge, ""}) {
    const auto judged = plate(edge, "hardened_steel_60");
    EXPECT_FALSE(judged.codes(Severity::kError).empty()) << edge;
    EXPECT_FALSE(model::condemned(judged.plan, judged.findings).empty()) << edge;
  }
}

}  // namespace
}  // namespace capstan::pipeline
