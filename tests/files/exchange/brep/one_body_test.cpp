// One body out of a file of several: what it keeps, how it is named, and what is refused.

#include "planner/files/exchange/brep/one_body.h"

#include <gtest/gtest.h>

#include <set>

#include "planner/files/exchange/brep/read_brep.h"
#include "tests/files/exchange/brep/step_part.h"
#include "tests/files/exchange/brep/support.h"

namespace capstan::exchange {
namespace {

using testing::StepPart;

class OneBody : public ::testing::Test {
 protected:
  void SetUp() override {
    if (testing::helper().empty()) GTEST_SKIP() << "built without OpenCASCADE";
    StepPart part;
    part.product({part.box({0, 0, 0}, {10, 10, 10}), part.box({100, 0, 0}, {140, 30, 20})}, part.context());
    BrepLimits limits;
    limits.helper = testing::helper();
    Job job;
    auto brep = read_brep_bytes(part.text(), "two.step", limits, job);
    ASSERT_TRUE(brep) << brep.error().message;
    two_ = *std::move(brep);
    ASSERT_EQ(two_.bodies.size(), 2U);
  }
  Brep two_;
};

TEST_F(OneBody, HasTheFacesEdgesAndTrianglesOfItsOwnNumberedAnew) {
  const auto second = one_body(two_, "2", "two.step");
  ASSERT_TRUE(second) << second.error().message;
  ASSERT_EQ(second->bodies.size(), 1U);
  EXPECT_EQ(second->bodies.front().first_face, 0U);
  // A box: 6 faces of 2 triangles, 12 edges, 8 corners.
  ASSERT_EQ(second->faces.size(), 6U);
  ASSERT_EQ(second->edges.size(), 12U);
  EXPECT_EQ(second->triangles.size(), 12U);
  EXPECT_EQ(second->points.size(), 8U);
  EXPECT_EQ(second->box.lo, (Point3{100, 0, 0}));
  EXPECT_EQ(second->box.hi, (Point3{140, 30, 20}));
  for (std::uint32_t f = 0; f < 6; ++f) {
    ASSERT_EQ(second->faces[f].loops.size(), 1U);
    std::set<std::uint32_t> around;
    for (const std::uint32_t e : second->faces[f].loops.front().edges) {
      ASSERT_LT(e, second->edges.size());
      EXPECT_TRUE(second->edges[e].face[0] == f || second->edges[e].face[1] == f);
      around.insert(e);
    }
    EXPECT_EQ(around.size(), 4U);
  }
  for (const auto& t : second->triangles) {
    for (const std::uint32_t c : t) EXPECT_LT(c, second->points.size());
  }
}

TEST_F(OneBody, KeepsWhatIsAskedOfItsFacesAndOfTheWholePart) {
  const std::int64_t of_first = two_.faces[two_.bodies[0].first_face].id;
  const std::int64_t of_second = two_.faces[two_.bodies[1].first_face].id;
  ASSERT_NE(of_first, of_second);
  for (const auto& faces : {std::vector{of_first}, std::vector{of_second}, std::vector{of_first, of_second},
                            std::vector<std::int64_t>{}}) {
    StatedZone zone;
    zone.faces = faces;
    two_.pmi.zones.push_back(zone);
  }
  const auto second = one_body(two_, "2", "two.step");
  ASSERT_TRUE(second);
  ASSERT_EQ(second->pmi.zones.size(), 3U);
  EXPECT_EQ(second->pmi.zones.front().faces, std::vector{of_second});
}

TEST_F(OneBody, IsRefusedWhereItsNumberIsTheNameOfAnother) {
  two_.bodies[0].name = "2";
  const auto both = one_body(two_, "2", "two.step");
  ASSERT_FALSE(both);
  EXPECT_EQ(both.error().code, "CAD-BODIES");
  EXPECT_NE(both.error().message.find("1 '2' (solid"), std::string::npos) << both.error().message;
  EXPECT_TRUE(one_body(two_, "1", "two.step"));
  two_.bodies[0].name = "1";
  EXPECT_TRUE(one_body(two_, "1", "two.step"));
}

TEST_F(OneBody, IsNamedByNumberOrNameAndElseRefusedWithTheList) {
  two_.bodies[0].name = "plate";
  two_.bodies[1].name = "boss";
  const auto boss = one_body(two_, "boss", "two.step");
  ASSERT_TRUE(boss);
  EXPECT_EQ(boss->bodies.front().name, "boss");
  const auto none = one_body(two_, "3", "two.step");
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "CAD-BODIES");
  EXPECT_EQ(
      none.error().message,
      "no body has the number or the name '3'; there are: 1 'plate' (solid, 6 faces); 2 'boss' (solid, 6 "
      "faces)");
  two_.bodies[0].name = "boss";
  const auto both = one_body(two_, "boss", "two.step");
  ASSERT_FALSE(both);
  EXPECT_TRUE(both.error().message.starts_with("2 bodies have the name 'boss'"));
  two_.bodies[0].solid = false;
  const auto sheet = one_body(two_, "1", "two.step");
  ASSERT_FALSE(sheet);
  EXPECT_TRUE(sheet.error().message.starts_with("body '1' is a sheet"));
}

}  // namespace
}  // namespace capstan::exchange
