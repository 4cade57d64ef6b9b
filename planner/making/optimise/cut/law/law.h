#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "planner/making/optimise/cut.h"

namespace capstan::optimise {

/// The loads of a cut along the axis, as a law of the operations that name it (vocabulary/operations.inc).
/// What is not along the axis is milled; its loads are MillingLoads.
struct AxialLaw {
  std::string_view name;  ///< "drilling"
  /// A thread's pitch is the feed of a turn: there is none to choose, and an override spoils the thread.
  bool feed_is_pitch = false;
  /// Thrust (peak_force_n), torque, power, chip and removal without a margin; nothing outside the formulas'
  /// range.
  std::optional<model::StepLoads> (*loads)(const CutQuestion& q, double n_rpm, double feed_mm_min) = nullptr;
};

/// Of the files of this folder, each NAME_law(), by their names.
[[nodiscard]] std::vector<AxialLaw> axial_laws();
/// The question's. Throws std::logic_error where no file has a law of that name.
[[nodiscard]] const AxialLaw& law_of(const CutQuestion& q);
/// Whether its feed is that of a thread's pitch.
[[nodiscard]] bool feeds_by_pitch(const CutQuestion& q);

}  // namespace capstan::optimise
