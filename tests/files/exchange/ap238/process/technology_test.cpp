// Technology and machine functions, attribute by attribute.

#include "tests/files/exchange/ap238/process/process_support.h"

namespace capstan::exchange::ap238::process {
namespace {

TEST(Technology, HasSpeedsInRepresentationsOfTheirOwn) {
  const auto speed = [](const char* name, const char* entity, const char* kind, const char* item,
                        const std::string& value) {
    return std::vector<std::string>{
        std::string("ACTION_PROPERTY('") + name + "','milling',#);",
        std::string("ACTION_PROPERTY_REPRESENTATION('") + item + "','milling',#,#);",
        std::string(entity) + "('" + kind + "',(#),#);", value};
  };
  const Line lines[] = {
      {"MILLING_TECHNOLOGY", "feedrate", 0,
       speed("feedrate", "MACHINING_FEED_SPEED_REPRESENTATION", "feed speed", "feed speed",
             number_item("feed speed"))},
      {"MILLING_TECHNOLOGY", "feedrate_per_tooth", 0,
       speed("feedrate", "MACHINING_FEED_SPEED_REPRESENTATION", "feed per tooth", "feed per tooth",
             length_item("feed per tooth"))},
      {"MILLING_TECHNOLOGY", "spindle", 0,
       speed("spindle", "MACHINING_SPINDLE_SPEED_REPRESENTATION", "spindle speed", "rotational speed",
             number_item("rotational speed"))},
      {"MILLING_TECHNOLOGY", "cutspeed", 0,
       speed("spindle", "MACHINING_SPINDLE_SPEED_REPRESENTATION", "cutting speed", "surface speed",
             number_item("surface speed"))},
  };
  for (const Line& line : lines) check(line);
}

TEST(Technology, SpellsItsChoicesAsTheMappingDoes) {
  const Line lines[] = {
      {"MILLING_TECHNOLOGY", "feedrate_reference", 0,
       property("feedrate reference", "milling", text_item("tool center point"))},
      {"MILLING_TECHNOLOGY", "feedrate_reference", 1,
       property("feedrate reference", "milling", text_item("cutter contact point"))},
      {"MILLING_TECHNOLOGY", "synchronize_spindle_with_feed", 0,
       property("synchronize spindle with feed", "milling", text_item("synchronized"))},
      {"MILLING_TECHNOLOGY", "synchronize_spindle_with_feed", 1,
       property("synchronize spindle with feed", "milling", text_item("not synchronized"))},
      {"MILLING_TECHNOLOGY", "inhibit_feedrate_override", 0,
       property("inhibit feedrate override", "milling", text_item("override not allowed"))},
      {"MILLING_TECHNOLOGY", "inhibit_feedrate_override", 1,
       property("inhibit feedrate override", "milling", text_item("override allowed"))},
      {"MILLING_TECHNOLOGY", "inhibit_spindle_override", 0,
       property("inhibit spindle override", "milling", text_item("override not allowed"))},
      {"MILLING_TECHNOLOGY", "inhibit_spindle_override", 1,
       property("inhibit spindle override", "milling", text_item("override allowed"))},
  };
  for (const Line& line : lines) check(line);
}

TEST(Functions, SpellTheirChoicesAsTheMappingDoes) {
  const std::map<std::string, std::string> switches = {{"coolant", "coolant"},
                                                       {"mist", "mist"},
                                                       {"through_spindle_coolant", "through spindle coolant"},
                                                       {"chip_removal", "chip removal"}};
  for (const auto& [attribute, name] : switches) {
    check({"MILLING_MACHINE_FUNCTIONS", attribute.c_str(), 0,
           property(name, "milling", text_item(name + " on"))});
    check({"MILLING_MACHINE_FUNCTIONS", attribute.c_str(), 1,
           property(name, "milling", text_item(name + " off"))});
  }
}

TEST(Functions, HavePressuresListsAndRelations) {
  const Line lines[] = {
      {"MILLING_MACHINE_FUNCTIONS", "coolant_pressure", 0,
       property("coolant pressure", "milling", number_item())},
      {"MILLING_MACHINE_FUNCTIONS", "through_pressure", 0,
       property("through spindle pressure", "milling", number_item())},
      {"MILLING_MACHINE_FUNCTIONS",
       "axis_clamping",
       0,
       {"ACTION_PROPERTY('axis clamping','milling',#);", "REPRESENTATION('',(#),#);",
        "COMPOUND_REPRESENTATION_ITEM('',LIST_REPRESENTATION_ITEM((#,#)));", text_item("first"),
        text_item("second")}},
      {"MILLING_MACHINE_FUNCTIONS", "oriented_spindle_stop", 0,
       property("oriented spindle stop", "milling", "DIRECTION('',(0.,0.6,0.8));")},
      {"PROCESS_MODEL",
       "its_type",
       0,
       {"MACHINING_PROCESS_MODEL_RELATIONSHIP('',$,#,#,1.);", "MACHINING_PROCESS_MODEL('','a text','','');"}},
      {"PROCESS_MODEL",
       "ini_data_file",
       0,
       {"ACTION_PROPERTY('initialization data','',#);", text_item("a text")}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Functions, HoldAxesWithinLimits) {
  Bench bench;
  auto& m = bench.plan.model;
  const AnyRef functions = placed(bench, TypeId::kMillingMachineFunctions);
  model::MachineAxisConstraint x, b;
  x.axis_identifier = "X";
  x.axis_minimum = -10.0;
  x.axis_maximum = 250.0;
  b.axis_identifier = "B";
  b.angle_minimum = -0.5;
  b.angle_maximum = 1.5;
  put(m, functions, "axis_constraints", m.add(std::move(x)));
  put(m, functions, "axis_constraints", m.add(std::move(b)));
  const auto lines = shapes(written(bench.plan).bytes);
  EXPECT_THAT(lines, ::testing::Contains("ACTION_PROPERTY('axis constraints','milling',#);"));
  EXPECT_THAT(lines, ::testing::Contains("REPRESENTATION('',(#,#),#);"));
  EXPECT_THAT(lines, ::testing::Contains("VALUE_RANGE('X',SET_REPRESENTATION_ITEM((#,#)));"));
  EXPECT_THAT(lines, ::testing::Contains("VALUE_RANGE('B',SET_REPRESENTATION_ITEM((#,#)));"));
  EXPECT_THAT(lines,
              ::testing::Contains(
                  "(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE("
                  "-10.),#)REPRESENTATION_ITEM('lower limit'));"));
  EXPECT_THAT(
      lines, ::testing::Contains("(MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(PLANE_ANGLE_MEASURE(1.5),#)"
                                 "PLANE_ANGLE_MEASURE_WITH_UNIT()REPRESENTATION_ITEM('upper limit'));"));
  EXPECT_EQ(lost_on_the_way(bench.plan), "");
}

TEST(Functions, AndTechnologyComeBackWhole) {
  for (const TypeId t : concrete({TypeId::kTechnology, TypeId::kMachineFunctions, TypeId::kProcessModel})) {
    check_whole(t);
  }
}

TEST(Technology, LeadsToAdaptiveControlThatIsKept) {
  const auto plan =
      read_text(file_of("#1=MACHINING_TECHNOLOGY('','milling','','');\n"
                        "#2=MACHINING_ADAPTIVE_CONTROL_RELATIONSHIP('','milling',#1,#3);\n"
                        "#3=MACHINING_TECHNOLOGY('','adaptive control','','');\n"));
  const auto all = plan.model.all_below(TypeId::kMillingTechnology);
  ASSERT_EQ(all.size(), 1u);
  const AnyRef control = plan.model.at<model::MillingTechnology>(all.front()).its_adaptive_control;
  ASSERT_EQ(control.type, TypeId::kKeptInstance);
  const auto lines = shapes(written(plan).bytes);
  EXPECT_THAT(lines, ::testing::Contains("MACHINING_ADAPTIVE_CONTROL_RELATIONSHIP('','milling',#,#);"));
  EXPECT_THAT(lines, ::testing::Contains("MACHINING_TECHNOLOGY('','adaptive control','','');"));
}

TEST(Technology, WithoutAUnitIsTakenInThePlansAndWarnedOf) {
  std::vector<std::string> said;
  const auto plan = read_text(
      file_of(
          "#1=MACHINING_TECHNOLOGY('','milling','','');\n"
          "#2=ACTION_PROPERTY('feedrate','milling',#1);\n#3=ACTION_PROPERTY_REPRESENTATION('','milling',#2,"
          "#4);\n#4=MACHINING_FEED_SPEED_REPRESENTATION('feed speed',(#5),#90);\n"
          "#5=MEASURE_REPRESENTATION_ITEM('feed speed',NUMERIC_MEASURE(10.),$);\n"
          "#6=ACTION_PROPERTY('spindle','milling',#1);\n#7=ACTION_PROPERTY_REPRESENTATION('','milling',#6,"
          "#8);\n#8=MACHINING_SPINDLE_SPEED_REPRESENTATION('spindle speed',(#9),#90);\n"
          "#9=MEASURE_REPRESENTATION_ITEM('rotational speed',NUMERIC_MEASURE(1000.),$);\n"
          "#90=REPRESENTATION_CONTEXT('','');\n"),
      &said);
  const auto& t =
      plan.model.at<model::MillingTechnology>(plan.model.all_below(TypeId::kMillingTechnology).front());
  EXPECT_EQ(t.feedrate.value_or(0), 10.0);
  EXPECT_EQ(t.spindle.value_or(0), 1000.0);
  using ::testing::AllOf;
  using ::testing::Contains;
  using ::testing::HasSubstr;
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("EXC-UNIT"), HasSubstr("#5"), HasSubstr("taken as mm/min"))));
  EXPECT_THAT(said, Contains(AllOf(HasSubstr("EXC-UNIT"), HasSubstr("#9"), HasSubstr("taken as 1/min"))));
}

TEST(Technology, OfAnotherUnitIsConverted) {
  // 10 in/min, 1000 rev/min as a derived unit of revolutions, 100 ft/min.
  const auto plan = read_text(file_of(
      "#1=MACHINING_TECHNOLOGY('','milling','','');\n"
      "#2=ACTION_PROPERTY('feedrate','milling',#1);\n#3=ACTION_PROPERTY_REPRESENTATION('','milling',#2,#4);\n"
      "#4=MACHINING_FEED_SPEED_REPRESENTATION('feed speed',(#5),#90);\n#5=MEASURE_REPRESENTATION_ITEM('feed "
      "speed',NUMERIC_MEASURE(10.),#30);\n"
      "#6=ACTION_PROPERTY('spindle','milling',#1);\n#7=ACTION_PROPERTY_REPRESENTATION('','milling',#6,#8);\n"
      "#8=MACHINING_SPINDLE_SPEED_REPRESENTATION('spindle speed',(#9),#90);\n"
      "#9=MEASURE_REPRESENTATION_ITEM('rotational speed',NUMERIC_MEASURE(1000.),#31);\n"
      "#10=ACTION_PROPERTY('spindle','milling',#1);\n#11=ACTION_PROPERTY_REPRESENTATION('','milling',#10,#12)"
      ";\n"
      "#12=MACHINING_SPINDLE_SPEED_REPRESENTATION('cutting speed',(#13),#90);\n"
      "#13=MEASURE_REPRESENTATION_ITEM('surface speed',NUMERIC_MEASURE(100.),#32);\n"
      "#20=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#21=LENGTH_MEASURE_WITH_UNIT(LENGTH_"
      "MEASURE(25.4),#20);\n"
      "#22=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n#23=(CONVERSION_BASED_UNIT('INCH',#21)LENGTH_UNIT()"
      "NAMED_UNIT(#22));\n"
      "#24=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(12.),#23);\n#25=(CONVERSION_BASED_UNIT('FOOT',#24)LENGTH_"
      "UNIT()NAMED_UNIT(#22));\n"
      "#26=(NAMED_UNIT(*)SI_UNIT($,.SECOND.)TIME_UNIT());\n#27=TIME_MEASURE_WITH_UNIT(TIME_MEASURE(60.),#26);"
      "\n"
      "#28=DIMENSIONAL_EXPONENTS(0.,0.,1.,0.,0.,0.,0.);\n#29=(CONVERSION_BASED_UNIT('MINUTE',#27)NAMED_UNIT(#"
      "28)TIME_UNIT());\n"
      "#30=DERIVED_UNIT((#33,#34));\n#31=DERIVED_UNIT((#34));\n#32=DERIVED_UNIT((#35,#34));\n"
      "#33=DERIVED_UNIT_ELEMENT(#23,1.);\n#34=DERIVED_UNIT_ELEMENT(#29,-1.);\n#35=DERIVED_UNIT_ELEMENT(#25,1."
      ");\n"
      "#90=REPRESENTATION_CONTEXT('','');\n"));
  const auto all = plan.model.all_below(TypeId::kMillingTechnology);
  ASSERT_EQ(all.size(), 1u);
  const auto& t = plan.model.at<model::MillingTechnology>(all.front());
  EXPECT_NEAR(t.feedrate.value_or(0), 254.0, 1e-9);
  EXPECT_NEAR(t.spindle.value_or(0), 1000.0, 1e-9);
  EXPECT_NEAR(t.cutspeed.value_or(0), 30480.0, 1e-6);
}

}  // namespace
}  // namespace capstan::exchange::ap238::process
