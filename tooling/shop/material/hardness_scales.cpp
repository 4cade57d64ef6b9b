#include "tooling/shop/material/hardness_scales.h"

#include <limits>
#include <span>

namespace capstan::tooling {
namespace {

struct Point {
  double value, hb;
};
constexpr std::array<Point, 9> kOfRockwellC = {
    {{20, 226}, {25, 253}, {30, 286}, {35, 327}, {40, 371}, {45, 421}, {50, 481}, {55, 560}, {60, 654}}};
constexpr std::array<Point, 9> kOfRockwellA = {{{60.5, 226},
                                                {65.3, 286},
                                                {68.4, 336},
                                                {70.4, 371},
                                                {73.1, 421},
                                                {75.9, 481},
                                                {78.5, 560},
                                                {80.1, 615},
                                                {81.2, 654}}};
constexpr std::array<Point, 9> kOfRockwellB = {
    {{65, 111}, {71, 121}, {77, 137}, {81, 149}, {85, 163}, {90, 183}, {92.8, 197}, {95.5, 212}, {100, 241}}};
constexpr std::array<Point, 13> kOfStrength = {{{320, 95},
                                                {450, 133},
                                                {575, 171},
                                                {705, 209},
                                                {835, 247},
                                                {965, 285},
                                                {1095, 323},
                                                {1220, 361},
                                                {1350, 399},
                                                {1520, 447},
                                                {1775, 513},
                                                {1995, 570},
                                                {2180, 618}}};

double along(std::span<const Point> points, double value) {
  if (value <= points.front().value) return points.front().hb;
  for (std::size_t i = 0; i + 1 < points.size(); ++i) {
    const Point a = points[i], b = points[i + 1];
    if (value <= b.value) return a.hb + (value - a.value) / (b.value - a.value) * (b.hb - a.hb);
  }
  return std::numeric_limits<double>::infinity();
}

}  // namespace

double brinell_of(Scale scale, double value) {
  switch (scale) {
    case Scale::kBrinell:
    case Scale::kVickers:
      return value;
    case Scale::kRockwellA:
      return along(kOfRockwellA, value);
    case Scale::kRockwellB:
      return along(kOfRockwellB, value);
    case Scale::kRockwellC:
      return along(kOfRockwellC, value);
    case Scale::kStrength:
      return along(kOfStrength, value);
    case Scale::kOther:
      break;
  }
  return 0.0;
}

bool converts(Scale scale, std::string_view iso_group) {
  if (scale == Scale::kOther) return false;
  if (scale == Scale::kRockwellB || scale == Scale::kStrength) return iso_group == "P" || iso_group == "H";
  return true;
}

}  // namespace capstan::tooling
