#include "planner/making/toolpath/freeform/surface_line.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace capstan::toolpath::freeform {

using geometry::Vec2;
using geometry::Vec3;

namespace {

/// Narrower than this a rise counts as a step and is climbed straight up, mm.
constexpr double kStepWidth = 1e-3;

double distance_to_segment(Vec3 p, Vec3 a, Vec3 b) {
  const Vec3 d = b - a;
  const double length2 = dot(d, d);
  const double t = length2 > 0.0 ? std::clamp(dot(p - a, d) / length2, 0.0, 1.0) : 0.0;
  return norm(p - a - t * d);
}

}  // namespace

double probe_spacing(double ball_mm, double margin_mm) {
  return 2.0 * std::sqrt(margin_mm * (2.0 * ball_mm + margin_mm));
}

std::vector<Vec3> thinned(const std::vector<Vec3>& line, double within_mm) {
  if (line.size() < 3) return line;
  std::vector<bool> keep(line.size());
  keep.front() = keep.back() = true;
  std::vector<std::pair<std::size_t, std::size_t>> spans{{0, line.size() - 1}};
  while (!spans.empty()) {
    const auto [first, last] = spans.back();
    spans.pop_back();
    double worst = within_mm;
    std::size_t at = 0;
    for (std::size_t i = first + 1; i < last; ++i) {
      const double d = distance_to_segment(line[i], line[first], line[last]);
      if (d > worst) {
        worst = d;
        at = i;
      }
    }
    if (at == 0) continue;
    keep[at] = true;
    spans.emplace_back(first, at);
    spans.emplace_back(at, last);
  }
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (keep[i]) out.push_back(line[i]);
  }
  return out;
}

std::vector<std::vector<Vec3>> Follower::over(Vec2 a, Vec2 b) const {
  // Half of the tolerance lifts the cutter; the probes' spacing and the thinning take a quarter each.
  const double lift = 0.5 * tolerance_mm;
  const double quarter = 0.25 * tolerance_mm;
  const double spacing = probe_spacing(cutter.ball_mm() + allowance_mm, quarter);
  const double length = norm(b - a);
  const int n = std::max(1, static_cast<int>(std::ceil(length / spacing)));
  std::uint32_t hint = 0;
  const auto probe = [&](double t) {
    const Vec2 p = a + t * (b - a);
    double z = drop->drop(cutter, p.x, p.y, allowance_mm + lift, hint);
    if (z != DropCutter::kNoContact || beside_is_free) z = std::max(z, bottom_z_mm);
    return std::pair{t, Vec3{p.x, p.y, z}};
  };
  std::vector<std::vector<Vec3>> out;
  std::vector<Vec3> run;
  const auto close = [&] {
    if (run.size() > 1) out.push_back(thinned(run, quarter));
    run.clear();
  };
  const auto append = [&](Vec3 p) {
    if (p.z == DropCutter::kNoContact) return close();
    run.push_back(p);
  };
  auto last = probe(0.0);
  append(last.second);
  std::vector<std::pair<double, Vec3>> ahead;
  for (int k = 1; k <= n; ++k) {
    ahead.push_back(probe(static_cast<double>(k) / n));
    while (!ahead.empty()) {
      const auto next = ahead.back();
      const bool wide = (next.first - last.first) * length > kStepWidth;
      const bool both = last.second.z != DropCutter::kNoContact && next.second.z != DropCutter::kNoContact;
      const bool same = last.second.z == next.second.z;
      if (wide && !same && !(both && norm(next.second - last.second) <= spacing)) {
        ahead.push_back(probe(0.5 * (last.first + next.first)));
        continue;
      }
      if (both && norm(next.second - last.second) > spacing) {
        const bool up = next.second.z > last.second.z;
        append(up ? Vec3{last.second.x, last.second.y, next.second.z}
                  : Vec3{next.second.x, next.second.y, last.second.z});
      }
      append(next.second);
      last = next;
      ahead.pop_back();
    }
  }
  close();
  return out;
}

}  // namespace capstan::toolpath::freeform
