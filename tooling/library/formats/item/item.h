#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "tooling/library/formats/format.h"
#include "tooling/library/formats/values.h"

namespace capstan::tooling {

/// One value as a file spells it.
struct StatedValue {
  std::string_view symbol;  ///< of ISO 13399, or the file's own name if none is known
  std::string_view text;
  std::string_view unit;  ///< "mm", "in", "deg", ""
  std::string source;
  bool decimal_comma = false;  ///< allowed, beside the point
};

/// Adds the value to the item. An unknown symbol is kept as text, with its number if it is one; an empty text
/// adds nothing. Returns the fault: as `property_from`, or a symbol given twice with different values.
[[nodiscard]] std::optional<Diagnostic> add_value(CatalogueItem& item, const StatedValue& value,
                                                  const Place& place);

/// Adds a value (mm, rad) that follows from others, and says so; nothing when the symbol has one.
void add_derived(CatalogueItem& item, std::string_view symbol, double number, std::string_view unit,
                 std::string why, LossReport& report);
void add_derived_text(CatalogueItem& item, std::string_view symbol, std::string_view text, std::string why,
                      LossReport& report);

/// Contradictions between an item's values, each as a sentence with its numbers: a zero diameter, flutes
/// longer than the tool, a radius beyond half the diameter, an unknown hand, no teeth.
[[nodiscard]] std::vector<std::string> item_faults(const CatalogueItem& item);

/// Key of the reason of `leave_out` in CatalogueItem::kept; readers find it again, writers skip it.
inline constexpr std::string_view kLeftOut = "left out";
/// Removes the class: the known values do not allow planning with the tool.
void leave_out(CatalogueItem& item, const std::string& why, LossReport& report);

/// An end mill whose corner has a radius is a bullnose or ball end mill.
void class_by_radius(CatalogueItem& item);

/// Gathers the items of a file: those with faults are dropped and warned of, ids are held to be unique.
class ItemGatherer {
 public:
  /// `code`: of the faults it finds itself, "FREECAD-VALUE".
  ItemGatherer(Imported& out, std::string file, std::string code, Job& job)
      : out_(out), file_(std::move(file)), code_(std::move(code)), job_(job) {}

  /// A fault found while reading the item that comes next.
  void fault(Diagnostic d) { pending_.push_back(std::move(d)); }
  void fault(std::optional<Diagnostic> d) {
    if (d) pending_.push_back(std::move(*d));
  }
  void fault(const Place& place, std::string what, std::string expected = {});
  /// Whether the next item has one already: a value that could not be read is not missed, too.
  [[nodiscard]] bool has_fault() const { return !pending_.empty(); }
  /// Takes the item, or drops it when it has faults; whether it was taken.
  bool take(CatalogueItem item, const Place& place);
  /// Fails with the first fault when no item is left, or (TOOL-ID) when an id is given twice.
  [[nodiscard]] Status finish(std::string_view what_the_file_should_hold);

 private:
  Imported& out_;
  std::string file_, code_;
  Job& job_;
  std::vector<Diagnostic> pending_, dropped_;
  std::optional<Diagnostic> duplicate_;
  std::set<std::string> ids_;
};

}  // namespace capstan::tooling
