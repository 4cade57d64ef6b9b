#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "planner/making/piece/demands.h"
#include "planner/making/piece/piece.h"
#include "planner/making/piece/workpiece.h"
#include "planner/making/propose/choose.h"
#include "planner/making/propose/corners.h"
#include "planner/model/features/in_piece.h"
#include "rules/rules.h"
#include "tests/door/pipeline/block.h"
#include "tooling/shop/material/material.h"

// Features that are alike share the tools of their chain; what else is decided of one is not decided by the
// others.

namespace capstan::pipeline {
namespace {

using model::FeatureShape;

/// A block with its machine and material, as far as proposing asks for them.
model::Plan block_of(const std::string& features, const std::string& material) {
  model::Plan plan = block::read(features);
  Job job;
  const auto found = tooling::find_material(material, block::shop().materials, job);
  EXPECT_TRUE(found) << (found ? "" : to_text(found.error()));
  if (found) plan.material = *found;
  plan.machine = block::shop().machine;
  plan.stock.box = {{0.0, 0.0, -20.0}, {100.0, 100.0, 0.0}};
  return plan;
}

piece::Shapes shapes_of(const model::Plan& plan) {
  Job job;
  return piece::shapes_of_all(plan, piece::stated_shapes(plan.model), 0.0, {}, job);
}

propose::InCorners in_corners(const model::Plan& plan, const piece::Shapes& shapes, const FeatureShape& s) {
  const Inputs& in = block::shop();
  const piece::Piece piece{plan, shapes};
  const draft::Bans bans;
  optimise::Options options;
  options.solver = in.solver;
  options.backends = in.backends;
  const propose::Choice choice{piece, in.library, bans, options};
  const rules::Context context = piece::context_of(piece, {}, s.feature, {s});
  Job job;
  return propose::choose_in_corners(choice, in.rules, context, rules::propose(in.rules, s, context), s,
                                    {s.feature, s.feature, s.member}, {}, {}, job);
}

TEST(AlikeFeatures, OfAPocketChangeNothingOfItsCorners) {
  constexpr double kLongS = 1200.0;  // of one feature (propose/corners.cpp)
  const model::Plan plan = block_of(
      "#80=TOLERANCED_LENGTH_MEASURE(40.,$);\n#81=TOLERANCED_LENGTH_MEASURE(30.,$);\n"
      "#82=TOLERANCED_LENGTH_MEASURE(0.2,$);\n#83=RECTANGULAR_CLOSED_PROFILE($,#81,#80);\n"
      "#84=CLOSED_POCKET('POCKET',#4,(),#50,#56,(),$,#57,$,#82,#83);\n",
      "EN AW-6061");
  piece::Shapes shapes = shapes_of(plan);
  ASSERT_EQ(shapes.all.size(), 1U);
  const FeatureShape pocket = shapes.all.front();
  const propose::InCorners one = in_corners(plan, shapes, pocket);
  ASSERT_TRUE(one.rest);
  ASSERT_GT(one.chosen.seconds, 0.0);
  ASSERT_LT(one.chosen.seconds, kLongS);
  // So many that all of them together take ten times what is long of one.
  shapes.all.resize(static_cast<std::size_t>(std::ceil(10.0 * kLongS / one.chosen.seconds)), pocket);
  const propose::InCorners many = in_corners(plan, shapes, pocket);
  ASSERT_TRUE(many.rest);
  EXPECT_EQ(many.rest->radius_mm, one.rest->radius_mm);
  EXPECT_LT(many.chosen.seconds, kLongS) << "the time of one";
}

TEST(AlikeFeatures, AreCountedWithoutThoseThatTheFileMakes) {
  const model::Plan plan = block_of(block::kTwoHoles, "C45");
  const piece::Shapes shapes = shapes_of(plan);
  ASSERT_EQ(shapes.all.size(), 2U);
  const piece::Piece piece{plan, shapes};
  draft::StepDraft of_file, proposed;
  of_file.feature = proposed.feature = shapes.all[1].feature;
  of_file.shapes = proposed.shapes = {shapes.all[1]};
  proposed.proposed = true;
  propose::AlikeShapes alike;
  EXPECT_EQ(alike.of(piece, shapes.all[0], {}), 2);
  EXPECT_EQ(alike.of(piece, shapes.all[0], {proposed}), 2);
  FeatureShape deeper = shapes.all[0];
  deeper.depth_mm += 1.0;
  EXPECT_EQ(alike.of(piece, deeper, {}), 1);
  propose::AlikeShapes beside_file;
  EXPECT_EQ(beside_file.of(piece, shapes.all[0], {of_file, proposed}), 1);
}

TEST(WidestForTime, OfAStatedRadiusGoesByDepthHoweverWideAnOpenPocketIs) {
  constexpr double kDepthMm = 40.0, kSideMm = 120.0;
  FeatureShape open;
  open.kind = model::ShapeKind::kPocket;
  open.open = true;
  open.depth_mm = kDepthMm;
  open.area = geometry::rectangle({0.0, 0.0}, {kSideMm, kSideMm});
  EXPECT_NEAR(propose::widest_for_time_mm(open, false), 0.35 * kSideMm, 1e-9) << "none is stated";
  EXPECT_EQ(propose::widest_for_time_mm(open, true), model::unstated_corner_mm(kDepthMm)) << "0 is stated";
  open.corner_radius_mm = 1.0;
  EXPECT_EQ(propose::widest_for_time_mm(open, false), model::unstated_corner_mm(kDepthMm));
}

}  // namespace
}  // namespace capstan::pipeline
