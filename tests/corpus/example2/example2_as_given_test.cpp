#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <numbers>
#include <set>
#include <string>

#include "tests/corpus/session.h"
#include "tests/support/rows.h"

// The standard's example 2 as given: every workingstep is executed as its file says, or something says why
// not.

namespace capstan::corpus {
namespace {

class CorpusExample2AsGiven : public ::testing::Test {
 protected:
  static const Session& session() {
    static const Session made =
        planned(testing::corpus_folder() + "/iso14649/fdis_ex2_mended.p21", Reopen::kNothing);
    return made;
  }
};

#define CAPSTAN_EXAMPLE2() CAPSTAN_CORPUS_FILE(corpus_file, "iso14649/fdis_ex2_mended.p21")

TEST_F(CorpusExample2AsGiven, EachOfThe35WorkingstepsIsExecutedOrSaidWhyNot) {
  CAPSTAN_EXAMPLE2();
  const auto& plan = session().plan;
  std::set<std::string> executed;
  for (const auto& s : plan.steps) {
    if (s.path && s.path->size() > 1) executed.insert(model::step_id(plan, s));
  }
  // What is not executed: by which code, and which of its words say why.
  struct Why {
    std::string code, words;
  };
  std::map<std::string, Why> not_executed;
  for (testing::DataRow& row : testing::data_rows("tests/corpus/example2/not_executed.csv"))
    EXPECT_TRUE(not_executed.emplace(row["step"], Why{row["code"], row["words"]}).second) << row["step"];
  std::size_t met = 0;
  int steps = 0;
  for (const model::AnyRef ref : plan.model.all(model::TypeId::kMachiningWorkingstep)) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(ref);
    const std::string id = ws->its_id.value_or("");
    ++steps;
    const auto why = not_executed.find(id.substr(0, id.find_last_not_of(' ') + 1));
    EXPECT_EQ(executed.contains(id), why == not_executed.end()) << id;
    if (why == not_executed.end()) continue;
    ++met;
    const auto has = [&](const std::string& text) {
      return text.find(why->second.words) != std::string::npos;
    };
    EXPECT_TRUE(std::any_of(session().bound.begin(), session().bound.end(),
                            [&](const Diagnostic& d) {
                              return d.code == why->second.code && d.severity == Severity::kError &&
                                     has(d.message);
                            }))
        << id << " by " << why->second.code;
    EXPECT_TRUE(std::any_of(plan.unplanned.begin(), plan.unplanned.end(), [&](const model::Unplanned& u) {
      return u.reason.find("step '" + id + "'") != std::string::npos && has(u.reason);
    })) << id;
  }
  EXPECT_EQ(steps, 35);
  EXPECT_EQ(met, not_executed.size()) << "not_executed.csv names a step that the file does not have";
}

// As printed, with its wrong references: what needs one of them is not made, and says so.
TEST(CorpusExample2AsPrinted, EachOfThe35WorkingstepsIsExecutedOrSaidWhyNot) {
  CAPSTAN_CORPUS_FILE(path, "iso14649/fdis_ex2.p21");
  const Session made = planned(path, Reopen::kNothing);
  const auto& plan = made.plan;
  const auto wrong = std::count_if(made.read.begin(), made.read.end(), [](const Diagnostic& d) {
    return d.code == "EXC-REFERENCE" && d.severity == Severity::kError && d.line == 113 &&
           d.instance == 110 && d.expected == "HOLE_BOTTOM_CONDITION";
  });
  EXPECT_EQ(wrong, 1) << "the one that a shape needs; three more name a material only";
  std::set<std::string> executed;
  for (const auto& s : plan.steps) {
    if (s.path && s.path->size() > 1) executed.insert(model::step_id(plan, s));
  }
  const auto steps = plan.model.all(model::TypeId::kMachiningWorkingstep);
  EXPECT_EQ(steps.size(), 35u);
  std::size_t made_count = 0;
  for (const model::AnyRef ref : steps) {
    const std::string id = plan.model.get<model::MachiningWorkingstep>(ref)->its_id.value_or("");
    const bool is_made = executed.contains(id);
    made_count += is_made ? 1 : 0;
    const bool told = std::any_of(
        plan.unplanned.begin(), plan.unplanned.end(),
        [&](const model::Unplanned& u) { return u.reason.find("step '" + id + "'") != std::string::npos; });
    EXPECT_NE(is_made, told) << id;
  }
  EXPECT_GE(made_count, 20u) << "most of the part does not need what is wrong";
  for (const char* hole : {"DRILLING HOLE2", "DRILLING HOLE3"}) {
    EXPECT_TRUE(std::any_of(plan.unplanned.begin(), plan.unplanned.end(), [&](const model::Unplanned& u) {
      return u.reason.find(hole) != std::string::npos && u.reason.find("#110") != std::string::npos &&
             u.reason.find("ROUND_HOLE.bottom_condition points to #216") != std::string::npos;
    })) << hole;
  }
}

// Hole 1 goes through 50 mm; its last tool, a spade drill of 40 mm whose point has a flank of 20 degrees, is
// let down 45 mm: at the radius of 20 it cuts to 45 - 20 tan 20 = 37.7 mm, and 12.3 mm stay. The file's own
// values.
TEST_F(CorpusExample2AsGiven, IsToldThatHole1IsNotCutDownToItsUnderside) {
  CAPSTAN_EXAMPLE2();
  Job job;
  double stands = 0.0;
  for (const auto& f : verify::check_plan(session().plan, job)) {
    if (f.code != "CHK-LEFT" || f.message.find("HOLE1") == std::string::npos) continue;
    EXPECT_EQ(f.step.substr(0, 21), "COUNTER SINKING HOLE1") << "the last step on it";
    const auto at = f.message.find(" mm of COMPOUND FEATURE HOLE1");
    ASSERT_NE(at, std::string::npos) << f.message;
    stands = std::max(stands, std::strtod(f.message.c_str() + f.message.rfind(' ', at - 1), nullptr));
  }
  EXPECT_NEAR(stands, 50.0 - (45.0 - 20.0 * std::tan(20.0 * std::numbers::pi / 180.0)), 0.3)
      << "a cell of 0.44 mm";
}

TEST_F(CorpusExample2AsGiven, IsToldOfItsOwnSpindlesFeedsAndTools) {
  CAPSTAN_EXAMPLE2();
  // Of the file's values, whatever the material: feeds of 0.09 to 0.8 mm per tooth and turn; flutes of 4.3
  // to 13.5 mm for bores of 15 to 56 mm; a boring tool that is withdrawn stopped; a 125 mm cutter; feeds of
  // 30 m/min down. Positive spindle speeds (counter-clockwise) for right-hand cutters are turned round.
  const std::set<std::string> kOwn{
      "CHK-SPINDLE-DIRECTION", "CHK-FLUTE",        "CHK-SPINDLE-STOPPED", "CHK-PLUNGE",
      "CHK-FEED-AXIS",         "CHK-MACHINE-TOOL", "CHK-MACHINE-FEED"};
  EXPECT_THAT(codes(session().bound, Severity::kWarning), ::testing::Contains("PIP-CHANGED"));
  std::vector<std::string> own;
  for (const std::string& f : findings_of_plan(session())) {
    const auto code = f.substr(f.find(' ') + 1, f.find(' ', f.find(' ') + 1) - f.find(' ') - 1);
    if (kOwn.contains(code)) own.push_back(f.substr(f.find(' ') + 1));
  }
  for (std::string& f : own) f.erase(f.find_last_not_of(' ') + 1);
  EXPECT_THAT(own, ::testing::UnorderedElementsAre(
                       "CHK-MACHINE-FEED", "CHK-MACHINE-TOOL ROUGHING HEAD1", "CHK-FEED-AXIS ROUGHING HEAD1",
                       "CHK-FEED-AXIS FINISH HEAD1", "CHK-FLUTE BORING1 HOLE1", "CHK-PLUNGE BORING1 HOLE1",
                       "CHK-FLUTE BORING HOLE2", "CHK-FLUTE BORING HOLE3", "CHK-FLUTE BORING HOLE1",
                       "CHK-SPINDLE-STOPPED BORING HOLE1"))
      << all_findings(session());
}

}  // namespace
}  // namespace capstan::corpus
