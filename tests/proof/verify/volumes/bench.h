#pragma once

#include <numbers>
#include <string>
#include <vector>

#include "planner/proof/verify/compared/compare.h"
#include "tests/model/maker.h"

namespace capstan::verify::volumes {

using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::FeatureShape;
using model::Ref;

inline constexpr double kDeg = std::numbers::pi / 180.0;

/// Features in a raw piece of 200 x 150 x 50 below z = 0, as both readings have them.
struct Bench : model::Maker {
  geometry::Box3 raw{{0, 0, -50}, {200, 150, 0}};

  std::vector<FeatureShape> planner(AnyRef f) {
    auto s = model::shapes_of(m, Ref<model::ManufacturingFeature>(f));
    EXPECT_TRUE(s) << (s ? "" : s.error().message);
    return s ? *std::move(s) : std::vector<FeatureShape>{};
  }
  Reading own(AnyRef f) { return read(source_of(m, raw), f); }
  /// What the comparison says of a feature as both read it: nothing.
  std::string agree(AnyRef f) {
    const Reading r = own(f);
    if (!r.unread.empty()) return "unread: " + r.unread;
    const auto d = disagreement(r, planner(f), raw);
    return d ? to_text(*d) : "";
  }
  static std::string to_text(const Disagreement& d) {
    return d.what + " at " + std::to_string(d.at.x) + " " + std::to_string(d.at.y) + " " +
           std::to_string(d.at.z) + (d.removed ? " removed by the file" : " left by the file") + "; own " +
           d.own + "; planner's " + d.theirs;
  }
  Ref<model::CompoundFeature> compound(Ref<model::Axis2Placement3d> where, const std::vector<AnyRef>& list) {
    model::CompoundFeature c;
    c.feature_placement = where;
    for (const AnyRef e : list) c.elements.items.push_back(e);
    return m.add(c);
  }
  Ref<model::Circle> circle(double x, double y, double radius) {
    model::Circle c;
    c.position = at(x, y, 0);
    c.radius = radius;
    return m.add(c);
  }
  /// The arc of a circle from one point to another, along its sense or against it.
  Ref<model::TrimmedCurve> arc(double x, double y, double radius, Vec2 from, Vec2 to, bool along) {
    model::TrimmedCurve t;
    t.basis_curve = circle(x, y, radius);
    t.trim_1.items.push_back({.ref = point(from.x, from.y, 0), .type = {}, .real = {}, .text = {}});
    t.trim_2.items.push_back({.ref = point(to.x, to.y, 0), .type = {}, .real = {}, .text = {}});
    t.sense_agreement = along;
    t.master_representation = model::TrimmingPreference::kCartesian;
    return m.add(t);
  }
  Ref<model::Polyline> line(const std::vector<Vec2>& points) {
    model::Polyline p;
    for (const Vec2 q : points) p.points.push_back(point(q.x, q.y, 0));
    return m.add(p);
  }
  Ref<model::CompositeCurve> chain(const std::vector<AnyRef>& parts) {
    model::CompositeCurve c;
    for (const AnyRef p : parts) {
      model::CompositeCurveSegment s;
      s.same_sense = true;
      s.parent_curve = Ref<model::Curve>(p);
      c.segments.push_back(m.add(s));
    }
    return m.add(c);
  }
  /// A pocket with a drawn boundary, 10 deep, at (100, 75).
  Ref<model::ClosedPocket> drawn_pocket(AnyRef curve) {
    model::GeneralClosedProfile g;
    g.closed_profile_shape = Ref<model::BoundedCurve>(curve);
    const auto p = pocket(100, 75, 10, 10, 10);
    m.at<model::ClosedPocket>(p).feature_boundary = m.add(g);
    return p;
  }
  /// A rectangle of 40 x 30 whose right end is a half circle of radius 15 about (20, 0).
  Ref<model::ClosedPocket> with_round_end(bool bulging) {
    return drawn_pocket(chain(
        {line({{20, 15}, {-20, 15}, {-20, -15}, {20, -15}}), arc(20, 0, 15, {20, -15}, {20, 15}, bulging)}));
  }
};

}  // namespace capstan::verify::volumes
