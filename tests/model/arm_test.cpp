// Every application object and attribute of ISO 10303-238 that concerns machining has a place in the model.

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "planner/model/features/curve_points.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/reached.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::model {
namespace {

struct Object {
  std::string name;
  std::vector<std::string> attributes;
};
struct Elsewhere {
  std::string object, attribute, where;
};

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, at);) out.push_back(word);
  return out;
}

const std::vector<Object>& arm_objects() {
  static const std::vector<Object> kObjects = {
#define ARM_OBJECT(object, attributes) {object, split(attributes, ' ')},
#define ARM_NOUN(object, noun)
#define ARM_PATH(object, attribute, where, note)
#include "tests/model/arm_names.inc"
#undef ARM_OBJECT
#undef ARM_NOUN
#undef ARM_PATH
  };
  return kObjects;
}

const std::map<std::string, std::string>& other_nouns() {
  static const std::map<std::string, std::string> kNouns = {
#define ARM_OBJECT(object, attributes)
#define ARM_NOUN(object, noun) {object, noun},
#define ARM_PATH(object, attribute, where, note)
#include "tests/model/arm_names.inc"
#undef ARM_OBJECT
#undef ARM_NOUN
#undef ARM_PATH
  };
  return kNouns;
}

const std::vector<Elsewhere>& other_paths() {
  static const std::vector<Elsewhere> kPaths = {
#define ARM_OBJECT(object, attributes)
#define ARM_NOUN(object, noun)
#define ARM_PATH(object, attribute, where, note) {object, attribute, where},
#include "tests/model/arm_names.inc"
#undef ARM_OBJECT
#undef ARM_NOUN
#undef ARM_PATH
  };
  return kPaths;
}

std::optional<TypeId> noun_of(const std::string& object) {
  const auto other = other_nouns().find(object);
  std::string keyword = other != other_nouns().end() ? other->second : object;
  for (char& c : keyword) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return find_noun(keyword);
}

/// The attribute of that kind, or of one below it: what a reference to the kind may lead to.
const Attribute* at_or_below(TypeId type, const std::string& name) {
  for (std::size_t t = 1; t < kTypeCount; ++t) {
    const auto kind = static_cast<TypeId>(t);
    if (!is_a(kind, type)) continue;
    if (const Attribute* a = find_attribute(kind, name)) return a;
  }
  return nullptr;
}

bool path_exists(const std::string& where) {
  const auto words = split(where, '.');
  auto kind = noun_of(words[0]);
  const Attribute* a = nullptr;
  for (std::size_t i = 1; i < words.size(); ++i) {
    if (i > 1) kind = a->targets.empty() ? std::nullopt : std::optional(a->targets[0]);
    if (!kind) return false;
    a = at_or_below(*kind, words[i]);
    if (a == nullptr) return false;
  }
  return a != nullptr;
}

bool is_elsewhere(const std::string& object, const std::string& attribute) {
  return std::any_of(other_paths().begin(), other_paths().end(),
                     [&](const Elsewhere& e) { return e.object == object && e.attribute == attribute; });
}

TEST(Arm, EveryObjectHasANoun) {
  for (const Object& o : arm_objects()) EXPECT_TRUE(noun_of(o.name)) << o.name;
  for (const auto& [object, noun] : other_nouns()) {
    std::string same = object;
    for (char& c : same) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    EXPECT_FALSE(find_noun(same)) << object << " needs no other name";
  }
}

TEST(Arm, EveryAttributeIsTheNounsOrStandsElsewhereByName) {
  for (const Object& o : arm_objects()) {
    const auto noun = noun_of(o.name);
    ASSERT_TRUE(noun) << o.name;
    for (const std::string& a : o.attributes) {
      EXPECT_NE(find_attribute(*noun, a) != nullptr, is_elsewhere(o.name, a)) << o.name << "." << a;
    }
  }
  for (const Elsewhere& e : other_paths()) EXPECT_TRUE(path_exists(e.where)) << e.where;
}

TEST(Arm, TheTableIsAsLongAsTheStandardsMapping) {
  // The machining part of ISO 10303-238's mapping table and ARM: 172 objects with 360 attributes; the
  // features, tolerances and properties beside them are counted by name above.
  std::set<std::string> objects;
  std::set<std::pair<std::string, std::string>> attributes;
  for (const Object& o : arm_objects()) {
    objects.insert(o.name);
    for (const std::string& a : o.attributes) attributes.emplace(o.name, a);
  }
  EXPECT_GE(objects.size(), 172u);
  EXPECT_GE(attributes.size(), 360u);
}

// The nouns of ISO 14649 are all there, and no more are; beside them AP238's and the planner's own may grow.
TEST(Nouns, OfIso14649AreAsManyAsTheStandardHasAndNoneOfTheOthersIsLost) {
  std::size_t iso14649 = 0, ap238 = 0, added = 0;
  for (std::size_t t = 1; t + 1 < kTypeCount; ++t) {  // all but the kept instances
    const NounType& n = noun_type(static_cast<TypeId>(t));
    ++(n.in_iso14649 ? iso14649 : ap238);
    const std::size_t inherited = n.parent == TypeId::kNone ? 0 : noun_type(n.parent).attributes.size();
    for (const Attribute& a : n.attributes.subspan(inherited)) added += a.in_iso14649 ? 0 : 1;
  }
  EXPECT_EQ(iso14649, 358u);
  EXPECT_GE(ap238, 74u);
  EXPECT_GE(added, 311u);
}

TEST(Nouns, NoKindHasTwoAttributesOfOneName) {
  for (std::size_t t = 1; t < kTypeCount; ++t) {
    std::set<std::string_view> names;
    for (const Attribute& a : noun_type(static_cast<TypeId>(t)).attributes) {
      EXPECT_TRUE(names.insert(a.name).second) << noun_type(static_cast<TypeId>(t)).keyword << "." << a.name;
    }
  }
}

TEST(Nouns, ATouchProbeIsAToolThatIso14649WritesWithItsIdAlone) {
  EXPECT_TRUE(is_a(TypeId::kTouchProbe, TypeId::kMachiningTool));
  std::vector<std::string> written;
  for (const Attribute& a : noun_type(TypeId::kTouchProbe).attributes) {
    if (a.in_iso14649) written.emplace_back(a.name);
  }
  EXPECT_EQ(written, std::vector<std::string>{"its_id"});
}

TEST(Nouns, AListOfSeveralKindsTakesEachOfThemAndNamesThem) {
  Model m;
  ToolpathList list;
  list.its_list.push_back(m.add(CutterLocationTrajectory{}));
  list.its_list.push_back(m.add(OptionalStop{}));
  const Attribute* a = find_attribute(TypeId::kToolpathList, "its_list");
  ASSERT_NE(a, nullptr);
  EXPECT_EQ(std::vector<TypeId>(a->targets.begin(), a->targets.end()),
            (std::vector<TypeId>{TypeId::kToolpath, TypeId::kNcFunction}));
  EXPECT_EQ(value_of<AnyRefList>(*a, &list).items.size(), 2u);
  EXPECT_TRUE(has_value(*a, &list));
}

TEST(Nouns, WhatIsStatedOfAWorkpieceIsReachedFromIt) {
  Model m;
  const auto piece = m.add(Workpiece{});
  FlatnessTolerance flat;
  flat.its_workpiece = piece;
  flat.tolerance_value = 0.02;
  const auto tolerance = m.add(flat);
  m.at<Workpiece>(piece).its_requirements.push_back(tolerance);
  const AnyRef roots[] = {piece};
  const auto found = reachable(m, roots);
  EXPECT_NE(std::find(found.begin(), found.end(), AnyRef(tolerance)), found.end());
}

// Also of kinds that hold no reference, are a root, or are met twice.
TEST(Nouns, ThoseOfAKindThatAreReachedAreTheSameInTheSameOrder) {
  Model m;
  std::vector<AnyRef> roots;
  for (int i = 0; i < 4; ++i) {
    Polyline line;
    const auto shared = m.add(CartesianPoint{});
    for (int k = 0; k < 3; ++k) {
      line.points.push_back(m.add(CartesianPoint{}));
      line.points.push_back(shared);
    }
    line.points.push_back(Ref<CartesianPoint>(m.add(ViaArcPoint{})));
    if (i == 2) roots.push_back(shared);
    CutterLocationTrajectory path;
    path.basiccurve = m.add(line);
    ToolpathList list;
    list.its_list.push_back(m.add(path));
    list.its_list.push_back(m.add(Feedstop{}));
    roots.push_back(m.add(list));
    roots.push_back({});
  }
  const auto all = reachable(m, roots);
  for (const TypeId kind :
       {TypeId::kToolpath, TypeId::kCartesianPoint, TypeId::kViaArcPoint, TypeId::kPolyline,
        TypeId::kToolpathList, TypeId::kWorkpiece, TypeId::kRepresentationItem}) {
    std::vector<AnyRef> wanted;
    for (const AnyRef r : all) {
      if (is_a(r.type, kind)) wanted.push_back(r);
    }
    EXPECT_EQ(reached_of(m, roots, kind), wanted) << noun_type(kind).keyword;
  }
  EXPECT_FALSE(reached_of(m, roots, TypeId::kCartesianPoint).empty());
}

TEST(CurvePoints, APolylineWithAViaPointIsRefusedNotCutStraight) {
  Model m;
  Polyline arc;
  for (const double x : {0.0, 10.0}) {
    CartesianPoint p;
    p.coordinates = {{x, 0.0, 0.0}, true};
    if (x > 0.0) {
      ViaArcPoint via;
      via.coordinates = {{5.0, 5.0, 0.0}, true};
      arc.points.push_back(m.add(via));
    }
    arc.points.push_back(m.add(p));
  }
  const auto points = curve_points(m, m.add(arc));
  ASSERT_FALSE(points);
  EXPECT_EQ(points.error().code, "CRV-UNSUPPORTED");
}

}  // namespace
}  // namespace capstan::model
