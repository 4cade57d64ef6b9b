#include "planner/door/late/late.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <sstream>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/controls/linuxcnc/linuxcnc.h"
#include "planner/files/json/json.h"
#include "planner/making/given/magazine.h"
#include "planner/model/nouns/all.h"
#include "tests/door/late/brought.h"
#include "tests/support/corpus.h"
#include "tests/support/scratch.h"
#include "tests/support/seal.h"
#include "tests/support/shop.h"
#include "tests/support/soak.h"

namespace capstan::late {
namespace {

/// The generic machine, whose table counts from a reference.
std::string reference_machine() {
  std::string text =
      testing::slurp(capstan::testing::source_dir() + "/tooling/data/machines/generic_vmc.yaml");
  const std::string at = "control: {";
  text.insert(text.find(at) + at.size(), "length_offsets: reference, ");
  const std::string path = capstan::testing::scratch_file("late_reference.yaml");
  std::ofstream(path) << text;
  return path;
}

std::string texts(Job& job) {
  std::string out;
  for (const auto& d : job.diagnostics()) out += to_text(d) + "\n";
  return out;
}

TEST(Late, BindsWithWhatTheMagazineHoldsAndNothingElse) {
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_TRUE(bound) << to_text(bound.error()) << "\n" << texts(job);
  EXPECT_TRUE(bound->plan.unplanned.empty());
  ASSERT_FALSE(bound->plan.steps.empty());
  for (const auto& c : bound->plan.cutters) {
    const bool loaded =
        c.pocket == 2 || c.pocket == 3 || c.pocket == 4 || c.pocket == 5 || c.pocket == 7 || c.pocket == 8;
    EXPECT_TRUE(loaded) << c.id << " in pocket " << c.pocket;
  }
  for (const auto& f : bound->findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(Late, TakesTheLengthOfAToolFromTheTable) {
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  const auto mill = std::find_if(bound->plan.cutters.begin(), bound->plan.cutters.end(),
                                 [](const auto& c) { return c.pocket == 7; });
  ASSERT_NE(mill, bound->plan.cutters.end());
  EXPECT_EQ(mill->functional_length_mm, 115.0);  // the file says 75, the table what was measured
}

/// The plate and its magazine, with one line of the table as a shop has it.
pipeline::Inputs shop_with(const std::string& line, const std::string& machine = {}) {
  std::string text;
  std::istringstream lines(testing::slurp(kMagazine));
  const std::string number = line.substr(0, line.find(' '));
  for (std::string one; std::getline(lines, one);)
    text += (one.starts_with(number + " ") ? line : one) + "\n";
  return shop_of(text, machine);
}

/// The line of a tool in the table that the plan is given with.
std::string line_of(const model::Plan& plan, int tool) {
  std::istringstream lines(controls::linuxcnc::write_tool_table(plan));
  for (std::string one; std::getline(lines, one);)
    if (one.starts_with("T" + std::to_string(tool) + " ")) return one.substr(0, one.find(" ;"));
  return {};
}

const model::Cutter* cutter_of(const model::Plan& plan, int tool) {
  for (const auto& c : plan.cutters)
    if (c.pocket == tool) return &c;
  return nullptr;
}

TEST(Late, TheToolTableComesOutNumberForNumber) {
  // The mill in carousel place 17, shorter than the 75 mm of the file, with a worn diameter.
  Job job;
  const std::string line = "T7 P17 Z+65.2345678 D+11.999500";
  const auto bound =
      bind(plate(), shop_with(line + " ;12 mm carbide end mill, 3 flutes"), {.deadline = std::nullopt}, job);
  ASSERT_TRUE(bound) << to_text(bound.error()) << "\n" << texts(job);
  EXPECT_EQ(line_of(bound->plan, 7), line);
  EXPECT_EQ(line_of(bound->plan, 4), "T4 P4 Z+140.000000 D+9.800000");
}

TEST(Late, AnAssumedStickOutLosesWhatTheToolIsShorterThanAssumed) {
  // The file's mill is 75 mm long over its holder, and its flutes of 26 mm want 1.5 * 26 = 39 mm out of it.
  // At 65 mm the same holder leaves 39 - (75 - 65) = 29 mm; at 115 mm nobody knows that more stands out.
  for (const auto& [z, out] : {std::pair("65", 29.0), std::pair("115", 39.0)}) {
    Job job;
    const auto bound =
        bind(plate(), shop_with("T7 P7 Z+" + std::string(z) + " D+12 ;12 mm carbide end mill, 3 flutes"),
             {.deadline = std::nullopt}, job);
    ASSERT_TRUE(bound) << to_text(bound.error()) << "\n" << texts(job);
    const auto* mill = cutter_of(bound->plan, 7);
    ASSERT_NE(mill, nullptr);
    EXPECT_EQ(mill->functional_length_mm, std::stod(z));
    EXPECT_NEAR(mill->stick_out_mm, out, 1e-9) << z;
    EXPECT_LE(mill->usable_length_mm, mill->stick_out_mm);
  }
}

TEST(Late, AToolWhoseHolderWouldTakeInItsFlutesIsRefused) {
  // 39 - (75 - 61) = 25 mm stand out, the flutes are 26 mm long.
  Job job;
  const auto bound = bind(plate(), shop_with("T7 P7 Z+61 D+12 ;12 mm carbide end mill, 3 flutes"),
                          {.deadline = std::nullopt}, job);
  ASSERT_FALSE(bound);
  EXPECT_NE(bound.error().message.find("61 mm long as it is loaded, so that 25 mm of it stand out"),
            std::string::npos)
      << to_text(bound.error());
}

TEST(Late, AToolWhoseLengthTheTableDoesNotTellIsRefused) {
  // 12 mm mills have flutes of some 26 mm: no length from the gage line is 20 mm.
  for (const std::string z : {"Z+20", "Z0", ""}) {
    Job job;
    const auto bound = bind(plate(), shop_with("T7 P7 " + z + " D+12 ;12 mm carbide end mill, 3 flutes"),
                            {.deadline = std::nullopt}, job);
    ASSERT_FALSE(bound) << z;
    EXPECT_EQ(bound.error().code, "LATE-TOOL") << to_text(bound.error());
    EXPECT_NE(bound.error().message.find("T7 has Z"), std::string::npos) << bound.error().message;
    EXPECT_NE(bound.error().hint.find("measure"), std::string::npos);
  }
}

TEST(Late, OffsetsAgainstAReferenceToolAreNoLengthsAndComeOutAgain) {
  // T3 is shorter than the reference, so no Z of this table is a length.
  Job job;
  const auto bound = bind(plate(),
                          shop_of("T2 P2 Z+0 D+10 ;10 mm carbide spot drill, 90 deg\n"
                                  "T3 P3 Z-12.5 D+9 ;9 mm carbide twist drill, 140 deg\n"
                                  "T4 P4 Z+14.25 D+9.8 ;9.8 mm carbide twist drill, 140 deg\n"
                                  "T5 P5 Z+15 D+10 ;10 mm hss reamer H7\n"
                                  "T7 P7 Z+2.5 D+12 ;12 mm carbide end mill, 3 flutes\n"
                                  "T8 P8 Z+1.5 D+8 ;8 mm carbide end mill, 4 flutes\n"),
                          {.deadline = std::nullopt}, job);
  ASSERT_TRUE(bound) << to_text(bound.error()) << "\n" << texts(job);
  EXPECT_EQ(line_of(bound->plan, 7), "T7 P7 Z+2.500000 D+12.000000");
  EXPECT_EQ(cutter_of(bound->plan, 7)->functional_length_mm, 75.0);  // the file's, for the table tells none
  const auto program = pipeline::write_plan(bound->plan, pipeline::Format::kLinuxCnc, job);
  ASSERT_TRUE(program);
  EXPECT_NE(program->find("T7: its length offset counts from a reference"), std::string::npos);
}

TEST(Late, OneNegativeOffsetAmongLengthsIsNoLengthAndNoReference) {
  // A sign mistyped: were it an offset from a reference, T8 would stand out 96 mm more than T7.
  Job job;
  const auto bound = bind(plate(),
                          shop_of("T7 P7 Z-5 D+12 ;12 mm carbide end mill, 3 flutes\n"
                                  "T8 P8 Z+91 D+8 ;8 mm carbide end mill, 4 flutes\n"),
                          {.deadline = std::nullopt}, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-TOOL") << to_text(bound.error());
}

TEST(Late, AMachineMaySayThatItsOffsetsCountFromAReference) {
  // All above zero, as of a shop whose reference is the shortest: the machine's description tells.
  pipeline::Inputs in = shop_with("T7 P7 Z+20 D+12 ;12 mm carbide end mill, 3 flutes", reference_machine());
  Job job;
  const auto bound = bind(plate(), std::move(in), {.deadline = std::nullopt}, job);
  ASSERT_TRUE(bound) << to_text(bound.error()) << "\n" << texts(job);
  EXPECT_EQ(line_of(bound->plan, 7), "T7 P7 Z+20.000000 D+12.000000");
}

TEST(Late, OfAReferenceTableOnlyOneToolMayHaveZero) {
  Job job;
  const auto bound = bind(plate(),
                          shop_of("T2 P2 Z+0 D+10 ;10 mm carbide spot drill, 90 deg\n"
                                  "T3 P3 Z-12.5 D+9 ;9 mm carbide twist drill, 140 deg\n"
                                  "T7 P7 Z+0 D+12 ;12 mm carbide end mill, 3 flutes\n"),
                          {.deadline = std::nullopt}, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-TOOL") << to_text(bound.error());
}

TEST(Late, RefusesWhenSomethingStaysOpen) {
  Job job;
  const auto bound = bind(plate(), shop(kOneTool), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-OPEN");
}

TEST(Late, GivesTheFallbackWhenTheDeadlineIsPastAndSaysThatItIsLate) {
  Job job;
  const auto bound = bind(plate(), shop(kMagazine), {.deadline = std::chrono::milliseconds(0)}, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->late);
  EXPECT_FALSE(bound->improved);
  EXPECT_EQ(bound->machining_s, bound->fallback_s);
}

/// A clock that stands still but for what a test adds when the n-th check begins (each plan is checked as
/// a plan, then as a program), or at its end.
class StagedClock {
 public:
  explicit StagedClock(Job& job) {
    job.set_clock([this] { return now_; });
    job.set_progress([this](std::string_view stage, double fraction) {
      if (stage != "check") return;
      if (fraction == 0.0) ++checks_;
      if (checks_ == jump_at_ && fraction >= jump_from_) now_ = std::max(now_, jump_to_);
    });
  }
  /// From that fraction of the n-th check on, the time is `after` the beginning.
  void jump(int check, double fraction, std::chrono::milliseconds after) {
    jump_at_ = check;
    jump_from_ = fraction;
    jump_to_ = now_ + after;
  }
  [[nodiscard]] int checks() const { return checks_; }

 private:
  std::chrono::steady_clock::time_point now_{std::chrono::hours(1)}, jump_to_ = now_;
  int checks_ = 0, jump_at_ = -1;
  double jump_from_ = 0.0;
};

/// Of a fallback on hardly any evaluations there is something to improve.
LatePolicy hasty() { return {.deadline = std::chrono::milliseconds(1000), .fallback_budget = 1}; }

TEST(Late, TakesAnImprovementThatIsCheckedInTime) {
  Job job;
  const StagedClock clock(job);
  const auto bound = bind(plate(), shop(kMagazine), hasty(), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->improved);
  EXPECT_FALSE(bound->late);
  EXPECT_LT(bound->machining_s, bound->fallback_s);
  EXPECT_EQ(clock.checks(), 4);  // two plans, each with its program
}

/// How often the paths of a plan are begun.
int plannings(const LatePolicy& policy) {
  Job job;
  int out = 0;
  job.set_progress([&](std::string_view stage, double fraction) {
    if (stage == "paths" && fraction == 0.0) ++out;
  });
  const auto bound = bind(plate(), shop(kMagazine), policy, job);
  EXPECT_TRUE(bound) << to_text(bound.error());
  return out;
}

TEST(Late, PlansOnceWhereNoSearchEndedForTheFallbacksBudget) {
  const int once = plannings({.deadline = {}, .fallback_budget = 60, .budget = 60});
  EXPECT_GT(once, 0);
  EXPECT_EQ(plannings({.deadline = {}}), once)
      << "the usual budget of a fallback ends none of these searches";
  EXPECT_GT(plannings({.deadline = {}, .fallback_budget = 1}), once);
}

TEST(Late, RefusesAnImprovementWhoseCheckWasStopped) {
  Job job;
  StagedClock clock(job);
  // The third check is the improvement's: the reserve of time is used up in its midst, the deadline is not.
  clock.jump(3, 0.5, std::chrono::milliseconds(1000));
  const auto bound = bind(plate(), shop(kMagazine), hasty(), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->improved);
  EXPECT_FALSE(bound->late);  // not past the deadline: the check alone refuses it
  EXPECT_EQ(bound->machining_s, bound->fallback_s);
  EXPECT_GE(clock.checks(), 3);
  EXPECT_TRUE(bound->condemned.empty());
}

TEST(Late, IsLateWhenTheImprovementOverranTheDeadline) {
  Job job;
  StagedClock clock(job);
  clock.jump(4, 1.0, std::chrono::milliseconds(1001));
  const auto bound = bind(plate(), shop(kMagazine), hasty(), job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_TRUE(bound->late);
  EXPECT_FALSE(bound->improved);
}

TEST(LateProperty, WhateverToolIsMissingNoStepUsesIt) {
  const std::string part = capstan::testing::source_dir() + "/examples/bracket.p21";
  for (const auto format : {pipeline::Format::kAp238, pipeline::Format::kJson}) {
    const Brought early = brought(part, format);
    const int tools = static_cast<int>(std::count(early.table.begin(), early.table.end(), '\n'));
    ASSERT_GT(tools, 5);
    int replaced = 0;
    for (int missing = 1; missing <= tools; ++missing) {
      // Of a sample every second in the one form, the others in the other.
      if (!soaking() && (missing % 2 == 0) == (format == pipeline::Format::kJson)) continue;
      Job job;
      const auto bound =
          bind(early.plan, shop_of(without(early.table, missing)), {.deadline = std::nullopt}, job);
      if (!bound) {
        EXPECT_EQ(bound.error().code, "LATE-OPEN") << missing << ": " << to_text(bound.error());
        continue;
      }
      ++replaced;
      EXPECT_TRUE(bound->plan.unplanned.empty()) << missing;
      EXPECT_FALSE(bound->reopened.empty()) << missing;
      for (const model::StepResult& step : bound->plan.steps) {
        const model::Cutter* c = model::find_cutter(bound->plan, step.cutter_id);
        ASSERT_NE(c, nullptr) << missing;
        EXPECT_NE(c->pocket, missing) << step.cutter_id;
      }
      const std::string program =
          pipeline::write_plan(bound->plan, pipeline::Format::kLinuxCnc, job).value_or("");
      EXPECT_EQ(program.find("T" + std::to_string(missing) + " "), std::string::npos) << missing;
    }
    EXPECT_GT(replaced, 0);
  }
}

TEST(Late, APlanWithTheFilesOwnPathOfAToolThatIsNotLoadedIsRefused) {
  for (const auto format : {pipeline::Format::kAp238, pipeline::Format::kJson}) {
    Brought early = brought(kPlate, format);
    const auto entries = early.plan.ledger.entries();
    for (const auto& [key, decision] : entries) {
      if (key.attribute != "its_toolpath") continue;
      model::Decision given = decision;
      given.binder = model::Binder::kGiven;
      early.plan.ledger.set(key, given);
    }
    const model::Cutter* mill = model::find_cutter(early.plan, early.plan.steps.front().cutter_id);
    ASSERT_NE(mill, nullptr);
    const std::string id = mill->id;
    Job job;
    const auto bound =
        bind(early.plan, shop_of(without(early.table, mill->pocket)), {.deadline = std::nullopt}, job);
    const std::string form = format == pipeline::Format::kJson ? "JSON" : "AP238";
    ASSERT_FALSE(bound) << form;
    EXPECT_EQ(bound.error().code, "LATE-TOOL") << form << ": " << to_text(bound.error());
    EXPECT_NE(bound.error().message.find("'" + id + "' of step '" + bound.error().path + "'"),
              std::string::npos)
        << bound.error().message;
    EXPECT_FALSE(bound.error().path.empty());
  }
}

TEST(Late, AWornMillKeepsWhatIsKnownOfItAndItsPathTakesTheMeasuredDiameter) {
  const Brought early =
      brought(capstan::testing::source_dir() + "/examples/bracket.p21", pipeline::Format::kJson);
  const auto pocket = std::find_if(early.plan.cutters.begin(), early.plan.cutters.end(), [](const auto& c) {
    return c.cutter_class == model::CutterClass::kEndmill && c.cutting_diameter_mm >= 8.0;
  });
  ASSERT_NE(pocket, early.plan.cutters.end());
  const double worn = pocket->cutting_diameter_mm - 0.05;
  const std::string number = "T" + std::to_string(pocket->pocket) + " ";
  std::string table = early.table;
  const auto at = table.find("D+", table.find(number)) + 2;
  table.replace(at, table.find(' ', at) - at, std::to_string(worn));
  Job job;
  const auto bound = bind(early.plan, shop_of(table), {.deadline = std::nullopt}, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  const model::Cutter* now = cutter_of(bound->plan, pocket->pocket);
  ASSERT_NE(now, nullptr);
  EXPECT_NEAR(now->cutting_diameter_mm, worn, 1e-9);
  EXPECT_EQ(now->teeth, pocket->teeth);
  EXPECT_EQ(now->substrate, pocket->substrate);
  EXPECT_EQ(now->maximum_depth_of_cut_mm, pocket->maximum_depth_of_cut_mm);
  EXPECT_NEAR(bound->machining_s, early.machining_s, 0.05 * early.machining_s);
  // What was decided of its cuts stays; nothing but the path is made anew.
  std::size_t by_the_mill = 0;
  ASSERT_EQ(bound->plan.steps.size(), early.plan.steps.size());
  for (std::size_t i = 0; i < early.plan.steps.size(); ++i) {
    const model::StepResult &a = early.plan.steps[i], &b = bound->plan.steps[i];
    EXPECT_EQ(a.axial_depth_mm, b.axial_depth_mm) << i;
    EXPECT_NEAR(a.radial_depth_mm, b.radial_depth_mm, 0.05) << i;  // as cut, of a finish to the rest
    EXPECT_EQ(a.spindle_rpm, b.spindle_rpm) << i;
    if (a.cutter_id != pocket->id) continue;
    ++by_the_mill;
    EXPECT_EQ(b.cutter_id, now->id) << i;
    EXPECT_FALSE(*a.path == *b.path) << i;
  }
  EXPECT_GT(by_the_mill, 0U);
}

TEST(Late, ReopensAToolThatIsNotInTheMagazine) {
  const model::Plan plan = plate();
  pipeline::Inputs in = shop(kMagazine);
  std::erase_if(in.library, [](const auto& c) { return c.pocket == 7; });
  Job job;
  const auto matched = given::match_loaded(plan, in.library, job);
  ASSERT_TRUE(matched);
  ASSERT_FALSE(matched->why.empty());
  EXPECT_EQ(matched->open.size(), matched->why.size());
  EXPECT_NE(matched->why.front().find("END MILL 12"), std::string::npos) << matched->why.front();
}

TEST(Late, FeedsOfAGivenPathComeFromTheSectionsThatItsFileStates) {
  // The plan as another system would bring it: path and sections given, speed and feed open.
  Job job;
  const auto planned = pipeline::bind(plate(), shop(kMagazine), {}, job);
  ASSERT_TRUE(planned) << to_text(planned.error());
  const auto text = pipeline::write_plan(*planned, pipeline::Format::kAp238, job);
  ASSERT_TRUE(text);
  const std::string unsealed = testing::without_seal(*text);
  const auto opened = [&](double factor) {
    Job quiet;
    auto plan = *pipeline::read_plan(unsealed, "plate.stpnc", quiet);
    auto& m = plan.model;
    for (const auto at : m.all(model::TypeId::kMillingTechnology)) {
      m.at<model::MillingTechnology>(at).feedrate.reset();
      m.at<model::MillingTechnology>(at).spindle.reset();
    }
    plan.ledger = model::Ledger{};
    std::set<model::AnyRef> scaled;  // equal points of a file are one
    for (const auto at : m.all(model::TypeId::kCutterLocationTrajectory)) {
      const auto* line = m.get<model::Polyline>(m.at<model::Trajectory>(at).cross_section_area_parameters);
      if (line == nullptr) continue;
      for (const auto p : line->points.items) {
        auto& c = m.at<model::CartesianPoint>(p).coordinates.items;
        if (c.size() == 7 && scaled.insert(p).second) c[4] *= factor;
      }
    }
    return plan;
  };
  const auto warned = [&](double factor) {
    Job said;
    pipeline::Policy policy;
    policy.only_loaded_cutters = true;
    const auto bound = pipeline::bind(opened(factor), shop(kMagazine), policy, said);
    EXPECT_TRUE(bound) << (bound ? "" : to_text(bound.error()));
    if (bound) {
      for (const auto& s : bound->steps) {
        if (!(s.cutting_s > 0.0)) continue;
        EXPECT_GT(s.feed_mm_min, 0.0) << model::step_id(*bound, s);
        EXPECT_NE(s.spindle_rpm, 0.0);
      }
    }
    const auto all = texts(said);
    const auto at = all.find("PIP-SECTIONS");
    if (factor == 1.0) {
      EXPECT_EQ(at, std::string::npos) << all;
    }
    return at != std::string::npos;
  };
  EXPECT_FALSE(warned(1.0));
  EXPECT_TRUE(warned(0.3));
  EXPECT_TRUE(warned(3.0));
}

// The pocket's corners have R6: a mill of 16 mm would leave R8 in them. Offline that is told and agreed to.
TEST(Late, NobodyAtTheMachineAgreesToRestMaterialInCorners) {
  const std::string table = capstan::testing::scratch_file("late_wide.tbl");
  std::ofstream(table) << "T4 P4 Z+95 D+16 ;16 mm carbide end mill, 3 flutes\n";
  const std::string file = capstan::testing::source_dir() + "/examples/reference_pocket.p21";
  Job job;
  auto plan = pipeline::read_plan(testing::slurp(file), file, job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  const auto bound = bind(*std::move(plan), shop(table), {.deadline = std::chrono::seconds(20)}, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-REST") << to_text(bound.error());
  EXPECT_NE(bound.error().message.find("a radius of 8 mm in place of 6 mm"), std::string::npos)
      << bound.error().message;
}

}  // namespace
}  // namespace capstan::late
