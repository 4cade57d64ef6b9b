#include "casebase/retain/items.h"

#include <fmt/format.h>

#include <array>

#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

enum class Dimension : std::uint8_t { kNone, kLength, kFeed, kSpeed, kShare, kTime };

struct Name {
  std::string_view name;  // lower case, without a unit
  Item item;
  Dimension dimension;
};

// Names of items: MTConnect Part 3 (types and the usual short names of its adapters), the test bed of NIST
// (Hurco), LinuxCNC's HAL pins, ours.
constexpr std::array kNames = {
    Name{"x", Item::kX, Dimension::kLength},
    Name{"y", Item::kY, Dimension::kLength},
    Name{"z", Item::kZ, Dimension::kLength},
    Name{"xact", Item::kX, Dimension::kLength},
    Name{"yact", Item::kY, Dimension::kLength},
    Name{"zact", Item::kZ, Dimension::kLength},
    Name{"xabs", Item::kX, Dimension::kLength},
    Name{"yabs", Item::kY, Dimension::kLength},
    Name{"zabs", Item::kZ, Dimension::kLength},
    Name{"joint.0.motor-pos-cmd", Item::kX, Dimension::kLength},
    Name{"joint.1.motor-pos-cmd", Item::kY, Dimension::kLength},
    Name{"joint.2.motor-pos-cmd", Item::kZ, Dimension::kLength},
    Name{"feed", Item::kFeed, Dimension::kFeed},
    Name{"feed_actual", Item::kFeed, Dimension::kFeed},
    Name{"feed_rate", Item::kFeed, Dimension::kFeed},
    Name{"path_feedrate", Item::kFeed, Dimension::kFeed},
    Name{"fact", Item::kFeed, Dimension::kFeed},
    Name{"frt", Item::kFeed, Dimension::kFeed},
    Name{"velocity", Item::kFeed, Dimension::kFeed},
    Name{"motion.current-vel", Item::kFeed, Dimension::kFeed},
    Name{"asked_feed", Item::kAskedFeed, Dimension::kFeed},
    Name{"feed_programmed", Item::kAskedFeed, Dimension::kFeed},
    Name{"path_feedrate_programmed", Item::kAskedFeed, Dimension::kFeed},
    Name{"spindle", Item::kSpindle, Dimension::kSpeed},
    Name{"spindle_speed", Item::kSpindle, Dimension::kSpeed},
    Name{"rotary_velocity", Item::kSpindle, Dimension::kSpeed},
    Name{"s1speed", Item::kSpindle, Dimension::kSpeed},
    Name{"sspeed", Item::kSpindle, Dimension::kSpeed},
    Name{"spindle.0.speed-in", Item::kSpindle, Dimension::kSpeed},
    Name{"load", Item::kLoad, Dimension::kShare},
    Name{"spindle_load", Item::kLoad, Dimension::kShare},
    Name{"s1load", Item::kLoad, Dimension::kShare},
    Name{"sload", Item::kLoad, Dimension::kShare},
    Name{"lag", Item::kLag, Dimension::kLength},
    Name{"following_error", Item::kLag, Dimension::kLength},
    Name{"tool", Item::kTool, Dimension::kNone},
    Name{"tool_number", Item::kTool, Dimension::kNone},
    Name{"tool_id", Item::kTool, Dimension::kNone},
    Name{"current_tool", Item::kTool, Dimension::kNone},
    Name{"tool_instance", Item::kToolInstance, Dimension::kNone},
    Name{"tool_serial", Item::kToolInstance, Dimension::kNone},
    Name{"tool_asset_id", Item::kToolInstance, Dimension::kNone},
    Name{"toolassetid", Item::kToolInstance, Dimension::kNone},
    Name{"line", Item::kLine, Dimension::kNone},
    Name{"line_number", Item::kLine, Dimension::kNone},
    Name{"program_line", Item::kLine, Dimension::kNone},
    Name{"block_number", Item::kLine, Dimension::kNone},
    Name{"motion.program-line", Item::kLine, Dimension::kNone},
    Name{"running", Item::kRunning, Dimension::kNone},
    Name{"execution", Item::kRunning, Dimension::kNone},
    Name{"program_status", Item::kRunning, Dimension::kNone},
    Name{"workingstep", Item::kWorkingstep, Dimension::kNone},
    Name{"program", Item::kProgram, Dimension::kNone},
    Name{"program_name_running", Item::kProgram, Dimension::kNone},
    Name{"time", Item::kTime, Dimension::kTime},
    Name{"timestamp", Item::kTime, Dimension::kTime},
};

struct Unit {
  std::string_view suffix;
  Dimension dimension;
  double factor;
};
// The longer ones first: "_mm_min" ends in no other, "_mm_s" would be taken for "_s".
constexpr std::array kUnits = {
    Unit{"_mm_min", Dimension::kFeed, 1.0},   Unit{"_mm_s", Dimension::kFeed, 60.0},
    Unit{"_in_min", Dimension::kFeed, 25.4},  Unit{"_in_s", Dimension::kFeed, 1524.0},
    Unit{"_ipm", Dimension::kFeed, 25.4},     Unit{"_m_min", Dimension::kFeed, 1000.0},
    Unit{"_mm", Dimension::kLength, 1.0},     Unit{"_in", Dimension::kLength, 25.4},
    Unit{"_um", Dimension::kLength, 1e-3},    Unit{"_rpm", Dimension::kSpeed, 1.0},
    Unit{"_percent", Dimension::kShare, 1.0}, Unit{"_ms", Dimension::kTime, 1e-3},
    Unit{"_us", Dimension::kTime, 1e-6},      Unit{"_s", Dimension::kTime, 1.0},
};

const Name* find(std::string_view name) {
  for (const Name& n : kNames) {
    if (n.name == name) return &n;
  }
  return nullptr;
}

struct Range {
  std::string_view name;
  double low, high;
};
constexpr std::array<Range, kNumbers> kRanges = {{{"x_mm", -1e5, 1e5},
                                                  {"y_mm", -1e5, 1e5},
                                                  {"z_mm", -1e5, 1e5},
                                                  {"feed_mm_min", 0.0, 1e6},
                                                  {"asked_feed_mm_min", 0.0, 1e6},
                                                  {"spindle_rpm", -1e6, 1e6},
                                                  {"load_percent", -1000.0, 1000.0},
                                                  {"lag_mm", -100.0, 100.0}}};

}  // namespace

std::optional<Column> column_of(std::string_view name, const LogUnits& units) {
  std::string lower(name);
  for (char& c : lower) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (const Name* n = find(lower)) {
    switch (n->dimension) {
      case Dimension::kLength:
        return Column{n->item, units.mm};
      case Dimension::kFeed:
        return Column{n->item, units.mm_min};
      default:
        return Column{n->item, 1.0};
    }
  }
  for (const Unit& u : kUnits) {
    if (!lower.ends_with(u.suffix)) continue;
    const Name* n = find(std::string_view(lower).substr(0, lower.size() - u.suffix.size()));
    if (n == nullptr || n->dimension != u.dimension) return std::nullopt;
    return Column{n->item, u.factor};
  }
  return std::nullopt;
}

std::vector<std::string> known_columns() {
  std::vector<std::string> out;
  for (const Name& n : kNames) out.emplace_back(n.name);
  return out;
}

std::string_view name_of(Item item) { return kRanges[index_of(item)].name; }

std::optional<std::string> fault_of(Item item, double value) {
  const Range& r = kRanges[index_of(item)];
  if (value >= r.low && value <= r.high) return std::nullopt;
  return fmt::format("{} of {} is out of range ({} to {})", r.name, shortest(value), shortest(r.low),
                     shortest(r.high));
}

}  // namespace capstan::casebase::retain
