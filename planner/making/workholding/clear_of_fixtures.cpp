#include "planner/making/workholding/clear_of_fixtures.h"

#include <algorithm>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/ground/geometry/moved.h"
#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::workholding {
namespace {

using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using model::FixtureSolid;
using model::MoveKind;

constexpr double kSlack = 0.005;       // mm: chords of paths and of the regions they keep out of
constexpr double kSpindle = 300.0;     // mm above the holder that count as holder, too
constexpr double kChord = 0.002;       // mm, of arcs
constexpr double kNoArea = 0.01;       // mm2
constexpr double kRise = 0.5;          // mm of height that one piece of a slope spans at most, up to ...
constexpr int kMostPieces = 64;        // ... so many; longer pieces are taken with all their heights
constexpr double kUsualCutter = 20.0;  // mm: overrun of a step whose cutter is not known yet; unsourced

struct Cylinder {
  const char* what;
  double from, to, radius;
};

/// A shank whose diameter is not stated is taken as thick as the cutter; a tool whose stick-out is not stated
/// goes on as it is. A holder that is not described has no cylinder: the checks of the plan say so.
std::vector<Cylinder> cylinders(const model::Cutter& c) {
  const double r = std::max(0.5 * c.cutting_diameter_mm, model::profile_of(c).radius_mm);
  const bool placed = c.stick_out_mm > 0.0;
  const double out =
      placed ? c.stick_out_mm
             : kSpindle + std::max({c.maximum_depth_of_cut_mm, c.neck_length_mm, c.usable_length_mm});
  const double flutes = c.maximum_depth_of_cut_mm > 0.0 ? std::min(out, c.maximum_depth_of_cut_mm) : out;
  const double shank = c.shank_diameter_mm > 0.0 ? 0.5 * c.shank_diameter_mm : r;
  std::vector<Cylinder> all = {{"the cutter", 0.0, flutes, r}};
  const double thick =
      std::clamp(c.neck_length_mm > 0.0 ? c.neck_length_mm : c.usable_length_mm, flutes, out);
  const double neck = c.neck_diameter_mm > 0.0 ? 0.5 * c.neck_diameter_mm : std::min(r, shank);
  if (thick > flutes && neck > 0.0) all.push_back({"the shank", flutes, thick, neck});
  if (out > thick) all.push_back({"the shank", thick, out, shank});
  if (!placed) return all;
  double at = out;
  const std::size_t below = all.size();
  for (const auto& s : c.holder) {
    if (!(s.height_mm > 0.0) || !(std::max(s.lower_diameter_mm, s.upper_diameter_mm) > 0.0)) continue;
    all.push_back(
        {"the holder", at, at + s.height_mm, 0.5 * std::max(s.lower_diameter_mm, s.upper_diameter_mm)});
    at += s.height_mm;
  }
  if (all.size() > below) {
    all.back().to += kSpindle;
  } else if (c.holder_diameter_mm > 0.0) {
    all.push_back({"the holder", out, out + kSpindle, 0.5 * c.holder_diameter_mm});
  }
  return all;
}

/// The corner points that one move passes in XY, in an order whose hull holds the move.
std::vector<Vec2> track(const model::CutterPath& p, std::size_t i) {
  const Vec2 a = xy(p.point(i - 1)), b = xy(p.point(i));
  if (p.kind[i] == MoveKind::kRapid) return {a, {b.x, a.y}, b, {a.x, b.y}};
  std::vector<Vec2> out = {a};
  if (p.kind[i] == MoveKind::kArcCw || p.kind[i] == MoveKind::kArcCcw) {
    const Vec2 centre{p.cx[i], p.cy[i]};
    const double a0 = std::atan2(a.y - centre.y, a.x - centre.x);
    double turn = std::atan2(b.y - centre.y, b.x - centre.x) - a0;
    const bool ccw = p.kind[i] == MoveKind::kArcCcw;
    while (ccw && turn <= 1e-9) turn += kRadPerTurn;
    while (!ccw && turn >= -1e-9) turn -= kRadPerTurn;
    geometry::append_arc(out, centre, a, turn, kChord);
    return out;
  }
  out.push_back(b);
  return out;
}

/// A piece of a move: where its axis may be, and between which heights its tip.
struct Leg {
  std::vector<Vec2> line;
  double low, high;
};

/// Axes of a rapid need not arrive together, so that it may be anywhere in its box at any of its heights.
std::vector<Leg> legs(const model::CutterPath& p, std::size_t i) {
  std::vector<Vec2> line = track(p, i);
  const double z0 = p.z[i - 1], z1 = p.z[i];
  const double rise = std::abs(z1 - z0);
  const bool upright = line.size() == 2 && norm(line[1] - line[0]) < 1e-9;
  if (p.kind[i] == MoveKind::kRapid || upright || rise < 1e-9)
    return {{std::move(line), std::min(z0, z1), std::max(z0, z1)}};
  if (p.kind[i] == MoveKind::kLine) {
    const Vec2 a = line[0], d = line[1] - line[0];
    const int n = std::clamp(static_cast<int>(std::ceil(rise / kRise)), 1, kMostPieces);
    line.clear();
    for (int k = 0; k <= n; ++k) line.push_back(a + (static_cast<double>(k) / n) * d);
  }
  std::vector<Leg> out;
  const auto n = static_cast<double>(line.size() - 1);
  for (std::size_t k = 1; k < line.size(); ++k) {
    const double za = z0 + (z1 - z0) * static_cast<double>(k - 1) / n;
    const double zb = z0 + (z1 - z0) * static_cast<double>(k) / n;
    out.push_back({{line[k - 1], line[k]}, std::min(za, zb), std::max(za, zb)});
  }
  return out;
}

double segments_apart(Vec2 a, Vec2 b, Vec2 c, Vec2 d) {
  const auto point = [](Vec2 p, Vec2 q, Vec2 r) {
    const Vec2 v = r - q;
    const double n = dot(v, v);
    const double t = n > 0.0 ? std::clamp(dot(p - q, v) / n, 0.0, 1.0) : 0.0;
    return norm(p - (q + t * v));
  };
  const double abc = cross(b - a, c - a), abd = cross(b - a, d - a);
  const double cda = cross(d - c, a - c), cdb = cross(d - c, b - c);
  if (abc * abd < 0.0 && cda * cdb < 0.0) return 0.0;
  return std::min(std::min(point(a, c, d), point(b, c, d)), std::min(point(c, a, b), point(d, a, b)));
}

/// Distance of a track's axis from a solid's outline; 0 over it.
double apart(const std::vector<Vec2>& line, bool closed, const FixtureSolid& s, const Region& area) {
  if (contains(area, line.front())) return 0.0;
  if (closed && line.size() > 2) {
    const auto b = geometry::bounds(Region{{line}});
    const Vec2 p = s.outline.front();
    if (p.x >= b.lo.x && p.x <= b.hi.x && p.y >= b.lo.y && p.y <= b.hi.y) return 0.0;
  }
  double best = 1e300;
  const std::size_t n = closed ? line.size() : line.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < s.outline.size(); ++k) {
      best = std::min(best, segments_apart(line[i], line[(i + 1) % line.size()], s.outline[k],
                                           s.outline[(k + 1) % s.outline.size()]));
    }
  }
  return best;
}

std::string place_text(Vec3 p) {
  return "(" + trimmed(p.x, 2) + ", " + trimmed(p.y, 2) + ", " + trimmed(p.z, 2) + ")";
}

std::string touch_text(const model::CutterPath& path, std::size_t i, const char* what, double gap,
                       const FixtureSolid& s, const model::Workholding& h) {
  const std::string move = "move " + std::to_string(i) +
                           (path.kind[i] == MoveKind::kRapid ? " (rapid)" : "") + " from " +
                           place_text(path.point(i - 1)) + " to " + place_text(path.point(i));
  if (gap < 0.0) return move + ": " + what + " would enter '" + s.id + "' by " + trimmed(-gap, 2) + " mm";
  return move + ": " + what + " would pass " + trimmed(gap, 2) + " mm from '" + s.id + "', less than " +
         trimmed(h.clearance_mm, 2) + " mm";
}

Region region_of(const FixtureSolid& s) { return {{s.outline}}; }

/// The area that a tool whose tip goes down to `low` must not enter.
Region keep_out(const model::Workholding& h, double low) {
  Region out;
  for (const FixtureSolid& s : h.solids) {
    if (s.top_mm + h.clearance_mm <= low) continue;
    out = geometry::unite(out, geometry::offset(region_of(s), h.clearance_mm + 2.0 * kSlack));
  }
  return out;
}

}  // namespace

std::optional<NearMove> near_move_of(const model::CutterPath& path, const model::Cutter& cutter,
                                     const model::Workholding& h) {
  std::optional<NearMove> out;
  double worst = h.clearance_mm - kSlack;
  const auto tool = cylinders(cutter);
  double widest = 0.0;
  for (const Cylinder& c : tool) widest = std::max(widest, c.radius);
  for (const FixtureSolid& s : h.solids) {
    if (s.outline.size() < 3) continue;
    const Region area = region_of(s);
    const auto around = geometry::bounds(area);
    for (std::size_t i = 1; i < path.size(); ++i) {
      if (path.kind[i] == MoveKind::kDwell) continue;
      const double low = std::min(path.z[i - 1], path.z[i]);
      if (low - s.top_mm >= worst) continue;
      const auto line = track(path, i);
      const auto b = geometry::bounds(Region{{line}});
      const double reach = widest + h.clearance_mm;
      if (b.lo.x - reach > around.hi.x || b.hi.x + reach < around.lo.x || b.lo.y - reach > around.hi.y ||
          b.hi.y + reach < around.lo.y) {
        continue;
      }
      for (const Leg& leg : legs(path, i)) {
        const double flat = apart(leg.line, path.kind[i] == MoveKind::kRapid, s, area);
        for (const Cylinder& c : tool) {
          // Between the tip's lowest and highest place the cylinder is everywhere.
          const double gap =
              std::max({flat - c.radius, leg.low + c.from - s.top_mm, s.bottom_mm - leg.high - c.to});
          if (gap >= worst) continue;
          worst = gap;
          out = NearMove{i, touch_text(path, i, c.what, gap, s, h)};
        }
      }
    }
  }
  return out;
}

Result<toolpath::GeneratedPath> kept_clear(
    const draft::SetupDraft& setup, const model::Cutter& cutter, const toolpath::PathJob& job,
    const std::function<Result<toolpath::GeneratedPath>(const toolpath::PathJob&)>& make) {
  auto path = make(job);
  const model::Workholding& h = setup.holding;
  if (!path || h.solids.empty()) return path;
  const auto touch = near_move_of(path->path, cutter, h);
  if (!touch) return path;
  // Links higher than all that holds, then around it.
  toolpath::PathJob other = job;
  double top = -1e300;
  for (const FixtureSolid& s : h.solids) top = std::max(top, s.top_mm + h.clearance_mm);
  if (top > job.retract_z_mm) {
    other.retract_z_mm = std::min(job.security_z_mm, top);
    auto higher = make(other);
    if (higher && !near_move_of(higher->path, cutter, h)) return higher;
  }
  double low = job.feature_in_setup.origin.z - job.shape.depth_mm - job.break_through_mm;
  // Around a solid all goes, down to the underside of the raw piece.
  if (job.shape.kind == model::ShapeKind::kFreeform) low = std::min(low, setup.stock.lo.z);
  other.avoid = geometry::unite(job.avoid, keep_out(h, low));
  const Region cut = geometry::intersect(geometry::moved(job.shape.area, job.feature_in_setup), job.stock);
  std::string why;
  for (const FixtureSolid& s : h.solids) {
    if (s.top_mm + h.clearance_mm <= low) continue;
    const double under = geometry::area(geometry::intersect(
        cut, geometry::offset(region_of(s), std::max(0.0, h.clearance_mm - 2.0 * kSlack))));
    if (under > kNoArea && why.empty())
      why = "; around it " + trimmed(under, 1) + " mm2 of the feature would stay uncut under or beside '" +
            s.id + "'";
  }
  if (why.empty()) {
    auto around = make(other);
    const auto still = around ? near_move_of(around->path, cutter, h) : std::nullopt;
    if (around && !still) return around;
    why = around ? "; around it, " + still->text : "; around it there is no path: " + around.error().message;
  }
  return fail("PIP-HOLDING", touch->text + why);
}

std::vector<Footprint> footprints(const draft::SetupDraft& setup, std::size_t at,
                                  const std::vector<draft::StepDraft>& steps) {
  std::vector<Footprint> out;
  for (const draft::StepDraft& s : steps) {
    if (s.setup != at) continue;
    const double d = s.cutter.cutting_diameter_mm > 0.0 ? s.cutter.cutting_diameter_mm : kUsualCutter;
    for (const auto& shape : s.shapes) {
      const auto frame = compose(setup.workpiece, shape.frame);
      Footprint f;
      const bool over = shape.open || model::has(shape.kind, model::ShapeTrait::kBeyond);
      f.area = geometry::moved(shape.area, frame);
      if (over) {
        const auto& box = setup.stock;
        f.area = geometry::intersect(f.area, geometry::rectangle(xy(box.lo), xy(box.hi)));
        f.area = geometry::offset(f.area, d);
      }
      f.low_mm = frame.origin.z - shape.depth_mm - (shape.through ? 1.0 + model::tip_length(s.cutter) : 0.0);
      if (!f.area.empty()) out.push_back(std::move(f));
    }
  }
  return out;
}

const model::FixtureSolid* in_the_way(const model::Workholding& h, const std::vector<Footprint>& cuts) {
  for (const FixtureSolid& s : h.solids) {
    const Region near = geometry::offset(region_of(s), h.clearance_mm);
    for (const Footprint& f : cuts) {
      if (f.low_mm >= s.top_mm + h.clearance_mm) continue;
      if (geometry::area(geometry::intersect(near, f.area)) > kNoArea) return &s;
    }
  }
  return nullptr;
}

}  // namespace capstan::workholding
