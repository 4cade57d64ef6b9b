// Shapes of parts and entities of other processes: kept as they are, and still connected to what was read.

#include <memory>
#include <set>

#include "planner/files/p21/read/parse.h"
#include "tests/files/exchange/ap238/part/feature_support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using ::testing::Contains;
using ::testing::HasSubstr;

/// A written file, to follow its references in.
class Instances {
 public:
  explicit Instances(std::string bytes) {
    Job job;
    auto file = p21::parse(std::move(bytes), "written.stpnc", {}, job);
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
  [[nodiscard]] p21::Instance only(const std::string& keyword) const {
    const auto found = all(keyword);
    EXPECT_EQ(found.size(), 1U) << keyword;
    return found.front();
  }
  /// What a parameter refers to; a list's first.
  [[nodiscard]] p21::Instance to(const p21::Instance& from, std::size_t parameter) const {
    p21::Value v = from.part(from.part_count() - 1).parameters[parameter];
    if (v.is(p21::Kind::kList)) v = v[0];
    const auto found = file_->find(v.reference());
    EXPECT_TRUE(found.has_value()) << from.keyword() << " refers to nothing";
    return *found;
  }
  /// The text parameter of a simple instance.
  [[nodiscard]] static std::string text(const p21::Instance& i, std::size_t parameter) {
    return std::string(i.part(0).parameters[parameter].as_text());
  }

 private:
  std::unique_ptr<p21::File> file_;
};

/// A project and one part, of which #8 is the shape.
const std::string kPart =
    "#1=MACHINING_PROJECT('p','',$,());\n#2=PRODUCT_DEFINITION_FORMATION('','',#1);\n"
    "#3=PRODUCT_DEFINITION('','',#2,$);\n#4=MACHINING_PROJECT_WORKPIECE_RELATIONSHIP('','','',#3,#5);\n"
    "#5=PRODUCT_DEFINITION('part','',#6,$);\n#6=PRODUCT_DEFINITION_FORMATION('1.0','',#7);\n"
    "#7=PRODUCT('part','','',());\n#8=PRODUCT_DEFINITION_SHAPE('','',#5);\n";

/// A context in inches, which nothing but kept text may be in.
const std::string kInches =
    "#12=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#14))"
    "REPRESENTATION_CONTEXT('INCH','3D'));\n"
    "#14=(CONVERSION_BASED_UNIT('inch',#15)LENGTH_UNIT()NAMED_UNIT(#17));\n"
    "#15=LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4),#16);\n"
    "#16=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
    "#17=DIMENSIONAL_EXPONENTS(1.,0.,0.,0.,0.,0.,0.);\n";

const model::Workpiece& part_of(const model::Plan& plan) {
  return plan.model.at<model::Workpiece>(plan.model.at<model::Project>(plan.project).its_workpieces[0]);
}

struct Shape {
  const char* representation;
  const char* item;
  std::string instances;  ///< #11 is the item
};

const std::string kPoint = "#20=CARTESIAN_POINT('near',(1.5,2.5,3.5));\n";
const std::string kEdge =
    "#21=EDGE_CURVE('e',#22,#23,#24,.T.);\n#22=VERTEX_POINT('a',#20);\n#23=VERTEX_POINT('b',#25);\n"
    "#24=LINE('l',#20,#26);\n#25=CARTESIAN_POINT('far',(4.5,2.5,3.5));\n#26=VECTOR('v',#27,3.);\n"
    "#27=DIRECTION('x',(1.,0.,0.));\n";
const std::string kFace =
    "#30=ADVANCED_FACE('top',(#31),#32,.T.);\n#31=FACE_OUTER_BOUND('',#33,.T.);\n"
    "#33=EDGE_LOOP('',(#34));\n#34=ORIENTED_EDGE('',*,*,#21,.T.);\n#32=PLANE('p',#35);\n"
    "#35=AXIS2_PLACEMENT_3D('',#20,$,$);\n";

const Shape kShapes[] = {
    {"EDGE_BASED_WIREFRAME_SHAPE_REPRESENTATION", "EDGE_BASED_WIREFRAME_MODEL",
     "#11=EDGE_BASED_WIREFRAME_MODEL('m',(#40));\n#40=CONNECTED_EDGE_SET('set',(#21));\n" + kEdge + kPoint},
    {"SHELL_BASED_WIREFRAME_SHAPE_REPRESENTATION", "SHELL_BASED_WIREFRAME_MODEL",
     "#11=SHELL_BASED_WIREFRAME_MODEL('m',(#40));\n#40=WIRE_SHELL('w',(#41));\n"
     "#41=EDGE_LOOP('',(#42));\n#42=ORIENTED_EDGE('',*,*,#21,.T.);\n" +
         kEdge + kPoint},
    {"GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION", "GEOMETRIC_CURVE_SET",
     "#11=GEOMETRIC_CURVE_SET('m',(#40));\n#40=POLYLINE('way',(#20,#41));\n"
     "#41=CARTESIAN_POINT('far',(4.5,2.5,3.5));\n" +
         kPoint},
    {"GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION", "GEOMETRIC_SET",
     "#11=GEOMETRIC_SET('m',(#40));\n#40=RECTANGULAR_TRIMMED_SURFACE('cut',#32,0.,1.,0.,1.,.T.,.T.);\n"
     "#32=PLANE('p',#35);\n#35=AXIS2_PLACEMENT_3D('',#20,$,$);\n" +
         kPoint},
    {"NON_MANIFOLD_SURFACE_SHAPE_REPRESENTATION", "FACE_BASED_SURFACE_MODEL",
     "#11=FACE_BASED_SURFACE_MODEL('m',(#40));\n#40=CONNECTED_FACE_SET('set',(#30));\n" + kFace + kEdge +
         kPoint},
    {"MANIFOLD_SURFACE_SHAPE_REPRESENTATION", "SHELL_BASED_SURFACE_MODEL",
     "#11=SHELL_BASED_SURFACE_MODEL('m',(#40));\n#40=OPEN_SHELL('shell',(#30));\n" + kFace + kEdge + kPoint},
    // Topologically bounded surfaces are what manifold surfaces and advanced solids are made of.
    {"MANIFOLD_SUBSURFACE_SHAPE_REPRESENTATION", "CONNECTED_FACE_SUB_SET",
     "#11=CONNECTED_FACE_SUB_SET('m',(#30),#40);\n#40=CONNECTED_FACE_SET('set',(#30));\n" + kFace + kEdge +
         kPoint},
    {"FACETED_BREP_SHAPE_REPRESENTATION", "FACETED_BREP",
     "#11=FACETED_BREP('m',#40);\n#40=CLOSED_SHELL('shell',(#41));\n#41=FACE_SURFACE('f',(#42),#32,.T.);\n"
     "#42=FACE_OUTER_BOUND('',#43,.T.);\n#43=POLY_LOOP('loop',(#20,#44,#45));\n"
     "#44=CARTESIAN_POINT('far',(4.5,2.5,3.5));\n#45=CARTESIAN_POINT('third',(4.5,9.5,3.5));\n"
     "#32=PLANE('p',#35);\n#35=AXIS2_PLACEMENT_3D('',#20,$,$);\n" +
         kPoint},
    {"ELEMENTARY_BREP_SHAPE_REPRESENTATION", "MANIFOLD_SOLID_BREP",
     "#11=MANIFOLD_SOLID_BREP('m',#40);\n#40=CLOSED_SHELL('shell',(#41));\n"
     "#41=FACE_SURFACE('f',(#31),#32,.T.);\n#31=FACE_OUTER_BOUND('',#33,.T.);\n#33=EDGE_LOOP('',(#34));\n"
     "#34=ORIENTED_EDGE('',*,*,#21,.T.);\n#32=PLANE('p',#35);\n#35=AXIS2_PLACEMENT_3D('',#20,$,$);\n" +
         kEdge + kPoint},
    {"ADVANCED_BREP_SHAPE_REPRESENTATION", "MANIFOLD_SOLID_BREP",
     "#11=MANIFOLD_SOLID_BREP('m',#40);\n#40=CLOSED_SHELL('shell',(#30));\n" + kFace + kEdge + kPoint},
};

void PrintTo(const Shape& s, std::ostream* out) { *out << s.representation; }

/// The part with that shape, and with a styled model of it.
std::string file_with(const Shape& s) {
  return file_of(kPart + "#9=SHAPE_DEFINITION_REPRESENTATION(#8,#10);\n#10=" + s.representation +
                 "('shape',(#11),#12);\n" + s.instances + kInches +
                 "#50=MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION('styles',(#51),#12);\n"
                 "#51=STYLED_ITEM('styled',(#52),#11);\n#52=PRESENTATION_STYLE_ASSIGNMENT((#53));\n"
                 "#53=CURVE_STYLE('c',$,$,#54);\n#54=COLOUR_RGB('red',1.,0.,0.);\n");
}

class ShapeOfAPart : public ::testing::TestWithParam<Shape> {};

TEST_P(ShapeOfAPart, IsItsGeometryKeptAsItIs) {
  const Shape& s = GetParam();
  std::vector<std::string> said;
  const model::Plan plan = read_text(file_with(s), &said);
  for (const auto& line : said) {  // the styles alone are not understood
    const bool style = line.find("STYLE") != std::string::npos || line.find("COLOUR") != std::string::npos;
    EXPECT_TRUE(style || line.find("EXC-KEPT") == std::string::npos) << line;
  }
  ASSERT_TRUE(plan.model.holds<model::KeptInstance>(part_of(plan).its_geometry));
  EXPECT_EQ(plan.model.at<model::KeptInstance>(part_of(plan).its_geometry).keyword, s.representation);
  // Each instance of the shape once, word by word.
  const std::string bytes = written(plan).bytes;
  const auto lines = shapes(bytes);
  auto wanted = shapes(s.instances);
  wanted.pop_back();
  for (const auto& line : wanted) {
    EXPECT_EQ(std::count(lines.begin(), lines.end(), line), std::count(wanted.begin(), wanted.end(), line))
        << line << "\n"
        << bytes;
  }
  // From the part to the item, in the inches that it is in.
  const Instances file(bytes);
  const auto used = file.only("SHAPE_DEFINITION_REPRESENTATION");
  const auto shape = file.to(used, 1);
  EXPECT_EQ(shape.keyword(), s.representation);
  EXPECT_EQ(Instances::text(file.to(file.to(used, 0), 2), 0), "part");
  EXPECT_EQ(file.to(shape, 1).keyword(), s.item);
  EXPECT_THAT(lines, Contains(HasSubstr("LENGTH_MEASURE_WITH_UNIT(LENGTH_MEASURE(25.4)")));
  EXPECT_EQ(lost_on_the_way(plan), "");
}

TEST_P(ShapeOfAPart, IsWhatItsStyledModelIsOf) {
  const Shape& s = GetParam();
  const model::Plan plan = read_text(file_with(s));
  ASSERT_EQ(part_of(plan).its_styled_models.size(), 1U);
  const Instances file(written(plan).bytes);
  const auto styled = file.to(file.only("MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION"), 1);
  ASSERT_EQ(styled.keyword(), "STYLED_ITEM");
  EXPECT_EQ(file.to(styled, 2).id(), file.to(file.only(s.representation), 1).id());
  EXPECT_EQ(file.to(file.to(file.to(styled, 1), 0), 3).keyword(), "COLOUR_RGB");
}

INSTANTIATE_TEST_SUITE_P(Kinds, ShapeOfAPart, ::testing::ValuesIn(kShapes),
                         [](const auto& given) { return std::string(given.param.representation); });

// No entity of the schema of edition 3, which has none for flat wireframes.
TEST(ShapeOfADrawing, IsKeptAndStillRefersToItsPart) {
  const model::Plan plan =
      read_text(file_of(kPart + kInches +
                        "#9=SHAPE_DEFINITION_REPRESENTATION(#8,#10);\n"
                        "#10=GEOMETRICALLY_BOUNDED_2D_WIREFRAME_REPRESENTATION('flat',(#11),#12);\n"
                        "#11=GEOMETRIC_CURVE_SET('m',(#13));\n#13=POLYLINE('way',(#20,#21));\n"
                        "#20=CARTESIAN_POINT('near',(1.5,2.5));\n#21=CARTESIAN_POINT('far',(4.5,2.5));\n"));
  const Instances file(written(plan).bytes);
  const auto used = file.only("SHAPE_DEFINITION_REPRESENTATION");
  EXPECT_EQ(Instances::text(file.to(file.to(used, 0), 2), 0), "part");
  EXPECT_EQ(file.to(used, 1).keyword(), "GEOMETRICALLY_BOUNDED_2D_WIREFRAME_REPRESENTATION");
  EXPECT_EQ(file.to(file.to(used, 1), 1).keyword(), "GEOMETRIC_CURVE_SET");
  EXPECT_EQ(lost_on_the_way(plan), "");
}

// --- faces of a feature ---

/// A part with a hole, then its solid: two faces of it are the hole's.
std::string with_faces() {
  FeatureBench b;
  auto hole = b.basic<model::RoundHole>("H");
  hole.diameter = b.length(22.0);
  hole.bottom_condition = FeatureBench::as<model::HoleBottomCondition>(b.m.add(model::FlatHoleBottom{}));
  b.m.add(std::move(hole));
  std::string bytes = written(b.plan).bytes;
  const auto id_before = [&](std::size_t at) {
    const auto hash = bytes.rfind("\n#", at) + 1;
    return bytes.substr(hash, bytes.find('=', hash) - hash);
  };
  const auto feature = id_before(bytes.find("ROUND_HOLE("));
  std::string shape;  // of the part: what the hole's place refers to
  Job job;
  auto file = p21::parse(bytes, "t.stpnc", {}, job);
  EXPECT_TRUE(file.has_value());
  for (const p21::Instance i : *file) {
    if (i.keyword() != "PRODUCT_DEFINITION_SHAPE") continue;
    const auto of = file->find(i.part(0).parameters[2].reference());
    if (of && of->keyword() == "PRODUCT_DEFINITION") shape = "#" + std::to_string(i.id());
  }
  EXPECT_FALSE(shape.empty());
  bytes.insert(
      bytes.find("ENDSEC;\nEND-ISO"),
      "#901=GEOMETRIC_ITEM_SPECIFIC_USAGE('',''," + feature +
          ",#906,#907);\n"
          "#902=GEOMETRIC_ITEM_SPECIFIC_USAGE('',''," +
          feature +
          ",#906,#908);\n"
          "#906=ADVANCED_BREP_SHAPE_REPRESENTATION('solid',(#909),#920);\n#909=MANIFOLD_SOLID_BREP('',#910);"
          "\n"
          "#910=CLOSED_SHELL('',(#911,#907,#908));\n#907=ADVANCED_FACE('side',(),#912,.F.);\n"
          "#908=ADVANCED_FACE('floor',(),#913,.T.);\n#911=ADVANCED_FACE('top',(),#913,.T.);\n"
          "#912=CYLINDRICAL_SURFACE('',#914,11.);\n#913=PLANE('',#914);\n"
          "#914=AXIS2_PLACEMENT_3D('',#915,$,$);\n#915=CARTESIAN_POINT('',(20.,30.,5.));\n"
          "#920=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#921))"
          "REPRESENTATION_CONTEXT('',''));\n#921=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
          "#922=SHAPE_DEFINITION_REPRESENTATION(" +
          shape + ",#906);\n");
  return bytes;
}

std::vector<std::string> faces_of(const model::Plan& plan) {
  std::vector<std::string> out;
  EXPECT_EQ(plan.model.count(model::TypeId::kRoundHole), 1U);
  const auto& hole = plan.model.at<model::RoundHole>(plan.model.all(model::TypeId::kRoundHole)[0]);
  for (const AnyRef face : hole.explicit_representation.items) {
    const auto* kept = plan.model.get<model::KeptInstance>(face);
    EXPECT_NE(kept, nullptr);
    if (kept == nullptr) continue;
    const auto* text = std::get_if<std::string>(&kept->pieces.front());
    EXPECT_NE(text, nullptr);
    if (text != nullptr) out.push_back(*text);
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(Feature, NamesTheFacesOfTheSolidThatAreIts) {
  std::vector<std::string> said;
  const model::Plan plan = read_text(with_faces(), &said);
  for (const auto& line : said) EXPECT_EQ(line.find("EXC-KEPT"), std::string::npos) << line;
  const auto faces = faces_of(plan);
  ASSERT_EQ(faces.size(), 2U);
  EXPECT_THAT(faces[0], HasSubstr("'floor'"));
  EXPECT_THAT(faces[1], HasSubstr("'side'"));
  // Written: from the hole to the very faces that are in the shell of the part's solid.
  const std::string bytes = written(plan).bytes;
  const Instances file(bytes);
  const auto solid = file.only("ADVANCED_BREP_SHAPE_REPRESENTATION");
  const auto shell = file.to(file.to(solid, 1), 1);
  ASSERT_EQ(shell.keyword(), "CLOSED_SHELL");
  std::set<std::uint64_t> in_shell;
  const p21::Value list = shell.part(0).parameters[1];
  for (std::size_t i = 0; i < list.size(); ++i) in_shell.insert(list[i].reference());
  EXPECT_EQ(in_shell.size(), 3U);
  const auto usages = file.all("GEOMETRIC_ITEM_SPECIFIC_USAGE");
  ASSERT_EQ(usages.size(), 2U);
  std::set<std::string> named;
  for (const auto& usage : usages) {
    const auto face = file.to(usage, 4);
    named.insert(Instances::text(face, 0));
    EXPECT_TRUE(in_shell.contains(face.id()));
    EXPECT_EQ(file.to(usage, 3).id(), solid.id());
    bool hole = false;
    const auto feature = file.to(usage, 2);
    for (std::size_t k = 0; k < feature.part_count(); ++k) hole |= feature.part(k).keyword == "ROUND_HOLE";
    EXPECT_TRUE(hole);
  }
  EXPECT_EQ(named, (std::set<std::string>{"side", "floor"}));
  EXPECT_EQ(faces_of(read_text(bytes)), faces);
  EXPECT_EQ(lost_on_the_way(plan), "");
}

// --- other processes ---

struct Other {
  const char* name;
  std::string workingstep, operation;  ///< with #20 as the one, #22 as the other
  std::string about;                   ///< more that belongs to it
};

void PrintTo(const Other& o, std::ostream* out) { *out << o.name; }

const Other kOthers[] = {
    {"Additive", "MACHINING_WORKINGSTEP('bead','additive','','')",
     "ADDITIVE_TYPE_OPERATION('lay','oned','','')",
     "#30=ACTION_PROPERTY('stepover','oned',#22);\n#31=ACTION_PROPERTY_REPRESENTATION('','oned',#30,#32);\n"
     "#32=REPRESENTATION('',(#33),#34);\n#33=DESCRIPTIVE_REPRESENTATION_ITEM('','0.8 of a bead');\n"
     "#34=REPRESENTATION_CONTEXT('','units not necessary');\n"},
    {"DrillAndFill", "MACHINING_WORKINGSTEP('rivet','drill and fill','','')",
     "FILLING_TYPE_OPERATION('set','place fastener','','')",
     "#30=ACTION_PROPERTY('seal type','place fastener',#22);\n"
     "#31=ACTION_PROPERTY_REPRESENTATION('','place fastener',#30,#32);\n#32=REPRESENTATION('',(#33),#34);\n"
     "#33=DESCRIPTIVE_REPRESENTATION_ITEM('','fastener');\n"
     "#34=REPRESENTATION_CONTEXT('','units not necessary');\n"
     "#40=FILLING_TYPE_GROUP('rivets of a row','precedence');\n"
     "#41=APPLIED_GROUP_ASSIGNMENT(#40,(#20));\n"},
};

class OtherProcess : public ::testing::TestWithParam<Other> {
 protected:
  static std::string bytes() {
    const Other& o = GetParam();
    return file_of(
        kPart +
        "#60=PRODUCT_DEFINITION_PROCESS('machining','',#61,'');\n"
        "#62=PROCESS_PRODUCT_ASSOCIATION('','',#3,#60);\n#61=MACHINING_WORKPLAN('main','','','');\n"
        "#63=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#61,#64,1.);\n"
        "#64=MACHINING_NC_FUNCTION('before','program stop','','');\n"
        "#19=MACHINING_PROCESS_SEQUENCE_RELATIONSHIP('','',#61,#20,2.);\n"
        "#20=" +
        o.workingstep +
        ";\n#21=MACHINING_OPERATION_RELATIONSHIP('','kind',#20,#22);\n"
        "#22=" +
        o.operation + ";\n" + o.about);
  }
};

TEST_P(OtherProcess, IsKeptConnectedAndWrittenBack) {
  std::vector<std::string> said;
  const model::Plan plan = read_text(bytes(), &said);
  EXPECT_THAT(said, Contains(HasSubstr("MACHINING_WORKINGSTEP")));  // not in silence
  const auto& main =
      plan.model.at<model::Workplan>(plan.model.at<model::Project>(plan.project).main_workplan);
  ASSERT_FALSE(main.its_elements.empty());
  EXPECT_EQ(main.its_elements.items[0].type, model::TypeId::kProgramStop);
  const std::string again = written(plan).bytes;
  const auto lines = shapes(again);
  auto wanted =
      shapes("#20=" + GetParam().workingstep + ";\n#22=" + GetParam().operation + ";\n" + GetParam().about);
  wanted.pop_back();
  for (const auto& line : wanted) EXPECT_EQ(std::count(lines.begin(), lines.end(), line), 1) << line;
  // In the workplan, second; and to its operation and what that says.
  const Instances file(again);
  const auto step = file.only("MACHINING_WORKINGSTEP");
  bool second = false;
  for (const auto& sequence : file.all("MACHINING_PROCESS_SEQUENCE_RELATIONSHIP")) {
    if (file.to(sequence, 3).id() != step.id()) continue;
    EXPECT_EQ(Instances::text(file.to(sequence, 2), 0), "main");
    second = sequence.part(0).parameters[4].as_real() == 2.0;
  }
  EXPECT_TRUE(second);
  const auto relation = file.only("MACHINING_OPERATION_RELATIONSHIP");
  EXPECT_EQ(file.to(relation, 2).id(), step.id());
  const auto operation = file.to(relation, 3);
  EXPECT_EQ(file.to(file.only("ACTION_PROPERTY"), 2).id(), operation.id());
  for (const auto& group : file.all("APPLIED_GROUP_ASSIGNMENT")) {
    EXPECT_EQ(file.to(group, 0).keyword(), "FILLING_TYPE_GROUP");
    EXPECT_EQ(file.to(group, 1).id(), step.id());
  }
  EXPECT_EQ(lost_on_the_way(plan), "");
  EXPECT_EQ(written(read_text(again)).bytes, again);
}

INSTANTIATE_TEST_SUITE_P(Kinds, OtherProcess, ::testing::ValuesIn(kOthers),
                         [](const auto& given) { return std::string(given.param.name); });

}  // namespace
}  // namespace capstan::exchange::ap238
