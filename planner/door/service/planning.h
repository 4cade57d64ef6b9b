#pragma once

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/program_check.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/shape/finished.h"

namespace capstan::service {

/// A part or plan to work on: a file, or its bytes under a name.
struct Source {
  std::string name;                                 ///< what diagnostics call it; the path of a file
  std::optional<std::string> bytes = std::nullopt;  ///< nothing: the file of that name is read
};

/// A plan, and what the check says of it.
struct Planned {
  model::Plan plan;
  std::vector<model::Finding> findings;   ///< of the plan; those of its program: `judge`
  bool open = false;                      ///< decisions are left open, so there is no path to check yet
  pipeline::CheckedProgram program = {};  ///< bind: the program as it was checked with the plan
  /// bind, of some workingsteps: these alone, of which the program is; `plan` is the whole that they are in.
  std::optional<model::Plan> part = std::nullopt;
  std::size_t cut_before = 0;  ///< steps of `plan` that are cut before these
  bool late = false;           ///< bind: the deadline was past when the plan was there
  /// bind: what changed against the plan that was brought, for the operator's screen: sentences, one a line.
  std::string changes = {};
  /// plan: the shape that the CAD file says the part is to have; the programs are held against it.
  std::shared_ptr<const verify::AskedShape> shape = nullptr;
  std::string brought_sha256 = {};  ///< of the file that was planned or bound; empty: not known
};

/// The exit code of a fault: wrong usage for an unknown name, wherever it was given; kImpossible where the
/// work was stopped.
[[nodiscard]] Code code_of(const Diagnostic& fault, Code otherwise);

/// Reads a part, opens the shop and plans. A job that is stopped, or past its deadline, gives no plan: the
/// call fails with a code that ends in -STOPPED. `check` gives the finding CHK-STOPPED, an error.
[[nodiscard]] Outcome<Planned> plan(const Request& request, Source part, Job& job);

/// The same, binding at the machine the decisions that a plan leaves open, with the tools in the magazine
/// (late/late.h). `began` is when the caller began to wait; the deadline counts from there.
[[nodiscard]] Outcome<Planned> bind(const Request& request, Source plan,
                                    std::chrono::steady_clock::time_point began, Job& job);
/// What is said of a bind that was stopped: LATE-NONE where its deadline stopped it, else that it was stopped.
[[nodiscard]] Diagnostic stopped_bind(const Request& request, std::chrono::steady_clock::time_point began,
                                      const std::string& file, const Job& job);

/// The same of a plan that was read, in a shop that is open (open_shop); what reading said of it is among the
/// job's diagnostics.
/// Both are copied, a deadline that stops the job looked at between.
[[nodiscard]] Outcome<Planned> bind_in(const pipeline::Inputs& shop, const Request& request,
                                       const model::Plan& plan, std::chrono::steady_clock::time_point began,
                                       Job& job);

/// What a format is written of: a program of the workingsteps that were bound, a plan of all.
[[nodiscard]] inline const model::Plan& plan_for(const Planned& planned, const Format& format) {
  return planned.part && format.of_program() ? *planned.part : planned.plan;
}

/// A finding, and the file it is about.
struct FileFinding {
  std::string file;
  model::Finding finding;
  bool program = false;  ///< then the finding's place is a line, else a move of its step
  bool schema = false;   ///< a deviation from the schema, which says nothing of safety
};

/// Result of checking a plan and its programs.
struct Verdict {
  std::vector<FileFinding> findings;           ///< of the plan, then of the programs
  std::size_t count = 0;                       ///< findings without notes
  std::vector<model::Condemnation> condemned;  ///< why the program must not be run
  /// True if programs are given: they are not condemned, or were requested all the same and stop before each
  /// condemned step.
  bool written = true;
};

/// Checks the programs among the outputs against the plan. A condemned program that is requested all the same
/// (Request::allow_findings) is written again with its stops, and checked in that form.
/// A program's file in `findings` is its output's path. Fails  as the writers; APP-STOPPED.
[[nodiscard]] Result<Verdict> judge(const Request& request, const Planned& planned,
                                    std::vector<Output>& outputs, Job& job);

/// Number of features of which some part is unplanned, each once.
[[nodiscard]] std::size_t unplanned_features(const model::Plan& plan);
/// How many features have a step, or have something not planned.
[[nodiscard]] std::size_t features_of(const model::Plan& plan);

[[nodiscard]] inline bool is_program(const Output& o) { return o.format->holds == Holds::kProgram; }
/// True for outputs withheld with a condemned program: the tool table belongs to it.
[[nodiscard]] inline bool of_program(const Output& o) { return o.format->of_program(); }

}  // namespace capstan::service
