#include "planner/ground/vocabulary/shape_kind.h"

#include <array>

namespace capstan::model {
namespace {

constexpr unsigned operator|(ShapeTrait a, ShapeTrait b) {
  return static_cast<unsigned>(a) | static_cast<unsigned>(b);
}
constexpr unsigned operator|(unsigned a, ShapeTrait b) { return a | static_cast<unsigned>(b); }

using enum ShapeTrait;
constexpr std::array kRows{
#define CAPSTAN_SHAPE_KIND(Kind, name, traits) \
  ShapeKindRow{ShapeKind::k##Kind, name, static_cast<std::uint16_t>(traits)},
#include "planner/ground/vocabulary/shape_kinds.inc"
#undef CAPSTAN_SHAPE_KIND
};

}  // namespace

std::span<const ShapeKindRow> shape_kinds() { return kRows; }
bool has(ShapeKind k, ShapeTrait t) {
  return (kRows.at(static_cast<std::size_t>(k)).traits & static_cast<std::uint16_t>(t)) != 0;
}
std::string_view to_text(ShapeKind k) { return kRows.at(static_cast<std::size_t>(k)).name; }

}  // namespace capstan::model
