// What a CAD file asks of its faces, as tolerances and textures of the features that make them.

#include "planner/files/from_cad/asked/requirements.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/files/exchange/brep/read_brep.h"
#include "planner/files/from_cad/from_cad.h"
#include "planner/model/features/requirements.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "tests/files/exchange/brep/support.h"
#include "tests/files/from_cad/turned_part.h"

namespace capstan::testing {
namespace {

using model::TypeId;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// The number of the n-th face of a name, from 0, in a file: "#12".
std::string face(const std::string& text, const std::string& name, std::size_t n = 0) {
  std::size_t at = 0;
  for (std::size_t i = 0; i <= n; ++i) {
    at = text.find("ADVANCED_FACE('" + name + "'", at + 1);
    EXPECT_NE(at, std::string::npos) << name;
  }
  const std::size_t from = text.rfind('#', at);
  return text.substr(from, text.rfind('=', at) - from);
}

/// Adds instances; 9001 is the millimetre, 9002 the micrometre, 9003 the product's shape.
std::string with(const std::string& text, const std::string& more) {
  const std::size_t shape = text.find("=PRODUCT_DEFINITION_SHAPE");
  const std::size_t from = text.rfind('#', shape);
  std::string out = text, data = more;
  for (auto at = data.find("#9003"); at != std::string::npos; at = data.find("#9003", at))
    data.replace(at, 5, text.substr(from, shape - from));
  out.insert(out.find("ENDSEC;\nEND-ISO"),
             "#9001=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));\n"
             "#9002=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MICRO.,.METRE.));\n" +
                 data);
  return out;
}

/// An aspect that is a face.
std::string aspect(int id, const std::string& face) {
  const std::string n = std::to_string(id);
  return "#" + n + "=SHAPE_ASPECT('','',#9003,.T.);\n#" + n + "1=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#" + n +
         ",#9003," + face + ");\n";
}

std::string measure(int id, double value, int unit = 9001, const std::string& name = "") {
  return "#" + std::to_string(id) +
         "=(LENGTH_MEASURE_WITH_UNIT()MEASURE_REPRESENTATION_ITEM()MEASURE_WITH_UNIT(" + "LENGTH_MEASURE(" +
         StepPart::real(value) + "),#" + std::to_string(unit) + ")REPRESENTATION_ITEM('" + name + "'));\n";
}

/// The diameter of aspect 910 with a tolerance, #9211 to #9214.
std::string diameter(double nominal, const std::string& range) {
  return "#9200=DIMENSIONAL_SIZE(#910,'diameter');\n#9201=SHAPE_DIMENSION_REPRESENTATION('',(#9210),#9003);\n"
         "#9202=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(#9200,#9201);\n" +
         measure(9210, nominal) + range + "#9203=PLUS_MINUS_TOLERANCE(#9211,#9200);\n";
}

std::string deviations(double lower, double upper) {
  return measure(9212, lower) + measure(9213, upper) + "#9211=TOLERANCE_VALUE(#9212,#9213);\n";
}

class FromPmi : public ::testing::Test {
 protected:
  void SetUp() override {
    if (exchange::testing::helper().empty()) GTEST_SKIP() << "built without OpenCASCADE";
  }
  model::Plan planned(const std::string& step) {
    exchange::BrepLimits limits;
    limits.helper = exchange::testing::helper();
    const auto brep = exchange::read_brep_bytes(step, "part.step", limits, job_);
    EXPECT_TRUE(brep) << (brep ? "" : brep.error().message);
    if (!brep) return {};
    auto plan = from_cad::plan_of_part(*brep, "part.step", {}, job_);
    EXPECT_TRUE(plan) << (plan ? "" : plan.error().message);
    return plan ? *std::move(plan) : model::Plan{};
  }
  [[nodiscard]] std::string said() const {
    std::string out;
    for (const auto& d : job_.diagnostics()) out += d.code == "CAD-PMI" ? d.message + "\n" : "";
    return out;
  }
  /// The limits of the diameter of the only hole.
  static model::ResolvedLength hole(const model::Plan& plan) {
    const auto holes = plan.model.all(TypeId::kRoundHole);
    EXPECT_EQ(holes.size(), 1U);
    if (holes.empty()) return {};
    const auto size = model::length(plan.model, plan.model.at<model::RoundHole>(holes.front()).diameter);
    EXPECT_TRUE(size) << (size ? "" : size.error().message);
    return size ? *size : model::ResolvedLength{};
  }
  Job job_;
};

/// A blind bore of 8 mm, 12 mm deep, from z = 20.
std::string bore_8() { return bored({{4, 20}, {4, 8}, {0, 8}}); }

TEST_F(FromPmi, ADeviationOfADiameterIsThatOfTheHole) {
  const std::string part = bore_8();
  const auto plan =
      planned(with(part, aspect(910, face(part, "bore")) + diameter(8.0, deviations(-0.01, 0.03))));
  const model::ResolvedLength d = hole(plan);
  EXPECT_DOUBLE_EQ(d.nominal_mm, 8.0);
  EXPECT_NEAR(d.lower_mm, -0.01, 1e-9);
  EXPECT_NEAR(d.upper_mm, 0.03, 1e-9);
  EXPECT_THAT(said(), HasSubstr("1 of 1 tolerance"));
}

TEST_F(FromPmi, AFitIsThatOfIso286) {
  const std::string part = bore_8();
  const auto plan = planned(with(
      part, aspect(910, face(part, "bore")) + diameter(8.0, "#9211=LIMITS_AND_FITS('H','hole','7','');\n")));
  const model::ResolvedLength d = hole(plan);
  // ISO 286-2, H7 over 6 to 10 mm: 0 to +0.015.
  EXPECT_NEAR(d.lower_mm, 0.0, 1e-9);
  EXPECT_NEAR(d.upper_mm, 0.015, 1e-9);
}

TEST_F(FromPmi, ASizeThatTheShapeHasNotIsNotTheFeatures) {
  const std::string part = bore_8();
  const auto plan =
      planned(with(part, aspect(910, face(part, "bore")) + diameter(8.2, deviations(-0.01, 0.03))));
  EXPECT_FALSE(hole(plan).given);
  EXPECT_THAT(said(), HasSubstr("#9200 diameter 8.2 -0.01/0.03: no size of its feature is"));
}

TEST_F(FromPmi, AToleranceOfAFaceThatStaysRawIsNamed) {
  const std::string part = bore_8();
  (void)planned(with(part, aspect(910, face(part, "0")) + measure(9300, 0.05) +
                               "#9301=FLATNESS_TOLERANCE('','',#9300,#910);\n"));
  EXPECT_THAT(said(), HasSubstr("#9301 flatness 0.05: no planned feature makes face " + face(part, "0")));
}

TEST_F(FromPmi, APositionWithItsDatumIsAskedOfTheHole) {
  const std::string part = bore_8();
  const auto plan = planned(
      with(part,
           aspect(910, face(part, "bore")) + measure(9300, 0.1) +
               "#9301=(GEOMETRIC_TOLERANCE('','',#9300,#910)GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE((#9302))"
               "POSITION_TOLERANCE());\n#9302=DATUM_SYSTEM('',$,#9003,.F.,(#9303));\n"
               "#9303=DATUM_REFERENCE_COMPARTMENT('',$,#9003,.F.,#9304,$);\n"
               "#9304=DATUM('',$,#9003,.F.,'A');\n#9305=DATUM_FEATURE('',$,#9003,.T.);\n"
               "#9306=SHAPE_ASPECT_RELATIONSHIP('',$,#9305,#9304);\n"
               "#9307=GEOMETRIC_ITEM_SPECIFIC_USAGE('','',#9305,#9003," +
               face(part, "0") + ");\n"));
  const auto holes = plan.model.all(TypeId::kRoundHole);
  ASSERT_EQ(holes.size(), 1U);
  const auto q = model::quality_of(plan.model, model::Ref<model::ManufacturingFeature>(holes.front()));
  EXPECT_EQ(q.location_mm, 0.1);
  EXPECT_THAT(q.datums, ::testing::ElementsAre("A"));
}

TEST_F(FromPmi, ATextureIsOfTheSideOrTheBottomThatItsFaceIs) {
  const std::string part = bore_8();
  const std::string texture = measure(9400, 1.6, 9002, "Ra") +
                              "#9401=PROPERTY_DEFINITION('surface_condition','',#910);\n"
                              "#9402=SURFACE_TEXTURE_REPRESENTATION('',(#9400),#9003);\n"
                              "#9403=PROPERTY_DEFINITION_REPRESENTATION(#9401,#9402);\n";
  for (const auto& [name, element] :
       {std::pair{"bore", model::BottomOrSide::kSide}, std::pair{"floor", model::BottomOrSide::kBottom}}) {
    const auto plan = planned(with(part, aspect(910, face(part, name)) + texture));
    const auto holes = plan.model.all(TypeId::kRoundHole);
    ASSERT_EQ(holes.size(), 1U);
    const auto q = model::quality_of(plan.model, model::Ref<model::ManufacturingFeature>(holes.front()));
    EXPECT_EQ(q.ra_um, 1.6) << name;
    const auto surfaces = plan.model.all(TypeId::kMachinedSurface);
    ASSERT_EQ(surfaces.size(), 1U);
    EXPECT_EQ(plan.model.at<model::MachinedSurface>(surfaces.front()).surface_element, element) << name;
  }
}

TEST_F(FromPmi, ATextureOfTheProductIsOfEveryFeature) {
  const std::string part = bore_8();
  const auto plan = planned(with(part, measure(9400, 3.2, 9002, "Ra") +
                                           "#9401=PROPERTY_DEFINITION('surface_condition','',#9003);\n"
                                           "#9402=SURFACE_TEXTURE_REPRESENTATION('',(#9400),#9003);\n"
                                           "#9403=PROPERTY_DEFINITION_REPRESENTATION(#9401,#9402);\n"));
  const auto holes = plan.model.all(TypeId::kRoundHole);
  ASSERT_EQ(holes.size(), 1U);
  EXPECT_EQ(model::quality_of(plan.model, model::Ref<model::ManufacturingFeature>(holes.front())).ra_um, 3.2);
}

/// A block of 60 x 60 x 20 mm with a pocket of 30 x 30 mm, 10 mm deep, in the middle of its top. Faces: the
/// box's without its top (0 to 4: bottom, front, back, left, right), the top in four (5 to 8), the pocket's
/// floor (9), and its walls at y = 15 (10), y = 45 (11), x = 15 (12), x = 45 (13).
std::string pocketed() {
  StepPart step;
  auto corners = StepPart::box_corners({0, 0, 0}, {60, 60, 20});
  const auto mouth = StepPart::box_corners({15, 15, 10}, {45, 45, 20});
  corners.insert(corners.end(), mouth.begin(), mouth.end());
  auto faces = StepPart::box_faces();
  faces.erase(faces.begin() + 1);
  for (const auto& f :
       std::vector<std::vector<int>>{{4, 5, 13, 12}, {5, 7, 15, 13}, {7, 6, 14, 15}, {6, 4, 12, 14}})
    faces.push_back(f);
  auto inner = StepPart::box_faces();
  inner.erase(inner.begin() + 1);
  for (auto& f : inner) {
    std::reverse(f.begin(), f.end());
    for (int& corner : f) corner += 8;
    faces.push_back(f);
  }
  step.product({step.solid(step.flat_faces(corners, faces), "pocketed")}, step.context());
  return step.text();
}

/// A distance of 30 mm between two aspects with deviations of both signs.
std::string distance(int id, int from, int to, double deviation) {
  const std::string n = "#" + std::to_string(id);
  return n + "0=DIMENSIONAL_LOCATION('linear distance',$,#" + std::to_string(from) + ",#" +
         std::to_string(to) + ");\n" + n + "1=SHAPE_DIMENSION_REPRESENTATION('',(" + n + "5),#9003);\n" + n +
         "2=DIMENSIONAL_CHARACTERISTIC_REPRESENTATION(" + n + "0," + n + "1);\n" + n +
         "3=PLUS_MINUS_TOLERANCE(" + n + "4," + n + "0);\n" + n + "4=TOLERANCE_VALUE(" + n + "6," + n +
         "7);\n" + measure(id * 10 + 5, 30.0) + measure(id * 10 + 6, -deviation) +
         measure(id * 10 + 7, deviation);
}

/// Aspects of the pocket's walls: 910 and 911 at x, 912 and 913 at y, 914: its floor.
std::string walls(const std::string& part) {
  return aspect(910, face(part, "12")) + aspect(911, face(part, "13")) + aspect(912, face(part, "10")) +
         aspect(913, face(part, "11")) + aspect(914, face(part, "9"));
}

/// The upper deviations of the pocket's size along x and along y.
std::pair<double, double> deviations_of(const model::Plan& plan) {
  const auto pockets = plan.model.all(TypeId::kClosedPocket);
  EXPECT_EQ(pockets.size(), 1U);
  if (pockets.empty()) return {};
  const auto& pocket = plan.model.at<model::ClosedPocket>(pockets.front());
  const auto* box = plan.model.get<model::RectangularClosedProfile>(model::AnyRef(pocket.feature_boundary));
  EXPECT_NE(box, nullptr);
  if (box == nullptr) return {};
  const auto frame = model::placement_or_identity(plan.model, pocket.feature_placement);
  const auto at = model::placement_or_identity(plan.model, box->placement);
  EXPECT_TRUE(frame && at);
  const Vec3 along = frame->direction_to_parent(at->x);
  const double length = model::length(plan.model, box->profile_length)->upper_mm;
  const double width = model::length(plan.model, box->profile_width)->upper_mm;
  return std::abs(along.x) > 0.5 ? std::pair{length, width} : std::pair{width, length};
}

TEST_F(FromPmi, OfASquarePocketADistanceIsOfTheWallsThatItNames) {
  const std::string part = pocketed();
  const auto plan =
      planned(with(part, walls(part) + distance(920, 910, 911, 0.1) + distance(930, 912, 913, 0.02)));
  const auto [x, y] = deviations_of(plan);
  EXPECT_NEAR(x, 0.1, 1e-9);
  EXPECT_NEAR(y, 0.02, 1e-9);
  EXPECT_THAT(said(), HasSubstr("2 of 2 tolerances"));
}

TEST_F(FromPmi, ADistanceOfNoTwoWallsIsNoSizeOfThePocket) {
  const std::string part = pocketed();
  (void)planned(with(part, walls(part) + distance(920, 914, 911, 0.1)));
  EXPECT_THAT(said(), HasSubstr("#9200 linear distance 30 -0.1/0.1: no size of its feature is"));
}

TEST_F(FromPmi, ASecondToleranceOfASizeIsNamed) {
  const std::string part = pocketed();
  const auto plan =
      planned(with(part, walls(part) + distance(920, 910, 911, 0.1) + distance(930, 911, 910, 0.02)));
  EXPECT_NEAR(deviations_of(plan).first, 0.1, 1e-9);
  EXPECT_THAT(said(), HasSubstr("#9300 linear distance 30 -0.02/0.02: its size has a tolerance already"));
}

TEST_F(FromPmi, FacesThatGetNothingOfAStatementAreNamed) {
  const std::string part = bore_8();
  const std::string both = aspect(910, "(" + face(part, "bore") + "," + face(part, "0") + ")");
  const std::string none =
      "asked of some of its faces only: no planned feature makes face " + face(part, "0");
  const auto plan = planned(with(part, both + diameter(8.0, deviations(-0.01, 0.03))));
  EXPECT_TRUE(hole(plan).given);
  EXPECT_THAT(said(), HasSubstr("0 of 1 tolerance"));
  EXPECT_THAT(said(), HasSubstr("#9200 diameter 8 -0.01/0.03: " + none));
  (void)planned(with(part, both + measure(9300, 0.05) + "#9301=CYLINDRICITY_TOLERANCE('','',#9300,#910);\n"));
  EXPECT_THAT(said(), HasSubstr("#9301 cylindricity 0.05: " + none));
  (void)planned(with(part, both + measure(9400, 1.6, 9002, "Ra") +
                               "#9401=PROPERTY_DEFINITION('surface_condition','',#910);\n"
                               "#9402=SURFACE_TEXTURE_REPRESENTATION('',(#9400),#9003);\n"
                               "#9403=PROPERTY_DEFINITION_REPRESENTATION(#9401,#9402);\n"));
  EXPECT_THAT(said(), HasSubstr("#9401 Ra 1.6: " + none));
}

TEST_F(FromPmi, AFitOfAShaftIsNotThatOfAHole) {
  const std::string part = bore_8();
  const auto plan = planned(with(
      part, aspect(910, face(part, "bore")) + diameter(8.0, "#9211=LIMITS_AND_FITS('H','shaft','7','');\n")));
  EXPECT_FALSE(hole(plan).given);
  EXPECT_THAT(said(), HasSubstr("the fit H7 is stated of a shaft"));
}

TEST_F(FromPmi, AnAngleWithoutAToleranceIsNoToleranceOfTheFile) {
  const std::string part = bore_8();
  const std::string angle = aspect(910, face(part, "bore")) + "#9200=ANGULAR_SIZE(#910,'angle',.SMALL.);\n";
  (void)planned(with(part, angle));
  EXPECT_THAT(said(), IsEmpty());
  (void)planned(with(part, angle + "#9203=PLUS_MINUS_TOLERANCE(#9211,#9200);\n"));
  EXPECT_THAT(said(), HasSubstr("0 of 1 tolerance"));
}

TEST_F(FromPmi, FeaturesAndTheirTolerancesAreBoundByRecognition) {
  const std::string part = bore_8();
  const auto plan =
      planned(with(part, aspect(910, face(part, "bore")) + diameter(8.0, deviations(-0.01, 0.03))));
  std::size_t bound = 0;
  for (const auto& [key, decision] : plan.ledger.entries()) {
    if (decision.binder != model::Binder::kRecognition) continue;
    ++bound;
    const auto why = plan.ledger.reason(decision.reason);
    EXPECT_THAT(why.text, HasSubstr(key.attribute == "feature_placement" ? face(part, "bore") : "#9200"));
  }
  EXPECT_EQ(bound, 2U);
}

}  // namespace
}  // namespace capstan::testing
