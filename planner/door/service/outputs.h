#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/service/formats.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// A file to write: its name, and the format that its ending names ("-": JSON, to standard output).
struct Output {
  std::string path;
  const Format* format = nullptr;  ///< of `formats`, with a writer
  std::string bytes;               ///< once made
  std::size_t losses = 0;          ///< kinds of things that the format cannot hold, once made
};

/// The ending alone decides, so that a wrong name fails before any work.
/// Fails  OUT-KIND: no ending, or one that is not supported (yet); OUT-BROWSER: what would print it is not
/// there.
[[nodiscard]] Result<Output> output_of(const std::string& path);
/// All of them.
[[nodiscard]] Result<std::vector<Output>> outputs_of(const std::vector<std::string>& paths);

/// What a call ends with that was stopped in another part of it than planning (APP-STOPPED).
[[nodiscard]] Diagnostic stopped_call(const std::string& file);

/// Whether `make` writes the reports, which then say that nobody checked, or `judge`, which follows it, does.
enum class Reports : std::uint8_t { kUnjudged, kLeftToJudge };

/// Fills `bytes` and `losses`, on the job's threads. Things that ISO 14649 or AP238 cannot hold are noted
/// (EXC-LOSS). `of_program`: the plan that programs and tool tables are written of, where that is another;
/// `how`: what plans are written without.
/// Fails  as the writers; APP-STOPPED.
[[nodiscard]] Status make(const model::Plan& plan, std::vector<Output>& outputs, Job& job,
                          const model::Plan* of_program = nullptr, Reports reports = Reports::kUnjudged,
                          const Writing& how = {});

/// " (without 3 things)", or nothing when the file holds all of the plan.
[[nodiscard]] std::string losses_text(const Output& output);

/// The fate of an older file whose name is not written now.
struct Aside {
  enum Outcome : std::uint8_t { kNothingThere, kRenamed, kStays };
  Outcome outcome = kNothingThere;
  std::string renamed_to;
};
/// Renames it to its name and ".before"; a file of that name goes. It stays where it cannot be renamed.
[[nodiscard]] Aside set_aside(const std::string& path);
/// Leaves it.
[[nodiscard]] Aside left_there(const std::string& path);

/// Checks the outputs' paths before any work: none is named twice, none is an input of the same call, unless
/// forced, and each can be written.
/// Fails  OUT-TWICE, OUT-INPUT, FILE-WRITE.
[[nodiscard]] Status can_be_written(const std::vector<std::string>& outputs,
                                    const std::vector<std::string>& inputs, bool force);

/// Writes all files or none: all are brought to disk first (StagedFile), then all are renamed into place.
/// Only if a rename fails after another succeeded (another program removed the folder) some are written; the
/// fault says so.
/// "-" goes to standard output last. A stop before the first rename leaves nothing.
/// Fails  FILE-WRITE; APP-STOPPED.
[[nodiscard]] Status write_all(const std::vector<Output>& outputs, const Job& job);

}  // namespace capstan::service
