#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/geometry/vec.h"

namespace capstan::controls::gcode {

struct FaceWords;
struct PocketWords;

/// Decimals of a number in a program at most: a double of six digits before the point has no more to say.
inline constexpr int kMostDecimals = 7;

/// How a hole is pecked. Heights of the work offset, rounded; mm, s.
struct Pecks {
  std::vector<double> bottoms_z;  ///< of all pecks but the last, which ends at the hole's bottom
  bool clears = false;            ///< up to the cycle's `r_z` after each; else up a little, to break the chip
  double back_mm = 0.0;           ///< so far above the last bottom it is fed again
  double dwell_s = 0.0;           ///< at each of these bottoms
  friend bool operator==(const Pecks&, const Pecks&) = default;
};

/// One hole as a canned cycle makes it. Units  mm, mm/min, s; heights of the work offset, rounded.
struct HoleCycle {
  geometry::Vec2 at;
  double initial_z = 0.0;  ///< where the tool is before and behind
  double r_z = 0.0;        ///< from where it is fed
  double bottom_z = 0.0;
  bool feeds_out = false;                   ///< back to `r_z` at the same feed
  bool stops = false;                       ///< the spindle stands while the tool comes out
  std::optional<Pecks> pecks = {};          ///< none: in one feed
  double feed_mm_min = 0.0, dwell_s = 0.0;  ///< the dwell is at the bottom
  double rpm = 0.0, pitch_mm = 0.0;         ///< of a tap; rpm below 0 for a left-hand one
  bool in_chuck = false;                    ///< of a tap: a compensating chuck holds it
  int decimals = 0, feed_decimals = 0;      ///< of the control
};

/// The blocks of a cycle at one or more places.
struct CycleText {
  std::string text;
  /// The control has computed the last place itself: it is that of the plan to half a unit only, so that X
  /// and Y are stated again behind it.
  bool computed_place = false;
};

/// The blocks that number themselves with N; kLines: each line from 0 by a number alone, comments too, but
/// not those that go on with a block (the line before ends with ~), and no line is blank.
enum class BlockNumbers : unsigned char { kNone, kSteps, kAll, kLines };

/// An arc, or a helix of one block. Units  mm; places of the work offset, rounded as they are written.
struct ArcBlock {
  geometry::Vec3 from{}, to{};
  double i = 0.0, j = 0.0;  ///< centre from the start
  bool clockwise = false;
  int further_turns = 0;  ///< of a helix: whole ones before the arc that ends at `to`
  int decimals = 0, centre_decimals = 0;
  std::string feed = {};  ///< as a word with a blank before it; empty: as before
};

/// What one control says in its own way; `write` (writer.h) says the rest as all RS-274 controls do. A member
/// with a default says what NIST RS274/NGC 3.5 says; a control that agrees leaves it out.
/// Units  texts are numbers of mm, mm per turn or s, already rounded and written by `number`.
struct Words {
  std::span<const std::string_view> work_offsets;  ///< in the order in which set-ups get them
  std::size_t longest_line = 0;                    ///< characters, without the line's end
  std::size_t longest_message =
      0;  ///< characters of a text shown to the operator; 0: what a line has room for
  int speed_decimals = 0, dwell_decimals = 0;
  std::string first = {}, last = {};  ///< lines that begin and end a program; `first` may be empty
  std::string_view comment_begin = "(", comment_end = ")";
  /// The modal state before the first tool: millimetres, plane XY, absolute, feed per minute, no compensation
  /// of radius or length, no cycle.
  std::string first_state = "G21 G17 G90 G94 G40 G49 G80";
  /// The modal state at the head of each step: the same, but the length offset of the tool stays.
  std::string step_state = "G21 G17 G90 G94 G40 G80";
  /// The text of a comment or marker as this control may read it; the same where it is empty.
  std::function<std::string(std::string_view)> comment = {};
  BlockNumbers block_numbers = BlockNumbers::kNone;
  /// Changes the tool, by its number or its id; `speed`: that of its first move. One or more lines.
  std::function<std::string(const std::string& tool, const std::string& id, const std::string& speed)>
      change_tool = [](const std::string& tool, const std::string& /*id*/, const std::string& /*speed*/) {
        return "T" + tool + " M6";
      };
  /// Where the length of a tool lies in the zero of Z of one work offset: calls the tool in the spindle
  /// again, to set that of another offset, in a set-up that goes on with it. One or more lines. Null: lengths
  /// are true of every offset.
  std::function<std::string(const std::string& tool, const std::string& id, const std::string& offset)>
      call_again = {};
  /// Makes the tool of the next change ready, right after a change; nothing where it is empty.
  std::function<std::string(const std::string& next, const std::string& id)> stage_tool = {};
  /// Behind the last step of each tool, when it is away and all is off; nothing where it is empty.
  std::string tool_end = {};
  /// Names the work offset of a set-up; its name alone where it is empty.
  std::function<std::string(const std::string& name)> work_offset = {};
  /// Applies the length offset of the tool in the spindle; no line where it says nothing.
  std::function<std::string(const std::string& tool)> length_offset = [](const std::string& tool) {
    return "G43 H" + tool;
  };
  /// The length offset stands in the block of the step's first move of Z, which ends where it says, for alone
  /// it would itself move Z.
  bool offset_moves_z = false;
  std::function<std::string(double value, int decimals)> number = {};
  /// The number of an axis's word; as `number` where it is empty.
  std::function<std::string(double value, int decimals)> coordinate = {};
  /// Straight moves: what stands before the axes' words, and between them and the feed.
  std::string_view rapid_begin = "G0", rapid_end = "", cut_begin = "G1", cut_end = "";
  /// An arc in one or more lines; G2 and G3 with I and J where it is empty.
  std::function<std::string(const ArcBlock& arc)> arc = {};
  /// A speed in 1/min, with `speed_decimals`; as `number` where it is empty.
  std::function<std::string(double rpm)> speed = {};
  /// Starts the spindle; `called`: the change of the tool stated this speed. `S M3`, `S M4` where it is
  /// empty.
  std::function<std::string(const std::string& speed, bool clockwise, bool called)> spindle = {};
  /// A new speed within a step of a spindle that turns on the same way; as a start where it is empty.
  std::function<std::string(const std::string& speed)> new_speed = {};
  /// Such a speed stands in the block of the next move (S without M): a block between two cuts would stop the
  /// tool on the wall.
  bool speed_in_move = false;
  /// The path mode for a tolerance in mm; exact stop where the text is empty. `finishes`: a finishing step.
  std::function<std::string(const std::string& tolerance, bool finishes)> path_mode = {};
  /// To that height in machine coordinates, by rapid.
  std::function<std::string(const std::string& z)> retract = {};
  /// A line that shows a text to the operator; the program stops with an M0 behind it.
  std::function<std::string(const std::string& text)> message = {};
  /// Takes the message away when the program goes on; nothing where it is empty.
  std::string message_end = {};
  std::function<std::string(const std::string& seconds)> dwell = {};
  /// Rigid tapping at `at`, where the tool is; it ends at `initial_z`. One or more lines. Null: the control
  /// has none.
  std::function<std::string(const HoleCycle& hole)> tap = {};
  /// The control has stopped the spindle when a tap is out.
  bool tap_stops_spindle = false;
  /// Equal holes, one or more, as a canned cycle at each of these places (as planned, not rounded), the tool
  /// over the first; cancelled behind the last. Nothing where this control has none that makes these moves:
  /// `pecks` and `stops` are no moves of most cycles.
  /// Null: explicit moves always.
  std::function<std::optional<CycleText>(const HoleCycle& hole, std::span<const geometry::Vec2> places)>
      cycle = {};
  /// Whether the machine asks for them; an edit may say otherwise of a step.
  bool by_cycles = true;
  /// Null: the control has no pockets as cycles. Those of its row (dialect.h).
  const PocketWords* pockets = nullptr;
  /// Null: nor faces. That of its row.
  const FaceWords* faces = nullptr;
  /// The last line of `cycle` where it runs what the lines before it define: for equal holes of a step these
  /// stand once. Empty: each run of equal holes has its whole text.
  std::string_view cycle_call = {};
  /// Of such a control: in the block of the way to a place, it runs the cycle there.
  std::string_view cycle_call_there = {};
  /// Around the moves of a milling step; nothing where they are empty.
  std::string smooth_on = {}, smooth_off = {};
  /// Arcs: decimals of I and J beyond those of ends; how far the radii at both ends may differ (0: by a unit
  /// of the last decimal); whether they end at quadrants; the largest radius (0: any); helices.
  int more_centre_decimals = 2;
  double closure_mm = 0.0;
  bool quadrants = false;
  double largest_radius_mm = 0.0;
  bool helices = true;
  /// Calls subprogram `number`, a line; a subprogram of these lines. Null: the control or the machine has
  /// none.
  std::function<std::string(int number)> call = {};
  std::function<std::string(int number, const std::string& lines)> subprogram = {};
  int first_subprogram = 0, last_subprogram = 0;  ///< their numbers
  std::string behind = {};                        ///< lines behind `last` and the subprograms; may be empty
  bool turns = false;      ///< a helix of more than one turn is one block, TURN= with the further ones
  /// A move that ends where the probe touches, by its code; empty: none.
  std::string_view probe = {};
  /// Exact stop, before such moves; nothing where it is empty.
  std::string_view probe_state = {};
  /// Lines behind such a move that tell the operator where it ended and where that is expected, for what
  /// `name` says.
  std::function<std::string(const std::string& name, const std::string& expected)> probed = {};
  std::string codes = {};  ///< those that the machine has, "G0 G1 M3", with blanks between; empty: all
};

}  // namespace capstan::controls::gcode
