#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "tests/removal/simulation/cutter.h"
#include "tests/removal/simulation/point.h"
#include "tests/removal/simulation/program.h"

namespace capstan::testing::removal {

/// Where a set-up's coordinates lie in those of the workpiece: each axis runs along one of the workpiece's.
struct Frame {
  Point origin;  ///< of the set-up, workpiece coordinates
  std::array<int, 3> axis{1, 2,
                          3};  ///< set-up's x, y, z along 1 x, 2 y, 3 z of the workpiece; negative: against
};

/// What one step did.
struct StepRemoval {
  std::size_t points = 0;    ///< removed by edges and shank
  std::size_t by_rapid = 0;  ///< of these, in rapid motion
  std::size_t by_shank = 0;  ///< of these, by what has no edges
  Point rapid_at, shank_at;  ///< one of each
  std::string fault;         ///< why it could not be simulated
};

/// The material as a lattice of points in workpiece coordinates, each there or not. A point goes when the
/// swept body covers it, so that what is said of it is exact there; what lies between points is not seen.
/// Undercuts are held as well as anything, and every set-up along an axis of the workpiece cuts the same
/// lattice. Each point remembers the step that removed it.
class Stock {
 public:
  /// A block; `cell` is the distance of points across, `cell_z` along z.
  Stock(Box block, double cell, double cell_z);
  /// Sweeps the tool along a motion in a set-up's frame.
  void sweep(const Motion& motion, const CutterBody& body, const Frame& frame, StepRemoval& record);

  [[nodiscard]] const std::array<int, 3>& count() const { return n_; }
  [[nodiscard]] Point at(int x, int y, int z) const;
  [[nodiscard]] bool present(int x, int y, int z) const { return by_[index(x, y, z)] == kPresent; }
  /// The step that removed it.
  [[nodiscard]] std::size_t remover(int x, int y, int z) const { return by_[index(x, y, z)]; }
  [[nodiscard]] double cell() const { return cell_[0]; }
  [[nodiscard]] double cell_z() const { return cell_[2]; }
  [[nodiscard]] double point_volume() const { return cell_[0] * cell_[1] * cell_[2]; }

 private:
  static constexpr std::uint16_t kPresent = 0xFFFF;
  struct Piece;
  void capsule(const Piece& p);
  void column(const Piece& p, int x, int y, double less);
  void single(const Piece& p, int x, int y, int z, double less);
  void take(const Piece& p, int x, int y, int z, bool shank);
  /// Whether no point of a column is above the piece's lowest tip, seen along the tool; for a tool along z.
  [[nodiscard]] bool gone_above(const Piece& p, int x, int y);
  [[nodiscard]] Point in(const Frame& frame, const Point& work) const;
  [[nodiscard]] std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(n_[0]) + static_cast<std::size_t>(x)) *
               static_cast<std::size_t>(n_[2]) +
           static_cast<std::size_t>(z);
  }

  Point lo_;
  std::array<double, 3> cell_{};
  std::array<int, 3> n_{};
  std::vector<std::uint16_t> by_;
  /// Of each column: no point from the index `top_` on is there, and none below `bottom_`.
  std::vector<std::uint16_t> top_, bottom_;
};

}  // namespace capstan::testing::removal
