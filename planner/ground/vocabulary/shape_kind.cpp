#include "planner/ground/vocabulary/shape_kind.h"

#include <array>

namespace capstan::model {

std::string_view to_text(ShapeKind k) {
  constexpr std::array<std::string_view, 13> kNames = {
      "face",       "pocket", "slot",          "step",        "hole",     "outside", "chamfer",
      "edge_round", "thread", "spherical_cap", "rounded_end", "freeform", "toolpath"};
  return kNames.at(static_cast<std::size_t>(k));
}

}  // namespace capstan::model
