#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/exchange/ap238/ap238.h"
#include "planner/files/exchange/iso14649/iso14649.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::exchange {

/// What one unit of a mesh is, which STL does not state.
struct MeshUnit {
  double mm = 1.0;
  std::string name = "mm";
  std::string source = "assumed: STL states none";
};
/// The row of a plan's provenance that says it.
inline constexpr std::string_view kMeshUnit = "mesh unit";

struct ReadOptions {
  p21::Limits limits;  ///< what a file may cost
  /// One wrong reference keeps the whole file from being read. Otherwise that attribute is unset, which is an
  /// error in the job, and what needs it is not planned (planner/model/plan/decision/unreadable.h).
  bool strict = true;
  std::optional<MeshUnit> mesh_unit = {};  ///< unset: nobody stated it
};

/// Reads a part or a plan; its content, not its name, decides the format: ISO 14649 or ISO 10303-238 (Part
/// 21), or STL, which gives a plan with a target mesh and one region to machine.
///
/// Fails  FILE-READ, P21-… (not a Part 21 file), EXC-… (not a plan), EXC-UNKNOWN-FORMAT for anything else,
///        EXC-UNSUPPORTED for Part 21 files of other schemas; each fault went to `job` before.
[[nodiscard]] Result<model::Plan> read(const std::string& path, Job& job);
[[nodiscard]] Result<model::Plan> read(const std::string& path, const ReadOptions& options, Job& job);
/// As above, from bytes; `name` is what diagnostics call the file.
[[nodiscard]] Result<model::Plan> read_bytes(std::string bytes, const std::string& name,
                                             const ReadOptions& options, Job& job);

}  // namespace capstan::exchange
