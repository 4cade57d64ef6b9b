#include "planner/ground/geometry/region.h"

#include <algorithm>
#include <array>
#include <clipper.hpp>
#include <cmath>
#include <cstring>
#include <numbers>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>

#include "planner/ground/base/stopping.h"
#include "planner/ground/geometry/kept_outlines.h"
#include "planner/ground/geometry/offset/raw_offset.h"

namespace capstan::geometry {
namespace {

using ClipperLib::ClipType;
using ClipperLib::IntPoint;
using ClipperLib::Paths;

constexpr double kScale = 1.0 / kRegionGrid;
constexpr int kOffset = -1;  ///< in questions to kept outlines, beside the types of Clipper

ClipperLib::cInt to_grid(double v) {
  if (!(std::abs(v) <= kRegionLimit)) throw std::logic_error("a region's coordinate is out of range");
  return std::llround(v * kScale);
}

ClipperLib::Path to_path(const Loop& loop) {
  ClipperLib::Path path;
  path.reserve(loop.size());
  for (const Vec2 p : loop) path.emplace_back(to_grid(p.x), to_grid(p.y));
  return path;
}

Paths to_paths(const std::vector<Loop>& loops) {
  Paths paths;
  paths.reserve(loops.size());
  for (const Loop& loop : loops) paths.push_back(to_path(loop));
  return paths;
}

Vec2 from_grid(const IntPoint& p) {
  return {static_cast<double>(p.X) * kRegionGrid, static_cast<double>(p.Y) * kRegionGrid};
}

// The starting point of a loop is its lowest, then leftmost: same area, same bytes.
Loop from_path(const ClipperLib::Path& path) {
  Loop loop;
  loop.reserve(path.size());
  for (const IntPoint& p : path) loop.push_back(from_grid(p));
  const auto first = std::min_element(loop.begin(), loop.end(),
                                      [](Vec2 a, Vec2 b) { return a.y != b.y ? a.y < b.y : a.x < b.x; });
  std::rotate(loop.begin(), first, loop.end());
  return loop;
}

Region from_paths(const Paths& paths) {
  Region out;
  for (const auto& path : paths) {
    if (path.size() >= 3) out.loops.push_back(from_path(path));
  }
  std::sort(out.loops.begin(), out.loops.end(), [](const Loop& a, const Loop& b) {
    if (a.front().y != b.front().y) return a.front().y < b.front().y;
    if (a.front().x != b.front().x) return a.front().x < b.front().x;
    return a.size() < b.size();
  });
  return out;
}

/// Moves all points.
void shift(Paths& paths, IntPoint by) {
  for (ClipperLib::Path& path : paths) {
    for (IntPoint& p : path) {
      p.X += by.X;
      p.Y += by.Y;
    }
  }
}

void put(std::string& bytes, const auto& v) { bytes.append(reinterpret_cast<const char*>(&v), sizeof v); }

std::string bytes_of(const Paths& paths) {
  std::string out;
  for (const ClipperLib::Path& path : paths) {
    put(out, path.size());
    for (const IntPoint& p : path) {
      put(out, p.X);
      put(out, p.Y);
    }
  }
  return out;
}

/// Of what `bytes_of` gave.
Paths paths_of(std::string_view bytes) {
  const auto take = [&](auto& v) {
    std::memcpy(&v, bytes.data(), sizeof v);
    bytes.remove_prefix(sizeof v);
  };
  Paths out;
  while (!bytes.empty()) {
    std::size_t n = 0;
    take(n);
    out.emplace_back(n);
    for (IntPoint& p : out.back()) {
      take(p.X);
      take(p.Y);
    }
  }
  return out;
}

/// The first point of all; 0 where there is none.
IntPoint place_of(const Paths& paths) {
  for (const ClipperLib::Path& path : paths)
    if (!path.empty()) return path.front();
  return {};
}

// Clipper rounds to whole numbers by doubles that hold the place, too. Made about a point of its own, an
// outline is the same wherever it lies, and may be taken from what was made elsewhere.
template <class Ask, class Make>
Region made_or_kept(IntPoint place, const Ask& ask, const Make& make) {
  KeptOutlines* const kept = KeptOutlinesScope::innermost();
  Paths solution;
  std::string question, known;
  if (kept != nullptr) ask(question);
  if (kept != nullptr && kept->find(question, known)) {
    solution = paths_of(known);
  } else {
    make(solution);
    if (kept != nullptr) kept->keep(std::move(question), bytes_of(solution));
  }
  shift(solution, place);
  return from_paths(solution);
}

Region combine(ClipType type, const std::vector<Loop>& a, const std::vector<Loop>& b) {
  poll();
  Paths subject = to_paths(a), clip = to_paths(b);
  const IntPoint place = place_of(subject);
  for (Paths* paths : {&subject, &clip}) shift(*paths, {-place.X, -place.Y});
  const auto ask = [&](std::string& question) {
    put(question, static_cast<int>(type));
    put(question, subject.size());
    question += bytes_of(subject) + bytes_of(clip);
  };
  return made_or_kept(place, ask, [&](Paths& solution) {
    ClipperLib::Clipper clipper;
    clipper.AddPaths(subject, ClipperLib::ptSubject, true);
    clipper.AddPaths(clip, ClipperLib::ptClip, true);
    clipper.Execute(type, solution, ClipperLib::pftNonZero, ClipperLib::pftNonZero);
  });
}

Region offset_paths(Paths paths, double delta_mm, ClipperLib::JoinType join, ClipperLib::EndType end,
                    double arc_tolerance_mm) {
  poll();
  const IntPoint place = place_of(paths);
  shift(paths, {-place.X, -place.Y});
  const auto ask = [&](std::string& question) {
    put(question, kOffset);
    for (const int v : {static_cast<int>(join), static_cast<int>(end)}) put(question, v);
    for (const double v : {delta_mm, arc_tolerance_mm}) put(question, v);
    question += bytes_of(paths);
  };
  return made_or_kept(place, ask, [&](Paths& solution) {
    ClipperLib::ClipperOffset clipper(kMitreLimit, arc_tolerance_mm * kScale);
    clipper.AddPaths(paths, join, end);
    clipper.Execute(solution, delta_mm * kScale);
  });
}

/// An outline of so many vertices is offset by its raw outline (offset/raw_offset.h) in steps; below, by
/// Clipper's own joins, whose cost grows with the square.
constexpr std::size_t kManyVertices = 500;
/// Corners in a step that may be led through their vertex; and the least that a step goes, of the whole way.
constexpr std::size_t kMostSpikes = 64;
constexpr double kLeastStep = 0.125;
/// Of the radius that would become a corner: where a step ends before, with vertices that are still apart.
constexpr double kShortOfCorner = 0.9;
/// Of the tolerance: what vertices may say that are dropped where there would be more spikes.
constexpr double kDroppedPart = 0.25;

std::size_t vertices(const Region& a) {
  std::size_t n = 0;
  for (const Loop& loop : a.loops) n += loop.size();
  return n;
}

/// Ring from ring: shrunk or grown by one distance and then by another is by both. Each step goes as far as
/// corners need no spike, about the least radius of a curve, which is no longer one after the next.
Region offset_in_steps(Region a, double delta_mm, double arc_tolerance_mm) {
  const double whole = std::abs(delta_mm) + arc_tolerance_mm;
  const bool outwards = delta_mm > 0.0;
  double droppable_mm = kDroppedPart * arc_tolerance_mm;
  for (double left = whole; left > 0.0 && !a.empty();) {
    poll();
    double step = left;
    if (reach_with_spikes(a, outwards, kMostSpikes) < left) {
      droppable_mm *= 0.5;  // as much as is left for the steps that follow
      for (Loop& loop : a.loops) loop = without_small_corners(loop, outwards, droppable_mm);
      const double reach = kShortOfCorner * reach_with_spikes(a, outwards, kMostSpikes);
      step = std::min(left, std::max(reach, kLeastStep * whole));
    }
    left -= step;
    std::vector<Loop> raw;
    for (const Loop& loop : a.loops)
      raw.push_back(raw_offset(loop, outwards ? step : -step, arc_tolerance_mm * step / whole).loop);
    ClipperLib::Clipper clipper;
    clipper.AddPaths(to_paths(raw), ClipperLib::ptSubject, true);
    Paths solution;
    clipper.Execute(ClipperLib::ctUnion, solution, ClipperLib::pftPositive, ClipperLib::pftPositive);
    a = from_paths(solution);
  }
  return a;
}

int arc_steps(double radius_mm, double sweep_rad, double tolerance_mm) {
  if (radius_mm <= tolerance_mm) return std::max(1, static_cast<int>(std::ceil(std::abs(sweep_rad))));
  const double step = 2.0 * std::acos(1.0 - tolerance_mm / radius_mm);
  return std::max(1, static_cast<int>(std::ceil(std::abs(sweep_rad) / step)));
}

}  // namespace

Region clean(const std::vector<Loop>& loops) { return combine(ClipperLib::ctUnion, loops, {}); }
Region unite(const Region& a, const Region& b) { return combine(ClipperLib::ctUnion, a.loops, b.loops); }
Region intersect(const Region& a, const Region& b) {
  return combine(ClipperLib::ctIntersection, a.loops, b.loops);
}
Region subtract(const Region& a, const Region& b) {
  return combine(ClipperLib::ctDifference, a.loops, b.loops);
}

Region offset(const Region& a, double delta_mm, double arc_tolerance_mm) {
  if (delta_mm == 0.0 || a.empty()) return a;
  if (vertices(a) >= kManyVertices) return offset_in_steps(a, delta_mm, arc_tolerance_mm);
  // Clipper's chords of a rounded corner lie up to the tolerance inside the circle of radius |delta|, that
  // is, too near to the old boundary: offset by that much more, so that no point comes nearer than |delta|.
  const double away = std::copysign(std::abs(delta_mm) + arc_tolerance_mm, delta_mm);
  return offset_paths(to_paths(a.loops), away, ClipperLib::jtRound, ClipperLib::etClosedPolygon,
                      arc_tolerance_mm);
}

Region offset_sharp(const Region& a, double delta_mm) {
  if (delta_mm == 0.0 || a.empty()) return a;
  return offset_paths(to_paths(a.loops), delta_mm, ClipperLib::jtMiter, ClipperLib::etClosedPolygon, 0.001);
}

std::vector<Region> pieces(const Region& a) {
  poll();
  std::vector<Region> out;
  for (const Loop& loop : a.loops) {
    if (signed_area(loop) > 0.0) out.push_back({{loop}});
  }
  std::stable_sort(out.begin(), out.end(), [](const Region& x, const Region& y) {
    return signed_area(x.loops.front()) > signed_area(y.loops.front());
  });
  // A hole belongs to the smallest outer loop that contains it.
  for (const Loop& hole : a.loops) {
    if (signed_area(hole) > 0.0) continue;
    for (auto it = out.rbegin(); it != out.rend(); ++it) {
      const Region outer{{it->loops.front()}};
      if (contains(outer, hole.front())) {
        it->loops.push_back(hole);
        break;
      }
    }
  }
  return out;
}

double signed_area(const Loop& loop) {
  double twice = 0.0;
  for (std::size_t i = 0, n = loop.size(); i < n; ++i) twice += cross(loop[i], loop[(i + 1) % n]);
  return 0.5 * twice;
}

double area(const Region& a) {
  double sum = 0.0;
  for (const Loop& loop : a.loops) sum += signed_area(loop);
  return sum;
}

namespace {

enum class Side { kOutside, kInside, kOn };

/// Even-odd by a ray towards +x, on the grid (Hormann and Agathos, "The point in polygon problem for
/// arbitrary polygons", 2001): the ray crosses an edge that changes the side of its height and has the point
/// on its left when it goes up. Only the corners of edges that reach that height are put on the grid.
Side side_of(const Loop& loop, Vec2 p) {
  if (loop.size() < 3) return Side::kOutside;
  const auto px = to_grid(p.x), py = to_grid(p.y);
  const double over = p.y + 2.0 * kRegionGrid, under = p.y - 2.0 * kRegionGrid;
  bool inside = false;
  Vec2 from = loop.back();
  for (const Vec2 to : loop) {
    const Vec2 a = std::exchange(from, to);
    if ((a.y > over && to.y > over) || (a.y < under && to.y < under)) continue;
    const auto ax = to_grid(a.x), ay = to_grid(a.y), bx = to_grid(to.x), by = to_grid(to.y);
    if (bx == px && by == py) return Side::kOn;
    if (ay == py && by == py && (ax < px) != (bx < px)) return Side::kOn;  // along the ray
    if ((ay < py) == (by < py)) continue;
    const double cross = static_cast<double>(ax - px) * static_cast<double>(by - py) -
                         static_cast<double>(bx - px) * static_cast<double>(ay - py);
    if (cross == 0.0) return Side::kOn;
    if ((cross > 0.0) == (by > ay)) inside = !inside;
  }
  return inside ? Side::kInside : Side::kOutside;
}

}  // namespace

bool contains(const Region& a, Vec2 p) {
  int winding = 0;
  for (const Loop& loop : a.loops) {
    const Side side = side_of(loop, p);
    if (side == Side::kOn) return true;
    if (side == Side::kInside) winding += signed_area(loop) > 0.0 ? 1 : -1;
  }
  return winding > 0;
}

double distance_to_boundary(const Region& a, Vec2 p) {
  double least = 1e300;  // squared
  Vec2 best{1e300, 0.0};
  for (const Loop& loop : a.loops) {
    if (loop.empty()) continue;
    Vec2 s = loop.back();
    for (const Vec2 e : loop) {
      const Vec2 d = e - s;
      const double length2 = dot(d, d);
      const double t = length2 > 0.0 ? std::clamp(dot(p - s, d) / length2, 0.0, 1.0) : 0.0;
      const Vec2 way = p - (s + t * d);
      if (const double d2 = dot(way, way); d2 < least) {
        least = d2;
        best = way;
      }
      s = e;
    }
  }
  return norm(best);
}

double mitred_distance(const Loop& loop, Vec2 p) {
  double best = 1e300;
  const std::size_t n = loop.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 before = loop[(i + n - 1) % n], here = loop[i], next = loop[(i + 1) % n];
    const Vec2 in = here - before, out = next - here;
    const double length2 = dot(out, out);
    if (!(length2 > 0.0)) continue;
    const double t = dot(p - here, out) / length2;
    if (t >= 0.0 && t <= 1.0) {
      best = std::min(best, std::abs(cross(out, p - here)) / std::sqrt(length2));
    } else if (t < 0.0) {
      const double whole = norm(p - here), run = norm(in);
      if (!(run > 0.0)) continue;
      const bool beyond_both = dot(p - here, in) >= 0.0;
      const double sides =
          std::max(std::abs(cross(in, p - here)) / run, std::abs(cross(out, p - here)) / std::sqrt(length2));
      best = std::min(best, beyond_both && sides * kMitreLimit >= whole ? sides : whole);
    }
  }
  return best;
}

double mitred_distance(const Region& a, Vec2 p) {
  double best = 1e300;
  for (const Loop& loop : a.loops) best = std::min(best, mitred_distance(loop, p));
  return best;
}

bool has_sharp_inner_corner(const Region& a) {
  // Chords of 0.5 um turn by less from a radius of 0.1 mm on.
  constexpr double kLeastTurn = 0.25;
  for (const Loop& loop : a.loops) {
    for (std::size_t i = 0, n = loop.size(); i < n; ++i) {
      const Vec2 in = loop[i] - loop[(i + n - 1) % n], out = loop[(i + 1) % n] - loop[i];
      if (std::atan2(cross(in, out), dot(in, out)) < -kLeastTurn) return true;
    }
  }
  return false;
}

Box2 bounds(const Region& a) {
  Box2 box;
  for (const Loop& loop : a.loops) {
    for (const Vec2 p : loop) {
      box.lo = {std::min(box.lo.x, p.x), std::min(box.lo.y, p.y)};
      box.hi = {std::max(box.hi.x, p.x), std::max(box.hi.y, p.y)};
    }
  }
  return box;
}

Region rectangle(Vec2 lo, Vec2 hi) { return {{{lo, {hi.x, lo.y}, hi, {lo.x, hi.y}}}}; }

namespace {

/// Directions of the points of an arc, from its start on. Holes of one size and corners of pockets ask for
/// the same ones by the thousand, and sine and cosine are most of what an arc costs: a thread keeps the last
/// few.
const std::vector<Vec2>& directions(double from_rad, double sweep_rad, int steps) {
  struct Known {
    double from_rad = 0.0, sweep_rad = 0.0;
    std::vector<Vec2> at;
  };
  constexpr std::size_t kKept = 16;  // corners of a few sizes
  constexpr int kMostSteps = 4096;   // more are made in a place of their own
  thread_local std::array<Known, kKept> known;
  thread_local Known long_one;
  thread_local std::size_t next = 0;
  for (const Known& k : known) {
    if (k.from_rad == from_rad && k.sweep_rad == sweep_rad && k.at.size() == static_cast<std::size_t>(steps))
      return k.at;
  }
  Known& made = steps > kMostSteps ? long_one : known[next++ % kKept];
  made = {from_rad, sweep_rad, {}};
  made.at.reserve(static_cast<std::size_t>(steps));
  for (int i = 1; i <= steps; ++i) {
    const double a = from_rad + sweep_rad * i / steps;
    made.at.push_back({std::cos(a), std::sin(a)});
  }
  return made.at;
}

}  // namespace

void append_arc(Loop& out, Vec2 centre, Vec2 start, double sweep_rad, double tolerance_mm) {
  const Vec2 r = start - centre;
  const double radius = norm(r);
  const double a0 = std::atan2(r.y, r.x);
  const int steps = arc_steps(radius, sweep_rad, tolerance_mm);
  // One arc after the other: room for this one alone would move them all each time.
  const std::size_t room = out.size() + static_cast<std::size_t>(steps);
  if (room > out.capacity()) out.reserve(std::max(room, 2 * out.capacity()));
  for (const Vec2 d : directions(a0, sweep_rad, steps))
    out.push_back({centre.x + radius * d.x, centre.y + radius * d.y});
}

Region rounded_rectangle(Vec2 lo, Vec2 hi, double corner_radius_mm, double tolerance_mm) {
  const double r = std::min({corner_radius_mm, 0.5 * (hi.x - lo.x), 0.5 * (hi.y - lo.y)});
  if (!(r > 0.0)) return rectangle(lo, hi);
  constexpr double kQuarter = std::numbers::pi / 2.0;
  Loop loop;
  const auto corner = [&](Vec2 centre, Vec2 start) {
    loop.push_back(start);
    append_arc(loop, centre, start, kQuarter, tolerance_mm);
  };
  corner({hi.x - r, lo.y + r}, {hi.x - r, lo.y});
  corner({hi.x - r, hi.y - r}, {hi.x, hi.y - r});
  corner({lo.x + r, hi.y - r}, {lo.x + r, hi.y});
  corner({lo.x + r, lo.y + r}, {lo.x, lo.y + r});
  return clean({loop});
}

Region disc(Vec2 centre, double radius_mm, double tolerance_mm) {
  Loop loop;
  append_arc(loop, centre, {centre.x + radius_mm, centre.y}, 2.0 * std::numbers::pi, tolerance_mm);
  return {{loop}};
}

Region stroke(const std::vector<Vec2>& line, double half_width_mm, bool round_ends, double arc_tolerance_mm) {
  return offset_paths({to_path(line)}, half_width_mm, ClipperLib::jtRound,
                      round_ends ? ClipperLib::etOpenRound : ClipperLib::etOpenButt, arc_tolerance_mm);
}

}  // namespace capstan::geometry
