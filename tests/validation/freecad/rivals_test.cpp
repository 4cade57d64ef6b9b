#include "tests/validation/freecad/rivals.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/support/shop.h"
#include "tests/validation/freecad/foreign_path.h"
#include "tests/validation/freecad/simulated.h"

namespace capstan::validation {
namespace {

constexpr RivalCase kCase{"C45", 10, 0};

/// A way down at feed, an arc, a way up, each with its line.
constexpr const char* kProgram =
    "G21 G17 G90 G94\nF100\nG0X0Y0Z5\nG1Z1\nX1Z-1\nZ-2\nG2X3I1J0\nG1X9\nZ5\nM2\n";

TEST(ForeignPath, TellsMovesByWhatTheyDo) {
  const auto path = path_of_program(kProgram, 0.0);
  ASSERT_TRUE(path) << to_text(path.error());
  using R = model::MoveRole;
  const std::vector<R> roles{R::kApproach, R::kRamp, R::kPlunge, R::kCut, R::kCut, R::kRetract};
  ASSERT_EQ(path->size(), roles.size() + 1);
  for (std::size_t i = 0; i < roles.size(); ++i) EXPECT_EQ(path->role[i + 1], roles[i]) << i;
  EXPECT_EQ(path->kind[4], model::MoveKind::kArcCw);
  EXPECT_DOUBLE_EQ(path->cx[4], 2.0);
}

TEST(ForeignPath, KeepsItsLengthInPieces) {
  const auto path = path_of_program(kProgram, 0.0);
  ASSERT_TRUE(path) << to_text(path.error());
  const model::CutterPath pieces = in_pieces(*path, 0.5);
  double whole_mm = 0.0, sum_mm = 0.0;
  for (std::size_t i = 1; i < path->size(); ++i) whole_mm += model::move_length(*path, i);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_LE(model::move_length(pieces, i), 0.5 + 1e-9);
    sum_mm += model::move_length(pieces, i);
  }
  EXPECT_NEAR(sum_mm, whole_mm, 1e-9);
}

TEST(ForeignPath, IsNoneWhereTheProgramCannotBeFollowed) {
  EXPECT_FALSE(path_of_program("G21 G90\n#1=3\nG0 X#1 Y0 Z0\nG1 X5 F100\nM2\n", 0.0));
  EXPECT_FALSE(path_of_program("G21 G90\nM2\n", 0.0));
}

// What is fair of the comparison: our own path, handed in as somebody else's, gets the feeds that it had, and may
// be quicker, for a given speed is not lowered where the path is a deep slot.
TEST(ForeignPath, OfOurOwnTakesNoMoreTimeThanItTakes) {
  const auto m = match(kCase, "generic_vmc");
  ASSERT_TRUE(m) << to_text(m.error());
  pipeline::ShopFiles files;
  files.machine = "generic_vmc";
  Job job;
  auto in = pipeline::load_shop(files, job);
  ASSERT_TRUE(in);
  in->material_name = kCase.material;
  const model::StepResult& ours = m->ours.steps[m->step];
  const auto again = with_path(m->ours, m->step, in_pieces(*ours.path, 2.0), *in, job);
  ASSERT_TRUE(again) << to_text(again.error());
  const model::StepResult& theirs = again->steps[m->step];
  EXPECT_EQ(theirs.cutter_id, ours.cutter_id);
  EXPECT_DOUBLE_EQ(std::abs(theirs.spindle_rpm), std::abs(ours.spindle_rpm));
  // Neighbouring moves share a feed within 3 % (kGroupRatio), and theirs are told apart at other places.
  EXPECT_LE(theirs.cutting_s, 1.03 * ours.cutting_s);
  // Deep slots turn at three quarters of the speed: an eighth of this path, as its speeds say.
  double slow = 0.0;
  for (std::size_t i = 1; i < ours.path->size(); ++i) {
    if (std::abs(ours.schedule->spindle_rpm[i]) < 0.99 * std::abs(ours.spindle_rpm))
      slow += model::move_length(*ours.path, i);
  }
  double all = 0.0;
  for (std::size_t i = 1; i < ours.path->size(); ++i) all += model::move_length(*ours.path, i);
  EXPECT_GE(theirs.cutting_s, (1.0 - 0.03 - 0.25 * slow / all) * ours.cutting_s);
}

TEST(Rivals, RemoveWhatOursRemovesAndKeepItsLimits) {
  for (const RivalCase& c : {kCase, RivalCase{"EN AW-6061", 20, 14}}) {
    const auto m = match(c, "generic_vmc");
    ASSERT_TRUE(m) << to_text(m.error());
    ASSERT_GE(m->rivals.size(), 3U);
    const model::StepResult& ours = m->ours.steps[m->step];
    for (const Rival& r : m->rivals) {
      // FreeCAD's tolerance on walls, 0.01 mm, is 0.2 % of the pocket's volume at most.
      EXPECT_NEAR(r.removed_mm3, m->removed_mm3, 0.002 * m->removed_mm3) << r.name;
      EXPECT_GE(r.constant_s, r.scheduled_s) << r.name;
      const model::StepResult& theirs = r.scheduled.steps[m->step];
      EXPECT_DOUBLE_EQ(std::abs(theirs.spindle_rpm), std::abs(ours.spindle_rpm)) << r.name;
      EXPECT_TRUE(theirs.exceeded.empty()) << r.name;
    }
    EXPECT_NE(fastest(*m, true, false), nullptr);
    EXPECT_LE(fastest(*m, false, false)->scheduled_s, m->rivals.back().scheduled_s);
  }
}

TEST(SimulatedRoughing, ReadsWhatItWrites) {
  const std::vector<SimulatedRoughing> record{{part_name(kCase), "C45", kOurs, 12.5, 12.25}};
  const auto read = simulated_of(text_of(record));
  ASSERT_EQ(read.size(), 1U);
  EXPECT_EQ(read[0].part, "pocket, 10 mm");
  EXPECT_EQ(read[0].path, kOurs);
  EXPECT_DOUBLE_EQ(read[0].measured_s, 12.5);
  EXPECT_TRUE(simulated_of("no record").empty());
}

}  // namespace
}  // namespace capstan::validation
