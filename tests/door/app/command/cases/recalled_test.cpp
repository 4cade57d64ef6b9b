#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "planner/door/service/reading.h"
#include "tests/door/app/command/command.h"
#include "tests/door/app/plans.h"
#include "tests/support/corpus.h"

// What was cut before, in the choice of chains, tools and strategies of the next plan: through the whole
// command.

namespace capstan::app {
namespace {

using casebase::Case;
using casebase::Origin;
using casebase::Verdict;
using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

const std::string kSpot =
    "  - {id: spot, class: spotdrill, substrate: hss, cutting_diameter: 10, shank_diameter: 10, teeth: 2, "
    "point_angle_deg: 90, maximum_depth_of_cut: 5, usable_length: 25, stick_out: 40, functional_length: 110, "
    "centre_cutting: true, pocket: 1}\n";
/// A twist drill of 10 mm that states its own values.
std::string drill(const std::string& id, const std::string& values, int teeth, double vc_m_min,
                  double fz_mm) {
  return "  - {id: " + id + ", class: twist_drill, " + values + ", teeth: " + std::to_string(teeth) +
         ", cutting_diameter: 10, shank_diameter: 10, maximum_depth_of_cut: 87, usable_length: 80, "
         "stick_out: "
         "95, functional_length: 165, centre_cutting: true, presets: [{material: P, vc_m_min: " +
         std::to_string(vc_m_min) + ", fz: " + std::to_string(fz_mm) + ", source: a test}]}\n";
}
const std::string kHss = "substrate: hss, point_angle_deg: 118";
const std::string kTwoFlutes = drill("two_flutes", kHss, 2, 30.0, 0.1);
/// 3 % slower, and too many teeth for a case of the other.
const std::string kThreeFlutes = drill("three_flutes", kHss, 3, 30.0, 0.0645);
/// What needs no spot drill: the rules' first choice.
const std::string kSolid = drill("solid", "substrate: carbide, point_angle_deg: 140", 2, 18.0, 0.1);

class Recalled : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    put("plate.p21", testing::drilled_plate());
  }
  void put_tools(const std::string& name, const std::string& tools) {
    put(name, "capstan_tools: 1\nunit: mm\nsource: a test\ntools:\n" + tools);
  }
  /// Plans the plate anew; `more`: further arguments. The steps of `json` as simulated cases.
  std::vector<Case> planned(const std::string& tools, const std::string& json, const std::string& more = "") {
    last_ = run("plan plate.p21 --material C45 --reopen all --tools " + tools + " -o " + json + " " + more);
    EXPECT_LE(last_.code, 1) << last_.err;
    return steps_of(json);
  }
  std::vector<Case> steps_of(const std::string& json) {
    Job job;
    const auto plan = service::read_plan(slurp(folder_ / json), json, job);
    if (!plan) {
      ADD_FAILURE() << to_text(plan.error());
      return {};
    }
    return casebase::cases_of(*plan, job);
  }
  /// Those steps as measured cuts of so many parts.
  void add(const std::vector<Case>& steps, int parts, Verdict verdict,
           const std::function<void(Case&)>& change = {}) {
    Job job;
    auto base = casebase::CaseBase::open_or_create((folder_ / "shop.db").string(), job);
    ASSERT_TRUE(base) << to_text(base.error());
    for (int part = 0; part < parts; ++part) {
      ++parts_;
      for (Case c : steps) {
        c.origin = Origin::kMeasured;
        c.observed = {};
        c.observed.verdict = verdict;
        c.from.part = std::to_string(parts_);
        if (change) change(c);
        const Status added = base->add(c);
        ASSERT_TRUE(added) << to_text(added.error());
      }
    }
  }
  /// What `explain` says of all steps.
  std::string explained(const std::string& json, const std::vector<Case>& steps) {
    std::string out;
    for (const Case& c : steps) out += run("explain " + json + " '" + c.from.workingstep + "'").out;
    return out;
  }
  /// The tools of a plan, in order.
  static std::vector<std::string> tools_of(const std::vector<Case>& steps) {
    std::vector<std::string> out;
    for (const Case& c : steps) out.push_back(c.asked.tool_class + ' ' + std::to_string(c.asked.teeth));
    return out;
  }

  Ran last_;
  int parts_ = 0;
};

// Solid carbide alone is estimated shorter by so little that a proven time decides.
TEST_F(Recalled, AChainWhoseCutsWentWellIsTakenInPlaceOfTheOneThatIsTakenWithoutThem) {
  put_tools("all.yaml", kSpot + kTwoFlutes + kSolid);
  put_tools("spotted.yaml", kSpot + kTwoFlutes);
  ASSERT_THAT(tools_of(planned("all.yaml", "rules.json")), ElementsAre("carbide/twist_drill 2"));
  const auto spotted = planned("spotted.yaml", "spotted.json");
  ASSERT_THAT(tools_of(spotted), ElementsAre("hss/spotdrill 2", "hss/twist_drill 2"));
  add(spotted, 5, Verdict::kGood);
  const auto by_cases = planned("all.yaml", "cases.json", "--cases shop.db");
  EXPECT_EQ(tools_of(by_cases), tools_of(spotted));
  const std::string why = explained("cases.json", by_cases);
  EXPECT_THAT(why, HasSubstr("5 cuts are near (5 good)"));
  EXPECT_THAT(why, HasSubstr("the rules prefer the chain taken"));
  EXPECT_EQ(run("check cases.json").code, 0);
}

TEST_F(Recalled, AChainThatFailedAgainAndAgainIsPutLastAndNamed) {
  put_tools("all.yaml", kSpot + kTwoFlutes + kSolid);
  const auto by_rules = planned("all.yaml", "rules.json");
  ASSERT_THAT(tools_of(by_rules), ElementsAre("carbide/twist_drill 2"));
  add(by_rules, 13, Verdict::kBad);
  const auto by_cases = planned("all.yaml", "cases.json", "--cases shop.db");
  EXPECT_THAT(tools_of(by_cases), ElementsAre("hss/spotdrill 2", "hss/twist_drill 2"));
  EXPECT_THAT(last_.err, AllOf(HasSubstr("CASE-BAD-NEAR"), HasSubstr("would be first, but failed before")));
  EXPECT_THAT(explained("cases.json", by_cases), HasSubstr("would be first, but failed before"));
}

TEST_F(Recalled, AToolThatDidWellIsTakenBeforeOneThatIsALittleFaster) {
  // Nobody has cut with the faster one, which is taken to go well in 90 of 100 cuts: that is worth 9 % of
  // time.
  put_tools("two.yaml", kSpot + kTwoFlutes + kThreeFlutes);
  put_tools("three.yaml", kSpot + kThreeFlutes);
  ASSERT_THAT(tools_of(planned("two.yaml", "table.json")),
              ElementsAre("hss/spotdrill 2", "hss/twist_drill 2"));
  auto cut = planned("three.yaml", "three.json");
  std::erase_if(cut, [](const Case& c) { return c.asked.tool_class != "hss/twist_drill"; });
  ASSERT_EQ(cut.size(), 1U);
  add(cut, 30, Verdict::kGood);
  const auto by_cases = planned("two.yaml", "cases.json", "--cases shop.db");
  EXPECT_THAT(tools_of(by_cases), ElementsAre("hss/spotdrill 2", "hss/twist_drill 3"));
  const std::string why = explained("cases.json", by_cases);
  EXPECT_THAT(why, HasSubstr("likely to go well, its time taken times 0.91"));
  EXPECT_THAT(
      why,
      HasSubstr("would be first by the table; with the times that cases tell, three_flutes comes before it"));
  EXPECT_THAT(last_.err, Not(HasSubstr("CASE-BAD-NEAR")));
}

TEST_F(Recalled, AStrategyThatFailedIsWarnedOfWithTheOneThatWentWell) {
  const std::string plan = "plan '" + testing::example("bracket.p21") + "' ";
  ASSERT_LE(run(plan + "-o plain.json").code, 1);
  auto steps = steps_of("plain.json");
  std::erase_if(steps, [](const Case& c) {
    return c.bound.strategy != "CONTOUR_PARALLEL" || c.asked.operation != "BOTTOM_AND_SIDE_FINISH_MILLING";
  });
  ASSERT_FALSE(steps.empty());
  add(steps, 5, Verdict::kBad);
  // So many that neither speeds nor tools are doubted.
  add(steps, 40, Verdict::kGood, [](Case& c) { c.bound.strategy = "CENTER_MILLING"; });
  last_ = run(plan + "--cases shop.db -o cases.json");
  ASSERT_LE(last_.code, 1) << last_.err;
  EXPECT_THAT(last_.err, HasSubstr("made by CONTOUR_PARALLEL, by which 5 of 5 near cuts failed; near it went "
                                   "well: CENTER_MILLING: 40 good, 0 failed"));
  EXPECT_THAT(explained("cases.json", steps), HasSubstr("CONTOUR_PARALLEL: 0 good, 5 failed"));
}

}  // namespace
}  // namespace capstan::app
