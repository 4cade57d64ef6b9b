#include "planner/files/exchange/express/dictionary.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <vector>

#include "planner/files/exchange/common/embedded.h"

namespace capstan::exchange::express {
namespace {

using ::testing::ElementsAre;

const Dictionary& ap238() { return Dictionary::ap238(); }

EntityId id(std::string_view keyword) {
  const EntityId e = ap238().find(keyword);
  EXPECT_NE(e, kNoEntity) << keyword;
  return e;
}

// "name" per parameter, with ? where $ is allowed and * where derived.
std::vector<std::string> parameters(std::span<const Slot> slots) {
  std::vector<std::string> out;
  for (const Slot& s : slots)
    out.push_back(std::string(s.derived ? "*" : s.optional ? "?" : "") + std::string(s.name));
  return out;
}
std::vector<std::string> parameters(std::string_view keyword) {
  return parameters(ap238().slots(id(keyword)));
}

std::vector<std::string> closure(std::vector<EntityId> leaves) {
  std::vector<std::string> out;
  for (const EntityId e : ap238().closure(leaves)) out.emplace_back(ap238().keyword(e));
  return out;
}

TEST(Dictionary, HoldsEditionThreeAndTheSupplement) {
  constexpr std::size_t kEdition3 = 1464, kSupplement = 29;
  EXPECT_EQ(ap238().size(), kEdition3 + kSupplement);
  EXPECT_NE(ap238().find("MACHINING_BROADCAST_STRATEGY"), kNoEntity);
  EXPECT_TRUE(ap238().is_a(id("MACHINING_BROADCAST_STRATEGY"), id("ACTION_METHOD")));
}

TEST(Dictionary, FindsKeywordsInAnyCase) {
  EXPECT_EQ(ap238().find("cartesian_point"), ap238().find("CARTESIAN_POINT"));
  EXPECT_EQ(ap238().keyword(id("Cartesian_Point")), "CARTESIAN_POINT");
  EXPECT_EQ(ap238().find("NO_SUCH_THING"), kNoEntity);
  EXPECT_EQ(ap238().find(""), kNoEntity);
  EXPECT_EQ(ap238().find("LENGTH_MEASURE"), kNoEntity);  // a type, not an entity
  EXPECT_NE(ap238().find_type("LENGTH_MEASURE"), nullptr);
  EXPECT_EQ(ap238().find_type("CARTESIAN_POINT"), nullptr);
}

TEST(Dictionary, NumbersEntitiesInTheOrderOfTheirKeywords) {
  for (std::size_t i = 0; i < ap238().size(); ++i) {
    const EntityId e{static_cast<std::uint16_t>(i)};
    EXPECT_EQ(ap238().find(ap238().keyword(e)), e);
    if (i > 0) {
      EXPECT_LT(ap238().keyword(EntityId{static_cast<std::uint16_t>(i - 1)}), ap238().keyword(e));
    }
  }
}

TEST(Dictionary, PutsAttributesOfSupertypesFirst) {
  EXPECT_THAT(parameters("PRODUCT_DEFINITION"),
              ElementsAre("id", "?description", "formation", "frame_of_reference"));
  EXPECT_THAT(parameters("CARTESIAN_POINT"), ElementsAre("name", "coordinates"));
  EXPECT_THAT(parameters("MACHINING_TOOLPATH_SEQUENCE_RELATIONSHIP"),
              ElementsAre("name", "?description", "relating_method", "related_method", "sequence_position"));
  EXPECT_THAT(parameters("B_SPLINE_CURVE_WITH_KNOTS"),
              ElementsAre("name", "degree", "control_points_list", "curve_form", "closed_curve",
                          "self_intersect", "knot_multiplicities", "knots", "knot_spec"));
  EXPECT_THAT(parameters("GEOMETRIC_TOLERANCE_WITH_DATUM_REFERENCE"),
              ElementsAre("name", "?description", "?magnitude", "toleranced_shape_aspect", "datum_system"));
}

TEST(Dictionary, StarsWhatASubtypeDerives) {
  EXPECT_THAT(parameters("SI_UNIT"), ElementsAre("*dimensions", "?prefix", "name"));
  EXPECT_THAT(parameters("CONVERSION_BASED_UNIT"), ElementsAre("dimensions", "name", "conversion_factor"));
}

TEST(Dictionary, TellsThePartsOfAComplexInstanceAndTheirParameters) {
  const std::vector<EntityId> leaves{id("SI_UNIT"), id("LENGTH_UNIT")};
  EXPECT_THAT(closure(leaves), ElementsAre("LENGTH_UNIT", "NAMED_UNIT", "SI_UNIT"));
  const auto parts = ap238().closure(leaves);
  EXPECT_THAT(parameters(ap238().part_slots(id("NAMED_UNIT"), parts)), ElementsAre("*dimensions"));
  const auto inch = ap238().closure(std::vector{id("CONVERSION_BASED_UNIT"), id("LENGTH_UNIT")});
  EXPECT_THAT(parameters(ap238().part_slots(id("NAMED_UNIT"), inch)), ElementsAre("dimensions"));
  EXPECT_THAT(closure({id("MEASURE_REPRESENTATION_ITEM"), id("LENGTH_MEASURE_WITH_UNIT")}),
              ElementsAre("LENGTH_MEASURE_WITH_UNIT", "MEASURE_REPRESENTATION_ITEM", "MEASURE_WITH_UNIT",
                          "REPRESENTATION_ITEM"));
  EXPECT_THAT(closure({id("RATIONAL_B_SPLINE_CURVE"), id("B_SPLINE_CURVE_WITH_KNOTS")}),
              ElementsAre("BOUNDED_CURVE", "B_SPLINE_CURVE", "B_SPLINE_CURVE_WITH_KNOTS", "CURVE",
                          "GEOMETRIC_REPRESENTATION_ITEM", "RATIONAL_B_SPLINE_CURVE", "REPRESENTATION_ITEM"));
}

TEST(Dictionary, KnowsWhereAnAttributeStandsAndWhoDeclaresIt) {
  const EntityId hole = id("ROUND_HOLE");  // FEATURE_DEFINITION of CHARACTERIZED_OBJECT
  EXPECT_EQ(ap238().owner(hole, "name"), id("CHARACTERIZED_OBJECT"));
  const EntityId instanced = id("INSTANCED_FEATURE");  // and of SHAPE_ASPECT: two names
  const auto first = ap238().position(instanced, "name");
  const auto of_shape = ap238().position(instanced, "shape_aspect.name");
  const auto of_object = ap238().position(instanced, "characterized_object.name");
  ASSERT_TRUE(first && of_shape && of_object);
  EXPECT_NE(*of_shape, *of_object);
  EXPECT_EQ(ap238().position(hole, "no_such"), std::nullopt);
  EXPECT_EQ(ap238().owner(hole, "no_such"), kNoEntity);
}

TEST(Dictionary, SaysWhatASelectAdmits) {
  const Type* target = ap238().find_type("SHAPE_DEFINITION");
  ASSERT_NE(target, nullptr);
  EXPECT_TRUE(ap238().admits(*target, id("SHAPE_ASPECT")));
  EXPECT_TRUE(ap238().admits(*target, id("INSTANCED_FEATURE")));
  EXPECT_FALSE(ap238().admits(*target, id("CARTESIAN_POINT")));
  const Type* value = ap238().find_type("MEASURE_VALUE");
  ASSERT_NE(value, nullptr);
  bool length = false;
  for (const Type* v : value->values) length |= v->name == "LENGTH_MEASURE";
  EXPECT_TRUE(length);
}

TEST(Dictionary, ReadsEachFormOfItsTable) {
  const Dictionary d(
      "entity ab abstract : ; size ? list 1:3 unique real ; grid array 0:2 optional b_or_c ; name string\n"
      "entity ac : ab ; ab\\size list 2:2 real ; * ab\\name ; ab\\grid=cells array 0:2 ac\n"
      "enum b = red green\n"
      "select b_or_c = b c ab\n"
      "type c = d\n"
      "type d = integer\n");
  const auto slots = d.slots(d.find("ac"));
  ASSERT_EQ(slots.size(), 3U);
  EXPECT_FALSE(slots[0].optional);
  EXPECT_EQ(slots[0].type->lower, 2U);
  EXPECT_EQ(d.slots(d.find("ab"))[0].type->upper, 3U);
  EXPECT_TRUE(d.slots(d.find("ab"))[0].type->unique);
  EXPECT_EQ(slots[1].name, "cells");
  EXPECT_EQ(slots[1].type->lower, 3U);
  EXPECT_EQ(d.position(d.find("ac"), "grid"), 1U);
  EXPECT_EQ(d.position(d.find("ac"), "cells"), 1U);
  EXPECT_TRUE(slots[2].derived);
  EXPECT_TRUE(d.abstract(d.find("ab")));
  EXPECT_TRUE(d.admits(*d.find_type("b_or_c"), d.find("ac")));
  EXPECT_THAT(d.find_type("b")->enumerators, ElementsAre("RED", "GREEN"));
  EXPECT_EQ(d.find_type("b_or_c")->values.size(), 2U);
  EXPECT_THROW(Dictionary("entity a : b\n"), std::logic_error);
  EXPECT_THROW(Dictionary("entity a :\nentity a :\n"), std::logic_error);
}

TEST(Dictionary, IsBuiltAgainFromItsTableWithTheSameEntities) {
  const Dictionary d(embedded_file("express/ap238.table"));
  ASSERT_EQ(d.size(), ap238().size());
  EXPECT_GT(d.size(), 0U);
}

}  // namespace
}  // namespace capstan::exchange::express
