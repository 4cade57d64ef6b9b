// Workpieces: shapes, materials, what they are made from, assemblies.

#include "tests/files/exchange/ap238/resources/resource_support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;

// --- workpiece ---

TEST(Workpiece, HasItsNameOfDefinitionAndProduct) {
  check(workpiece_case("id", [](auto&, auto&) {},
                       {"PRODUCT_DEFINITION('part',$,#,#);", "PRODUCT('part','',$,(#));",
                        "MACHINING_PROJECT_WORKPIECE_RELATIONSHIP('','workpiece',$,#,#);"}));
  check(workpiece_case("revision", [](auto&, auto& w) { w.revision_id = "B.2"; },
                       {"PRODUCT_DEFINITION_FORMATION('B.2',$,#);"}));
}

TEST(Workpiece, HasAToleranceAndClampingPositions) {
  check(workpiece_case("tolerance", [](auto&, auto& w) { w.global_tolerance = 0.01; },
                       {"PROPERTY_DEFINITION('global tolerance',$,#);", "SHAPE_REPRESENTATION('',(#),#);",
                        length_of("", "0.01")}));
  check(workpiece_case("clamping",
                       [](auto& m, auto& w) {
                         w.clamping_positions.push_back(point(m, 0, 20, 25));
                         w.clamping_positions.push_back(point(m, 100, 20, 25));
                       },
                       {"PROPERTY_DEFINITION('clamping position',$,#);", "SHAPE_REPRESENTATION('',(#,#),#);",
                        "CARTESIAN_POINT('',(100.,20.,25.));"}));
}

TEST(Workpiece, IsBoundedByABlockOrACylinderAndMadeFromARawPiece) {
  check(workpiece_case(
      "block",
      [](auto& m, auto& w) {
        model::Block block;
        block.position = placement(m, 1, 2, 3);
        block.x = 100.0;
        block.y = 80.0;
        block.z = 25.0;
        w.its_bounding_geometry = m.add(std::move(block));
      },
      {"MAKE_FROM_USAGE_OPTION('','bounding geometry',$,#,#,0,'',#);",
       "BLOCK_SHAPE_REPRESENTATION('',(#,#,#,#),#);", "AXIS2_PLACEMENT_3D('orientation',#,$,$);",
       length_of("length", "100."), length_of("width", "80."), length_of("height", "25.")}));
  check(workpiece_case(
      "cylinder",
      [](auto& m, auto& w) {
        model::Axis1Placement axis;
        axis.location = point(m, 1, 2, 3);
        model::RightCircularCylinder cylinder;
        cylinder.position = m.add(std::move(axis));
        cylinder.height = 60.0;
        cylinder.radius = 20.0;
        w.its_bounding_geometry = m.add(std::move(cylinder));
      },
      {"CYLINDRICAL_SHAPE_REPRESENTATION('',(#,#,#),#);", "AXIS1_PLACEMENT('orientation',#,$);",
       length_of("length", "60."), length_of("diameter", "40.")}));
  check(workpiece_case("raw piece, with a bounding block of its own",
                       [](auto& m, auto& w) {
                         model::Block block;
                         block.position = placement(m, 1, 2, 3);
                         block.x = 100.0;
                         block.y = 80.0;
                         block.z = 25.0;
                         model::Workpiece raw;
                         raw.its_id = "stock";
                         raw.clamping_positions.given = true;
                         raw.its_bounding_geometry = m.add(std::move(block));
                         w.its_rawpiece = m.add(std::move(raw));
                       },
                       {"MAKE_FROM_USAGE_OPTION('','',$,#,#,0,'',#);", "PRODUCT_DEFINITION('stock',$,#,#);",
                        "MEASURE_WITH_UNIT(COUNT_MEASURE(1.),#);"}));
  check(workpiece_case("material workpiece",
                       [](auto& m, auto& w) {
                         model::Workpiece bar;
                         bar.its_id = "bar";
                         bar.clamping_positions.given = true;
                         w.material_workpiece = m.add(std::move(bar));
                       },
                       {"MAKE_FROM_USAGE_OPTION('','material workpiece',$,#,#,0,'',#);"}));
}

TEST(Workpiece, HasAMaterialWithParametersAndProperties) {
  check(workpiece_case(
      "material",
      [](auto& m, auto& w) {
        model::DescriptiveParameter text;
        text.parameter_name = "structure";
        text.descriptive_string = "annealed";
        model::NumericParameter number;
        number.parameter_name = "E";
        number.its_parameter_value = 210000.0;
        number.its_parameter_unit = "N/mm2";
        model::NumericParameter hardness;
        hardness.parameter_name = "HB";
        hardness.its_parameter_value = 180.0;
        hardness.its_parameter_unit = "HB 2.5";
        model::MaterialProperty property;
        property.name = "hardness";
        property.description = "as delivered";
        property.its_parameters.push_back(m.add(std::move(hardness)));
        model::Material material;
        material.material_identifier = "STEEL";
        material.standard_identifier = "ST-50";
        material.material_property.push_back(m.add(std::move(text)));
        material.material_property.push_back(m.add(std::move(number)));
        material.its_properties.push_back(m.add(std::move(property)));
        w.its_material = m.add(std::move(material));
      },
      {"MATERIAL_DESIGNATION('STEEL',(#));", "APPLIED_DOCUMENT_REFERENCE(#,'',(#));",
       "DOCUMENT('ST-50','',$,#);", "MATERIAL_DESIGNATION_CHARACTERIZATION('parameters','',#,#);",
       "MATERIAL_PROPERTY_REPRESENTATION(#,#,#);", word_of("structure", "annealed"),
       number_of("E", "210000."), "CONTEXT_DEPENDENT_UNIT(#,'N/mm2');",
       "MATERIAL_DESIGNATION_CHARACTERIZATION('','',#,#);", "MATERIAL_PROPERTY('hardness','as delivered',#);",
       number_of("HB", "180.")}));
}

TEST(Workpiece, HasAShapeFromIso14649AsARepresentation) {
  check(workpiece_case(
      "brep",
      [](auto& m, auto& w) {
        // One triangle suffices: topology is written as it is.
        model::AdvancedFace face;
        model::EdgeLoop loop;
        const double corners[3][3] = {{0, 0, 0}, {10, 0, 0}, {0, 10, 0}};
        std::vector<Ref<model::VertexPoint>> vertices;
        for (const auto& c : corners) {
          model::VertexPoint v;
          v.vertex_geometry = point(m, c[0], c[1], c[2]);
          vertices.push_back(m.add(std::move(v)));
        }
        for (std::size_t i = 0; i < 3; ++i) {
          const auto& a = corners[i];
          const auto& e = corners[(i + 1) % 3];
          model::Direction d;
          d.direction_ratios = {.items = {e[0] - a[0], e[1] - a[1], e[2] - a[2]}, .given = true};
          model::Vector along;
          along.orientation = m.add(std::move(d));
          along.magnitude = 1.0;
          model::Line line;
          line.pnt = point(m, a[0], a[1], a[2]);
          line.dir = m.add(std::move(along));
          model::EdgeCurve edge;
          edge.edge_start = vertices[i];
          edge.edge_end = vertices[(i + 1) % 3];
          edge.edge_geometry = m.add(std::move(line));
          edge.same_sense = true;
          model::OrientedEdge oriented;
          oriented.edge_element = m.add(std::move(edge));
          oriented.orientation = true;
          loop.edge_list.push_back(m.add(std::move(oriented)));
        }
        model::FaceOuterBound bound;
        bound.bound = m.add(std::move(loop));
        bound.orientation = true;
        face.bounds.push_back(m.add(std::move(bound)));
        model::Plane plane;
        plane.position = placement(m, 0, 0, 0);
        face.face_geometry = m.add(std::move(plane));
        face.same_sense = true;
        model::ClosedShell shell;
        shell.cfs_faces.push_back(m.add(std::move(face)));
        model::ManifoldSolidBrep solid;
        solid.outer = m.add(std::move(shell));
        model::AdvancedBrepShapeRepresentation shape;
        shape.name = "shape of the part";
        shape.items.push_back(m.add(std::move(solid)));
        w.its_geometry = m.add(std::move(shape));
      },
      {"SHAPE_DEFINITION_REPRESENTATION(#,#);",
       "ADVANCED_BREP_SHAPE_REPRESENTATION('shape of the part',(#),#);", "MANIFOLD_SOLID_BREP('',#);"}));
}

TEST(Workpiece, HasPartsWithTheirPlaces) {
  check(workpiece_case(
      "parts",
      [](auto& m, auto& w) {
        model::Workpiece child;
        child.its_id = "child";
        child.clamping_positions.given = true;
        model::NextAssemblyUsage usage;
        usage.its_id = "U1";
        usage.name = "left";
        usage.reference_designator = "R1";
        usage.child_workpiece = m.add(std::move(child));
        usage.item_transform = placement(m, 10, 0, 0);
        usage.item_transform_origin = placement(m, 0, 0, 5);
        w.its_components.push_back(m.add(usage));
        usage.its_id = "U2";
        usage.name = "right";
        usage.reference_designator = "R2";
        usage.item_transform = placement(m, 50, 0, 0);
        usage.item_transform_origin = {};
        w.its_components.push_back(m.add(usage));
      },
      {"NEXT_ASSEMBLY_USAGE_OCCURRENCE('U1','left',$,#,#,'R1');",
       "NEXT_ASSEMBLY_USAGE_OCCURRENCE('U2','right',$,#,#,'R2');",
       "CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#,#);", "ITEM_DEFINED_TRANSFORMATION('',$,#,#);",
       "CARTESIAN_POINT('',(10.,0.,0.));", "CARTESIAN_POINT('',(0.,0.,5.));"}));
}

TEST(Machine, WithKinematicsIsAProduct) {
  check(workpiece_case(
      "kinematics",
      [](auto& m, auto& w) {
        model::MachineWithKinematics machine;
        machine.its_id = "M12";
        machine.configuration = "C";
        machine.clamping_positions.given = true;
        w.material_workpiece = m.add(std::move(machine));
      },
      {"PROPERTY_DEFINITION('configuration',$,#);", word_of("", "C"), "PRODUCT_DEFINITION('M12',$,#,#);"}));
}

// --- files of others ---

TEST(Workpiece, HasTheNameOfItsProductWhereTheDefinitionHasNone) {
  const auto id = [](const std::string& definition, const std::string& product) {
    const model::Plan plan = read_text(
        file_of("#1=MACHINING_PROJECT('p','',$,());\n#2=PRODUCT_DEFINITION_FORMATION('','',#1);\n#3=PRODUCT_"
                "DEFINITION('','',#2,$);\n"
                "#4=MACHINING_PROJECT_WORKPIECE_RELATIONSHIP('','','',#3,#5);\n#5=PRODUCT_DEFINITION(" +
                definition +
                ",'',#6,$);\n"
                "#6=PRODUCT_DEFINITION_FORMATION('1.0','',#7);\n#7=PRODUCT(" +
                product + ",'',());\n"));
    const auto& p = plan.model.at<model::Project>(plan.project);
    if (p.its_workpieces.size() != 1) return std::string("?");
    return plan.model.at<model::Workpiece>(p.its_workpieces[0]).its_id.value_or("none");
  };
  EXPECT_EQ(id("'a'", "'b','c'"), "a");
  EXPECT_EQ(id("''", "'b','c'"), "b");
  EXPECT_EQ(id("$", "'b','c'"), "b");
  EXPECT_EQ(id("''", "'','c'"), "c");
}

TEST(Workpiece, WhoseShapeIsABlockIsBoundedByIt) {
  const model::Plan plan = read_text(file_of(
      "#1=MACHINING_PROJECT('p','',$,());\n#2=PRODUCT_DEFINITION_FORMATION('','',#1);\n#3=PRODUCT_DEFINITION("
      "'','',#2,$);\n"
      "#4=MACHINING_PROJECT_WORKPIECE_RELATIONSHIP('','','',#3,#5);\n#5=PRODUCT_DEFINITION('part','',#6,$);\n"
      "#6=PRODUCT_DEFINITION_FORMATION('1.0','',#7);\n#7=PRODUCT('part','','',());\n#8=MAKE_FROM_USAGE_"
      "OPTION('','','',#5,#9,0,'',$);\n"
      "#9=PRODUCT_DEFINITION('stock','',#10,$);\n#10=PRODUCT_DEFINITION_FORMATION('1.0','',#11);\n#11="
      "PRODUCT('stock','','',());\n"
      "#12=PRODUCT_DEFINITION_SHAPE('','',#9);\n#13=SHAPE_DEFINITION_REPRESENTATION(#12,#14);\n"
      "#14=BLOCK_SHAPE_REPRESENTATION('',(#15,#16,#17,#18),#20);\n#15=AXIS2_PLACEMENT_3D('orientation',#19,$,"
      "$);\n"
      "#19=CARTESIAN_POINT('',(1.,0.,0.));\n" +
      [] {
        std::string items;
        const char* names[] = {"length", "width", "height"};
        for (int i = 0; i < 3; ++i) {
          items +=
              "#" + std::to_string(16 + i) +
              "=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(" +
              std::to_string(i + 2) + ".),#24)REPRESENTATION_ITEM('" + names[i] + "'));\n";
        }
        return items;
      }() +
      "#20=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#21))REPRESENTATION_CONTEXT('"
      "INCH','3D'));\n"
      "#21=(CONVERSION_BASED_UNIT('inch',#22)LENGTH_UNIT()NAMED_UNIT(#23));\n#23=DIMENSIONAL_EXPONENTS(1.,0.,"
      "0.,0.,0.,0.,0.);\n"
      "#22=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#24);\n#24=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(."
      "MILLI.,.METRE.));\n"));
  const auto& m = plan.model;
  const auto& part = m.at<model::Workpiece>(m.at<model::Project>(plan.project).its_workpieces[0]);
  const auto& stock = m.at<model::Workpiece>(part.its_rawpiece);
  const auto& block = m.at<model::Block>(stock.its_bounding_geometry);
  EXPECT_EQ(block.x, 2.0);
  EXPECT_EQ(block.y, 3.0);
  EXPECT_EQ(block.z, 4.0);
  // The sizes have a unit of their own, the point has that of the context.
  const auto& at = m.at<model::CartesianPoint>(m.at<model::Axis2Placement3d>(block.position).location);
  EXPECT_EQ(at.coordinates.items, (std::vector<double>{25.4, 0, 0}));
  EXPECT_EQ(lost_on_the_way(plan), "");
}

TEST(Workpiece, OfAnInchFileKeepsItsShapeVerbatimWithItsUnits) {
  std::vector<std::string> said;
  const model::Plan plan = read_text(file_of("#1=MACHINING_PROJECT('p','',$,());\n#2=PRODUCT_DEFINITION_"
                                             "FORMATION('','',#1);\n#3=PRODUCT_DEFINITION('','',#2,$);\n"
                                             "#4=MACHINING_PROJECT_WORKPIECE_RELATIONSHIP('','','',#3,#5);\n#"
                                             "5=PRODUCT_DEFINITION('part','',#6,$);\n"
                                             "#6=PRODUCT_DEFINITION_FORMATION('1.0','',#7);\n#7=PRODUCT('"
                                             "part','','',());\n#8=PRODUCT_DEFINITION_SHAPE('','',#5);\n"
                                             "#9=SHAPE_DEFINITION_REPRESENTATION(#8,#10);\n#10=FACETED_BREP_"
                                             "SHAPE_REPRESENTATION('f',(#11),#12);\n"
                                             "#11=FACETED_BREP('solid',#13);\n#13=CLOSED_SHELL('',());\n"
                                             "#12=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_"
                                             "CONTEXT((#14))REPRESENTATION_CONTEXT('INCH','3D'));\n"
                                             "#14=(CONVERSION_BASED_UNIT('inch',#15)LENGTH_UNIT()NAMED_UNIT(#"
                                             "17));\n#17=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n"
                                             "#15=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#16);\n#16=("
                                             "LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
                                             "#18=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',"
                                             "(#19),#12);\n#19=STYLED_ITEM('',(),#11);\n"),
                                     &said);
  for (const auto& s : said) EXPECT_EQ(s.find("EXC-KEPT"), std::string::npos) << s;
  const auto& w =
      plan.model.at<model::Workpiece>(plan.model.at<model::Project>(plan.project).its_workpieces[0]);
  ASSERT_TRUE(plan.model.holds<model::KeptInstance>(w.its_geometry));
  EXPECT_EQ(w.its_styled_models.size(), 1U);
  const auto lines = shapes(written(plan).bytes);
  for (const char* wanted :
       {"SHAPE_DEFINITION_REPRESENTATION(#,#);", "FACETED_BREP_SHAPE_REPRESENTATION('f',(#),#);",
        "FACETED_BREP('solid',#);",
        "(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#))REPRESENTATION_CONTEXT('INCH','"
        "3D'));",
        "(CONVERSION_BASED_UNIT('inch',#)LENGTH_UNIT()NAMED_UNIT(#));", "STYLED_ITEM('',(),#);",
        "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('',(#),#);"}) {
    EXPECT_EQ(std::count(lines.begin(), lines.end(), wanted), 1) << wanted;
  }
}

const model::Workpiece* find(const model::Plan& plan, const std::string& id) {
  for (const AnyRef w : plan.model.all(model::TypeId::kWorkpiece)) {
    const auto& found = plan.model.at<model::Workpiece>(w);
    if (found.its_id == id) return &found;
  }
  return nullptr;
}

TEST(Workpiece, OfAnnexJ3IsReadToTheValue) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  Job job;
  const auto plan = exchange::read(path, job);
  ASSERT_TRUE(plan);
  const auto& m = plan->model;
  const auto* part = find(*plan, "SIMPLE WORKPIECE");
  const auto* stock = find(*plan, "STOCK");
  ASSERT_NE(part, nullptr);
  ASSERT_NE(stock, nullptr);
  EXPECT_EQ(part->global_tolerance, 0.01);
  EXPECT_EQ(m.get<model::Workpiece>(part->its_rawpiece), stock);
  EXPECT_FALSE(part->its_bounding_geometry.set());
  EXPECT_FALSE(stock->its_rawpiece.set());
  ASSERT_EQ(part->clamping_positions.size(), 4U);
  EXPECT_EQ(m.at<model::CartesianPoint>(part->clamping_positions[3]).coordinates.items,
            (std::vector<double>{100, 100, 25}));
  const auto& block = m.at<model::Block>(stock->its_bounding_geometry);
  EXPECT_EQ(block.x, 100.0);
  EXPECT_EQ(block.y, 100.0);
  EXPECT_EQ(block.z, 100.0);
  EXPECT_EQ(AnyRef(part->its_material), AnyRef(stock->its_material));
  const auto& material = m.at<model::Material>(part->its_material);
  EXPECT_EQ(material.material_identifier, "STEEL");
  EXPECT_EQ(material.standard_identifier, "ST-50");
  ASSERT_EQ(material.material_property.size(), 1U);
  EXPECT_EQ(m.at<model::DescriptiveParameter>(material.material_property[0]).parameter_name, "E=200000N/M2");
}

TEST(Workpiece, OfAnnexJ2HasItsPartsShapesAndProductData) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc2.stp");
  Job job;
  const auto plan = exchange::read(path, job);
  ASSERT_TRUE(plan);
  const auto& m = plan->model;
  const auto* top = find(*plan, "WP");
  const auto* child = find(*plan, "WORKPIECE COMPONENT");
  ASSERT_NE(top, nullptr);
  ASSERT_NE(child, nullptr);
  EXPECT_EQ(top->revision_id, "1.0");
  EXPECT_EQ(m.get<model::Workpiece>(top->its_rawpiece), find(*plan, "RAW"));
  ASSERT_EQ(top->its_components.size(), 1U);
  const auto& usage = m.at<model::NextAssemblyUsage>(top->its_components[0]);
  EXPECT_EQ(m.get<model::Workpiece>(usage.child_workpiece), child);
  EXPECT_TRUE(m.holds<model::Axis2Placement3d>(usage.item_transform));
  EXPECT_TRUE(m.holds<model::Axis2Placement3d>(usage.item_transform_origin));
  EXPECT_EQ(m.at<model::KeptInstance>(child->its_geometry).keyword, "SHAPE_REPRESENTATION");
  ASSERT_EQ(child->its_related_geometry.size(), 1U);
  EXPECT_EQ(m.at<model::KeptInstance>(child->its_related_geometry[0]).keyword,
            "ADVANCED_BREP_SHAPE_REPRESENTATION");
  ASSERT_EQ(child->its_approvals.size(), 1U);
  const auto& approval = m.at<model::Approval>(child->its_approvals[0]);
  EXPECT_EQ(m.at<model::ApprovalStatus>(approval.status).name, "not_yet_approved");
  EXPECT_EQ(child->its_timestamps.size(), 1U);
  EXPECT_EQ(child->product_people.size(), 1U);
  EXPECT_EQ(child->revision_approvals.size(), 1U);
  ASSERT_EQ(child->revision_people.size(), 2U);
  EXPECT_EQ(m.at<model::PersonOrganizationAssignment>(child->revision_people[1]).role, "creator");
  const auto& revision = m.at<model::Approval>(child->revision_approvals[0]);
  ASSERT_EQ(revision.approvers.size(), 1U);
  EXPECT_EQ(m.at<model::ApprovingPersonOrganization>(revision.approvers[0]).role, "approver");
  EXPECT_TRUE(revision.approval_date_time.set());
  const model::Plan back = read_text(written(*plan).bytes);
  EXPECT_EQ(testing::ModelDifference(*plan, back, {.item_names = false, .left_out = {}}).text(), "");
}

}  // namespace
}  // namespace capstan::exchange::ap238
