#pragma once

#include <cmath>
#include <numbers>
#include <random>

#include "planner/making/optimise/feeds.h"
#include "planner/physics/motion/time.h"

/// Questions and cuts for the tests of feeds.
namespace capstan::optimise::examples {

inline model::Machine machine(double acceleration_mm_s2 = 3000.0) {
  model::Machine m;
  for (std::size_t i = 0; i < 3; ++i) {
    m.axes[i] = {.name = std::string(1, static_cast<char>('X' + i)),
                 .rapid_mm_min = 24000.0,
                 .feed_max_mm_min = 10000.0,
                 .acceleration_mm_s2 = acceleration_mm_s2,
                 .jerk_mm_s3 = {}};
  }
  m.control.path_tolerance_mm = 0.01;
  m.spindle.rpm_min = 60;
  m.spindle.rpm_max = 10000;
  m.spindle.efficiency = 0.85;
  m.spindle.curve = {{60, 0, 47.746}, {1500, 7500, 0}, {10000, 7500, 0}};
  return m;
}

/// A carbide end mill of 10 mm with four teeth in mild steel: 0.05 mm per tooth at 4000 1/min is 800 mm/min.
inline FeedQuestion question() {
  FeedQuestion q;
  q.cut.kind = CutKind::kRough;
  q.cut.machine = machine();
  q.cut.cutter.id = "em10";
  q.cut.cutter.cutting_diameter_mm = 10.0;
  q.cut.cutter.shank_diameter_mm = 10.0;
  q.cut.cutter.maximum_depth_of_cut_mm = 22.0;
  q.cut.cutter.stick_out_mm = 30.0;
  q.cut.cutter.teeth = 4;
  q.cut.cutter.helix_rad = 0.6;
  q.cut.material.kc11_n_mm2 = 1800.0;
  q.cut.material.mc = 0.22;
  q.cut.fz_start_mm = 0.05;
  q.n_rpm = 4000.0;
  q.feed_mm_min = 800.0;
  return q;
}

/// One cut along X.
inline model::CutterPath straight(double length_mm = 100.0) {
  model::CutterPath p;
  p.start({0, 0, 0});
  p.line({length_mm, 0, 0}, model::MoveRole::kCut);
  return p;
}

/// The time that a path takes at feed by a schedule, s; -1 where it has none.
inline double cutting_s(const FeedQuestion& q, const model::CutterPath& p, const model::FeedSchedule& s) {
  const auto t = motion::time_of(p, s, q.cut.machine);
  return t ? t->cutting_s : -1.0;
}

/// A straight pass in down milling: the arc ends at pi.
inline CutSample down_cut(std::uint32_t move, double at_mm, double step_mm, double ap_mm, double ae_mm,
                          double diameter_mm = 10.0) {
  const double phi = std::acos(1.0 - 2.0 * ae_mm / diameter_mm);
  return {.move = move,
          .ap_mm = ap_mm,
          .ae_mm = ae_mm,
          .plunge = false,
          .at_mm = at_mm,
          .step_mm = step_mm,
          .entry_rad = std::numbers::pi - phi,
          .exit_rad = std::numbers::pi,
          .csa_mm2 = ap_mm * ae_mm};
}

/// Samples each millimetre of a move, all the same.
inline void cut_along(FeedQuestion& q, const model::CutterPath& path, std::uint32_t move, double ap_mm,
                      double ae_mm, double from_mm = 0.0, double to_mm = 1e9) {
  const double length = std::min(to_mm, model::move_length(path, move));
  for (double at = from_mm; at < length - 1e-9;) {
    const double step = std::min(1.0, length - at);
    at += step;
    q.samples.push_back(down_cut(move, at, step, ap_mm, ae_mm));
  }
}

/// A random zigzag of lines and arcs with random cuts along it.
inline model::CutterPath random_path(FeedQuestion& q, std::mt19937& random, int moves = 40) {
  std::uniform_real_distribution<double> at(-40.0, 40.0), depth(0.2, 8.0), width(0.05, 10.0), one(0.0, 1.0);
  model::CutterPath p;
  p.start({0, 0, 0});
  for (int i = 1; i <= moves; ++i) {
    const geometry::Vec3 to{at(random), at(random), 0.0};
    const geometry::Vec3 from = p.point(p.size() - 1);
    const double kind = one(random);
    if (kind < 0.1) {
      p.rapid(to);
      continue;
    }
    if (kind < 0.3) {
      const geometry::Vec2 centre{from.x + 0.2 * (to.x - from.x), from.y + 0.2 * (to.y - from.y)};
      p.arc({from.x + 0.4 * (to.x - from.x), from.y + 0.4 * (to.y - from.y), 0.0}, centre, kind < 0.2,
            model::MoveRole::kCut);
    } else {
      p.line(to, kind < 0.4 ? model::MoveRole::kRamp : model::MoveRole::kCut);
    }
    const auto move = static_cast<std::uint32_t>(p.size() - 1);
    const double length = model::move_length(p, move);
    double ap = depth(random);
    double ae = width(random);
    for (double s = 0.0; s < length - 1e-9;) {
      const double step = std::min(0.5, length - s);
      s += step;
      if (one(random) < 0.1) ap = depth(random);
      if (one(random) < 0.2) ae = width(random);
      if (one(random) < 0.1) continue;  // air
      CutSample c = down_cut(move, s, step, ap, ae);
      if (one(random) < 0.3) {  // up milling
        c.exit_rad = c.exit_rad - c.entry_rad;
        c.entry_rad = 0.0;
      }
      if (one(random) < 0.2) c.csa_mm2 *= 0.3 + 0.6 * one(random);  // a wall and a floor
      if (one(random) < 0.1) c.csa_mm2 *= 1.3;                      // inside of a corner
      q.samples.push_back(c);
    }
  }
  return p;
}

}  // namespace capstan::optimise::examples
