// Operations of milling and drilling, attribute by attribute.

#include "tests/files/exchange/ap238/process/process_support.h"

namespace capstan::exchange::ap238::process {
namespace {

TEST(Operation, IsToldByItsEntityAndItsDescription) {
  const Line lines[] = {
      {"FREEFORM_OPERATION", "its_id", 0, {"FREEFORM_MILLING_OPERATION('a text',$,'','');"}},
      {"FREEFORM_ROUGH_MILLING", "its_id", 0, {"FREEFORM_MILLING_OPERATION('a text','roughing','','');"}},
      {"FREEFORM_FINISH_MILLING", "its_id", 0, {"FREEFORM_MILLING_OPERATION('a text','finishing','','');"}},
      {"PLANE_ROUGH_MILLING", "its_id", 0, {"PLANE_MILLING_OPERATION('a text','roughing','','');"}},
      {"PLANE_FINISH_MILLING", "its_id", 0, {"PLANE_MILLING_OPERATION('a text','finishing','','');"}},
      {"SIDE_ROUGH_MILLING", "its_id", 0, {"SIDE_MILLING_OPERATION('a text','roughing','','');"}},
      {"SIDE_FINISH_MILLING", "its_id", 0, {"SIDE_MILLING_OPERATION('a text','finishing','','');"}},
      {"BOTTOM_AND_SIDE_ROUGH_MILLING",
       "its_id",
       0,
       {"BOTTOM_AND_SIDE_MILLING_OPERATION('a text','roughing','','');"}},
      {"BOTTOM_AND_SIDE_FINISH_MILLING",
       "its_id",
       0,
       {"BOTTOM_AND_SIDE_MILLING_OPERATION('a text','finishing','','');"}},
      {"DRILLING", "its_id", 0, {"DRILLING_OPERATION('a text','drilling','','');"}},
      {"CENTER_DRILLING", "its_id", 0, {"DRILLING_OPERATION('a text','center drilling','','');"}},
      {"COUNTER_SINKING", "its_id", 0, {"DRILLING_OPERATION('a text','counter sinking','','');"}},
      {"MULTISTEP_DRILLING", "its_id", 0, {"DRILLING_OPERATION('a text','multistep drilling','','');"}},
      {"BORING", "its_id", 0, {"BORING_OPERATION('a text','boring','','');"}},
      {"REAMING", "its_id", 0, {"BORING_OPERATION('a text','reaming','','');"}},
      {"BACK_BORING", "its_id", 0, {"BACK_BORING_OPERATION('a text',$,'','');"}},
      {"TAPPING", "its_id", 0, {"TAPPING_OPERATION('a text','tapping','','');"}},
      {"THREAD_DRILLING", "its_id", 0, {"TAPPING_OPERATION('a text','thread drilling','','');"}},
      {"EXTENDED_OPERATION", "description", 0, {"EXTENDED_TYPE_OPERATION('','a text','','');"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Operation, HasItsLengthsAsProperties) {
  const std::map<std::string, std::vector<std::pair<std::string, std::string>>> lengths = {
      {"PLANE_FINISH_MILLING",
       {{"retract_plane", "retract plane"},
        {"overcut_length", "overcut length"},
        {"axial_cutting_depth", "axial cutting depth"},
        {"allowance_bottom", "allowance bottom"}}},
      {"SIDE_FINISH_MILLING",
       {{"axial_cutting_depth", "axial cutting depth"},
        {"radial_cutting_depth", "radial cutting depth"},
        {"allowance_side", "allowance side"}}},
      {"BOTTOM_AND_SIDE_FINISH_MILLING",
       {{"axial_cutting_depth", "axial cutting depth"},
        {"radial_cutting_depth", "radial cutting depth"},
        {"allowance_side", "allowance side"},
        {"allowance_bottom", "allowance bottom"}}}};
  for (const auto& [noun, attributes] : lengths) {
    for (const auto& [attribute, name] : attributes) {
      check({noun.c_str(), attribute.c_str(), 0, property(name, "finishing", length_item())});
    }
  }
}

TEST(Operation, OfDrillingHasItsPropertiesByName) {
  const std::string relative[] = {"MACHINING_FEED_SPEED_REPRESENTATION('relative speed',(#),#);"};
  const Line lines[] = {
      {"DRILLING", "cutting_depth", 0, property("cutting depth", "drilling", length_item())},
      {"DRILLING", "previous_diameter", 0, property("previous diameter", "drilling", length_item())},
      {"DRILLING",
       "dwell_time_bottom",
       0,
       {"ACTION_PROPERTY('dwell time bottom','drilling',#);",
        "ACTION_PROPERTY_REPRESENTATION('dwell time','drilling',#,#);",
        "MACHINING_DWELL_TIME_REPRESENTATION('dwell time',(#),#);", time_item("dwell time")}},
      {"DRILLING",
       "feed_on_retract",
       0,
       {"ACTION_PROPERTY('feedrate on retract','drilling',#);",
        "ACTION_PROPERTY_REPRESENTATION('relative speed','drilling',#,#);", relative[0],
        ratio_item("relative speed")}},
      {"DRILLING",
       "its_machining_strategy",
       0,
       {"MACHINING_STRATEGY_RELATIONSHIP('machining','drilling',#,#);",
        "DRILLING_TYPE_STRATEGY('',$,'','');"}},
      {"MULTISTEP_DRILLING", "retract_distance", 0,
       property("retract distance", "multistep drilling", length_item())},
      {"MULTISTEP_DRILLING", "first_depth", 0, property("first depth", "multistep drilling", length_item())},
      {"MULTISTEP_DRILLING", "depth_of_step", 0,
       property("depth of step", "multistep drilling", length_item())},
      {"MULTISTEP_DRILLING",
       "dwell_time_step",
       0,
       {"ACTION_PROPERTY('dwell time step','multistep drilling',#);",
        "MACHINING_DWELL_TIME_REPRESENTATION('dwell time',(#),#);", time_item("dwell time")}},
      {"REAMING", "spindle_stop_at_bottom", 0,
       property("spindle stop", "reaming", text_item("spindle stop at bottom"))},
      {"REAMING", "spindle_stop_at_bottom", 1,
       property("spindle stop", "reaming", text_item("spindle nonstop"))},
      {"BORING", "depth_of_testcut", 0, property("testcut depth", "boring", length_item())},
      {"BORING", "waiting_position", 0,
       property("waiting position", "boring", "CARTESIAN_POINT('',(10.,20.,30.5));")},
      {"TAPPING", "compensation_chuck", 0,
       property("compensation chuck", "tapping", text_item("compensation chuck used"))},
      {"TAPPING", "compensation_chuck", 1,
       property("compensation chuck", "tapping", text_item("compensation chuck not used"))},
      {"THREAD_DRILLING", "helical_movement_on_forward", 0,
       property("helical movement on forward", "thread drilling", text_item("helical movement on forward"))},
      {"THREAD_DRILLING", "helical_movement_on_forward", 1,
       property("helical movement on forward", "thread drilling",
                text_item("no helical movement on forward"))},
  };
  for (const Line& line : lines) check(line);
}

TEST(Operation, LeadsToWhatItUses) {
  const Line lines[] = {
      {"PLANE_FINISH_MILLING", "start_point", 0,
       property("cut start point", "finishing", "CARTESIAN_POINT('',(10.,20.,30.5));")},
      {"PLANE_FINISH_MILLING",
       "its_technology",
       0,
       {"MACHINING_TECHNOLOGY_RELATIONSHIP('','finishing',#,#);",
        "MACHINING_TECHNOLOGY('','milling','','');"}},
      {"PLANE_FINISH_MILLING",
       "its_machine_functions",
       0,
       {"MACHINING_FUNCTIONS_RELATIONSHIP('','finishing',#,#);", "MACHINING_FUNCTIONS('','milling','','');"}},
      {"PLANE_FINISH_MILLING",
       "its_tool_direction",
       0,
       {"ACTION_PROPERTY('tool direction','finishing',#);",
        "MACHINING_TOOL_DIRECTION_REPRESENTATION('three axes',(#),#);"}},
      {"PLANE_FINISH_MILLING",
       "approach",
       0,
       {"MACHINING_STRATEGY_RELATIONSHIP('approach','finishing',#,#);",
        "MACHINING_APPROACH_RETRACT_STRATEGY('','plunge toolaxis','','');"}},
      {"PLANE_FINISH_MILLING", "retract", 0, {"MACHINING_STRATEGY_RELATIONSHIP('retract','finishing',#,#);"}},
      {"PLANE_FINISH_MILLING",
       "its_machining_strategy",
       0,
       {"MACHINING_STRATEGY_RELATIONSHIP('machining','finishing',#,#);",
        "MILLING_TYPE_STRATEGY('','center milling','','');"}},
      {"FREEFORM_ROUGH_MILLING",
       "its_machining_strategy",
       0,
       {"MACHINING_STRATEGY_RELATIONSHIP('machining','roughing',#,#);",
        "FREEFORM_MILLING_STRATEGY('','uv','','');"}},
      {"PLANE_FINISH_MILLING",
       "its_broadcasts",
       0,
       {"MACHINING_STRATEGY_RELATIONSHIP('broadcast','finishing',#,#);",
        "MACHINING_BROADCAST_STRATEGY('each','broadcast count','','');"}},
      {"EXTENDED_OPERATION", "its_technology", 0, {"MACHINING_TECHNOLOGY_RELATIONSHIP('','',#,#);"}},
      {"EXTENDED_OPERATION", "its_machine_functions", 0, {"MACHINING_FUNCTIONS_RELATIONSHIP('','',#,#);"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Operation, OfEveryKindComesBackWhole) {
  for (const TypeId t : concrete({TypeId::kOperation})) check_whole(t);
}

// A workplan with one workingstep whose operation is #20.
std::string one_step(const std::string& operation) {
  return "#1=MACHINING_PROJECT('p','',$,(#2));\n#2=PRODUCT_CONTEXT('',#3,'');\n#3=APPLICATION_CONTEXT('');\n"
         "#4=PRODUCT_DEFINITION_FORMATION('','',#1);\n#5=PRODUCT_DEFINITION('','',#4,#6);\n"
         "#6=PRODUCT_DEFINITION_CONTEXT('',#3,'');\n#7=PRODUCT_DEFINITION_PROCESS('machining','',#9,'');\n"
         "#8=PROCESS_PRODUCT_ASSOCIATION('','',#5,#7);\n#9=MACHINING_WORKPLAN('main','','','');\n"
         "#10=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#12,1.);\n"
         "#12=MACHINING_WORKINGSTEP('ws','machining','','');\n#13=MACHINING_OPERATION_RELATIONSHIP('','',#12,"
         "#20);\n" +
         operation;
}

const std::string kInch =
    "#50=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#51=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE("
    "25.4),#50);\n"
    "#52=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n#53=(CONVERSION_BASED_UNIT('INCH',#51)LENGTH_UNIT()"
    "NAMED_UNIT(#52));\n"
    "#55=REPRESENTATION_CONTEXT('','');\n";

std::string depth(int id, const std::string& name, const std::string& value) {
  const auto n = [&](int k) { return "#" + std::to_string(id + k); };
  return n(0) + "=ACTION_PROPERTY('" + name + "','',#20);\n" + n(1) +
         "=ACTION_PROPERTY_REPRESENTATION('',''," + n(0) + "," + n(2) + ");\n" + n(2) +
         "=REPRESENTATION('',(" + n(3) + "),#55);\n" + n(3) +
         "=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()" + "MEASURE_WITH_UNIT(" + value +
         ")REPRESENTATION_ITEM(''));\n";
}

const model::MachiningWorkingstep& step_of(const model::Plan& plan) {
  const auto steps = plan.model.all_below(TypeId::kMachiningWorkingstep);
  EXPECT_EQ(steps.size(), 1u);
  return plan.model.at<model::MachiningWorkingstep>(steps.front());
}

TEST(Operation, ReadsInchesBesideMillimetresAndLeavesOpenWhatHasNoValue) {
  const auto plan = read_text(file_of(one_step("#20=DRILLING_OPERATION('d','drilling','','');\n") + kInch +
                                      depth(60, "cutting depth", "LENGTH_MEASURE(1.5),#53") +
                                      depth(70, "previous diameter", "LENGTH_MEASURE(8.),#50") +
                                      depth(80, "overcut length", "$,#50")));
  const auto* drilling = plan.model.get<model::Drilling>(step_of(plan).its_operation);
  ASSERT_NE(drilling, nullptr);
  EXPECT_NEAR(drilling->cutting_depth.value_or(0), 38.1, 1e-12);
  EXPECT_NEAR(drilling->previous_diameter.value_or(0), 8.0, 1e-12);
  EXPECT_FALSE(drilling->overcut_length.has_value());
}

TEST(Operation, OfTurningIsKeptAndStaysConnected) {
  std::vector<std::string> said;
  const auto plan = read_text(file_of(one_step("#20=FACING_TURNING_OPERATION('face','finishing','','');\n"
                                               "#21=ACTION_PROPERTY('allowance','finishing',#20);\n"
                                               "#22=MACHINING_TECHNOLOGY_RELATIONSHIP('','',#20,#23);\n"
                                               "#23=MACHINING_TECHNOLOGY('','turning','','');\n")),
                              &said);
  const auto& step = step_of(plan);
  ASSERT_EQ(step.its_operation.type, TypeId::kKeptInstance);
  EXPECT_EQ(plan.model.at<model::KeptInstance>(step.its_operation).keyword, "FACING_TURNING_OPERATION");
  EXPECT_THAT(said, ::testing::Contains(
                        ::testing::HasSubstr("FACING_TURNING_OPERATION is kept as it is and not acted on")));
  const auto lines = shapes(written(plan).bytes);
  EXPECT_THAT(lines, ::testing::Contains("FACING_TURNING_OPERATION('face','finishing','','');"));
  EXPECT_THAT(lines, ::testing::Contains("MACHINING_OPERATION_RELATIONSHIP('','machining',#,#);"));
  EXPECT_THAT(lines, ::testing::Contains("ACTION_PROPERTY('allowance','finishing',#);"));
  EXPECT_THAT(lines, ::testing::Contains("MACHINING_TECHNOLOGY('','turning','','');"));
  EXPECT_EQ(lost_on_the_way(plan), "");
}

TEST(Workingstep, OfTurningIsKeptWhereItStands) {
  const auto plan = read_text(file_of(
      "#1=MACHINING_PROJECT('p','',$,(#2));\n#2=PRODUCT_CONTEXT('',#3,'');\n#3=APPLICATION_CONTEXT('');\n"
      "#4=PRODUCT_DEFINITION_FORMATION('','',#1);\n#5=PRODUCT_DEFINITION('','',#4,#6);\n"
      "#6=PRODUCT_DEFINITION_CONTEXT('',#3,'');\n#7=PRODUCT_DEFINITION_PROCESS('machining','',#9,'');\n"
      "#8=PROCESS_PRODUCT_ASSOCIATION('','',#5,#7);\n#9=MACHINING_WORKPLAN('main','','','');\n"
      "#10=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#12,2.);\n"
      "#11=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#14,1.);\n"
      "#12=MACHINING_WORKINGSTEP('turn','turning','','');\n#13=MACHINING_OPERATION_RELATIONSHIP('','',#12,#"
      "20);\n"
      "#14=MACHINING_NC_FUNCTION('stop','program stop','','');\n"
      "#20=FACING_TURNING_OPERATION('face','finishing','','');\n"));
  const auto& plan_steps =
      plan.model.at<model::Workplan>(plan.model.at<model::Project>(plan.project).main_workplan).its_elements;
  ASSERT_EQ(plan_steps.size(), 2u);
  EXPECT_EQ(plan_steps.items[0].type, TypeId::kProgramStop);
  ASSERT_EQ(plan_steps.items[1].type, TypeId::kKeptInstance);
  EXPECT_EQ(plan.model.at<model::KeptInstance>(plan_steps.items[1]).keyword, "MACHINING_WORKINGSTEP");
  EXPECT_EQ(lost_on_the_way(plan), "");
}

}  // namespace
}  // namespace capstan::exchange::ap238::process
