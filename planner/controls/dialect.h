#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/plan.h"

namespace capstan::controls {

namespace gcode {
struct FaceWords;
struct PocketWords;
}

/// A kind of file that a control reads.
struct FileKind {
  std::string_view name;    ///< as a format (door/service/formats.h)
  std::string_view ending;  ///< with its dot, lower case
  std::string_view media;   ///< media type (RFC 6838)
};

/// What a control is able to do with a program: its conformance profile. `suitability.h` holds plans against
/// it.
struct Conformance {
  bool arcs = true;                  ///< in the XY plane
  bool helices = true;               ///< arcs that also go up or down
  bool rigid_tapping = true;         ///< turns and feed of a tap are kept together, back as well
  bool path_tolerance = true;        ///< a program may say how far corners are rounded
  int largest_tool_number = 0;       ///< 0: not limited
  std::size_t look_ahead_moves = 0;  ///< it is ready to stop within so many moves; 0: not limited
  int axes = 3;                      ///< that move at once
  std::size_t work_offsets = 0;      ///< that a program can name; 0: not limited
  double block_time_s = 0.0;         ///< it takes for one move; 0: as the machine states
  double largest_radius_mm = 0.0;    ///< of an arc; 0: not limited
  double largest_feed_mm_min = 0.0;  ///< that a program can state; 0: not limited
  bool splines = false;              ///< a program may hold B-splines
  bool compensation = true;          ///< it offsets paths of the contact by the cutter's radius
  bool tool_changes = true;          ///< a program may change tools
  bool broadcasts = false;           ///< it sends what broadcasts of a plan (AP238 edition 4) ask for
};

/// One control that programs are written for: what it is, what its files hold and who writes them. How it
/// follows a path is in ground/vocabulary/control_rows.h, for timing and feeds need it; who reads its
/// programs back for the check in proof/verify/program/readers.cpp.
struct Dialect {
  std::string_view id;                             ///< as model::Control::dialect has it
  std::string_view name;                           ///< for people
  FileKind program, tool_table;                    ///< `tool_table` is empty for a control that reads none
  std::span<const std::string_view> work_offsets;  ///< in the order in which set-ups get them
  Conformance conformance;
  /// Of lengths in mm, as the control usually counts: what a machine gets that is given this control.
  int decimals = 4;
  /// The plan as one program. `condemned` (model::condemned): why it must not be run; the program says so and
  /// stops before each condemned step.
  Result<std::string> (*write_program)(const model::Plan& plan, Job& job,
                                       const std::vector<model::Condemnation>& condemned);
  /// The tools of that program as the control reads them; null for a control that reads no tool table.
  std::string (*write_tool_table)(const model::Plan& plan) = nullptr;
  /// Its pockets as cycles (gcode/moves/pocket_cycles.h); null for a control that has none.
  const gcode::PocketWords* pockets = nullptr;
  /// Its faces as cycles (gcode/moves/face_cycles.h); null for a control that has none.
  const gcode::FaceWords* faces = nullptr;
};

}  // namespace capstan::controls
