#include <functional>

#include "tests/files/exchange/ap238/resources/resource_support.h"
#include "tests/files/exchange/ap238/support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

/// An operation with one toolpath of a kind, and geometry to hang on it.
template <class T>
struct PathBench : Bench {
  model::Ref<model::FreeformOperation> operation;
  model::Ref<T> path;
  PathBench() {
    model::Model& m = plan.model;
    path = m.add<T>();
    m.at<T>(path).its_id = "path";
    m.at<T>(path).its_priority = true;
    m.at<T>(path).its_type = model::ToolpathType::kContact;
    model::ToolpathList list;
    list.its_list.push_back(path);
    operation = m.add<model::FreeformOperation>();
    m.at<model::FreeformOperation>(operation).its_id = "operation";
    m.at<model::FreeformOperation>(operation).its_toolpath = m.add(std::move(list));
    model::MachiningWorkingstep step;
    step.its_id = "step";
    step.its_operation = operation;
    this->step(std::move(step));
  }
  T& at() { return plan.model.at<T>(path); }
  model::Ref<model::CartesianPoint> point(std::vector<double> at) {
    model::CartesianPoint p;
    p.name = "";
    p.coordinates = {std::move(at), true};
    return plan.model.add(std::move(p));
  }
  model::Ref<model::Direction> direction(std::vector<double> of) {
    model::Direction d;
    d.name = "";
    d.direction_ratios = {std::move(of), true};
    return plan.model.add(std::move(d));
  }
  model::Ref<model::BoundedCurve> line(const std::vector<std::vector<double>>& through) {
    model::Polyline c;
    c.name = "";
    for (const auto& p : through) c.points.push_back(point(p));
    return plan.model.add(std::move(c));
  }
};

template <class T>
struct Form {
  std::string name;
  std::function<void(PathBench<T>&)> set;
  std::vector<std::string> written;  ///< shapes that must stand in the file
};

/// Sets each attribute alone, writes it, looks for the instances, reads it back.
template <class T>
void check(const std::vector<Form<T>>& forms) {
  for (const auto& form : forms) {
    SCOPED_TRACE(form.name);
    PathBench<T> bench;
    form.set(bench);
    const Written out = written(bench.plan);
    const auto lines = shapes(out.bytes);
    for (const auto& shape : form.written) EXPECT_THAT(lines, Contains(shape)) << out.bytes;
    EXPECT_EQ(lost_on_the_way(bench.plan), "") << out.bytes;
  }
}

constexpr const char* kLocation = "cutter location trajectory";

std::string property(const std::string& name, const std::string& of = kLocation) {
  return "ACTION_PROPERTY('" + name + "','" + of + "',#);";
}
std::string relation(const std::string& of = kLocation) {
  return "ACTION_PROPERTY_REPRESENTATION('','" + of + "',#,#);";
}

constexpr const char* kInSpace = "REPRESENTATION('',(#),#);";

using Location = model::CutterLocationTrajectory;

TEST(Ap238Toolpath, EachAttributeOfAToolpathStandsWhereTheMappingHasIt) {
  using Bench = PathBench<Location>;
  check<Location>({
      {"its_id",
       [](Bench& b) { b.at().its_id = "WS 1 TP 1"; },
       {"MACHINING_TOOLPATH('WS 1 TP 1','cutter location trajectory','','');"}},
      {"required",
       [](Bench& b) { b.at().its_priority = true; },
       {property("priority"), "DESCRIPTIVE_REPRESENTATION_ITEM('','required');"}},
      {"suggested",
       [](Bench& b) { b.at().its_priority = false; },
       {property("priority"), "DESCRIPTIVE_REPRESENTATION_ITEM('','suggested');"}},
      {"approach",
       [](Bench& b) { b.at().its_type = model::ToolpathType::kApproach; },
       {property("trajectory type"), "DESCRIPTIVE_REPRESENTATION_ITEM('','approach');"}},
      {"lift",
       [](Bench& b) { b.at().its_type = model::ToolpathType::kLift; },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('','lift');"}},
      {"connect",
       [](Bench& b) { b.at().its_type = model::ToolpathType::kConnect; },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('','connect');"}},
      {"non-contact",
       [](Bench& b) { b.at().its_type = model::ToolpathType::kNonContact; },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('','non-contact');"}},
      {"contact",
       [](Bench& b) { b.at().its_type = model::ToolpathType::kContact; },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('','contact');"}},
      {"trajectory path",
       [](Bench& b) { b.at().its_type = model::ToolpathType::kTrajectoryPath; },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('','trajectory path');"}},
      {"rapid",
       [](Bench& b) { b.at().its_speed.text = "RAPID"; },
       {"ACTION_PROPERTY('speed profile','rapid',#);", "DESCRIPTIVE_REPRESENTATION_ITEM('','rapid');",
        "MACHINING_TOOLPATH_SPEED_PROFILE_REPRESENTATION('',(#),#);"}},
      {"ratio",
       [](Bench& b) { b.at().its_speed.real = 0.75; },
       {property("speed profile"), "MACHINING_TOOLPATH_SPEED_PROFILE_REPRESENTATION('',(#),#);",
        "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(RATIO_MEASURE(0.75),#)RATIO_MEASURE_WITH_UNIT()"
        "REPRESENTATION_ITEM(''));"}},
      {"speed curve",
       [](Bench& b) {
         model::ToolpathSpeed s;
         s.speed = b.line({{1.0}, {0.5}, {0.5}});
         b.at().its_speed.ref = b.plan.model.add(std::move(s));
       },
       {property("speed profile"), "MACHINING_TOOLPATH_SPEED_PROFILE_REPRESENTATION('',(#),#);",
        "POLYLINE('',(#,#,#));", "CARTESIAN_POINT('',(0.5));",
        "(GEOMETRIC_REPRESENTATION_CONTEXT(1)GLOBAL_UNIT_ASSIGNED_CONTEXT((#))"
        "REPRESENTATION_CONTEXT('RATIO','1D'));"}},
  });
}

TEST(Ap238Toolpath, EachAttributeOfATrajectoryStandsWhereTheMappingHasIt) {
  using Bench = PathBench<Location>;
  const std::string seven =
      "(GEOMETRIC_REPRESENTATION_CONTEXT(7)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#))"
      "GLOBAL_UNIT_ASSIGNED_CONTEXT((#))REPRESENTATION_CONTEXT('MILLIMETRE','7D'));";
  const std::string length =
      "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT("
      "LENGTH_MEASURE(2.5),#)REPRESENTATION_ITEM(''));";
  check<Location>({
      {"along",
       [](Bench& b) { b.at().its_direction = true; },
       {property("direction"), "DESCRIPTIVE_REPRESENTATION_ITEM('','beginning to end');"}},
      {"against",
       [](Bench& b) { b.at().its_direction = false; },
       {property("direction"), "DESCRIPTIVE_REPRESENTATION_ITEM('','end to beginning');"}},
      {"basiccurve",
       [](Bench& b) {
         b.at().basiccurve = b.line({{0, 0, 0}, {1, 0, 0}});
       },
       {property("basic curve"), relation(), kInSpace, "POLYLINE('',(#,#));"}},
      {"its_toolaxis",
       [](Bench& b) {
         b.at().its_toolaxis = b.line({{0, 0, 1}, {0, 0.6, 0.8}});
       },
       {property("tool axis"), "CARTESIAN_POINT('',(0.,0.6,0.8));"}},
      {"its_toolref_direction",
       [](Bench& b) {
         b.at().its_toolref_direction = b.line({{1, 0, 0}, {0, 1, 0}});
       },
       {property("tool reference direction")}},
      {"surface_normal",
       [](Bench& b) {
         b.at().surface_normal = b.line({{0, 0, 1}, {1, 0, 0}});
       },
       {property("surface normal")}},
      {"depth",
       [](Bench& b) { b.at().its_material_removal_depth.real = 2.5; },
       {property("material removal depth"), length}},
      {"depth curve",
       [](Bench& b) {
         b.at().its_material_removal_depth.ref = b.line({{1.0}, {2.0}});
       },
       {property("material removal depth"), "CARTESIAN_POINT('',(2.));"}},
      {"overcut",
       [](Bench& b) { b.at().its_material_removal_overcut.real = 2.5; },
       {property("material removal overcut"), length}},
      {"overcut curve",
       [](Bench& b) {
         b.at().its_material_removal_overcut.ref = b.line({{1.0}, {2.0}});
       },
       {property("material removal overcut"), "CARTESIAN_POINT('',(2.));"}},
      {"total volume",
       [](Bench& b) { b.at().its_material_removal_total_volume = 1234.5; },
       {property("material removal total volume")}},
      {"path deviation",
       [](Bench& b) { b.at().path_maximum_deviation = 2.5; },
       {property("path maximum deviation"), length}},
      {"axis deviation",
       [](Bench& b) { b.at().tool_axis_maximum_deviation = 0.01; },
       {property("tool axis maximum deviation"),
        "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.01),#)"
        "PLANE_ANGLE_MEASURE_WITH_UNIT()REPRESENTATION_ITEM(''));"}},
      {"sections",
       [](Bench& b) {
         b.at().cross_section_area_parameters =
             b.line({{5, 3, 1, -2, 15, 0.5, -1}, {4, 3, 1, -2, 12, 0.5, -1}});
       },
       {property("cross section area parameters"), seven, "CARTESIAN_POINT('',(5.,3.,1.,-2.,15.,0.5,-1.));"}},
      {"flank sections",
       [](Bench& b) {
         b.at().cross_section_area_flank_parameters = b.line({{5, 3, 1}, {4, 3, 1}});
       },
       {property("cross section area flank parameters")}},
      {"plunge sections",
       [](Bench& b) {
         b.at().cross_section_area_plunge_parameters = b.line({{5, 3, 1}, {4, 3, 1}});
       },
       {property("cross section area plunge parameters")}},
  });
}

TEST(Ap238Toolpath, HasPropertiesAndATimestampAsOperationsHave) {
  using Bench = PathBench<Location>;
  check<Location>({
      {"process properties",
       [](Bench& b) {
         for (const char* name : {"inspected by", "released by"}) {
           model::DescriptiveParameter who;
           who.parameter_name = "name";
           who.descriptive_string = "M8";
           model::ProcessProperty property;
           property.name = name;
           property.description = "the operator";
           property.its_parameters.push_back(b.plan.model.add(std::move(who)));
           b.at().process_properties.push_back(b.plan.model.add(std::move(property)));
         }
       },
       {"MACHINING_PROCESS_PROPERTY('inspected by','the operator',#);",
        "MACHINING_PROCESS_PROPERTY('released by','the operator',#);",
        "DESCRIPTIVE_REPRESENTATION_ITEM('name','M8');"}},
      {"last modified",
       [](Bench& b) {
         model::LastModifiedTimestamp stamp;
         stamp.assigned_date = moment(b.plan.model);
         stamp.role = "last modified";
         b.at().last_modified_timestamp = b.plan.model.add(std::move(stamp));
       },
       {"APPLIED_DATE_AND_TIME_ASSIGNMENT(#,#,(#));", "DATE_TIME_ROLE('last modified');"}},
  });
}

TEST(Ap238Toolpath, EachAttributeOfTheOtherKindsStandsWhereTheMappingHasIt) {
  using Contact = model::CutterContactTrajectory;
  const std::string contact = "cutter contact trajectory";
  const auto with_normal = [](PathBench<Contact>& b) {
    model::CurveWithNormalVector c;
    c.basiccurve = b.line({{0, 0, 0}, {1, 0, 0}});
    c.surface_normal = b.line({{0, 0, 1}, {0, 0, 1}});
    b.at().basiccurve = b.plan.model.add(std::move(c));
  };
  check<Contact>({
      {"normal",
       with_normal,
       {"MACHINING_TOOLPATH('path','cutter contact trajectory','','');", property("basic curve", contact),
        property("surface normal", contact)}},
      {"pcurve",
       [](PathBench<Contact>& b) {
         model::BoundedPcurve c;
         c.name = "";
         b.at().basiccurve = b.plan.model.add(std::move(c));
       },
       {property("basic curve", contact)}},
      {"axis",
       [&](PathBench<Contact>& b) {
         with_normal(b);
         b.at().its_toolaxis = b.line({{0, 0, 1}, {0, 0.6, 0.8}});
       },
       {property("tool axis", contact)}},
      {"side",
       [&](PathBench<Contact>& b) { b.at().its_contact_type = model::ContactType::kSide; },
       {property("contact type", contact), "DESCRIPTIVE_REPRESENTATION_ITEM('','side');"}},
      {"front",
       [&](PathBench<Contact>& b) { b.at().its_contact_type = model::ContactType::kFront; },
       {"DESCRIPTIVE_REPRESENTATION_ITEM('','front');"}},
  });
  check<model::AxisTrajectory>({
      {"axes",
       [](PathBench<model::AxisTrajectory>& b) {
         b.at().axis_list = {{"x", "b"}, true};
         b.at().commands.push_back(b.line({{0.0}, {10.0}}));
         b.at().commands.push_back(b.line({{0.0}, {90.0}}));
       },
       {"MACHINING_TOOLPATH('path','axis trajectory','','');", property("axis commands", "axis trajectory"),
        "REPRESENTATION('',(#,#),#);", "POLYLINE('x',(#,#));", "POLYLINE('b',(#,#));"}},
  });
  check<model::Feedstop>({
      {"time",
       [](PathBench<model::Feedstop>& b) { b.at().dwell = 0.5; },
       {property("dwell", "feedstop"), "MACHINING_DWELL_TIME_REPRESENTATION('dwell time',(#),#);",
        "(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(TIME_MEASURE(0.5),#)"
        "REPRESENTATION_ITEM('dwell time')TIME_MEASURE_WITH_UNIT());"}},
      {"revolutions",
       [](PathBench<model::Feedstop>& b) { b.at().dwell_revolutions = 3.0; },
       {property("dwell", "feedstop"), "MACHINING_DWELL_TIME_REPRESENTATION('dwell revolution',(#),#);",
        "MEASURE_REPRESENTATION_ITEM('dwell revolution',COUNT_MEASURE(3.),#);"}},
  });
  check<model::ConnectDirect>(
      {{"direct", [](auto&) {}, {"MACHINING_TOOLPATH('path','connect direct','','');"}}});
  check<model::ConnectSecplane>({
      {"up",
       [](PathBench<model::ConnectSecplane>& b) {
         b.at().up_dir = b.direction({0, 0, 1});
       },
       {property("up direction", "connect security plane"), "DIRECTION('',(0.,0.,1.));"}},
      {"down",
       [](PathBench<model::ConnectSecplane>& b) {
         b.at().down_dir = b.direction({0, 0, -1});
       },
       {property("down direction", "connect security plane")}},
  });
  const std::string angle = "approach lift path angle", tangent = "approach lift path tangent";
  check<model::ApLiftPathAngle>({
      {"angle",
       [](PathBench<model::ApLiftPathAngle>& b) { b.at().angle = 0.5; },
       {"MACHINING_TOOLPATH('path','approach lift path angle','','');", property("angle", angle)}},
      {"benddist",
       [](PathBench<model::ApLiftPathAngle>& b) { b.at().benddist = 4.0; },
       {property("bend distance", angle)}},
      {"fix point",
       [](PathBench<model::ApLiftPathAngle>& b) {
         b.at().fix_point = b.point({1, 2, 3});
       },
       {property("fix point", angle), "CARTESIAN_POINT('',(1.,2.,3.));"}},
      {"fix point direction",
       [](PathBench<model::ApLiftPathAngle>& b) {
         b.at().fix_point_dir = b.direction({1, 0, 0});
       },
       {property("fix point direction", angle)}},
  });
  check<model::ApLiftPathTangent>({
      {"radius",
       [](PathBench<model::ApLiftPathTangent>& b) { b.at().radius = 4.0; },
       {"MACHINING_TOOLPATH('path','approach lift path tangent','','');", property("radius", tangent)}},
  });
}

TEST(Ap238Toolpath, ListsAreSequenceRelationshipsInOrder) {
  PathBench<Location> b;
  auto& list = b.plan.model.at<model::ToolpathList>(
      b.plan.model.at<model::FreeformOperation>(b.operation).its_toolpath);
  model::Feedstop stop;
  stop.its_id = "pause";
  stop.its_priority = true;
  stop.its_type = model::ToolpathType::kTrajectoryPath;
  stop.dwell = 1.0;
  list.its_list.push_back(b.plan.model.add(std::move(stop)));
  const Written out = written(b.plan);
  EXPECT_THAT(shapes(out.bytes), AllOf(Contains("MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP('',$,#,#,1.);"),
                                       Contains("MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP('',$,#,#,2.);")));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

std::string inch_file(const std::string& more) {
  return file_of(
      "#1=MACHINING_PROJECT('p','','',(#2));\n#2=PRODUCT_CONTEXT('','',#3,'');\n#3=APPLICATION_CONTEXT('');\n"
      "#4=PRODUCT_DEFINITION_FORMATION('','',#1);\n#5=PRODUCT_DEFINITION('p','',#4,#6);\n"
      "#6=PRODUCT_DEFINITION_CONTEXT('',#3,'');\n#7=PROCESS_PRODUCT_ASSOCIATION('','',#5,#8);\n"
      "#8=PRODUCT_DEFINITION_PROCESS('machining','',#9,'');\n#9=MACHINING_WORKPLAN('w','','','');\n"
      "#10=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#11,1.);\n"
      "#11=MACHINING_WORKINGSTEP('s','machining','','');\n"
      "#12=MACHINING_OPERATION_RELATIONSHIP('','',#11,#13);\n#13=FREEFORM_MILLING_OPERATION('o','','','');\n"
      "#14=MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP('','',#13,#15,1.);\n"
      "#15=MACHINING_TOOLPATH('t','cutter location trajectory','','');\n"
      "#20=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#21))REPRESENTATION_CONTEXT('','"
      "'));\n"
      "#21=(CONVERSION_BASED_UNIT('INCH',#22)LENGTH_UNIT()NAMED_UNIT(#24));\n"
      "#22=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#23);\n"
      "#23=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
      "#24=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
      "#25=REPRESENTATION_CONTEXT('','');\n" +
      more);
}

std::string action_property(int n, const std::string& name, const std::string& items, int context) {
  const auto ref = [](int k) { return "#" + std::to_string(k); };
  return ref(n) + "=ACTION_PROPERTY('" + name + "','',#15);\n" + ref(n + 1) +
         "=ACTION_PROPERTY_REPRESENTATION('',''," + ref(n) + "," + ref(n + 2) + ");\n" + ref(n + 2) +
         "=REPRESENTATION(''," + items + "," + ref(context) + ");\n";
}

TEST(Ap238Toolpath, InchesAreOfPointsAndNotOfDirectionsRatiosOrSquares) {
  const auto plan = read_text(inch_file(
      action_property(30, "basic curve", "(#33)", 20) + "#33=POLYLINE('',(#34,#35));\n" +
      "#34=CARTESIAN_POINT('',(0.,0.,1.));\n#35=CARTESIAN_POINT('',(1.,0.,1.));\n" +
      action_property(40, "tool axis", "(#43)", 20) + "#43=POLYLINE('',(#34,#34));\n" +
      action_property(50, "cross section area parameters", "(#53)", 20) +
      "#53=POLYLINE('',(#54,#54));\n#54=CARTESIAN_POINT('',(1.,1.,1.,1.,1.,1.,1.));\n"
      "#60=ACTION_PROPERTY('speed profile','',#15);\n#61=ACTION_PROPERTY_REPRESENTATION('','',#60,#62);\n"
      "#62=MACHINING_TOOLPATH_SPEED_PROFILE_REPRESENTATION('',(#63),#20);\n#63=POLYLINE('',(#64,#64));\n"
      "#64=CARTESIAN_POINT('',(0.5));\n" +
      action_property(70, "path maximum deviation", "(#73)", 25) +
      "#73=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(0.001),#"
      "21)"
      "REPRESENTATION_ITEM(''));\n"));
  const auto& m = plan.model;
  const auto paths = m.all(model::TypeId::kCutterLocationTrajectory);
  ASSERT_THAT(paths, SizeIs(1));
  const auto& t = m.at<Location>(paths.front());
  const auto first = [&](model::AnyRef curve) {
    return m.at<model::CartesianPoint>(m.at<model::Polyline>(curve).points[0]).coordinates.items;
  };
  EXPECT_EQ(first(t.basiccurve), (std::vector<double>{0.0, 0.0, 25.4}));
  EXPECT_EQ(first(t.its_toolaxis), (std::vector<double>{0.0, 0.0, 1.0}));
  EXPECT_EQ(first(m.at<model::ToolpathSpeed>(t.its_speed.ref).speed), std::vector<double>{0.5});
  const auto seven = first(t.cross_section_area_parameters);
  ASSERT_THAT(seven, SizeIs(7));
  for (std::size_t i = 0; i < 7; ++i) EXPECT_DOUBLE_EQ(seven[i], i == 4 ? 25.4 * 25.4 : 25.4);
  EXPECT_DOUBLE_EQ(*t.path_maximum_deviation, 0.0254);
}

TEST(Ap238Toolpath, AFaultInAListIsToldInsteadOfMovingTheRest) {
  Job job;
  const auto plan = read_bytes(
      inch_file(
          action_property(30, "basic curve", "(#33)", 20) +
          "#33=B_SPLINE_CURVE_WITH_KNOTS('',1,(#34,#35),.UNSPECIFIED.,.F.,.F.,(2,1.5,2),(0.,1.),"
          ".UNSPECIFIED.);\n#34=CARTESIAN_POINT('',(0.,0.,1.));\n#35=CARTESIAN_POINT('',(1.,0.,1.));\n"),
      "test.stpnc", {}, job);
  ASSERT_FALSE(plan.has_value());
  EXPECT_THAT(plan.error().message, HasSubstr("knot_multiplicities cannot be (2,1.5,2)"));
}

TEST(Ap238ToolpathCorpus, EveryTrajectoryOfTheStandardsExamplesIsDecoded) {
  for (const char* name : {"ap238/ap238e4dis_annexJ_cc1.stp", "ap238/ap238e4dis_annexJ_cc2.stp"}) {
    CAPSTAN_CORPUS_FILE(path, name);
    std::vector<std::string> said;
    const auto plan = read_text(capstan::testing::slurp(path), &said);
    for (const auto& s : said) {
      EXPECT_THAT(s, ::testing::Not(
                         ::testing::AnyOf(HasSubstr("TOOLPATH"), HasSubstr("POLYLINE"), HasSubstr("SPEED"))));
    }
    const auto& m = plan.model;
    const auto lists = m.all(model::TypeId::kToolpathList);
    ASSERT_THAT(lists, SizeIs(1)) << name;
    const auto& items = m.at<model::ToolpathList>(lists.front()).its_list.items;
    ASSERT_THAT(items, SizeIs(12)) << name;
    for (std::size_t i = 0; i < items.size(); ++i) {
      const auto& t = m.at<Location>(items[i]);
      EXPECT_EQ(t.its_id, "WS 1 TP " + std::to_string(i + 1));
      EXPECT_EQ(t.its_priority, true);
      EXPECT_TRUE(t.its_type == model::ToolpathType::kTrajectoryPath);
      EXPECT_EQ(t.its_speed.text, i % 2 == 0 ? "RAPID" : "");
      EXPECT_TRUE(t.basiccurve.set());
    }
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238
