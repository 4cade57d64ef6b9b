#pragma once

namespace capstan::model {

/// A fillet whose radius is this near to that of a cutter's corner is made by it, mm: what then stands or lacks
/// in the fillet is 0.41 of the difference (the root of two, less one), 0.02 mm. ISO 2768-1 lets the radii of a
/// drawing differ by ten times as much (0.2 mm up to a radius of 3 mm, classes f and m). So are fillets
/// of 1/16 inch made by a corner of 1.6 mm.
inline constexpr double kFilletSlackMm = 0.05;

}  // namespace capstan::model
