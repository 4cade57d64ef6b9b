#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "tooling/library/formats/format.h"

namespace capstan::tooling {

/// ISO 13399 exchange files: Part 21 with the schema CUTTING_TOOL_SCHEMA_ARM. The formats are
/// `iso13399_format` (a `.p21` file, both ways) and `gtc_format` (a package of them, read only), see all.h.
///
///     ITEM <- ITEM_VERSION <- ITEM_DEFINITION <- PROPERTY_VALUE_ASSOCIATION -> PROPERTY_VALUE_REPRESENTATION
///                                                  -> PROPERTY -> PLIB_PROPERTY_REFERENCE (code)
///                                                  -> NUMERICAL_VALUE / STRING_VALUE (name, value, UNIT)
///
/// A value's symbol is found by the code of the dictionary, else by the value's name as symbol, else as
/// preferred name. A value without a symbol is kept under its name. Roles come from
/// SPECIFIC_ITEM_CLASSIFICATION: tool items become catalogue items, adaptive items holders; cutting items
/// (inserts) are reported and skipped. Values that no association ties to an item belong to the only item of
/// a file.
///
/// Units    lengths and angles need theirs; numbers may be quoted or plain.
/// Source   entity and attribute order: as makers' public files have them.
/// Fails    ISO13399-FORM (wrong schema, type or number of parameters), ISO13399-DANGLING, DATA-NUMBER,
///          DATA-UNIT, TOOL-VALUE, TOOL-ID, P21-*.
struct IsoReadOptions {
  /// For GTC packages: class and order number as package_assortment.xml has them.
  std::string gtc_class, product_id;
};
[[nodiscard]] Result<Imported> read_iso13399(std::string_view bytes, const std::string& file,
                                             const IsoReadOptions& options, Job& job);

/// Classification of a tool that must not be planned with; the reason is the class. Without it the tool's
/// words might give it a class again.
inline constexpr std::string_view kNotPlanned = "not for planning";

[[nodiscard]] Result<Exported> write_iso13399(const ToolLibrary& library, const FormatOptions& options,
                                              Job& job);

}  // namespace capstan::tooling
