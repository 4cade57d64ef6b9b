#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <string_view>
#include <type_traits>

#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/ground/vocabulary/limit.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/ground/vocabulary/shape_kind.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/plan/cutter/cutter_fields.h"
#include "planner/model/plan/cutter/outline/outline.h"

namespace capstan::model {
namespace {

TEST(Vocabulary, NamesEveryClassOfCutterOnce) {
  std::set<std::string_view> names, words, fusion, freecad;
  for (const CutterClassRow& r : cutter_classes()) {
    EXPECT_TRUE(names.insert(r.name).second) << r.name;
    EXPECT_TRUE(words.insert(r.words).second) << r.words;
    EXPECT_TRUE(r.fusion.empty() || fusion.insert(r.fusion).second) << r.fusion;
    EXPECT_TRUE(r.freecad.empty() || freecad.insert(r.freecad).second) << r.freecad;
  }
}

// The reader goes by the nearest noun above: a row whose body is no tool body would never be read back.
TEST(Vocabulary, WritesEveryClassAsAConcreteToolBody) {
  for (const CutterClassRow& r : cutter_classes()) {
    if (r.value == CutterClass::kTouchProbe) continue;  // a tool of its own, without a body
    EXPECT_TRUE(is_a(r.body, TypeId::kMillingToolBody)) << r.name;
    EXPECT_FALSE(noun_type(r.body).abstract) << r.name;
  }
}

// A name that is no number of Cutter would never be stated: no cutter of the class could be used.
TEST(Vocabulary, NamesFieldsOfACutterThatMustBeStated) {
  std::set<std::string_view> numbers;
  const Cutter any;
  for_each_field(any, [&](const auto& row, const auto& value) {
    if constexpr (std::is_same_v<std::decay_t<decltype(value)>, double>) numbers.insert(row.name);
  });
  for (const CutterClassRow& r : cutter_classes()) {
    EXPECT_EQ(r.must.field.empty(), r.must.words.empty()) << r.name;
    EXPECT_TRUE(r.must.field.empty() || numbers.contains(r.must.field)) << r.name << ' ' << r.must.field;
  }
}

// Two files of plan/cutter/outline that describe one cutter would make its outline a matter of their names.
TEST(Vocabulary, GivesACutterOfAnyClassOneOutline) {
  for (const CutterClassRow& r : cutter_classes()) {
    Cutter c;
    c.cutter_class = r.value;
    c.cutting_diameter_mm = 10.0;
    c.maximum_depth_of_cut_mm = 20.0;
    c.point_angle_rad = 2.0;
    c.lead_angle_rad = 0.5;
    c.taper_angle_rad = 0.1;
    const auto all = outline::outlines();
    EXPECT_LE(std::count_if(all.begin(), all.end(), [&](const auto& o) { return o.describes(c); }), 1)
        << r.name;
  }
}

// One step: a format that has neither the class nor its stand-in says so.
TEST(Vocabulary, StandsInWithAClassThatNeedsNone) {
  for (const CutterClassRow& r : cutter_classes())
    EXPECT_EQ(row_of(r.stand_in).stand_in, r.stand_in) << r.name;
}

TEST(Vocabulary, TakesTheMoreTellingWordOfAComment) {
  EXPECT_EQ(cutter_class_called("ball probe 3 mm"), CutterClass::kTouchProbe);
  EXPECT_EQ(cutter_class_called("tap drill 5.0"), CutterClass::kTwistDrill);
  EXPECT_EQ(cutter_class_called("gewindebohrer m6"), CutterClass::kTap);
  EXPECT_EQ(cutter_class_called("threadmill 60 deg"), CutterClass::kThreadMill);
  EXPECT_EQ(cutter_class_called("back countersink 90 deg"), CutterClass::kBackCountersink);
  EXPECT_EQ(cutter_class_called("kugelfräser"), CutterClass::kBallEndmill);
  EXPECT_EQ(cutter_class_called("holder"), std::nullopt);
}

TEST(Vocabulary, CallsEveryClassByItsOwnWords) {
  for (const CutterClassRow& r : cutter_classes()) {
    std::string lower(r.words);
    for (char& c : lower) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c;
    EXPECT_EQ(cutter_class_called(lower), r.value) << r.words;
  }
}

TEST(Vocabulary, HasEveryConcreteOperationOnce) {
  std::set<TypeId> seen;
  for (const OperationRow& r : operations()) {
    EXPECT_TRUE(seen.insert(r.value).second) << noun_type(r.value).keyword;
    EXPECT_TRUE(is_a(r.value, TypeId::kMachiningOperation)) << noun_type(r.value).keyword;
  }
  for (std::size_t i = 0; i < kTypeCount; ++i) {
    const auto t = static_cast<TypeId>(i);
    // ISO 14649's freeform operation says neither rough nor finish: planning makes AP238's two.
    if (t == TypeId::kKeptInstance || t == TypeId::kFreeformOperation) continue;
    if (!is_a(t, TypeId::kMachiningOperation) || noun_type(t).abstract) continue;
    EXPECT_EQ(seen.count(t), 1U) << noun_type(t).keyword;
  }
}

TEST(Vocabulary, RanksOperationsInTheOrderOfTheCraft) {
  EXPECT_LT(craft_rank(TypeId::kCenterDrilling), craft_rank(TypeId::kDrilling));
  EXPECT_LT(craft_rank(TypeId::kDrilling), craft_rank(TypeId::kSideRoughMilling));
  EXPECT_LT(craft_rank(TypeId::kSideRoughMilling), craft_rank(TypeId::kSideFinishMilling));
  EXPECT_LT(craft_rank(TypeId::kSideFinishMilling), craft_rank(TypeId::kReaming));
  EXPECT_EQ(craft_rank(TypeId::kExtendedOperation), craft::kNone);
}

TEST(Vocabulary, NamesEveryLimitOnceWithItsUnit) {
  std::set<std::string_view> names;
  for (const LimitRow& r : kLimitRows) {
    EXPECT_TRUE(names.insert(r.name).second) << r.name;
    EXPECT_FALSE(r.unit.empty()) << r.name;
    EXPECT_TRUE(!r.of_loads || r.eased) << r.name;  // loads fall with the feed
  }
  for (const Limit l : kSectionLimits) EXPECT_TRUE(row_of(l).of_loads) << row_of(l).name;
}

TEST(Vocabulary, NamesEveryShapeOnce) {
  std::set<std::string_view> names;
  for (const ShapeKindRow& r : shape_kinds()) EXPECT_TRUE(names.insert(r.name).second) << r.name;
}

TEST(SameForm, LooksAtSizesAndNotAtPlaces) {
  FeatureShape a;
  a.kind = ShapeKind::kHole;
  a.depth_mm = 10.0;
  a.diameter = {8.0, 0.0, 0.015, true};
  FeatureShape b = a;
  b.frame.origin = {20.0, 5.0, 0.0};
  EXPECT_TRUE(same_form(a, b));
  b.diameter.upper_mm = 0.036;
  EXPECT_FALSE(same_form(a, b));
  b = a;
  b.bottom_angle_rad = 0.5;  // another point's mark at the bottom
  EXPECT_FALSE(same_form(a, b));
}

}  // namespace
}  // namespace capstan::model
