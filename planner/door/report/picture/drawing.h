#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "planner/ground/geometry/vec.h"

/// A flat picture as a value, which is written as SVG (svg.h) or as pixels (raster.h).
///
/// Frame  x to the right, y down, from the upper left corner.
/// Units  units of the picture; a character of its text is kGlyphWide of them wide.
namespace capstan::report::picture {

using Polyline = std::vector<geometry::Vec2>;

struct Colour {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(Colour, Colour) = default;
};

/// Lines of one pen, or outlines of an area (even-odd rule).
struct Lines {
  std::vector<Polyline> lines = {};
  bool closed = false;  ///< the last point of each joins the first
  std::optional<Colour> fill = {}, stroke = {};
  double width = 1.0;
  bool dashed = false;
};

/// Discs of one size and colour.
struct Dots {
  std::vector<geometry::Vec2> at = {};
  double radius = 1.0;
  Colour fill = {};
};

/// A line of text. `at` is on its base line, at its left end, or its right end where `ends_there`.
struct Words {
  geometry::Vec2 at = {};
  std::string text = {};
  Colour colour = {};
  bool bold = false, ends_there = false;
};

inline constexpr double kGlyphWide = 6.0, kGlyphHigh = 7.0;
inline constexpr double kFontSize = 10.0;  ///< at which a monospaced font is 6 units wide
/// Pixels of a unit, at the size in which a picture is shown.
inline constexpr int kPixelsPerUnit = 2;
inline constexpr double kDashOn = 4.0, kDashOff = 3.0;

/// Shapes that belong together, under a name that viewers show. `step`: of the plan, from 1; 0: none.
struct Group {
  std::string title = {};
  std::size_t step = 0;
  std::vector<std::variant<Lines, Dots, Words>> shapes = {};
};

/// The shapes in the order in which they are drawn, later ones over earlier ones.
struct Drawing {
  double width = 0.0, height = 0.0;
  std::string title = {};
  std::vector<Group> groups = {};
};

}  // namespace capstan::report::picture
