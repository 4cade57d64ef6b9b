#pragma once

#include <optional>
#include <string_view>

namespace capstan::service {

/// A kind of file that is given by mistake for a part or a plan.
struct ForeignFile {
  std::string_view what;  ///< "a DXF drawing"
  std::string_view hint;  ///< what to do
};

/// What these bytes are, where they are surely neither a part nor a plan; nothing otherwise. Told by the
/// signatures that the formats state, and text of a program by its words.
[[nodiscard]] std::optional<ForeignFile> foreign_file(std::string_view bytes);

}  // namespace capstan::service
