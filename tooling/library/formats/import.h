#pragma once

#include "tooling/library/formats/format.h"

namespace capstan::tooling {

/// As `import_library`, from bytes; `file` is named in diagnostics, and tells where a format that names other
/// files looks for them.
[[nodiscard]] Result<Imported> import_bytes(std::string_view bytes, const std::string& file,
                                            const FormatOptions& options, Job& job);

/// The format that is written to a file of this ending, or null.
[[nodiscard]] const Format* format_of_ending(std::string_view path);

}  // namespace capstan::tooling
