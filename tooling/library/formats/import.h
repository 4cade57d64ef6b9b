#pragma once

#include "tooling/library/formats/format.h"

namespace capstan::tooling {

/// As `import_library`, from bytes. `file` is named in diagnostics, and is where a format that names other
/// files looks for them.
[[nodiscard]] Result<Imported> import_bytes(std::string_view bytes, const std::string& file,
                                            const FormatOptions& options, Job& job);

/// The format whose ending a path has, or null.
[[nodiscard]] const Format* format_of_ending(std::string_view path);

}  // namespace capstan::tooling
