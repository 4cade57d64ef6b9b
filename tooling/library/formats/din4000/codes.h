#pragma once

#include <optional>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::tooling::din4000 {

/// What a code of a table means. `symbol` empty: for people (article, maker), taken elsewhere.
struct Code {
  std::string_view table;  ///< "80", "81", "82"; empty: every table
  std::string_view code, symbol, unit;
};
/// Null: not known for this table.
[[nodiscard]] const Code* find_code(std::string_view table, std::string_view code);

/// The class that a figure of a table shows; nothing where it is none that planning knows or no source tells.
[[nodiscard]] std::optional<model::CutterClass> class_of(std::string_view table, std::string_view figure);
/// What the figure is called.
[[nodiscard]] std::string_view figure_words(std::string_view table, std::string_view figure);

}  // namespace capstan::tooling::din4000
