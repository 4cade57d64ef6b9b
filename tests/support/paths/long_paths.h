#pragma once

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>

#include "planner/model/nouns/all.h"
#include "tests/support/empty_plan.h"

namespace capstan::testing {

/// A plan whose paths have `points` points together, in steps of 100,000 or fewer: passes of a ball over a
/// wavy surface, each of 500 lines with a link to the next, feeds that change every ten moves, a section at
/// the end of each cut. Coordinates have all the digits of a computed path, sections those that planning
/// keeps.
inline model::Plan long_paths_plan(std::size_t points) {
  using namespace model;
  constexpr std::size_t kInStep = 100000, kInPass = 500;
  constexpr double kStepMm = 0.2371, kPassMm = 0.0713;
  const auto rounded = [](double v) { return std::round(v * 1e6) / 1e6; };
  Plan plan = empty_plan();
  Model& m = plan.model;
  const auto piece = m.add<Workpiece>();
  m.at<Workpiece>(piece).its_id = "part";
  const auto workplan = m.add<Workplan>();
  m.at<Workplan>(workplan).its_id = "main";
  m.at<Project>(plan.project).main_workplan = workplan;
  m.at<Project>(plan.project).its_workpieces.push_back(piece);
  const auto origin = m.add<CartesianPoint>();
  m.at<CartesianPoint>(origin).coordinates = {{0.0, 0.0, 0.0}, true};
  const auto placement = m.add<Axis2Placement3d>();
  m.at<Axis2Placement3d>(placement).location = origin;
  for (std::size_t done = 0; done < points;) {
    const std::size_t count = std::min(kInStep, points - done);
    CutterPath path;
    SectionSeries s;
    path.start({0.0, 0.0, 20.0});
    for (std::size_t i = 1; i < count; ++i) {
      const std::size_t pass = i / kInPass, k = i % kInPass;
      const double along = kStepMm * static_cast<double>(pass % 2 == 0 ? k : kInPass - k);
      const double across = kPassMm * static_cast<double>(pass);
      const double z = 3.0 * std::sin(0.11 * along) * std::cos(0.07 * across) - 4.0;
      path.line({along, across, z}, k == 0 ? MoveRole::kLink : MoveRole::kCut);
      if (k == 0) continue;
      const double deep = 0.15 + 0.05 * std::sin(0.3 * along + across);
      s.move.push_back(static_cast<std::uint32_t>(i));
      s.at_mm.push_back(rounded(move_length(path, i)));
      s.ad_max_mm.push_back(rounded(deep));
      s.rd_max_mm.push_back(rounded(2.0 * std::sqrt(10.0 * deep)));
      s.x_max_ofs_mm.push_back(rounded(0.6 + 0.1 * std::cos(along)));
      s.y_max_ofs_mm.push_back(rounded(0.5 * deep));
      s.csa_mm2.push_back(rounded(kPassMm * deep));
      s.x_cg_ofs_mm.push_back(rounded(0.65 + 0.1 * std::cos(along)));
      s.y_cg_ofs_mm.push_back(rounded(0.6 * deep));
      s.removed_mm3.push_back(rounded(kPassMm * deep * s.at_mm.back()));
    }
    const std::string id = "finish " + std::to_string(plan.steps.size() + 1);
    auto& step = add_step(plan, id, "em18", std::move(path));
    auto schedule = *step.schedule;
    for (std::size_t i = 0; i < schedule.feed_mm_min.size(); ++i)
      schedule.feed_mm_min[i] = 600.0 + 0.1 * static_cast<double>(i / 10 % 997);
    step.schedule = std::make_shared<const FeedSchedule>(std::move(schedule));
    step.sections = std::make_shared<const SectionSeries>(std::move(s));
    const auto technology = m.add<MillingTechnology>();
    m.at<MillingTechnology>(technology).feedrate = 600.0;
    m.at<MillingTechnology>(technology).spindle = -3000.0;
    const auto operation = m.add<FreeformOperation>();
    m.at<FreeformOperation>(operation).its_id = id;
    m.at<FreeformOperation>(operation).its_technology = technology;
    const auto feature = m.add<ToolpathFeature>();
    m.at<ToolpathFeature>(feature).its_id = id;
    m.at<ToolpathFeature>(feature).its_workpiece = piece;
    m.at<ToolpathFeature>(feature).feature_placement = placement;
    auto& w = m.at<MachiningWorkingstep>(step.step);
    w.its_feature = feature;
    w.its_operation = operation;
    m.at<Workplan>(workplan).its_elements.push_back(step.step);
    done += count;
  }
  return plan;
}

/// The sum of all coordinates, feeds and areas: whether a plan came back.
inline double sum_of_paths(const model::Plan& plan) {
  double out = 0.0;
  for (const auto& s : plan.steps) {
    if (!s.path || !s.schedule || !s.sections) return std::nan("");
    for (const auto* column : {&s.path->x, &s.path->y, &s.path->z, &s.schedule->feed_mm_min,
                               &s.sections->csa_mm2, &s.sections->at_mm}) {
      for (const double v : *column) out += v;
    }
  }
  return out;
}

}  // namespace capstan::testing
