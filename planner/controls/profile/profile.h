#pragma once

#include <string>
#include <vector>

#include "planner/controls/dialect.h"
#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::controls {

/// A control as plans are held against it: what it is able to do, as data.
struct Profile {
  std::string id, name;
  Conformance can;
};

/// The ids of all that are known: of the controls that programs are written for (`dialects`), then of
/// profile/data.
[[nodiscard]] std::vector<std::string> profile_ids();

/// The profile of that id, or that of a file (YAML; docs/controls.md has its fields).
/// Fails  PROFILE-UNKNOWN with the nearest ids; as read_profile and the reading of files.
[[nodiscard]] Result<Profile> load_profile(const std::string& id_or_file, Job& job);

/// A profile as its file has it. Every figure is stated with its source; what is left out is as `Conformance`
/// has it.
/// Fails  as tooling's data files (DATA-...): a field that nobody knows, a value of another kind, one out of
/// its
///        range, a figure without a source; each with file and line.
[[nodiscard]] Result<Profile> read_profile(const std::string& text, const std::string& file, Job& job);

}  // namespace capstan::controls
