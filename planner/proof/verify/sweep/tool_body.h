#pragma once

#include <string>
#include <vector>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::verify {

/// A cylinder of a tool in its holder; heights from the tip.
struct BodyPart {
  enum class What : unsigned char { kCutter, kShank, kHolder };
  What what = What::kCutter;
  double from_mm = 0.0, to_mm = 0.0, radius_mm = 0.0;
};
[[nodiscard]] const char* to_text(BodyPart::What what);

/// What is known of the tool, from its tip up: flutes as a full cylinder, shank, holder by its segments (each
/// as thick as its thicker end), else by its largest diameter above the stick-out. A shank that is not
/// described is taken as thick as the cutter, and a tool of unknown stick-out goes on for kSpindleMm; both
/// are defaults, unsourced. A holder that is not described is left out.
[[nodiscard]] std::vector<BodyPart> body_of(const model::Cutter& c);

/// What of a tool is not described, and what is taken instead; empty when all is.
[[nodiscard]] std::string not_described(const model::Cutter& c);

/// Above the holder there is the spindle; its nose is not known, so that the last part goes on this far, mm.
inline constexpr double kSpindleMm = 300.0;

}  // namespace capstan::verify
