#pragma once

#include <span>
#include <string_view>

namespace capstan::tooling {

/// A property of ISO 13399 by the three names that files use.
///
/// Source   symbols and names: makers' public lists of ISO 13399 parameters; codes: makers' public Part 21
///          files. A code that no public source confirmed is left empty rather than guessed.
struct IsoName {
  std::string_view symbol;  ///< as records.h has it: "DC"
  std::string_view name;    ///< preferred name: "cutting diameter"
  std::string_view bsu;     ///< code in the dictionary
};

[[nodiscard]] std::span<const IsoName> iso_names();
/// By symbol; other spellings of the same property too: "DCONMS" is "DMM" (of a shank, its connection).
[[nodiscard]] const IsoName* find_symbol(std::string_view symbol);
[[nodiscard]] const IsoName* find_bsu(std::string_view code);
/// By preferred name, letter case, blanks, hyphens and underscores aside.
[[nodiscard]] const IsoName* find_preferred_name(std::string_view name);

}  // namespace capstan::tooling
