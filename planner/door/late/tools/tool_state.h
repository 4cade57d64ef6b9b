#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/making/given/magazine.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// What a control tells of one tool beside its line in the tool table.
struct ToolState {
  int number = 0;  ///< its T
  bool broken = false;
  bool in_table = false;  ///< diameter and length of the table are less by the wear already
  /// Both are the whole since the edge was new.
  std::optional<double> wear_mm = std::nullopt;  ///< of the cutting edge, radial: twice that off the diameter
  std::optional<double> length_wear_mm = std::nullopt;  ///< off the length
  std::optional<double> life_left_min = std::nullopt;   ///< of its edge, minutes of cutting
  friend bool operator==(const ToolState&, const ToolState&) = default;
};

/// Reads the states of tools, a tool a line, by number:
///
///     T3 broken
///     T5 wear 0.02 length-wear 0.01 life-left 12.5    ; mm, mm, minutes
///     T6 wear 0.02 in-table                           ; D and Z of the table are less by it already
///
/// What stands behind ; or # is a remark. A text without tools is one: nothing is told.
/// Fails  TOOL-STATE with file, line and what may stand there: no tool number, an unknown word, a number that
///        is missing, negative or not finite, a word or a tool twice.
[[nodiscard]] Result<std::vector<ToolState>> parse_tool_states(const std::string& text,
                                                               const std::string& file);

/// What the states are in a binding.
struct ToldTools {
  std::vector<given::OutOfUse> out_of_use;  ///< broken, or without life: they are in the library no more
  std::map<int, double> life_left_min;      ///< by tool number, above 0
  std::vector<model::Provenance> rows;      ///< what was told of each tool, for the record

  /// "; out of use: T3 (is broken)"; empty where none is.
  [[nodiscard]] std::string words() const;
};

/// Takes the states into the loaded tools of a library: a tool that is broken, or has no life left, is taken
/// out; wear comes off diameter and length, in the tool table's line too, for that has to be in effect.
///
/// Once      what a table has of the wear is not taken off again: all of it where the state says so
///           (`in_table`), or the table measures the planned tool of that number, or its new edge, less by
///           just the wear; what the record of the plan that is `brought` says where the table is the one of
///           then. Which counts is noted (LATE-WEAR) and recorded, from the size of the new edge. Wear of a
///           tool that is taken out is not looked at.
/// Warns     LATE-TOOL-STATE for a number that no loaded tool has.
/// Fails     LATE-TOOL-STATE for wear that leaves no diameter or length.
[[nodiscard]] Result<ToldTools> take_tool_states(const std::vector<ToolState>& states,
                                                 const model::Plan& brought,
                                                 std::vector<model::Cutter>& library, Job& job);

/// Whether a row of provenance tells a tool's state (ToldTools::rows).
[[nodiscard]] bool is_tool_state(const model::Provenance& row);
/// The rows of an earlier binding that tell of wear which `told`, this one's rows, do not tell anew: a table
/// may have it still.
[[nodiscard]] std::vector<model::Provenance> wear_known(const model::Plan& brought,
                                                        const std::vector<model::Provenance>& told);

}  // namespace capstan::late
