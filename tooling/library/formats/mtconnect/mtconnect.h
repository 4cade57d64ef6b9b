#pragma once

#include "tooling/library/formats/format.h"

namespace capstan::tooling {

/// CuttingTool assets of MTConnect, written only. The format is `mtconnect_format` (all.h).
///
/// One asset per assembly, per further piece of an item, and per item that has neither. Lengths are in
/// millimetres, angles in degrees, weights in grams, as the standard requires. `nominal` is the catalogue's
/// value; the content of a measurement is what a presetter found, and empty if nothing was measured.
/// Time     the standard requires time stamps, none is known here: 1970-01-01T00:00:00Z means "unknown",
///          so that the same library gives the same bytes. An agent sets its own.
/// Source   MTConnect part 4, schema MTConnectAssets_1.6.xsd (order and names of elements).
[[nodiscard]] Result<Exported> write_mtconnect(const ToolLibrary& library, const FormatOptions& options,
                                               Job& job);

}  // namespace capstan::tooling
