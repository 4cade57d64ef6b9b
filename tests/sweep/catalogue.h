#pragma once

#include <vector>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/model/plan/resources/material.h"
#include "tests/sweep/features.h"

namespace capstan::testing::sweep {

/// How long a catalogue says that a feature takes, s: what is removed over the catalogue's rate of removal,
/// and the ways there and back; without changes of tools. It asks neither for power, force and bending nor
/// for corners and acceleration: no plan is to reach it, but by how much one misses it says how it was held.
/// 0: the library has no such tool.
[[nodiscard]] double catalogue_s(const std::vector<CatalogueWork>& work,
                                 const std::vector<model::Cutter>& library,
                                 const model::WorkMaterial& material, const model::Machine& machine);

}  // namespace capstan::testing::sweep
