#pragma once

#include <array>
#include <string_view>

namespace capstan::model {

/// How a control follows a path, as far as timing and feeds must know. What else it is has a row in
/// controls/controls.cpp.
struct PathFollowing {
  std::string_view dialect;  ///< as model::Control has it
  /// Shares of an axis's acceleration: the most for turning, on arcs and where moves are blended, and the
  /// least that then stays along the path.
  double turning_share, along_share;
  /// It begins to brake for a lower feed word only within the move before: each move must be able to brake
  /// within itself to the feed of the next.
  bool brakes_within_a_move;
};

/// One row per control.
inline constexpr std::array kPathFollowing{
    // Source: LinuxCNC 2.9, blendmath.h, BLEND_ACC_RATIO_NORMAL and BLEND_ACC_RATIO_TANGENTIAL.
    PathFollowing{"linuxcnc", 0.86602540378443864676, 0.5, true},
    // Acceleration before interpolation is a parameter of each axis, whole on arcs as on lines; a lower F is
    // looked ahead for. Source: FANUC 0i operator's manual B-63844EN/02, "AI advanced preview control";
    // shares
    // of the axes' limits: default, unsourced.
    PathFollowing{"fanuc", 0.86602540378443864676, 0.5, false},
    PathFollowing{"haas", 0.86602540378443864676, 0.5, false},
    // Looks ahead for lower feeds and corners (G64, LookAhead); shares of the axes' limits: default,
    // unsourced.
    PathFollowing{"siemens", 0.86602540378443864676, 0.5, false},
};

/// The control's row; that of LinuxCNC, after which motion is modelled, for a dialect without one (such a
/// plan has no program: controls::write_program).
[[nodiscard]] constexpr const PathFollowing& path_following(std::string_view dialect) {
  for (const PathFollowing& row : kPathFollowing) {
    if (row.dialect == dialect) return row;
  }
  return kPathFollowing.front();
}

}  // namespace capstan::model
