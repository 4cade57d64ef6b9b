#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/corpus/example2/example2.h"
#include "tests/corpus/session.h"

// What is milled on the standard's example 2, re-opened: chains, cutters and paths as a machinist would have
// them.

namespace capstan::corpus {
namespace {

class CorpusExample2Mills : public ::testing::Test {
 protected:
  static const Session& session() {
    static const Session made = planned_bytes(
        without_holes(testing::slurp(testing::corpus_folder() + "/iso14649/fdis_ex2_mended.p21")),
        "example2_mills.p21", Reopen::kAll);
    return made;
  }
  static const model::StepResult* step(const std::string& begins, const std::string& ends) {
    for (const auto& s : session().plan.steps) {
      const std::string id = model::step_id(session().plan, s);
      if (id.starts_with(begins) && id.ends_with(ends)) return &s;
    }
    return nullptr;
  }
  static const model::Cutter& cutter(const model::StepResult& s) {
    const auto* c = model::find_cutter(session().plan, s.cutter_id);
    EXPECT_NE(c, nullptr);
    static const model::Cutter kNone;
    return c != nullptr ? *c : kNone;
  }
};

#define CAPSTAN_EXAMPLE2() CAPSTAN_CORPUS_FILE(corpus_file, "iso14649/fdis_ex2_mended.p21")

TEST_F(CorpusExample2Mills, AreAllPlannedButTheGrooveInTheBoreAndWithoutFindings) {
  CAPSTAN_EXAMPLE2();
  const auto reasons = reasons_unplanned(session().plan);
  EXPECT_LE(reasons.size(), 3U);
  EXPECT_TRUE(std::any_of(reasons.begin(), reasons.end(), [](const std::string& r) {
    return r.find("a groove in the wall of a bore, 3.5 mm wide, its floor on a radius of 44 mm") !=
           std::string::npos;
  })) << ::testing::PrintToString(reasons);
  EXPECT_THAT(findings_of_plan(session()), ::testing::IsEmpty()) << all_findings(session());
}

TEST_F(CorpusExample2Mills, TheTeeSlotTakesHalfAnHourAtMost) {
  CAPSTAN_EXAMPLE2();
  const auto* form = step("TEE_SLOT1", "t_slot_finish");
  ASSERT_NE(form, nullptr);
  // 25 mm of head in a slot 32 wide, 20 high, 50 long: two heights of seven passes, 3.5 mm aside on each
  // side.
  EXPECT_NEAR(cutter(*form).cutting_diameter_mm, 25.0, 1e-9);
  EXPECT_LT(form->cutting_s, 30.0 * 60.0);
  EXPECT_GT(form->loads.torque_nm, 0.0);
}

TEST_F(CorpusExample2Mills, StandInARawPieceThatStandsOverTheOutsideAndIsAsDeep) {
  CAPSTAN_EXAMPLE2();
  // HEAD1: 260 x 180 mm, 5 above its finished height; SIDE1: 50 deep, 5 mm (default) stand over it at y = 0.
  const auto& box = session().plan.stock.box;
  EXPECT_NEAR(box.lo.x, 0.0, 1e-9);
  EXPECT_NEAR(box.lo.y, -5.0, 1e-9);
  EXPECT_NEAR(box.lo.z, -50.0, 1e-9);
  EXPECT_NEAR(box.hi.x, 260.0, 1e-9);
  EXPECT_NEAR(box.hi.y, 180.0, 1e-9);
  EXPECT_NEAR(box.hi.z, 5.0, 1e-9);
  EXPECT_THAT(codes(session().bound, Severity::kWarning), ::testing::Contains("PIP-STOCK"));
}

TEST_F(CorpusExample2Mills, TheOpenOutsideIsCutAlongItsLineFromAirToAir) {
  CAPSTAN_EXAMPLE2();
  for (const char* which : {"rough", "finish"}) {
    const auto* s = step("SIDE1", which);
    ASSERT_TRUE(s != nullptr && s->path) << which;
    const double r = 0.5 * cutter(*s).cutting_diameter_mm;
    double low = 1e300, high = -1e300, x0 = 1e300, x1 = -1e300;
    for (std::size_t i = 1; i < s->path->size(); ++i) {
      if (s->path->role[i] != model::MoveRole::kCut) continue;
      low = std::min(low, s->path->y[i]);
      high = std::max(high, s->path->y[i]);
      x0 = std::min({x0, s->path->x[i], s->path->x[i - 1]});
      x1 = std::max({x1, s->path->x[i], s->path->x[i - 1]});
    }
    EXPECT_LE(high - low, 5.0) << "passes side by side within what stands over";
    EXPECT_GE(x1 - x0, 260.0 + 2.0 * r - 1e-9) << "from air to air";
  }
}

TEST_F(CorpusExample2Mills, TheSlotsWithSmallFloorRadiiAreFinishedByABullNoseOfThatRadius) {
  CAPSTAN_EXAMPLE2();
  for (const char* slot : {"SLOT1", "SLOT2"}) {
    const auto* s = step(slot, "area_finish");
    ASSERT_NE(s, nullptr) << slot;
    EXPECT_EQ(cutter(*s).cutter_class, model::CutterClass::kBullnoseEndmill);
    EXPECT_DOUBLE_EQ(cutter(*s).corner_radius_mm, 0.1) << "0.1 +- 0.02 in the file";
    EXPECT_LT(cutter(*s).cutting_diameter_mm, 10.0) << "narrower than the slot";
  }
}

TEST_F(CorpusExample2Mills, TheTeeSlotIsCutInPassesByALowerHeadWhoseNeckPassesItsMouth) {
  CAPSTAN_EXAMPLE2();
  const auto* neck = step("TEE_SLOT1", "t_slot_rough");
  const auto* bar = step("TEE_SLOT1", "t_slot_finish");
  ASSERT_TRUE(neck != nullptr && bar != nullptr && bar->path);
  EXPECT_LT(cutter(*neck).cutting_diameter_mm, 20.0) << "the mouth";
  const auto& c = cutter(*bar);
  EXPECT_EQ(c.cutter_class, model::CutterClass::kTSlotMill);
  EXPECT_LE(c.cutting_diameter_mm, 32.0);
  EXPECT_LT(c.cutting_width_mm, 20.0) << "the bar is 20 mm high: more than one height";
  EXPECT_LT(c.neck_diameter_mm, 20.0);
  std::vector<double> heights;
  for (std::size_t i = 1; i < bar->path->size(); ++i) {
    const double z = bar->path->z[i];
    if (bar->path->role[i] != model::MoveRole::kCut) continue;
    if (std::none_of(heights.begin(), heights.end(), [z](double h) { return std::abs(h - z) < 1e-6; }))
      heights.push_back(z);
  }
  ASSERT_GE(heights.size(), 2U);
  // From the floor up the heads cover the bar: no step higher than the head, the highest up to the neck.
  std::sort(heights.begin(), heights.end());
  for (std::size_t i = 1; i < heights.size(); ++i)
    EXPECT_LE(heights[i] - heights[i - 1], c.cutting_width_mm + 1e-6);
  EXPECT_NEAR(heights.back() - heights.front() + c.cutting_width_mm, 20.0, 1e-6);
}

TEST_F(CorpusExample2Mills, HaveNoArcThatAControlDoesNotResolveAndRunInTheInterpreter) {
  CAPSTAN_EXAMPLE2();
  for (const auto& s : session().plan.steps) {
    if (!s.path) continue;
    for (std::size_t i = 1; i < s.path->size(); ++i) {
      const auto kind = s.path->kind[i];
      if (kind != model::MoveKind::kArcCw && kind != model::MoveKind::kArcCcw) continue;
      EXPECT_GE(std::hypot(s.path->x[i] - s.path->cx[i], s.path->y[i] - s.path->cy[i]), 0.001)
          << model::step_id(session().plan, s);
    }
  }
  CAPSTAN_NEEDS_RS274();
  EXPECT_FALSE(interpreted(session()).moves.empty());
}

}  // namespace
}  // namespace capstan::corpus
