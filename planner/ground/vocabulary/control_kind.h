#pragma once

#include <array>
#include <span>
#include <string_view>

#include "planner/ground/vocabulary/work_offset.h"

namespace capstan::model {

/// What a control does that planning and timing must know, by dialect. Its writer is in controls/controls.h,
/// the reader of the check in proof/verify/program/readers.h.
struct ControlKind {
  std::string_view dialect;                            ///< as model::Control has it
  std::string_view name;                               ///< for people
  std::string_view program_ending, tool_table_ending;  ///< of its files
  std::span<const std::string_view> work_offsets;      ///< in the order in which set-ups get them
  /// Shares of an axis's acceleration: the most for turning, on arcs and where moves are blended, and the
  /// least that then stays along the path.
  double turning_share, along_share;
  /// It begins to brake for a lower feed word only within the move before: each move must be able to brake
  /// within itself to the feed of the next.
  bool brakes_within_a_move;
};

/// One row per control.
inline constexpr std::array kControlKinds{
    // Source: LinuxCNC 2.9, blendmath.h, BLEND_ACC_RATIO_NORMAL and BLEND_ACC_RATIO_TANGENTIAL.
    ControlKind{"linuxcnc", "LinuxCNC", ".ngc", ".tbl", kWorkOffsets, 0.86602540378443864676, 0.5, true},
};

/// The control's row; that of LinuxCNC, after which motion is modelled, for a dialect without one (such a
/// plan has no program: controls::write_program).
[[nodiscard]] constexpr const ControlKind& control_kind(std::string_view dialect) {
  for (const ControlKind& kind : kControlKinds) {
    if (kind.dialect == dialect) return kind;
  }
  return kControlKinds.front();
}

}  // namespace capstan::model
