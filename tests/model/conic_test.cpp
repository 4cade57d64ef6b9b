#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/model/features/curve_points.h"
#include "tests/model/maker.h"

// Trimmed conics: every sampled point lies on the curve, the samples run from trim 1 to trim 2 in the sense,
// and their length is the arc's. The conics stand turned and moved, so that frames count.

namespace capstan::model {
namespace {

using geometry::Vec3;

constexpr double kPi = std::numbers::pi;
constexpr double kChord = 0.001;  // mm: short of the arc by far less than 0.01 mm in all of these

struct Trims {
  std::optional<double> from, to;        ///< degrees, or the parameter of an open conic
  std::optional<Vec3> first, last;       ///< points
  std::optional<TrimmingPreference> by;  ///< which counts where both are given
};

struct Bench : Maker {
  /// Centre (7, 3, 2), x along the workpiece's y: local (x, y) is (7 - y, 3 + x, 2).
  Ref<Axis2Placement3d> where = at(7, 3, 2, 0, 1);
  [[nodiscard]] static Vec3 local(const Vec3& p) { return {p.y - 3.0, 7.0 - p.x, p.z - 2.0}; }
  [[nodiscard]] static Vec3 world(double x, double y) { return {7.0 - y, 3.0 + x, 2.0}; }

  Ref<Circle> circle(double r) {
    Circle c;
    c.position = where;
    c.radius = r;
    return m.add(c);
  }
  Ref<Ellipse> ellipse(double a, double b) {
    Ellipse e;
    e.position = where;
    e.semi_axis_1 = a;
    e.semi_axis_2 = b;
    return m.add(e);
  }
  SelectList trim(const std::optional<double>& parameter, const std::optional<Vec3>& p) {
    SelectList out;
    out.given = true;
    if (p) out.items.push_back({.ref = point(p->x, p->y, p->z), .type = {}, .real = {}, .text = {}});
    if (parameter)
      out.items.push_back({.ref = {}, .type = "PARAMETER_VALUE", .real = *parameter, .text = {}});
    return out;
  }
  Ref<TrimmedCurve> arc(AnyRef basis, const Trims& t, bool sense) {
    TrimmedCurve c;
    c.basis_curve = Ref<Curve>(basis);
    c.trim_1 = trim(t.from, t.first);
    c.trim_2 = trim(t.to, t.last);
    c.sense_agreement = sense;
    if (t.by) c.master_representation = *t.by;
    return m.add(c);
  }
  std::vector<Vec3> points(AnyRef curve) {
    auto p = curve_points(m, curve, kChord);
    EXPECT_TRUE(p) << (p ? "" : p.error().message);
    return p ? *p : std::vector<Vec3>{};
  }
};

double length_of(const std::vector<Vec3>& p) {
  double out = 0.0;
  for (std::size_t i = 1; i < p.size(); ++i) out += norm(p[i] - p[i - 1]);
  return out;
}

/// An arc of a circle of radius 5 by two angles, in degrees: what it must sweep is worked out by hand.
struct Arc {
  double from, to;
  bool sense;
  double sweep;
};

class TrimmedCircle : public ::testing::TestWithParam<Arc> {};

void expect_arc(const std::vector<Vec3>& p, const Arc& arc, double a, double b) {
  ASSERT_GE(p.size(), 3u);
  const double rad = kPi / 180.0;
  const auto on = [&](double degrees) {
    return Bench::world(a * std::cos(degrees * rad), b * std::sin(degrees * rad));
  };
  EXPECT_LT(norm(p.front() - on(arc.from)), 1e-9);
  EXPECT_LT(norm(p.back() - on(arc.to)), 1e-9);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec3 q = Bench::local(p[i]);
    EXPECT_NEAR(q.x * q.x / (a * a) + q.y * q.y / (b * b), 1.0, 1e-12);
    EXPECT_NEAR(q.z, 0.0, 1e-12);
    if (i == 0) continue;
    const Vec3 before = Bench::local(p[i - 1]);
    EXPECT_GT((before.x * q.y - before.y * q.x) * arc.sweep, 0.0) << "it turns the other way at point " << i;
  }
}

TEST_P(TrimmedCircle, ByAnglesRunsFromTheOneToTheOtherInItsSense) {
  const Arc arc = GetParam();
  Bench k;
  const auto p = k.points(k.arc(k.circle(5), {arc.from, arc.to, {}, {}, {}}, arc.sense));
  expect_arc(p, arc, 5, 5);
  EXPECT_NEAR(length_of(p), 5.0 * std::abs(arc.sweep) * kPi / 180.0, 0.01);
}

TEST_P(TrimmedCircle, ByPointsRunsFromTheOneToTheOtherInItsSense) {
  const Arc arc = GetParam();
  Bench k;
  const double rad = kPi / 180.0;
  const Vec3 first = Bench::world(5 * std::cos(arc.from * rad), 5 * std::sin(arc.from * rad));
  const Vec3 last = Bench::world(5 * std::cos(arc.to * rad), 5 * std::sin(arc.to * rad));
  const auto p = k.points(k.arc(k.circle(5), {{}, {}, first, last, {}}, arc.sense));
  expect_arc(p, arc, 5, 5);
  EXPECT_NEAR(length_of(p), 5.0 * std::abs(arc.sweep) * kPi / 180.0, 0.01);
}

TEST_P(TrimmedCircle, AnEllipseRunsAsItsCircleWould) {
  const Arc arc = GetParam();
  Bench k;
  expect_arc(k.points(k.arc(k.ellipse(8, 3), {arc.from, arc.to, {}, {}, {}}, arc.sense)), arc, 8, 3);
}

TEST_P(TrimmedCircle, InASegmentOfTheOtherSenseItRunsBackwards) {
  const Arc arc = GetParam();
  Bench k;
  CompositeCurveSegment s;
  s.parent_curve = Ref<Curve>(AnyRef(k.arc(k.circle(5), {arc.from, arc.to, {}, {}, {}}, arc.sense)));
  s.same_sense = false;
  CompositeCurve c;
  c.segments.items.push_back(k.m.add(s));
  expect_arc(k.points(k.m.add(c)), {arc.to, arc.from, !arc.sense, -arc.sweep}, 5, 5);
}

INSTANTIATE_TEST_SUITE_P(
    Angles, TrimmedCircle,
    ::testing::Values(Arc{270, 0, true, 90}, Arc{270, 360, true, 90}, Arc{0, 90, true, 90},
                      Arc{180, 90, false, -90}, Arc{0, 270, false, -90}, Arc{10, 350, false, -20},
                      Arc{10, 350, true, 340}, Arc{350, 10, true, 20}, Arc{0, 360, true, 360},
                      Arc{0, 0, false, -360}, Arc{90, 450, true, 360}, Arc{-90, 0, true, 90},
                      Arc{0, -90, false, -90}, Arc{300, 30, true, 90}, Arc{725, 15, true, 10}),
    [](const auto& i) {
      const auto n = [](double v) {
        return (v < 0 ? "m" : "") + std::to_string(static_cast<int>(std::abs(v)));
      };
      return n(i.param.from) + "to" + n(i.param.to) + (i.param.sense ? "along" : "against");
    });

TEST(TrimmedEllipse, ByPointsEndsInThem) {
  Bench k;
  // (0, -3) to (8, 0) the way of rising angles: a quarter.
  const auto p =
      k.points(k.arc(k.ellipse(8, 3), {{}, {}, Bench::world(0, -3), Bench::world(8, 0), {}}, true));
  expect_arc(p, {270, 0, true, 90}, 8, 3);
}

TEST(TrimmedEllipse, IsAsLongAsItsQuarter) {
  Bench k;
  // The perimeter of semi-axes 8 and 3 by Ramanujan's second formula, h = (5/11)^2: 36.4489 mm (to 1e-4).
  const double h = (5.0 / 11.0) * (5.0 / 11.0);
  const double perimeter = kPi * 11.0 * (1.0 + 3.0 * h / (10.0 + std::sqrt(4.0 - 3.0 * h)));
  EXPECT_NEAR(length_of(k.points(k.arc(k.ellipse(8, 3), {270, 0, {}, {}, {}}, true))), perimeter / 4, 0.01);
  EXPECT_NEAR(length_of(k.points(k.ellipse(8, 3))), perimeter, 0.02);
}

TEST(TrimmedCircleByBoth, ItsMasterRepresentationCounts) {
  Bench k;
  Trims t{0, 90, Bench::world(0, 5), Bench::world(-5, 0), TrimmingPreference::kParameter};
  expect_arc(k.points(k.arc(k.circle(5), t, true)), {0, 90, true, 90}, 5, 5);
  t.by = TrimmingPreference::kCartesian;
  expect_arc(k.points(k.arc(k.circle(5), t, true)), {90, 180, true, 90}, 5, 5);
}

// y^2 = 4 f x, as ISO 10303-42: x = f u^2, y = 2 f u.
TEST(TrimmedParabola, RunsFromTheOneToTheOther) {
  Bench k;
  Parabola c;
  c.position = k.where;
  c.focal_dist = 2;
  const auto basis = k.m.add(c);
  for (const auto& arc : {k.arc(basis, {-1, 3, {}, {}, {}}, true),
                          k.arc(basis, {{}, {}, Bench::world(2, -4), Bench::world(18, 12), {}}, true)}) {
    const auto p = k.points(arc);
    ASSERT_GE(p.size(), 3u);
    EXPECT_LT(norm(p.front() - Bench::world(2, -4)), 1e-9);
    EXPECT_LT(norm(p.back() - Bench::world(18, 12)), 1e-9);
    for (const Vec3& q : p) EXPECT_NEAR(Bench::local(q).y * Bench::local(q).y, 8 * Bench::local(q).x, 1e-9);
    // Length of 2 f sqrt(1 + u^2) du: f (u sqrt(1 + u^2) + asinh u) from -1 to 3.
    const auto s = [](double u) { return 2.0 * (u * std::sqrt(1 + u * u) + std::asinh(u)); };
    EXPECT_NEAR(length_of(p), s(3) - s(-1), 0.01);
  }
}

TEST(TrimmedHyperbola, RunsFromTheOneToTheOther) {
  Bench k;
  Hyperbola c;
  c.position = k.where;
  c.semi_axis = 4;
  c.semi_imag_axis = 3;
  const auto p = k.points(k.arc(k.m.add(c), {-1, 1.5, {}, {}, {}}, true));
  ASSERT_GE(p.size(), 3u);
  EXPECT_LT(norm(p.front() - Bench::world(4 * std::cosh(1), -3 * std::sinh(1))), 1e-9);
  EXPECT_LT(norm(p.back() - Bench::world(4 * std::cosh(1.5), 3 * std::sinh(1.5))), 1e-9);
  for (const Vec3& w : p) {
    const Vec3 q = Bench::local(w);
    EXPECT_NEAR(q.x * q.x / 16 - q.y * q.y / 9, 1.0, 1e-12);
  }
}

TEST(CompositeCurve, WhosePiecesDoNotMeetIsRefusedNotBridged) {
  Bench k;
  CompositeCurve c;
  Polyline line;
  line.points.push_back(k.point(0, 0, 2));
  line.points.push_back(k.point(7, 0, 2));
  c.segments.items.push_back(k.m.add(line));
  c.segments.items.push_back(k.arc(k.circle(5), {0, 90, {}, {}, {}}, true));  // begins at (7, 8, 2)
  const auto p = curve_points(k.m, k.m.add(c), kChord);
  ASSERT_FALSE(p);
  EXPECT_NE(p.error().message.find("gap of 8 mm"), std::string::npos) << p.error().message;
}

// A rounded square of 50 by 20 with its corners drawn as in the standard's example 2: 270 degrees to 0 first.
TEST(Shape, ACornerFrom270To0DegreesIsRound) {
  Bench k;
  const auto corner = [&](double x, double y, double from, double to) {
    Circle c;
    c.position = k.at(x, y, 0);
    c.radius = 5;
    return k.arc(k.m.add(c), {from, to, {}, {}, {}}, true);
  };
  const auto line = [&](double x0, double y0, double x1, double y1) {
    Polyline l;
    l.points.push_back(k.point(x0, y0, 0));
    l.points.push_back(k.point(x1, y1, 0));
    return k.m.add(l);
  };
  CompositeCurve c;
  for (const AnyRef part : std::initializer_list<AnyRef>{
           line(5, 0, 45, 0), corner(45, 5, 270, 0), line(50, 5, 50, 15), corner(45, 15, 0, 90),
           line(45, 20, 5, 20), corner(5, 15, 90, 180), line(0, 15, 0, 5), corner(5, 5, 180, 270)})
    c.segments.items.push_back(part);
  GeneralClosedProfile g;
  g.closed_profile_shape = Ref<BoundedCurve>(AnyRef(k.m.add(c)));
  ClosedPocket p;
  p.feature_placement = k.at(0, 0, 0);
  p.depth = k.depth(-5);
  p.bottom_condition = k.m.add(PlanarPocketBottomCondition{});
  p.feature_boundary = Ref<ClosedProfile>(AnyRef(k.m.add(g)));
  // The rectangle less four times what a corner of radius r lacks, (1 - pi / 4) r^2.
  EXPECT_NEAR(geometry::area(k.only(k.m.add(p)).area), 1000 - (4 - kPi) * 25, 0.1);
}

}  // namespace
}  // namespace capstan::model
