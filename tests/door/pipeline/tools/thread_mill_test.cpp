#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "tests/door/pipeline/block.h"
#include "tests/support/corpus.h"
#include "tooling/library/library.h"
#include "tooling/selection/select.h"

// The feed of thread mills, by hand.

namespace capstan::pipeline {
namespace {

/// M20 x 2.5, left-hand, 15 mm deep in a core of 17.5 mm right through the block: milled.
const char* const kM20 =
    "#70=CARTESIAN_POINT('',(0.,0.,-20.));\n#71=AXIS2_PLACEMENT_3D('',#70,#21,#22);\n#72=PLANE('',#71);\n"
    "#60=PLUS_MINUS_VALUE(0.2,0.2,3);\n#61=TOLERANCED_LENGTH_MEASURE(17.5,#60);\n"
    "#75=ROUND_HOLE('CORE',#4,(),#50,#72,#61,$,#58);\n#80=CARTESIAN_POINT('',(0.,0.,-15.));\n"
    "#81=AXIS2_PLACEMENT_3D('',#80,#21,#22);\n#82=PLANE('',#81);\n"
    "#121=PARTIAL_AREA_DEFINITION(15.,#50,$);\n#122=DESCRIPTIVE_PARAMETER('fit class','6H');\n"
    "#123=DESCRIPTIVE_PARAMETER('form','M');\n#124=NUMERIC_PARAMETER('threads per mm',0.4,'mm');\n"
    "#125=DESCRIPTIVE_PARAMETER('hand','left');\n"
    "#126=DEFINED_THREAD('M20',#4,(),#50,#82,#121,(#75),.T.,$,#122,#123,20.,#124,#125,18.376,17.294,$);\n";

TEST(ThreadMill, ItsCentreIsFedByTheSmallerCircle) {
  const auto made = block::bound(block::read(kM20));
  const auto step = std::find_if(made.plan.steps.begin(), made.plan.steps.end(), [&](const auto& s) {
    const auto* c = model::find_cutter(made.plan, s.cutter_id);
    return c != nullptr && c->cutter_class == model::CutterClass::kThreadMill;
  });
  ASSERT_NE(step, made.plan.steps.end()) << made.said;
  const model::Cutter& c = *model::find_cutter(made.plan, step->cutter_id);
  const double fz = tooling::start_values(c, made.plan.material, made.plan.machine).fz_mm;
  ASSERT_GT(fz, 0.0);
  const double major = 20.0, d = c.cutting_diameter_mm, core = 17.5;
  // Sandvik's formulas of internal thread milling, chip = the table's feed per tooth.
  const double ae = (major * major - core * core) / (4.0 * (major - d));
  const double arc = std::acos(1.0 - 2.0 * ae / d);
  const double edge_fz = fz / std::min(1.0, std::sin(std::min(arc, 1.5708)));
  const double most = edge_fz * c.teeth * std::abs(step->spindle_rpm) * (major - d) / major;
  double fastest = 0.0;
  for (std::size_t i = 1; i < step->path->size(); ++i) {
    const bool arc_move =
        step->path->kind[i] == model::MoveKind::kArcCw || step->path->kind[i] == model::MoveKind::kArcCcw;
    if (arc_move) fastest = std::max(fastest, step->schedule->feed_mm_min[i]);
  }
  EXPECT_GT(fastest, 0.0);
  EXPECT_LE(fastest, most * 1.001);
  EXPECT_GE(fastest, 0.5 * most);  // and not needlessly slow: aluminium, no other limit is near
}

// 25.4 / 10.16 = 2.5: the check reads the pitch by itself and finds the mill's.
TEST(ThreadMill, OfAThreadCountedPerInchIsHeldAgainstItsPitchInMm) {
  std::string inch = kM20;
  const std::string per_mm = "NUMERIC_PARAMETER('threads per mm',0.4,'mm')";
  for (const double count : {10.16, 12.7}) {
    std::string text = inch;
    text.replace(text.find(per_mm), per_mm.size(),
                 "NUMERIC_PARAMETER('threads per inch'," + std::to_string(count) + ",'inch')");
    const auto made = block::bound(block::read(text));
    const bool milled = std::any_of(made.plan.cutters.begin(), made.plan.cutters.end(), [](const auto& c) {
      return c.cutter_class == model::CutterClass::kThreadMill;
    });
    EXPECT_EQ(milled, count == 10.16) << "the library has no M20 with a pitch of 2 mm: " << made.said;
    Job quiet;
    for (const auto& f : findings_of(made.plan, quiet)) {
      EXPECT_NE(f.code, "CHK-THREAD") << f.message;
      EXPECT_NE(f.code, "CHK-MEANING") << f.message;
    }
  }
}

/// The thread mill that a plan has, and its step's path.
struct ThreadMillOf {
  model::Cutter cutter;
  std::shared_ptr<const model::CutterPath> path;
};
ThreadMillOf thread_mill_of(const model::Plan& plan) {
  for (const auto& s : plan.steps) {
    const auto* c = model::find_cutter(plan, s.cutter_id);
    if (c != nullptr && c->cutter_class == model::CutterClass::kThreadMill) return {*c, s.path};
  }
  return {};
}

// Its profiles are the length of its teeth and their pitch: 45.54 mm and 2.5 mm, for a thread of 20 mm.
TEST(ThreadMill, OfProfilesOverTheWholeThreadComesBackFromEachForm) {
  const std::string file = testing::source_dir() + "/docs/strategies/thread.p21";
  Job job;
  auto read = read_plan(testing::slurp(file), "thread.p21", job);
  ASSERT_TRUE(read);
  const auto plan = bind(*std::move(read), block::shop(), {}, job);
  ASSERT_TRUE(plan);
  const ThreadMillOf made = thread_mill_of(*plan);
  ASSERT_TRUE(made.path);
  ASSERT_GT(made.cutter.maximum_depth_of_cut_mm, 20.0) << made.cutter.id;
  for (const auto& [format, name] : {std::pair{Format::kJson, "plan.json"},
                                     {Format::kIso14649, "plan.p21"},
                                     {Format::kAp238, "plan.stpnc"}}) {
    Job quiet;
    const auto text = write_plan(*plan, format, quiet);
    ASSERT_TRUE(text) << name;
    const auto back = read_plan(*text, name, quiet);
    ASSERT_TRUE(back) << name;
    const ThreadMillOf again = thread_mill_of(*back);
    ASSERT_TRUE(again.path) << name;
    EXPECT_EQ(again.cutter.id, made.cutter.id) << name;
    EXPECT_EQ(again.cutter.thread_pitch_mm, 2.5) << name;
    EXPECT_EQ(again.cutter.maximum_depth_of_cut_mm, made.cutter.maximum_depth_of_cut_mm) << name;
    EXPECT_EQ(again.cutter.cutting_diameter_mm, 13.8) << name;
    EXPECT_EQ(again.cutter.thread_size_mm, 20.0) << name;
    EXPECT_EQ(again.cutter.thread_form, "M") << name;
    EXPECT_EQ(again.cutter.teeth, made.cutter.teeth) << name;
    EXPECT_EQ(again.cutter.neck_diameter_mm, 0.0) << name;
    EXPECT_EQ(again.path->size(), made.path->size()) << name;
  }
}

}  // namespace
}  // namespace capstan::pipeline
