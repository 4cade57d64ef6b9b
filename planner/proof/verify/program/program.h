#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/cutter_path.h"
#include "planner/proof/verify/pocket/face.h"
#include "planner/proof/verify/pocket/pocket.h"

namespace capstan::verify {

// A program as the check understands it, whatever control it is for. The readers of the controls (readers.h)
// fill it.

/// A marker `(CAPSTAN STEP id="..." n=... tool=... setup=...)`.
struct StepMarker {
  std::string id;
  long n = 0;
  long line = 0;
  long setup = 0;  ///< counted from 1; 0: not said
  long tool = 0;   ///< 0: not said
  bool condemned = false;
};

/// What a program's own header says of a set-up: `(CAPSTAN SETUP n=1 offset=G54 security=20)`.
struct HeaderSetup {
  long n = 0;
  int offset = 0;  ///< by offset_code; 0: none that there is
  std::optional<double> security_mm;
  long line = 0;
};
/// And of a tool: `(CAPSTAN TOOL T1 H1 length=102 diameter=10 ...)`.
struct HeaderTool {
  int tool = 0;
  std::optional<double> length_mm, diameter_mm;
  long line = 0;
  std::string id, kind;  ///< kind: the last word, "twist_drill"
};

/// What the program tells whoever stands at the machine: a comment, or a text that the control shows.
struct Told {
  long line = 0;
  std::string text;    ///< without its delimiters, as the control's programs write it
  bool shown = false;  ///< on the screen: (MSG, ...), MSG("...")
};

/// What a block of the program did: one move, tool change, or another event, with the state it ran in.
struct Block {
  enum class Kind : unsigned char { kMove, kDwell, kToolChange, kStop, kEnd };
  Kind kind = Kind::kMove;
  long line = 0;
  int marker = -1;  ///< index into Program::markers; -1 before the first

  // Moves. Coordinates are the work offset's, mm.
  model::MoveKind move = model::MoveKind::kRapid;
  bool synchronised = false;              ///< G33.1 or a tapping cycle
  bool in_chuck = false;                  ///< tapping that a compensating chuck must even out
  bool probes = false;                    ///< ends where a probe touches (G38.2, G31), at `to` at the latest
  bool in_machine = false;                ///< G53: `to` is in machine coordinates where a word was given
  bool from_cycle = false;                ///< expanded from a canned cycle
  int pocket = -1;                        ///< of Program::pockets, whose cycle made it; -1: none
  int face = -1;                          ///< likewise of Program::faces
  bool from_turns = false;                ///< half a turn of a helix that one block makes
  bool words[3] = {false, false, false};  ///< which axes the block names
  bool known_from[3] = {false, false, false}, known_to[3] = {false, false, false};
  geometry::Vec3 from, to;
  geometry::Vec2 centre;
  double radius_start = 0.0, radius_end = 0.0;
  double pitch_mm = 0.0;
  double dwell_s = 0.0;

  // State.
  double feed_mm_min = 0.0;  ///< G94 and G95 (times speed); of G93 length over time
  double spindle_rpm = 0.0;  ///< positive M3, negative M4, 0 off
  int tool = 0;              ///< loaded
  int length_offset = -1;    ///< H; -1 none; 0 for G43.1
  int radius_offset = -1;    ///< D while G41, G42
  bool radius_left = false;  ///< G41
  int work_offset = 0;       ///< by offset_code; 0: never stated
  /// Z in machine coordinates after the block, where a G53 said it and nothing else moved Z since.
  std::optional<double> machine_z;
  bool unmoved = false;      ///< nothing moved so far
  int spindle_starts = 0;    ///< starts and reversals so far
  double started_s = 0.0;    ///< dwelt since the last of them
  bool moved_since = false;  ///< and moved
  bool cycle_active = false;
  bool mist = false, flood = false;  ///< M7, M8
  bool through = false;              ///< coolant through the spindle, by the codes of the machine's file
  unsigned stated = 0;               ///< Stated bits set since the last marker
  double tolerance_mm = 0.0;         ///< G64 P: corners may be rounded by this; 0 G61; kNoTolerance G64 alone
  double naive_mm = 0.0;             ///< G64 Q: points this near to a line are left out; as P where not said
  bool exact_stop = false;           ///< G61.1
};
inline constexpr double kNoTolerance = 1e300;

/// What a program stated since the marker of the current step.
enum Stated : unsigned {
  kStatedUnits = 1U << 0U,
  kStatedPlane = 1U << 1U,
  kStatedDistance = 1U << 2U,
  kStatedFeedMode = 1U << 3U,
  kStatedRadius = 1U << 4U,
  kStatedCycle = 1U << 5U,
  kStatedOffset = 1U << 6U,
  kStatedLength = 1U << 7U,
  kStatedSpindle = 1U << 8U,
  kStatedSpeed = 1U << 9U,
  kStatedFeed = 1U << 10U,
};

/// Something the reader itself has to say: what it cannot follow, or what is wrong in the text.
struct ReaderFault {
  int property = 0;
  std::string code;
  long line = 0;
  std::string message;
  bool undecided = false;  ///< cannot be verified, rather than wrong
};

struct Program {
  std::vector<Block> blocks;
  std::vector<StepMarker> markers;
  std::vector<ReaderFault> faults;
  std::vector<HeaderSetup> setups;
  std::vector<HeaderTool> tools;
  std::vector<Pocket> pockets;                    ///< in the order of the lines
  std::vector<FacedArea> faces;                   ///< likewise
  std::vector<Told> told;                         ///< in the order of the lines; markers left out
  std::string stock;                              ///< the header's `(stock: ...)`, as written; empty: none
  std::vector<Block> stops;                       ///< M0 and M60, with the state they stop in
  std::vector<std::pair<long, std::string>> odd;  ///< line and code: followed, but no plan asks for it
  bool ended = false;
  long lines = 0;
};

/// "G54" .. "G59.9" as a code times ten, and so "G505" .. "G599"; "G54.1P7" is 541007, "G154P7" 1540007; 0
/// for anything else.
[[nodiscard]] int offset_code(std::string_view name);
/// 551 is "G55.1".
[[nodiscard]] std::string offset_name(int code);

/// Largest program read, bytes; most faults kept; most blocks that canned cycles are expanded into.
inline constexpr std::size_t kProgramCap = std::size_t{256} << 20U;
inline constexpr std::size_t kFaultCap = 1000;
inline constexpr std::size_t kCycleBlockCap = 500000;

/// Takes in a comment (without its delimiters): the marker of a step, or what the header says of set-ups,
/// tools and the raw piece; anything else says nothing. True for a marker, which is the program's last then.
bool read_comment(const std::string& text, long line, Program& out);
/// Keeps a text for the check of what is told (told/told.cpp), up to a cap.
void keep_told(std::string_view text, long line, bool shown, Program& out);

}  // namespace capstan::verify
