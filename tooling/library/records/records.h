#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"

/// @file The four records of a shop's tools, as catalogues and tool rooms keep them: what can be bought
/// (item), the piece on the shelf (instance), how it is put together (assembly), where it sits (machine
/// entry). Every format of `tooling/library/formats` reads into a ToolLibrary and is written from one;
/// `cutters_of` makes of it what planning uses.

namespace capstan::tooling {

/// Where a value comes from.
enum class ValueState : std::uint8_t { kStated, kDerived, kDefault };
[[nodiscard]] std::string_view to_text(ValueState s);  ///< "stated", "derived", "default"

/// One property by its ISO 13399 preferred symbol ("DC", "APMX", "LF"); unknown ones by the name the file
/// gives.
///
/// Units   `number` in mm, rad, kg, bar, 1/min, min; `text` is the spelling of the source, in `unit` of the
///         source ("in", "mm", "deg"), so that inch and metric survive. No number: a text, a code.
struct Property {
  std::string symbol;
  std::optional<double> number;
  std::string text, unit;
  ValueState state = ValueState::kStated;
  std::string source;  ///< "maker's P21, property 71D078EB7C086", "DIN 4000 A1", "generic series"
  bool operator==(const Property&) const = default;
};

/// Start values for a material, as CAM systems keep them; unset: not given.
struct Preset {
  std::string name, material;  ///< a group letter, a material's name or the system's own query; empty: any
  std::optional<double> rpm, vc_m_min, fz_mm, feed_per_revolution_mm, feed_mm_min, plunge_mm_min, ramp_mm_min;
  std::optional<double> ramp_angle_rad, stepdown_mm, stepover_mm;
  std::string coolant, source;
  bool operator==(const Preset&) const = default;
};

/// A purchasable tool.
struct CatalogueItem {
  std::string id;  ///< unique in the library
  std::string description, manufacturer, product_id, product_link;
  std::optional<model::CutterClass> cutter_class;  ///< unset: a kind that planning does not know
  std::string kind;  ///< the source's own word: "flat end mill", "DIN4000-82", a class code
  std::vector<Property> properties;
  std::vector<Preset> presets;
  std::vector<std::pair<std::string, std::string>> kept;  ///< what has no place here, verbatim (path, text)
  bool inches = false;                                    ///< its sizes were stated in inches
  bool operator==(const CatalogueItem&) const = default;
};

/// A piece on the shelf.
struct ToolInstance {
  std::string id, item;  ///< `item`: the catalogue item's id
  std::string group;     ///< sister tools share one
  std::optional<int> in_stock;
  std::optional<double> price, life_min, life_used_min;
  std::vector<Property> measured;  ///< presetter: DC, LF, RE as they really are
  bool operator==(const ToolInstance&) const = default;
};

struct Holder {
  std::string id, description, product_id, manufacturer, product_link;
  std::string connection;  ///< code towards the machine: "BT40", a CZC code
  std::optional<double> gage_length_mm;
  std::vector<model::HolderSegment> segments;  ///< from the tool's side up
  std::vector<std::pair<std::string, std::string>> kept;
  bool inches = false;
  bool operator==(const Holder&) const = default;
};

/// A tool in its holder, with its stick-out.
struct ToolAssembly {
  std::string id, item, instance, holder;      ///< `instance` and `holder` may be empty
  std::optional<double> stick_out_mm;          ///< LPR, from the holder's face
  std::optional<double> functional_length_mm;  ///< LF, gage line to tip
  bool operator==(const ToolAssembly&) const = default;
};

/// A line of the machine's tool table.
struct MachineEntry {
  int number = 0;                  ///< T
  std::optional<int> pocket;       ///< P
  std::string carousel, assembly;  ///< `assembly`: id; empty: only the table knows the tool
  std::vector<std::pair<char, double>>
      offsets;  ///< X Y Z A B C U V W in the table's unit, D, I, J, Q as given
  std::string comment;
  bool operator==(const MachineEntry&) const = default;
};

/// A library as a file or store holds it.
struct ToolLibrary {
  std::string name, source;  ///< `source`: the file
  std::vector<CatalogueItem> items;
  std::vector<ToolInstance> instances;
  std::vector<Holder> holders;
  std::vector<ToolAssembly> assemblies;
  std::vector<MachineEntry> entries;
  std::vector<std::pair<std::string, std::string>> kept;  ///< of the file as a whole, verbatim
  bool operator==(const ToolLibrary&) const = default;
};

/// Report of reading or writing a library: each line about one tool or field, in the file's order.
struct LossReport {
  struct Line {
    std::string tool, field, what;  ///< `tool` empty: all of them
    bool operator==(const Line&) const = default;
  };
  std::size_t tools = 0;      ///< read or written
  std::vector<Line> derived;  ///< values that follow from others, or were taken by default
  std::vector<Line> dropped;  ///< what the other side has no place for, with the reason
};

[[nodiscard]] const Property* find(const std::vector<Property>& properties, std::string_view symbol);
/// The number of a property; nothing when absent or not a number.
[[nodiscard]] std::optional<double> number_of(const CatalogueItem& item, std::string_view symbol);

}  // namespace capstan::tooling
