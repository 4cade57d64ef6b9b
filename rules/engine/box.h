#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "rules/engine/fact.h"

namespace capstan::rules {

/// One side of a box: an interval [from, below) of a number, or a set of symbols (a bit each).
/// The other half of it stays zero, so that sides compare by value.
struct Side {
  double from = 0.0, below = 0.0;
  std::uint32_t symbols = 0;
  bool symbolic = false;
  friend bool operator==(const Side&, const Side&) = default;
};

/// A product of sides, one per fact of a table. Intervals are half open, so that boxes that touch share
/// nothing and differences are exact: no tolerance anywhere.
using Box = std::vector<Side>;

[[nodiscard]] Side domain_of(const FactType& fact);
[[nodiscard]] bool empty(const Side& side);
[[nodiscard]] bool empty(const Box& box);
[[nodiscard]] bool holds(const Side& side, double value);
[[nodiscard]] Side intersect(const Side& a, const Side& b);
[[nodiscard]] Box intersect(const Box& a, const Box& b);
/// a without b, as boxes that do not overlap: at most two per side.
[[nodiscard]] std::vector<Box> subtract(const Box& a, const Box& b);
/// All of `boxes` without b.
[[nodiscard]] std::vector<Box> subtract(const std::vector<Box>& boxes, const Box& b);
/// "bottom in {flat, conical}, it_grade in [1, 7)"; sides that span the domain are left out.
[[nodiscard]] std::string to_text(const Box& box, const std::vector<std::size_t>& facts);

}  // namespace capstan::rules
