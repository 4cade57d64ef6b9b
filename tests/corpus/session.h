#pragma once

#include <gtest/gtest.h>

#include <map>
#include <set>
#include <string>
#include <vector>

#include "tests/support/shop.h"
#include "planner/model/plan/assumed_tool_material.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/verify.h"
#include "tests/support/canon.h"
#include "tests/support/corpus.h"
#include "tests/support/rs274.h"

namespace capstan::corpus {

using pipeline::Format;
using pipeline::Reopen;

/// A plan made of a file with what comes with the planner: generic machine, tools, shipped rules.
struct Session {
  model::Plan plan;
  std::vector<Diagnostic> read, bound;
  std::string program, table;  ///< empty when the plan has no step to write
};

/// Reads and plans bytes; fails the running test when either fails.
inline Session planned_bytes(std::string bytes, const std::string& name, Reopen reopen,
                             unsigned threads = 1) {
  Session out;
  Job job;
  job.threads = threads;
  auto shop = pipeline::load_shop({}, job);
  EXPECT_TRUE(shop) << to_text(shop.error());
  (void)job.take_diagnostics();
  auto plan = pipeline::read_plan(std::move(bytes), name, job);
  out.read = job.take_diagnostics();
  EXPECT_TRUE(plan) << to_text(plan.error());
  if (!shop || !plan) return out;
  pipeline::Policy policy;
  policy.reopen = reopen;
  shop->tool_materials.of_plan = model::assumed_tool_materials(*plan);  // as door/service does
  auto bound = pipeline::bind(*std::move(plan), *shop, policy, job);
  out.bound = job.take_diagnostics();
  EXPECT_TRUE(bound) << to_text(bound.error());
  if (!bound) return out;
  out.plan = *std::move(bound);
  if (out.plan.steps.empty()) return out;
  auto program = pipeline::write_plan(out.plan, Format::kLinuxCnc, job);
  EXPECT_TRUE(program) << to_text(program.error());
  auto table = pipeline::write_plan(out.plan, Format::kToolTable, job);
  EXPECT_TRUE(table) << to_text(table.error());
  if (program) out.program = *std::move(program);
  if (table) out.table = *std::move(table);
  return out;
}

inline Session planned(const std::string& path, Reopen reopen, unsigned threads = 1) {
  const auto slash = path.rfind('/');
  return planned_bytes(testing::slurp(path), path.substr(slash + 1), reopen, threads);
}

/// "17 CHK-POWER WS DRILL HOLE1", once each, in the checker's order. Notes say nothing against a plan.
inline std::vector<std::string> summary(const std::vector<model::Finding>& findings) {
  std::vector<std::string> out;
  std::set<std::string> seen;
  for (const auto& f : findings) {
    if (f.severity == Severity::kNote) continue;
    const std::string line = std::to_string(f.property) + " " + f.code + " " + f.step;
    if (seen.insert(line).second) out.push_back(line);
  }
  return out;
}

inline std::vector<std::string> findings_of_plan(const Session& s) {
  Job job;
  return summary(verify::check_plan(s.plan, job));
}

inline std::vector<std::string> findings_of_program(const Session& s) {
  Job job;
  const verify::ProgramText text{"program.ngc", s.program, s.table};
  return summary(verify::check_program(text, &s.plan, s.plan.machine, s.plan.cutters, job));
}

/// The same as sentences, for a failing test to show.
inline std::string all_findings(const Session& s) {
  Job job;
  std::string out;
  for (const auto& f : pipeline::findings_of(s.plan, job))
    out += std::to_string(f.property) + " " + f.code + " " + f.step + ": " + f.message + "\n";
  return out;
}

inline std::vector<std::string> step_ids(const model::Plan& plan) {
  std::vector<std::string> out;
  for (const auto& s : plan.steps) out.push_back(model::step_id(plan, s));
  return out;
}

inline std::vector<std::string> reasons_unplanned(const model::Plan& plan) {
  std::vector<std::string> out;
  for (const auto& u : plan.unplanned) out.push_back(u.reason);
  return out;
}

/// "CODE" of each diagnostic of at least a severity.
inline std::vector<std::string> codes(const std::vector<Diagnostic>& from, Severity least) {
  std::vector<std::string> out;
  for (const auto& d : from) {
    if (d.severity >= least) out.push_back(d.code);
  }
  return out;
}

/// What LinuxCNC's interpreter makes of the program; fails the running test when it refuses it.
inline testing::CanonProgram interpreted(const Session& s) {
  const auto run = testing::run_rs274(s.table, s.program);
  EXPECT_EQ(run.status, 0) << run.output.substr(run.output.size() > 600 ? run.output.size() - 600 : 0);
  auto out = testing::read_canon(run.output);
  EXPECT_TRUE(out.ended);
  // The interpreter names tools by pocket; the plan knows which cutter is there.
  std::map<std::string, std::string> names;
  for (const auto& c : s.plan.cutters) names[std::to_string(c.pocket)] = c.id;
  for (auto& t : out.tools) t = names[t];
  for (auto& m : out.moves) m.tool = names[m.tool];
  return out;
}

}  // namespace capstan::corpus
