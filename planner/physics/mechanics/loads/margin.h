#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/number.h"

/// The one policy of margins: the ratio of the load that is compared with a limit to the expected load.
///
/// A force may exceed the computed one because the coefficients of the material spread, because the edge
/// wears, and because the operator turns the feed up. These do not know of one another, so that their
/// logarithms add as squares,
///
///     limit load = expected load exp(k sqrt(ln^2 spread + ln^2 wear + ln^2 override))
///
/// with each factor the one of a single standard deviation and k standard deviations on one side. A product
/// of all three would ask that the worst material meets the dullest edge and the highest override at once.
///
/// Source    sum of variances of independent quantities (JCGM 100:2008, 5.1.2); k: quantiles of the normal
///           distribution. kForceUncertaintyFactor is half the range, in logarithms, of the four published
///           sets for one alloy; the mean range of four samples is 2.06 standard deviations (ISO 7870-2,
///           d2), so that it stands for one. kWearForceFactor is that of an edge at the end of its life, the
///           override the most that the machine lets the operator turn: both taken for one, too (on the safe
///           side: most of an edge's life and of a program runs below).
namespace capstan::mechanics {

/// A policy of the shop's own is a number of deviations, of which it is also the name. More than
/// kMostDeviations hold back what no spread explains; at none, every second cut exceeds its limit.
struct MarginPolicy {
  std::string name;
  double deviations = 1.0;  ///< k
};
inline constexpr double kMostDeviations = 3.0;

/// Those with a name (--margin): the load stays below its limit in 95 %, 84 % and 70 % of all cuts.
struct NamedMargin {
  std::string_view name;
  double deviations;
};
inline constexpr std::array<NamedMargin, 3> kNamedMargins = {
    {{"careful", 1.6449}, {"usual", 1.0}, {"bold", 0.5244}}};
inline constexpr NamedMargin kUsualMargin = kNamedMargins[1];
[[nodiscard]] inline MarginPolicy usual_margin() {
  return {std::string(kUsualMargin.name), kUsualMargin.deviations};
}

/// A policy by its name, or by its number of deviations ("1.28": 90 % of all cuts), above 0 and at most
/// kMostDeviations; none for other words.
[[nodiscard]] inline std::optional<MarginPolicy> margin_policy(const std::string& name) {
  for (const NamedMargin& m : kNamedMargins) {
    if (m.name == name) return MarginPolicy{name, m.deviations};
  }
  const auto k = parse_double(name);
  if (!k || !(*k > 0.0) || !(*k <= kMostDeviations)) return std::nullopt;
  return MarginPolicy{shortest(*k), *k};
}

[[nodiscard]] inline std::vector<std::string> margin_names() {
  std::vector<std::string> names;
  for (const NamedMargin& m : kNamedMargins) names.emplace_back(m.name);
  return names;
}

/// What a margin may be, for who named none: "careful, usual, bold, or a number of standard deviations ...".
[[nodiscard]] inline std::string margins_asked() {
  std::string out;
  for (const NamedMargin& m : kNamedMargins) out += std::string(m.name) + ", ";
  return out + "or a number of standard deviations above 0 and at most " + trimmed(kMostDeviations, 1);
}

}  // namespace capstan::mechanics
