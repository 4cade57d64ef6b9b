#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "planner/files/exchange/brep/brep.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::exchange {

/// What reading a shape may cost. The values are defaults without a source: far above what the largest public
/// part takes, below what hurts.
struct BrepLimits {
  p21::Limits file{.bytes = std::size_t{1} << 30};
  std::size_t faces = 200'000;  ///< in the file
  double chord_mm = 0.02;       ///< distance of the tessellation from the surfaces
  std::uint64_t processor_s = 120;
  std::uint64_t wall_s = 300;
  std::uint64_t memory_bytes = std::uint64_t{6} << 30;
  std::uint64_t message_bytes = std::uint64_t{1} << 30;
  /// The program capstan-brep. Empty: what the environment's CAPSTAN_BREP names; else in the places of
  /// ground/base/loading/beside.h.
  std::string helper = {};
};

/// Reads the shapes of a STEP file (ISO 10303-203, -214, -242): mended, in mm, tessellated.
///
/// The file is judged by our own Part 21 reader first. A process of its own, `capstan-brep`, turns it into
/// shapes by OpenCASCADE; it is killed when it is over a limit or when the job is to stop. Remarks go to
/// `job` as helper/read_shape.h lists them, and BREP-ID (a warning: faces of no instance).
///
/// Fails   FILE-READ, FILE-TOO-LARGE, P21-…; of the content as helper/read_shape.h says; of the cost:
///         BREP-LIMIT (faces, output), BREP-TIME, BREP-MEMORY; of the helper: BREP-HELPER (not there, not to
///         be started), BREP-CRASH, BREP-MESSAGE, PROCESS-START; BREP-STOPPED.
[[nodiscard]] Result<Brep> read_brep(const std::string& path, const BrepLimits& limits, Job& job);
/// The same from bytes; `name` is the file's name in diagnostics.
[[nodiscard]] Result<Brep> read_brep_bytes(std::string bytes, const std::string& name,
                                           const BrepLimits& limits, Job& job);

}  // namespace capstan::exchange
