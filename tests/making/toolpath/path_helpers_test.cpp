#include "tests/making/toolpath/path_helpers.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <numbers>

#include "planner/making/toolpath/region/area/inside.h"

namespace capstan::toolpath {

using geometry::Region;
using geometry::Vec2;
using geometry::Vec3;
using model::MoveKind;
using model::MoveRole;

HeightMap::HeightMap(Vec2 lo, Vec2 hi, double cell_mm, double top_mm)
    : lo_(lo),
      cell_(cell_mm),
      nx_(static_cast<std::size_t>((hi.x - lo.x) / cell_mm)),
      ny_(static_cast<std::size_t>((hi.y - lo.y) / cell_mm)),
      z_(nx_ * ny_, static_cast<float>(top_mm)) {}

Vec2 HeightMap::centre(std::size_t i) const {
  return lo_ +
         Vec2{(static_cast<double>(i % nx_) + 0.5) * cell_, (static_cast<double>(i / nx_) + 0.5) * cell_};
}

void HeightMap::only(const Region& region) {
  const Inside in(region);
  for (std::size_t i = 0; i < z_.size(); ++i) {
    if (!in.contains(centre(i))) z_[i] = -1e6F;
  }
}

void HeightMap::set_top(const Region& region, double z_mm) {
  const Inside in(region);
  for (std::size_t i = 0; i < z_.size(); ++i) {
    if (in.contains(centre(i))) z_[i] = static_cast<float>(z_mm);
  }
}

double HeightMap::stamp(Vec3 p, double radius, bool cuts) {
  float most = 0.0F;
  const double r = cuts ? radius : radius - 1.5 * cell_;
  if (r <= 0.0) return 0.0;
  const auto index = [&](double v, double lo, std::size_t n) {
    return static_cast<std::size_t>(std::clamp((v - lo) / cell_, 0.0, static_cast<double>(n)));
  };
  const std::size_t x0 = index(p.x - r, lo_.x, nx_), x1 = std::min(nx_, index(p.x + r, lo_.x, nx_) + 1),
                    y1 = std::min(ny_, index(p.y + r, lo_.y, ny_) + 1);
  const float tip = static_cast<float>(p.z);
  for (std::size_t y = index(p.y - r, lo_.y, ny_); y < y1; ++y) {
    const double dy = lo_.y + (static_cast<double>(y) + 0.5) * cell_ - p.y;
    float* const row = &z_[y * nx_];
    for (std::size_t x = x0; x < x1; ++x) {
      float& z = row[x];
      if (z <= tip + 1e-4F) continue;
      const double dx = lo_.x + (static_cast<double>(x) + 0.5) * cell_ - p.x;
      if (dx * dx + dy * dy > r * r) continue;
      most = std::max(most, z - tip);
      if (cuts) z = tip;
    }
  }
  return static_cast<double>(most);
}

HeightMap::Report HeightMap::run(const GeneratedPath& g, const model::Cutter& cutter) {
  Report out;
  const double radius = 0.5 * cutter.cutting_diameter_mm;
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (g.path.kind[i] == MoveKind::kDwell) continue;
    const MoveRole role = g.path.role[i];
    const bool air = g.path.kind[i] == MoveKind::kRapid || role == MoveRole::kApproach ||
                     role == MoveRole::kLink || role == MoveRole::kRetract;
    const double length = model::move_length(g.path, i);
    const int n = std::max(1, static_cast<int>(std::ceil(length / (0.7 * cell_))));
    bool touched = false;
    for (int k = air ? 1 : 0; k <= n; ++k) {
      const double taken = stamp(model::point_on_move(g.path, i, static_cast<double>(k) / n), radius, !air);
      touched = touched || taken > 0.0;
      if (!air) out.deepest_mm = std::max(out.deepest_mm, taken);
    }
    if (!air) out.cut_mm += length;
    if (touched && (air || (role == MoveRole::kPlunge && !cutter.centre_cutting))) {
      char text[200];
      std::snprintf(text, sizeof text, "move %zu (role %d, kind %d) to %.3f %.3f %.3f touches", i,
                    static_cast<int>(role), static_cast<int>(g.path.kind[i]), g.path.x[i], g.path.y[i],
                    g.path.z[i]);
      out.faults.emplace_back(text);
    }
  }
  return out;
}

double HeightMap::highest(const Region& region) const {
  const Inside in(region);
  double z = -1e9;
  for (std::size_t i = 0; i < z_.size(); ++i) {
    if (in.contains(centre(i))) z = std::max(z, static_cast<double>(z_[i]));
  }
  return z;
}

double HeightMap::lowest_outside(const Region& region) const {
  const Inside in(region);
  double z = 1e9;
  for (std::size_t i = 0; i < z_.size(); ++i) {
    if (!in.contains(centre(i)) && z_[i] > -1e5F) z = std::min(z, static_cast<double>(z_[i]));
  }
  return z;
}

std::vector<std::string> rule_breaks(const PathJob& task, const GeneratedPath& g) {
  std::vector<std::string> out;
  const auto& p = g.path;
  const auto say = [&](std::size_t i, const char* what) {
    char text[200];
    std::snprintf(text, sizeof text, "move %zu to %.4f %.4f %.4f: %s", i, p.x[i], p.y[i], p.z[i], what);
    out.emplace_back(text);
  };
  if (p.size() < 3) return {"the path is empty"};
  const std::size_t n = p.size();
  for (const std::size_t have :
       {p.y.size(), p.z.size(), p.cx.size(), p.cy.size(), p.kind.size(), p.role.size(), g.feed_factor.size(),
        g.speed_factor.size(), g.dwell_s.size()}) {
    if (have != n) out.emplace_back("columns differ in length");
  }
  if (std::abs(p.z.front() - task.security_z_mm) > 1e-9) say(0, "does not begin at the security plane");
  if (std::abs(p.z.back() - task.security_z_mm) > 1e-9) say(n - 1, "does not end at the security plane");
  const double rapid = std::max(task.retract_z_mm, task.start_z_mm + task.clearance_mm);
  const double most = std::tan(task.cutter.maximum_ramp_angle_rad);
  for (std::size_t i = 1; i < n; ++i) {
    if (!std::isfinite(p.x[i] + p.y[i] + p.z[i])) say(i, "is not finite");
    const bool flat = std::hypot(p.x[i] - p.x[i - 1], p.y[i] - p.y[i - 1]) < 1e-9;
    if (p.kind[i] == MoveKind::kRapid) {
      const bool up = flat && p.z[i] > p.z[i - 1];
      if (!up && std::min(p.z[i], p.z[i - 1]) < rapid - 1e-9) say(i, "rapid below the retract plane");
    }
    if (p.kind[i] == MoveKind::kArcCw || p.kind[i] == MoveKind::kArcCcw) {
      const double r0 = std::hypot(p.x[i - 1] - p.cx[i], p.y[i - 1] - p.cy[i]);
      const double r1 = std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]);
      if (std::abs(r0 - r1) > 1e-6) say(i, "arc with two radii");
      if (r0 < 1e-4) say(i, "arc without a radius");
    }
    const double run = model::move_length(p, i);
    const double fall = p.z[i - 1] - p.z[i];
    if (p.role[i] == MoveRole::kRamp) {
      const double flat_run = std::sqrt(std::max(0.0, run * run - fall * fall));
      if (fall > most * flat_run + 1e-6) say(i, "ramp steeper than the cutter allows");
    }
    if (p.role[i] == MoveRole::kCut && fall > 1e-9 && flat) say(i, "cut straight down");
    if (p.role[i] == MoveRole::kPlunge && !task.cutter.centre_cutting && fall > 1e-9)
      say(i, "plunge with a cutter that does not cut to its centre");
    if (p.kind[i] != MoveKind::kDwell && run <= 1e-9) say(i, "move without length");
  }
  return out;
}

double gouge_mm(const GeneratedPath& g, const Region& allowed, double radius_mm, double below_z) {
  const Inside in(allowed);
  double worst = 0.0;
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    if (std::min(g.path.z[i], g.path.z[i - 1]) >= below_z) continue;
    const int n = std::clamp(static_cast<int>(model::move_length(g.path, i) / 0.05), 1, 400);
    for (int k = 0; k <= n; ++k) {
      const Vec3 p = model::point_on_move(g.path, i, static_cast<double>(k) / n);
      if (p.z >= below_z) continue;
      if (!in.contains(xy(p))) {
        worst = std::max(worst, radius_mm + geometry::distance_to_boundary(allowed, xy(p)));
      } else if (in.boundary_within(xy(p), radius_mm - worst)) {
        worst = std::max(worst, radius_mm - geometry::distance_to_boundary(allowed, xy(p)));
      }
    }
  }
  return worst;
}

model::Cutter endmill(double diameter_mm) {
  model::Cutter c;
  c.id = "EM" + std::to_string(static_cast<int>(diameter_mm));
  c.cutting_diameter_mm = diameter_mm;
  c.maximum_depth_of_cut_mm = 3.0 * diameter_mm;
  c.centre_cutting = true;
  c.maximum_ramp_angle_rad = 3.0 * std::numbers::pi / 180.0;
  c.teeth = 3;
  return c;
}

PathJob area_job(const Region& area, double depth_mm, double diameter_mm) {
  PathJob t;
  t.shape.kind = model::ShapeKind::kPocket;
  t.shape.name = "POCKET";
  t.shape.area = t.shape.reach = area;
  t.shape.depth_mm = depth_mm;
  t.operation = model::TypeId::kBottomAndSideRoughMilling;
  t.cutter = endmill(diameter_mm);
  t.axial_depth_mm = depth_mm;
  t.security_z_mm = 50.0;
  t.retract_z_mm = 5.0;
  return t;
}

void plot(const GeneratedPath& g, const Region& area, const std::string& name) {
  const char* folder = std::getenv("CAPSTAN_PLOT");
  if (folder == nullptr) return;
  const auto box = model::bounds(g.path);
  const double w = box.hi.x - box.lo.x + 10;
  const double h = box.hi.y - box.lo.y + 10;
  const double k = 900.0 / std::max(w, h);
  std::ofstream f(std::string(folder) + "/" + name + ".svg");
  f << "<svg xmlns='http://www.w3.org/2000/svg' width='" << w * k << "' height='" << h * k << "'>\n"
    << "<rect width='100%' height='100%' fill='white'/>\n";
  const auto x = [&](double v) { return (v - box.lo.x + 5) * k; };
  const auto y = [&](double v) { return (box.hi.y - v + 5) * k; };
  for (const auto& loop : area.loops) {
    f << "<polygon fill='none' stroke='black' stroke-width='1.5' points='";
    for (const Vec2 p : loop) f << x(p.x) << "," << y(p.y) << " ";
    f << "'/>\n";
  }
  static const char* const kColours[] = {"orange", "red",  "magenta", "blue",
                                         "green",  "grey", "brown",   "brown"};
  for (std::size_t i = 1; i < g.path.size(); ++i) {
    const bool arc = g.path.kind[i] == MoveKind::kArcCw || g.path.kind[i] == MoveKind::kArcCcw;
    const int n = arc ? 16 : 1;
    f << "<polyline fill='none' stroke='"
      << (g.path.kind[i] == MoveKind::kRapid ? "lightgrey" : kColours[static_cast<int>(g.path.role[i])])
      << "' stroke-width='" << (arc ? 2 : 1) << "' points='";
    for (int s = 0; s <= n; ++s) {
      const Vec3 p = model::point_on_move(g.path, i, static_cast<double>(s) / n);
      f << x(p.x) << "," << y(p.y) << " ";
    }
    f << "'/>\n";
  }
  f << "</svg>\n";
}

}  // namespace capstan::toolpath
