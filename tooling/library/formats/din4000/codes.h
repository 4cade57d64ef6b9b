#pragma once

#include <optional>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::tooling::din4000 {

/// Meaning of a code of a table. `symbol` empty: for people only (article, maker), or read elsewhere.
struct Code {
  std::string_view table;  ///< "80", "81", "82"; empty: every table
  std::string_view code, symbol, unit;
};
/// Null: not known for this table.
[[nodiscard]] const Code* find_code(std::string_view table, std::string_view code);

/// The class that a figure of a table shows; nothing if planning does not know it or no source says.
[[nodiscard]] std::optional<model::CutterClass> class_of(std::string_view table, std::string_view figure);
/// The name of the figure.
[[nodiscard]] std::string_view figure_words(std::string_view table, std::string_view figure);

}  // namespace capstan::tooling::din4000
