#pragma once

#include <cstddef>
#include <string>

namespace capstan::testing {

/// A steel plate 20 mm thick with `features` features in a grid, every operation open, as ISO 14649 Part 21
/// text: by turns two through holes of 6.6 mm (+-0.2), a pocket of 10 x 8 mm with corners R2.5 and 3 mm deep
/// (+-0.1), and a dowel hole 8 H7. The first pocket may be of another depth.
struct Plate {
  std::size_t features = 0;
  std::size_t pockets = 0, holes = 0, dowel_holes = 0;
  double length_mm = 0.0, width_mm = 0.0;
  std::string text;
};

[[nodiscard]] Plate plate(std::size_t features, double first_pocket_mm = 3.0);
/// The same plate with through holes of 6.6 mm alone.
[[nodiscard]] Plate plate_of_holes(std::size_t holes);

/// A LinuxCNC tool table with one size of a tool (`key`: "Z" its length, "D" its diameter) changed by so many
/// mm: of the first tool whose comment has these words. Its number is no name: planning gives it. Empty: it
/// has no such tool.
[[nodiscard]] std::string with_tool_changed(std::string table, const std::string& words,
                                            const std::string& key, double by_mm);

}  // namespace capstan::testing
