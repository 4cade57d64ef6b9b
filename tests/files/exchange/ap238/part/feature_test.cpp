#include <functional>

#include "tests/files/exchange/ap238/part/feature_support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;

struct Case {
  std::string name;
  std::function<void(FeatureBench&)> make;
  std::vector<std::string> written;
};

std::string root(const std::string& entities, const std::string& description = "$") {
  return "(CHARACTERIZED_OBJECT(''," + description + ")" + entities + ");";
}

Ref<model::ClosedProfile> circle(FeatureBench& b, double diameter) {
  model::CircularClosedProfile p;
  p.diameter = b.length(diameter);
  return b.as<model::ClosedProfile>(b.m.add(std::move(p)));
}

Ref<model::ClosedProfile> rectangle(FeatureBench& b, double length, double width) {
  model::RectangularClosedProfile p;
  p.profile_length = b.length(length);
  p.profile_width = b.length(width);
  return b.as<model::ClosedProfile>(b.m.add(std::move(p)));
}

Ref<model::OpenProfile> square(FeatureBench& b) {
  model::SquareUProfile p;
  p.width = b.length(10);
  p.first_angle = p.second_angle = 1.5;
  return b.as<model::OpenProfile>(b.m.add(std::move(p)));
}

Ref<model::Boss> boss(FeatureBench& b, const std::string& id, Ref<model::ClosedProfile> boundary) {
  auto f = b.basic<model::Boss>(id);
  f.its_boundary = boundary;
  f.slope = 0.0625;
  f.height = b.as<model::TravelPath>(b.line(12, 0, 0, -1));
  f.top_fillet_radius = b.length(1);
  f.fillet_radius = b.length(2);
  return b.m.add(std::move(f));
}

template <class T>
void thread(FeatureBench& b, T f) {
  auto hole = b.basic<model::RoundHole>("H");
  hole.diameter = b.length(6.8);
  hole.bottom_condition = b.as<model::HoleBottomCondition>(b.m.add(model::ThroughBottomCondition{}));
  model::PartialAreaDefinition area;
  area.effective_length = 10;
  area.maximum_length = 11;
  area.placement = b.placement(0, 0, -1);
  f.partial_profile = b.m.add(std::move(area));
  f.applied_shape.given = true;
  f.applied_shape.items = {b.m.add(std::move(hole))};
  f.inner_or_outer_thread = true;
  f.qualifier = b.text("qualifier", "class 2");
  f.fit_class = b.text("fit class", "6H");
  f.fit_class_2 = b.text("fit class 2", "6G");
  f.form = b.text("FORM OF THREAD", "M");
  f.major_diameter = 8;
  f.number_of_threads = b.number("number of threads", 0.8, "1/mm");
  f.nominal_size = b.number("nominal size", 8, "mm");
  f.thread_hand = b.text("hand", "right");
  b.m.add(std::move(f));
}

const std::vector<Case>& cases() {
  static const std::vector<Case> kCases = {
      {"planar face",
       [](FeatureBench& b) {
         auto f = b.basic<model::PlanarFace>("F");
         f.course_of_travel = b.line(120, 0, 1, 0);
         model::LinearProfile p;
         p.profile_length = b.number("profile length", 100, "mm");
         f.removal_boundary = b.m.add(std::move(p));
         f.face_boundary = rectangle(b, 120, 100);
         f.its_boss.given = true;
         f.its_boss.items = {boss(b, "B1", circle(b, 20)), boss(b, "B2", circle(b, 30))};
         f.removal_depth = b.length(12, 0.1, 0.1);
         f.removal_direction = b.direction(0, 0, 1);
         b.m.add(std::move(f));
       },
       {root("FEATURE_DEFINITION()FLAT_FACE()INSTANCED_FEATURE()SHAPE_ASPECT('F',$,#,.T.)"),
        "SHAPE_DEFINING_RELATIONSHIP('course of travel','path feature component usage',#,#);",
        "SHAPE_DEFINING_RELATIONSHIP('removal boundary','profile usage',#,#);",
        "SHAPE_ASPECT('','enclosed boundary occurrence',#,.F.);",
        "COMPOSITE_SHAPE_ASPECT('uncut volume',$,#,.F.);",
        "DIRECTION_SHAPE_REPRESENTATION('removal direction',(#),#);",
        "SHAPE_REPRESENTATION('maximum feature limit',(#),#);"}},
      {"face without a direction of removal, which the schema demands",
       [](FeatureBench& b) {
         auto f = b.basic<model::PlanarFace>("F");
         f.course_of_travel = b.line(120, 0, 1, 0);
         f.its_boss.given = true;
         b.m.add(std::move(f));
       },
       {"DIRECTION_SHAPE_REPRESENTATION('removal direction',(#),#);"}},
      {"closed pocket",
       [](FeatureBench& b) {
         auto f = b.basic<model::ClosedPocket>("P");
         f.its_boss.given = true;
         f.its_boss.items = {boss(b, "B", rectangle(b, 10, 20))};
         f.slope = 0.125;
         f.bottom_condition =
             b.as<model::PocketBottomCondition>(b.m.add(model::PlanarPocketBottomCondition{}));
         f.planar_radius = b.length(1, 0.1, 0.1);
         f.orthogonal_radius = b.length(10);
         f.feature_boundary = rectangle(b, 80, 50);
         b.m.add(std::move(f));
       },
       {root("FEATURE_DEFINITION()INSTANCED_FEATURE()POCKET()SHAPE_ASPECT('P',$,#,.T.)", "'complex'"),
        "SHAPE_ASPECT('','boundary occurrence',#,.F.);", "SHAPE_ASPECT('','pocket depth occurrence',#,.F.);",
        "SHAPE_DEFINING_RELATIONSHIP('pocket depth','path feature component usage',#,#);",
        "FEATURE_COMPONENT_RELATIONSHIP('pocket depth end','pocket bottom usage',#,#);",
        "SHAPE_ASPECT('','change in boundary occurrence',#,.F.);", "TAPER('','angle taper',#,.F.);",
        "SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#,#,#),#);"}},
      {"pocket with its own course of travel",
       [](FeatureBench& b) {
         auto f = b.basic<model::ClosedPocket>("P");
         f.its_boss.given = true;
         f.bottom_condition =
             b.as<model::PocketBottomCondition>(b.m.add(model::ThroughPocketBottomCondition{}));
         f.feature_boundary = circle(b, 50);
         f.course_of_travel = b.as<model::TravelPath>(b.line(12, 0, 0, -1));
         f.bottom_at_path_end = true;
         b.m.add(std::move(f));
       },
       {"FEATURE_COMPONENT_RELATIONSHIP('pocket depth end','pocket bottom usage',#,#);"}},
      {"open pocket",
       [](FeatureBench& b) {
         auto f = b.basic<model::OpenPocket>("P");
         f.its_boss.given = true;
         f.bottom_condition =
             b.as<model::PocketBottomCondition>(b.m.add(model::PlanarPocketBottomCondition{}));
         f.open_boundary = square(b);
         model::GeneralProfile wall;
         wall.its_profile = b.as<model::BoundedCurve>(b.polyline({{0, 0}, {10, 20}}));
         f.wall_boundary = b.as<model::OpenProfile>(b.m.add(std::move(wall)));
         b.m.add(std::move(f));
       },
       {"SHAPE_ASPECT('','boundary occurrence',#,.F.);",
        "SHAPE_ASPECT('','wall boundary occurrence',#,.F.);"}},
      {"step",
       [](FeatureBench& b) {
         auto f = b.basic<model::Step>("T");
         f.open_boundary = b.line(100, 1, 0, 0);
         model::VeeProfile p;
         p.profile_radius = b.length(0);
         p.profile_angle = 1.5;
         p.tilt_angle = 0;
         f.wall_boundary = b.m.add(std::move(p));
         f.its_boss.given = true;
         b.m.add(std::move(f));
       },
       {root("FEATURE_DEFINITION()INSTANCED_FEATURE()SHAPE_ASPECT('T',$,#,.T.)STEP()"),
        "SHAPE_ASPECT('','removal boundary occurrence',#,.F.);"}},
      {"general outside profile",
       [](FeatureBench& b) {
         auto f = b.basic<model::GeneralOutsideProfile>("O");
         f.profile_swept_shape = b.line(12, 0, 0, -1);
         f.feature_boundary = b.as<model::Profile>(rectangle(b, 80, 50));
         b.m.add(std::move(f));
       },
       {root("FEATURE_DEFINITION()INSTANCED_FEATURE()OUTSIDE_PROFILE()SHAPE_ASPECT('O',$,#,.T.)"),
        "SHAPE_DEFINING_RELATIONSHIP('profile swept shape','path feature component usage',#,#);"}},
      {"general shape profile on a planar floor",
       [](FeatureBench& b) {
         auto f = b.basic<model::GeneralShapeProfile>("O");
         f.profile_swept_shape = b.line(12, 0, 0, -1);
         model::PlanarProfileFloor floor;
         floor.floor_radius = b.number("radius", 2, "mm");
         floor.start_or_end = false;
         floor.floor = Ref<model::Plane>(AnyRef(b.plane(-12)));
         f.floor_condition = decltype(f.floor_condition)(AnyRef(b.m.add(std::move(floor))));
         f.removal_direction = b.direction(0, 1, 0);
         f.profile_boundary = b.as<model::Profile>(rectangle(b, 80, 50));
         b.m.add(std::move(f));
       },
       {"SHAPE_ASPECT('','complex boundary occurrence',#,.F.);", "PROFILE_FLOOR('','planar',#,.F.);",
        "DESCRIPTIVE_REPRESENTATION_ITEM('shape profile floor orientation','shape profile end');",
        "PLANAR_SHAPE_REPRESENTATION('floor',(#),#);"}},
      {"partial circular shape profile",
       [](FeatureBench& b) {
         auto f = b.basic<model::PartialCircularShapeProfile>("O");
         f.profile_swept_shape = b.line(12, 0, 0, -1);
         f.floor_condition = decltype(f.floor_condition)(AnyRef(b.m.add(model::ThroughProfileFloor{})));
         model::PartialCircularProfile p;
         p.radius = b.length(30);
         p.sweep_angle = 2;
         f.open_boundary = b.m.add(std::move(p));
         b.m.add(std::move(f));
       },
       {"SHAPE_ASPECT('','partial circular boundary occurrence',#,.F.);",
        "PROFILE_FLOOR('','through',#,.F.);",
        "FEATURE_COMPONENT_RELATIONSHIP('','profile floor usage',#,#);"}},
      {"circular closed shape profile",
       [](FeatureBench& b) {
         auto f = b.basic<model::CircularClosedShapeProfile>("O");
         f.profile_swept_shape = b.line(12, 0, 0, -1);
         f.closed_boundary = Ref<model::CircularClosedProfile>(AnyRef(circle(b, 60)));
         b.m.add(std::move(f));
       },
       {"SHAPE_ASPECT('','closed circular boundary occurrence',#,.F.);"}},
      {"rectangular open shape profile",
       [](FeatureBench& b) {
         auto f = b.basic<model::RectangularOpenShapeProfile>("O");
         f.profile_swept_shape = b.line(12, 0, 0, -1);
         f.open_boundary = Ref<model::SquareUProfile>(AnyRef(square(b)));
         b.m.add(std::move(f));
       },
       {"SHAPE_ASPECT('','open rectangular boundary occurrence',#,.F.);"}},
      {"rectangular closed shape profile",
       [](FeatureBench& b) {
         auto f = b.basic<model::RectangularClosedShapeProfile>("O");
         f.profile_swept_shape = b.line(12, 0, 0, -1);
         f.closed_boundary = Ref<model::RectangularClosedProfile>(AnyRef(rectangle(b, 60, 40)));
         b.m.add(std::move(f));
       },
       {"SHAPE_ASPECT('','closed rectangular boundary occurrence',#,.F.);"}},
      {"round hole",
       [](FeatureBench& b) {
         auto f = b.basic<model::RoundHole>("H");
         f.diameter = b.length(22, 0.02, 0.01);
         f.bottom_condition = b.as<model::HoleBottomCondition>(b.m.add(model::ThroughBottomCondition{}));
         b.m.add(std::move(f));
       },
       {root("FEATURE_DEFINITION()INSTANCED_FEATURE()ROUND_HOLE()SHAPE_ASPECT('H',$,#,.T.)"),
        "SHAPE_DEFINING_RELATIONSHIP('diameter','profile usage',#,#);",
        "SHAPE_DEFINING_RELATIONSHIP('hole depth','path feature component usage',#,#);"}},
      {"toolpath feature",
       [](FeatureBench& b) { b.m.add(b.basic<model::ToolpathFeature>("TP")); },
       {"INSTANCED_FEATURE('','toolpath','TP','toolpath',#,.T.);"}},
      {"boss of a polygon",
       [](FeatureBench& b) {
         model::NgonClosedProfile p;
         p.diameter = b.length(30);
         p.number_of_sides = 6;
         p.circumscribed = true;
         boss(b, "B", b.as<model::ClosedProfile>(b.m.add(std::move(p))));
       },
       {root("BOSS()FEATURE_DEFINITION()INSTANCED_FEATURE()SHAPE_ASPECT('B',$,#,.T.)", "'complex'"),
        "SHAPE_DEFINING_RELATIONSHIP('boss height','path feature component usage',#,#);",
        "FEATURE_COMPONENT_RELATIONSHIP('boss height start','boss top usage',#,#);",
        "BOSS_TOP('','planar',#,.F.);"}},
      {"spherical cap",
       [](FeatureBench& b) {
         auto f = b.basic<model::SphericalCap>("S");
         f.internal_angle = b.number("INTERNAL ANGLE", 90, "deg");
         f.radius = b.number("radius", 25, "mm");
         b.m.add(std::move(f));
       },
       {"TYPE_QUALIFIER('INTERNAL ANGLE [deg]');",
        "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(1.5707963267948966),#)"
        "PLANE_ANGLE_MEASURE_WITH_UNIT()QUALIFIED_REPRESENTATION_ITEM((#))REPRESENTATION_ITEM('internal "
        "angle'));"}},
      {"rounded end",
       [](FeatureBench& b) {
         auto f = b.basic<model::RoundedEnd>("E");
         f.course_of_travel = b.line(30, 0, 1, 0);
         model::PartialCircularProfile p;
         p.radius = b.length(10);
         p.sweep_angle = 3;
         f.partial_circular_boundary = b.m.add(std::move(p));
         b.m.add(std::move(f));
       },
       {root("FEATURE_DEFINITION()INSTANCED_FEATURE()ROUNDED_END()SHAPE_ASPECT('E',$,#,.T.)")}},
      {"defined thread",
       [](FeatureBench& b) {
         auto f = b.basic<model::DefinedThread>("M8");
         f.pitch_diameter = 7.1875;
         f.minor_diameter = 6.625;
         f.crest = 0.125;
         thread(b, std::move(f));
       },
       {root("FEATURE_DEFINITION()INSTANCED_FEATURE()SHAPE_ASPECT('M8',$,#,.T.)THREAD()"),
        "SHAPE_DEFINING_RELATIONSHIP('','applied area usage',#,#);",
        "SHAPE_DEFINING_RELATIONSHIP('','applied shape',#,#);", "APPLIED_AREA('',$,#,.F.);",
        "DESCRIPTIVE_REPRESENTATION_ITEM('thread side','internal');",
        "DESCRIPTIVE_REPRESENTATION_ITEM('fit class 2','6G');", "TYPE_QUALIFIER('FORM OF THREAD');",
        "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(RATIO_MEASURE(0.8),#)RATIO_MEASURE_WITH_UNIT()"
        "REPRESENTATION_ITEM('number of threads'));"}},
      {"catalogue thread",
       [](FeatureBench& b) {
         auto f = b.basic<model::CatalogueThread>("M8");
         model::SpecificationUsageConstraint c;
         c.element = "size";
         c.class_id = "M8";
         model::Specification s;
         s.constraint.given = true;
         s.constraint.items = {b.m.add(std::move(c))};
         s.specification_id = "ISO 261";
         s.specification_description = "metric threads";
         s.specification_class = "coarse";
         f.documentation = b.m.add(std::move(s));
         thread(b, std::move(f));
       },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('removal direction','internal');",
        "EXTERNAL_SOURCE(IDENTIFIER('external feature specification'));",
        "DOCUMENT('ISO 261','coarse','metric threads',$);", "DOCUMENT_USAGE_CONSTRAINT(#,'size','M8');"}},
      {"chamfer by an angle",
       [](FeatureBench& b) {
         auto f = b.basic<model::Chamfer>("C");
         f.first_feature = b.m.add(b.basic<model::ToolpathFeature>("A"));
         f.second_feature = b.m.add(b.basic<model::ToolpathFeature>("B"));
         f.first_offset_amount = b.length(1.5, 0.1, 0.1);
         f.angle_to_plane = 0.75;
         b.m.add(std::move(f));
       },
       {"CHAMFER('C',$,#,.T.);", "CHAMFER_OFFSET('','first offset',#,.F.);",
        "CHAMFER_OFFSET('','second offset',#,.F.);", "FEATURE_COMPONENT_RELATIONSHIP('first feature',$,#,#);",
        "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.75),#)PLANE_ANGLE_MEASURE_"
        "WITH_UNIT()"
        "REPRESENTATION_ITEM('offset angle'));"}},
      {"chamfer by two lengths",
       [](FeatureBench& b) {
         auto f = b.basic<model::Chamfer>("C");
         f.first_offset_amount = b.length(1.5);
         f.second_offset_amount = b.length(2.5);
         b.m.add(std::move(f));
       },
       {}},
      {"edge round",
       [](FeatureBench& b) {
         auto f = b.basic<model::EdgeRound>("E");
         f.first_feature = b.m.add(b.basic<model::ToolpathFeature>("A"));
         f.second_feature = b.m.add(b.basic<model::ToolpathFeature>("B"));
         f.radius = b.length(3);
         f.first_offset_amount = b.length(3.5);
         f.second_offset_amount = b.length(4.5);
         b.m.add(std::move(f));
       },
       {"EDGE_ROUND('E','constant radius',#,.T.);"}},
      {"fillet",
       [](FeatureBench& b) {
         auto f = b.basic<model::Fillet>("E");
         f.radius = b.length(3);
         f.first_offset_amount = b.length(3.5);
         b.m.add(std::move(f));
       },
       {"FILLET('E','constant radius',#,.T.);"}},
      {"region of faces",
       [](FeatureBench& b) {
         auto f = b.basic<model::TopologicalRegion>("R");
         f.feature_placement = b.placement(1, 2, 3);
         f.name = "skin";
         f.cfs_faces.given = true;
         b.m.add(std::move(f));
       },
       {"INSTANCED_FEATURE('skin','topological region','R','topological region',#,.T.);"}},
      {"region of surfaces",
       [](FeatureBench& b) {
         auto f = b.basic<model::RegionSurfaceList>("R");
         f.surface_list.given = true;
         b.m.add(std::move(f));
       },
       {"INSTANCED_FEATURE('','region surface list','R','region surface list',#,.T.);"}},
  };
  return kCases;
}

TEST(Features, AreWrittenByTheirRulesAndComeBackEqual) {
  for (const Case& c : cases()) {
    SCOPED_TRACE(c.name);
    FeatureBench b;
    c.make(b);
    const Shapes s(b.plan);
    for (std::string line : c.written) {
      // BOSS sorts before CHARACTERIZED_OBJECT.
      if (line.find("BOSS()") != std::string::npos) {
        line.erase(line.find("BOSS()"), 6);
        line.insert(1, "BOSS()");
      }
      EXPECT_TRUE(s.has(line)) << line;
    }
    EXPECT_EQ(lost_on_the_way(b.plan), "");
  }
}

TEST(Features, LoseNothingWhenWritten) {
  for (const Case& c : cases()) {
    FeatureBench b;
    c.make(b);
    for (const auto& loss : written(b.plan).losses) ADD_FAILURE() << c.name << ": " << loss;
  }
}

TEST(Features, ShareTheShapeOfTheirWorkpiece) {
  FeatureBench b;
  b.m.add(b.basic<model::ToolpathFeature>("A"));
  b.m.add(b.basic<model::ToolpathFeature>("B"));
  const std::string bytes = written(b.plan).bytes;
  // UR1 of PRODUCT_DEFINITION_SHAPE: one for what it defines; here the part and two features.
  std::size_t n = 0;
  for (std::size_t at = bytes.find("PRODUCT_DEFINITION_SHAPE('"); at != std::string::npos;
       at = bytes.find("PRODUCT_DEFINITION_SHAPE('", at + 1)) {
    ++n;
  }
  EXPECT_EQ(n, 3u) << bytes;
}

// --- operations ---

struct Worked : FeatureBench {
  Ref<model::ManufacturingFeature> feature;
  std::vector<AnyRef> operations;
  Worked() {
    for (const char* id : {"one", "two"}) {
      model::Drilling d;
      d.its_id = id;
      operations.push_back(m.add(std::move(d)));
    }
    auto f = basic<model::ToolpathFeature>("F");
    f.its_operations.items = operations;
    feature = as<model::ManufacturingFeature>(m.add(std::move(f)));
  }
  void work(AnyRef operation) {
    model::MachiningWorkingstep s;
    s.its_id = "step";
    s.its_feature = feature;
    s.its_operation = decltype(s.its_operation)(operation);
    step(std::move(s));
  }
};

TEST(Operations, OfAFeatureFollowFromThePlansWorkingsteps) {
  Worked b;
  b.work(b.operations[0]);
  b.work(b.operations[1]);
  EXPECT_EQ(Shapes(b.plan).count("MACHINING_WORKINGSTEP('','','','');"), 0);
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(Operations, WithoutAWorkingstepHangOnOneWithoutAName) {
  Worked b;
  b.work(b.operations[1]);
  const Shapes s(b.plan);
  EXPECT_EQ(s.count("MACHINING_WORKINGSTEP('','','','');"), 2);
  EXPECT_TRUE(s.has("MACHINING_OPERATION_RELATIONSHIP('','',#,#);"));
  EXPECT_TRUE(s.has("PROPERTY_PROCESS('machining','',#,'');"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
  const auto back = read_text(written(b.plan).bytes);
  EXPECT_EQ(back.model.all(model::TypeId::kMachiningWorkingstep).size(), 1u);
}

}  // namespace
}  // namespace capstan::exchange::ap238
