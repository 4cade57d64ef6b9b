#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>
#include <vector>

#include "casebase/casebase.h"
#include "casebase/record/failing.h"
#include "planner/door/service/reading.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/plan/order/step_ids.h"
#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// The bracket as it was planned, and as parts of it were measured.

namespace capstan::app {

using casebase::Case;

class CaseModels : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    ASSERT_EQ(run("plan '" + part() + "' -o plain.json").code, 0);
    plain_ = plan("plain.json");
    Job job;
    planned_ = casebase::cases_of(plain_, job);
  }
  static std::string part() { return capstan::testing::source_dir() + "/examples/bracket.p21"; }
  model::Plan plan(const std::string& name) {
    Job job;
    auto read = service::read_plan(slurp(folder_ / name), name, job);
    EXPECT_TRUE(read) << name;
    return read ? *std::move(read) : model::Plan{};
  }
  /// The milled steps of the plan as cut on so many edges, with so much of the force expected.
  std::vector<Case> cut(int edges, double share) const {
    std::vector<Case> out;
    for (int edge = 0; edge < edges; ++edge) {
      for (Case c : planned_) {
        if (!(c.predicted.specific_force_n_mm2 > 0.0)) continue;
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        const double expected = c.predicted.peak_force_n / c.predicted.force_margin;
        c.observed.peak_force_n = casebase::Figure{.value = share * (1.0 + 0.01 * edge) * expected};
        EXPECT_GT(c.predicted.held_fz_mm, 0.0) << c.from.workingstep;
        c.observed.executed_fz_mm = casebase::Figure{.value = c.predicted.held_fz_mm};
        c.from.tool_instance = "E" + std::to_string(edge);
        c.from.part = std::to_string(edge);
        c.from.source = "log";
        out.push_back(c);
      }
    }
    return out;
  }
  /// The first step that a plan mills, on so many edges, each followed while it lived so many times as long
  /// as the law says, a hundredth from edge to edge.
  static std::vector<Case> worn(const model::Plan& plan, const model::ToolLifeLaw& law, int edges,
                                double times) {
    Job job;
    const std::vector<Case> steps = casebase::cases_of(plan, job);
    const auto milled = std::find_if(steps.begin(), steps.end(),
                                     [](const Case& c) { return c.predicted.specific_force_n_mm2 > 0.0; });
    std::vector<Case> out;
    for (int edge = 0; edge < edges && milled != steps.end(); ++edge) {
      Case c = *milled;
      c.origin = casebase::Origin::kMeasured;
      c.observed = {};
      c.observed.executed_fz_mm = casebase::Figure{.value = c.predicted.held_fz_mm};
      c.observed.executed_vc_m_min = casebase::Figure{.value = c.bound.vc_m_min};
      const double by_law_s = 60.0 * law.life_min * std::pow(c.bound.vc_m_min / law.v0_m_min, -1.0 / law.n);
      for (const double share : {0.25, 0.5, 0.75, 1.0, 1.25}) {
        c.observed.wear_series_mm.samples.push_back(
            {share * times * (1.0 + 0.01 * edge) * by_law_s, share * casebase::kWornMm});
      }
      c.from.tool_instance = c.from.part = "E" + std::to_string(edge);
      c.from.source = "microscope";
      out.push_back(c);
    }
    EXPECT_FALSE(out.empty()) << "nothing is milled";
    return out;
  }
  /// A log of the plan's program at 100 %: what each of its moves is fed with, rapids at 20 m/min. A recorder
  /// speaks every five seconds at least.
  static std::string log_of(const model::Plan& plan) {
    constexpr double kRapid = 20000.0, kSilence = 5.0;
    std::ostringstream out;
    out.precision(17);
    out << "time_s,workingstep,feed_mm_min,spindle_rpm\n";
    const std::vector<std::string> ids = model::step_ids(plan);
    double t_s = 0.0;
    for (std::size_t k = 0; k < plan.steps.size(); ++k) {
      const model::StepResult& s = plan.steps[k];
      if (!s.path || !s.schedule) continue;
      for (std::size_t i = 1; i < s.path->size(); ++i) {
        if (s.path->kind[i] == model::MoveKind::kDwell) continue;
        const bool rapid = s.path->kind[i] == model::MoveKind::kRapid;
        const double feed = rapid ? kRapid : s.schedule->feed_mm_min[i];
        double left_s = feed > 0.0 ? 60.0 * model::move_length(*s.path, i) / feed : 0.0;
        while (left_s > 0.0) {
          out << t_s << ',' << ids[k] << ',' << feed << ',' << std::abs(s.schedule->spindle_rpm[i]) << '\n';
          t_s += std::min(left_s, kSilence);
          left_s -= kSilence;
        }
      }
    }
    out << t_s << ",,0,0\n";
    return out.str();
  }
  /// The steps of the plan as cut on so many parts in so much of the time planned, a hundredth more each.
  std::vector<Case> timed(int parts, double share) const {
    std::vector<Case> out;
    for (int part = 0; part < parts; ++part) {
      for (Case c : planned_) {
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        c.observed.time_s = casebase::Figure{.value = (share + 0.01 * part) * c.predicted.time_s};
        c.from.part = std::to_string(part);
        c.from.source = "log " + std::to_string(share);
        out.push_back(c);
      }
    }
    return out;
  }
  /// The bores that the plan mills, on four parts, so far from the size asked; nobody says with which edges.
  std::vector<Case> bored(double off_mm) const {
    std::vector<Case> out;
    for (int part = 0; part < 4; ++part) {
      for (Case c : planned_) {
        if (!c.asked.operation.ends_with("MILLING") || !(c.asked.diameter_mm > 0.0)) continue;
        c.origin = casebase::Origin::kMeasured;
        c.observed = {};
        c.observed.size_deviation_mm = casebase::Figure{.value = off_mm + 0.001 * part};
        c.from.part = std::to_string(part);
        c.from.source = "gauge " + std::to_string(off_mm);
        out.push_back(c);
      }
    }
    EXPECT_FALSE(out.empty()) << "the bracket mills no bore";
    return out;
  }
  static bool is_bore(const Case& c) {
    return c.asked.operation.ends_with("MILLING") && c.asked.diameter_mm > 0.0;
  }
  /// The first bore that a plan mills, as a case.
  static Case bore_of(const model::Plan& made) {
    Job job;
    for (Case& c : casebase::cases_of(made, job))
      if (is_bore(c)) return std::move(c);
    ADD_FAILURE() << "no bore is milled";
    return {};
  }
  Ran planned_with(const std::vector<Case>& cases) {
    Job job;
    auto base = casebase::CaseBase::open_or_create((folder_ / "base.db").string(), job);
    EXPECT_TRUE(base && base->add(cases));
    tuned_case_ = base->cases().front().id;
    return run("plan '" + part() + "' --reopen all --cases base.db -o tuned.json");
  }
  /// Factor of the margin in the forces of a milled step.
  static double margin_of(const model::Plan& plan) {
    for (const model::StepResult& s : plan.steps) {
      if (model::step_id(plan, s) == "POCKET area_rough") return s.loads.force_margin;
    }
    return 0.0;
  }

  model::Plan plain_;
  std::vector<Case> planned_;
  std::string tuned_case_;  // the least id of those that were planned with
};

}  // namespace capstan::app
