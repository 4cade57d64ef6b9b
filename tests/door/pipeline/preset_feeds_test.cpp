#include "planner/model/plan/preset_feeds.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "planner/making/optimise/cut/limits.h"
#include "planner/proof/verify/stated_values.h"
#include "planner/proof/verify/sweep/step_checks.h"
#include "tooling/library/cutters/complete.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/shop/material/material.h"

// Planning and the check read what a tool's presets state by code of their own: they must say the same.

namespace capstan::pipeline {
namespace {

std::vector<model::WorkMaterial> materials() { return tooling::shipped_materials().value(); }

/// The generic library as it is in a material, each tool also without its feeds and presets but what a shop
/// or a maker may state instead, completed.
std::vector<model::Cutter> cutters_in(const model::WorkMaterial& m, const std::string& sibling) {
  std::vector<model::Cutter> out = tooling::generic_library().value();
  const auto generic = out;
  EXPECT_TRUE(tooling::add_start_values(m, out));
  std::set<std::string> kinds;
  for (const model::Cutter& g : generic) {
    if (!kinds.insert(std::string(model::to_text(g.cutter_class)) + std::string(model::to_text(g.substrate)))
             .second)
      continue;
    const double fz = g.fz_max_mm;
    const std::vector<std::vector<model::CuttingPreset>> stated = {
        {},
        {{m.id, 50.0, 0.9 * fz, "stated: the shop"}},
        {{m.iso_group, 50.0, 0.9 * fz, "stated: the shop"}},
        {{sibling, 50.0, 1.2 * fz, "stated: the maker"}},
        {{sibling, 50.0, 2.0 * fz, "stated: the maker"}, {m.iso_group, 60.0, 0.0, "stated: a speed alone"}},
        {{m.id, 50.0, 0.0, "stated: a speed alone"}},
        {{m.id, 50.0, 0.002, "default, unsourced"}},
        {{m.id, 50.0, 0.002, "stated: the shop"}}};
    for (const auto& presets : stated) {
      model::Cutter c = g;
      c.presets = presets;
      c.fz_min_mm = c.fz_max_mm = 0.0;
      c.sources.clear();
      tooling::complete(c, generic);
      out.push_back(c);
    }
  }
  return out;
}

TEST(BorneFeed, IsTheSameToPlanningAndToTheCheck) {
  const auto all = materials();
  std::map<std::string, std::string> last_of_group;
  for (const auto& m : all) last_of_group[m.iso_group] = m.id;
  std::size_t by_presets = 0;
  for (const auto& m : all) {
    for (const model::Cutter& c : cutters_in(m, last_of_group[m.iso_group])) {
      if (c.cutter_class == model::CutterClass::kTouchProbe || !(c.fz_max_mm > 0.0)) continue;
      const double planned = model::largest_tooth_feed_mm(c, m);
      const verify::FeedLimit checked = verify::feed_limit(c, m);
      const double per = checked.per_revolution ? std::max(1, c.teeth) : 1;
      ASSERT_NEAR(checked.mm, per * planned, 1e-12) << c.id << " in " << m.id;
      by_presets += planned > c.fz_max_mm ? 1 : 0;
    }
  }
  EXPECT_GT(by_presets, 100U);  // or the presets of a shop were not met at all
}

TEST(LeastChip, IsTheSameToPlanningAndToTheCheck) {
  const auto all = materials();
  std::map<std::string, std::string> last_of_group;
  for (const auto& m : all) last_of_group[m.iso_group] = m.id;
  for (const auto& m : all) {
    for (const model::Cutter& c : cutters_in(m, last_of_group[m.iso_group])) {
      optimise::CutQuestion q;
      q.cutter = c;
      q.material = m;
      ASSERT_DOUBLE_EQ(verify::least_chip_of(c, m), optimise::least_chip_mm(q)) << c.id << " in " << m.id;
    }
  }
}

// A start value of 0.003 x 4 mm in titanium is nobody's; an edge of 0.008 mm asks for as much there.
TEST(LeastChip, IsLoweredByWhatAShopStatesAndByNoDefault) {
  const auto all = materials();
  const auto m = std::find_if(all.begin(), all.end(), [](const auto& x) { return x.id == "ti6al4v"; });
  ASSERT_NE(m, all.end());
  model::Cutter c;
  c.cutting_diameter_mm = 4.0;
  c.substrate = model::Substrate::kCarbide;
  c.presets = {{"S", 50.0, 0.012, "default, unsourced: own conservative value"}};
  EXPECT_DOUBLE_EQ(verify::least_chip_of(c, *m), 0.008);
  c.presets[0].source = "stated: the shop";
  EXPECT_DOUBLE_EQ(verify::least_chip_of(c, *m), 0.006);
}

/// By how much the source of a preset says that a coated edge is faster; 0: it says nothing.
double coated_by(const model::CuttingPreset& p) {
  const std::string& said = p.source.text();
  const auto at = said.find(tooling::kCoated);
  if (at == std::string::npos || at < 2) return 0.0;
  const auto begin = said.find_last_of(' ', at - 2) + 1;
  return std::stod(said.substr(begin, at - begin));
}

TEST(CoatedEdges, RunAsMuchFasterInTheCheckAsTheLeastOfTheirKindInTheTable) {
  std::map<double, double> least;  // by what the check takes
  const std::vector<model::Cutter> library = tooling::generic_library().value();
  for (const model::Cutter& c : library) {
    for (const model::CuttingPreset& p : c.presets) {
      const bool helps = p.material_group == "P" || p.material_group == "M" || p.material_group == "K";
      const double by = coated_by(p);
      if (!helps || !(by > 0.0)) continue;
      double& of_kind = least.emplace(verify::coated_over_bare(c), by).first->second;
      of_kind = std::min(of_kind, by);
    }
  }
  ASSERT_EQ(least.size(), 2U);  // drills and mills
  for (const auto& [taken, stated] : least) EXPECT_DOUBLE_EQ(taken, stated);
  model::Cutter reamer;
  reamer.cutter_class = model::CutterClass::kReamer;
  EXPECT_DOUBLE_EQ(verify::coated_over_bare(reamer), 1.0);  // no series of them is coated
}

}  // namespace
}  // namespace capstan::pipeline
