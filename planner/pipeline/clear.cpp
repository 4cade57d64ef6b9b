#include <algorithm>
#include <cmath>

#include "planner/base/number.h"
#include "planner/pipeline/holding.h"

// Paths against the solids that hold the piece.

namespace capstan::pipeline {
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
constexpr double kUsualCutter = 20.0;  // mm: overrun of a step whose cutter is not known yet; unsourced

struct Cylinder {
  const char* what;
  double from, to, radius;
};

std::vector<Cylinder> cylinders(const model::Cutter& c) {
  const double r = std::max(0.5 * c.cutting_diameter_mm, model::profile_of(c).radius_mm);
  const double out = c.stick_out_mm > 0.0 ? c.stick_out_mm : std::max(c.maximum_depth_of_cut_mm, 1.0);
  const double flutes = c.maximum_depth_of_cut_mm > 0.0 ? std::min(out, c.maximum_depth_of_cut_mm) : out;
  std::vector<Cylinder> all = {{"the cutter", 0.0, flutes, r}};
  const double thick =
      std::clamp(c.neck_length_mm > 0.0 ? c.neck_length_mm : c.usable_length_mm, flutes, out);
  const double neck =
      c.neck_diameter_mm > 0.0 ? 0.5 * c.neck_diameter_mm : std::min(r, 0.5 * c.shank_diameter_mm);
  if (thick > flutes && neck > 0.0) all.push_back({"the shank", flutes, thick, neck});
  if (out > thick && c.shank_diameter_mm > 0.0)
    all.push_back({"the shank", thick, out, 0.5 * c.shank_diameter_mm});
  if (!(c.stick_out_mm > 0.0)) return all;
  double at = out;
  for (const auto& s : c.holder) {
    all.push_back(
        {"the holder", at, at + s.height_mm, 0.5 * std::max(s.lower_diameter_mm, s.upper_diameter_mm)});
    at += s.height_mm;
  }
  if (!c.holder.empty()) {
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
    constexpr double kTurn = 6.283185307179586;
    const bool ccw = p.kind[i] == MoveKind::kArcCcw;
    while (ccw && turn <= 1e-9) turn += kTurn;
    while (!ccw && turn >= -1e-9) turn -= kTurn;
    geometry::append_arc(out, centre, a, turn, kChord);
    return out;
  }
  out.push_back(b);
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

Region region_of(const FixtureSolid& s) { return {{s.outline}}; }

/// What must not be entered by any tool whose tip goes down to `low`.
Region keep_out(const model::Workholding& h, double low) {
  Region out;
  for (const FixtureSolid& s : h.solids) {
    if (s.top_mm + h.clearance_mm <= low) continue;
    out = geometry::unite(out, geometry::offset(region_of(s), h.clearance_mm + 2.0 * kSlack));
  }
  return out;
}

Region in_setup(const Region& r, const geometry::Placement& frame) {
  Region out = r;
  for (auto& loop : out.loops) {
    for (Vec2& p : loop) p = xy(frame.to_parent({p.x, p.y, 0.0}));
    if (frame.z.z < 0.0) std::reverse(loop.begin(), loop.end());
  }
  return out;
}

}  // namespace

std::optional<Touch> touch_of(const model::CutterPath& path, const model::Cutter& cutter,
                              const model::Workholding& h) {
  std::optional<Touch> out;
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
      const double flat = apart(line, path.kind[i] == MoveKind::kRapid, s, area);
      for (const Cylinder& c : tool) {
        const double gap = std::max({flat - c.radius, low + c.from - s.top_mm, s.bottom_mm - low - c.to});
        if (gap >= worst) continue;
        worst = gap;
        out = Touch{i, "move " + std::to_string(i) + (path.kind[i] == MoveKind::kRapid ? " (rapid)" : "") +
                           " to " + place_text(path.point(i)) + ": " + c.what +
                           (gap < 0.0 ? " would enter '" + s.id + "' by " + trimmed(-gap, 2) + " mm"
                                      : " would pass " + trimmed(gap, 2) + " mm from '" + s.id +
                                            "', less than " + trimmed(h.clearance_mm, 2) + " mm")};
      }
    }
  }
  return out;
}

Result<toolpath::GeneratedPath> kept_clear(
    const Work& w, const StepWork& step, const toolpath::PathJob& job,
    const std::function<Result<toolpath::GeneratedPath>(const toolpath::PathJob&)>& make) {
  auto path = make(job);
  const model::Workholding& h = w.setups[step.setup].holding;
  if (!path || h.solids.empty()) return path;
  const auto touch = touch_of(path->path, step.cutter, h);
  if (!touch) return path;
  // Links higher than all that holds, then around it.
  toolpath::PathJob other = job;
  double top = -1e300;
  for (const FixtureSolid& s : h.solids) top = std::max(top, s.top_mm + h.clearance_mm);
  if (top > job.retract_z_mm) {
    other.retract_z_mm = std::min(job.security_z_mm, top);
    auto higher = make(other);
    if (higher && !touch_of(higher->path, step.cutter, h)) return higher;
  }
  const double low = job.feature_in_setup.origin.z - job.shape.depth_mm - job.break_through_mm;
  other.avoid = geometry::unite(job.avoid, keep_out(h, low));
  const Region cut = geometry::intersect(in_setup(job.shape.area, job.feature_in_setup), job.stock);
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
    const auto still = around ? touch_of(around->path, step.cutter, h) : std::nullopt;
    if (around && !still) return around;
    why = around ? "; around it, " + still->text : "; around it there is no path: " + around.error().message;
  }
  return fail("PIP-HOLDING", touch->text + why);
}

std::vector<Footprint> footprints(const Work& w, std::size_t setup) {
  std::vector<Footprint> out;
  for (const StepWork& s : w.steps) {
    if (s.setup != setup) continue;
    const double d = s.cutter.cutting_diameter_mm > 0.0 ? s.cutter.cutting_diameter_mm : kUsualCutter;
    for (const auto& shape : s.shapes) {
      const auto frame = compose(w.setups[setup].workpiece, shape.frame);
      Footprint f;
      const bool over = shape.open || shape.kind == model::ShapeKind::kFace ||
                        shape.kind == model::ShapeKind::kStep || shape.kind == model::ShapeKind::kOutside ||
                        shape.kind == model::ShapeKind::kChamfer;
      f.area = in_setup(shape.area, frame);
      if (over) {
        const auto& box = w.setups[setup].stock;
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

}  // namespace capstan::pipeline
