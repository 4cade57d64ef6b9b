#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// Adds a row to the plan's provenance that tells of this binding, after those of earlier ones that `brought`
/// has: "late binding 2", when (as the caller says it; else "no time was given"), on which machine and with
/// which tools, both with a hash, and what was re-opened. Every form of a plan keeps it.
///
/// What was told of the tools (ToldTools::rows) stands before it, in place of what earlier bindings were
/// told; of these stays what tells of wear that is not told anew (wear_known).
///
/// Hashes  64 bits in hex: of the machine's data, and of number, place, length and diameter of each loaded
/// tool.
///         They tell one state from another, of one version of this program; they are no seal.
struct Told {
  const std::vector<std::string>& reopened;
  const std::vector<model::Provenance>& of_tools;
  const std::string& time;
};
void record(model::Plan& plan, const model::Plan& brought, const pipeline::Inputs& inputs, const Told& told);

}  // namespace capstan::late
