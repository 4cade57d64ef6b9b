#pragma once

#include <cstdint>
#include <map>
#include <numbers>
#include <optional>
#include <set>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "tooling/library/records/records.h"

/// @file What the readers and writers of tool libraries share: symbols, units, numbers as they are spelled.

namespace capstan::tooling {

/// Tool numbers and pockets at most, in every format: what LinuxCNC's tool table holds (five digits).
inline constexpr int kMostToolNumber = 99999;

enum class Quantity : std::uint8_t { kLength, kAngle, kNumber, kCount, kText };

/// Meaning of a symbol and its range of values; lengths in mm, angles in degrees (here only).
struct SymbolFact {
  std::string_view symbol;
  Quantity quantity;
  double least, most;
  std::string_view words;  ///< "cutting diameter"
};
/// The symbols that planning reads (ISO 13399, and names of our own: "TA" half taper or tip angle,
/// "FZMIN", "FZMAX", "LEADLENGTH", "LEADTHREADS", "RUNOUT", "LIFE", "PRICE"); null for others.
[[nodiscard]] const SymbolFact* symbol_fact(std::string_view symbol);

/// Position of a value in a file.
struct Place {
  std::string file;
  std::uint64_t line = 0;  ///< 0 unknown
  std::string path;        ///< tool and element: "tool 3 '6 mm drill', geometry.DC"
};
[[nodiscard]] Diagnostic fault_at(const Place& place, std::string code, std::string message,
                                  std::string expected = {}, std::string hint = {});

/// 1 or 25.4 of "mm", "millimeters", "metric", "in", "inch", "inches", ...; nothing of others.
[[nodiscard]] std::optional<double> mm_per_unit_of(std::string_view unit);

/// The number as spelled; blanks around it and a leading + are allowed.
/// Fails  DATA-NUMBER: not one finite number (NaN, 1e400, text); a decimal comma unless `decimal_comma`.
[[nodiscard]] Result<double> number_from(std::string_view text, const Place& place,
                                         bool decimal_comma = false);

/// A property whose number is converted from `unit` ("mm", "in", "deg", "rad", "" for counts) and held to
/// what the symbol allows; the spelling is kept.
/// Fails  DATA-NUMBER, DATA-UNIT for a length without a unit, TOOL-VALUE out of range (3.9 flutes, -1, 300).
[[nodiscard]] Result<Property> property_from(std::string_view symbol, std::string_view text,
                                             std::string_view unit, std::string_view source,
                                             const Place& place, bool decimal_comma = false);
/// What a value's record says of its origin: "stated: of sheet 3"; its symbol where it names no source.
[[nodiscard]] std::string words_of(const Property& p);
/// Whether a text means yes, in English or German.
[[nodiscard]] bool yes(std::string_view text);
/// A text or code.
[[nodiscard]] Property text_property(std::string_view symbol, std::string_view text, std::string_view source);
/// A number of ours (mm, rad), spelled in `unit`.
[[nodiscard]] Property number_property(std::string_view symbol, double number, std::string_view unit,
                                       ValueState state, std::string_view source);

/// The value spelled in `unit`: as the source spelled it when its unit is the same, converted otherwise.
[[nodiscard]] std::string spelled_in(const Property& property, std::string_view unit);
/// A number of ours in a unit: the shortest text that reads back to it.
[[nodiscard]] std::string spelled(double ours, double factor);

/// Ids that are taken, and where to go on counting for one that is met again.
struct UniqueIds {
  std::set<std::string> taken;
  std::map<std::string, int> next;
};

/// "tool 3 'description'": how readers name an entry to people.
[[nodiscard]] std::string tool_words(std::size_t index, std::string_view description);
/// Without blanks at either end.
[[nodiscard]] std::string_view trimmed_text(std::string_view text);
/// The id, or the id with " (2)", " (3)" ... behind, so that none of `taken` is met; adds it there.
[[nodiscard]] std::string unique_id(const std::string& id, UniqueIds& taken);

/// The value stated for a path ("geometry.JET") in a list of kept texts, or null.
[[nodiscard]] const std::string* find_kept(const std::vector<std::pair<std::string, std::string>>& kept,
                                           std::string_view path);

}  // namespace capstan::tooling
