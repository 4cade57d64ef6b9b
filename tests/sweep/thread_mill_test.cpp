#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/door/pipeline/pipeline.h"
#include "tests/removal/drawing.h"
#include "tests/support/shop.h"
#include "tests/sweep/sweep.h"

// A thread mill of the library is a ring of teeth on a neck. Heights hold no groove, so that the check looks
// at the neck and takes off what the ring alone cuts.

namespace capstan::testing::sweep {
namespace {

/// M8 on a machine whose control does not synchronise spindle and feed.
Outcome thread_in(const std::string& material) {
  Case c;
  for (std::size_t i = 0; i < features().size(); ++i)
    if (features()[i].name == "tapped hole") c.feature = i;
  while (c.material + 1 < std::size(kMaterials) && kMaterials[c.material].name != material) ++c.material;
  EXPECT_EQ(kMaterials[c.material].name, material);
  c.machine = 1;
  return Sweep().plan(c);
}

/// The same in C45.
const Outcome& milled_thread() {
  static const Outcome made = thread_in("C45");
  return made;
}

bool has(const std::vector<model::Finding>& findings, const std::string& code) {
  return std::any_of(findings.begin(), findings.end(),
                     [&](const auto& f) { return f.code == code && f.severity == Severity::kError; });
}

/// What the check says of the plan with another neck behind the teeth.
std::vector<model::Finding> with_neck(double diameter_mm) {
  model::Plan plan = milled_thread().made.plan;
  for (model::Cutter& c : plan.cutters)
    if (c.cutter_class == model::CutterClass::kThreadMill) c.neck_diameter_mm = diameter_mm;
  Job quiet;
  return pipeline::checked(std::move(plan), quiet).findings;
}

TEST(ThreadMill, MakesAThreadWhereTheMachineDoesNotTap) {
  const Outcome& o = milled_thread();
  ASSERT_TRUE(o.failed.empty()) << o.failed;
  ASSERT_TRUE(o.whole()) << o.made.plan.unplanned.front().reason;
  EXPECT_TRUE(std::any_of(o.made.plan.cutters.begin(), o.made.plan.cutters.end(),
                          [](const auto& c) { return c.cutter_class == model::CutterClass::kThreadMill; }));
  for (const auto& f : o.findings) EXPECT_NE(f.severity, Severity::kError) << f.message;
}

TEST(ThreadMill, WhoseNeckDoesNotPassTheCoreIsFound) {
  EXPECT_FALSE(has(with_neck(3.4), "CHK-NECK"));
  // Its path leaves the axis by (8 - 5.3) / 2 mm; the core is 6.75 mm wide, so that 4.05 mm would pass.
  EXPECT_TRUE(has(with_neck(5.3), "CHK-NECK"));
}

TEST(ThreadMill, WhoseNeckIsNotStatedCutsWithAllOfItsLength) {
  EXPECT_TRUE(has(with_neck(0.0), "CHK-FLUTE"));
}

// The check's cells are some tenths of a millimetre: what is thinner falls between them.
TEST(ThreadMill, WhoseNeckIsThinnerThanTheChecksCellsIsNotCalledGood) {
  const auto findings = with_neck(0.01);
  const auto at = std::find_if(findings.begin(), findings.end(),
                               [](const auto& f) { return f.code == "CHK-NECK-UNDECIDED"; });
  ASSERT_NE(at, findings.end());
  EXPECT_TRUE(at->unproved);
}

model::StepResult& milling_step(model::Plan& plan) {
  return *std::find_if(plan.steps.begin(), plan.steps.end(), [&](const model::StepResult& s) {
    return model::find_cutter(plan, s.cutter_id)->cutter_class == model::CutterClass::kThreadMill;
  });
}

/// Arcs of its path that cut, in turns.
double turns_of(const model::StepResult& s) {
  double out = 0.0;
  for (std::size_t i = 1; i < s.path->size(); ++i) {
    if (!model::is_arc(s.path->kind[i]) || s.path->role[i] != model::MoveRole::kCut) continue;
    const double r = std::hypot(s.path->x[i] - s.path->cx[i], s.path->y[i] - s.path->cy[i]);
    out += std::sqrt(std::max(0.0, std::pow(model::move_length(*s.path, i), 2.0) -
                                       std::pow(s.path->z[i] - s.path->z[i - 1], 2.0))) /
           (2.0 * std::numbers::pi * r);
  }
  return out;
}

// One turn, and a half to lead in and to lead out. The thread is 15 mm deep.
TEST(ThreadMill, OfProfilesOverTheWholeThreadTakesOneTurnWhereItsForceIsBorne) {
  Outcome o = thread_in("POM");
  ASSERT_TRUE(o.whole());
  for (const auto& f : o.findings) EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.message;
  const model::StepResult& s = milling_step(o.made.plan);
  const model::Cutter& c = *model::find_cutter(o.made.plan, s.cutter_id);
  EXPECT_GE(c.maximum_depth_of_cut_mm, 15.0) << c.id;
  EXPECT_NEAR(turns_of(s), 2.0, 1e-6);
  EXPECT_LE(s.loads.deflection_mm, 0.05) << "all its profiles bend it at once";
}

/// The thread in POM, made by a mill with profiles over all of it.
const Outcome& thread_by_rows() {
  static const Outcome made = thread_in("POM");
  return made;
}

/// What the check says of that plan after `change` of its thread mill and of the path.
template <typename Change>
std::vector<model::Finding> with_fault(const Outcome& good, const Change& change) {
  model::Plan plan = good.made.plan;
  model::StepResult& s = milling_step(plan);
  model::CutterPath path = *s.path;
  for (model::Cutter& c : plan.cutters)
    if (c.id == s.cutter_id) change(c, path);
  s.path = std::make_shared<model::CutterPath>(std::move(path));
  Job quiet;
  return pipeline::checked(std::move(plan), quiet).findings;
}

TEST(ThreadMill, WhoseProfilesHaveAnotherPitchIsFound) {
  ASSERT_TRUE(thread_by_rows().whole());
  EXPECT_FALSE(has(with_fault(thread_by_rows(), [](auto&, auto&) {}), "CHK-THREAD"));
  for (const double pitch : {1.0, 1.5}) {
    const auto fault = [&](model::Cutter& c, model::CutterPath&) { c.thread_pitch_mm = pitch; };
    EXPECT_TRUE(has(with_fault(thread_by_rows(), fault), "CHK-THREAD")) << pitch;
    EXPECT_TRUE(has(with_fault(milled_thread(), fault), "CHK-THREAD")) << pitch;
  }
}

TEST(ThreadMill, WhoseProfilesStateNoPitchIsNotCalledGood) {
  const auto findings =
      with_fault(thread_by_rows(), [](model::Cutter& c, model::CutterPath&) { c.thread_pitch_mm = 0.0; });
  const auto at = std::find_if(findings.begin(), findings.end(),
                               [](const auto& f) { return f.code == "CHK-THREAD-UNDECIDED"; });
  ASSERT_NE(at, findings.end());
  EXPECT_TRUE(at->unproved);
}

// The pitch is 1.25: four fifths of each rise are 1 mm in a turn.
TEST(ThreadMill, WhoseHelixHasAnotherPitchIsFound) {
  const auto flatter = [](model::Cutter&, model::CutterPath& p) {
    const double low = *std::min_element(p.z.begin(), p.z.end());
    for (std::size_t i = 0; i < p.size(); ++i)
      if (p.role[i] == model::MoveRole::kCut || p.z[i] < 0.0) p.z[i] = low + 0.8 * (p.z[i] - low);
  };
  for (const Outcome* o : {&thread_by_rows(), &milled_thread()})
    EXPECT_TRUE(has(with_fault(*o, flatter), "CHK-THREAD"));
}

TEST(ThreadMill, WhoseHelixHasTheOtherHandIsFound) {
  const auto mirrored = [](model::Cutter&, model::CutterPath& p) {
    for (auto& kind : p.kind)
      kind = kind == model::MoveKind::kArcCcw  ? model::MoveKind::kArcCw
             : kind == model::MoveKind::kArcCw ? model::MoveKind::kArcCcw
                                               : kind;
  };
  for (const Outcome* o : {&thread_by_rows(), &milled_thread()})
    EXPECT_TRUE(has(with_fault(*o, mirrored), "CHK-THREAD"));
}

// One turn and two leads of half a pitch are 2.5 mm of the thread's 15.
TEST(ThreadMill, WhoseProfilesAreShorterThanTheThreadInOneTurnIsFound) {
  const auto rows = [](double mm) {
    return [mm](model::Cutter& c, model::CutterPath&) { c.maximum_depth_of_cut_mm = mm; };
  };
  EXPECT_TRUE(has(with_fault(thread_by_rows(), rows(8.0)), "CHK-THREAD-LENGTH"));
  EXPECT_TRUE(has(with_fault(thread_by_rows(), rows(1.25)), "CHK-THREAD-LENGTH"));
  EXPECT_FALSE(has(with_fault(thread_by_rows(), rows(15.0)), "CHK-THREAD-LENGTH"));
}

// In steel all profiles at once bend a mill too far: one profile, by the shorter of the necks that reach.
TEST(ThreadMill, OfOneProfileIsTheStiffestThatReaches) {
  model::Plan plan = milled_thread().made.plan;
  const model::StepResult& s = milling_step(plan);
  const model::Cutter& c = *model::find_cutter(plan, s.cutter_id);
  EXPECT_LT(c.maximum_depth_of_cut_mm, 2.0 * c.thread_pitch_mm) << c.id;
  EXPECT_LT(c.neck_length_mm, 2.5 * 8.0) << c.id;
  EXPECT_NEAR(turns_of(s), 15.0 / 1.25 + 1.0, 1e-6);
}

/// What the check says where the step ends in the middle of its thread: `kind` straight up from there.
std::vector<model::Finding> pulled_up(model::MoveKind kind) {
  model::Plan plan = milled_thread().made.plan;
  model::StepResult& s = milling_step(plan);
  model::CutterPath path = *s.path;
  model::FeedSchedule schedule = *s.schedule;
  const std::size_t last = path.size() - 1, at = last / 2;
  EXPECT_EQ(path.role[at], model::MoveRole::kCut);
  const geometry::Vec3 up{path.x[at], path.y[at], path.z[last]};
  model::CutterPath cut;
  cut.start({path.x[0], path.y[0], path.z[0]});
  model::FeedSchedule fed{{schedule.feed_mm_min[0]}, {schedule.spindle_rpm[0]}, {0.0}};
  for (std::size_t i = 1; i <= at + 1; ++i) {
    const geometry::Vec3 to{path.x[i], path.y[i], path.z[i]};
    if (i > at && kind == model::MoveKind::kRapid)
      cut.rapid(up, model::MoveRole::kRetract);
    else if (i > at)
      cut.line(up, model::MoveRole::kCut);
    else if (path.kind[i] == model::MoveKind::kRapid)
      cut.rapid(to, path.role[i]);
    else if (path.kind[i] == model::MoveKind::kLine)
      cut.line(to, path.role[i]);
    else
      cut.arc(to, {path.cx[i], path.cy[i]}, path.kind[i] == model::MoveKind::kArcCw, path.role[i]);
    fed.feed_mm_min.push_back(schedule.feed_mm_min[i]);
    fed.spindle_rpm.push_back(schedule.spindle_rpm[i]);
    fed.dwell_s.push_back(0.0);
  }
  s.path = std::make_shared<model::CutterPath>(std::move(cut));
  s.schedule = std::make_shared<model::FeedSchedule>(std::move(fed));
  Job quiet;
  return pipeline::checked(std::move(plan), quiet).findings;
}

// MakesAThreadWhereTheMachineDoesNotTap is the same thread with its lead-out.
TEST(ThreadMill, ThatIsPulledUpThroughItsThreadIsFound) {
  EXPECT_TRUE(has(pulled_up(model::MoveKind::kRapid), "CHK-HEAD"));
  EXPECT_TRUE(has(pulled_up(model::MoveKind::kLine), "CHK-HEAD"));
}

/// A left-hand M10 on a machine that taps: the library has no tap that turns left.
pipeline::Checked left_hand(bool through) {
  removal::Drawing d("LEFT HAND", {{0.0, 0.0, -24.0}, {40.0, 40.0, 0.0}});
  const auto at = d.placement({20, 20, 0});
  const auto core = through ? d.hole_of("CORE", at, 24, d.length(8.5, 0.15, 0.05), d.through_bottom())
                            : d.hole_of("CORE", at, 18, d.length(8.5, 0.15, 0.05), d.conical_bottom(118));
  d.thread("M10", at, through ? 24 : 12, core, 10, 1.5);
  std::string text = d.text();
  const std::string right = "DESCRIPTIVE_PARAMETER('hand','right')";
  text.replace(text.find(right), right.size(), "DESCRIPTIVE_PARAMETER('hand','left')");
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "generic_vmc";
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = "C45";
  return *pipeline::bind_checked(*pipeline::read_plan(text, "left.p21", quiet), *in, {}, quiet);
}

// A right-hand cutter climbs counter-clockwise: the left-hand helix goes down.
TEST(ThreadMill, MakesALeftHandThreadFromTheTopDown) {
  for (const bool through : {true, false}) {
    const pipeline::Checked made = left_hand(through);
    ASSERT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
    for (const auto& f : made.findings) EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.message;
    model::Plan plan = made.plan;
    const model::CutterPath& path = *milling_step(plan).path;
    for (std::size_t i = 1; i < path.size(); ++i)
      EXPECT_TRUE(path.role[i] != model::MoveRole::kCut || path.z[i] < path.z[i - 1]) << i;
  }
}

// Straight down its teeth have nothing that cuts.
TEST(ThreadMill, ThatGoesStraightDownIntoItsThreadIsFound) {
  model::Plan plan = left_hand(false).plan;
  model::StepResult& s = milling_step(plan);
  model::CutterPath path = *s.path;
  const auto first = static_cast<std::size_t>(
      std::find_if(path.kind.begin(), path.kind.end(), [](model::MoveKind k) { return model::is_arc(k); }) -
      path.kind.begin());
  ASSERT_LT(first + 2, path.size());
  path.kind[first + 1] = model::MoveKind::kLine;
  path.x[first + 1] = path.x[first];
  path.y[first + 1] = path.y[first];
  s.path = std::make_shared<model::CutterPath>(std::move(path));
  Job quiet;
  EXPECT_TRUE(has(pipeline::checked(std::move(plan), quiet).findings, "CHK-HEAD"));
}

}  // namespace
}  // namespace capstan::testing::sweep
