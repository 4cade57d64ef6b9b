#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "planner/files/json/json.h"
#include "planner/physics/mechanics/holding_constants.h"
#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// A part on two set-ups, in a vise and under clamps, planned and checked by the built program.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;

class Workholding : public ::testing::Test {
 protected:
  /// Exit code; `said` is what went to both streams.
  int run(const std::string& arguments) {
    std::string line = "cd '";
    line.append(folder_.string()).append("' && ").append(command_quoted()).append(" ").append(arguments);
    line.append(" >said.txt 2>&1");
    const int status = std::system(line.c_str());
    said_ = slurp("said.txt");
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
  [[nodiscard]] std::string slurp(const std::string& name) const {
    std::ifstream in(folder_ / name, std::ios::binary);
    std::ostringstream text;
    text << in.rdbuf();
    return text.str();
  }
  ::capstan::testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
  std::string said_;
};

/// The file of an example, as a shell takes it.
std::string quoted(const char* name) {
  std::string out = "'";
  out.append((fs::path(capstan::testing::source_dir()) / "examples" / name).string()).append("'");
  return out;
}

std::string plan_with(const std::string& workholding) {
  std::string out = "plan ";
  out.append(quoted("two_setups.p21")).append(" --workholding ").append(workholding).append(" -o p.json");
  return out;
}

TEST_F(Workholding, APartIsTurnedOverAndItsProgramKeepsClearOfJawsAndClamps) {
  ASSERT_EQ(run(plan_with(quoted("two_setups_holding.yaml")).append(" -o p.ngc -o p.p21")), 0) << said_;
  const std::string plan = slurp("p.json");
  EXPECT_THAT(plan, HasSubstr("vise.fixed_jaw"));
  EXPECT_THAT(plan, HasSubstr("\"clamp 2\""));
  const std::string text = slurp("p.p21");
  EXPECT_THAT(text, HasSubstr("SETUP_INSTRUCTION"));
  EXPECT_THAT(text, HasSubstr("face against the fixed jaw"));
  EXPECT_THAT(text, HasSubstr("-Z up; turned over, 180 deg about its X axis"));
  EXPECT_EQ(run("check p.json p.ngc"), 0) << said_;
  // The same paths between a jaw that somebody made higher afterwards: seen by the check alone.
  std::string moved = plan;
  const std::string jaw = "\"top_mm\":-20";
  std::size_t at = moved.find(jaw);
  if (at == std::string::npos) at = moved.find("\"top_mm\": -20");
  ASSERT_NE(at, std::string::npos);
  moved.replace(moved.find("-20", at), 3, "30");  // in the way of holders at the slot
  std::ofstream(folder_ / "moved.json", std::ios::binary) << moved;
  EXPECT_EQ(run("check moved.json"), 1) << said_;
  EXPECT_THAT(said_, HasSubstr("vise.fixed_jaw"));
  EXPECT_THAT(said_, HasSubstr("FIXTURE"));
  EXPECT_THAT(said_, ::testing::ContainsRegex("move [0-9]+ of step '"));
}

TEST_F(Workholding, AClampInTheWayIsRefusedWithTheMoveAndTheClamp) {
  EXPECT_EQ(run(plan_with(quoted("two_setups_clamp_in_way.yaml"))), 1) << said_;
  EXPECT_THAT(said_, HasSubstr("BOTTOM POCKET"));
  EXPECT_THAT(said_, HasSubstr("would enter 'clamp 1'"));
  EXPECT_THAT(said_, HasSubstr("move "));
  EXPECT_EQ(run("check p.json"), 0) << said_;  // what is left of the plan keeps clear
}

TEST_F(Workholding, IsChosenWhenNobodySaysHow) {
  ASSERT_EQ(run(plan_with("auto").append(" -o p.ngc")), 0) << said_;
  EXPECT_THAT(slurp("p.json"), HasSubstr("vise.moving_jaw"));
  EXPECT_EQ(run("check p.json p.ngc"), 0) << said_;
}

TEST_F(Workholding, FaultsOfTheFileAreToldOnceEach) {
  const auto with = [&](const std::string& setup) {
    std::ofstream(folder_ / "h.yaml") << "capstan_workholding: 1\nunit: mm\nsetups:\n  - " << setup << "\n";
    return run(plan_with("h.yaml"));
  };
  EXPECT_EQ(with("{setup: 1, fixture: grandfathers_vise}"), 2);
  EXPECT_THAT(said_, HasSubstr("unknown fixture 'grandfathers_vise'"));
  EXPECT_NE(with("{setup: 7, fixture: vise_125}"), 0);
  EXPECT_THAT(said_, HasSubstr("there is no set-up '7'"));
  EXPECT_NE(run(plan_with("no_such_file.yaml")), 0);
  EXPECT_THAT(said_, HasSubstr("no_such_file.yaml"));
}

/// A shop's file with fixtures only.
std::string shop_with_vise(double holding_force_n) {
  return R"(capstan_workholding: 1
unit: mm
fixtures:
  - id: our_vise
    kind: vise
    description: the vise on our table
    width: 130
    thickness: 25
    height: 40
    opening: 160
    length: 360
    bed: 75
    parallels: [[8, 10], [8, 14], [8, 18], [8, 22], [8, 26], [8, 30]]
    holding_force_n: )" +
         std::to_string(holding_force_n) + "\n";
}

TEST_F(Workholding, AutoTakesWhatTheShopsOwnFileLists) {
  // No set-ups: the choice is left, and the shop's own vise comes before the shipped ones.
  std::ofstream(folder_ / "shop.yaml") << shop_with_vise(20000.0);
  ASSERT_EQ(run(plan_with("shop.yaml")), 0) << said_;
  EXPECT_THAT(slurp("p.json"), HasSubstr("\"our_vise\""));
  EXPECT_THAT(slurp("p.json"), Not(HasSubstr("\"vise_125\"")));
}

/// The largest force of a milling step in a plan, N.
double heaviest_cut_n(std::string json) {
  Job job;
  const auto plan = json::read_json(std::move(json), "p.json", job);
  EXPECT_TRUE(plan);
  double out = 0.0;
  for (const model::StepResult& s : plan->steps) {
    const bool along_axis = std::any_of(s.path->role.begin(), s.path->role.end(), [](model::MoveRole r) {
      return r == model::MoveRole::kDrill || r == model::MoveRole::kTap;
    });
    if (!along_axis) out = std::max(out, s.loads.peak_force_n);
  }
  return out;
}

TEST_F(Workholding, CutsNoHarderThanWhatHoldsThePieceBears) {
  std::ofstream(folder_ / "strong.yaml") << shop_with_vise(20000.0);
  ASSERT_EQ(run(plan_with("strong.yaml")), 0) << said_;
  const double free_n = heaviest_cut_n(slurp("p.json"));
  ASSERT_GT(free_n, 0.0);
  const double held_n = 1.5 * free_n;
  std::ofstream(folder_ / "weak.yaml") << shop_with_vise(held_n);
  (void)run(plan_with("weak.yaml"));
  EXPECT_THAT(said_, Not(HasSubstr("CHK-HOLD-FORCE")));
  const double heaviest_n = heaviest_cut_n(slurp("p.json"));
  EXPECT_GT(heaviest_n, 0.0);
  EXPECT_LE(heaviest_n * mechanics::kHoldingForceSafety, held_n * (1.0 + 1e-9));
}

}  // namespace
}  // namespace capstan::app
