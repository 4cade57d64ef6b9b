#pragma once

#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::pipeline {

/// What a shop is named by: files, or empty for what comes with the planner.
struct ShopFiles {
  std::string machine;   ///< YAML, LinuxCNC .ini, or the id of a shipped machine; empty: the generic one
  std::string tools;     ///< a library or LinuxCNC tool table; empty: the generic library
  std::string rules;     ///< a folder of further tables; empty: the shipped ones alone
  std::string material;  ///< overrides the file's
};

/// Loads all of it. Each thing that was not named is in `Inputs::provenance` as a built-in default.
/// Fails  as the rooms that read it, naming file and place.
[[nodiscard]] Result<Inputs> load_shop(const ShopFiles& files, Job& job);

/// The material by the caller's choice: a name, `like:NAME`, or a file with a material of the shop's own,
/// which joins `in.materials` and gets start values in `in.library`; both are loaded before. Fails  as
/// tooling::load_material.
[[nodiscard]] Status name_material(Inputs& in, const std::string& given, Job& job);
/// The same for a material that is at hand, as a plan holds it.
[[nodiscard]] Status name_material(Inputs& in, model::WorkMaterial own);

/// Reads a plan or a part: ISO 14649, AP238, STL, or plan JSON, told by content.
[[nodiscard]] Result<model::Plan> read_plan(std::string bytes, const std::string& name, Job& job);

/// What the checker says of a plan, and of the LinuxCNC program it makes.
[[nodiscard]] std::vector<model::Finding> findings_of(const model::Plan& plan, Job& job);
/// The same, where the plan is checked already.
[[nodiscard]] std::vector<model::Finding> findings_of(const Checked& checked, Job& job);

/// Holds the tools of a plan against what is in the magazine (`inputs.library`, Cutter::pocket > 0).
///
/// A tool that is there (same class and diameter, or the same id) keeps its decisions and takes pocket and
/// length from the table; one that is not is re-opened, and with it, by the ledger, what depends on it.
/// Gives what was re-opened, one sentence each, in the order of the plan.
/// Fails  LATE-TOOL for a tool of the plan that is there and whose length the table does not tell
///        (model::offset_fault). A loaded tool like that which the plan does not name is not used.
[[nodiscard]] Result<std::vector<std::string>> match_loaded(model::Plan& plan, Inputs& inputs, Job& job);

/// The cutter of the magazine (Cutter::loaded, a pocket) that is this one by class and every size that both
/// know, whatever it is called; of several a measured one, then that of the same name, then of the same
/// number, then of the lowest; null when none is.
[[nodiscard]] const model::Cutter* loaded_like(const std::vector<model::Cutter>& library,
                                               const model::Cutter& wanted);

/// The tool is as long as it is in the magazine, and stands out no farther; the line of the machine's tool
/// table goes with it.
void take_length(const model::Cutter& loaded, model::Cutter& into);

enum class Format : std::uint8_t { kIso14649, kJson, kLinuxCnc, kToolTable, kAp238 };

/// The plan in a format; what the format cannot hold is noted to the job.
[[nodiscard]] Result<std::string> write_plan(const model::Plan& plan, Format format, Job& job);

}  // namespace capstan::pipeline
