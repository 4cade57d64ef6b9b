#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"

namespace capstan::model {

/// What a person does to a plan: sets a value, holds one that was planned, bounds a number, rules something
/// out, puts one step before another.
enum class EditKind : std::uint8_t { kSet, kPin, kLimit, kForbid, kOrder };
inline constexpr EditKind kEditKinds[] = {EditKind::kSet, EditKind::kPin, EditKind::kLimit, EditKind::kForbid,
                                          EditKind::kOrder};
[[nodiscard]] std::string_view to_text(EditKind kind);  ///< "set", "pin", "limit", "forbid", "order"

/// What of a step an edit is about.
enum class EditOf : std::uint8_t {
  kTool,
  kFeed,          ///< mm/min, of the step, before the schedule along its path
  kSpeed,         ///< 1/min
  kDepth,         ///< mm, along the axis, of one level
  kToolDiameter,  ///< mm
  kToolStickOut,  ///< mm
  kToolTeeth,
  kOperation,  ///< the kind: "reaming"
  kStrategy,   ///< of a milling operation: "bidirectional"
  kCycles,     ///< of its program alone: holes as the control's cycles, or as moves (cycles.h)
};

/// One edit. Its text is
///
///     set    [PATTERN/]tool=T5, [PATTERN/]feed=2000       tool, feed, speed, depth, cycles
///     pin    [PATTERN/]tool, or with the value that is held as `set`
///     limit  [PATTERN/]feed<=2000                          feed, speed, depth, tool.diameter, ...
///     forbid [PATTERN/]tool=em1*, [PATTERN/]operation=reaming
///     order  PATTERN<PATTERN
///
/// PATTERN names features or workingsteps, with * for any text and ? for any character; without one the edit
/// is about all steps. A name that holds = or <, or begins with a quote, stands in double quotes, with a
/// backslash before a quote or backslash in it: "A=B"/feed=900. Numbers are in mm, mm/min and 1/min.
struct Edit {
  EditKind kind = EditKind::kSet;
  EditOf of = EditOf::kTool;
  std::string where = "*";  ///< features or workingsteps; of an order those that come first
  std::string before = {};  ///< of an order: those that come later
  std::string value = {};   ///< as written; of a pin empty: what was planned
  double number = 0.0;      ///< of `value`, where it is one
  bool at_least = false;    ///< of a limit
  std::string from = {};    ///< who said so, for messages: "edit 2 of shop.edits.yaml", "--set"
  friend bool operator==(const Edit&, const Edit&) = default;
};

/// Longest text of an edit, bytes.
inline constexpr std::size_t kLongestEdit = 1000;

/// Reads the text of an edit; `from` is kept.
/// Fails  EDIT-SYNTAX for no edit, NAME-UNKNOWN for an attribute that this kind does not take, with those
///        that it may mean.
[[nodiscard]] Result<Edit> parse_edit(EditKind kind, std::string_view text, std::string from);

/// What `parse_edit` reads as the same edit: "POCKET*/tool=T5". Needs names without control characters.
[[nodiscard]] std::string text_of(const Edit& e);
/// "edit 2 of shop.edits.yaml: set POCKET*/tool=T5".
[[nodiscard]] std::string words_of(const Edit& e);
/// The word and unit of what an edit is about: "feed", "mm/min".
[[nodiscard]] std::string_view word_of(EditOf of);
[[nodiscard]] std::string_view unit_of(EditOf of);

/// Whether a name is one that the pattern means: * is any text, ? any character; letter case counts.
/// Cost  the product of the lengths, at most.
[[nodiscard]] bool names(std::string_view pattern, std::string_view name);

}  // namespace capstan::model
