// Workplans, workingsteps, program structures, expressions and functions, attribute by attribute.

#include <memory>

#include "tests/files/exchange/ap238/process/process_support.h"

namespace capstan::exchange::ap238::process {
namespace {

std::vector<std::string> product_by(const std::string& name) {
  return {"PRODUCT_DEFINITION_PROCESS('" + name + "',$,#,'');", "PROCESS_PRODUCT_ASSOCIATION('','',#,#);"};
}

TEST(Executable, HasTheAttributesThatEditionsTwoToFourAdd) {
  const Line lines[] = {
      {"WORKPLAN", "its_id", 0, {"MACHINING_WORKPLAN('a text',$,'','');"}},
      {"WORKPLAN", "enabled", 0, property("enabled", "", text_item("enabled"))},
      {"MACHINING_WORKINGSTEP", "enabled", 1, property("enabled", "machining", text_item("disabled"))},
      {"MACHINING_WORKINGSTEP", "as_is", 0, product_by("as-is shape")},
      {"WORKPLAN", "to_be", 0, product_by("to-be shape")},
      {"PROGRAM_STOP", "removal", 0, product_by("removal shape")},
      {"MACHINING_WORKINGSTEP", "fixture", 0, product_by("fixture shape")},
      {"WORKPLAN", "twin_source", 0, property("twin source", "", text_item("a text"))},
      {"WORKPLAN", "twin_exception", 0, property("twin exception", "", text_item("a text"))},
      {"WORKPLAN", "twin_worktime", 0, property("twin worktime", "", time_item())},
      {"WORKPLAN", "twin_plan", 0, {"MACHINING_TWIN_RELATIONSHIP('',$,#,#);"}},
      {"WORKPLAN",
       "start_content",
       0,
       {"MACHINING_BROADCAST_CONTENT_RELATIONSHIP('start content',$,#,#);",
        "MACHINING_BROADCAST_CONTENT('content',$,'','');"}},
      {"MACHINING_WORKINGSTEP",
       "end_content",
       0,
       {"MACHINING_BROADCAST_CONTENT_RELATIONSHIP('end content',$,#,#);"}},
      {"WORKPLAN", "its_broadcasts", 0, {"MACHINING_STRATEGY_RELATIONSHIP('broadcast','',#,#);"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Workplan, HasItsOrderAndItsOrientation) {
  const Line lines[] = {
      {"WORKPLAN",
       "its_elements",
       0,
       {"MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('',$,#,#,1.);",
        "MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('',$,#,#,2.);"}},
      {"WORKPLAN",
       "its_channel",
       0,
       {"ACTION_PROPERTY('channel','',#);", "ACTION_PROPERTY_REPRESENTATION('','',#,#);",
        "REPRESENTATION('channel',(#),#);", text_item("1")}},
      {"WORKPLAN", "toolpath_orientation", 0,
       property("toolpath orientation", "", "AXIS2_PLACEMENT_3D('',#,$,$);")},
  };
  for (const Line& line : lines) check(line);
}

TEST(Workplan, IsOrderedByTheNumbersAndNotByTheFile) {
  const auto plan = read_text(file_of(
      "#1=MACHINING_PROJECT('p','',$,(#2));\n#2=PRODUCT_CONTEXT('',#3,'');\n#3=APPLICATION_CONTEXT('');\n"
      "#4=PRODUCT_DEFINITION_FORMATION('','',#1);\n#5=PRODUCT_DEFINITION('','',#4,#6);\n#6=PRODUCT_"
      "DEFINITION_CONTEXT('',#3,'');\n"
      "#7=PRODUCT_DEFINITION_PROCESS('machining','',#9,'');\n#8=PROCESS_PRODUCT_ASSOCIATION('','',#5,#7);\n"
      "#9=MACHINING_WORKPLAN('main','','','');\n#10=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#20,3.);"
      "\n"
      "#11=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#9,#21,1.);\n#12=MACHINING_PROCESS_SEQUENCE_"
      "RELATIONSHIP('','',#9,#22,2);\n"
      "#20=MACHINING_NC_FUNCTION('c','program stop','','');\n#21=MACHINING_NC_FUNCTION('a','optional "
      "stop','','');\n"
      "#22=MACHINING_NC_FUNCTION('b','set mark','','');\n"));
  const auto& steps =
      plan.model.at<model::Workplan>(plan.model.at<model::Project>(plan.project).main_workplan).its_elements;
  ASSERT_EQ(steps.size(), 3u);
  EXPECT_EQ(steps.items[0].type, TypeId::kOptionalStop);
  EXPECT_EQ(steps.items[1].type, TypeId::kSetMark);
  EXPECT_EQ(steps.items[2].type, TypeId::kProgramStop);
}

TEST(Workingstep, HasItsPlaneAndItsOrientation) {
  const Line lines[] = {
      {"MACHINING_WORKINGSTEP", "its_id", 0, {"MACHINING_WORKINGSTEP('a text','machining','','');"}},
      {"MACHINING_WORKINGSTEP", "its_secplane", 0, property("security plane", "machining", "PLANE('',#);")},
      {"MACHINING_WORKINGSTEP", "toolpath_orientation", 0,
       property("toolpath orientation", "machining", "AXIS2_PLACEMENT_3D('',#,$,$);")},
      {"MACHINING_WORKINGSTEP",
       "its_operation",
       0,
       {"MACHINING_OPERATION_RELATIONSHIP('','machining',#,#);"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(ProgramStructure, IsToldByItsDescriptionAndItsRelations) {
  const Line lines[] = {
      {"PARALLEL",
       "branches",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','parallel','','');",
        "MACHINING_PROCESS_CONCURRENT_RELATIONSHIP('',$,#,#);"}},
      {"NON_SEQUENTIAL",
       "its_elements",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','non-sequential','','');",
        "MACHINING_PROCESS_BODY_RELATIONSHIP('',$,#,#);"}},
      {"SELECTIVE",
       "its_elements",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','selective','','');",
        "MACHINING_PROCESS_BRANCH_RELATIONSHIP('',$,#,#);"}},
      {"IF_STATEMENT",
       "condition",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','if statement','','');",
        "ACTION_PROPERTY('condition','if statement',#);",
        "(BINARY_GENERIC_EXPRESSION((#,#))BOOLEAN_EXPRESSION()COMPARISON_EXPRESSION()COMPARISON_LESS()"
        "EXPRESSION()"
        "EXPRESSION_REPRESENTATION_ITEM()GENERIC_EXPRESSION()REPRESENTATION_ITEM(''));"}},
      {"IF_STATEMENT", "true_branch", 0, {"MACHINING_PROCESS_BRANCH_RELATIONSHIP('true branch',$,#,#);"}},
      {"IF_STATEMENT", "false_branch", 0, {"MACHINING_PROCESS_BRANCH_RELATIONSHIP('false branch',$,#,#);"}},
      {"WHILE_STATEMENT",
       "condition",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','while statement','','');",
        "ACTION_PROPERTY('condition','while statement',#);"}},
      {"WHILE_STATEMENT", "body", 0, {"MACHINING_PROCESS_BODY_RELATIONSHIP('',$,#,#);"}},
      {"ASSIGNMENT",
       "its_lvalue",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','assignment','','');", "ACTION_PROPERTY('lvalue','assignment',#);",
        "(EXPRESSION()EXPRESSION_REPRESENTATION_ITEM()GENERIC_EXPRESSION()GENERIC_VARIABLE()NUMERIC_"
        "EXPRESSION()NUMERIC_VARIABLE()"
        "REAL_NUMERIC_VARIABLE()REPRESENTATION_ITEM('V1')SIMPLE_GENERIC_EXPRESSION()SIMPLE_NUMERIC_"
        "EXPRESSION()VARIABLE());"}},
      {"ASSIGNMENT", "its_rvalue", 0, {"ACTION_PROPERTY('rvalue','assignment',#);"}},
      {"PLANNING_OPERATION",
       "description",
       0,
       {"MACHINING_PROCESS_EXECUTABLE('','planning operation','','');",
        "ACTION_PROPERTY('description','planning operation',#);"}},
      {"PLANNING_OPERATION", "its_elements", 0, {"MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('',$,#,#,2.);"}},
  };
  for (const Line& line : lines) check(line);
}

TEST(Expression, HasNamesAndValues) {
  const std::string literal =
      "(EXPRESSION()EXPRESSION_REPRESENTATION_ITEM()GENERIC_EXPRESSION()GENERIC_LITERAL()LITERAL_NUMBER(2.5)"
      "NUMERIC_EXPRESSION()REAL_LITERAL()REPRESENTATION_ITEM('')SIMPLE_GENERIC_EXPRESSION()"
      "SIMPLE_NUMERIC_EXPRESSION());";
  check({"NC_VARIABLE",
         "initial_value",
         0,
         {"REPRESENTATION_ITEM_RELATIONSHIP('','initial value',#,#);", literal}});
  check({"NC_CONSTANT", "its_value", 0, {literal}});
}

TEST(Expression, OfEveryKindComesBackWhole) {
  Bench bench;
  auto& m = bench.plan.model;
  const std::vector<TypeId> expressions[] = {{TypeId::kBooleanExpression}};
  const auto leaf = [&] { return sample(bench, expressions[0]); };
  for (const TypeId t : concrete({TypeId::kBooleanExpression})) {
    const AnyRef at = m.add_object(t);
    for (const auto& a : model::noun_type(t).attributes) {
      if (a.storage == model::Storage::kRefList) {
        for (int i = 0; i < 3; ++i) put(m, at, std::string(a.name), leaf());
      } else {
        put(m, at, std::string(a.name), sample(bench, a.targets));
      }
    }
    model::IfStatement statement;
    statement.condition = model::Ref<model::BooleanExpression>(at);
    bench.step(std::move(statement));
  }
  EXPECT_EQ(written(bench.plan).losses, std::vector<std::string>{});
  EXPECT_EQ(lost_on_the_way(bench.plan), "");
}

TEST(Expression, KeepsTheOrderOfItsOperands) {
  const auto plan = read_text(file_of(
      "#1=MACHINING_PROCESS_EXECUTABLE('','while statement','','');\n#2=ACTION_PROPERTY('condition','',#1);\n"
      "#3=ACTION_PROPERTY_REPRESENTATION('','',#2,#4);\n#4=REPRESENTATION('',(#5),#90);\n"
      "#5=EXPRESSION_ITEM_REPRESENTATION_ITEM('',#6);\n#6=COMPARISON_GREATER((#7,#8));\n#7=REAL_NUMERIC_"
      "VARIABLE();\n#8=INT_LITERAL(4);\n"
      "#9=EXPRESSION_ITEM_REPRESENTATION_ITEM('depth',#7);\n#90=REPRESENTATION_CONTEXT('','');\n"));
  const auto all = plan.model.all_below(TypeId::kWhileStatement);
  ASSERT_EQ(all.size(), 1u);
  const auto* greater =
      plan.model.get<model::ComparisonGreater>(plan.model.at<model::WhileStatement>(all.front()).condition);
  ASSERT_NE(greater, nullptr);
  const auto* variable = plan.model.get<model::NcVariable>(greater->operand1);
  const auto* constant = plan.model.get<model::NcConstant>(greater->operand2);
  ASSERT_NE(variable, nullptr);
  ASSERT_NE(constant, nullptr);
  EXPECT_EQ(variable->its_name, "depth");
  EXPECT_EQ(constant->its_value, 4.0);
}

TEST(Expression, OfEditionFourStandsInAnItem) {
  const auto plan = read_text(
      file_of("#1=MACHINING_PROCESS_EXECUTABLE('','assignment','','');\n#2=ACTION_PROPERTY('lvalue','',#1);\n"
              "#3=ACTION_PROPERTY_REPRESENTATION('','',#2,#4);\n#4=REPRESENTATION('',(#5),#90);\n"
              "#5=EXPRESSION_ITEM_REPRESENTATION_ITEM('depth',#6);\n#6=INT_NUMERIC_VARIABLE();\n"
              "#7=REPRESENTATION_ITEM_RELATIONSHIP('','initial "
              "value',#5,#8);\n#8=EXPRESSION_ITEM_REPRESENTATION_ITEM('',#9);\n#9=INT_LITERAL(4);\n"
              "#12=ACTION_PROPERTY('rvalue','',#1);\n#13=ACTION_PROPERTY_REPRESENTATION('','',#12,#14);\n#14="
              "REPRESENTATION('',(#15),#90);\n"
              "#15=EXPRESSION_ITEM_REPRESENTATION_ITEM('limit',#16);\n#16=REAL_LITERAL(2.5);\n#90="
              "REPRESENTATION_CONTEXT('','');\n"));
  const auto all = plan.model.all_below(TypeId::kAssignment);
  ASSERT_EQ(all.size(), 1u);
  const auto& assignment = plan.model.at<model::Assignment>(all.front());
  const auto* variable = plan.model.get<model::NcVariable>(assignment.its_lvalue);
  const auto* constant = plan.model.get<model::NcConstant>(assignment.its_rvalue);
  ASSERT_NE(variable, nullptr);
  ASSERT_NE(constant, nullptr);
  EXPECT_EQ(variable->its_name, "depth");
  EXPECT_EQ(variable->initial_value, 4.0);
  EXPECT_EQ(constant->its_name, "limit");
  EXPECT_EQ(constant->its_value, 2.5);
}

TEST(Workplan, HasAnEffectOfShapes) {
  const auto plan =
      read_text(file_of("#1=MACHINING_WORKPLAN('main','','','');\n#2=ACTION_PROPERTY('as-is "
                        "shape','',#1);\n#3=ACTION_PROPERTY_REPRESENTATION('','',#2,#4);\n"
                        "#4=ADVANCED_BREP_SHAPE_REPRESENTATION('',(#5),#90);\n#5=AXIS2_PLACEMENT_3D('',#6,$,$"
                        ");\n#6=CARTESIAN_POINT('',(0.,0.,0.));\n"
                        "#90=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#91))"
                        "REPRESENTATION_CONTEXT('',''));\n"
                        "#91=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"));
  const auto all = plan.model.all_below(TypeId::kWorkplan);
  ASSERT_EQ(all.size(), 1u);
  const auto* effect =
      plan.model.get<model::InProcessGeometry>(plan.model.at<model::Workplan>(all.front()).its_effect);
  ASSERT_NE(effect, nullptr);
  EXPECT_TRUE(effect->as_is.set());
  EXPECT_FALSE(effect->removal.set());
  EXPECT_THAT(shapes(written(plan).bytes), ::testing::Contains("ACTION_PROPERTY('as-is shape','',#);"));
}

TEST(NcFunction, IsToldByItsDescription) {
  const auto function = [](const char* description) {
    return std::vector<std::string>{std::string("MACHINING_NC_FUNCTION('a text','") + description +
                                    "','','');"};
  };
  const Line lines[] = {
      {"DISPLAY_MESSAGE", "its_id", 0, function("display message")},
      {"OPTIONAL_STOP", "its_id", 0, function("optional stop")},
      {"PROGRAM_STOP", "its_id", 0, function("program stop")},
      {"SET_MARK", "its_id", 0, function("set mark")},
      {"WAIT_FOR_MARK", "its_id", 0, function("wait for mark")},
      {"EXCHANGE_PALLET", "its_id", 0, function("exchange pallet")},
      {"INDEX_PALLET", "its_id", 0, function("index pallet")},
      {"INDEX_TABLE", "its_id", 0, function("index table")},
      {"LOAD_TOOL", "its_id", 0, function("load tool")},
      {"UNLOAD_TOOL", "its_id", 0, function("unload tool")},
      {"EXTENDED_NC_FUNCTION", "its_id", 0, function("extended function")},
      {"LOAD_TOOL", "its_tool", 0, {"MACHINING_TOOL('T9','touch probe',(#),#);"}},
      {"UNLOAD_TOOL", "its_tool", 0, {"MACHINING_TOOL('T9','touch probe',(#),#);"}},
      {"DISPLAY_MESSAGE", "its_text", 0, property("message text", "display message", text_item("a text"))},
      {"WAIT_FOR_MARK",
       "its_channel",
       0,
       {"ACTION_PROPERTY('channel','wait for mark',#);", "REPRESENTATION('channel',(#),#);"}},
      {"INDEX_PALLET", "its_index", 0, property("pallet index", "index pallet", kCount3)},
      {"INDEX_TABLE", "its_index", 0, property("table index", "index table", kCount3)},
      {"EXTENDED_NC_FUNCTION", "extended_description", 0,
       property("description", "extended function", text_item("a text"))},
  };
  for (const Line& line : lines) check(line);
}

TEST(NcFunction, OfEditionThreeIsCalledLegacy) {
  const auto plan = read_text(
      file_of("#1=MACHINING_NC_FUNCTION('coolant','legacy function','','');\n#2=ACTION_PROPERTY('function "
              "text','',#1);\n"
              "#3=ACTION_PROPERTY_REPRESENTATION('','',#2,#4);\n#4=REPRESENTATION('',(#5),#90);\n"
              "#5=DESCRIPTIVE_REPRESENTATION_ITEM('','M8');\n#90=REPRESENTATION_CONTEXT('','');\n"));
  const auto all = plan.model.all_below(TypeId::kExtendedNcFunction);
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(plan.model.at<model::ExtendedNcFunction>(all.front()).extended_description, "M8");
}

TEST(Executable, OfEveryKindComesBackWhole) {
  for (const TypeId t : concrete({TypeId::kExecutable})) {
    std::vector<std::string> others = {"persistent_id"};  // a record of the plan, see records_test.cpp
    // A feature knows its operations when it is read, and toolpaths follow an orientation: each has a test of
    // its own.
    if (t == TypeId::kMachiningWorkingstep)
      others.insert(others.end(), {"its_feature", "toolpath_orientation"});
    check_whole(t, others);
  }
}

/// Instances of a written file, followed along their references.
class Chain {
 public:
  explicit Chain(std::string bytes) {
    Job job;
    auto file = p21::parse(std::move(bytes), "t.stpnc", {}, job);
    EXPECT_TRUE(file.has_value());
    if (file) file_ = std::make_unique<p21::File>(std::move(*file));
  }
  [[nodiscard]] std::vector<p21::Instance> all(const std::string& keyword) const {
    std::vector<p21::Instance> out;
    for (const p21::Instance i : *file_) {
      if (i.keyword() == keyword) out.push_back(i);
    }
    return out;
  }
  /// The instances of that kind whose parameter refers to this one.
  [[nodiscard]] std::vector<p21::Instance> users(const p21::Instance& of, const std::string& keyword,
                                                 std::size_t parameter) const {
    std::vector<p21::Instance> out;
    for (const auto& i : all(keyword)) {
      const auto v = i.part(0).parameters[parameter];
      if (v.is(p21::Kind::kReference) && v.reference() == of.id()) out.push_back(i);
    }
    return out;
  }
  [[nodiscard]] p21::Instance to(const p21::Instance& from, std::size_t parameter) const {
    return *file_->find(from.part(0).parameters[parameter].reference());
  }
  [[nodiscard]] static std::string text(const p21::Instance& i, std::size_t parameter) {
    return std::string(i.part(0).parameters[parameter].as_text());
  }

 private:
  std::unique_ptr<p21::File> file_;
};

// workingstep . final_features: relating_method <- machining_final_feature_relationship -> related_method
// machining_feature_process <- chosen_method property_process{name 'machining'} <- process
// process_property_association -> property_or_shape, the feature.
TEST(Workingstep, ReachesItsFinalFeaturesByProcessesOfTheirOwn) {
  check(
      {"MACHINING_WORKINGSTEP",
       "final_features",
       0,
       {"MACHINING_FINAL_FEATURE_RELATIONSHIP('','machining',#,#);",
        "MACHINING_FEATURE_PROCESS('','machining','','');", "PROPERTY_PROCESS('machining','machining',#,'');",
        "PROCESS_PROPERTY_ASSOCIATION('','machining',#,#);"}});
  Bench bench;
  const AnyRef at = placed(bench, TypeId::kMachiningWorkingstep);
  auto& step = bench.plan.model.at<model::MachiningWorkingstep>(at);
  step.its_id = "last cut";
  give(bench, at, *model::find_attribute(at.type, "final_features"), 0);
  const Written out = written(bench.plan);
  const Chain file(out.bytes);
  const auto relations = file.all("MACHINING_FINAL_FEATURE_RELATIONSHIP");
  ASSERT_EQ(relations.size(), 2U);
  std::vector<std::string> reached;
  for (const auto& relation : relations) {
    EXPECT_EQ(Chain::text(file.to(relation, 2), 0), "last cut");
    const auto process = file.to(relation, 3);
    EXPECT_EQ(process.keyword(), "MACHINING_FEATURE_PROCESS");
    const auto actions = file.users(process, "PROPERTY_PROCESS", 2);
    ASSERT_EQ(actions.size(), 1U);
    const auto associations = file.users(actions[0], "PROCESS_PROPERTY_ASSOCIATION", 2);
    ASSERT_EQ(associations.size(), 1U);
    const auto feature = file.to(associations[0], 3);
    const std::string line = "#" + std::to_string(feature.id()) + "=";
    const auto at_line = out.bytes.find("\n" + line);
    ASSERT_NE(at_line, std::string::npos);
    reached.push_back(out.bytes.substr(at_line + 1, out.bytes.find('\n', at_line + 1) - at_line - 1));
  }
  EXPECT_THAT(reached,
              ::testing::ElementsAre(::testing::HasSubstr("INSTANCED_FEATURE('','toolpath','feature 0'"),
                                     ::testing::HasSubstr("INSTANCED_FEATURE('','toolpath','feature 1'")));
  EXPECT_TRUE(file.all("MACHINING_FEATURE_RELATIONSHIP").empty());  // they are not the feature it works on
}

// executable . process_properties and operation . process_properties: action_method <- definition
// machining_process_property, with its parameters in a representation.
TEST(ProcessProperty, StandsAtExecutablesAndAtOperations) {
  struct Case {
    const char* noun;
    const char* keyword;
  };
  for (const Case& c :
       {Case{"WORKPLAN", "MACHINING_WORKPLAN"}, Case{"MACHINING_WORKINGSTEP", "MACHINING_WORKINGSTEP"},
        Case{"PROGRAM_STOP", "MACHINING_NC_FUNCTION"}, Case{"IF_STATEMENT", "MACHINING_PROCESS_EXECUTABLE"},
        Case{"PLANE_FINISH_MILLING", "PLANE_MILLING_OPERATION"}, Case{"DRILLING", "DRILLING_OPERATION"},
        Case{"TAPPING", "TAPPING_OPERATION"}, Case{"REAMING", "BORING_OPERATION"}}) {
    SCOPED_TRACE(c.noun);
    check({c.noun,
           "process_properties",
           0,
           {"MACHINING_PROCESS_PROPERTY('bound by','the operator',#);",
            "ACTION_PROPERTY_REPRESENTATION('','',#,#);", "REPRESENTATION('',(#,#),#);",
            "DESCRIPTIVE_REPRESENTATION_ITEM('M','M8');"}});
    Bench bench;
    const AnyRef at = placed(bench, noun(c.noun));
    *static_cast<model::Text*>(model::find_attribute(at.type, "its_id")->at(bench.plan.model.object(at))) =
        "holder";
    give(bench, at, *model::find_attribute(at.type, "process_properties"), 0);
    const Chain file(written(bench.plan).bytes);
    const auto properties = file.all("MACHINING_PROCESS_PROPERTY");
    ASSERT_EQ(properties.size(), 2U);
    for (const auto& property : properties) {
      EXPECT_EQ(file.to(property, 2).keyword(), c.keyword);
      EXPECT_EQ(Chain::text(file.to(property, 2), 0), "holder");
      EXPECT_EQ(file.users(property, "ACTION_PROPERTY_REPRESENTATION", 2).size(), 1U);
    }
  }
}

}  // namespace
}  // namespace capstan::exchange::ap238::process
