#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan {

/// What a program may take before it is ended. 0: no limit.
struct ProcessLimits {
  std::uint64_t processor_s = 0;
  std::chrono::milliseconds wall{0};
  std::uint64_t memory_bytes = 0;  ///< of address space
  std::uint64_t output_bytes = 0;  ///< of each of its outputs
};

/// How a program ended.
struct ProcessEnd {
  enum class Kind : std::uint8_t {
    kExited,     ///< by itself, with `status`
    kSignal,     ///< by the signal `status`
    kProcessor,  ///< over its limit of processor time
    kWall,       ///< over its limit of time
    kOutput,     ///< over its limit of output
    kStopped,    ///< the job was to stop
  };
  Kind kind = Kind::kExited;
  int status = 0;
  std::string out;    ///< its standard output; empty unless it exited
  std::string error;  ///< the first 4096 bytes of its standard error
};

/// Runs a program on `input` (its standard input) until it ends, is over a limit, or the job is to stop; then
/// it is no more: killed and waited for. It dies with this process, too. It has no other file open.
///
/// program    a path, not looked for.
/// Fails      PROCESS-START: no process or no memory for its input can be had.
/// Cost       of waiting: at most 5 ms after its end.
/// Threads    any; the program dies when the calling thread does.
[[nodiscard]] Result<ProcessEnd> run_process(const std::string& program,
                                             const std::vector<std::string>& arguments,
                                             std::string_view input, const ProcessLimits& limits,
                                             const Job& job);

}  // namespace capstan
