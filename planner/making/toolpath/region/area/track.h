#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "planner/ground/geometry/region.h"
#include "planner/ground/geometry/vec.h"

namespace capstan::toolpath {

enum class Bend : std::uint8_t { kStraight, kCw, kCcw };

/// One piece of a plane track, from the end of the piece before.
struct Segment {
  geometry::Vec2 to;
  geometry::Vec2 centre;  ///< of an arc
  Bend bend = Bend::kStraight;
};

/// A plane curve of lines and arcs, mm. A closed track ends where it starts.
struct Track {
  geometry::Vec2 start;
  std::vector<Segment> segments;
  bool closed = false;
  [[nodiscard]] geometry::Vec2 end() const { return segments.empty() ? start : segments.back().to; }
};

/// An arc of a smaller radius, or whose ends are nearer, is a line to a control, mm: programs have three
/// decimals, and rounded apart its ends and its centre say anything.
inline constexpr double kSmallestArc = 0.002;

/// Vertices of an offset polygon may lie this far from the arc that replaces them, and the arc twice
/// as far from their chords, mm.
inline constexpr double kFitTolerance = 0.001;

/// The loop without vertices that say nothing: no dropped one lies farther than the tolerance from the new
/// line. Cost: linear.
[[nodiscard]] geometry::Loop simplified(const geometry::Loop& loop, double tolerance_mm);
[[nodiscard]] geometry::Region simplified(const geometry::Region& region, double tolerance_mm);

/// The loop as lines and arcs: three chords or more that turn the same way on one circle become an arc of
/// little more than half a turn at most.
[[nodiscard]] Track track_of(const geometry::Loop& loop, double tolerance_mm = kFitTolerance);
/// As above, of an open line.
[[nodiscard]] Track track_of_line(const std::vector<geometry::Vec2>& line,
                                  double tolerance_mm = kFitTolerance);

[[nodiscard]] double length_of(geometry::Vec2 from, const Segment& s);
[[nodiscard]] double length_of(const Track& t);
/// The point at fraction t of a segment.
[[nodiscard]] geometry::Vec2 point_at(geometry::Vec2 from, const Segment& s, double t);
/// Unit direction of travel at fraction t.
[[nodiscard]] geometry::Vec2 direction_at(geometry::Vec2 from, const Segment& s, double t);
[[nodiscard]] Track reversed(const Track& t);
/// A quarter turn to the left.
[[nodiscard]] inline geometry::Vec2 left_of(geometry::Vec2 d) { return {-d.y, d.x}; }

struct Spot {
  std::size_t segment = 0;
  double t = 0.0;  ///< fraction of that segment
  geometry::Vec2 point;
  double distance_mm = 1e300;
};
[[nodiscard]] Spot nearest(const Track& t, geometry::Vec2 p);
/// The spot at a given length from the start.
[[nodiscard]] Spot at_length(const Track& t, double s_mm);
/// Unit direction of travel at a spot of the track.
[[nodiscard]] geometry::Vec2 direction_at(const Track& t, const Spot& s);
/// A closed track that begins (and ends) at the spot.
[[nodiscard]] Track begun_at(const Track& t, const Spot& s);
/// The part between two lengths from the start, 0 <= from <= to <= length.
[[nodiscard]] Track part_of(const Track& t, double from_mm, double to_mm);
/// Points along the track, both ends included, chords within the tolerance.
[[nodiscard]] std::vector<geometry::Vec2> points_of(const Track& t, double tolerance_mm);

}  // namespace capstan::toolpath
