#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"

namespace capstan::pipeline {

/// Findings of the check on a plan and on the program that its machine's control gets.
[[nodiscard]] std::vector<model::Finding> findings_of(const model::Plan& plan, Job& job);
/// A program with its tool table, and what the check says of them; without a text: nothing was checked.
struct CheckedProgram {
  std::string text, tool_table;
  std::vector<model::Finding> findings;
};
/// The same for a plan that is checked already. `kept`, where it is given, gets the program. `proofs`:
/// Inputs::proofs. `before`: as `checked`.
[[nodiscard]] std::vector<model::Finding> findings_of(const Checked& checked, Job& job,
                                                      CheckedProgram* kept = nullptr,
                                                      memo::Memo* proofs = nullptr,
                                                      const model::CutBefore* before = nullptr);

}  // namespace capstan::pipeline
