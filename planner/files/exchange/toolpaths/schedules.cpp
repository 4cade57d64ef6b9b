#include "planner/files/exchange/toolpaths/schedules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "planner/files/exchange/toolpaths/segments.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using geometry::Vec3;
using model::AnyRef;

namespace {

constexpr double kSameParameter = 1e-9;
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

struct Reading {
  double unit;  ///< times a value: the multiple of the feed
  const char* name;
};

// Possible meanings of the values; the first is taken. The ratio comes first: it is the one that the same
// select offers beside the curve, and has no unit to state.
std::vector<Reading> readings_of(const std::vector<double>& values, double feed) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  std::vector<Reading> out = {{1.0, "multiples of the feed"}};
  if (feed > 0.0) {
    out.push_back({kMetrePerSecond / feed, "metres per second"});
    out.push_back({1.0 / feed, "millimetres per minute"});
  }
  std::erase_if(out, [lo = *least, hi = *most](const Reading& r) {
    // At most exactly 1: ratios of the greatest feed, however small for the heaviest cut.
    if (r.unit == 1.0 && hi == 1.0) return false;
    return !(r.unit * lo >= kLeastRatio && r.unit * hi <= kMostRatio);
  });
  return out;
}

Result<double> unit_of(const model::Model& m, AnyRef speed, const std::vector<double>& values, double feed,
                       Job& job) {
  const auto wrong = [&](std::string what) { return bad(m, speed, "EXC-SPEED-PROFILE", std::move(what)); };
  const auto positive = [](double v) { return v > 0.0 && std::isfinite(v); };
  if (values.empty() || !std::all_of(values.begin(), values.end(), positive)) {
    return wrong("a toolpath's speed curve has values that are not positive");
  }
  const auto readings = readings_of(values, feed);
  const double most = *std::max_element(values.begin(), values.end());
  if (readings.empty()) {
    return wrong("a toolpath's speed curve goes up to " + trimmed(most, 4) + ": no multiple of the feed of " +
                 trimmed(feed, 1) + " mm/min, and no speed near it");
  }
  // A curve whose greatest value is just 1 is one of ratios: of the greatest feed.
  if (readings.size() > 1 && most != 1.0) {
    Diagnostic d =
        wrong("a toolpath's speed curve goes up to " + trimmed(most, 4) + ", which may be " +
              readings[0].name + " (" + trimmed(readings[0].unit * most * feed, 3) + " mm/min) or " +
              readings[1].name + " (" + trimmed(readings[1].unit * most * feed, 3) +
              " mm/min): " + readings[0].name + " are taken")
            .value();
    d.severity = Severity::kWarning;
    job.report(std::move(d));
  }
  return readings[0].unit;
}

// All numbers that a curve consists of: its values lie between the least and the greatest.
Result<std::vector<double>> stated_values(const model::Model& m, AnyRef speed) {
  const model::Polyline* line = m.get<model::Polyline>(speed);
  const auto* spline = m.get<model::BSplineCurve>(speed);
  std::vector<double> out;
  const auto add = [&](const auto& items) {
    for (const AnyRef p : items) {
      const auto* point = m.get<model::CartesianPoint>(p);
      if (point == nullptr || point->coordinates.items.empty()) return false;
      out.push_back(point->coordinates.items.front());
    }
    return true;
  };
  const bool good = line != nullptr     ? add(line->points.items)
                    : spline != nullptr ? add(spline->control_points_list.items)
                                        : false;
  if (good) return out;
  return bad(m, speed, "EXC-SPEED-PROFILE", "a toolpath's speed curve is of a kind that is not followed");
}

}  // namespace

Result<double> least_speed_ratio(const model::Model& m, AnyRef speed, double feed_mm_min, Job& job) {
  const auto values = stated_values(m, speed);
  if (!values) return fail(values.error());
  const auto unit = unit_of(m, speed, *values, feed_mm_min, job);
  if (!unit) return fail(unit.error());
  return std::min(1.0, *unit * *std::min_element(values->begin(), values->end()));
}

Result<std::vector<double>> speed_ratios(const model::Model& m, AnyRef speed, const MoveParameters& moves,
                                         double feed_mm_min, Job& job) {
  const auto wrong = [&](std::string what) { return bad(m, speed, "EXC-SPEED-PROFILE", std::move(what)); };
  const bool spline = m.holds<model::BSplineCurve>(speed);
  auto values = spline ? curves::values_of_spline(m, speed, moves.from, moves.to) : stated_values(m, speed);
  if (!values) return fail(values.error());
  if (!spline && !fits(values->size(), moves)) {
    return wrong("a toolpath's speed curve has another parameter range than its basic curve");
  }
  const auto unit = unit_of(m, speed, *values, feed_mm_min, job);
  if (!unit) return fail(unit.error());
  std::vector<double> out(moves.from.size(), 1.0);
  for (std::size_t i = 1; i < out.size(); ++i) {
    if (spline) {
      out[i] = *unit * (*values)[i];
      continue;
    }
    const auto at = [&v = *values](double u) {
      const auto k = std::min(static_cast<std::size_t>(std::max(u, 0.0)), v.size() - 1);
      const double t = u - static_cast<double>(k);
      return t > 0.0 && k + 1 < v.size() ? v[k] + t * (v[k + 1] - v[k]) : v[k];
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
    // The nearest point; what a curve is sampled to need not begin or end at one.
    const double nearest = std::clamp(std::round(u), 0.0, static_cast<double>(points->size() - 1));
    const auto& p = *(*points)[static_cast<std::size_t>(nearest)];
    out.move.push_back(static_cast<std::uint32_t>(move));
    out.at_mm.push_back(fraction * model::move_length(path, move));
    const std::array<std::vector<double>*, 7> columns = {&out.ad_max_mm,    &out.rd_max_mm, &out.x_max_ofs_mm,
                                                         &out.y_max_ofs_mm, &out.csa_mm2,   &out.x_cg_ofs_mm,
                                                         &out.y_cg_ofs_mm};
    for (std::size_t k = 0; k < 7; ++k) columns[k]->push_back(p[k]);
    // Between two points the area changes evenly.
    const double area = std::max(0.0, p[4]);
    const double before = length_mm > 0.0 && out.size() - begin > 1 ? out.csa_mm2[out.size() - 2] : area;
    share.push_back(0.5 * (area + std::max(0.0, before)) * length_mm);
    sum += share.back();
  };
  for (std::size_t i = 1; i < moves.from.size(); ++i) {
    const double a = moves.from[i], b = moves.to[i];
    if (i == 1 || a != moves.to[i - 1]) add(first + i, 0.0, a, 0.0);
    const auto n = static_cast<std::size_t>(std::lround(std::abs(b - a)));
    const double length = model::move_length(path, first + i);
    for (std::size_t k = 1; k <= n; ++k) {
      const auto d = static_cast<double>(k);
      add(first + i, d / static_cast<double>(n), a + (b - a) * d / static_cast<double>(n),
          length / static_cast<double>(n));
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
