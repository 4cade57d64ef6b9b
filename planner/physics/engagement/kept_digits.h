#pragma once

#include "planner/model/plan/cutter_path.h"

namespace capstan::engagement {

/// Rounds measured sections to the digits that a plan keeps: those that the measurement is sure of, so that
/// files do not carry the noise behind them.
///
///     known_to_mm       lengths                     areas, volumes          at_mm
///     0: exactly        7 digits, down to 1e-6 mm   7 digits                1e-6 mm
///     a cell, mm        down to a 100th of it       5 digits                1e-6 mm
///
/// The measurement is accurate to 1e-6 of the diameter where it is exact, else to a cell and to 0.005 % of an
/// area at best (README.md): what is rounded away is less than half of that.
/// Needs  finite numbers.
void keep_digits(model::SectionSeries& sections, double known_to_mm);

}  // namespace capstan::engagement
