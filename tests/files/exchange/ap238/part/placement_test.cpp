#include "planner/ground/base/file.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/arena/kept.h"
#include "tests/files/exchange/ap238/part/feature_support.h"
#include "tests/support/corpus.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;
using ::testing::HasSubstr;

model::Plan corpus(const std::string& path) {
  Job job;
  const auto bytes = read_file(path);
  EXPECT_TRUE(bytes.has_value());
  auto plan = read_bytes(bytes.value_or(""), path, {}, job);
  EXPECT_TRUE(plan.has_value()) << (plan ? "" : to_text(plan.error()));
  return plan ? std::move(*plan) : model::Plan{};
}

model::FeatureShape only(const model::Plan& plan, model::TypeId type) {
  const auto all = plan.model.all(type);
  EXPECT_EQ(all.size(), 1u);
  auto out = model::shapes_of(plan.model, Ref<model::ManufacturingFeature>(all.front()));
  EXPECT_TRUE(out.has_value()) << (out ? "" : to_text(out.error()));
  return out ? out->front() : model::FeatureShape{};
}

// The corners of a shape's area at its bottom, in workpiece coordinates.
std::array<double, 4> extent(const model::FeatureShape& s) {
  std::array<double, 4> out = {1e9, 1e9, -1e9, -1e9};
  for (const auto& loop : s.area.loops) {
    for (const auto& p : loop) {
      const auto q = s.frame.to_parent({p.x, p.y, 0.0});
      out = {std::min(out[0], q.x), std::min(out[1], q.y), std::max(out[2], q.x), std::max(out[3], q.y)};
    }
  }
  return out;
}

// The example of ISO 10303-238 annex J cc3 is that of ISO 14649-11 annex F.1.
TEST(Placement, OfAnnexJIsThatOfTheSamePartInISO14649) {
  CAPSTAN_CORPUS_FILE(ap238, "ap238/ap238e4dis_annexJ_cc3.stp");
  CAPSTAN_CORPUS_FILE(iso14649, "iso14649/nist_ex1.stp");
  const auto a = corpus(ap238), b = corpus(iso14649);
  for (const auto type :
       {model::TypeId::kPlanarFace, model::TypeId::kRoundHole, model::TypeId::kClosedPocket}) {
    SCOPED_TRACE(std::string(model::noun_type(type).keyword));
    const auto x = only(a, type), y = only(b, type);
    EXPECT_EQ(x.name, y.name);
    EXPECT_NEAR(x.frame.origin.z, y.frame.origin.z, 1e-9);
    EXPECT_NEAR(norm(x.frame.z - y.frame.z), 0.0, 1e-12);
    EXPECT_NEAR(x.depth_mm, y.depth_mm, 1e-9);
    EXPECT_EQ(x.through, y.through);
    EXPECT_NEAR(x.diameter.nominal_mm, y.diameter.nominal_mm, 1e-9);
    EXPECT_NEAR(x.corner_radius_mm, y.corner_radius_mm, 1e-9);
    if (type == model::TypeId::kClosedPocket) {
      const auto p = extent(x), q = extent(y);
      for (std::size_t i = 0; i < 4; ++i) EXPECT_NEAR(p[i], q[i], 1e-3) << i;
    }
    EXPECT_NEAR(geometry::area(x.area), geometry::area(y.area), 0.05);  // arcs are cut into chords
  }
  // Values of ISO 14649-11: face 5 mm above, hole of 22 mm at (20, 60), pocket of 50 by 80 from (45, 110).
  const auto face = only(a, model::TypeId::kPlanarFace);
  EXPECT_NEAR(face.frame.origin.z, 5.0, 1e-12);
  EXPECT_NEAR(face.depth_mm, 5.0, 1e-12);
  const auto hole = only(a, model::TypeId::kRoundHole);
  EXPECT_NEAR(norm(hole.frame.origin - geometry::Vec3{20.0, 60.0, 0.0}), 0.0, 1e-12);
  EXPECT_NEAR(hole.depth_mm, 30.0, 1e-12);
  EXPECT_NEAR(hole.diameter.nominal_mm, 22.0, 1e-12);
  const auto pocket = only(a, model::TypeId::kClosedPocket);
  EXPECT_NEAR(pocket.depth_mm, 30.0, 1e-12);
  EXPECT_NEAR(pocket.frame.origin.z, 0.0, 1e-12);
  const auto e = extent(pocket);
  EXPECT_NEAR(e[2] - e[0], 50.0, 1e-3);
  EXPECT_NEAR(e[3] - e[1], 80.0, 1e-3);
}

TEST(Placement, OfAnnexJsHoleIsWarnedOf) {
  CAPSTAN_CORPUS_FILE(path, "ap238/ap238e4dis_annexJ_cc3.stp");
  Job job;
  const auto bytes = read_file(path);
  (void)read_bytes(bytes.value_or(""), path, {}, job);
  std::string said;
  for (const auto& d : job.diagnostics()) said += d.code == "EXC-DEPTH" ? to_text(d) : "";
  EXPECT_THAT(said, HasSubstr("#3300"));
  EXPECT_THAT(said, HasSubstr("30 mm along z"));
}

TEST(Placement, ComesBackEqualForEveryISO14649FileWithFeatures) {
  for (const char* name : {"nist_ex1.stp", "ufsc_Cavidade.p21", "ufsc_FuroBaseEsferica.p21",
                           "ufsc_FuroConico.p21", "ufsc_Ranhura.p21", "ufsc_RanhuraPerfilRoundedU.p21",
                           "ufsc_RanhuraPerfilVee.p21", "meduag_furo.p21", "meduag_peca_defesa.p21"}) {
    SCOPED_TRACE(name);
    CAPSTAN_CORPUS_FILE(path, std::string("iso14649/") + name);
    const auto plan = corpus(path);
    const auto back = read_text(written(plan).bytes);
    const testing::ModelDifference difference(plan, back, {1e-9, false, {}});
    for (const auto& line : difference.found()) {
      if (line.rfind("feature", 0) == 0 || line.find("its_feature") != std::string::npos)
        ADD_FAILURE() << line;
    }
  }
}

// --- AP238's own placements ---

/// A blind hole or a pocket of 20 mm at (40, 50, `z`), as AP238 has it, in millimetres.
std::string drilled(const std::string& z, const std::string& along, const std::string& usage,
                    const std::string& limit = "") {
  std::string out =
      "#1=PRODUCT_DEFINITION('','',#2,$);\n#2=PRODUCT_DEFINITION_FORMATION('','',#3);\n#3=PRODUCT('P','P','',"
      "());\n"
      "#4=PRODUCT_DEFINITION_SHAPE('','',#1);\n"
      "#10=(CHARACTERIZED_OBJECT('','')FEATURE_DEFINITION()INSTANCED_FEATURE()ROUND_HOLE()SHAPE_ASPECT('H',''"
      ",#4,.T.));\n"
      "#11=PRODUCT_DEFINITION_SHAPE('','',#10);\n#12=SHAPE_DEFINITION_REPRESENTATION(#11,#13);\n"
      "#13=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#14),#50);\n#14=AXIS2_PLACEMENT_3D('orientation',#15,$,$)"
      ";\n"
      "#15=CARTESIAN_POINT('',(40.,50.," +
      z +
      "));\n"
      "#20=SHAPE_ASPECT('','diameter "
      "occurrence',#11,.F.);\n#21=SHAPE_DEFINING_RELATIONSHIP('diameter','profile usage',#22,#20);\n"
      "#22=CIRCULAR_CLOSED_PROFILE('','',#60,.F.);\n#23=PROPERTY_DEFINITION('','',#22);\n#24=SHAPE_"
      "DEFINITION_REPRESENTATION(#23,#25);\n"
      "#25=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#26,#14),#50);\n"
      "#26=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(20.),#53)"
      "REPRESENTATION_ITEM('diameter'));\n"
      "#30=SHAPE_ASPECT('','hole depth occurrence',#11,.F.);\n"
      "#31=SHAPE_DEFINING_RELATIONSHIP('hole depth','path feature component usage',#32,#30);\n"
      "#32=PATH_FEATURE_COMPONENT('','linear',#60,.F.);\n#33=PROPERTY_DEFINITION('','linear',#32);\n"
      "#34=SHAPE_DEFINITION_REPRESENTATION(#33,#35);\n#35=SHAPE_REPRESENTATION_WITH_PARAMETERS('',(#36,#14),#"
      "50);\n"
      "#36=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(LENGTH_MEASURE(15.),#53)"
      "REPRESENTATION_ITEM('distance'));\n"
      "#37=PROPERTY_DEFINITION_REPRESENTATION(#33,#38);\n#38=DIRECTION_SHAPE_REPRESENTATION('',(#39),#50);\n"
      "#39=DIRECTION('',(0.,0.," +
      along +
      "));\n#40=SHAPE_ASPECT('','bottom condition occurrence',#11,.F.);\n"
      "#41=FEATURE_COMPONENT_RELATIONSHIP('" +
      usage +
      "','hole bottom usage',#42,#40);\n#42=HOLE_BOTTOM('','flat',#60,.F.);\n"
      "#50=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNIT_ASSIGNED_CONTEXT((#53,#54))REPRESENTATION_CONTEXT("
      "'',''));\n"
      "#53=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n#54=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_"
      "UNIT($,.RADIAN.));\n"
      "#60=PRODUCT_DEFINITION_SHAPE('feature component',$,#61);\n#61=FEATURE_COMPONENT_DEFINITION('feature "
      "component','');\n";
  if (!limit.empty()) {
    out +=
        "#70=SHAPE_DEFINITION_REPRESENTATION(#11,#71);\n#71=SHAPE_REPRESENTATION('maximum feature "
        "limit',(#72),#50);\n"
        "#72=PLANE('',#73);\n#73=AXIS2_PLACEMENT_3D('',#74,$,$);\n#74=CARTESIAN_POINT('',(0.,0.," +
        limit + "));\n";
  }
  return file_of(out);
}

TEST(Placement, OfAHoleGoesOnTopHoweverItsCourseOfTravelRuns) {
  // Top at z = 30, bottom at z = 15, opening upwards.
  struct Form {
    const char *z, *along, *usage, *limit;
  };
  for (const Form& f :
       {Form{"15.", "1.", "hole depth start", ""}, Form{"30.", "-1.", "hole depth end", ""},
        Form{"15.", "1.", "hole depth start", "0."}, Form{"15.", "1.", "hole depth start", "15."},
        Form{"30.", "-1.", "hole depth end", "-15."}, Form{"15.", "1.", "", ""},
        Form{"30.", "-1.", "", ""}}) {
    SCOPED_TRACE(std::string(f.z) + f.along + f.usage + f.limit);
    std::vector<std::string> said;
    const auto plan = read_text(drilled(f.z, f.along, f.usage, f.limit), &said);
    const auto s = only(plan, model::TypeId::kRoundHole);
    EXPECT_NEAR(norm(s.frame.origin - geometry::Vec3{40.0, 50.0, 30.0}), 0.0, 1e-12);
    EXPECT_NEAR(s.frame.z.z, 1.0, 1e-12);
    EXPECT_NEAR(s.depth_mm, 15.0, 1e-12);
    for (const auto& line : said) EXPECT_THAT(line, ::testing::Not(HasSubstr("EXC-DEPTH")));
    EXPECT_EQ(lost_on_the_way(plan), "");
  }
}

TEST(Placement, OfAHoleThatOpensDownwardsIsTurned) {
  // z into the material: top at z = 15, bottom at z = 30.
  for (const auto& [z, along, usage] : std::vector<std::tuple<std::string, std::string, std::string>>{
           {"15.", "1.", "hole depth end"}, {"30.", "-1.", "hole depth start"}}) {
    SCOPED_TRACE(usage);
    const auto plan = read_text(drilled(z, along, usage));
    const auto s = only(plan, model::TypeId::kRoundHole);
    EXPECT_NEAR(norm(s.frame.origin - geometry::Vec3{40.0, 50.0, 15.0}), 0.0, 1e-12);
    EXPECT_NEAR(s.frame.z.z, -1.0, 1e-12);
    EXPECT_NEAR(s.depth_mm, 15.0, 1e-12);
    EXPECT_EQ(lost_on_the_way(plan), "");
  }
}

TEST(Placement, OfAHolePrefersTheDepthSurfaceAndWarns) {
  std::vector<std::string> said;
  const auto plan = read_text(drilled("30.", "-1.", "hole depth end", "-12."), &said);
  EXPECT_NEAR(only(plan, model::TypeId::kRoundHole).depth_mm, 12.0, 1e-12);
  EXPECT_THAT(said, ::testing::Contains(HasSubstr("EXC-DEPTH")));
}

TEST(Placement, OfADepthGivenAsALengthComesBackAsOne) {
  FeatureBench b;
  auto f = b.basic<model::RoundHole>("H");
  f.diameter = b.length(10);
  f.bottom_condition = b.as<model::HoleBottomCondition>(b.m.add(model::FlatHoleBottom{}));
  *static_cast<AnyRef*>(&f.depth) = b.length(25, 0.1, 0.2);
  b.m.add(std::move(f));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(Placement, OfProfilesSharedByTwoFeaturesIsNone) {
  FeatureBench b;
  model::RectangularClosedProfile p;
  p.profile_length = b.length(30);
  p.profile_width = b.length(20);
  const auto profile = b.as<model::ClosedProfile>(b.m.add(std::move(p)));
  for (const double x : {10.0, 90.0}) {
    auto f = b.basic<model::ClosedPocket>("P" + std::to_string(static_cast<int>(x)));
    f.feature_placement = b.placement(x, 0, 0);
    f.its_boss.given = true;
    f.bottom_condition = b.as<model::PocketBottomCondition>(b.m.add(model::PlanarPocketBottomCondition{}));
    f.feature_boundary = profile;
    b.m.add(std::move(f));
  }
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

// What is told of the feature when it is written, or nothing.
std::string told(const model::Plan& plan, const std::string& name) {
  for (const std::string& loss : written(plan).losses) {
    if (loss.find("'" + name + "'") != std::string::npos) return loss;
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  EXPECT_NE(text.find(from), std::string::npos) << from;
  return text.find(from) == std::string::npos ? text : text.replace(text.find(from), from.size(), to);
}

FeatureBench flat_hole(double depth_mm) {
  FeatureBench b;
  auto f = b.basic<model::RoundHole>("H");
  f.diameter = b.length(10);
  f.depth = b.plane(-depth_mm);
  f.bottom_condition = b.as<model::HoleBottomCondition>(b.m.add(model::FlatHoleBottom{}));
  b.m.add(std::move(f));
  return b;
}

TEST(Placement, OfADepthThatWasEditedInTheCourseOnlyIsWarnedOf) {
  const std::string bytes = written(flat_hole(17).plan).bytes;
  std::vector<std::string> said;
  EXPECT_NEAR(only(read_text(bytes, &said), model::TypeId::kRoundHole).depth_mm, 17.0, 1e-12);
  EXPECT_THAT(said, ::testing::Not(::testing::Contains(HasSubstr("EXC-DEPTH"))));
  const auto plan = read_text(replaced(bytes, "LENGTH_MEASURE(17.)", "LENGTH_MEASURE(19.)"), &said);
  const auto hole = only(plan, model::TypeId::kRoundHole);
  EXPECT_NEAR(hole.depth_mm, 17.0, 1e-12);  // as for any course: the surface decides
  EXPECT_NEAR(norm(hole.frame.origin - geometry::Vec3{20.0, 30.0, 5.0}), 0.0, 1e-12);
  EXPECT_THAT(said, ::testing::Contains(::testing::AllOf(HasSubstr("EXC-DEPTH"), HasSubstr("-19 mm"),
                                                         HasSubstr("17 mm below"))));
}

// A surface that no noun describes, in place of the depth.
template <class T>
void keep_depth(FeatureBench& b, T& f, model::KeptSchema schema) {
  model::KeptInstance k;
  k.keyword = "BOUNDED_SURFACE";
  k.pieces = {"BOUNDED_SURFACE('bent')"};
  k.schema = schema;
  *static_cast<AnyRef*>(&f.depth) = b.m.add(std::move(k));
}

TEST(Placement, OfAPocketWhoseDepthIsNotUnderstoodStaysAndIsTold) {
  for (const auto schema : {model::KeptSchema::kIso14649, model::KeptSchema::kAp238}) {
    FeatureBench b;
    auto f = b.basic<model::ClosedPocket>("P");
    f.its_boss.given = true;
    f.bottom_condition = b.as<model::PocketBottomCondition>(b.m.add(model::PlanarPocketBottomCondition{}));
    model::RectangularClosedProfile p;
    p.profile_length = b.length(30);
    p.profile_width = b.length(20);
    f.feature_boundary = b.as<model::ClosedProfile>(b.m.add(std::move(p)));
    keep_depth(b, f, schema);
    b.m.add(std::move(f));
    EXPECT_THAT(told(b.plan, "P"), HasSubstr("depth"));
    const auto back = read_text(written(b.plan).bytes);
    const auto& pocket = back.model.at<model::ClosedPocket>(back.model.all(model::TypeId::kClosedPocket)[0]);
    const auto frame = model::placement(back.model, pocket.feature_placement);
    ASSERT_TRUE(frame.has_value());
    EXPECT_NEAR(norm(frame->origin - geometry::Vec3{20.0, 30.0, 5.0}), 0.0, 1e-12);
    EXPECT_NEAR(norm(frame->z - geometry::Vec3{0.0, 0.0, 1.0}), 0.0, 1e-12);
    EXPECT_FALSE(pocket.course_of_travel);
    EXPECT_FALSE(model::depth_of(back.model, AnyRef(back.model.all(model::TypeId::kClosedPocket)[0])));
  }
}

TEST(Placement, OfAPocketWhoseCourseStartsAtTheBottomKeepsItsDepthWhereItCannotMove) {
  FeatureBench b;
  auto f = b.basic<model::RoundHole>("H");
  f.diameter = b.length(10);
  f.bottom_condition = b.as<model::HoleBottomCondition>(b.m.add(model::FlatHoleBottom{}));
  f.bottom_at_path_end = false;
  f.course_of_travel = b.as<model::TravelPath>(b.line(12, 0, 0, 1));
  b.m.at<model::Axis2Placement3d>(f.feature_placement).location = {};
  b.m.add(std::move(f));
  EXPECT_THAT(told(b.plan, "H"), HasSubstr("placement is not understood"));
  EXPECT_THAT(shapes(written(b.plan).bytes),
              ::testing::Contains("SHAPE_REPRESENTATION('maximum feature limit',(#),#);"));
}

// --- slots ---

struct SlotBench : FeatureBench {
  model::Slot slot = basic<model::Slot>("S");
  SlotBench() {
    slot.feature_placement = placement(20, 30, 50);
    slot.course_of_travel = as<model::TravelPath>(line(100, 1, 0, 0));
    model::RoundedUProfile p;
    p.width = length(8);
    slot.swept_shape = as<model::OpenProfile>(m.add(std::move(p)));
    slot.end_conditions.given = true;
  }
};

TEST(Placement, OfASlotWithoutADepthTurnsOnTop) {
  SlotBench b;
  b.slot.depth = {};
  b.m.add(std::move(b.slot));
  const std::string bytes = written(b.plan).bytes;
  // Travelling along +x: z is, and y is out of the material.
  EXPECT_THAT(shapes(bytes), ::testing::Not(::testing::Contains(HasSubstr("maximum feature limit"))));
  EXPECT_EQ(told(b.plan, "S"), "");
  EXPECT_EQ(lost_on_the_way(b.plan), "");

  // Without what goes along it stands at the same place.
  std::string bare = bytes;
  for (const char* role : {"'placement on top'", "'direction of the path on top'"}) {
    for (auto at = bare.find(role); at != std::string::npos; at = bare.find(role)) bare.replace(at, 2, "'x");
  }
  const auto plan = read_text(bare);
  const auto& s = plan.model.at<model::Slot>(plan.model.all(model::TypeId::kSlot)[0]);
  const auto frame = model::placement(plan.model, s.feature_placement);
  ASSERT_TRUE(frame.has_value());
  EXPECT_NEAR(norm(frame->origin - geometry::Vec3{20.0, 30.0, 50.0}), 0.0, 1e-9);
  EXPECT_NEAR(norm(frame->y - geometry::Vec3{1.0, 0.0, 0.0}), 0.0, 1e-9);
}

TEST(Placement, OfASlotWithATiltedOrUnknownDepthTurnsOnTopAndIsTold) {
  for (const int form : {0, 1, 2}) {
    SCOPED_TRACE(form);
    SlotBench b;
    if (form == 0) {
      model::Plane p;
      p.name = "";
      p.position = b.placement(0, 0, -12);
      b.m.at<model::Axis2Placement3d>(p.position).axis = b.direction(0, 0.6, 0.8);
      b.slot.depth = model::Ref<model::ElementarySurface>(AnyRef(b.m.add(std::move(p))));
    } else {
      keep_depth(b, b.slot, form == 1 ? model::KeptSchema::kAp238 : model::KeptSchema::kIso14649);
    }
    b.m.add(std::move(b.slot));
    EXPECT_THAT(told(b.plan, "S"), HasSubstr("depth"));
    if (form == 2) {
      (void)read_text(written(b.plan).bytes);
      continue;  // what ISO 14649's text says cannot stand in AP238
    }
    EXPECT_EQ(lost_on_the_way(b.plan), "");
  }
}

TEST(Placement, OfASlotWhosePathIsNotUnderstoodStaysAndIsTold) {
  SlotBench b;
  b.m.at<model::LinearPath>(b.slot.course_of_travel).its_direction = b.direction(0, 0, -1);
  b.m.add(std::move(b.slot));
  EXPECT_THAT(told(b.plan, "S"), HasSubstr("path is not understood"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(Placement, OfASlotWhoseLimitWasMovedSinceIsWarnedOf) {
  SlotBench b;
  b.m.add(std::move(b.slot));
  const std::string bytes = written(b.plan).bytes;
  std::vector<std::string> said;
  const auto plan =
      read_text(replaced(bytes, "CARTESIAN_POINT('',(0.,12.,0.))", "CARTESIAN_POINT('',(0.,15.,0.))"), &said);
  const auto s = only(plan, model::TypeId::kSlot);
  EXPECT_NEAR(s.depth_mm, 15.0, 1e-9);
  EXPECT_NEAR(s.frame.origin.z, 53.0, 1e-9);  // the bottom stays at 38
  EXPECT_THAT(said, ::testing::Contains(HasSubstr("EXC-PLACEMENT")));
}

TEST(Placement, OfASlotStandsAtItsProfileTravellingAlongZ) {
  FeatureBench b;
  auto f = b.basic<model::Slot>("S");
  f.feature_placement = b.placement(20, 30, 50);
  f.course_of_travel = b.as<model::TravelPath>(b.line(100, 1, 0, 0));
  b.m.at<model::LinearPath>(f.course_of_travel).placement = b.placement(2, 3, 0);
  model::RoundedUProfile p;
  p.width = b.length(8);
  f.swept_shape = b.as<model::OpenProfile>(b.m.add(std::move(p)));
  f.end_conditions.given = true;
  b.m.add(std::move(f));
  const std::string bytes = written(b.plan).bytes;
  // At (22, 33), 12 mm below the top: z along the travel (+x), y out of the material, so x is -y.
  EXPECT_THAT(bytes, HasSubstr("CARTESIAN_POINT('',(22.,33.,38.))"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");

  // Without what goes along, the same place in the model's terms: travel along y.
  std::string bare = bytes;
  for (const char* role : {"'placement on top'", "'direction of the path on top'"}) {
    for (auto at = bare.find(role); at != std::string::npos; at = bare.find(role)) bare.replace(at, 2, "'x");
  }
  const auto plan = read_text(bare);
  const auto s = only(plan, model::TypeId::kSlot);
  EXPECT_NEAR(norm(s.frame.origin - geometry::Vec3{22.0, 33.0, 50.0}), 0.0, 1e-9);
  EXPECT_NEAR(norm(s.frame.y - geometry::Vec3{1.0, 0.0, 0.0}), 0.0, 1e-9);
  EXPECT_NEAR(norm(s.frame.z - geometry::Vec3{0.0, 0.0, 1.0}), 0.0, 1e-9);
  EXPECT_NEAR(s.depth_mm, 12.0, 1e-9);
  ASSERT_EQ(s.spine.size(), 2u);
  EXPECT_NEAR(norm(s.frame.to_parent({s.spine[1].x, s.spine[1].y, 0.0}) - geometry::Vec3{122.0, 33.0, 50.0}),
              0.0, 1e-6);
  EXPECT_EQ(lost_on_the_way(plan), "");
}

TEST(Placement, OfASlotThatWasMovedSinceIsTaken) {
  FeatureBench b;
  auto f = b.basic<model::Slot>("S");
  f.feature_placement = b.placement(20, 30, 50);
  f.course_of_travel = b.as<model::TravelPath>(b.line(100, 0, 1, 0));
  model::RoundedUProfile p;
  p.width = b.length(8);
  f.swept_shape = b.as<model::OpenProfile>(b.m.add(std::move(p)));
  f.end_conditions.given = true;
  b.m.add(std::move(f));
  std::string bytes = written(b.plan).bytes;
  const std::string from = "CARTESIAN_POINT('',(20.,30.,38.))";
  ASSERT_NE(bytes.find(from), std::string::npos);
  bytes.replace(bytes.find(from), from.size(), "CARTESIAN_POINT('',(20.,37.,38.))");
  std::vector<std::string> said;
  const auto s = only(read_text(bytes, &said), model::TypeId::kSlot);
  EXPECT_NEAR(norm(s.frame.origin - geometry::Vec3{20.0, 37.0, 50.0}), 0.0, 1e-9);
  EXPECT_THAT(said, ::testing::Contains(HasSubstr("EXC-PLACEMENT")));
}

}  // namespace
}  // namespace capstan::exchange::ap238
