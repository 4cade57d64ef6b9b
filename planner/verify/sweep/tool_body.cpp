#include "planner/verify/sweep/tool_body.h"

#include <algorithm>

namespace capstan::verify {

const char* to_text(BodyPart::What what) {
  switch (what) {
    case BodyPart::What::kCutter:
      return "the cutter";
    case BodyPart::What::kShank:
      return "the shank";
    case BodyPart::What::kHolder:
      return "the holder";
  }
  return "";
}

std::vector<BodyPart> body_of(const model::Cutter& c) {
  using What = BodyPart::What;
  std::vector<BodyPart> out;
  const double r = std::max(model::profile_of(c).radius_mm, 0.5 * c.cutting_diameter_mm);
  const double out_mm = c.stick_out_mm;
  double flutes = c.maximum_depth_of_cut_mm > 0.0 ? c.maximum_depth_of_cut_mm : out_mm;
  if (out_mm > 0.0) flutes = std::min(flutes, out_mm);
  out.push_back({What::kCutter, 0.0, flutes, r});
  if (!(out_mm > 0.0)) return out;
  // A neck or the usable length says where the shank begins to be thick.
  double thick = flutes;
  if (c.neck_length_mm > 0.0 && c.neck_diameter_mm > 0.0) {
    thick = std::clamp(c.neck_length_mm, flutes, out_mm);
    out.push_back({What::kShank, flutes, thick, 0.5 * c.neck_diameter_mm});
  } else if (c.usable_length_mm > flutes) {
    thick = std::min(c.usable_length_mm, out_mm);
    out.push_back({What::kShank, flutes, thick, std::min(r, 0.5 * c.shank_diameter_mm)});
  }
  if (c.shank_diameter_mm > 0.0 && thick < out_mm)
    out.push_back({What::kShank, thick, out_mm, 0.5 * c.shank_diameter_mm});
  double at = out_mm;
  for (const model::HolderSegment& s : c.holder) {
    const double wide = std::max(s.lower_diameter_mm, s.upper_diameter_mm);
    out.push_back({What::kHolder, at, at + s.height_mm, 0.5 * wide});
    at += s.height_mm;
  }
  if (c.holder.empty() && c.holder_diameter_mm > 0.0) {
    out.push_back({What::kHolder, at, at + kSpindleMm, 0.5 * c.holder_diameter_mm});
  } else if (!c.holder.empty()) {
    out.back().to_mm += kSpindleMm;
  }
  std::erase_if(out, [](const BodyPart& p) { return !(p.radius_mm > 0.0) || !(p.to_mm > p.from_mm); });
  return out;
}

}  // namespace capstan::verify
