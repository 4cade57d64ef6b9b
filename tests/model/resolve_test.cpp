#include "planner/model/features/resolve.h"

#include <gtest/gtest.h>

#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

TEST(Resolve, LengthsCarryTheirTolerance) {
  Model m;
  const auto make = [&](auto tolerance) {
    TolerancedLengthMeasure l;
    l.theoretical_size = 20.0;
    l.implicit_tolerance = m.add(tolerance);
    return m.add(l);
  };
  PlusMinusValue pm;
  pm.upper_limit = 0.1;
  pm.lower_limit = 0.05;
  const auto a = length(m, make(pm));
  ASSERT_TRUE(a);
  EXPECT_EQ(a->nominal_mm, 20.0);
  EXPECT_EQ(a->upper_mm, 0.1);
  EXPECT_EQ(a->lower_mm, -0.05);
  EXPECT_EQ(a->grade, "IT11");  // 130 um of the 150
  pm.lower_limit = -0.3;        // empty unless read as a signed deviation
  const auto b = length(m, make(pm));
  EXPECT_EQ(b->lower_mm, -0.3);
  LimitsAndFits lf;
  lf.deviation = 0.0;
  lf.grade = 0.021;
  lf.its_fitting_type = FittingType::kHole;
  const auto hole = length(m, make(lf));  // 20 H7
  EXPECT_EQ(hole->lower_mm, 0.0);
  EXPECT_EQ(hole->upper_mm, 0.021);
  EXPECT_EQ(hole->grade, "IT7");
  EXPECT_DOUBLE_EQ(hole->middle(), 20.0105) << "what paths aim at";
  TolerancedLengthMeasure bare;
  bare.theoretical_size = 5.0;
  EXPECT_FALSE(length(m, m.add(bare))->given);
  EXPECT_EQ(length(m, {}).error().code, "MDL-MISSING");
}

TEST(Resolve, ATolerancesFaultNamesItsPlaceInTheFile) {
  Model m;
  PlusMinusValue pm;
  pm.upper_limit = pm.lower_limit = 0.0;
  TolerancedLengthMeasure l;
  l.theoretical_size = 20.0;
  const auto tolerance = m.add(pm);
  m.set_origin(tolerance, {42, 7});
  l.implicit_tolerance = tolerance;
  const auto r = length(m, m.add(l));
  ASSERT_FALSE(r);
  EXPECT_EQ(r.error().code, "MDL-TOLERANCE");
  EXPECT_EQ(r.error().instance, 42U);
  EXPECT_EQ(r.error().line, 7U);
}

Ref<CartesianPoint> add_point(Model& m, std::vector<double> c) {
  CartesianPoint p;
  p.coordinates = {std::move(c), true};
  return m.add(p);
}
Ref<Direction> add_direction(Model& m, std::vector<double> c) {
  Direction d;
  d.direction_ratios = {std::move(c), true};
  return m.add(d);
}

TEST(Resolve, DepthIsWhereTheSurfaceCutsTheFeaturesAxis) {
  Model m;
  Axis2Placement3d place;
  place.location = add_point(m, {3.0, 0.0, -7.0});
  Plane plane;
  plane.position = m.add(place);
  RoundHole hole;
  hole.depth = m.add(plane);
  const auto flat = depth_of(m, m.add(hole));
  ASSERT_TRUE(flat);
  EXPECT_EQ(flat->depth_mm, 7.0);
  EXPECT_FALSE(flat->tilted);
  // Tilted by 45 degrees about y through (3, 0, -7): at x = 0 it lies 3 mm higher or lower.
  place.axis = add_direction(m, {1.0, 0.0, 1.0});
  plane.position = m.add(place);
  hole.depth = m.add(plane);
  const auto tilted = depth_of(m, m.add(hole));
  ASSERT_TRUE(tilted);
  EXPECT_NEAR(tilted->depth_mm, 4.0, 1e-12);
  EXPECT_TRUE(tilted->tilted);
  place.axis = add_direction(m, {1.0, 0.0, 0.0});
  plane.position = m.add(place);
  hole.depth = m.add(plane);
  EXPECT_EQ(depth_of(m, m.add(hole)).error().code, "MDL-DEPTH");
  hole.depth = {};
  EXPECT_EQ(depth_of(m, m.add(hole)).error().code, "MDL-MISSING");
}

TEST(Resolve, DirectionsAreUnitAndFaultsNameTheInstance) {
  Model m;
  EXPECT_EQ(*direction(m, add_direction(m, {0.0, 3.0, 4.0})), (geometry::Vec3{0.0, 0.6000000000000001, 0.8}));
  const auto zero = add_direction(m, {0.0, 0.0, 0.0});
  m.set_origin(zero, {42, 7});
  EXPECT_EQ(direction(m, zero).error().instance, 42U);
  EXPECT_EQ(direction(m, zero).error().line, 7U);
  EXPECT_EQ(*point(m, add_point(m, {1.0, 2.0})), (geometry::Vec3{1.0, 2.0, 0.0}));
  EXPECT_TRUE(placement_or_identity(m, {}));
  EXPECT_FALSE(placement(m, {}));
}

}  // namespace
}  // namespace capstan::model
