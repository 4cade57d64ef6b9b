#include "planner/model/features/quality.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/model/features/requirements.h"
#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

/// A face that is datum A, a hole, a pocket, and what is stated of them.
struct Part {
  Model m;
  Ref<Workpiece> piece;
  Ref<PlanarFace> face;
  Ref<RoundHole> hole;
  Ref<ClosedPocket> pocket;
  Ref<Datum> a;

  Part() {
    piece = m.add(Workpiece{});
    face = named<PlanarFace>("top");
    hole = named<RoundHole>("H1");
    pocket = named<ClosedPocket>("P1");
    Datum d;
    d.identification = "A";
    d.established_by.push_back(face);
    a = m.add(d);
  }
  template <class T>
  Ref<T> named(const char* id) {
    T f;
    f.its_id = id;
    f.its_workpiece = piece;
    return m.add(f);
  }
  Ref<DatumSystem> system(std::vector<Ref<Datum>> datums) {
    DatumSystem s;
    for (const auto d : datums) {
      DatumReference r;
      r.referenced_datum = d;
      s.constituents.push_back(m.add(r));
    }
    return m.add(s);
  }
  template <class T, class... F>
  Ref<T> tolerance(double value, F... of) {
    T t;
    t.tolerance_value = value;
    (t.applied_to.push_back(of), ...);
    return m.add(t);
  }
};

TEST(Quality, PutsEachOfTheFifteenKindsWhereItBelongs) {
  const auto of = [](auto tag) {
    Part p;
    using T = decltype(tag);
    p.tolerance<T>(0.03, p.hole);
    return quality_of(p.m, p.hole);
  };
  for (const Quality& q : {of(StraightnessTolerance{}), of(FlatnessTolerance{}), of(RoundnessTolerance{}),
                           of(CylindricityTolerance{})}) {
    EXPECT_EQ(q.form_mm, 0.03);
    EXPECT_FALSE(q.orientation_mm || q.location_mm || q.runout_mm || q.profile_mm);
  }
  for (const Quality& q :
       {of(ParallelismTolerance{}), of(PerpendicularityTolerance{}), of(AngularityTolerance{})})
    EXPECT_EQ(q.orientation_mm, 0.03);
  for (const Quality& q : {of(PositionTolerance{}), of(ConcentricityTolerance{}), of(CoaxialityTolerance{}),
                           of(SymmetryTolerance{})})
    EXPECT_EQ(q.location_mm, 0.03);
  for (const Quality& q : {of(CircularRunoutTolerance{}), of(TotalRunoutTolerance{})})
    EXPECT_EQ(q.runout_mm, 0.03);
  for (const Quality& q : {of(LineProfileTolerance{}), of(SurfaceProfileTolerance{})})
    EXPECT_EQ(q.profile_mm, 0.03);
}

TEST(Quality, SaysAPositionAsADrawingDoes) {
  Part p;
  Datum second;
  second.identification = "B";
  second.established_by.push_back(p.pocket);
  const auto b = p.m.add(second);
  const auto t = p.tolerance<PositionTolerance>(0.05, p.hole);
  p.m.at<PositionTolerance>(t).zone_form = "cylindrical or circular";
  p.m.at<PositionTolerance>(t).modifiers = {{"maximum_material_requirement"}, true};
  p.m.at<PositionTolerance>(t).its_datum_system = p.system({p.a, b});
  const Quality q = quality_of(p.m, p.hole);
  EXPECT_THAT(q.texts, ElementsAre("position dia 0.05 (M) | A | B"));
  EXPECT_THAT(q.datums, ElementsAre("A", "B"));
  EXPECT_THAT(quality_of(p.m, p.face).texts, IsEmpty());
}

TEST(Quality, FollowsSurfacesElementsDimensionsAndFaces) {
  Part p;
  MachinedSurface floor;
  floor.its_machining_feature = p.pocket;
  floor.surface_element = BottomOrSide::kBottom;
  p.tolerance<FlatnessTolerance>(0.02, p.m.add(floor));
  EXPECT_EQ(quality_of(p.m, p.pocket).form_mm, 0.02);

  ShapeElement element;
  element.its_elements.push_back(p.hole);
  ShapeElement group;
  group.its_elements.push_back(p.m.add(element));
  p.tolerance<PerpendicularityTolerance>(0.04, p.m.add(group));
  EXPECT_EQ(quality_of(p.m, p.hole).orientation_mm, 0.04);

  SizeDimension size;
  size.applied_to = p.hole;
  p.tolerance<CylindricityTolerance>(0.01, p.m.add(size));
  EXPECT_EQ(quality_of(p.m, p.hole).form_mm, 0.01);

  CartesianPoint stands_for_a_face;
  const auto shared = p.m.add(stands_for_a_face);
  p.m.at<PlanarFace>(p.face).explicit_representation.push_back(shared);
  ShapeElement drawn;
  drawn.explicit_representation.push_back(shared);
  p.tolerance<FlatnessTolerance>(0.005, p.m.add(drawn));
  EXPECT_EQ(quality_of(p.m, p.face).form_mm, 0.005);
}

TEST(Quality, TakesTheTightestAndOfACompoundAllItsElements) {
  Part p;
  CounterboreHole compound;
  compound.its_workpiece = p.piece;
  compound.elements.push_back(p.hole);
  const auto whole = p.m.add(compound);
  p.tolerance<PositionTolerance>(0.2, whole);
  p.tolerance<PositionTolerance>(0.1, p.hole);
  EXPECT_EQ(quality_of(p.m, whole).location_mm, 0.1);
  EXPECT_EQ(quality_of(p.m, p.hole).location_mm, 0.1);
}

TEST(Quality, TakesRaInMicrometresAndLeavesRzUnconverted) {
  Part p;
  SurfaceTextureParameter ra;
  ra.parameter_name = "Ra";
  ra.its_value = 1.6;
  ra.applied_to.push_back(p.hole);
  p.m.add(ra);
  SurfaceTextureParameter rz;
  rz.parameter_name = "Rz";
  rz.its_value = 6.3;
  rz.applied_to.push_back(p.pocket);
  p.m.add(rz);
  EXPECT_EQ(quality_of(p.m, p.hole).ra_um, 1.6);
  EXPECT_FALSE(quality_of(p.m, p.pocket).ra_um);
  EXPECT_THAT(quality_of(p.m, p.pocket).texts, ElementsAre("Rz 6.3"));
}

TEST(Quality, GivesATextureOfTheWholePartToWhatStatesNone) {
  Part p;
  SurfaceTextureParameter all;
  all.parameter_name = "Ra";
  all.its_value = 3.2;
  p.m.add(all);
  MachinedSurface wall;
  wall.its_machining_feature = p.pocket;
  SurfaceTextureParameter own;
  own.parameter_name = "Ra";
  own.its_value = 6.3;
  own.applied_surfaces.push_back(p.m.add(wall));
  p.m.add(own);
  EXPECT_EQ(quality_of(p.m, p.hole).ra_um, 3.2);
  EXPECT_EQ(quality_of(p.m, p.pocket).ra_um, 6.3);
}

TEST(Quality, NamesWhatNoFeatureAnswersForOnce) {
  Part p;
  p.tolerance<FlatnessTolerance>(0.02, p.m.add(ShapeElement{}));
  p.tolerance<FlatnessTolerance>(0.03, p.hole);
  p.tolerance<SurfaceProfileTolerance>(0.5);
  const auto lost = Attribution(p.m).lost();
  ASSERT_EQ(lost.size(), 1U);
  EXPECT_EQ(lost.front().text, "flatness 0.02");
  EXPECT_EQ(quality_of(p.m, p.pocket).profile_mm, 0.5) << "all over";
}

TEST(Quality, PutsOnlyAProfileThatNamesNothingOnEverything) {
  Part p;
  p.tolerance<FlatnessTolerance>(0.005);
  p.tolerance<PositionTolerance>(0.01);
  p.tolerance<TotalRunoutTolerance>(0.01);
  const Quality q = quality_of(p.m, p.hole);
  EXPECT_FALSE(q.form_mm || q.location_mm || q.runout_mm);
  EXPECT_THAT(q.texts, IsEmpty());
  const auto lost = Attribution(p.m).lost();
  ASSERT_EQ(lost.size(), 3U) << "kept, and said";
}

TEST(Quality, EndsOnShapeElementsThatHoldEachOther) {
  Part p;
  const auto one = p.m.add(ShapeElement{});
  ShapeElement other;
  other.its_elements.push_back(one);
  other.its_elements.push_back(p.hole);
  p.m.at<ShapeElement>(one).its_elements.push_back(p.m.add(other));
  p.tolerance<FlatnessTolerance>(0.02, one);
  EXPECT_EQ(quality_of(p.m, p.hole).form_mm, 0.02);
}

TEST(Ties, JoinDatumAndTolerancedFeatureAndWhatIsTolerancedTogether) {
  Part p;
  const auto t = p.tolerance<PositionTolerance>(0.05, p.hole, p.pocket);
  p.m.at<PositionTolerance>(t).its_datum_system = p.system({p.a});
  const auto ties = ties_of(p.m, Attribution(p.m));
  ASSERT_EQ(ties.size(), 3U);
  EXPECT_EQ(ties[0].first, model::AnyRef(p.face));
  EXPECT_EQ(ties[0].letter, "A");
  EXPECT_EQ(ties[0].text, "position 0.05 | A");
  EXPECT_TRUE(ties[2].letter.empty());
}

TEST(Ties, AreNotMadeByForm) {
  Part p;
  p.tolerance<FlatnessTolerance>(0.05, p.hole, p.pocket);
  EXPECT_TRUE(ties_of(p.m, Attribution(p.m)).empty());
}

TEST(GeneralToleranceOf, PrefersTheTextToTheNumber) {
  Part p;
  EXPECT_FALSE(*general_tolerance_of(p.m, p.piece));
  p.m.at<Workpiece>(p.piece).global_tolerance = 0.1;
  EXPECT_EQ((*general_tolerance_of(p.m, p.piece))->size_mm, 0.1);
  DescriptiveParameter text;
  text.parameter_name = "general tolerance";
  text.descriptive_string = "ISO 2768-mK";
  PartProperty property;
  property.its_parameters.push_back(p.m.add(text));
  p.m.at<Workpiece>(p.piece).its_properties.push_back(p.m.add(property));
  EXPECT_EQ((*general_tolerance_of(p.m, p.piece))->size_class, 'm');
}

}  // namespace
}  // namespace capstan::model
