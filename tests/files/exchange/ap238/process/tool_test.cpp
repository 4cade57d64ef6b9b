// Tools: classes, dimensions, edges, usage.

#include <numbers>

#include "planner/model/nouns/arena/walk.h"
#include "tests/files/exchange/ap238/resources/resource_support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;
using model::TypeId;

/// A tool of that body class in an operation of the bench.
struct ToolBench {
  Ref<model::MillingCuttingTool> tool;
  AnyRef body;
  Ref<model::MillingToolDimension> dimension;
  explicit ToolBench(Bench& b, TypeId body_type) {
    model::Model& m = b.plan.model;
    dimension = m.add<model::MillingToolDimension>();
    m.at<model::MillingToolDimension>(dimension).diameter = 12.0;
    body = m.add_object(body_type);
    m.at<model::MillingToolBody>(body).dimension = dimension;
    tool = m.add<model::MillingCuttingTool>();
    auto& t = m.at<model::MillingCuttingTool>(tool);
    t.its_id = "T7";
    t.its_tool_body = Ref<model::ToolBody>(body);
    t.its_cutting_edge.given = true;
    const auto operation = m.add<model::PlaneFinishMilling>();
    m.at<model::PlaneFinishMilling>(operation).its_tool = tool;
    const auto step = b.step<model::MachiningWorkingstep>();
    m.at<model::MachiningWorkingstep>(step).its_operation = operation;
  }
};

template <class Give>
Case tool_case(const std::string& what, TypeId body, Give give, std::vector<std::string> instances) {
  return {what,
          [=](Bench& b) {
            ToolBench t(b, body);
            give(b.plan.model, t);
          },
          std::move(instances)};
}

TEST(Tool, IsOfTheClassThatItsDescriptionNames) {
  const std::pair<TypeId, const char*> kClasses[] = {
      {TypeId::kEndmill, "endmill"},
      {TypeId::kBallEndmill, "ballnose endmill"},
      {TypeId::kBullnoseEndmill, "bullnose endmill"},
      {TypeId::kProfiledEndMill, "profiled endmill"},
      {TypeId::kFacemill, "facemill"},
      {TypeId::kShouldermill, "shoulder mill"},
      {TypeId::kTSlotMill, "tee slot mill"},
      {TypeId::kDovetailMill, "dovetail mill"},
      {TypeId::kSideMill, "side mill"},
      {TypeId::kThreadMill, "thread mill"},
      {TypeId::kGeneralDrill, "drill"},
      {TypeId::kTwistDrill, "twist drill"},
      {TypeId::kTaperedDrill, "tapered drill"},
      {TypeId::kSpadeDrill, "spade drill"},
      {TypeId::kSpotdrill, "spot drill"},
      {TypeId::kStepDrill, "step drill"},
      {TypeId::kCounterbore, "counterbore"},
      {TypeId::kCountersink, "countersink"},
      {TypeId::kTap, "tapping tool"},
      {TypeId::kCombinedDrillAndTap, "combined drill and tap"},
      {TypeId::kReamer, "reamer"},
      {TypeId::kTaperedReamer, "tapered reamer"},
      {TypeId::kCombinedDrillAndReamer, "combined drill and reamer"},
      {TypeId::kBoringTool, "boring tool"},
      // Of ISO 14649 only, under words of our own.
      {TypeId::kCenterDrill, "center drill"},
      {TypeId::kTaperedEndmill, "tapered endmill"},
      {TypeId::kWoodruffKeyseatMill, "woodruff keyseat mill"},
      {TypeId::kTaperedTap, "tapered tap"},
      {TypeId::kMillingThreadingTool, "milling threading tool"},
      {TypeId::kBacksideCounterbore, "backside counterbore"},
      {TypeId::kBacksideCountersink, "backside countersink"},
  };
  std::set<TypeId> met = {TypeId::kUserDefinedTool};
  for (const auto& [type, description] : kClasses) {
    met.insert(type);
    check(tool_case(description, type, [](auto&, auto&) {},
                    {"MACHINING_TOOL('T7','" + std::string(description) + "',(#),#);",
                     "ACTION_RESOURCE_TYPE('milling cutting tool');", "RESOURCE_PROPERTY('tool body','',#);",
                     "MACHINING_TOOL_BODY_REPRESENTATION('" + std::string(description) + "',(#),#);",
                     length_of("effective cutting diameter", "12.")}));
  }
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    if (!model::is_a(type, TypeId::kMillingToolBody) || model::noun_type(type).abstract) continue;
    EXPECT_TRUE(met.contains(type)) << model::noun_type(type).keyword << " is not tested";
  }
}

TEST(Tool, HasItsDimensionsAsItemsOfItsBody) {
  using D = model::MillingToolDimension;
  struct Line {
    const char* what;
    TypeId body;
    model::Real D::*member;
    std::string item;
  };
  const Line kLines[] = {
      {"depth of cut", TypeId::kEndmill, &D::cutting_edge_length, length_of("maximum depth of cut")},
      {"edge radius", TypeId::kEndmill, &D::edge_radius, length_of("edge radius")},
      {"corner radius", TypeId::kUserDefinedTool, &D::edge_radius, length_of("corner radius")},
      {"corner across", TypeId::kUserDefinedTool, &D::edge_center_horizontal,
       length_of("corner radius center horizontal")},
      {"corner up", TypeId::kUserDefinedTool, &D::edge_center_vertical,
       length_of("corner radius center vertical")},
      // Half a point of 2.5 rad; the model's angle is half of what the standard's drills say.
      {"point", TypeId::kTwistDrill, &D::tool_top_angle, angle_of("point angle", "5.")},
      {"point of a counterbore", TypeId::kCounterbore, &D::tool_top_angle, angle_of("point angle", "5.")},
      {"point of a countersink", TypeId::kCountersink, &D::tool_top_angle, angle_of("point angle", "5.")},
      {"tip of an endmill", TypeId::kEndmill, &D::tool_top_angle, angle_of("tool top angle", "2.5")},
      {"flank", TypeId::kEndmill, &D::tool_circumference_angle, angle_of("tool circumference angle", "2.5")},
  };
  for (const Line& l : kLines) {
    check(tool_case(l.what, l.body,
                    [&](model::Model& m, ToolBench& t) { m.at<D>(t.dimension).*l.member = 2.5; }, {l.item}));
  }
}

TEST(Tool, HasTheAttributesOfItsClassAsItemsOfItsBody) {
  struct Line {
    TypeId body;
    const char* attribute;
    std::string item;
    std::size_t variant = 0;
  };
  const Line kLines[] = {
      {TypeId::kEndmill, "number_of_teeth", count_of("number of effective teeth", "3.")},
      {TypeId::kEndmill, "hand_of_cut", word_of("hand of cut", "left"), 0},
      {TypeId::kEndmill, "hand_of_cut", word_of("hand of cut", "right"), 1},
      {TypeId::kEndmill, "hand_of_cut", word_of("hand of cut", "neutral"), 2},
      {TypeId::kEndmill, "coolant_through_tool", word_of("coolant through tool", "supported"), 0},
      {TypeId::kEndmill, "coolant_through_tool", word_of("coolant through tool", "not supported"), 1},
      {TypeId::kEndmill, "pilot_length", length_of("pilot length")},
      {TypeId::kEndmill, "tool_cutting_edge_angle", angle_of("tool cutting edge angle", "2.5")},
      {TypeId::kFacemill, "tool_cutting_edge_angle", angle_of("tool cutting edge angle", "2.5")},
      {TypeId::kTaperedEndmill, "taper_angle", angle_of("taper angle", "2.5")},
      {TypeId::kTaperedDrill, "taper_angle", angle_of("taper angle", "2.5")},
      {TypeId::kTaperedReamer, "taper_angle", angle_of("taper angle", "2.5")},
      {TypeId::kTaperedTap, "taper_angle", angle_of("taper angle", "2.5")},
      {TypeId::kReamer, "taper_length", length_of("taper length")},
      {TypeId::kTSlotMill, "cutting_thickness", length_of("cutting width")},
      {TypeId::kDovetailMill, "included_angle", angle_of("included angle", "2.5")},
      {TypeId::kWoodruffKeyseatMill, "cutter_width", length_of("cutter width")},
      {TypeId::kSideMill, "cutter_width", length_of("cutter width")},
      {TypeId::kThreadMill, "thread_form_type", word_of("thread form type", "a text")},
      {TypeId::kThreadMill, "thread_size", length_of("thread size")},
      {TypeId::kThreadMill, "thread_pitch", length_of("thread pitch")},
      {TypeId::kTap, "thread_form_type", word_of("thread form type", "a text")},
      {TypeId::kTap, "thread_size", length_of("thread size")},
      {TypeId::kTap, "thread_pitch", length_of("thread pitch")},
      {TypeId::kTap, "taper_thread_count", count_of("taper thread count", "2.5")},
      {TypeId::kCombinedDrillAndTap, "drill_length", length_of("drill length")},
      {TypeId::kCombinedDrillAndReamer, "drill_length", length_of("drill length")},
      {TypeId::kCountersink, "countersink_radius", length_of("countersink radius")},
      {TypeId::kCountersink, "minimum_cutting_diameter", length_of("minimum cutting diameter")},
      {TypeId::kCountersink, "maximum_usable_length", length_of("maximum usable length")},
      {TypeId::kBoringTool, "retract_movement_forbidden", word_of("retract movement", "forbidden"), 0},
      {TypeId::kBoringTool, "retract_movement_forbidden", word_of("retract movement", "permitted"), 1},
      {TypeId::kUserDefinedTool, "taper_angle", angle_of("taper angle", "2.5")},
      {TypeId::kUserDefinedTool, "tip_outer_angle", angle_of("tip outer angle", "2.5")},
      {TypeId::kUserDefinedTool, "identifier", word_of("tool description", "a text")},
      {TypeId::kStepDrill, "diameters",
       "COMPOUND_REPRESENTATION_ITEM('step diameters',LIST_REPRESENTATION_ITEM((#,#,#)));"},
      {TypeId::kStepDrill, "step_length",
       "COMPOUND_REPRESENTATION_ITEM('step lengths',LIST_REPRESENTATION_ITEM((#,#,#)));"},
  };
  for (const Line& l : kLines) {
    check(tool_case(l.attribute, l.body,
                    [&](model::Model& m, ToolBench& t) {
                      const model::Attribute* a = model::find_attribute(l.body, l.attribute);
                      ASSERT_NE(a, nullptr) << l.attribute;
                      void* slot = a->at(m.object(t.body));
                      switch (a->storage) {
                        case model::Storage::kReal:
                          *static_cast<model::Real*>(slot) = 2.5;
                          break;
                        case model::Storage::kInteger:
                          *static_cast<model::Integer*>(slot) = 3;
                          break;
                        case model::Storage::kText:
                          *static_cast<model::Text*>(slot) = "a text";
                          break;
                        case model::Storage::kBoolean:
                          *static_cast<model::Boolean*>(slot) = l.variant == 0;
                          break;
                        case model::Storage::kEnum:
                          static_cast<model::AnyEnum*>(slot)->code = static_cast<std::int8_t>(l.variant);
                          break;
                        case model::Storage::kRealList:
                          *static_cast<model::RealList*>(slot) = {.items = {4.0, 6.0, 9.0}, .given = true};
                          break;
                        default:
                          FAIL() << "another kind of attribute";
                      }
                    },
                    {l.item}));
  }
}

TEST(Tool, HasItsLengthAndItsHoldersOrientation) {
  check(tool_case("overall length", TypeId::kEndmill,
                  [](auto& m, auto& t) {
                    m.template at<model::MillingCuttingTool>(t.tool).overall_assembly_length = 80.0;
                  },
                  {length_of("overall assembly length", "80.")}));
  check(tool_case(
      "orientation", TypeId::kBoringTool,
      [](auto& m, auto& t) {
        model::Direction d;
        d.direction_ratios = {.items = {0.0, 0.6, 0.8}, .given = true};
        auto& tool = m.template at<model::MillingCuttingTool>(t.tool);
        tool.direction_for_spindle_orientation = m.add(std::move(d));
        tool.tool_holder_diameter_for_spindle_orientation = 40.0;
      },
      {"RESOURCE_PROPERTY('direction for spindle orientation','',#);", "DIRECTION('',(0.,0.6,0.8));",
       "RESOURCE_PROPERTY('tool holder diameter for spindle orientation','',#);", length_of("", "40.")}));
}

TEST(Tool, HasEdgesOfWhichSeveralMayBeOne) {
  const Case c = tool_case(
      "edges", TypeId::kEndmill,
      [](model::Model& m, ToolBench& t) {
        const auto material = m.add<model::Material>();
        m.at<model::Material>(material).material_identifier = "CARBIDE";
        m.at<model::Material>(material).standard_identifier = "ISO 513";
        m.at<model::Material>(material).material_property.given = true;
        model::CuttingEdgeTechnologicalData data;
        data.cutting_angle = 0.25;
        data.free_angle = 0.125;
        data.aux_angle = 0.5;
        model::CuttingComponent edge;
        edge.tool_offset_length = 80.0;
        edge.expected_tool_life = 900.0;
        edge.its_material = material;
        edge.technological_data = m.add(std::move(data));
        edge.its_technology = m.add(model::MillingTechnology{});
        const auto same = m.add(std::move(edge));
        auto& edges = m.at<model::MillingCuttingTool>(t.tool).its_cutting_edge;
        edges.push_back(same);
        edges.push_back(same);
        edges.push_back(same);
      },
      {"MACHINING_CUTTING_COMPONENT('',$,(#),#,'',$);", "ACTION_RESOURCE_TYPE('milling cutting edge');",
       "ACTION_RESOURCE_RELATIONSHIP('',$,#,#);", "RESOURCE_PROPERTY('functional length','',#);",
       length_of("", "80."), "RESOURCE_PROPERTY('expected life','',#);", time_of("", "900."),
       "MATERIAL_DESIGNATION('CARBIDE',(#));", "REQUIREMENT_FOR_ACTION_RESOURCE('','',#,(#),(#));",
       "RESOURCE_REQUIREMENT_TYPE('cutting component','');", "RESOURCE_PROPERTY('technological data','',#);",
       angle_of("cutting angle", "0.25"), angle_of("free angle", "0.125"),
       angle_of("auxiliary angle", "0.5")});
  check(c);
  Bench b;
  c.give(b);
  const auto lines = shapes(written(b.plan).bytes);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "ACTION_RESOURCE_RELATIONSHIP('',$,#,#);"), 3);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "MACHINING_CUTTING_COMPONENT('',$,(#),#,'',$);"), 1);
}

TEST(Tool, ListsEveryOperationThatUsesIt) {
  Bench b;
  ToolBench t(b, TypeId::kEndmill);
  model::Model& m = b.plan.model;
  for (int i = 0; i < 2; ++i) {
    const auto operation = m.add<model::PlaneRoughMilling>();
    m.at<model::PlaneRoughMilling>(operation).its_tool = t.tool;
    m.at<model::MachiningWorkingstep>(b.step<model::MachiningWorkingstep>()).its_operation = operation;
  }
  const auto lines = shapes(written(b.plan).bytes);
  EXPECT_NE(std::find(lines.begin(), lines.end(), "MACHINING_TOOL('T7','endmill',(#,#,#),#);"), lines.end());
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(Tool, ThatIsOpenStaysOpen) {
  // A requirement is a tool by class and dimensions: without usage, edges or length.
  Bench b;
  ToolBench t(b, TypeId::kTwistDrill);
  const model::Plan back = read_text(written(b.plan).bytes);
  const auto tools = back.model.all(TypeId::kMillingCuttingTool);
  ASSERT_EQ(tools.size(), 1U);
  const auto& tool = back.model.at<model::MillingCuttingTool>(tools.front());
  EXPECT_FALSE(tool.its_usage.set());
  EXPECT_TRUE(tool.its_cutting_edge.empty());
  EXPECT_FALSE(tool.overall_assembly_length.has_value());
  EXPECT_TRUE(back.model.holds<model::TwistDrill>(tool.its_tool_body));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(Tool, WithoutBodyOrDimensionIsNotLost) {
  check(
      tool_case("no body", TypeId::kEndmill,
                [](auto& m, auto& t) { m.template at<model::MillingCuttingTool>(t.tool).its_tool_body = {}; },
                {"MACHINING_TOOL('T7','unspecified tool',(#),#);"}));
  check(tool_case("no dimension", TypeId::kFacemill,
                  [](auto& m, auto& t) {
                    auto& body = m.template at<model::MillingToolBody>(t.body);
                    body.dimension = {};
                    body.number_of_teeth = 5;
                  },
                  {"MACHINING_TOOL('T7','facemill',(#),#);", count_of("number of effective teeth", "5.")}));
}

TEST(Tool, SaysThatABodyItDoesNotKnowIsLeftOut) {
  Bench b;
  ToolBench t(b, TypeId::kEndmill);
  model::KeptInstance vendor;
  vendor.keyword = "LOLLIPOP_MILL";
  vendor.pieces.emplace_back("LOLLIPOP_MILL()");
  b.plan.model.at<model::MillingCuttingTool>(t.tool).its_tool_body =
      Ref<model::ToolBody>(AnyRef(b.plan.model.add(std::move(vendor))));
  EXPECT_THAT(written(b.plan).losses,
              ::testing::ElementsAre(::testing::HasSubstr("MILLING_CUTTING_TOOL.its_tool_body")));
}

TEST(Tool, MayBeATouchProbe) {
  check({"touch probe",
         [](Bench& b) {
           model::TouchProbe probe;
           probe.its_id = "P1";
           probe.ball_radius = 3.0;
           probe.overall_assembly_length = 120.0;
           probe.stylus_diameter = 4.0;
           model::LoadTool load;
           load.its_tool = b.plan.model.add(std::move(probe));
           b.step(std::move(load));
         },
         {"MACHINING_TOOL('P1','touch probe',(#),#);",
          "MACHINING_TOOL_BODY_REPRESENTATION('touch probe',(#,#,#),#);", length_of("ball radius", "3."),
          length_of("overall assembly length", "120."), length_of("stylus diameter", "4.")}});
}

TEST(Tool, ThatNothingUsesIsForCuttingAndItsMaterialForItself) {
  check({"unused",
         [](Bench& b) {
           model::Model& m = b.plan.model;
           b.step(model::OptionalStop{});
           model::Material material;
           material.material_identifier = "STEEL";
           material.standard_identifier = "ST-50";
           material.material_property.given = true;
           model::MillingToolDimension dimension;
           dimension.diameter = 8.0;
           model::Endmill body;
           body.dimension = m.add(std::move(dimension));
           model::MillingCuttingTool tool;
           tool.its_id = "spare";
           tool.its_tool_body = m.add(std::move(body));
           b.plan.kept.push_back(m.add(std::move(tool)));
           b.plan.kept.push_back(m.add(std::move(material)));
         },
         {"MACHINING_TOOL('spare','endmill',(#),#);", "ACTION_METHOD('cutting',$,'','cutting');",
          "MATERIAL_DESIGNATION('STEEL',(#));", "CHARACTERIZED_OBJECT('material','');"}});
}

// --- files of others ---

std::string file_with_tool(const std::string& tool, const std::string& body) {
  return file_of(
      "#1=MACHINING_PROJECT('p','',$,());\n#2=PRODUCT_DEFINITION_FORMATION('','',#1);\n#3=PRODUCT_DEFINITION("
      "'','',#2,$);\n"
      "#4=PROCESS_PRODUCT_ASSOCIATION('','',#3,#5);\n#5=PRODUCT_DEFINITION_PROCESS('machining','',#6,'');\n"
      "#6=MACHINING_WORKPLAN('main','','','');\n#7=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#6,#8,1.);\n"
      "#8=MACHINING_WORKINGSTEP('ws','machining','','');\n#9=MACHINING_OPERATION_RELATIONSHIP('','machining',"
      "#8,#10);\n"
      "#10=PLANE_MILLING_OPERATION('op','finishing','','');\n#12=ACTION_RESOURCE_TYPE('milling cutting "
      "tool');\n"
      "#13=RESOURCE_PROPERTY('tool body','',#11);\n#14=RESOURCE_PROPERTY_REPRESENTATION('','',#13,#15);\n"
      "#16=REPRESENTATION_CONTEXT('','');\n"
      "#17=(CONVERSION_BASED_UNIT('inch',#18)LENGTH_UNIT()NAMED_UNIT(#19));\n#19=DIMENSIONAL_EXPONENTS(1.,0.,"
      "0.,0.,0.,0.,0.);\n"
      "#18=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#20);\n#20=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(."
      "MILLI.,.METRE.));\n"
      "#21=(CONVERSION_BASED_UNIT('degree',#22)NAMED_UNIT(#24)PLANE_ANGLE_UNIT());\n#24=DIMENSIONAL_"
      "EXPONENTS(0.,0.,0.,0.,0.,0.,0.);\n"
      "#22=PLANE_ANGLE_MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(0.017453292519943295),#23);\n"
      "#23=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));\n" +
      tool + body);
}

const model::MillingCuttingTool& only_tool(const model::Plan& plan) {
  const auto tools = plan.model.all(TypeId::kMillingCuttingTool);
  static const model::MillingCuttingTool kNone;
  EXPECT_EQ(tools.size(), 1U);
  return tools.empty() ? kNone : plan.model.at<model::MillingCuttingTool>(tools.front());
}

std::string item(const char* id, const char* measure, const char* kind, const char* unit, const char* name) {
  return std::string(id) + "=(" + kind +
         "_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(" + measure + "," + unit +
         ")REPRESENTATION_ITEM('" + name + "'));\n";
}

TEST(Tool, OfAnInchFileWithMixedUnitsIsInMillimetresAndRadians) {
  const model::Plan plan = read_text(
      file_with_tool("#11=MACHINING_TOOL('D1','drill',(#10),#12);\n#15=MACHINING_TOOL_BODY_REPRESENTATION('"
                     "drill',(#30,#31,#32),#16);\n",
                     item("#30", "LENGTH_MEASURE(0.5)", "LENGTH", "#17", "effective cutting diameter") +
                         item("#31", "LENGTH_MEASURE(70.)", "LENGTH", "#20", "maximum depth of cut") +
                         item("#32", "PLANE_ANGLE_MEASURE(118.)", "PLANE_ANGLE", "#21", "point angle")));
  const auto& tool = only_tool(plan);
  const auto& body = plan.model.at<model::GeneralDrill>(tool.its_tool_body);
  const auto& d = plan.model.at<model::MillingToolDimension>(body.dimension);
  EXPECT_DOUBLE_EQ(d.diameter.value_or(0), 12.7);
  EXPECT_DOUBLE_EQ(d.cutting_edge_length.value_or(0), 70.0);
  EXPECT_NEAR(d.tool_top_angle.value_or(0), 59.0 * std::numbers::pi / 180.0, 1e-12);
}

TEST(Tool, OfAKindUnknownIsAUserDefinedOneAndKeepsItsSizes) {
  const model::Plan plan = read_text(
      file_with_tool("#11=MACHINING_TOOL('L1','lollipop "
                     "mill',(#10),#12);\n#15=MACHINING_TOOL_BODY_REPRESENTATION('',(#30),#16);\n",
                     item("#30", "LENGTH_MEASURE(8.)", "LENGTH", "#20", "effective cutting diameter")));
  const auto& tool = only_tool(plan);
  const auto& body = plan.model.at<model::UserDefinedTool>(tool.its_tool_body);
  EXPECT_EQ(body.identifier, "lollipop mill");
  EXPECT_EQ(plan.model.at<model::MillingToolDimension>(body.dimension).diameter, 8.0);
}

TEST(Tool, MayHaveItemsWithoutAValueAndTheOlderNameOfAnEdgesLength) {
  const model::Plan plan = read_text(
      file_with_tool("#11=MACHINING_TOOL('B1','ball "
                     "endmill',(#10),#12);\n#15=MACHINING_TOOL_BODY_REPRESENTATION('',(#30),#16);\n",
                     item("#30", "$", "LENGTH", "#20", "effective cutting diameter") +
                         "#40=ACTION_RESOURCE_RELATIONSHIP('','',#11,#41);\n#41=MACHINING_CUTTING_COMPONENT('"
                         "','',$,$,'','');\n"
                         "#42=RESOURCE_PROPERTY('offset "
                         "length','',#41);\n#43=RESOURCE_PROPERTY_REPRESENTATION('','',#42,#44);\n"
                         "#44=REPRESENTATION('',(#45),#16);\n" +
                         item("#45", "LENGTH_MEASURE(80.)", "LENGTH", "#20", "")));
  const auto& tool = only_tool(plan);
  const auto& body = plan.model.at<model::BallEndmill>(tool.its_tool_body);
  EXPECT_FALSE(plan.model.at<model::MillingToolDimension>(body.dimension).diameter.has_value());
  ASSERT_EQ(tool.its_cutting_edge.size(), 1U);
  EXPECT_EQ(plan.model.at<model::CuttingComponent>(tool.its_cutting_edge[0]).tool_offset_length, 80.0);
}

TEST(Tool, OfAnnexJIsReadToTheValue) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  Job job;
  const auto plan = exchange::read(path, job);
  ASSERT_TRUE(plan);
  std::map<std::string, const model::MillingCuttingTool*> tools;
  for (const AnyRef t : plan->model.all(TypeId::kMillingCuttingTool)) {
    const auto& tool = plan->model.at<model::MillingCuttingTool>(t);
    tools[tool.its_id.value_or("")] = &tool;
  }
  ASSERT_EQ(tools.size(), 3U);
  const auto& mill = *tools.at("MILL 20MM");
  EXPECT_EQ(mill.overall_assembly_length, 80.0);
  ASSERT_EQ(mill.its_cutting_edge.size(), 4U);
  EXPECT_EQ(model::AnyRef(mill.its_cutting_edge[0]), model::AnyRef(mill.its_cutting_edge[3]));
  EXPECT_EQ(plan->model.at<model::CuttingComponent>(mill.its_cutting_edge[0]).tool_offset_length, 80.0);
  const auto& body = plan->model.at<model::Endmill>(mill.its_tool_body);
  EXPECT_EQ(body.number_of_teeth, 4);
  EXPECT_EQ(body.hand_of_cut, model::Hand::kRight);
  EXPECT_EQ(body.coolant_through_tool, false);
  const auto& size = plan->model.at<model::MillingToolDimension>(body.dimension);
  EXPECT_EQ(size.diameter, 20.0);
  EXPECT_EQ(size.cutting_edge_length, 30.0);
  EXPECT_EQ(size.edge_radius, 0.05);
  const auto& drill = plan->model.at<model::GeneralDrill>(tools.at("DRILL 20MM")->its_tool_body);
  // A point of 120 degrees; #428 gives the degree with ten digits.
  EXPECT_NEAR(plan->model.at<model::MillingToolDimension>(drill.dimension).tool_top_angle.value_or(0),
              std::numbers::pi / 3.0, 1e-9);
  EXPECT_TRUE(plan->model.holds<model::Reamer>(tools.at("REAMER 22MM")->its_tool_body));
}

}  // namespace
}  // namespace capstan::exchange::ap238
