#include "planner/door/app/show/inspect.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>
#include <utility>

#include "planner/model/features/shape.h"
#include "tests/door/app/plans.h"

namespace capstan::app {
namespace {

using ::testing::HasSubstr;

std::string at(const std::string& path) {
  const auto text = inspect(testing::read_text(testing::drilled_plate()), path);
  return text ? *text : "error: " + to_text(text.error());
}

TEST(Inspect, WalksAttributeNamesToOneValue) {
  EXPECT_EQ(at("/project/its_workpieces[0]/its_material/standard_identifier"), "'EN AW-6061'\n");
}

TEST(Inspect, ShowsNumbersWithTheUnitOfTheModel) {
  EXPECT_EQ(at("#45/feedrate"), "300 mm/min\n");  // 0.005 m/s
  EXPECT_EQ(at("#45/spindle"), "-960 1/min\n");   // -16 rev/s
  EXPECT_EQ(at("#58/theoretical_size"), "10 mm\n");
}

TEST(Inspect, FindsAnInstanceByItsNumber) { EXPECT_THAT(at("#17"), HasSubstr("#17 ROUND_HOLE 'HOLE'")); }

TEST(Inspect, ShowsAnObjectWithEveryAttributeAndSaysWhichAreAbsent) {
  const std::string text = at("#17");
  EXPECT_THAT(text, HasSubstr("its_id"));
  EXPECT_THAT(text, HasSubstr("change_in_diameter  absent"));
}

TEST(Inspect, MapsAStarOverAList) {
  EXPECT_EQ(at("/project/its_workpieces[0]/clamping_positions[*]/coordinates"),
            "(0, 0, 0) mm\n(0, 0, 30) mm\n");
  EXPECT_EQ(at("/project/its_workpieces[0]/clamping_positions[*]/coordinates[2]"), "0 mm\n30 mm\n");
}

TEST(Inspect, ListsAKindOfObject) {
  EXPECT_EQ(at("/ROUND_HOLE[*]/its_id"), "'HOLE'\n");
  EXPECT_EQ(at("/MANUFACTURING_FEATURE#size"), "1\n");
}

TEST(Inspect, CountsItemsOfListsAndOtherwisePlaces) {
  EXPECT_EQ(at("/project/its_workpieces[0]/clamping_positions#size"), "2\n");
  EXPECT_EQ(at("/project/its_workpieces[0]/clamping_positions[*]#size"), "2\n");
  EXPECT_EQ(at("/project/its_workpieces[0]/clamping_positions[*]/coordinates#size"), "3\n3\n");
}

TEST(Inspect, NamesTheSegmentThatIsNotThereAndWhatIs) {
  const std::string text = at("/project/its_workpieces[0]/its_matter");
  EXPECT_THAT(text, HasSubstr("#4 WORKPIECE 'PIECE' has no attribute 'its_matter'"));
  EXPECT_THAT(text, HasSubstr("its_material"));
}

TEST(Inspect, SaysWhereAPathRunsIntoNothing) {
  EXPECT_THAT(at("/project/its_workpieces[0]/its_rawpiece/its_id"),
              HasSubstr("its_rawpiece, which is absent"));
  EXPECT_THAT(at("/project/its_id/more"), HasSubstr("which has none"));
  EXPECT_THAT(at("/project/its_workpieces[7]"), HasSubstr("expected [0] to [0]"));
  EXPECT_THAT(at("/project/its_workpieces/its_id"), HasSubstr("is an attribute, and this is a list"));
  EXPECT_THAT(at("/project/its_id[0]"), HasSubstr("needs a list; this is none"));
  EXPECT_THAT(at("#9999"), HasSubstr("there is no instance #9999"));
  EXPECT_THAT(at("/projekt"), HasSubstr("there is no 'projekt' at the top"));
}

TEST(Inspect, RefusesBrokenPathsWithoutHarm) {
  for (const char* path : {"", "/", "[", "[]", "//", "/project[", "#", "#x", "/project/[0]", "#size", "/[*]",
                           "/project/its_workpieces[99999999999999999999]", "/project//its_id"}) {
    EXPECT_THAT(at(path), HasSubstr("error:")) << path;
  }
  std::string deep = "/project";
  for (int i = 0; i < 100000; ++i) deep += "/a";
  EXPECT_THAT(at(deep), HasSubstr("256 segments"));
}

TEST(Inspect, SummaryShowsWhatIsUnhandled) {
  const auto plan = testing::read_text(testing::drilled_plate());
  const std::string text = inspect(plan, std::vector<Diagnostic>{});
  EXPECT_THAT(text, HasSubstr("Unhandled"));
  EXPECT_THAT(text, HasSubstr("TROCHOIDAL_WONDER"));
  EXPECT_THAT(at("#200"), HasSubstr("TROCHOIDAL_WONDER"));
}

TEST(Examples, EveryFeatureOfTheBracketHasAShape) {
  Job job;
  const auto plan = exchange::read(testing::example("bracket.p21"), job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  EXPECT_EQ(job.diagnostics().size(), 0U)
      << (job.diagnostics().empty() ? "" : to_text(job.diagnostics().front()));
  const auto features = plan->model.all_below(model::TypeId::kManufacturingFeature);
  EXPECT_EQ(features.size(), 12U);
  for (const auto at : features) {
    const auto shapes = model::shapes_of(plan->model, model::Ref<model::ManufacturingFeature>(at));
    ASSERT_TRUE(shapes) << to_text(shapes.error());
    const bool pattern = plan->model.holds<model::RectangularPattern>(at);
    const bool compound = plan->model.holds<model::CompoundFeature>(at);
    EXPECT_EQ(shapes->size(), pattern ? 4U : compound ? 2U : 1U);
    for (const auto& s : *shapes) EXPECT_GT(s.depth_mm, 0.0) << s.name;
  }
  EXPECT_THAT(inspect(*plan, job.diagnostics()), HasSubstr("COUNTERBORE_HOLE 'CAP SCREW HOLE'"));
}

TEST(Examples, TheBracketIsOpen) {
  Job job;
  const auto plan = exchange::read(testing::example("bracket.p21"), job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  EXPECT_EQ(plan->model.count(model::TypeId::kMachiningWorkingstep), 0U);
  for (const auto at : plan->model.all_below(model::TypeId::kManufacturingFeature))
    EXPECT_TRUE(plan->model.at<model::ManufacturingFeature>(at).its_operations.empty());
}

TEST(Examples, ThePlateIsBoundAsItsTextSays) {
  Job job;
  const auto plan = exchange::read(testing::example("plate_bound.p21"), job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  EXPECT_EQ(job.count(Severity::kWarning), 0U);
  EXPECT_EQ(plan->model.count(model::TypeId::kMachiningWorkingstep), 3U);
  const auto value = [&](const char* path) { return *inspect(*plan, path); };
  EXPECT_EQ(value("/BOTTOM_AND_SIDE_ROUGH_MILLING[0]/its_technology/feedrate"), "240 mm/min\n");
  EXPECT_EQ(value("/BOTTOM_AND_SIDE_ROUGH_MILLING[0]/its_technology/spindle"), "-1260 1/min\n");
  EXPECT_EQ(value("/DRILLING[0]/its_technology/feedrate"), "absent\n");
  EXPECT_THAT(inspect(*plan, job.diagnostics()), HasSubstr("Open decisions (2)"));
}

TEST(Examples, TheSurfaceIsAClosedMesh) {
  Job job;
  const auto plan = exchange::read(testing::example("surface.stl"), job);
  ASSERT_TRUE(plan) << to_text(plan.error());
  ASSERT_NE(plan->target_mesh, nullptr);
  std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
  for (const auto& t : plan->target_mesh->triangles) {
    for (int i = 0; i < 3; ++i)
      ++edges[{t[static_cast<std::size_t>(i)], t[static_cast<std::size_t>((i + 1) % 3)]}];
  }
  for (const auto& [edge, n] : edges) {
    EXPECT_EQ(n, 1);
    EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);  // its neighbour runs it the other way
  }
  EXPECT_THAT(inspect(*plan, job.diagnostics()), HasSubstr("triangles"));
}

}  // namespace
}  // namespace capstan::app
