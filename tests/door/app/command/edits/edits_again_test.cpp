#include <gmock/gmock.h>

#include <set>

#include "planner/door/service/reading.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/model/plan/edit/provenance.h"
#include "tests/door/app/command/edits/edits.h"

// A person's edits where several meet, where a plan with edits comes to another machine, and where they
// cannot be.

namespace capstan::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

class EditsAgain : public Edits {
 protected:
  /// The number of a step's tool.
  [[nodiscard]] int number_of(const std::string& name, const std::string& step) const {
    const std::string id = steps_of(name).at(step)["cutter_id"];
    const json plan = read(name);
    for (const json& c : plan["cutters"]) {
      if (c["id"] == id) return c["pocket"];
    }
    return 0;
  }
};

// Only what a call names itself must be known where it plans.
TEST_F(EditsAgain, APlanIsBoundWhereTheToolThatItWasMadeWithoutIsNot) {
  ASSERT_EQ(plan("a", std::string("--forbid tool=") + kEm8 + " -o a.tbl").code, 0);
  const Ran bound = run("bind a.json --tools a.tbl -o b.json -o b.ngc");
  EXPECT_LE(bound.code, 1) << bound.err;
  EXPECT_THAT(bound.err, Not(HasSubstr("NAME-UNKNOWN")));
  const Ran named = run(std::string("bind a.json --tools a.tbl --forbid tool=") + kEm8 + " -o c.json");
  EXPECT_EQ(named.code, 2) << named.err;
  EXPECT_THAT(named.err, HasSubstr(std::string("unknown tool '") + kEm8));
}

TEST_F(EditsAgain, AToolThatIsForbiddenByItsNumberIsNotUsed) {
  ASSERT_EQ(plan("a", "").code, 0);
  const std::string step = "SLOT area_rough";
  const std::string id = steps_of("a").at(step)["cutter_id"];
  const std::string number = "T" + std::to_string(number_of("a", step));
  const Ran r = run("plan a.json --forbid 'SLOT*/tool=" + number + "' -o b.json -o b.edits.yaml");
  ASSERT_LE(r.code, 1) << r.err;
  EXPECT_NE(steps_of("b").at(step)["cutter_id"], id);
  // The library numbers nothing: a later plan may give that number to another.
  EXPECT_THAT(slurp(folder_ / "b.edits.yaml"), HasSubstr("forbid: \"SLOT*/tool=" + id + "\""));
  EXPECT_THAT(r.err, HasSubstr("--forbid (" + number + ")"));
}

TEST_F(EditsAgain, ValuesOfAFileAreNotPassedOverWhileSingleStepsAreBound) {
  put("set.yaml", "capstan_edits: 1\nedits:\n  - set: SLOT area_rough/feed=800\n");
  put("none.yaml", "capstan_edits: 1\nedits: []\n");
  ASSERT_EQ(plan("a", "").code, 0);
  const Ran next = run("bind a.json --next 1 --edits set.yaml -o b.json");
  EXPECT_EQ(next.code, 2) << next.err;
  EXPECT_THAT(next.err,
              AllOf(HasSubstr("EDIT-NEXT"), HasSubstr("edit 1 of set.yaml: set SLOT area_rough/feed=800"),
                    HasSubstr("bind all of the plan with these edits first")));
  // A plan that has them is bound on; a file that takes them back is refused.
  ASSERT_EQ(plan("c", "--edits set.yaml").code, 0);
  const Ran same = run("bind c.json --next 1 --edits set.yaml -o d.json");
  EXPECT_LE(same.code, 1) << same.err;
  const Ran back = run("bind c.json --next 1 --edits none.yaml -o e.json");
  EXPECT_EQ(back.code, 2) << back.err;
  EXPECT_THAT(back.err, HasSubstr("takes it back"));
}

TEST_F(EditsAgain, OfAGeneralAndASpecificOneTheSpecificHoldsInAnyOrder) {
  const std::string general = "--set 'SLOT*/feed=900' ", specific = "--set 'SLOT area_rough/feed=1111' ";
  ASSERT_EQ(plan("a", general + specific).code, 0);
  const Ran r = plan("b", specific + general);
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(slurp(folder_ / "a.ngc"), slurp(folder_ / "b.ngc"));
  EXPECT_EQ(steps_of("b").at("SLOT area_rough")["feed_mm_min"], 1111.0);
  EXPECT_EQ(steps_of("b").at("SLOT area_finish")["feed_mm_min"], 900.0);
  EXPECT_THAT(r.err, HasSubstr("set SLOT*/feed=900 yields to --set: set SLOT area_rough/feed=1111"));
  // In a plan that has both nothing changes, so that nothing is planned anew.
  Job job;
  auto read_back = service::load_plan((folder_ / "a.json").string(), job, false);
  ASSERT_TRUE(read_back) << to_text(read_back.error());
  const auto edits = model::edits_of(*read_back);
  ASSERT_EQ(edits.size(), 2U);
  const auto taken = given::take_edits(*read_back, edits, read_back->cutters, read_back->machine, false, job);
  ASSERT_TRUE(taken) << to_text(taken.error());
  EXPECT_FALSE(taken->opened);
}

TEST_F(EditsAgain, AFeatureMayBeCalledByTheSignsOfAnEdit) {
  std::string part = slurp(folder_ / "bracket.p21");
  for (std::size_t at = 0; (at = part.find("'SLOT'", at)) != std::string::npos; ++at)
    part.replace(at, 6, "'A=1<B'");
  put("bracket.p21", part);
  const Ran r = plan("a", "--set '\"A=1<B area_rough\"/feed=1111' --pin '\"A=1<B*\"/tool' -o a.edits.yaml");
  ASSERT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(steps_of("a").at("A=1<B area_rough")["feed_mm_min"], 1111.0);
  ASSERT_EQ(plan("b", "--edits a.edits.yaml -o b.edits.yaml").code, 0);
  EXPECT_EQ(slurp(folder_ / "a.ngc"), slurp(folder_ / "b.ngc"));
  EXPECT_EQ(slurp(folder_ / "a.edits.yaml"), slurp(folder_ / "b.edits.yaml"));
  const Ran again = run("plan b.json -o c.json -o c.edits.yaml");
  ASSERT_LE(again.code, 1) << again.err;
  EXPECT_EQ(slurp(folder_ / "c.edits.yaml"), slurp(folder_ / "a.edits.yaml")) << "the plan keeps them, too";
}

TEST_F(EditsAgain, ATapIsFedByItsPitchWhateverIsSet) {
  const std::string tap = "M6 tap";
  const Ran all = plan("a", "--set 'feed=300' --allow-findings");
  EXPECT_LE(all.code, 1) << all.err;
  EXPECT_THAT(all.err, AllOf(HasSubstr("the feed of taps stays the pitch times the speed"), HasSubstr(tap)));
  const Ran r = plan("b", "--set '" + tap + "/speed=400'");
  ASSERT_EQ(r.code, 0) << r.err;
  for (const char* name : {"a", "b"}) {
    const json step = steps_of(name).at(tap);
    EXPECT_NEAR(step["feed_mm_min"].get<double>(), std::abs(step["spindle_rpm"].get<double>()) * 1.0, 1e-6)
        << name << ": M6 has a pitch of 1 mm";
  }
  EXPECT_NEAR(std::abs(steps_of("b").at(tap)["spindle_rpm"].get<double>()), 400.0, 1e-6);
  EXPECT_EQ(run("check b.json b.ngc").code, 0);
}

TEST_F(EditsAgain, ValuesThatNoMachineOrCutterHasAreRefusedWithTheLimit) {
  for (const auto& [edit, value, limit] :
       {std::tuple("SLOT area_rough/feed=0.000001", "0.000001 mm/min", "below the 0.1 mm/min"),
        std::tuple("SLOT area_rough/feed=20000", "20000 mm/min",
                   "above the 10000 mm/min of the fastest axis"),
        std::tuple("SLOT area_rough/speed=200000", "200000 1/min", "above the 10000 1/min of the spindle"),
        std::tuple("SLOT area_rough/depth=0.00001", "0.00001 mm", "below the 0.04 mm")}) {
    const Ran r = plan("a", std::string("--set '") + edit + "'");
    EXPECT_EQ(r.code, 2) << edit << r.err;
    EXPECT_THAT(r.err, AllOf(HasSubstr("SLOT area_rough"), HasSubstr(value), HasSubstr(limit))) << edit;
  }
  EXPECT_EQ(files(), std::vector<std::string>{"bracket.p21"});
}

TEST_F(EditsAgain, ADepthBeyondItsFeatureIsTold) {
  const Ran r = plan("a", "--set 'SLOT area_rough/depth=100'");
  EXPECT_THAT(r.err, AllOf(HasSubstr("EDIT-DEPTH"), HasSubstr("SLOT area_rough"), HasSubstr("100 mm")))
      << r.err;
}

TEST_F(EditsAgain, ASetFeedStaysWhereTechnologyIsPlannedAnew) {
  ASSERT_EQ(plan("a", "--set 'SLOT area_rough/feed=1111'").code, 0);
  const Ran r = run("plan a.json --reopen technology -o b.json -o b.ngc");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(steps_of("b").at("SLOT area_rough")["feed_mm_min"], 1111.0);
  EXPECT_THAT(why("b", "SLOT area_rough", "feedrate"), HasSubstr("operator"));
  EXPECT_EQ(run("check b.json b.ngc").code, 0);
}

// A hole's drill, reamer and tap were chosen by the rules of its chain: another choice of tools keeps to
// these.
TEST_F(EditsAgain, ToolsThatAreChosenAnewKeepTheSequenceOfEachHole) {
  ASSERT_EQ(plan("a", "").code, 0);
  const Ran r = run("plan a.json --reopen tools -o b.json -o b.ngc");
  EXPECT_EQ(r.code, 0) << r.err;
  const auto before = steps_of("a"), after = steps_of("b");
  for (const auto& [name, step] : before) EXPECT_TRUE(after.contains(name)) << name << " is lost";
  EXPECT_EQ(after.size(), before.size());
}

TEST_F(EditsAgain, AStepWithNothingLeftToChooseFromIsOneMessageWithTheEdits) {
  for (const auto& [options, edit] :
       {std::pair("--forbid 'POCKET*/strategy=*'", "--forbid: forbid POCKET*/strategy=*"),
        std::pair("--forbid 'POCKET*/tool=*'", "--forbid: forbid POCKET*/tool=*"),
        std::pair("--forbid 'POCKET*/operation=*'", "--forbid: forbid POCKET*/operation=*")}) {
    const Ran r = plan("a", options);
    EXPECT_EQ(r.code, 1) << options << r.err;
    std::size_t times = 0;
    for (std::size_t at = 0; (at = r.err.find(edit, at)) != std::string::npos; ++at) ++times;
    EXPECT_GE(times, 1U) << r.err;
    EXPECT_LE(times, 3U) << r.err;
  }
}

}  // namespace
}  // namespace capstan::app
