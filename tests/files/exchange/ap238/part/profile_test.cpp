#include <functional>

#include "tests/files/exchange/ap238/part/feature_support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;

std::string measure(const std::string& name, const std::string& mm) {
  return "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(" + mm +
         "),#)REPRESENTATION_ITEM('" + name + "'));";
}
std::string angle(const std::string& name, const std::string& rad) {
  return "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(" + rad +
         "),#)PLANE_ANGLE_MEASURE_WITH_UNIT()REPRESENTATION_ITEM('" + name + "'));";
}

struct Case {
  std::string name;
  std::function<AnyRef(FeatureBench&)> make;
  std::vector<std::string> written;
};

void hold(const Case& c, const FeatureBench& b) {
  SCOPED_TRACE(c.name);
  const Shapes s(b.plan);
  for (const auto& line : c.written) {
    EXPECT_TRUE(s.has(line)) << line;
  }
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(OpenProfiles, AreWrittenByTheirRulesAndComeBackEqual) {
  const std::vector<Case> cases = {
      {"square u",
       [](FeatureBench& b) {
         model::SquareUProfile p;
         p.width = b.length(10, 0.1, 0.1);
         p.first_radius = b.length(1);
         p.first_angle = 1.5;
         p.second_radius = b.length(2);
         p.second_angle = 1.25;
         p.depth = b.length(12);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"SQUARE_U_PROFILE('',$,#,.F.);", measure("first radius", "1."), measure("second radius", "2."),
        angle("first angle", "1.5"), angle("second angle", "1.25"), measure("depth", "12.")}},
      {"square u whose sides are left open",
       [](FeatureBench& b) {
         model::SquareUProfile p;
         p.width = b.length(10);
         return AnyRef(b.m.add(std::move(p)));
       },
       {measure("width", "10."), angle("first angle", "1.5707963267948968"),
        angle("second angle", "1.5707963267948968")}},
      {"rounded u",
       [](FeatureBench& b) {
         model::RoundedUProfile p;
         p.width = b.length(8);
         p.depth = b.length(12);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"ROUNDED_U_PROFILE('',$,#,.F.);", measure("width", "8."), measure("depth", "12.")}},
      {"tee",
       [](FeatureBench& b) {
         model::TeeProfile p;
         p.first_angle = 1.5;
         p.second_angle = 1.25;
         p.cross_bar_width = b.length(18);
         p.cross_bar_depth = b.length(5);
         p.radius = b.length(0.5);
         p.width = b.length(10);
         p.first_offset = b.length(4);
         p.second_offset = b.length(4.5);
         p.depth = b.length(12);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"TEE_PROFILE('',$,#,.F.);", measure("cross bar width", "18."), measure("cross bar depth", "5."),
        measure("radius", "0.5"), measure("width", "10."), measure("first offset", "4."),
        measure("second offset", "4.5"), measure("depth", "12."), angle("first angle", "1.5")}},
      {"vee",
       [](FeatureBench& b) {
         model::VeeProfile p;
         p.profile_radius = b.length(0.5);
         p.profile_angle = 1.5;
         p.tilt_angle = 0.75;
         p.first_length = b.length(9);
         p.second_length = b.length(7);
         p.placement = b.placement(0, 1, 0);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"VEE_PROFILE('',$,#,.F.);", measure("profile radius", "0.5"), angle("profile angle", "1.5"),
        angle("tilt angle", "0.75"), measure("first length", "9."), measure("second length", "7.")}},
      {"partial circular",
       [](FeatureBench& b) {
         model::PartialCircularProfile p;
         p.radius = b.length(6);
         p.sweep_angle = 3;
         return AnyRef(b.m.add(std::move(p)));
       },
       {"PARTIAL_CIRCULAR_PROFILE('',$,#,.F.);", measure("radius", "6."), angle("sweep angle", "3.")}},
      {"general, with more drawn beside it",
       [](FeatureBench& b) {
         model::GeneralProfile p;
         p.its_profile = FeatureBench::as<model::BoundedCurve>(b.polyline({{-5, 0}, {0, -12}, {5, 0}}));
         p.path_shape_items.given = true;
         p.path_shape_items.items = {b.polyline({{5, 0}, {9, 0}}), b.point(9, 0, 0)};
         return AnyRef(b.m.add(std::move(p)));
       },
       {"OPEN_PATH_PROFILE('',$,#,.F.);", "PATH_SHAPE_REPRESENTATION('',(#,#,#),#);"}},
  };
  for (const Case& c : cases) {
    FeatureBench b;
    auto f = b.basic<model::Slot>("S");
    f.course_of_travel = FeatureBench::as<model::TravelPath>(b.line(100, 0, 1, 0));
    f.swept_shape = Ref<model::OpenProfile>(c.make(b));
    f.end_conditions.given = true;
    f.end_conditions.items = {b.m.add(model::OpenSlotEndType{}), b.m.add(model::RadiusedSlotEndType{})};
    b.m.add(std::move(f));
    hold(c, b);
  }
}

TEST(ClosedProfiles, AreWrittenByTheirRulesAndComeBackEqual) {
  const auto ngon = [](bool around) {
    return [around](FeatureBench& b) {
      model::NgonClosedProfile p;
      p.diameter = b.length(30);
      p.number_of_sides = 6;
      p.circumscribed = around;
      p.corner_radius = b.length(2);
      return AnyRef(b.m.add(std::move(p)));
    };
  };
  const std::vector<Case> cases = {
      {"rectangle",
       [](FeatureBench& b) {
         model::RectangularClosedProfile p;
         p.profile_width = b.length(50, 0.1, 0.2);
         p.profile_length = b.length(80);
         p.corner_radius = b.length(5);
         p.placement = b.placement(3, 4, 0);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"RECTANGULAR_CLOSED_PROFILE('',$,#,.F.);", measure("length", "80."), measure("corner radius", "5.")}},
      {"circle",
       [](FeatureBench& b) {
         model::CircularClosedProfile p;
         p.diameter = b.length(40);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"CIRCULAR_CLOSED_PROFILE('',$,#,.F.);", measure("diameter", "40.")}},
      {"polygon around the circle",
       ngon(true),
       {measure("diameter across flats", "30."), measure("corner radius", "2."),
        "NGON_CLOSED_PROFILE('',$,#,.F.);",
        "MEASURE_REPRESENTATION_ITEM('number of sides',COUNT_MEASURE(6.),#);"}},
      {"polygon in the circle", ngon(false), {measure("circumscribed diameter", "30.")}},
      {"general",
       [](FeatureBench& b) {
         model::GeneralClosedProfile p;
         p.closed_profile_shape =
             FeatureBench::as<model::BoundedCurve>(b.polyline({{0, 0}, {50, 0}, {50, 80}, {0, 0}}));
         p.path_shape_items.given = true;
         p.path_shape_items.items = {b.polyline({{1, 1}, {2, 2}})};
         return AnyRef(b.m.add(std::move(p)));
       },
       {"CLOSED_PATH_PROFILE('',$,#,.F.);", "PATH_SHAPE_REPRESENTATION('',(#,#),#);"}},
  };
  for (const Case& c : cases) {
    FeatureBench b;
    auto f = b.basic<model::ClosedPocket>("P");
    f.its_boss.given = true;
    f.bottom_condition =
        FeatureBench::as<model::PocketBottomCondition>(b.m.add(model::PlanarPocketBottomCondition{}));
    f.feature_boundary = Ref<model::ClosedProfile>(c.make(b));
    b.m.add(std::move(f));
    hold(c, b);
  }
}

TEST(TravelPaths, AreWrittenByTheirKindAndComeBackEqual) {
  const std::vector<Case> cases = {
      {"linear",
       [](FeatureBench& b) { return AnyRef(b.line(100, 0.6, 0.8, 0)); },
       {"PATH_FEATURE_COMPONENT('','linear',#,.F.);", "DIRECTION_SHAPE_REPRESENTATION('',(#),#);"}},
      {"linear, placed",
       [](FeatureBench& b) {
         const auto p = b.line(100, 1, 0, 0);
         b.m.at<model::LinearPath>(p).placement = b.placement(7, 0, 0);
         return AnyRef(p);
       },
       {}},
      {"complete circle",
       [](FeatureBench& b) {
         model::CompleteCircularPath p;
         p.radius = b.length(40);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"PATH_FEATURE_COMPONENT('','complete circular',#,.F.);", measure("radius", "40.")}},
      {"part of a circle",
       [](FeatureBench& b) {
         model::PartialCircularPath p;
         p.radius = b.length(40);
         p.sweep_angle = 2;
         p.placement = b.placement(1, 2, 0);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"PATH_FEATURE_COMPONENT('','partial circular',#,.F.);", angle("sweep angle", "2.")}},
      {"general",
       [](FeatureBench& b) {
         model::GeneralPath p;
         p.swept_path = FeatureBench::as<model::BoundedCurve>(b.polyline({{0, 0}, {30, 40}, {60, 40}}));
         return AnyRef(b.m.add(std::move(p)));
       },
       {"PATH_FEATURE_COMPONENT('','complex',#,.F.);", "PATH_SHAPE_REPRESENTATION('sweep path',(#),#);",
        "POLYLINE('profile shape',(#,#,#));"}},
  };
  for (const Case& c : cases) {
    FeatureBench b;
    auto f = b.basic<model::Slot>("S");
    f.course_of_travel = Ref<model::TravelPath>(c.make(b));
    model::RoundedUProfile p;
    p.width = b.length(8);
    f.swept_shape = FeatureBench::as<model::OpenProfile>(b.m.add(std::move(p)));
    f.end_conditions.given = true;
    f.end_conditions.items = {b.m.add(model::LoopSlotEndType{})};
    b.m.add(std::move(f));
    hold(c, b);
  }
}

TEST(SlotEnds, AreToldApartByName) {
  FeatureBench b;
  auto f = b.basic<model::Slot>("S");
  f.course_of_travel = FeatureBench::as<model::TravelPath>(b.line(100, 0, 1, 0));
  model::RoundedUProfile p;
  p.width = b.length(8);
  f.swept_shape = FeatureBench::as<model::OpenProfile>(b.m.add(std::move(p)));
  model::FlatSlotEndType flat;
  flat.corner_radius1 = b.length(1);
  flat.corner_radius2 = b.length(2);
  model::WoodruffSlotEndType woodruff;
  woodruff.radius = b.length(11);
  f.end_conditions.given = true;
  f.end_conditions.items = {b.m.add(std::move(flat)), b.m.add(std::move(woodruff))};
  b.m.add(std::move(f));
  const Shapes s(b.plan);
  EXPECT_TRUE(s.has("FEATURE_COMPONENT_RELATIONSHIP('course of travel start','slot end usage',#,#);"));
  EXPECT_TRUE(s.has("FEATURE_COMPONENT_RELATIONSHIP('course of travel end','slot end usage',#,#);"));
  EXPECT_TRUE(s.has("SLOT_END('','flat',#,.F.);"));
  EXPECT_TRUE(s.has("SLOT_END('','woodruff',#,.F.);"));
  EXPECT_TRUE(s.has(measure("first radius", "1.")));
  EXPECT_TRUE(s.has(measure("second radius", "2.")));
  EXPECT_TRUE(s.has(measure("radius", "11.")));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(Bottoms, OfHolesAreWrittenByTheirKindAndComeBackEqual) {
  const std::vector<Case> cases = {
      {"through",
       [](FeatureBench& b) { return AnyRef(b.m.add(model::ThroughBottomCondition{})); },
       {"HOLE_BOTTOM('','through',#,.F.);"}},
      {"flat",
       [](FeatureBench& b) { return AnyRef(b.m.add(model::FlatHoleBottom{})); },
       {"HOLE_BOTTOM('','flat',#,.F.);"}},
      {"flat with radius",
       [](FeatureBench& b) {
         model::FlatWithRadiusHoleBottom h;
         h.corner_radius = b.length(1.5);
         return AnyRef(b.m.add(std::move(h)));
       },
       {"HOLE_BOTTOM('','flat with radius',#,.F.);", measure("corner radius", "1.5")}},
      {"spherical",
       [](FeatureBench& b) {
         model::SphericalHoleBottom h;
         h.radius = b.length(5);
         return AnyRef(b.m.add(std::move(h)));
       },
       {"HOLE_BOTTOM('','spherical',#,.F.);", measure("radius", "5.")}},
      {"conical",
       [](FeatureBench& b) {
         model::ConicalHoleBottom h;
         h.tip_angle = 2.0625;
         h.tip_radius = b.length(0.5);
         return AnyRef(b.m.add(std::move(h)));
       },
       {"HOLE_BOTTOM('','conical',#,.F.);", angle("tip angle", "2.0625"), measure("tip radius", "0.5")}},
  };
  for (const Case& c : cases) {
    FeatureBench b;
    auto f = b.basic<model::RoundHole>("H");
    f.diameter = b.length(10);
    f.bottom_condition = Ref<model::HoleBottomCondition>(c.make(b));
    b.m.add(std::move(f));
    hold(c, b);
    EXPECT_TRUE(
        Shapes(b.plan).has("FEATURE_COMPONENT_RELATIONSHIP('hole depth end','hole bottom usage',#,#);"));
  }
}

TEST(Bottoms, OfPocketsAreWrittenByTheirKindAndComeBackEqual) {
  const std::vector<Case> cases = {
      {"through",
       [](FeatureBench& b) { return AnyRef(b.m.add(model::ThroughPocketBottomCondition{})); },
       {"POCKET_BOTTOM('','through',#,.F.);"}},
      {"planar",
       [](FeatureBench& b) {
         model::PlanarPocketBottomCondition p;
         p.floor_location = b.point(0, 0, -12);
         p.floor_normal = b.direction(0, 0, 1);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"POCKET_BOTTOM('','planar',#,.F.);", "LOCATION_SHAPE_REPRESENTATION('floor location',(#),#);",
        "DIRECTION_SHAPE_REPRESENTATION('floor normal',(#),#);"}},
      {"radiused",
       [](FeatureBench& b) {
         model::RadiusedPocketBottomCondition p;
         p.floor_radius_center = b.point(0, 0, 100);
         p.floor_radius = b.length(112);
         return AnyRef(b.m.add(std::move(p)));
       },
       {"POCKET_BOTTOM('','complex',#,.F.);", "LOCATION_SHAPE_REPRESENTATION('floor radius center',(#),#);",
        measure("radius", "112.")}},
      {"general",
       [](FeatureBench& b) {
         auto r = b.basic<model::RegionProjection>("R");
         r.feature_placement = b.placement(0, 0, 0);
         r.proj_curve =
             FeatureBench::as<model::BoundedCurve>(b.polyline({{0, 0}, {10, 0}, {10, 10}, {0, 0}}));
         r.proj_dir = b.direction(0, 0, -1);
         r.depth = b.length(3);
         model::GeneralPocketBottomCondition p;
         p.shape = FeatureBench::as<model::Region>(b.m.add(std::move(r)));
         return AnyRef(b.m.add(std::move(p)));
       },
       {"POCKET_BOTTOM('','complex',#,.F.);", "FEATURE_COMPONENT_RELATIONSHIP('','floor shape',#,#);",
        "INSTANCED_FEATURE('','region projection','R','region projection',#,.T.);",
        "PATH_SHAPE_REPRESENTATION('projection curve',(#),#);",
        "DIRECTION_SHAPE_REPRESENTATION('projection direction',(#),#);", measure("depth", "3.")}},
  };
  for (const Case& c : cases) {
    FeatureBench b;
    auto f = b.basic<model::ClosedPocket>("P");
    f.its_boss.given = true;
    f.bottom_condition = Ref<model::PocketBottomCondition>(c.make(b));
    model::CircularClosedProfile p;
    p.diameter = b.length(40);
    f.feature_boundary = FeatureBench::as<model::ClosedProfile>(b.m.add(std::move(p)));
    b.m.add(std::move(f));
    hold(c, b);
  }
}

TEST(Tapers, OfHolesAreByDiameterOrByAngle) {
  const std::vector<Case> cases = {
      {"diameter",
       [](FeatureBench& b) {
         model::DiameterTaper t;
         t.final_diameter = b.length(8);
         return AnyRef(b.m.add(std::move(t)));
       },
       {"TAPER('','diameter taper',#,.F.);", measure("final diameter", "8.")}},
      {"angle",
       [](FeatureBench& b) {
         model::AngleTaper t;
         t.angle = 0.125;
         return AnyRef(b.m.add(std::move(t)));
       },
       {"TAPER('','angle taper',#,.F.);", angle("taper angle", "0.125"),
        "FEATURE_COMPONENT_RELATIONSHIP('','taper usage',#,#);"}},
  };
  for (const Case& c : cases) {
    FeatureBench b;
    auto f = b.basic<model::RoundHole>("H");
    f.diameter = b.length(10);
    f.bottom_condition = FeatureBench::as<model::HoleBottomCondition>(b.m.add(model::FlatHoleBottom{}));
    f.change_in_diameter = decltype(f.change_in_diameter)(c.make(b));
    b.m.add(std::move(f));
    hold(c, b);
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238
