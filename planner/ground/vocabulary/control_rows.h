#pragma once

#include <array>
#include <string_view>

namespace capstan::model {

/// What rooms below the controls must know of one: how it follows a path, for timing and feeds, and which
/// options its machines have. What else it is has a row in controls/controls.cpp.
struct ControlRow {
  std::string_view dialect;  ///< as model::Control has it
  /// Shares of an axis's acceleration: the most for turning, on arcs and where moves are blended, and the
  /// least that then stays along the path.
  double turning_share, along_share;
  /// It begins to brake for a lower feed word only within the move before: each move must be able to brake
  /// within itself to the feed of the next.
  bool brakes_within_a_move;
  /// Rows of control_options.h that it has, each with the value that holds where nothing is stated:
  /// "cycles=feature retract=g53". An empty value: not stated.
  std::string_view options = {};
};

/// One row per control.
inline constexpr std::array kControlRows{
    // Source: LinuxCNC 2.9, blendmath.h, BLEND_ACC_RATIO_NORMAL and BLEND_ACC_RATIO_TANGENTIAL.
    ControlRow{"linuxcnc", 0.86602540378443864676, 0.5, true,
               "cycles=explicit start_blocks= end_blocks= shop_codes= through_coolant= probe_radius_mm= "
               "probe_stylus_mm= probe_feed_mm_min= probe_way_mm_min= probe_overtravel_mm="},
    // Acceleration before interpolation is a parameter of each axis, whole on arcs as on lines; a lower F is
    // looked ahead for. Source: FANUC 0i operator's manual B-63844EN/02, "AI advanced preview control";
    // shares
    // of the axes' limits: default, unsourced.
    ControlRow{"fanuc", 0.86602540378443864676, 0.5, false,
               "cycles=feature retract=g53 tap=m29 tap_feed=per_revolution dwell=milliseconds "
               "extended_offsets=0 ai_contour=no path_tolerance=assumed next_tool=staged arcs=half "
               "largest_radius_mm=99999.999 helices=yes block_numbers=steps program_number=1 "
               "prove_out=m1 comments=upper line_length=200 peck_clearance_mm= chip_break_mm= codes= "
               "start_blocks= end_blocks= shop_codes= through_coolant= probe_macro= "
               "probe_macro_confirmed=no probe_radius_mm= probe_stylus_mm= subprograms="},
    ControlRow{"haas", 0.86602540378443864676, 0.5, false,
               "cycles=feature retract=g53 tap=g84 tap_feed=per_minute tap_retract=0 dwell=seconds "
               "extended_offsets=99 smoothness=yes next_tool=staged arcs=half "
               "largest_radius_mm=15404.000 helices=yes block_numbers=steps program_number=1 "
               "prove_out=m1 comments=mixed line_length=200 peck_clearance_mm= codes= "
               "start_blocks= end_blocks= shop_codes= through_coolant=M88/M89 probe_macro= "
               "probe_macro_confirmed=no probe_radius_mm= probe_stylus_mm="},
    // Looks ahead for lower feeds and corners (G64, LookAhead); shares of the axes' limits: default,
    // unsourced.
    ControlRow{"siemens", 0.86602540378443864676, 0.5, false,
               "cycles=feature next_tool=called block_numbers=steps prove_out=m1 line_length=200 "
               "tool_call=number smoothing=cycle832 turns=yes oriented_stop=no start_blocks= end_blocks= "
               "shop_codes= through_coolant= probe_macro= probe_macro_confirmed=no probe_radius_mm= "
               "probe_stylus_mm="},
    // Looks ahead 1,024 blocks (iTNC 530), also for lower feeds; shares of the axes' limits: default,
    // unsourced.
    ControlRow{"heidenhain", 0.86602540378443864676, 0.5, false,
               "cycles=feature next_tool=called prove_out=m1 line_length=200 plane_reset=no "
               "pecking_cycle=explicit oriented_stop=no "
               "start_blocks= end_blocks= shop_codes= through_coolant= probe_macro= probe_macro_confirmed=no "
               "probe_radius_mm= probe_stylus_mm="},
    // Looks ahead over 16 moves, for lower feeds too (gnea/grbl, planner.c); shares of the axes' limits:
    // default, unsourced.
    ControlRow{"grbl", 0.86602540378443864676, 0.5, false,
               "tool_change=m6 tool_length=touch_off mist=no block_numbers=none line_length=120 "
               "start_blocks= end_blocks= probe_radius_mm= probe_stylus_mm= probe_feed_mm_min= "
               "probe_way_mm_min= probe_overtravel_mm="},
    // Constant velocity, with a look-ahead of blocks; shares of the axes' limits: default, unsourced.
    ControlRow{"mach3", 0.86602540378443864676, 0.5, false,
               "cycles=feature dwell=seconds path_tolerance=assumed block_numbers=none line_length=200 "
               "start_blocks= end_blocks= shop_codes= probe_radius_mm= probe_stylus_mm= probe_feed_mm_min= "
               "probe_way_mm_min= probe_overtravel_mm="},
};

/// The control's row; null for a dialect without one.
[[nodiscard]] constexpr const ControlRow* find_control_row(std::string_view dialect) {
  for (const ControlRow& row : kControlRows) {
    if (row.dialect == dialect) return &row;
  }
  return nullptr;
}

/// The control's row; that of LinuxCNC, after which motion is modelled, for a dialect without one (such a
/// plan has no program: controls::write_program).
[[nodiscard]] constexpr const ControlRow& control_row(std::string_view dialect) {
  const ControlRow* row = find_control_row(dialect);
  return row != nullptr ? *row : kControlRows.front();
}

}  // namespace capstan::model
