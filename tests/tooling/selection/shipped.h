#pragma once

#include <string>
#include <vector>

#include "tooling/library/cutters/generic.h"
#include "tooling/shop/machine/machine.h"
#include "tooling/shop/material/material.h"

/// What is shipped, by name.
namespace capstan::tooling {

inline const std::vector<model::Cutter>& library() {
  static const std::vector<model::Cutter> kLibrary = generic_library().value();
  return kLibrary;
}
inline model::WorkMaterial material(const std::string& id) {
  Job job;
  return find_material(id, shipped_materials().value(), job).value();
}
inline model::Machine machine(const std::string& id = "generic_vmc") {
  Job job;
  return load_machine(id, job).value();
}

}  // namespace capstan::tooling
