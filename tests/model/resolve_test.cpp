#include "planner/model/resolve.h"

#include <gtest/gtest.h>

#include <cmath>
#include <iterator>

#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

TEST(Resolve, StandardTolerancesAreThoseOfTheTable) {
  // ISO 286-1, table 1, in micrometres.
  struct Row {
    int grade;
    double size_mm, tolerance_um;
  };
  for (const Row& r : {Row{7, 12.0, 18.0}, Row{6, 40.0, 16.0}, Row{9, 60.0, 74.0}, Row{11, 8.0, 90.0},
                       Row{8, 100.0, 54.0}, Row{12, 200.0, 460.0}, Row{7, 3.0, 10.0}, Row{5, 450.0, 27.0}}) {
    EXPECT_NEAR(1000.0 * tolerance_of_grade(r.grade, r.size_mm), r.tolerance_um, 1e-9)
        << "IT" << r.grade << " at " << r.size_mm;
    EXPECT_EQ(grade_of_tolerance(r.size_mm, 1e-3 * r.tolerance_um), r.grade) << r.size_mm;
  }
  // The table is the formula rounded: i = 0.45 cbrt(D) + 0.001 D um, IT7 is 16 i, D the geometric mean of the
  // range; above 3 mm the rounding stays below 6 %.
  const double limits[] = {3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500};
  for (std::size_t k = 1; k < std::size(limits); ++k) {
    const double d = std::sqrt(limits[k - 1] * limits[k]);
    const double it7 = 16.0 * (0.45 * std::cbrt(d) + 0.001 * d);
    EXPECT_NEAR(1000.0 * tolerance_of_grade(7, limits[k]), it7, 0.06 * it7) << limits[k];
    for (int grade = 6; grade <= 18; ++grade) {
      EXPECT_GT(tolerance_of_grade(grade, limits[k]), tolerance_of_grade(grade - 1, limits[k]));
      EXPECT_GE(tolerance_of_grade(grade, limits[k]), tolerance_of_grade(grade, limits[k - 1]));
    }
  }
  EXPECT_EQ(tolerance_of_grade(4, 10.0), 0.0);
  EXPECT_EQ(tolerance_of_grade(7, 501.0), 0.0);
  EXPECT_EQ(grade_of_tolerance(10.0, 0.001), 0);  // finer than IT5
}

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
  lf.its_fitting_type = FittingType::kShaft;
  const auto shaft = length(m, make(lf));  // 20 h7
  EXPECT_EQ(shaft->lower_mm, -0.021);
  EXPECT_EQ(shaft->upper_mm, 0.0);
  lf.deviation = -0.020;  // 20 f7
  EXPECT_NEAR(length(m, make(lf))->lower_mm, -0.041, 1e-15);
  TolerancedLengthMeasure bare;
  bare.theoretical_size = 5.0;
  EXPECT_FALSE(length(m, m.add(bare))->given);
  EXPECT_EQ(length(m, {}).error().code, "MDL-MISSING");
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
