#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tests/mutation/plans/plan_classes.h"

namespace capstan::mutation {

/// What became of the edits of one class of plan edits.
struct PlanRow {
  std::string name;
  Kind kind = Kind::kDangerous;
  int edits = 0;
  int refused = 0;          ///< by the reader
  int found = 0;            ///< by `check` of the plan alone; refused ones, too
  int found_by_values = 0;  ///< of all, without the hashes of the parts: by ranges, facts stated twice, and
                            ///< the check; JSON only
  int found_with_program = 0;  ///< of those not found by values: by the program that was written before
  int missed = 0, blamed = 0;
  std::vector<std::string> told = {};
};

struct PlanOptions {
  int edits = 1;  ///< of each class and file
  std::uint64_t first_seed = 1;
  bool by_values = false;  ///< also ask what is found without the hashes
  bool planned = true;     ///< the planned plate, too: its files change with the planner
};

[[nodiscard]] std::vector<PlanRow> study_plans(const PlanOptions& options);

}  // namespace capstan::mutation
