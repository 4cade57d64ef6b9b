#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/model/nouns/all.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/motion/time.h"
#include "tests/removal/drawing.h"
#include "tests/support/shop.h"
#include "tests/sweep/sweep.h"

// What a good programmer would do with a part, where the rules alone would do otherwise.

namespace capstan::testing::sweep {
namespace {

using removal::Drawing;
using ::testing::AnyOf;
using ::testing::HasSubstr;

pipeline::Checked planned(const Drawing& d, const std::string& material, double tool_change_s = -1.0,
                          double widest_mill_mm = 1000.0) {
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "generic_vmc";
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = material;
  if (tool_change_s >= 0.0) in->machine.tool_change_s = tool_change_s;
  std::erase_if(in->library, [&](const model::Cutter& c) {
    return model::has(c.cutter_class, model::CutterTrait::kEndMill) && c.cutting_diameter_mm > widest_mill_mm;
  });
  return *pipeline::bind_checked(*pipeline::read_plan(d.text(), "part.p21", quiet), *in, {}, quiet);
}

void expect_clean(const pipeline::Checked& made) {
  EXPECT_TRUE(made.plan.unplanned.empty()) << made.plan.unplanned.front().reason;
  for (const auto& f : made.findings) EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.message;
}

std::set<std::string> mills(const model::Plan& plan) {
  std::set<std::string> out;
  for (const auto& c : plan.cutters)
    if (model::has(c.cutter_class, model::CutterTrait::kEndMill)) out.insert(c.id);
  return out;
}

TEST(Productive, OneMillServesThreePocketsWhereAChangeCostsMoreThanTheSlowerTool) {
  Drawing d("THREE POCKETS", {{0, 0, -20}, {150, 60, 0}});
  double x = 25.0;
  for (const double corner : {3.0, 4.0, 5.0}) {
    d.closed_pocket("R" + std::to_string(static_cast<int>(corner)), d.placement({x, 30, 0}), 8,
                    d.rectangle(36, 40), corner);
    x += 50.0;
  }
  const auto free = planned(d, "EN AW-6061", 0.0), dear = planned(d, "EN AW-6061", 600.0);
  expect_clean(free);
  expect_clean(dear);
  EXPECT_GE(mills(free.plan).size(), 2U);
  EXPECT_EQ(mills(dear.plan).size(), 1U);
}

// A mill of 10 mm reaches 30 mm deep in steel only slender: its walls are finished in levels, at a feed that
// still cuts, and not by crawling along the whole depth; a last pass takes what bending left. One that
// reaches 10 mm bends little.
TEST(Productive, ADeepWallIsFinishedInLevelsWithASpringPassAndNotByCrawling) {
  constexpr double kDepth = 30.0;
  const auto pocket = [](double depth) {
    Drawing d("DEEP", {{0, 0, -45}, {90, 70, 0}});
    d.closed_pocket("POCKET", d.placement({45, 35, 0}), depth, d.rectangle(60, 40), 5);
    return planned(d, "C45");
  };
  const auto springs = [](const pipeline::Checked& made) {
    return std::count_if(made.plan.steps.begin(), made.plan.steps.end(), [&](const model::StepResult& s) {
      return model::step_id(made.plan, s).find("spring") != std::string::npos;
    });
  };
  const auto made = pocket(kDepth), shallow = pocket(10.0);
  expect_clean(made);
  expect_clean(shallow);
  EXPECT_EQ(springs(made), 1);
  EXPECT_EQ(springs(shallow), 0);
  int finished = 0;
  for (const model::StepResult& s : made.plan.steps) {
    const std::string id = model::step_id(made.plan, s);
    const bool last = id.find("spring") != std::string::npos;
    if ((id.find("finish") == std::string::npos && !last) || s.path == nullptr) continue;
    const model::Cutter& c = *model::find_cutter(made.plan, s.cutter_id);
    ++finished;
    EXPECT_LT(s.axial_depth_mm, 0.75 * kDepth) << "the whole wall at once";
    const double least = mechanics::least_chip_mm(
        c.cutting_diameter_mm, c.substrate == model::Substrate::kHss, made.plan.material.iso_group);
    EXPECT_GE(s.fz_mm, least);
    EXPECT_GE(s.loads.chip_thickness_mm, least);
    EXPECT_LE(std::abs(s.loads.wall_error_mm), 0.1) << "half of the zone of +-0.1 mm";
  }
  EXPECT_GE(finished, 2);
}

/// What the ledger says of how the steps of a plan clear, and of what was not taken.
std::string strategies_of(const model::Plan& plan) {
  std::string out;
  for (const model::StepResult& s : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    const auto* chosen = plan.ledger.find(ws->its_operation, "its_machining_strategy");
    if (chosen == nullptr) continue;
    out += plan.ledger.reason(chosen->reason).text + "\n";
    for (const auto& r : chosen->rejected) out += r.what + ": " + r.why + "\n";
  }
  return out;
}

// Trochoids: a slot wider than a mill is cleared along an arc of contact that stays small, where that is
// quicker; where rings are, its time stands beside theirs.
TEST(Productive, ASlotWiderThanItsMillIsTriedByConstantEngagementToo) {
  // Through the block by any mill, and closed, 70 mm long, by one of 10 mm at most: 16 x 20 mm.
  for (const bool open : {true, false}) {
    Drawing d("SLOT", {{0, 0, -30}, {90, 50, 0}});
    d.slot("SLOT", d.placement({open ? 0.0 : 10.0, 25, 0}), 20, d.linear_path(open ? 90 : 70, {1, 0, 0}),
           d.square_u(16), open ? "open" : "radiused", open ? "open" : "radiused");
    const auto made = planned(d, "X5CrNi18-10", -1.0, open ? 100.0 : 10.0);
    expect_clean(made);
    const std::string compared = strategies_of(made.plan);
    EXPECT_THAT(compared, HasSubstr("constant engagement ")) << open;
    EXPECT_THAT(compared, HasSubstr(" against ")) << open;
  }
}

// A shop without a drill of the size drills smaller and mills; which chain was to be, and why it is not,
// stands in the plan.
TEST(Productive, TheNextChainIsTakenWhereTheFirstHasNoTool) {
  Drawing d("HOLE", {{0, 0, -20}, {60, 60, 0}});
  d.hole("HOLE", d.placement({30, 30, 0}), 20, 16, d.through_bottom());
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "generic_vmc";
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = "C45";
  std::erase_if(in->library, [](const auto& c) {
    return model::has(c.cutter_class, model::CutterTrait::kDrills) && c.cutting_diameter_mm > 15.0;
  });
  const auto made =
      *pipeline::bind_checked(*pipeline::read_plan(d.text(), "hole.p21", quiet), *in, {}, quiet);
  expect_clean(made);
  ASSERT_FALSE(made.plan.steps.empty());
  EXPECT_TRUE(mills(made.plan).contains(made.plan.steps.back().cutter_id))
      << made.plan.steps.back().cutter_id;
  std::string lost;
  for (const model::StepResult& s : made.plan.steps) {
    const auto* chain = made.plan.ledger.find(s.step, "its_operation");
    if (chain == nullptr) continue;
    for (const auto& r : chain->rejected) lost += r.what + ": " + r.why + "\n";
  }
  EXPECT_THAT(lost, HasSubstr("no cutter fits; a 16 mm twist drill"));
}

/// Share of the time at feed in which the step's cutter meets nothing.
double air_of(const model::StepResult& s) {
  const model::FeedSchedule schedule = motion::schedule_of(s);
  const std::vector<bool> cuts = cutting_moves(s);
  double air = 0.0, all = 0.0;
  for (std::size_t i = 1; i < s.path->size(); ++i) {
    if (s.path->kind[i] == model::MoveKind::kRapid || !(schedule.feed_mm_min[i] > 0.0)) continue;
    const double minutes = model::move_length(*s.path, i) / schedule.feed_mm_min[i];
    all += minutes;
    if (!cuts[i]) air += minutes;
  }
  return all > 0.0 ? air / all : 0.0;
}

// Bosses, faces and slots: no air at feed worth naming.
TEST(Productive, FacesSlotsAndBossesAreCutWithLittleAirAtFeed) {
  Drawing d("THREE", {{0, 0, -40}, {160, 80, 2}});
  d.face("FACE", 0, 0, 160, 80, 2, 2);
  d.slot("SLOT", d.placement({0, 15, 0}), 8, d.linear_path(160, {1, 0, 0}), d.square_u(14), "open", "open");
  const auto boss = d.boss("BOSS", d.placement({80, 52, 0}), 10, d.circle(24));
  d.closed_pocket("POCKET", d.placement({80, 52, 0}), 10, d.rectangle(90, 44), 6, {boss});
  const auto made = planned(d, "C45");
  expect_clean(made);
  for (const model::StepResult& s : made.plan.steps) {
    if (s.path == nullptr || s.sections == nullptr) continue;
    const std::string id = model::step_id(made.plan, s);
    RecordProperty(id, std::to_string(air_of(s)));
    // A face is left by half the mill, to leave one pattern: of a way of length and diameter its radius is
    // air.
    const double r_mm = 0.5 * model::find_cutter(made.plan, s.cutter_id)->cutting_diameter_mm;
    EXPECT_LE(air_of(s), id.starts_with("FACE") ? r_mm / (160.0 + 2.0 * r_mm) : 0.1) << id;
  }
}

// A step no wider than its mill is finished by its wall alone, and what lies beside the piece is no cut. Over
// a wider one rings cross floor that is cut (docs/strategies.md).
TEST(Productive, StepsAreCutWithLittleAirAtFeed) {
  for (const double wide_mm : {10.0, 30.0}) {
    Drawing d("STEP", {{0, 0, -30}, {120, 80, 0}});
    d.step("STEP", d.placement({120.0 - wide_mm, 0, 0}), 8, 80, {0, 1, 0});
    const auto made = planned(d, "C45");
    expect_clean(made);
    EXPECT_GE(made.plan.steps.size(), 2U);
    for (const model::StepResult& s : made.plan.steps) {
      if (s.path == nullptr || s.sections == nullptr) continue;
      const std::string id = model::step_id(made.plan, s);
      const bool rings = wide_mm > 25.0 && id.find("finish") != std::string::npos;
      EXPECT_LE(air_of(s), rings ? 0.3 : 0.1) << id << " " << wide_mm << " mm wide";
    }
  }
}

// The softer material of the two allows more chip and more speed.
TEST(Productive, ASofterMaterialIsNotCutMoreSlowly) {
  Drawing d("POCKET", {{0, 0, -20}, {80, 60, 0}});
  d.closed_pocket("POCKET", d.placement({40, 30, 0}), 8, d.rectangle(60, 40), 6);
  double last = 0.0;
  for (const char* material : {"EN AW-6061", "C45", "tool steel"}) {
    const auto made = planned(d, material);
    expect_clean(made);
    const auto time = motion::time_of(made.plan);
    ASSERT_TRUE(time);
    EXPECT_GT(time->total_s(), last) << material;
    last = time->total_s();
  }
}

// Its point marks where the drill begins: no more of it reaches down than that asks for.
TEST(Productive, ASpotGoesNoDeeperThanItsTip) {
  Drawing d("HOLE", {{0, 0, -31}, {40, 40, 0}});
  d.hole("HOLE", d.placement({20, 20, 0}), 31, 8, d.through_bottom());
  Job quiet;
  pipeline::ShopFiles files;
  files.machine = "small_router";  // its spindle lets carbide drill nothing: HSS, which is spotted
  auto in = pipeline::load_shop(files, quiet);
  in->material_name = "EN AW-6061";
  const auto made =
      *pipeline::bind_checked(*pipeline::read_plan(d.text(), "hole.p21", quiet), *in, {}, quiet);
  expect_clean(made);
  for (const model::StepResult& s : made.plan.steps) {
    const model::Cutter& c = *model::find_cutter(made.plan, s.cutter_id);
    if (c.cutter_class != model::CutterClass::kSpotDrill || s.path == nullptr) continue;
    const double deepest = -*std::min_element(s.path->z.begin(), s.path->z.end());
    EXPECT_LE(deepest, 4.0) << "half of the hole's diameter, at a point of 90 degrees";
  }
}

}  // namespace
}  // namespace capstan::testing::sweep
