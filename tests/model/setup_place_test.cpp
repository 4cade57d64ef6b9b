#include "planner/model/features/setup_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/model/nouns/all.h"

// Where SETUP.its_origin and WORKPIECE_SETUP.its_origin put a workpiece in the program of its set-up.

namespace capstan::model {
namespace {

using geometry::Vec3;

Ref<Axis2Placement3d> frame(Model& m, Vec3 at, Vec3 z, Vec3 x) {
  CartesianPoint p;
  p.coordinates = {{at.x, at.y, at.z}, true};
  Direction axis, ref;
  axis.direction_ratios = {{z.x, z.y, z.z}, true};
  ref.direction_ratios = {{x.x, x.y, x.z}, true};
  Axis2Placement3d f;
  f.location = m.add(p);
  f.axis = m.add(axis);
  f.ref_direction = m.add(ref);
  return m.add(f);
}

struct Placed {
  Model m;
  Ref<Setup> setup;
  Ref<Workpiece> piece;
  /// Origin, z and x of both placements.
  Placed(Vec3 o1, Vec3 z1, Vec3 x1, Vec3 o2, Vec3 z2, Vec3 x2) {
    piece = m.add(Workpiece{});
    WorkpieceSetup w;
    w.its_workpiece = piece;
    w.its_origin = frame(m, o2, z2, x2);
    Setup s;
    s.its_origin = frame(m, o1, z1, x1);
    s.its_workpiece_setup.push_back(m.add(w));
    setup = m.add(s);
  }
  [[nodiscard]] geometry::Placement found() const { return workpiece_in_program(m, setup).value().value(); }
};

constexpr Vec3 kUp{0, 0, 1}, kRight{1, 0, 0}, kBack{0, 1, 0}, kDown{0, 0, -1};

void expect_near(Vec3 a, Vec3 b) { EXPECT_LT(norm(a - b), 1e-12) << a.x << " " << a.y << " " << a.z; }

TEST(SetupPlace, TheOriginOfASetUpIsTheZeroOfItsProgramAndMovesNothingInIt) {
  const Placed p({123, 45, 6}, kUp, kRight, {10, 20, 30}, kUp, kRight);
  EXPECT_EQ(p.found(), (geometry::Placement{.origin = {10, 20, 30}}));
}

TEST(SetupPlace, ATurnOfTheSetUpTurnsTheWorkpieceAboutTheProgramsZero) {
  const Placed p({123, 45, 6}, kUp, kBack, {10, 20, 30}, kUp, kRight);
  // A quarter turn: x to y, y to -x.
  expect_near(p.found().origin, {-20, 10, 30});
  expect_near(p.found().x, {0, 1, 0});
  expect_near(p.found().y, {-1, 0, 0});
}

TEST(SetupPlace, TurnsOfBothAddUp) {
  const double a = std::numbers::pi / 6.0;  // 30 degrees, and 60 more
  const Placed p({}, kUp, {std::cos(a), std::sin(a), 0}, {}, kUp, {std::cos(2 * a), std::sin(2 * a), 0});
  expect_near(p.found().x, {0, 1, 0});
}

TEST(SetupPlace, ALeanOfTheSetUpThatTheWorkpieceTakesBackIsNone) {
  const double a = 0.3;
  const Placed p({}, {0, -std::sin(a), std::cos(a)}, kRight, {}, {0, std::sin(a), std::cos(a)}, kRight);
  EXPECT_LE(lean_rad(p.found()), kUprightRad);
  EXPECT_EQ(leaning_attributes(p.m, p.setup), "SETUP.its_origin and WORKPIECE_SETUP.its_origin");
}

TEST(SetupPlace, ALeanIsTheAngleBetweenZAndTheTool) {
  const double a = std::numbers::pi / 18.0;
  const Placed tilted({}, kUp, kRight, {}, {0, -std::sin(a), std::cos(a)}, kRight);
  EXPECT_NEAR(lean_rad(tilted.found()), a, 1e-12);
  EXPECT_EQ(leaning_attributes(tilted.m, tilted.setup), "WORKPIECE_SETUP.its_origin");
  const Placed over({}, kDown, kRight, {}, kUp, kRight);
  EXPECT_NEAR(lean_rad(over.found()), std::numbers::pi, 1e-12);
  EXPECT_EQ(leaning_attributes(over.m, over.setup), "SETUP.its_origin");
}

TEST(SetupPlace, OfSeveralWorkpiecesEachHasItsOwnPlace) {
  Placed p({}, kUp, kRight, {1, 0, 0}, kUp, kRight);
  const auto other = p.m.add(Workpiece{});
  WorkpieceSetup w;
  w.its_workpiece = other;
  w.its_origin = frame(p.m, {2, 0, 0}, kUp, kRight);
  const auto second = p.m.add(w);
  p.m.at<model::Setup>(p.setup).its_workpiece_setup.push_back(second);
  const auto x_of = [&](const Workpiece* piece) {
    return workpiece_in_program(p.m, p.setup, piece).value().value().origin.x;
  };
  EXPECT_EQ(x_of(p.m.get<Workpiece>(other)), 2.0);
  EXPECT_EQ(x_of(p.m.get<Workpiece>(p.piece)), 1.0);
  EXPECT_EQ(x_of(nullptr), 1.0);
}

TEST(SetupPlace, WithoutASetUpOrAWorkpieceInItThereIsNoPlace) {
  Model m;
  EXPECT_FALSE(workpiece_in_program(m, {}).value());
  EXPECT_FALSE(workpiece_in_program(m, m.add(model::Setup{})).value());
}

}  // namespace
}  // namespace capstan::model
