#pragma once

#include <array>
#include <map>
#include <vector>

#include "tests/examples/linuxcnc/scenarios.h"

namespace capstan::linuxcnc {

/// A flat end mill as it really is, whatever the tool table says.
struct Mill {
  double length_mm = 0.0, diameter_mm = 0.0;
};

/// What is left of a block after the machine was where it was: its top over a grid of points, swept by the
/// tools as they are. Own code: it knows neither plan nor program.
///
/// Frame  the block's front left top corner is at `top_mm` above the machine's X0 Y0 Z0.
class CutBlock {
 public:
  CutBlock(double width_mm, double depth_mm, double top_mm);
  /// Sweeps the samples of a run with the tools by number. Lines between samples: 0.03 mm apart at the most,
  /// not needed.
  void cut(const Record& record, int mark, const std::map<int, Mill>& tools);

  static constexpr double kCell = 0.25;  ///< between points, mm
  /// Where a cell's point is in it, mm: walls at whole cells have points this far inside of them or outside.
  static constexpr double kPoint = 0.03;
  /// Over the block's top as it was, at most 0, of the point i * kCell + kPoint, j * kCell + kPoint.
  [[nodiscard]] double at(int i, int j) const { return top_[static_cast<std::size_t>(j * nx_ + i)]; }
  /// Least and greatest X and Y that an edge of a tool had below the block's top.
  [[nodiscard]] const std::array<double, 4>& reached() const { return reached_; }
  [[nodiscard]] int nx() const { return nx_; }
  [[nodiscard]] int ny() const { return ny_; }
  [[nodiscard]] bool whole() const;
  /// True when a tool went into the block with its spindle not turning.
  [[nodiscard]] bool struck() const { return struck_; }
  /// How deep a rapid move went into the block at the most, mm.
  [[nodiscard]] double rapid_mm() const { return rapid_mm_; }
  /// The spindle's greatest speed while it cut, 1/min.
  [[nodiscard]] double fastest_rpm() const { return fastest_rpm_; }

 private:
  int nx_, ny_;
  double top_mm_;
  std::vector<double> top_;
  std::array<double, 4> reached_;
  bool struck_ = false;
  double rapid_mm_ = 0.0;
  double fastest_rpm_ = 0.0;
};

/// The greatest distance, mm, by which a block differs from one with the pocket of
/// examples/reference_pocket.p21: points that are cut count with their distance outside of it, points that
/// are not with theirs inside, points inside with their height over or under its floor, and what the tools
/// reached with its distance from the walls.
[[nodiscard]] double differs_from_pocket(const CutBlock& block);

}  // namespace capstan::linuxcnc
