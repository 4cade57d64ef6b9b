#include "planner/making/toolpath/region/area/cutting_part.h"

#include <cmath>
#include <vector>

#include "planner/ground/base/stopping.h"
#include "planner/making/toolpath/region/area/work_area.h"

namespace capstan::toolpath {

using geometry::Region;

namespace {

constexpr double kPiece = 0.25;    // of the cover
constexpr double kNothing = 1e-6;  // mm2 that count as no contact: rounding of the polygons
constexpr double kWhole = 0.9;     // of the track; default, unsourced
constexpr int kMostPieces = 400;

struct Stretch {
  int first = 0, count = 0;
  Region left;
};

/// What is taken of `uncut` from the piece `start` on, once round.
Stretch taken_from(int start, const std::vector<Region>& swept, const Region& uncut) {
  const int n = static_cast<int>(swept.size());
  Stretch out{.first = start, .count = 0, .left = uncut};
  double area = geometry::area(uncut);
  for (int j = 0; j < n && area > kNothing; ++j) {
    poll();
    Region next = geometry::subtract(out.left, swept[static_cast<std::size_t>((start + j) % n)]);
    const double less = geometry::area(next);
    if (area - less <= kNothing) continue;
    if (out.count == 0) out.first = start + j;
    out.count = start + j + 1 - out.first;
    out.left = std::move(next);
    area = less;
  }
  return out;
}

}  // namespace

Track cutting_part(const Track& track, Region& uncut, double cover_mm, Begun begun) {
  const double length = length_of(track);
  const double pieces = std::ceil(length / (kPiece * cover_mm));
  if (!track.closed || !(pieces <= kMostPieces)) return track;
  const int n = static_cast<int>(pieces);
  if (n < 1) return track;
  std::vector<Region> swept;
  for (int i = 0; i < n; ++i) {
    const Track piece = part_of(track, length * i / n, length * (i + 1) / n);
    swept.push_back(geometry::stroke(points_of(piece, kInnerChord), cover_mm, true, kInnerChord));
  }
  Stretch best = taken_from(0, swept, uncut);
  if (begun == Begun::kAtStart && best.count > 0) {
    best.count += best.first;
    best.first = 0;
  }
  for (int k = 1; begun == Begun::kAnywhere && k < kPartStarts; ++k) {
    Stretch s = taken_from(n * k / kPartStarts, swept, uncut);
    if (s.count < best.count) best = std::move(s);
  }
  uncut = std::move(best.left);
  if (best.count == 0) return {.start = track.start, .segments = {}, .closed = false};
  if (best.count > kWhole * n) return track;
  const Track turned = begun_at(track, at_length(track, length * (best.first % n) / n));
  return part_of(turned, 0.0, length * best.count / n);
}

}  // namespace capstan::toolpath
