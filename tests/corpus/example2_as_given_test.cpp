#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "tests/corpus/session.h"

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
  std::string said;
  for (const auto& d : session().bound) said += d.message + "\n";
  for (const auto& d : session().read) said += d.message + "\n";
  for (const auto& u : plan.unplanned) said += u.reason + "\n";
  said += all_findings(session());
  int steps = 0;
  for (const model::AnyRef ref : plan.model.all(model::TypeId::kMachiningWorkingstep)) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(ref);
    const std::string id = ws->its_id.value_or("");
    ++steps;
    EXPECT_TRUE(executed.contains(id) || said.find("'" + id + "'") != std::string::npos) << id;
  }
  EXPECT_EQ(steps, 35);
  EXPECT_GE(executed.size(), 29U);
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
