#pragma once

#include <gtest/gtest.h>

#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"

namespace capstan::model {

/// Makes the small nouns that features are written with.
class Maker {
 public:
  Model m;

  Ref<CartesianPoint> point(double x, double y, double z) {
    CartesianPoint p;
    p.coordinates = {{x, y, z}, true};
    return m.add(p);
  }
  Ref<Direction> direction(double x, double y, double z) {
    Direction d;
    d.direction_ratios = {{x, y, z}, true};
    return m.add(d);
  }
  Ref<Axis2Placement3d> at(double x, double y, double z, double ref_x = 1, double ref_y = 0) {
    Axis2Placement3d p;
    p.location = point(x, y, z);
    p.axis = direction(0, 0, 1);
    p.ref_direction = direction(ref_x, ref_y, 0);
    return m.add(p);
  }
  Ref<Plane> depth(double z) {
    Plane p;
    p.position = at(0, 0, z);
    return m.add(p);
  }
  Ref<TolerancedLengthMeasure> length(double v) {
    TolerancedLengthMeasure t;
    t.theoretical_size = v;
    return m.add(t);
  }
  Ref<RectangularClosedProfile> rectangle(double along_x, double along_y) {
    RectangularClosedProfile p;
    p.profile_length = length(along_x);
    p.profile_width = length(along_y);
    return m.add(p);
  }
  Ref<RoundHole> hole(double x, double y, double diameter, double depth_mm) {
    RoundHole h;
    h.its_id = "H";
    h.feature_placement = at(x, y, 0);
    h.depth = depth(-depth_mm);
    h.diameter = length(diameter);
    h.bottom_condition = m.add(FlatHoleBottom{});
    return m.add(h);
  }
  Ref<ClosedPocket> pocket(double x, double y, double along_x, double along_y, double depth_mm) {
    ClosedPocket p;
    p.its_id = "P";
    p.feature_placement = at(x, y, 0);
    p.depth = depth(-depth_mm);
    p.bottom_condition = m.add(PlanarPocketBottomCondition{});
    p.feature_boundary = rectangle(along_x, along_y);
    return m.add(p);
  }
  Ref<Boss> boss(double x, double y, double along_x, double along_y, double depth_mm) {
    Boss b;
    b.its_id = "B";
    b.feature_placement = at(x, y, 0);
    b.depth = depth(-depth_mm);
    b.its_boundary = rectangle(along_x, along_y);
    return m.add(b);
  }
  FeatureShape only(Ref<ManufacturingFeature> f) {
    auto s = shapes_of(m, f);
    EXPECT_TRUE(s) << (s ? "" : s.error().message);
    return s && s->size() == 1 ? s->front() : FeatureShape{};
  }
};

}  // namespace capstan::model
