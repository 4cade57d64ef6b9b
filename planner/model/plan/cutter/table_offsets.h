#pragma once

#include <optional>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::model {

/// What a line of a machine's tool table says of a tool's size, in the table's unit.
struct TableOffset {
  double z = 0.0;         ///< length offset; 0 where none is stated
  double diameter = 0.0;  ///< 0 where none is stated
};

/// How the length offsets of a tool table are to be read.
struct TableReading {
  bool against_reference = false;  ///< from a reference tool or gauge: they are no lengths
  int zeros = 0;                   ///< tools with a diameter and an offset of 0
};

/// Length offsets are measured from wherever the shop measures: mostly from the gage line, where it is the
/// tool's length; or against a reference tool, and then it is any number. A length is never negative: a table
/// whose Z are all negative, or of both signs with the 0 of the reference tool among them, counts from a
/// reference. One negative Z among lengths is rather a sign that was mistyped. Of other tables the machine's
/// description may say it (control, length_offsets): `stated`.
[[nodiscard]] TableReading reading_of(const std::vector<TableOffset>& table, std::optional<bool> stated);

/// Diameters this near are one, mm: a tool table's is measured to a micrometre at best.
inline constexpr double kSameDiameterMm = 0.001;

/// Where the tool is in the magazine: P of its line in the machine's tool table, else its number.
[[nodiscard]] int magazine_pocket(const Cutter& c);

}  // namespace capstan::model
