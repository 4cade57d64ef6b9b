#include "casebase/tune/start.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "casebase/recall/advice.h"
#include "casebase/recall/recall.h"

namespace capstan::casebase::tune {
namespace {

constexpr Values kAsked = {.vc_m_min = 200.0, .fz_mm = 0.1, .ap_mm = 4.0};

Question question() {
  return {.operation = "DRILLING",
          .material_group = "P/mild_steel",
          .tool_class = "hss/twist_drill",
          .machine_class = "mill",
          .diameter_mm = 10.0,
          .depth_mm = 20.0,
          .cutter_diameter_mm = 10.0};
}

/// Measured good cuts of parts of their own at these shares of the speed asked.
class Shop {
 public:
  Case& cut(const std::string& edge, double speed) {
    Case c;
    c.origin = Origin::kMeasured;
    c.asked = question();
    c.bound.vc_m_min = speed * kAsked.vc_m_min;
    c.bound.fz_mm = kAsked.fz_mm;
    c.bound.ap_mm = kAsked.ap_mm;
    c.observed.verdict = Verdict::kGood;
    c.from.tool_instance = edge;
    c.from.part = std::to_string(near_.size());
    c.from.source = "log";
    near_.push_back({c, 0.0});
    return near_.back().found;
  }
  void cuts(std::size_t n, const std::string& edge, double speed) {
    for (std::size_t i = 0; i < n; ++i) cut(edge, speed);
  }
  [[nodiscard]] std::optional<ProvenStart> proven(const Values& than = kAsked) {
    for (std::size_t i = 0; i < near_.size(); ++i) near_[i].found.id = id_of(near_[i].found);
    return proven_start(near_, evidence_of(near_, question()), question(), kAsked, than);
  }

 private:
  std::vector<Neighbour> near_;
};

/// Five parts at the values asked, and four faster ones on two edges.
Shop tuned(double speed = 1.1) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  shop.cuts(2, "E1", speed);
  shop.cuts(2, "E2", speed);
  return shop;
}

TEST(ProvenStart, IsTheFasterSettingThatRepeatsOnTwoEdgesHaveProven) {
  const auto found = tuned().proven();
  ASSERT_TRUE(found);
  EXPECT_NEAR(found->vc_m_min, 1.1 * kAsked.vc_m_min, 1e-9);
  EXPECT_NEAR(found->fz_mm, kAsked.fz_mm, 1e-12);
  EXPECT_EQ(found->repeats.good, 4U);
  EXPECT_EQ(found->repeats.edges, 2U);
}

TEST(ProvenStart, IsNoneWhereThereIsNoCase) { EXPECT_FALSE(Shop().proven()); }

TEST(ProvenStart, IsNoneWhereOneEdgeAloneCutFaster) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  shop.cuts(20, "E1", 1.1);
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, DaysOfOneEdgeProveNothing) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  for (int day = 1; day <= 9; ++day)
    shop.cut("E1", 1.1).from.time_utc = "2199-06-0" + std::to_string(day) + "T08:00:00Z";
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, CopiesOfOneObservationUnderNamesOfOtherEdgesAreOne) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  for (int i = 0; i < 1000; ++i) {
    Observed& o = shop.cut("copy " + std::to_string(i), 1.1).observed;
    o.time_s = Figure{12.5};
    o.power_w = Figure{310.0};
    o.size_deviation_mm = Figure{0.004};
  }
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, IsNeverBeyondTheReachOfCases) {
  EXPECT_TRUE(tuned(kCaseReach - 0.01).proven());
  EXPECT_FALSE(tuned(kCaseReach + 0.01).proven());
}

TEST(ProvenStart, EnteredCutsProveNothing) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  for (const char* edge : {"E1", "E1", "E2", "E2"}) shop.cut(edge, 1.1).origin = Origin::kEntered;
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, CutsLessDeepThanWhatIsAskedProveNothing) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  for (const char* edge : {"E1", "E1", "E2", "E2"}) shop.cut(edge, 1.1).bound.ap_mm = 0.5 * kAsked.ap_mm;
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, CutsOfUnknownDepthProveNothingWhereOneIsAsked) {
  Shop shop;
  shop.cuts(5, "E1", 1.0);
  for (const char* edge : {"E1", "E1", "E2", "E2"}) shop.cut(edge, 1.1).bound.ap_mm = 0.0;
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, CutsOfUnnamedToolsAndOtherEdgesOfOneToolAreNoRepeats) {
  Shop unnamed;
  unnamed.cuts(5, "E1", 1.0);
  unnamed.cuts(2, "E1", 1.1);
  unnamed.cuts(4, "", 1.1);
  EXPECT_FALSE(unnamed.proven());
  Shop one_tool;
  one_tool.cuts(5, "E1", 1.0);
  one_tool.cuts(2, "E1", 1.1);
  for (int i = 0; i < 4; ++i) one_tool.cut("E1", 1.1).from.tool_edge = "1";
  EXPECT_FALSE(one_tool.proven());
}

TEST(ProvenStart, FailuresAtThatSettingForbidIt) {
  Shop shop = tuned();
  for (int i = 0; i < 2; ++i) shop.cut("E2", 1.1).observed.verdict = Verdict::kBad;
  EXPECT_FALSE(shop.proven());
}

TEST(ProvenStart, IsNoneThatIsSlowerThanWhatThereIs) {
  Values faster = kAsked;
  faster.vc_m_min *= 1.15;
  EXPECT_FALSE(tuned().proven(faster));
}

}  // namespace
}  // namespace capstan::casebase::tune
