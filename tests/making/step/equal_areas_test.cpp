#include "planner/making/step/path/equal_areas.h"

#include <gtest/gtest.h>

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/model/nouns/all.h"

// Areas with one key are taken as one: so one that is deeper, higher, of another shape or opened by a hole
// has a key of its own, or none.

namespace capstan::step {
namespace {

const geometry::Box3 kPlate{{0.0, 0.0, -20.0}, {200.0, 100.0, 0.0}};

/// Pockets in a plate with its top at z = 0, each roughed with the same end mill.
class EqualAreasOfAPlate : public ::testing::Test {
 protected:
  EqualAreasOfAPlate() {
    mill_.id = "em10";
    mill_.cutter_class = model::CutterClass::kEndmill;
    mill_.cutting_diameter_mm = mill_.shank_diameter_mm = 10.0;
    mill_.maximum_depth_of_cut_mm = 22.0;
    mill_.stick_out_mm = 40.0;
    mill_.teeth = 3;
    plan_.machine.spindle.rpm_max = 12000.0;
    plan_.machine.spindle.curve = {{1000.0, 7500.0, 71.6}, {12000.0, 7500.0, 5.97}};
    raw_.box = kPlate;
    operation_ = plan_.model.add(model::BottomAndSideRoughMilling{});
  }

  /// The key of a pocket of 30 x 20 mm about a place.
  std::optional<memo::Key> key(geometry::Vec3 at, double depth_mm, double length_mm = 30.0) {
    model::FeatureShape s;
    s.kind = model::ShapeKind::kPocket;
    s.name = "pocket " + std::to_string(steps_.size());
    s.frame.origin = at;
    s.depth_mm = depth_mm;
    s.area = s.reach = geometry::rectangle({-0.5 * length_mm, -10.0}, {0.5 * length_mm, 10.0});
    draft::StepDraft step;
    step.operation = operation_;
    step.shapes = {s};
    step.cutter = mill_;
    step.open_technology = true;
    steps_.push_back(step);
    return key_of_area(so_far_, steps_.back(), nullptr, true, std::nullopt, means_);
  }
  static std::vector<draft::SetupDraft> one_setup() {
    draft::SetupDraft setup;
    setup.security_z_mm = 20.0;
    setup.stock = kPlate;
    return {setup};
  }
  /// The end mill goes down through the plate.
  void open_by_a_hole(double x, double y) {
    model::CutterPath down;
    down.start({x, y, 10.0});
    down.rapid({x, y, 2.0});
    down.line({x, y, -20.0}, model::MoveRole::kDrill);
    down.rapid({x, y, 10.0}, model::MoveRole::kRetract);
    (void)stocks_.of(0);
    stocks_.cut(0, down, mill_);
  }

  model::Cutter mill_;
  model::Plan plan_;
  model::Stock raw_;
  model::AnyRef operation_;
  std::vector<draft::SetupDraft> setups_ = one_setup();
  std::vector<draft::StepDraft> steps_;
  piece::Shapes shapes_;
  piece::Piece piece_{plan_, shapes_};
  piece::Demands demands_;
  draft::Recorded recorded_;
  std::vector<model::Cutter> library_;
  Wishes wishes_{.library = library_};
  PlanSoFar so_far_{plan_, setups_, steps_, piece_, demands_, recorded_, wishes_};
  std::set<model::AnyRef> left_out_;
  SmallestCutters known_cells_;
  Stocks stocks_{raw_, setups_, steps_, left_out_, known_cells_, nullptr};
  Progress progress_{so_far_};
  KnownCuts known_;
  Job job_;
  Cuts cuts_{known_, {}, job_};
  Means means_{stocks_, progress_, cuts_, job_};
};

TEST_F(EqualAreasOfAPlate, HaveOneKeyAtAllPlacesAndUnequalOnesAnother) {
  const auto first = key({40.0, 50.0, 0.0}, 10.0);
  ASSERT_TRUE(first);
  EXPECT_EQ(key({140.0, 50.0, 0.0}, 10.0), first);
  EXPECT_NE(key({140.0, 50.0, 0.0}, 12.0), first) << "deeper";
  EXPECT_NE(key({140.0, 50.0, -2.0}, 10.0), first) << "lower";
  EXPECT_NE(key({140.0, 50.0, 0.0}, 10.0, 32.0), first) << "longer";
}

TEST_F(EqualAreasOfAPlate, DifferByAHoleThatOpensOne) {
  const auto closed = key({140.0, 50.0, 0.0}, 10.0);
  ASSERT_TRUE(closed);
  open_by_a_hole(145.0, 52.0);
  EXPECT_NE(key({140.0, 50.0, 0.0}, 10.0), closed);
}

TEST_F(EqualAreasOfAPlate, WhatIsKeptOfOneIsFoundOfNoOther) {
  EqualAreas areas;
  const auto first = key({40.0, 50.0, 0.0}, 10.0), equal = key({140.0, 50.0, 0.0}, 10.0),
             deeper = key({140.0, 50.0, 0.0}, 12.0);
  ASSERT_TRUE(first && equal && deeper);
  areas.keep(*first, {Clearing::kInwards, 12.0, {}, {}});
  ASSERT_NE(areas.find(*equal), nullptr);
  EXPECT_EQ(areas.find(*equal)->way, Clearing::kInwards);
  EXPECT_EQ(areas.find(*deeper), nullptr);
}

}  // namespace
}  // namespace capstan::step
