#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/resources/material.h"

// A file of materials, read and checked; tooling/data/README.md says what it holds.

namespace capstan::tooling {

/// What is taken where a text has one of the words and names no material.
struct MaterialFamily {
  std::vector<std::string> words;
  std::string material, source;
};

struct MaterialTable {
  std::vector<model::WorkMaterial> materials;
  std::vector<MaterialFamily> families;
  MaterialFamily unnamed;
  std::map<std::string, std::vector<std::string>>
      harder;  ///< by id: what a harder piece of it is like, softest first
};

/// Fails  as read_materials.
[[nodiscard]] Result<MaterialTable> read_material_table(std::string_view text, const std::string& file,
                                                        Job& job);
/// The one that comes with the planner, read once.
[[nodiscard]] const Result<MaterialTable>& shipped_material_table();

/// Where each measured set's alloys are kept until a name is looked up: "set 0 for 6061".
[[nodiscard]] std::string set_key(std::size_t set);

/// Upper case, letters and digits only: "EN AW-6061" and "ENAW6061" are one name.
[[nodiscard]] std::string plain_name(std::string_view text);

}  // namespace capstan::tooling
