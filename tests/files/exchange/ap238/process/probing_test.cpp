// Rapid movements and touch probing: one object in the model, a workingstep and its operation in AP238.

#include "tests/files/exchange/ap238/process/process_support.h"

namespace capstan::exchange::ap238::process {
namespace {

std::vector<std::string> operation(const std::string& description, const std::string& id = "") {
  return {"MACHINING_OPERATION_RELATIONSHIP('',$,#,#);",
          "MACHINING_WORKINGSTEP('','" + description + "','','');",
          "MACHINING_TOUCH_PROBING('" + id + "','" + description + "','','');"};
}

TEST(RapidMovement, IsAWorkingstepAndItsOperation) {
  const Line lines[] = {
      {"RAPID_MOVEMENT",
       "its_id",
       0,
       {"MACHINING_WORKINGSTEP('a text','rapid movement','','');",
        "MACHINING_RAPID_MOVEMENT('','rapid movement','','');"}},
      {"RAPID_MOVEMENT", "operation_id", 0, {"MACHINING_RAPID_MOVEMENT('a text','rapid movement','','');"}},
      {"RETURN_HOME", "its_id", 0, {"MACHINING_RAPID_MOVEMENT('','return home','','');"}},
      {"RAPID_MOVEMENT", "its_secplane", 0, property("security plane", "rapid movement", "PLANE('',#);")},
      {"RAPID_MOVEMENT",
       "its_tool_direction",
       0,
       {"ACTION_PROPERTY('tool direction','rapid movement',#);",
        "MACHINING_TOOL_DIRECTION_REPRESENTATION('three axes',(#),#);"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(TouchProbing, IsToldByTheDescriptionOfItsOperation) {
  const std::map<std::string, std::string> kinds = {
      {"WORKPIECE_PROBING", "workpiece probing"},
      {"WORKPIECE_COMPLETE_PROBING", "workpiece complete probing"},
      {"TOOL_LENGTH_PROBING", "tool length probing"},
      {"TOOL_RADIUS_PROBING", "tool radius probing"},
      {"FEATURE_COMPLETE_PROBING", "feature complete probing"},
      {"CURVE_PROBING", "curve probing"}};
  for (const auto& [noun, description] : kinds)
    check({noun.c_str(), "operation_id", 0, operation(description, "a text")});
}

TEST(TouchProbing, HasItsAttributesAsPropertiesOfTheOperation) {
  const Line lines[] = {
      {"WORKPIECE_PROBING",
       "measured_offset",
       0,
       {"ACTION_PROPERTY('measured offset','workpiece probing',#);",
        "(EXPRESSION()EXPRESSION_REPRESENTATION_ITEM()GENERIC_EXPRESSION()GENERIC_VARIABLE()NUMERIC_"
        "EXPRESSION()NUMERIC_VARIABLE()"
        "REAL_NUMERIC_VARIABLE()REPRESENTATION_ITEM('V1')SIMPLE_GENERIC_EXPRESSION()SIMPLE_NUMERIC_"
        "EXPRESSION()VARIABLE());"}},
      {"WORKPIECE_PROBING", "start_position", 0,
       property("start position", "workpiece probing", "AXIS2_PLACEMENT_3D('',#,$,$);")},
      {"WORKPIECE_PROBING", "direction", 0,
       property("direction", "workpiece probing", "DIRECTION('',(0.,0.6,0.8));")},
      {"WORKPIECE_PROBING", "its_workpiece", 0, {"PRODUCT_DEFINITION_PROCESS('workpiece probing',$,#,'');"}},
      {"WORKPIECE_COMPLETE_PROBING",
       "its_workpiece",
       0,
       {"PRODUCT_DEFINITION_PROCESS('workpiece complete probing',$,#,'');"}},
      {"WORKPIECE_PROBING",
       "its_probe",
       0,
       {"MACHINING_TOOL('T9','touch probe',(#),#);", "ACTION_PROPERTY('probe','workpiece probing',#);"}},
      {"WORKPIECE_PROBING",
       "expected_value",
       0,
       {"ACTION_PROPERTY('expected value','workpiece probing',#);"}},
      {"WORKPIECE_COMPLETE_PROBING",
       "probing_distance",
       0,
       {"ACTION_PROPERTY('probing distance','workpiece complete probing',#);"}},
      {"WORKPIECE_COMPLETE_PROBING",
       "computed_offset",
       0,
       {"ACTION_PROPERTY('computed offset','workpiece complete probing',#);",
        "MACHINING_OFFSET_VECTOR_REPRESENTATION('',(#),#);"}},
      {"TOOL_LENGTH_PROBING", "its_tool", 0, {"MACHINING_TOOL('T9','touch probe',(#),#);"}},
      {"FEATURE_COMPLETE_PROBING",
       "expected_value",
       0,
       {"MACHINING_FEATURE_RELATIONSHIP('','feature complete probing',#,#);",
        "PROPERTY_PROCESS('expected value','feature complete probing',#,'');"}},
      {"TOOL_LENGTH_PROBING",
       "its_toolpath",
       0,
       {"MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP('',$,#,#,1.);",
        "MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP('',$,#,#,2.);"}},
      {"TOOL_LENGTH_PROBING",
       "operation_properties",
       0,
       {"MACHINING_PROCESS_PROPERTY('bound by','the operator',#);"}},
      {"TOOL_LENGTH_PROBING", "offset", 0,
       property("offset", "tool length probing", "CARTESIAN_POINT('',(10.,20.,30.5));")},
      {"TOOL_RADIUS_PROBING", "max_wear", 0, property("maximum wear", "tool radius probing", length_item())},
      {"FEATURE_COMPLETE_PROBING", "start_position", 0,
       property("start position", "feature complete probing", "AXIS2_PLACEMENT_3D('',#,$,$);")},
      {"CURVE_PROBING", "its_curve", 0, property("curve", "curve probing", "POLYLINE('',(#,#));")},
      {"CURVE_PROBING", "its_workpiece", 0, {"PRODUCT_DEFINITION_PROCESS('curve probing',$,#,'');"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(TouchProbing, WithTheSecurityPlaneThatTheRulesWantOfTheOperation) {
  Bench bench;
  const AnyRef probing = placed(bench, TypeId::kToolLengthProbing);
  give(bench, probing, *model::find_attribute(probing.type, "its_secplane"), 0);
  const auto lines = shapes(written(bench.plan).bytes);
  EXPECT_EQ(
      std::count(lines.begin(), lines.end(), "ACTION_PROPERTY('security plane','tool length probing',#);"),
      2);
  EXPECT_EQ(std::count(lines.begin(), lines.end(), "PLANE('',#);"), 1);
  EXPECT_EQ(lost_on_the_way(bench.plan), "");
}

TEST(TouchProbing, OfEditionsBeforeThreeIsOneInstance) {
  const auto plan = read_text(
      file_of("#1=MACHINING_TOUCH_PROBING('probe it','tool length "
              "probing','','');\n#2=ACTION_PROPERTY('maximum wear','',#1);\n"
              "#3=ACTION_PROPERTY_REPRESENTATION('','',#2,#4);\n#4=REPRESENTATION('',(#5),#90);\n"
              "#5=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(0."
              "2),#6)REPRESENTATION_ITEM(''));\n"
              "#6=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#90=REPRESENTATION_CONTEXT('','');\n"
              "#10=MACHINING_WORKPLAN('main','','','');\n#11=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#"
              "10,#1,1.);\n"
              "#12=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#10,#13,2.);\n#13=MACHINING_RAPID_MOVEMENT('"
              "back','return home','','');\n"));
  const auto& plan_steps =
      plan.model.at<model::Workplan>(plan.model.all_below(TypeId::kWorkplan).front()).its_elements;
  ASSERT_EQ(plan_steps.size(), 2u);
  const auto* probing = plan.model.get<model::ToolLengthProbing>(plan_steps.items[0]);
  ASSERT_NE(probing, nullptr);
  EXPECT_EQ(probing->its_id, "probe it");
  EXPECT_NEAR(probing->max_wear.value_or(0), 0.2, 1e-12);
  ASSERT_EQ(plan_steps.items[1].type, TypeId::kReturnHome);
  EXPECT_EQ(plan.model.at<model::ReturnHome>(plan_steps.items[1]).its_id, "back");
}

TEST(RapidMovement, ReadsWithAFeatureThatEditionThreeGivesIt) {
  const auto plan = read_text(file_of(
      "#1=MACHINING_WORKPLAN('main','','','');\n#2=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#1,#3,1.);\n"
      "#3=MACHINING_WORKINGSTEP('go','machining','','');\n#4=MACHINING_OPERATION_RELATIONSHIP('','',#3,#5);\n"
      "#5=MACHINING_RAPID_MOVEMENT('op','','','');\n"));
  const auto all = plan.model.all_below(TypeId::kRapidMovement);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(plan.model.at<model::RapidMovement>(all.front()).operation_id, "op");
}

}  // namespace
}  // namespace capstan::exchange::ap238::process
