#include "planner/proof/verify/sweep/tool_body.h"

#include <algorithm>

#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/findings.h"

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

namespace {

double wide(const model::HolderSegment& s) { return std::max(s.lower_diameter_mm, s.upper_diameter_mm); }
bool stated(const model::HolderSegment& s) { return s.height_mm > 0.0 && wide(s) > 0.0; }
bool by_segments(const model::Cutter& c) { return std::any_of(c.holder.begin(), c.holder.end(), stated); }

struct Lengths {
  double flutes = 0.0, thick = 0.0, out = 0.0;  ///< ends of the flutes, the neck and the shank, above the tip
};
Lengths lengths_of(const model::Cutter& c) {
  Lengths l;
  const bool neck = c.neck_length_mm > 0.0 && c.neck_diameter_mm > 0.0;
  const double slender = neck ? c.neck_length_mm : c.usable_length_mm;
  l.out = c.stick_out_mm > 0.0 ? c.stick_out_mm
                               : std::max(c.maximum_depth_of_cut_mm, std::max(slender, 0.0)) + kSpindleMm;
  l.flutes = c.maximum_depth_of_cut_mm > 0.0 ? std::min(c.maximum_depth_of_cut_mm, l.out) : l.out;
  l.thick = std::clamp(slender, l.flutes, l.out);
  return l;
}

}  // namespace

std::string not_described(const model::Cutter& c) {
  std::string out;
  if (!(c.stick_out_mm > 0.0)) {
    out =
        "its stick-out is not stated: its holder is not judged, and what is above its flutes is taken as "
        "going on for " +
        mm(kSpindleMm);
  } else if (!by_segments(c) && !(c.holder_diameter_mm > 0.0)) {
    out = "its holder is not described: not judged";
  }
  const Lengths l = lengths_of(c);
  if (l.out > l.thick && !(c.shank_diameter_mm > 0.0))
    out += (out.empty() ? "" : "; ") +
           ("its shank is not described: taken as thick as its cutter, " + mm(c.cutting_diameter_mm));
  return out;
}

std::vector<BodyPart> body_of(const model::Cutter& c) {
  using What = BodyPart::What;
  const double r = std::max(outline_of(c).radius_mm, 0.5 * c.cutting_diameter_mm);
  const double shank = c.shank_diameter_mm > 0.0 ? 0.5 * c.shank_diameter_mm : r;
  const Lengths l = lengths_of(c);
  std::vector<BodyPart> out;
  out.push_back({What::kCutter, 0.0, l.flutes, r});
  // A neck or the usable length says where the shank begins to be thick.
  const bool neck = c.neck_length_mm > 0.0 && c.neck_diameter_mm > 0.0;
  out.push_back({What::kShank, l.flutes, l.thick, neck ? 0.5 * c.neck_diameter_mm : std::min(r, shank)});
  out.push_back({What::kShank, l.thick, l.out, shank});
  if (c.stick_out_mm > 0.0) {
    double at = l.out;
    for (const model::HolderSegment& s : c.holder) {
      if (!stated(s)) continue;
      out.push_back({What::kHolder, at, at + s.height_mm, 0.5 * wide(s)});
      at += s.height_mm;
    }
    if (by_segments(c)) {
      out.back().to_mm += kSpindleMm;
    } else {
      out.push_back({What::kHolder, at, at + kSpindleMm, 0.5 * c.holder_diameter_mm});
    }
  }
  std::erase_if(out, [](const BodyPart& p) { return !(p.radius_mm > 0.0) || !(p.to_mm > p.from_mm); });
  return out;
}

}  // namespace capstan::verify
