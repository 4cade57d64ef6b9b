#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::tooling::freecad {

/// A shape of FreeCAD and the class it is.
struct Shape {
  std::string_view type;  ///< "Endmill"
  std::optional<model::CutterClass> cutter_class;
};

/// Source of a largest feed per tooth that a bit states as its chip load.
inline constexpr std::string_view kChipLoad = "FreeCAD Chipload";

/// By type, by an alias ("v-bit", "torus", "thread-mill") or by the name of the shape's file.
[[nodiscard]] const Shape* find_shape(std::string_view type);
/// The file of FreeCAD that draws it: "endmill.fcstd"; empty for a custom shape.
[[nodiscard]] std::string file_of(const Shape& shape);
/// The shape that fits a class best; null: none does. `exact`: the shape also determines the class.
[[nodiscard]] const Shape* shape_of(model::CutterClass c, bool& exact);

/// The symbol of a parameter of a shape; empty: no symbol, kept word for word.
[[nodiscard]] std::string_view symbol_of(const Shape& shape, std::string_view parameter);
/// The other way; empty: the shape has no such parameter.
[[nodiscard]] std::string_view parameter_of(const Shape& shape, std::string_view symbol);

}  // namespace capstan::tooling::freecad
