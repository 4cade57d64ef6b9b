#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/controls/controls.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// The content of a file of a format.
enum class Holds : std::uint8_t { kPlan, kProgram, kToolTable, kReport, kPicture, kEdits };

/// Result of a writer.
struct Written {
  std::string bytes;
  std::size_t losses = 0;  ///< kinds of things that the format cannot hold
};

/// How a plan is written.
struct Writing {
  std::vector<model::Condemnation> condemned = {};  ///< for programs only (controls/controls.h)
  bool sections = true;  ///< plans with the cross sections along their paths; the peak of each step stays
  std::vector<std::string> draw = {};  ///< steps that pictures show (report/picture/picture.h); empty: all
};
struct Request;
/// As the caller asks for it.
[[nodiscard]] Writing writing_of(const Request& request);

/// A file format of parts, plans, programs or reports: a row of `formats`.
struct Format {
  std::string_view name;                  ///< stable, for libraries: "iso14649", "json", "linuxcnc"
  std::string_view words;                 ///< for people: "ISO 14649", "program"
  std::vector<std::string_view> endings;  ///< of files, lower case; the usual one first
  std::string_view media;                 ///< media type (RFC 6838); empty: none
  Holds holds = Holds::kPlan;
  bool reads = false;  ///< read_plan reads it
  /// Of programs and tool tables; the first where several read files of this kind.
  const controls::Dialect* control = nullptr;
  /// Null: it is not written.
  Result<Written> (*write)(const Format& format, const model::Plan& plan, Job& job,
                           const Writing& how) = nullptr;
  bool printed = false;  ///< of reports: the page as PDF, for which a browser must be there

  /// Whether a machine with this control reads such files.
  [[nodiscard]] bool is_read_by(std::string_view dialect) const {
    const controls::Dialect* other = controls::find_dialect(dialect);
    return control != nullptr && other != nullptr && other->program.name == control->program.name;
  }
  [[nodiscard]] bool of_program() const { return holds == Holds::kProgram || holds == Holds::kToolTable; }
};

/// All formats: those of plans, then a program and, where the control reads one, a tool table for each
/// control (controls::dialects), then those that are not written yet (neither reader nor writer).
[[nodiscard]] std::span<const Format> formats();

/// The format of that name; null if there is none.
[[nodiscard]] const Format* find_format(std::string_view name);
/// The format of files with that ending (with its dot, in any case); null if there is none.
[[nodiscard]] const Format* format_of_ending(std::string_view ending);

/// Writes the plan in a format; things that the format cannot hold are noted to the job (EXC-LOSS).
/// Fails  OUT-KIND for a format without a writer, and as the writers.
[[nodiscard]] Result<Written> write(const model::Plan& plan, const Format& format, Job& job,
                                    const Writing& how = {});

/// ".p21, .stp, ... or .tbl": the endings of all formats that are written.
[[nodiscard]] std::string written_endings();
/// ".ngc": those of the formats that are written and hold this, with commas between.
[[nodiscard]] std::string endings_of(Holds holds);
/// "ISO 14649 .p21 .stp, AP238 .stpnc .238, ...": the same, with what each holds.
[[nodiscard]] std::string written_text();
/// "ISO 14649 or AP238 file (.p21 .stp .stpnc .238), plan JSON, CAD part in STEP (AP203, AP214 or AP242), or
/// STL mesh": what is read.
[[nodiscard]] std::string read_text();

}  // namespace capstan::service
