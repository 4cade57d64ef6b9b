#include "casebase/key/normalisation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace capstan::casebase {
namespace {

enum Dimension : std::size_t {
  kDiameter,
  kDepth,
  kWidth,
  kTolerance,
  kRoughness,
  kCutterDiameter,
  kTeeth,
  kStickOut,
  kHardness,
  kCoolant,
};

/// How a number becomes a coordinate: log(max(number, least)) / scale. A distance of one is a factor of
/// e^scale.
struct Scale {
  double scale, least;
};
// Version 2. Defaults, unsourced, but where a line says more. `least`: below, nobody tells two apart.
constexpr double kTwice = std::numbers::ln2;
constexpr std::array<Scale, kDimensions> kScales = {{
    {kTwice, 1e-3},        // diameter
    {kTwice, 1e-3},        // depth
    {kTwice, 1e-3},        // width
    {2.0 * kTwice, 1e-4},  // tolerance: four times as wide
    {2.0 * kTwice, 1e-3},  // roughness: two steps of the series of ISO 1302: 0.8, 1.6, 3.2
    {kTwice, 1e-3},        // cutter diameter
    {kTwice, 1.0},         // teeth
    {kTwice, 1e-3},        // stick-out: eight times as much bending (a beam's, with the third power)
    {0.5 * kTwice, 1.0},   // hardness: 200 and 283 HB
    {1.0, 0.0},            // coolant: not a logarithm: see `coolant_place`
}};
constexpr double kNoToleranceMm = 1.0;  // what no tolerance counts as. Default, unsourced

/// Dry and flooded are as far apart as a case may be from a question.
double coolant_place(double coolant) {
  switch (static_cast<Coolant>(static_cast<int>(coolant))) {
    case Coolant::kMist:
      return 0.25;
    case Coolant::kFlood:
    case Coolant::kThrough:
      return 0.5;
    default:
      return 0.0;
  }
}

// ASTM E140-12b, table 1: HRC, HBW 10/3000; above 50 HRC by the 10 mm ball of tungsten carbide.
struct Hardness {
  double hrc, hb;
};
constexpr std::array<Hardness, 10> kBrinell = {{{20, 226},
                                                {25, 253},
                                                {30, 286},
                                                {35, 327},
                                                {40, 371},
                                                {45, 421},
                                                {50, 481},
                                                {55, 560},
                                                {60, 654},
                                                {65, 739}}};

}  // namespace

double hb_of_hrc(double hrc) {
  if (!(hrc >= kBrinell.front().hrc)) return 0.0;
  const auto above =
      std::find_if(kBrinell.begin() + 1, kBrinell.end() - 1, [&](const Hardness& h) { return hrc <= h.hrc; });
  const Hardness &b = *above, &a = *(above - 1);
  return a.hb + (b.hb - a.hb) * (hrc - a.hrc) / (b.hrc - a.hrc);
}

Key key_of(const Question& q) {
  Key key;
  key.raw[kDiameter] = q.diameter_mm;
  key.raw[kDepth] = q.depth_mm;
  key.raw[kWidth] = q.width_mm;
  key.raw[kTolerance] = q.tolerance_mm > 0.0 ? q.tolerance_mm : kNoToleranceMm;
  key.raw[kRoughness] = q.asked_ra_um;
  key.raw[kCutterDiameter] = q.cutter_diameter_mm;
  key.raw[kTeeth] = q.teeth;
  key.raw[kStickOut] = q.stick_out_mm;
  key.raw[kHardness] = q.hardness_hb > 0.0 ? q.hardness_hb : hb_of_hrc(q.hardness_hrc);
  key.raw[kCoolant] = static_cast<double>(q.coolant);
  for (std::size_t i = 0; i < kDimensions; ++i) {
    if (key.raw[i] > 0.0) key.known = static_cast<std::uint16_t>(key.known | (1U << i));
  }
  return key;
}

Point point_of(const Key& key) {
  Point p{};
  for (std::size_t i = 0; i < kDimensions; ++i) {
    if ((key.known >> i & 1U) == 0) continue;
    p[i] = i == kCoolant ? coolant_place(key.raw[i])
                         : std::log(std::max(key.raw[i], kScales[i].least)) / kScales[i].scale;
  }
  return p;
}

std::string categories_of(const Question& q) {
  return q.operation + '\n' + q.material_group + '\n' + q.tool_class + '\n' + q.machine_class;
}

namespace {

/// The line of this number, from 0.
std::string_view line_of(std::string_view text, int number) {
  for (; number > 0; --number) text.remove_prefix(text.find('\n') + 1);
  return text.substr(0, text.find('\n'));
}

}  // namespace

std::string_view operation_in(std::string_view categories) { return line_of(categories, 0); }
std::string_view material_group_in(std::string_view categories) { return line_of(categories, 1); }
std::string_view tool_class_in(std::string_view categories) { return line_of(categories, 2); }
std::string_view machine_class_in(std::string_view categories) { return line_of(categories, 3); }

Comparison comparison(std::uint16_t known_of_question, std::uint16_t known_of_case) {
  Comparison c;
  c.comparable = (known_of_question & kStrict) == (known_of_case & kStrict);
  c.counted = known_of_question & known_of_case;
  for (std::size_t i = 0; i < kDimensions; ++i) {
    const bool missing = ((known_of_question & ~known_of_case) >> i & 1) != 0;
    if (missing) c.added2 += kUnknownDistance * kUnknownDistance;
  }
  return c;
}

}  // namespace capstan::casebase
