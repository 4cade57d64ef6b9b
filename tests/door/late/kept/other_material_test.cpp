#include "planner/door/late/kept/other_material.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

#include "planner/door/late/late.h"
#include "planner/model/nouns/all.h"
#include "tests/door/late/brought.h"

namespace capstan::late {
namespace {

const std::string kBracket = capstan::testing::source_dir() + "/examples/bracket.p21";

/// The part is of EN AW-6061; on the machine lies a steel that is quenched and tempered.
const Brought& bracket() {
  static const Brought kBrought = brought(kBracket, pipeline::Format::kJson);
  return kBrought;
}
pipeline::Inputs of(const std::string& material) {
  pipeline::Inputs in = shop_of(bracket().table);
  in.material_name = material;
  return in;
}

std::string other_now(const pipeline::Inputs& in) {
  return other_material(bracket().plan, material_now(bracket().plan, in));
}

model::AnyRef technology_of(const model::Plan& plan, const model::StepResult& s) {
  const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
  const auto* op = ws == nullptr ? nullptr : plan.model.get<model::MachiningOperation>(ws->its_operation);
  return op == nullptr ? model::AnyRef{} : model::AnyRef(op->its_technology);
}

/// Speeds and feeds of the steps that mill or drill, of all but taps, whose feed is their pitch.
void expect_slower(const model::StepResult& now, const model::StepResult& then) {
  EXPECT_LT(std::abs(now.spindle_rpm), 0.8 * std::abs(then.spindle_rpm)) << now.cutter_id;
  EXPECT_LT(now.feed_mm_min, 0.8 * then.feed_mm_min) << now.cutter_id;
}

TEST(LateOtherMaterial, AHarderOneIsCutSlowerByTheSameToolsToTheSameDepths) {
  const model::Plan& early = bracket().plan;
  Job job;
  const auto bound = bind(early, of("42CrMo4+QT"), {.deadline = std::nullopt}, job);
  ASSERT_TRUE(bound) << to_text(bound.error());
  EXPECT_FALSE(bound->kept);
  ASSERT_EQ(bound->plan.steps.size(), early.steps.size());
  for (std::size_t i = 0; i < early.steps.size(); ++i) {
    const model::StepResult &now = bound->plan.steps[i], &then = early.steps[i];
    EXPECT_EQ(now.cutter_id, then.cutter_id);
    EXPECT_NEAR(now.axial_depth_mm, then.axial_depth_mm, 1e-3) << now.cutter_id;
    expect_slower(now, then);
  }
  ASSERT_EQ(bound->reopened.size(), 1U);
  EXPECT_NE(bound->reopened.front().find("the plan was made for " + early.material.id), std::string::npos)
      << bound->reopened.front();
  for (const model::Finding& f : bound->findings)
    EXPECT_NE(f.severity, Severity::kWarning) << f.code << ": " << f.message;
}

TEST(LateOtherMaterial, TheSameByAnotherNameIsTheSame) {
  const std::string id = bracket().plan.material.id;
  EXPECT_NE(id, "EN AW-6061");
  EXPECT_EQ(other_now(of("EN AW-6061")), "");
  pipeline::Inputs unnamed = shop_of(bracket().table);
  EXPECT_EQ(other_now(unnamed), "");
  const auto card = std::find_if(unnamed.materials.begin(), unnamed.materials.end(),
                                 [&](const model::WorkMaterial& m) { return m.id == id; });
  ASSERT_NE(card, unnamed.materials.end());
  card->kc11_n_mm2 *= 1.2;
  EXPECT_NE(other_now(unnamed), "");
}

/// A shop's own card of a steel, by its id and the speed of carbide in it.
std::string own_card(const std::string& id, double vc_m_min) {
  const std::string path = capstan::testing::scratch_file(id + "_" + std::to_string(vc_m_min) + ".yaml");
  std::ofstream(path) << "capstan_materials: 1\n"
                         "source: the shop\n"
                         "kc_uncertainty: {value: 0.375, source: the shop}\n"
                         "materials:\n"
                         "  - id: "
                      << id
                      << "\n"
                         "    iso_group: P\n"
                         "    kc11_n_mm2: 1500\n"
                         "    mc: 0.22\n"
                         "    vc_hss_m_min: 20\n"
                         "    vc_carbide_m_min: "
                      << vc_m_min
                      << "\n"
                         "    tensile_strength_n_mm2: 650\n"
                         "    hardness_hb: 190\n";
  return path;
}

/// The bracket, planned for a material at the desk and bound for another at the machine.
struct TwoCards {
  model::Plan early, bound;
};
TwoCards by_two_cards(const std::string& then, const std::string& now) {
  TwoCards out;
  Job job;
  const auto in = [&](const std::string& material, const std::string& tools) {
    auto shop = pipeline::load_shop({.machine = {}, .tools = tools, .rules = {}, .material = material}, job);
    EXPECT_TRUE(shop) << to_text(shop.error());
    return shop ? *std::move(shop) : pipeline::Inputs{};
  };
  auto read = pipeline::read_plan(testing::slurp(kBracket), kBracket, job);
  auto early = pipeline::bind(*std::move(read), in(then, {}), {}, job);
  EXPECT_TRUE(early) << to_text(early.error());
  if (!early) return out;
  out.early = *std::move(early);
  const std::string table = capstan::testing::scratch_file("two_cards.tbl");
  std::ofstream(table) << controls::linuxcnc::write_tool_table(out.early);
  LatePolicy policy = {.deadline = std::nullopt};
  policy.budget = policy.fallback_budget;  // no improvement
  auto bound = bind(out.early, in(now, table), policy, job);
  EXPECT_TRUE(bound) << to_text(bound.error());
  if (bound) out.bound = std::move(bound->plan);
  return out;
}

void expect_as_much_slower(const TwoCards& two, double by) {
  ASSERT_EQ(two.bound.steps.size(), two.early.steps.size());
  int of_carbide = 0;
  for (std::size_t i = 0; i < two.early.steps.size(); ++i) {
    const model::StepResult &now = two.bound.steps[i], &then = two.early.steps[i];
    const model::Cutter* c = model::find_cutter(two.early, then.cutter_id);
    ASSERT_NE(c, nullptr);
    if (c->substrate != model::Substrate::kCarbide) continue;
    ++of_carbide;
    EXPECT_NEAR(now.vc_m_min, by * then.vc_m_min, 0.05 * by * then.vc_m_min) << now.cutter_id;
  }
  EXPECT_GT(of_carbide, 5);
}

TEST(LateOtherMaterial, ACardThatWasChangedUnderItsOwnIdReachesTheSpeeds) {
  expect_as_much_slower(by_two_cards(own_card("shop_c45", 78), own_card("shop_c45", 40)), 40.0 / 78.0);
}

TEST(LateOtherMaterial, AShopsOwnCardOfTheGroupReachesTheSpeeds) {
  expect_as_much_slower(by_two_cards("c45", own_card("shop_p40", 40)), 40.0 / 78.0);
}

TEST(LateOtherMaterial, WhatTheOperatorPinnedStays) {
  model::Plan plan = bracket().plan;
  const model::AnyRef technology = technology_of(plan, plan.steps.front());
  ASSERT_TRUE(technology.set());
  const model::DecisionKey spindle{technology, "spindle"};
  const auto all = planned_speeds(plan, {});
  ASSERT_NE(std::find(all.begin(), all.end(), spindle), all.end());
  model::Decision pinned = *plan.ledger.find(technology, "spindle");
  pinned.pinned = true;
  plan.ledger.set(spindle, pinned);
  const auto free = planned_speeds(plan, {});
  EXPECT_EQ(std::find(free.begin(), free.end(), spindle), free.end());
  EXPECT_EQ(free.size(), all.size() - 1);
}

TEST(LateOtherMaterial, StepByStepTheLaterOnesAreStillOpenForIt) {
  const model::Plan& early = bracket().plan;
  LatePolicy policy = {.deadline = std::nullopt};
  policy.next = Next{1, 1};
  policy.budget = policy.fallback_budget;  // no improvement
  Job job;
  const auto first = bind(early, of("42CrMo4+QT"), policy, job);
  ASSERT_TRUE(first) << to_text(first.error());
  expect_slower(first->plan.steps[0], early.steps[0]);
  EXPECT_TRUE(first->plan.ledger.is_open(technology_of(early, early.steps[1]), "spindle"));
  // What was known of the others was of the other material; their tools are known as before.
  EXPECT_EQ(first->plan.steps.size(), 1U);
  for (const model::Cutter& c : early.cutters)
    EXPECT_NE(model::find_cutter(first->plan, c.id), nullptr) << c.id;
  policy.next = Next{1, 2};
  const auto second = bind(first->plan, of("42CrMo4+QT"), policy, job);
  ASSERT_TRUE(second) << to_text(second.error());
  expect_slower(second->plan.steps[1], early.steps[1]);
  // What was cut stays as it was cut.
  EXPECT_EQ(second->plan.steps[0].spindle_rpm, first->plan.steps[0].spindle_rpm);
}

TEST(LateOtherMaterial, WhereFeedsMayNotBeDecidedItIsRefused) {
  LatePolicy policy = {.deadline = std::nullopt};
  policy.may = *Decisions::parse("tools,strategy,depths");
  Job job;
  const auto bound = bind(bracket().plan, of("42CrMo4+QT"), policy, job);
  ASSERT_FALSE(bound);
  EXPECT_EQ(bound.error().code, "LATE-POLICY") << to_text(bound.error());
}

}  // namespace
}  // namespace capstan::late
