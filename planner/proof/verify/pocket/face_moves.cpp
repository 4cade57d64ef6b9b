#include <algorithm>
#include <cmath>

#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/program/block_state.h"

// A face cycle made into moves: strokes that cover the rectangle. The control's own may lie elsewhere within
// it and over its edges; face_step.cpp holds what is around.

namespace capstan::verify {

using geometry::Vec2;
using model::MoveKind;

namespace {

constexpr double kNothing = 1e-9;

}  // namespace

void BlockState::mill(FacedArea f) {
  f.line = line_;
  const auto wrong = [&](const std::string& why) { fault(26, "CHK-CYCLE", "the face cycle: " + why); };
  f.cutter_mm = called_diameter_mm();
  if (!(f.cutter_mm > 0.0))
    return fault(
        33, "CHK-UNVERIFIABLE",
        "the face cycle's path hangs on the tool's diameter, which the program's header does not say", true);
  const Vec2 size = f.hi - f.lo;
  if (!(size.x > 0.0) || !(size.y > 0.0)) return wrong("its rectangle has no size");
  const double depth = f.reference_z - f.floor_z - f.bottom_mm;
  if (!(depth > 0.0) || !(f.level_mm > 0.0)) return wrong("it has no depth, or its levels have none");
  if (f.start_z < f.reference_z || f.back_z < f.start_z)
    return wrong("its planes are not one above the other");
  if (!(f.feed_mm_min > 0.0)) return wrong("it has no feed");
  if (!(f.over_mm > 0.0)) return wrong("its strokes have no distance");
  if (f.out_mm < 0.0 || f.beyond_mm < 0.0) return wrong("it ends within its rectangle");
  if (!known_[0] || !known_[1] || !known_[2]) return wrong("it begins where the position is not known");
  if (at_.z < f.back_z - kNothing) return wrong("it is called below its return plane");
  const double radius = 0.5 * f.cutter_mm;
  const double wide = (f.along_y ? size.x : size.y) + 2.0 * f.beyond_mm - f.cutter_mm;
  if (wide < -kNothing)
    return wrong("the tool of diameter " + mm(f.cutter_mm) +
                 " is wider than the rectangle with what it goes over it: " +
                 "where the control leads it no parameter says");
  const double levels = std::max(1.0, std::ceil(depth / f.level_mm - 1e-6));
  const double strokes = std::max(0.0, std::ceil(wide / f.over_mm - 1e-6)) + 1.0;
  if (levels * strokes > 1.0 * kCycleBlockCap)
    return wrong("it has too many levels or strokes to be followed");

  const std::size_t first = out_.blocks.size();
  const double feed = feed_;
  // `along` the strokes and across, from the lower corner.
  const auto at = [&](double along, double across) {
    return f.along_y ? Vec2{f.lo.x + across, f.lo.y + along} : Vec2{f.lo.x + along, f.lo.y + across};
  };
  const double out = radius + f.out_mm, length = f.along_y ? size.y : size.x;
  stated_ |= kStatedFeed;
  for (double k = 1.0; k <= levels && cycle_blocks_ <= kCycleBlockCap; k += 1.0) {
    const double z = f.reference_z - depth * k / levels;
    bool forth = true;
    for (double n = 0.0; n < strokes && cycle_blocks_ <= kCycleBlockCap; n += 1.0) {
      const double across = radius - f.beyond_mm + (strokes > 1.0 ? wide * n / (strokes - 1.0) : 0.0);
      const Vec2 from = at(forth ? -out : length + out, across),
                 to_end = at(forth ? length + out : -out, across);
      if (n == 0.0) {
        to({at_.x, at_.y, f.back_z}, MoveKind::kRapid);
        to({from.x, from.y, f.back_z}, MoveKind::kRapid);
        to({from.x, from.y, f.start_z}, MoveKind::kRapid);
        feed_ = f.feed_mm_min;
        to({from.x, from.y, z}, MoveKind::kLine);
      }
      to({from.x, from.y, z}, MoveKind::kLine);
      to({to_end.x, to_end.y, z}, MoveKind::kLine);
      forth = !forth;
    }
  }
  to({at_.x, at_.y, f.back_z}, MoveKind::kRapid);
  feed_ = feed;
  const int number = static_cast<int>(out_.faces.size());
  for (std::size_t i = first; i < out_.blocks.size(); ++i) out_.blocks[i].face = number;
  out_.faces.push_back(f);
}

}  // namespace capstan::verify
