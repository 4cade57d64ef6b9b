#pragma once

#include <map>
#include <string>
#include <vector>

#include "tests/removal/simulation/solid.h"
#include "tests/removal/simulation/stock.h"

namespace capstan::testing::removal {

/// Points on the wrong side, together.
struct Amount {
  std::size_t points = 0;
  double volume_mm3 = 0.0;
  double deepest_mm = 0.0;  ///< how far the worst lies beyond the target's surface
  Point worst;
  Box around;
};

struct Comparison {
  std::map<std::size_t, Amount> gouges;  ///< by the step that removed what must stay
  std::vector<Amount> left;              ///< material that must be gone, by place
};

/// Compares each point of the stock with the target. A point further than `tolerance_mm` within what must
/// stay that is gone is a gouge; one further than `tolerance_mm` within what must be gone that is there is
/// left over.
[[nodiscard]] Comparison compare(const Stock& stock, const Target& target, double tolerance_mm);

/// What is wrong with a program; nothing when it makes the target.
struct Verdict {
  std::vector<std::string> gouges, left, idle, rapids, rubs, faults;
  std::vector<Point> left_at;  ///< the worst place of each of `left`
  std::size_t steps = 0;
  [[nodiscard]] bool agrees() const;
  [[nodiscard]] std::string text() const;
};

/// All that a program needs, as texts.
struct Emitted {
  std::string program, tool_table, json, iso14649;
};

struct Grid {
  double cell_mm = 0.4, cell_z_mm = 0.15;
  double tolerance_mm = 0.12;
};

/// Runs a program on a block and holds what is left against the target. The frames of set-ups come from the
/// placement of the workpiece in each, as written into the ISO 14649 file. `remains`, when given, receives
/// the stock.
[[nodiscard]] Verdict simulate(const Emitted& emitted, const Box& block, const Target& target,
                               const Grid& grid, Stock* remains = nullptr);
/// As above, for motions read before; `cutters` by tool number, `frames` by set-up from 1.
[[nodiscard]] Verdict simulate(const Motions& motions, const std::map<int, CutterBody>& cutters,
                               const std::map<int, Frame>& frames, const Box& block, const Target& target,
                               const Grid& grid, Stock* remains = nullptr);
/// The frames of the set-ups in a file, by number from 1; empty with a reason in `fault` when one does not
/// run along the axes of the workpiece.
[[nodiscard]] std::map<int, Frame> frames_of(const std::string& iso14649, std::string& fault);

}  // namespace capstan::testing::removal
