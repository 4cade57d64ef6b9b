#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

struct MarginPolicy {
  std::string_view name;
  double deviations = 1.0;  ///< k
};

/// The shop's to choose (--margin): the load stays below its limit in 95 %, 84 % and 70 % of all cuts.
inline constexpr std::array<MarginPolicy, 3> kMarginPolicies = {
    {{"careful", 1.6449}, {"usual", 1.0}, {"bold", 0.5244}}};
inline constexpr MarginPolicy kUsualMargin = kMarginPolicies[1];

[[nodiscard]] constexpr std::optional<MarginPolicy> margin_policy(std::string_view name) {
  for (const MarginPolicy& p : kMarginPolicies) {
    if (p.name == name) return p;
  }
  return std::nullopt;
}

[[nodiscard]] inline std::vector<std::string> margin_names() {
  std::vector<std::string> names;
  for (const MarginPolicy& p : kMarginPolicies) names.emplace_back(p.name);
  return names;
}

}  // namespace capstan::mechanics
