#pragma once

#include <cstddef>
#include <vector>

#include "tests/validation/nist/plate_time.h"

/// What the models say of a small bore that an end mill of the plates mills on a helix.
namespace capstan::validation::nist {

/// What the program asks of a bore.
struct Programmed {
  double diameter_mm = 0.0, pitch_mm = 0.0, orbit_mm = 0.0;
  std::vector<std::size_t> moves;  ///< the arcs that mill it
};
/// `nominal_mm`: tells the arcs of bores of that size from those of others.
[[nodiscard]] Programmed programmed(const ToolRun& run, double tool_mm, double nominal_mm);

struct Prediction {
  double stiffness_n_mm = 0.0, frequency_hz = 0.0, stable_mm = 0.0;
  double bore_by_bending_mm = 0.0;  ///< change of the diameter; below zero: the bore is small
};
[[nodiscard]] Prediction predict_bore(double tool_mm, double stickout_mm, const Programmed& p,
                                      double per_rev_mm, double rpm);

/// The tool of a row in its bores.
struct BoreOfRow {
  Programmed asked;
  double speed_mm_s = 0.0, per_rev_mm = 0.0;  ///< mean in the bore, as the machine moves
  Prediction predicted;
};
/// Needs  a row of a tool that mills bores of that size.
[[nodiscard]] BoreOfRow bore_of(const Plate& plate, const MachineFit& fit, const Row& row, double nominal_mm);

}  // namespace capstan::validation::nist
