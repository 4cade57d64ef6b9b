#pragma once

#include <span>
#include <string>

#include "casebase/tune/advise.h"

namespace capstan::casebase::tune {

/// An advice as a picture (SVG 1.1, no scripts, no external fonts): beside each other what speed and what
/// feed do to the time and to each load over its limit, with the values that 95 of 100 parts stay below, the
/// handbook's setting, the proven one and the trial.
[[nodiscard]] std::string picture_of(const std::string& title, const Advice& advice,
                                     std::span<const LinePoint> by_speed, std::span<const LinePoint> by_feed);

}  // namespace capstan::casebase::tune
