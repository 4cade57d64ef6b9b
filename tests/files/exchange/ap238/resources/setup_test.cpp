// Set-ups, usages of tools, fixtures and machines, and what a machine must be able to do.

#include "tests/files/exchange/ap238/resources/resource_support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;

// --- usages ---

template <class Give>
Case usage_case(const std::string& what, Give give, std::vector<std::string> instances) {
  return {what,
          [=](Bench& b) {
            model::Model& m = b.plan.model;
            model::ToolUsage usage;
            usage.its_id = "in pocket 7";
            give(b, usage);
            model::TouchProbe probe;
            probe.its_id = "P1";
            probe.its_usage = m.add(std::move(usage));
            model::LoadTool load;
            load.its_tool = m.add(std::move(probe));
            b.step(std::move(load));
          },
          std::move(instances)};
}

TEST(ToolUsage, HasEachOfItsAttributes) {
  check(usage_case(
      "id", [](auto&, auto&) {},
      {"REQUIREMENT_FOR_ACTION_RESOURCE('','',#,(#),(#));", "RESOURCE_REQUIREMENT_TYPE('tool usage','');",
       "MACHINING_TOOL_USAGE('in pocket 7',$,'','');"}));
  check(usage_case("description", [](auto&, auto& u) { u.description = "roughing tool"; },
                   {"MACHINING_TOOL_USAGE('in pocket 7','roughing tool','','');"}));
  check(usage_case("position", [](auto&, auto& u) { u.its_position = "7"; },
                   {"ACTION_PROPERTY('tool position','',#);", word_of("", "7")}));
  check(usage_case("carousel", [](auto&, auto& u) { u.its_carousel = "A"; },
                   {"ACTION_PROPERTY('tool carousel','',#);", word_of("", "A")}));
  check(usage_case(
      "product", [](auto& b, auto& u) { u.its_product = b.workpiece; },
      {"PRODUCT_DEFINITION_PROCESS('tool usage',$,#,'');", "PROCESS_PRODUCT_ASSOCIATION('','',#,#);"}));
  check(usage_case("gage", [](auto& b, auto& u) { u.gage_placement = placement(b.plan.model, 0, 0, 120); },
                   {"ACTION_PROPERTY('gage placement','',#);", "CARTESIAN_POINT('',(0.,0.,120.));"}));
  check(usage_case("tool end",
                   [](auto& b, auto& u) { u.tool_end_placement = placement(b.plan.model, 0, 0, -5); },
                   {"ACTION_PROPERTY('tool end placement','',#);", "CARTESIAN_POINT('',(0.,0.,-5.));"}));
  check(usage_case("library",
                   [](auto&, auto& u) {
                     u.its_library_reference = "EM-20-4";
                     u.its_library_source = "ISO 13399 catalogue";
                   },
                   {"ACTION_PROPERTY('library reference','',#);",
                    "EXTERNALLY_DEFINED_REPRESENTATION_WITH_PARAMETERS('',(#),#);",
                    "APPLIED_CLASSIFICATION_ASSIGNMENT(#,#,(#));",
                    "EXTERNALLY_DEFINED_CLASS('',$,IDENTIFIER('EM-20-4'),#);",
                    "EXTERNAL_SOURCE(IDENTIFIER('ISO 13399 catalogue'));"}));
  check(usage_case(
      "library of unknown source", [](auto&, auto& u) { u.its_library_reference = "EM-20-4"; },
      {"EXTERNALLY_DEFINED_CLASS('',$,IDENTIFIER('EM-20-4'),#);", "EXTERNAL_SOURCE(IDENTIFIER(''));"}));
}

TEST(FixtureUsage, HasEachOfItsAttributes) {
  check({"fixture usage",
         [](Bench& b) {
           model::Model& m = b.plan.model;
           model::FixtureUsage usage;
           usage.its_id = "vise";
           usage.description = "left jaw fixed";
           usage.its_product = b.workpiece;
           usage.mount_reference = placement(m, 1, 0, 0);
           usage.workpiece_reference = placement(m, 0, 2, 0);
           model::Setup setup;
           setup.its_id = "S1";
           setup.its_fixture_usage = m.add(std::move(usage));
           setup.its_workpiece_setup.given = true;
           model::Plane plane;
           plane.position = placement(m, 0, 0, 50);
           setup.its_secplane = m.add(std::move(plane));
           m.at<model::Workplan>(b.workplan).its_setup = m.add(std::move(setup));
           b.step(model::OptionalStop{});
         },
         {"PRODUCT_DEFINITION_PROCESS('fixture usage',$,#,'');",
          "MACHINING_FIXTURE_USAGE('vise','left jaw fixed','','');",
          "PRODUCT_DEFINITION_PROCESS('fixture workpiece',$,#,'');",
          "ACTION_PROPERTY('mount reference','',#);", "CARTESIAN_POINT('',(1.,0.,0.));",
          "ACTION_PROPERTY('workpiece reference','',#);", "CARTESIAN_POINT('',(0.,2.,0.));"}});
}

TEST(MachineUsage, HasEachOfItsAttributes) {
  check({"machine usage",
         [](Bench& b) {
           model::MachineUsage usage;
           usage.its_id = "M12";
           usage.description = "hall 3";
           usage.its_product = b.workpiece;
           b.plan.model.at<model::Workplan>(b.workplan).machine_used = b.plan.model.add(std::move(usage));
           b.step(model::OptionalStop{});
         },
         {"MACHINING_MACHINE_USAGE('M12','hall 3','','');",
          "PRODUCT_DEFINITION_PROCESS('machine usage',$,#,'');"}});
}

// --- machine parameters ---

template <class Give>
Case machine_case(const std::string& what, Give give, std::vector<std::string> instances) {
  instances.emplace_back("MACHINING_EXECUTION_RESOURCE('',$,(#),#);");
  return {what,
          [=](Bench& b) {
            model::MachineParameters p;
            give(b.plan.model, p);
            b.plan.model.at<model::Workplan>(b.workplan).its_minimum_machine_params =
                b.plan.model.add(std::move(p));
            b.step(model::OptionalStop{});
          },
          std::move(instances)};
}

std::string has(const std::string& property) { return "RESOURCE_PROPERTY('" + property + "','',#);"; }

TEST(MachineParameters, HaveEachOfTheirAttributes) {
  using P = model::MachineParameters;
  check(machine_case("feed", [](auto&, P& p) { p.feedrate = 9000.0; },
                     {has("feedrate"), "MACHINING_FEED_SPEED_REPRESENTATION('feed speed',(#),#);",
                      number_of("feed speed", "9000.")}));
  check(machine_case("speed", [](auto&, P& p) { p.spindle_speed = 12000.0; },
                     {has("spindle"), "MACHINING_SPINDLE_SPEED_REPRESENTATION('spindle speed',(#),#);",
                      number_of("rotational speed", "12000.")}));
  check(machine_case("power", [](auto&, P& p) { p.spindle_power = 15000.0; },
                     {has("spindle power"), number_of("", "15000.")}));
  check(machine_case("torque", [](auto&, P& p) { p.spindle_torque = 96.0; },
                     {has("spindle torque"), number_of("", "96.")}));
  check(machine_case("axes", [](auto&, P& p) { p.number_of_control_axis = 5; },
                     {has("number of control axis"), count_of("", "5.")}));
  check(machine_case("axes at once", [](auto&, P& p) { p.number_of_simultaneous_axis = 3; },
                     {has("number of simultaneous axis"), count_of("", "3.")}));
  check(machine_case("indexing", [](auto&, P& p) { p.table_indexing = true; },
                     {has("table indexing"), word_of("", "required")}));
  check(machine_case("no indexing", [](auto&, P& p) { p.table_indexing = false; },
                     {has("table indexing"), word_of("", "not required")}));
  const std::pair<const char*, model::Real P::*> kLengths[] = {
      {"positioning accuracy", &P::positioning_accuracy},
      {"table length", &P::table_length},
      {"table width", &P::table_width},
      {"work volume length", &P::work_volume_length},
      {"work volume width", &P::work_volume_width},
      {"work volume height", &P::work_volume_height}};
  for (const auto& [name, member] : kLengths) {
    check(machine_case(name, [member](auto&, P& p) { p.*member = 2.5; }, {has(name), length_of("")}));
  }
  check(machine_case("travel",
                     [](model::Model& m, P& p) {
                       model::MachineAxisTravel x, c;
                       x.axis_identifier = "X";
                       x.travel_distance = 600.0;
                       c.axis_identifier = "C";
                       c.travel_angle = 6.25;
                       p.axis_travel.push_back(m.add(std::move(x)));
                       p.axis_travel.push_back(m.add(std::move(c)));
                     },
                     {has("axis travel"), length_of("X", "600."), angle_of("C", "6.25")}));
}

// --- set-ups ---

/// A set-up of the main workplan with one workpiece in it.
struct SetupBench {
  Ref<model::Setup> setup;
  Ref<model::WorkpieceSetup> inside;
  explicit SetupBench(Bench& b) {
    model::Model& m = b.plan.model;
    inside = m.add<model::WorkpieceSetup>();
    m.at<model::WorkpieceSetup>(inside).its_workpiece = b.workpiece;
    m.at<model::WorkpieceSetup>(inside).its_origin = placement(m, 10, 20, 30);
    m.at<model::WorkpieceSetup>(inside).its_instructions.given = true;
    model::Plane plane;
    plane.position = placement(m, 0, 0, 50);
    model::Setup s;
    s.its_id = "S1";
    s.its_secplane = m.add(std::move(plane));
    s.its_workpiece_setup.push_back(inside);
    setup = m.add(std::move(s));
    m.at<model::Workplan>(b.workplan).its_setup = setup;
    b.step(model::OptionalStop{});
  }
};

template <class Give>
Case setup_case(const std::string& what, Give give, std::vector<std::string> instances) {
  return {what,
          [=](Bench& b) {
            SetupBench s(b);
            give(b, s);
          },
          std::move(instances)};
}

TEST(Setup, HasEachOfItsAttributes) {
  check(setup_case(
      "id and plane", [](auto&, auto&) {},
      {"MACHINING_SETUP('S1','',$,(#));", "PRODUCT_DEFINITION_PROCESS('setup',$,#,'');",
       "PROPERTY_DEFINITION('security plane',$,#);", "PLANE('',#);", "CARTESIAN_POINT('',(0.,0.,50.));",
       "MACHINING_SETUP_WORKPIECE_RELATIONSHIP('','',$,#,#);"}));
  check(setup_case("origin",
                   [](Bench& b, SetupBench& s) {
                     b.plan.model.at<model::Setup>(s.setup).its_origin = placement(b.plan.model, 150, 90, 40);
                   },
                   {"AXIS2_PLACEMENT_3D('orientation',#,$,$);", "CARTESIAN_POINT('',(150.,90.,40.));"}));
  check(setup_case("two workpieces",
                   [](Bench& b, SetupBench& s) {
                     model::Model& m = b.plan.model;
                     model::WorkpieceSetup other;
                     other.its_workpiece = b.workpiece;
                     other.its_origin = placement(m, 210, 20, 30);
                     other.its_instructions.given = true;
                     const auto r = m.add(std::move(other));
                     m.at<model::Setup>(s.setup).its_workpiece_setup.push_back(r);
                   },
                   {"CARTESIAN_POINT('',(210.,20.,30.));"}));
}

TEST(WorkpieceSetup, HasItsOriginAsATransformation) {
  check(setup_case("origin", [](auto&, auto&) {},
                   {"PRODUCT_DEFINITION_SHAPE('',$,#);", "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#,#);",
                    "(REPRESENTATION_RELATIONSHIP('',$,#,#)REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#)"
                    "SHAPE_REPRESENTATION_RELATIONSHIP());",
                    "ITEM_DEFINED_TRANSFORMATION('',$,#,#);", "CARTESIAN_POINT('',(10.,20.,30.));"}));
}

// In AP238 the relation says itself whose it is, so two set-ups cannot have the same.
TEST(WorkpieceSetup, OfTwoSetupsIsWrittenForEachOfThem) {
  Bench b;
  SetupBench s(b);
  model::Model& m = b.plan.model;
  model::SetupInstruction instruction;
  instruction.description = "clean the faces";
  m.at<model::WorkpieceSetup>(s.inside).its_instructions.push_back(m.add(std::move(instruction)));
  model::Setup second;
  second.its_id = "S2";
  second.its_workpiece_setup.push_back(s.inside);
  second.its_secplane = m.at<model::Setup>(s.setup).its_secplane;
  model::Workplan inner;
  inner.its_id = "second clamping";
  inner.its_setup = m.add(std::move(second));
  inner.its_elements.push_back(m.add(model::OptionalStop{}));
  b.step(std::move(inner));
  const Written out = written(b.plan);
  EXPECT_EQ(out.losses, std::vector<std::string>{});
  EXPECT_EQ(faults(out.bytes), std::vector<std::string>{}) << out.bytes;
  const model::Plan back = read_text(out.bytes);
  const auto setups = back.model.all(model::TypeId::kSetup);
  ASSERT_EQ(setups.size(), 2U);
  std::vector<AnyRef> met;
  for (const AnyRef at : setups) {
    const auto& setup = back.model.at<model::Setup>(at);
    ASSERT_EQ(setup.its_workpiece_setup.size(), 1U) << out.bytes;
    met.push_back(setup.its_workpiece_setup[0]);
    const auto& inside = back.model.at<model::WorkpieceSetup>(met.back());
    EXPECT_TRUE(inside.its_workpiece.set());
    const auto& origin = back.model.at<model::Axis2Placement3d>(inside.its_origin);
    EXPECT_EQ(back.model.at<model::CartesianPoint>(origin.location).coordinates.items,
              (std::vector<double>{10, 20, 30}));
    ASSERT_EQ(inside.its_instructions.size(), 1U) << out.bytes;
    EXPECT_EQ(back.model.at<model::SetupInstruction>(inside.its_instructions[0]).description,
              "clean the faces");
  }
  EXPECT_NE(met[0], met[1]);
}

TEST(WorkpieceSetup, HasInstructionsInOrder) {
  check(setup_case("instructions",
                   [](Bench& b, SetupBench& s) {
                     model::Model& m = b.plan.model;
                     model::SetupInstruction first, second;
                     first.description = "clean the jaws";
                     second.external_document = "DOC-7";
                     for (auto* i : {&first, &second}) {
                       const auto r = m.add(std::move(*i));
                       m.at<model::WorkpieceSetup>(s.inside).its_instructions.push_back(r);
                     }
                   },
                   {"PRODUCT_DEFINITION_PROCESS('setup instructions',$,#,'');",
                    "MACHINING_PROCESS_EXECUTABLE('','setup instructions','','');",
                    "MACHINING_OPERATOR_INSTRUCTION_RELATIONSHIP('',$,#,#,1.);",
                    "MACHINING_OPERATOR_INSTRUCTION_RELATIONSHIP('',$,#,#,2.);",
                    "MACHINING_OPERATOR_INSTRUCTION('','clean the jaws','','',(#));",
                    "MACHINING_OPERATOR_INSTRUCTION('',$,'','',(#));", "DOCUMENT('DOC-7','',$,#);"}));
}

TEST(WorkpieceSetup, HasAnOffsetByVariables) {
  check(setup_case(
      "offset",
      [](Bench& b, SetupBench& s) {
        model::Model& m = b.plan.model;
        model::OffsetVector offset;
        for (int i = 0; i < 6; ++i) {
          model::NcVariable v;
          v.its_name = "V" + std::to_string(i);
          v.initial_value = 1.5 * i;
          auto& list = i < 3 ? offset.translate : offset.rotate;
          list.push_back(m.add(std::move(v)));
        }
        m.at<model::WorkpieceSetup>(s.inside).its_offset = m.add(std::move(offset));
      },
      {"PROPERTY_DEFINITION('computed offset',$,#);", "MACHINING_OFFSET_VECTOR_REPRESENTATION('',(#,#),#);",
       "COMPOUND_REPRESENTATION_ITEM('translate',LIST_REPRESENTATION_ITEM((#,#,#)));",
       "COMPOUND_REPRESENTATION_ITEM('rotate',LIST_REPRESENTATION_ITEM((#,#,#)));"}));
}

TEST(WorkpieceSetup, HasARestrictedAreaOfAnyForm) {
  check(setup_case(
      "block",
      [](Bench& b, SetupBench& s) {
        model::Model& m = b.plan.model;
        model::Block block;
        block.position = placement(m, -5, -5, 0);
        block.x = 110.0;
        block.y = 120.0;
        block.z = 10.0;
        m.at<model::WorkpieceSetup>(s.inside).its_restricted_area = m.add(std::move(block));
      },
      {"PROPERTY_DEFINITION('restricted area',$,#);", "BLOCK_SHAPE_REPRESENTATION('',(#,#,#,#),#);",
       length_of("length", "110."), length_of("width", "120."), length_of("height", "10.")}));
  check(setup_case(
      "surface",
      [](Bench& b, SetupBench& s) {
        model::Model& m = b.plan.model;
        model::BezierSurface surface;
        surface.u_degree = 1;
        surface.v_degree = 1;
        surface.control_points_list.given = true;
        for (const double u : {0.0, 10.0}) {
          surface.control_points_list.items.emplace_back();
          for (const double v : {0.0, 5.0})
            surface.control_points_list.items.back().push_back(point(m, u, v, 0));
        }
        surface.surface_form = model::BSplineSurfaceForm::kPlaneSurf;
        surface.u_closed = model::Logical3::kFalse;
        surface.v_closed = model::Logical3::kFalse;
        surface.self_intersect = model::Logical3::kFalse;
        m.at<model::WorkpieceSetup>(s.inside).its_restricted_area = m.add(std::move(surface));
      },
      {"GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION('',(#),#);", "GEOMETRIC_SET('',(#));"}));
}

TEST(Setup, OfAnnexJIsReadToTheValue) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  Job job;
  const auto plan = exchange::read(path, job);
  ASSERT_TRUE(plan);
  const auto& m = plan->model;
  const auto setups = m.all(model::TypeId::kSetup);
  ASSERT_EQ(setups.size(), 1U);
  const auto& setup = m.at<model::Setup>(setups.front());
  EXPECT_EQ(setup.its_id, "SETUP1");
  const auto at = [&](AnyRef placement) {
    return m.at<model::CartesianPoint>(m.at<model::Axis2Placement3d>(placement).location).coordinates.items;
  };
  EXPECT_EQ(at(setup.its_origin), (std::vector<double>{150, 90, 40}));
  EXPECT_EQ(at(m.at<model::Plane>(setup.its_secplane).position), (std::vector<double>{0, 0, 30}));
  ASSERT_EQ(setup.its_workpiece_setup.size(), 1U);
  const auto& inside = m.at<model::WorkpieceSetup>(setup.its_workpiece_setup[0]);
  EXPECT_EQ(m.at<model::Workpiece>(inside.its_workpiece).its_id, "SIMPLE WORKPIECE");
  EXPECT_EQ(at(inside.its_origin), (std::vector<double>{0, 0, 0}));
  const auto& offset = m.at<model::OffsetVector>(inside.its_offset);
  EXPECT_EQ(offset.translate.size(), 3U);
  EXPECT_EQ(offset.rotate.size(), 3U);
}

}  // namespace
}  // namespace capstan::exchange::ap238
