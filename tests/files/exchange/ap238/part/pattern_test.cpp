#include "planner/model/features/shape.h"
#include "tests/files/exchange/ap238/part/feature_support.h"

namespace capstan::exchange::ap238 {
namespace {

using model::AnyRef;
using model::Ref;

struct PatternBench : FeatureBench {
  Ref<model::RoundHole> hole(const std::string& id, double diameter) {
    auto f = basic<model::RoundHole>(id);
    f.diameter = length(diameter);
    f.bottom_condition = as<model::HoleBottomCondition>(m.add(model::ThroughBottomCondition{}));
    return m.add(std::move(f));
  }
};

TEST(CircularPattern, IsWrittenByItsRulesAndComesBackEqual) {
  PatternBench b;
  auto f = b.basic<model::CircularPattern>("C");
  f.replicate_base_feature = b.as<model::Two5dManufacturingFeature>(b.hole("H", 8));
  f.angle_increment = 0.5;
  f.number_of_feature = 7;
  f.base_feature_diameter = b.length(60);
  f.base_feature_rotation = 0.25;
  f.relocated_base_feature.given = f.missing_base_feature.given = true;
  model::CircularOffset offset;
  offset.angular_offset = 0.0625;
  offset.index = 3;
  f.relocated_base_feature.items = {b.m.add(std::move(offset))};
  model::CircularOmit omit;
  omit.index = 5;
  f.missing_base_feature.items = {b.m.add(std::move(omit))};
  b.m.add(std::move(f));
  const Shapes s(b.plan);
  EXPECT_TRUE(
      s.has("(CHARACTERIZED_OBJECT('',$)CIRCULAR_PATTERN()FEATURE_DEFINITION()INSTANCED_FEATURE()REPLICATE_"
            "FEATURE()SHAPE_ASPECT('C',$,#,.T.));"));
  EXPECT_TRUE(s.has("FEATURE_COMPONENT_RELATIONSHIP('pattern basis',$,#,#);"));
  EXPECT_TRUE(s.has("MEASURE_REPRESENTATION_ITEM('number of features',COUNT_MEASURE(7.),#);"));
  EXPECT_TRUE(s.has("PATTERN_OFFSET_MEMBERSHIP('',$,#,#);"));
  EXPECT_TRUE(s.has("PATTERN_OMIT_MEMBERSHIP('',$,#,#);"));
  EXPECT_TRUE(s.has("MEASURE_REPRESENTATION_ITEM('index number',COUNT_MEASURE(3.),#);"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(RectangularPattern, IsWrittenByItsRulesAndComesBackEqual) {
  PatternBench b;
  auto f = b.basic<model::RectangularPattern>("R");
  f.replicate_base_feature = b.as<model::Two5dManufacturingFeature>(b.hole("H", 8));
  f.spacing = b.length(20);
  f.its_direction = b.direction(1, 0, 0);
  f.number_of_rows = 3;
  f.number_of_columns = 4;
  f.row_spacing = b.length(25);
  f.row_layout_direction = b.direction(0, 1, 0);
  f.relocated_base_feature.given = f.missing_base_feature.given = true;
  model::RectangularOffset offset;
  offset.offset_direction = b.direction(0.6, 0.8, 0);
  offset.offset_distance = 1.5;
  offset.row_index = 1;
  offset.column_index = 2;
  f.relocated_base_feature.items = {b.m.add(std::move(offset))};
  for (const int i : {1, 3}) {
    model::RectangularOmit omit;
    omit.row_index = i;
    omit.column_index = 4;
    f.missing_base_feature.items.push_back(b.m.add(std::move(omit)));
  }
  b.m.add(std::move(f));
  const Shapes s(b.plan);
  EXPECT_TRUE(s.has("DIRECTION_SHAPE_REPRESENTATION('row layout direction',(#),#);"));
  EXPECT_TRUE(s.has("DIRECTION_SHAPE_REPRESENTATION('column layout direction',(#),#);"));
  EXPECT_TRUE(s.has("DIRECTION_SHAPE_REPRESENTATION('offset direction',(#),#);"));
  EXPECT_TRUE(s.has("MEASURE_REPRESENTATION_ITEM('number of rows',COUNT_MEASURE(3.),#);"));
  EXPECT_TRUE(s.has("MEASURE_REPRESENTATION_ITEM('number of columns',COUNT_MEASURE(4.),#);"));
  EXPECT_EQ(s.count("PATTERN_OMIT_MEMBERSHIP('',$,#,#);"), 2);
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(GeneralPattern, KeepsItsPlacesInOrder) {
  PatternBench b;
  auto f = b.basic<model::GeneralPattern>("G");
  f.replicate_base_feature = b.as<model::Two5dManufacturingFeature>(b.hole("H", 8));
  f.replicate_locations.given = true;
  for (const double x : {30.0, 10.0, 20.0}) f.replicate_locations.items.push_back(b.placement(x, 5, 0));
  b.m.add(std::move(f));
  EXPECT_EQ(Shapes(b.plan).count("AXIS2_PLACEMENT_3D('base feature placement',#,#,#);"), 3);
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(CompositeHoles, KeepTheirElementsInOrder) {
  PatternBench b;
  auto f = b.basic<model::CounterboreHole>("K");
  f.elements.given = true;
  for (const double d : {20.0, 8.0, 14.0})
    f.elements.items.push_back(b.hole("H" + std::to_string(static_cast<int>(d)), d));
  const AnyRef at = b.m.add(std::move(f));
  const Shapes s(b.plan);
  EXPECT_TRUE(s.has("COMPOSITE_SHAPE_ASPECT('compound feature in solid',$,#,.F.);"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
  const auto back = read_text(written(b.plan).bytes);
  const auto all = back.model.all(at.type);
  ASSERT_EQ(all.size(), 1u);
  std::vector<std::string> ids;
  for (const AnyRef e : back.model.at<model::CompoundFeature>(all.front()).elements.items) {
    ids.push_back(back.model.at<model::ManufacturingFeature>(e).its_id.value_or(""));
  }
  EXPECT_EQ(ids, (std::vector<std::string>{"H20", "H8", "H14"}));
}

TEST(CompoundFeature, OfAnyFeaturesKeepsTheirOrder) {
  PatternBench b;
  auto f = b.basic<model::CompoundFeature>("C");
  f.elements.given = true;
  for (const double d : {12.0, 30.0, 6.0}) {
    f.elements.items.push_back(b.hole("H" + std::to_string(static_cast<int>(d)), d));
  }
  b.m.add(std::move(f));
  const Shapes s(b.plan);
  EXPECT_TRUE(
      s.has("(CHARACTERIZED_OBJECT('',$)COMPOUND_FEATURE()FEATURE_DEFINITION()INSTANCED_FEATURE()"
            "SHAPE_ASPECT('C',$,#,.T.));"));
  EXPECT_TRUE(s.has("COMPOSITE_SHAPE_ASPECT('compound feature in solid',$,#,.F.);"));
  EXPECT_EQ(lost_on_the_way(b.plan), "");
}

TEST(CompositeHoles, AreToldApartByDescription) {
  for (const bool bore : {true, false}) {
    PatternBench b;
    const auto fill = [&](auto f) {
      f.elements.given = true;
      f.elements.items = {b.hole("A", 20), b.hole("B", 8)};
      b.m.add(std::move(f));
    };
    if (bore) {
      fill(b.basic<model::CounterboreHole>("K"));
    } else {
      fill(b.basic<model::CountersunkHole>("K"));
    }
    EXPECT_TRUE(
        Shapes(b.plan).has("(CHARACTERIZED_OBJECT('','" + std::string(bore ? "counterbore" : "countersunk") +
                           "')COMPOSITE_HOLE()COMPOUND_FEATURE()FEATURE_DEFINITION()INSTANCED_FEATURE()SHAPE_"
                           "ASPECT('K',$,#,.T.));"));
    EXPECT_EQ(lost_on_the_way(b.plan), "");
  }
}

/// Where the members of the only feature of that kind stand.
std::string members(const model::Plan& plan, model::TypeId type) {
  std::string out;
  const auto all = plan.model.all(type);
  EXPECT_EQ(all.size(), 1u);
  const auto shapes = model::shapes_of(plan.model, Ref<model::ManufacturingFeature>(all.front()));
  EXPECT_TRUE(shapes) << (shapes ? "" : shapes.error().message);
  for (const auto& s : shapes ? *shapes : std::vector<model::FeatureShape>{}) {
    char text[96];
    std::snprintf(text, sizeof text, "%.6g,%.6g,%.6g ", s.frame.origin.x + 0.0, s.frame.origin.y + 0.0,
                  s.frame.origin.z + 0.0);
    out += text;
  }
  return out;
}

TEST(CompoundFeature, ItsElementsAreRelativeToItInBothForms) {
  PatternBench b;
  auto f = b.basic<model::CompoundFeature>("C");
  f.feature_placement = b.placement(100, 50, 0);
  const auto h = b.hole("H", 8);
  b.m.at<model::RoundHole>(h).feature_placement = b.placement(10, 0, 0);
  f.elements.given = true;
  f.elements.items = {h};
  b.m.add(std::move(f));
  EXPECT_EQ(members(b.plan, model::TypeId::kCompoundFeature), "110,50,0 ");
  const auto back = read_text(written(b.plan).bytes);
  EXPECT_EQ(members(back, model::TypeId::kCompoundFeature), "110,50,0 ");
}

// AP238 places a slot at its profile's origin, the model on top: the locations of a pattern of slots follow.
TEST(GeneralPattern, OfSlotsStandsWhereItStoodWhenItComesBack) {
  PatternBench b;
  auto slot = b.basic<model::Slot>("S");
  slot.feature_placement = b.placement(0, 0, 0);
  slot.course_of_travel = b.as<model::TravelPath>(b.line(60, 0, 1, 0));
  model::SquareUProfile u;
  u.width = b.length(10);
  u.first_radius = b.length(0);
  u.second_radius = b.length(0);
  slot.swept_shape = b.as<model::OpenProfile>(b.m.add(std::move(u)));
  slot.end_conditions.given = true;
  auto f = b.basic<model::GeneralPattern>("G");
  f.feature_placement = b.placement(100, 50, 0);
  f.replicate_base_feature = b.as<model::Two5dManufacturingFeature>(b.m.add(std::move(slot)));
  f.replicate_locations.given = true;
  f.replicate_locations.items.push_back(b.placement(30, 0, 0));
  b.m.add(std::move(f));
  EXPECT_EQ(members(b.plan, model::TypeId::kGeneralPattern), "100,50,0 130,50,0 ");
  const auto back = read_text(written(b.plan).bytes);
  EXPECT_EQ(members(back, model::TypeId::kGeneralPattern), "100,50,0 130,50,0 ");
}

}  // namespace
}  // namespace capstan::exchange::ap238
