#include "planner/exchange/ap238/schedules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "planner/base/number.h"
#include "planner/exchange/iso14649/segments.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using geometry::Vec3;
using model::AnyRef;

namespace {

constexpr double kSameParameter = 1e-9;
// Feeds a plan varies by along one path (default, unsourced): beyond, the numbers are something else.
constexpr double kLeastRatio = 0.01, kMostRatio = 4.0;
constexpr double kMetrePerSecond = 60000.0;  // mm/min

tl::unexpected<Diagnostic> bad(const model::Model& m, AnyRef at, std::string code, std::string what) {
  return fail({.code = std::move(code),
               .message = std::move(what),
               .line = at.set() ? m.origin(at).line : 0,
               .instance = at.set() ? m.origin(at).instance : 0});
}

// The numbers of a polyline's points; nothing for any other curve.
std::optional<std::vector<const std::vector<double>*>> numbers_of(const model::Model& m, AnyRef curve) {
  const auto* c = m.get<model::Polyline>(curve);
  if (c == nullptr) return std::nullopt;
  std::vector<const std::vector<double>*> out;
  for (const AnyRef p : c->points.items) {
    const auto* point = m.get<model::CartesianPoint>(p);
    if (point == nullptr || point->coordinates.items.empty()) return std::nullopt;
    out.push_back(&point->coordinates.items);
  }
  return out;
}

bool fits(std::size_t points, const MoveParameters& moves) {
  return moves.known() && std::abs(moves.first) < kSameParameter &&
         std::abs(moves.last - static_cast<double>(points - 1)) < kSameParameter;
}

// What one unit of the values is as a multiple of the feed; nothing when that cannot be told.
std::optional<double> unit_of(const std::vector<double>& values, double feed) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  const auto plausible = [&, lo = *least, hi = *most](double k) {
    return k * lo >= kLeastRatio && k * hi <= kMostRatio;
  };
  std::vector<double> units = {1.0};
  if (feed > 0.0) units.insert(units.end(), {kMetrePerSecond / feed, 1.0 / feed});
  // The ratio comes first: it is what stands beside the curve in the same select, and has no unit to state.
  for (const double k : units) {
    if (plausible(k)) return k;
  }
  return std::nullopt;
}

}  // namespace

Result<std::vector<double>> speed_ratios(const model::Model& m, AnyRef speed, const MoveParameters& moves,
                                         double feed_mm_min) {
  const auto wrong = [&](std::string what) { return bad(m, speed, "EXC-SPEED-PROFILE", std::move(what)); };
  std::vector<double> values;
  const bool spline = m.holds<model::BSplineCurve>(speed);
  if (const auto points = numbers_of(m, speed)) {
    for (const auto* p : *points) values.push_back(p->front());
  } else if (spline) {
    const auto curve = curves::values_of_spline(m, speed, moves.from, moves.to);
    if (!curve) return fail(curve.error());
    values = *curve;
  } else {
    return wrong("a toolpath's speed curve is of a kind that is not followed");
  }
  if (values.empty() || *std::min_element(values.begin(), values.end()) <= 0.0) {
    return wrong("a toolpath's speed curve has values that are not positive");
  }
  const auto unit = unit_of(values, feed_mm_min);
  if (!unit) {
    return wrong("a toolpath's speed curve goes up to " +
                 trimmed(*std::max_element(values.begin(), values.end()), 4) +
                 ": no multiple of the feed of " + trimmed(feed_mm_min, 1) + " mm/min, and no speed near it");
  }
  if (!spline && !fits(values.size(), moves)) {
    return wrong("a toolpath's speed curve has another parameter range than its basic curve");
  }
  std::vector<double> out(moves.from.size(), 1.0);
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (spline) {
      out[i] = *unit * values[i];
      continue;
    }
    const auto at = [&](double u) {
      const auto k = std::min(static_cast<std::size_t>(std::max(u, 0.0)), values.size() - 1);
      const double t = u - static_cast<double>(k);
      return t > 0.0 && k + 1 < values.size() ? values[k] + t * (values[k + 1] - values[k]) : values[k];
    };
    const double a = std::min(moves.from[i], moves.to[i]), b = std::max(moves.from[i], moves.to[i]);
    double least = std::min(at(a), at(b));
    for (double u = std::floor(a) + 1.0; u < b; u += 1.0) least = std::min(least, at(u));
    out[i] = *unit * least;
  }
  return out;
}

Status add_sections(const model::Model& m, const model::Trajectory& t, const MoveParameters& moves,
                    const model::CutterPath& path, model::SectionSeries& out) {
  const AnyRef curve = t.cross_section_area_parameters;
  const auto points = numbers_of(m, curve);
  const auto seven = [](const auto* p) { return p->size() == 7; };
  if (!points || !std::all_of(points->begin(), points->end(), seven)) {
    return bad(m, curve, "EXC-SECTIONS",
               "cross-section parameters are not a polyline of seven numbers a point");
  }
  if (!fits(points->size(), moves)) {
    return bad(m, curve, "EXC-SECTIONS",
               "cross-section parameters have another parameter range than the path");
  }
  const std::size_t begin = out.size(), first = path.size() - moves.from.size();
  std::vector<double> share;
  double sum = 0.0;
  const auto add = [&](std::size_t move, double fraction, double u, double length_mm) {
    const auto& p = *(*points)[static_cast<std::size_t>(std::lround(u))];
    out.move.push_back(static_cast<std::uint32_t>(move));
    out.at_mm.push_back(fraction * model::move_length(path, move));
    const std::array<std::vector<double>*, 7> columns = {&out.ad_max_mm,    &out.rd_max_mm, &out.x_max_ofs_mm,
                                                         &out.y_max_ofs_mm, &out.csa_mm2,   &out.x_cg_ofs_mm,
                                                         &out.y_cg_ofs_mm};
    for (std::size_t k = 0; k < 7; ++k) columns[k]->push_back(p[k]);
    share.push_back(std::max(0.0, p[4]) * length_mm);
    sum += share.back();
  };
  for (std::size_t i = 1; i < moves.from.size(); ++i) {
    const double a = moves.from[i], b = moves.to[i];
    if (i == 1 || a != moves.to[i - 1]) add(first + i, 0.0, a, 0.0);
    const double step = b > a ? 1.0 : -1.0;
    const auto n = static_cast<std::size_t>(std::lround(std::abs(b - a)));
    const double length = model::move_length(path, first + i);
    for (std::size_t k = 1; k <= n; ++k) {
      const auto d = static_cast<double>(k);
      add(first + i, d / static_cast<double>(n), a + step * d, length / static_cast<double>(n));
    }
  }
  const double volume = t.its_material_removal_total_volume.value_or(0.0);
  for (std::size_t k = 0; begin + k < out.size(); ++k) {
    out.removed_mm3.push_back(sum > 0.0 ? volume * share[k] / sum : 0.0);
  }
  return {};
}

std::optional<double> largest_tilt(const model::Model& m, AnyRef axes, const geometry::Placement& frame) {
  const auto points = numbers_of(m, axes);
  if (!points) return std::nullopt;
  double out = 0.0;
  for (const auto* p : *points) {
    if (p->size() != 3) return std::nullopt;
    const Vec3 d = frame.direction_to_parent({(*p)[0], (*p)[1], (*p)[2]});
    if (!(norm(d) > 0.0)) return std::nullopt;
    out = std::max(out, std::atan2(std::hypot(d.x, d.y), d.z));
  }
  return out;
}

}  // namespace capstan::exchange
