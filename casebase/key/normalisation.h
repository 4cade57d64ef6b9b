#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "casebase/record/case.h"

/// A question as a point: where distance is measured. Version 2; stores keep the numbers as they are, so that
/// they need not change with it.
///
/// Each number of a question is a coordinate: its logarithm, divided by a fixed scale. The scales never
/// depend on the cases stored, so that a distance means the same tomorrow; a metric that was
/// learned weighs the coordinates (metric.h). Distance is Euclid's. (With the
/// categories equal and the scale of each number fixed, HVDM of Wilson and Martinez, "Improved heterogeneous
/// distance functions", JAIR 6, 1997, is this.)
namespace capstan::casebase {

inline constexpr std::size_t kDimensions = 10;

/// The numbers of a question as they are, and which are known: bit i is dimension i. In this order: diameter,
/// depth, width, tolerance, roughness, cutter diameter, teeth, stick-out, hardness, coolant.
struct Key {
  std::array<double, kDimensions> raw{};
  std::uint16_t known = 0;
  bool operator==(const Key&) const = default;
};

/// Needs a question without fault.
[[nodiscard]] Key key_of(const Question& q);

using Point = std::array<double, kDimensions>;
/// The coordinates; 0 where a number is not known.
[[nodiscard]] Point point_of(const Key& key);

/// The four categories, which have to be equal.
[[nodiscard]] std::string categories_of(const Question& q);
/// One of them.
[[nodiscard]] std::string_view operation_in(std::string_view categories);
[[nodiscard]] std::string_view material_group_in(std::string_view categories);
[[nodiscard]] std::string_view tool_class_in(std::string_view categories);
[[nodiscard]] std::string_view machine_class_in(std::string_view categories);

/// Diameter, depth and width: if one has it and the other has not, they never match.
inline constexpr std::uint16_t kStrict = 0b111;
/// What a number adds to the distance that the question states and the case does not know. Two such numbers
/// are as far as a feature whose size differs by a quarter. Default, unsourced.
inline constexpr double kUnknownDistance = 0.25;

/// How numbers of a question are held against cases that know `known_of_case`.
struct Comparison {
  bool comparable = false;
  std::uint16_t counted = 0;  ///< dimensions that both know
  double added2 = 0.0;        ///< to the squared distance, for what the case does not know
};
[[nodiscard]] Comparison comparison(std::uint16_t known_of_question, std::uint16_t known_of_case);

/// HB of a hardness in HRC (ASTM E140, table 1: non-austenitic steels, 10 mm ball of tungsten carbide),
/// linear between the rows; nothing below 20 HRC, where the scale is not defined.
[[nodiscard]] double hb_of_hrc(double hrc);

}  // namespace capstan::casebase
