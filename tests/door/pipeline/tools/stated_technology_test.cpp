#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "planner/model/nouns/all.h"
#include "tests/support/corpus.h"
#include "tests/support/shop.h"

// Speeds and feeds of a file that states only one of them, or one that cannot be.

namespace capstan::pipeline {
namespace {

struct Planned {
  model::Plan plan;
  std::string said;
  std::string program;
};

Inputs shop() {
  Job job;
  auto in = load_shop({}, job);
  EXPECT_TRUE(in);
  return in ? *std::move(in) : Inputs{};
}

/// Two holes of 8 mm, drilled by a drill of two edges. `technology` begins MILLING_TECHNOLOGY (feed m/s,
/// reference, cutting speed m/s, spindle 1/s, feed per tooth mm); `retract` is feed_on_retract.
Planned drilled(const std::string& technology, const std::string& retract = "$", const Policy& policy = {}) {
  const std::string folder = capstan::testing::source_dir();
  std::string text = testing::slurp(folder + "/tests/door/pipeline/parts/compounds.p21");
  const auto put = [&](const std::string& from, const std::string& to) {
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
  };
  put("(),$,#8,$);", "(#101),$,#8,$);");
  put("ENDSEC;\nEND-ISO", R"(#101=MACHINING_WORKINGSTEP('PAIRS',#31,#66,#102,$);
#102=DRILLING($,$,'DRILL',20.,$,#103,#106,#107,$,10.,0.,$,)" +
                              retract + R"(,$);
#103=MILLING_CUTTING_TOOL('DRILL 8',#104,(#105),60.,$,$);
#104=TWIST_DRILL(#108,2,.RIGHT.,.F.,$);
#105=CUTTING_COMPONENT(50.,$,$,$,$);
#106=)" + technology + R"(,.F.,.F.,.F.,$);
#107=MILLING_MACHINE_FUNCTIONS(.F.,$,$,.F.,$,(),.T.,$,$,());
#108=MILLING_TOOL_DIMENSION(8.,70.,$,50.,$,$,$);
ENDSEC;
END-ISO)");
  Job job;
  const Inputs in = shop();
  auto plan = read_plan(text, "part.p21", job);
  EXPECT_TRUE(plan) << (plan ? "" : to_text(plan.error()));
  if (!plan) return {};
  auto bound = bind(*std::move(plan), in, policy, job);
  EXPECT_TRUE(bound) << (bound ? "" : to_text(bound.error()));
  if (!bound) return {};
  Planned out;
  out.plan = *std::move(bound);
  for (const auto& d : job.take_diagnostics()) {
    if (d.code == "PIP-CHANGED") out.said.append(d.message).append("\n");
  }
  if (const auto program = write_plan(out.plan, Format::kLinuxCnc, job)) out.program = *program;
  return out;
}

/// Speed (positive clockwise) and greatest feed of the given step.
struct Cut {
  double rpm = 0.0, feed = 0.0;
};
Cut cut_of(const Planned& p) {
  Cut out;
  for (const auto& s : p.plan.steps) {
    const auto* e = p.plan.model.get<model::Executable>(s.step);
    if (e == nullptr || e->its_id.value_or("") != "PAIRS" || !s.schedule) continue;
    for (std::size_t i = 0; i < s.schedule->feed_mm_min.size(); ++i) {
      if (s.schedule->spindle_rpm[i] != 0.0) out.rpm = s.schedule->spindle_rpm[i];
      out.feed = std::max(out.feed, s.schedule->feed_mm_min[i]);
    }
  }
  return out;
}

TEST(StatedTechnology, ASpeedStaysWhereTheFeedIsOpen) {
  const Planned p = drilled("MILLING_TECHNOLOGY($,.TCP.,$,-20.,$");
  EXPECT_DOUBLE_EQ(cut_of(p).rpm, 1200.0);  // 20 1/s
  EXPECT_GT(cut_of(p).feed, 0.0);
  EXPECT_EQ(p.said, "");
}

TEST(StatedTechnology, ACuttingSpeedStaysWhereTheFeedIsOpen) {
  const Planned p = drilled("MILLING_TECHNOLOGY($,.TCP.,0.5,$,$");
  EXPECT_NEAR(cut_of(p).rpm, 0.5 * 60'000.0 / (std::numbers::pi * 8.0), 1e-6);
  EXPECT_GT(cut_of(p).feed, 0.0);
}

TEST(StatedTechnology, AFeedStaysWhereTheSpeedIsOpen) {
  const Planned p = drilled("MILLING_TECHNOLOGY(0.004,.TCP.,$,$,$");
  EXPECT_DOUBLE_EQ(cut_of(p).feed, 240.0);  // 0.004 m/s
  EXPECT_GT(cut_of(p).rpm, 0.0);
}

TEST(StatedTechnology, AFeedPerToothStaysWhereTheSpeedIsOpen) {
  const Planned p = drilled("MILLING_TECHNOLOGY($,.TCP.,$,$,0.06");
  const Cut cut = cut_of(p);
  EXPECT_GT(cut.rpm, 0.0);
  EXPECT_NEAR(cut.feed, 0.06 * 2 * cut.rpm, 1.0);  // rounded down to whole mm/min
}

TEST(StatedTechnology, ReopenedItIsChosenAnew) {
  Policy policy;
  policy.reopen = Reopen::kTechnology;
  EXPECT_NE(cut_of(drilled("MILLING_TECHNOLOGY($,.TCP.,$,-20.,$", "$", policy)).rpm, 1200.0);
}

TEST(StatedTechnology, ASpeedAtWhichNothingCanBeCutIsLetGoAndItIsSaid) {
  const Planned p = drilled("MILLING_TECHNOLOGY($,.TCP.,$,-0.05,$");  // 3 1/min
  EXPECT_GT(cut_of(p).rpm, 3.0);
  EXPECT_NE(
      p.said.find("instead of the stated speed of 3 1/min, which breaks a limit: spindle speed 3 1/min, "
                  "at least "),
      std::string::npos)
      << p.said;
}

TEST(StatedTechnology, AFeedOfZeroOnTheWayOutIsTakenAsNotStated) {
  const Planned p = drilled("MILLING_TECHNOLOGY(0.004,.TCP.,$,-20.,$", "0.");
  EXPECT_NE(p.said.find("feed_on_retract is 0"), std::string::npos) << p.said;
  Job job;
  for (const auto& f : findings_of(p.plan, job)) EXPECT_NE(f.code, "CHK-FEED") << f.message;
  EXPECT_DOUBLE_EQ(cut_of(p).feed, 240.0);
  EXPECT_NE(p.program.find("M3"), std::string::npos);
}

TEST(StatedTechnology, ASpeedAgainstTheCuttersHandIsTurnedRoundAndItIsSaid) {
  const Planned p = drilled("MILLING_TECHNOLOGY(0.004,.TCP.,$,20.,$");  // counter-clockwise
  EXPECT_DOUBLE_EQ(cut_of(p).rpm, 1200.0);
  EXPECT_NE(p.said.find("cuts right-hand; it turns clockwise at the same 1200 1/min"), std::string::npos)
      << p.said;
  EXPECT_EQ(p.program.find("M4 "), std::string::npos);
  EXPECT_EQ(p.program.find("M4\n"), std::string::npos);
  Job job;
  for (const auto& f : findings_of(p.plan, job)) EXPECT_NE(f.code, "CHK-SPINDLE-DIRECTION") << f.message;
}

}  // namespace
}  // namespace capstan::pipeline
