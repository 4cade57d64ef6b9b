#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What logs call the things they record, and in which units: one table for all formats.
namespace capstan::casebase::retain {

/// What a column or item of a log is about.
enum class Item : std::uint8_t {
  // Numbers that are kept, each in one unit: mm, mm/min, 1/min, % of rated load.
  kX,
  kY,
  kZ,
  kFeed,       ///< along the path, as the machine moved
  kAskedFeed,  ///< as programmed
  kSpindle,
  kLoad,
  kLag,  ///< following error
  // What says where in the work the machine is.
  kTool,
  kLine,  ///< of the program, from 1
  kRunning,
  kWorkingstep,
  kToolInstance,  ///< serial number of the very tool
  kProgram,
  kTime,
};
inline constexpr std::size_t kNumbers = 8;  ///< of the items above that are numbers
[[nodiscard]] constexpr std::size_t index_of(Item i) { return static_cast<std::size_t>(i); }

/// How lengths and feeds are meant where a name does not say.
struct LogUnits {
  double mm = 1.0;      ///< of one unit of length
  double mm_min = 1.0;  ///< of one unit of feed
};

struct Column {
  Item item = Item::kX;
  double factor = 1.0;  ///< to the unit of the item
};

/// The item of a name, by MTConnect, LinuxCNC or ours, with or without a unit at its end: "Feed_Rate",
/// "path_feedrate", "x_in", "feed_mm_s", "motion.program-line". Upper and lower case are one. A name with a
/// unit of another kind ("x_rpm") is none.
[[nodiscard]] std::optional<Column> column_of(std::string_view name, const LogUnits& units);

/// The names that `column_of` knows, without a unit.
[[nodiscard]] std::vector<std::string> known_columns();

/// Our name of a numeric item, with its unit: "feed_mm_min".
[[nodiscard]] std::string_view name_of(Item item);

/// Why a value cannot be one of that item: beyond what any machine does; nothing when it can. Limits against
/// wrong units and damaged logs, defaults, unsourced.
[[nodiscard]] std::optional<std::string> fault_of(Item item, double value);

}  // namespace capstan::casebase::retain
