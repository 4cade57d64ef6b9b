#pragma once

#include <optional>
#include <string_view>

namespace capstan {

/// What to do with a program where a part was wanted.
inline constexpr std::string_view kPlanItsPart =
    "plan the part that it was made of; `capstan check` judges programs";

/// A kind of file that Capstan does not read as a part, plan or data file; people give one by mistake.
struct ForeignFile {
  std::string_view what;  ///< "a DXF drawing"
  std::string_view hint;  ///< what to do where a part was wanted
  bool program = false;   ///< of a control, which `check` reads
};

/// What these bytes are, where they are surely neither a part nor a plan nor data in YAML or JSON; nothing
/// otherwise. Told by the signatures that the formats state, and text of a program by its words.
[[nodiscard]] std::optional<ForeignFile> foreign_file(std::string_view bytes);

}  // namespace capstan
