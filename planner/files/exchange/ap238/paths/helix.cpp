#include "planner/files/exchange/ap238/paths/helix.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>

#include "planner/files/exchange/toolpaths/segments.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using geometry::Vec3;
using model::AnyRef;
using model::Storage;

namespace {

constexpr double kUpright = 1e-9;
constexpr double kSameMm = 1e-6;
constexpr std::string_view kName = "HELIX";

// --- what a helix is, as text ---

struct Form {
  double radius = 0.0, pitch = 0.0;
  Vec3 location;
  std::optional<Vec3> axis, ref;
  bool sense = true;
  int master = 0;
  std::array<bool, 2> point{};
  std::array<std::optional<double>, 2> parameter;
};

std::string text_of(const Form& f) {
  std::string out(kName);
  const auto number = [&](double v) { out += " " + shortest(v); };
  const auto vector = [&](const std::optional<Vec3>& v) {
    if (!v) {
      out += " $";
      return;
    }
    number(v->x);
    number(v->y);
    number(v->z);
  };
  number(f.radius);
  number(f.pitch);
  vector(f.location);
  vector(f.axis);
  vector(f.ref);
  out += f.sense ? " T " : " F ";
  out += std::to_string(f.master);
  for (std::size_t i = 0; i < 2; ++i) {
    out += f.point[i] ? " P" : " -";
    if (f.parameter[i]) {
      number(*f.parameter[i]);
    } else {
      out += " $";
    }
  }
  return out;
}

std::optional<Form> form_of(const std::string& text) {
  std::istringstream in(text);
  std::string word;
  bool good = true;
  const auto next = [&] {
    good = good && static_cast<bool>(in >> word);
    return good;
  };
  const auto value = [&](bool read_word) {
    if (read_word && !next()) return 0.0;
    const auto v = parse_double(word);
    good = good && v.has_value() && std::isfinite(*v);
    return v.value_or(0.0);
  };
  const auto vector = [&]() -> std::optional<Vec3> {
    if (!next() || word == "$") return std::nullopt;
    const double x = value(false), y = value(true), z = value(true);
    return Vec3{x, y, z};
  };
  if (!next() || word != kName) return std::nullopt;
  Form f;
  f.radius = value(true);
  f.pitch = value(true);
  const auto location = vector();
  if (!location) return std::nullopt;
  f.location = *location;
  f.axis = vector();
  f.ref = vector();
  next();
  f.sense = word == "T";
  const double master = value(true);
  if (master < 0.0 || master > 2.0) return std::nullopt;
  f.master = static_cast<int>(master);
  for (std::size_t i = 0; i < 2; ++i) {
    next();
    f.point[i] = word == "P";
    if (next() && word != "$") f.parameter[i] = value(false);
  }
  if (!good || f.master < 0) return std::nullopt;
  return f;
}

std::optional<Vec3> direction_of(const model::Model& m, AnyRef at) {
  const auto* d = m.get<model::Direction>(at);
  if (d == nullptr || d->direction_ratios.items.size() != 3) return std::nullopt;
  const auto& v = d->direction_ratios.items;
  return Vec3{v[0], v[1], v[2]};
}

std::optional<Form> form_of(const model::Model& m, const model::TrimmedCurve& c) {
  const auto* helix = m.get<model::Helix>(c.basis_curve);
  const auto* place = helix == nullptr ? nullptr : m.get<model::Axis2Placement3d>(helix->position);
  if (place == nullptr || !helix->radius || !helix->pitch) return std::nullopt;
  const auto location = model::point(m, place->location);
  if (!location) return std::nullopt;
  Form f;
  f.radius = *helix->radius;
  f.pitch = *helix->pitch;
  f.location = *location;
  f.axis = direction_of(m, place->axis);
  f.ref = direction_of(m, place->ref_direction);
  f.sense = c.sense_agreement.value_or(true);
  f.master = std::max<int>(0, c.master_representation.code);
  for (std::size_t i = 0; i < 2; ++i) {
    for (const auto& v : (i == 0 ? c.trim_1 : c.trim_2).items) {
      if (v.ref.set()) f.point[i] = true;
      if (v.real) f.parameter[i] = *v.real;
    }
  }
  return f;
}

// --- points ---

struct Point {
  Vec3 at;
  bool via = false;
};

// Largest number of points of a written helix, as many as a path may have moves; default, unsourced.
constexpr std::size_t kMostPoints = CurveOptions{}.max_moves;

// Full turns have two via points, the rest has one. Nothing if there are more than `most`.
std::optional<std::vector<Point>> points_of(const curves::Segment& s, bool upright, std::size_t most) {
  std::vector<Point> out = {{s.from}};
  if (!s.arc) {
    out.push_back({s.to});
    return out;
  }
  const double sweep = std::abs(s.sweep);
  const double radius = norm(s.from - s.centre - dot(s.from - s.centre, s.axis) * s.axis);
  double step = kRadPerTurn;
  if (!upright)
    step = 2.0 *
           std::acos(std::clamp(1.0 - CurveOptions{}.chord_tolerance_mm / std::max(radius, 1e-6), -1.0, 1.0));
  const double steps = std::max(1.0, std::ceil(sweep / std::max(step, 1e-4) - 1e-12));
  if (!(steps < static_cast<double>(most))) return std::nullopt;  // also what is no number
  const auto n = static_cast<std::size_t>(steps);
  for (std::size_t i = 1; i <= n; ++i) {
    const double a = static_cast<double>(i - 1) * step / sweep,
                 b = std::min(1.0, static_cast<double>(i) * step / sweep);
    const std::size_t vias = !upright ? 0 : (b - a) * sweep > kRadPerTurn - 1e-9 ? 2 : 1;
    for (std::size_t k = 1; k <= vias; ++k) {
      out.push_back(
          {curves::at(s, a + (b - a) * static_cast<double>(k) / static_cast<double>(vias + 1)), true});
    }
    out.push_back({i == n ? s.to : curves::at(s, b)});
    if (out.size() > most) return std::nullopt;
  }
  return out;
}

std::optional<std::vector<Point>> points_of(const model::Model& m, AnyRef trimmed, bool& upright,
                                            std::size_t most) {
  Job quiet;
  const auto segments = curves::segments_of(m, trimmed, {}, quiet);
  if (!segments || segments->size() != 1) return std::nullopt;
  const auto& s = segments->front();
  upright = !s.arc || std::hypot(s.axis.x, s.axis.y) <= kUpright;
  return points_of(s, upright, most);
}

AnyRef trim_point(const model::SelectList& list) {
  for (const auto& v : list.items) {
    if (v.ref.set()) return v.ref;
  }
  return {};
}

// --- putting one object in the place of another ---

void replace(model::Model& m, const std::map<AnyRef, AnyRef>& by) {
  const auto one = [&](AnyRef& r) {
    const auto it = by.find(r);
    if (it != by.end()) r = it->second;
  };
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<model::TypeId>(t);
    for (const AnyRef at : m.all(type)) {
      for (const model::Attribute& a : model::noun_type(type).attributes) {
        void* slot = a.at(m.object(at));
        if (a.storage == Storage::kRef) one(*static_cast<AnyRef*>(slot));
        if (a.storage == Storage::kRefList) {
          for (AnyRef& r : static_cast<model::AnyRefList*>(slot)->items) one(r);
        }
        if (a.storage == Storage::kSelect) one(static_cast<model::SelectValue*>(slot)->ref);
      }
    }
  }
  for (const AnyRef at : m.all(model::TypeId::kKeptInstance)) {
    for (auto& piece : m.at<model::KeptInstance>(at).pieces) {
      if (auto* r = std::get_if<AnyRef>(&piece)) one(*r);
    }
  }
}

template <class T>
AnyRef add_point(model::Model& m, Vec3 at) {
  T p;
  p.name = "";
  p.coordinates = {{at.x + 0.0, at.y + 0.0, at.z + 0.0}, true};
  return m.add(std::move(p));
}

AnyRef polyline(model::Model& m, const std::vector<Point>& points, AnyRef first, AnyRef last,
                std::string name) {
  model::Polyline c;
  c.name = std::move(name);
  c.points.given = true;
  for (std::size_t i = 0; i < points.size(); ++i) {
    AnyRef p = i == 0 ? first : i + 1 == points.size() ? last : AnyRef{};
    if (!p.set()) {
      p = points[i].via ? add_point<model::ViaHelixPoint>(m, points[i].at)
                        : add_point<model::CartesianPoint>(m, points[i].at);
    }
    c.points.items.push_back(p);
  }
  return m.add(std::move(c));
}

AnyRef trimmed_helix(model::Model& m, const Form& f, AnyRef first, AnyRef last) {
  const auto direction = [&](Vec3 d) {
    model::Direction out;
    out.name = "";
    out.direction_ratios = {{d.x, d.y, d.z}, true};
    return m.add(std::move(out));
  };
  model::Axis2Placement3d place;
  place.name = "";
  place.location = model::Ref<model::CartesianPoint>(add_point<model::CartesianPoint>(m, f.location));
  if (f.axis) place.axis = direction(*f.axis);
  if (f.ref) place.ref_direction = direction(*f.ref);
  model::Helix helix;
  helix.name = "";
  helix.position = m.add(std::move(place));
  helix.radius = f.radius;
  helix.pitch = f.pitch;
  model::TrimmedCurve c;
  c.name = "";
  c.basis_curve = m.add(std::move(helix));
  c.sense_agreement = f.sense;
  c.master_representation = static_cast<model::TrimmingPreference>(f.master);
  for (std::size_t i = 0; i < 2; ++i) {
    auto& trim = i == 0 ? c.trim_1 : c.trim_2;
    trim.given = true;
    if (f.point[i]) trim.items.push_back({.ref = i == 0 ? first : last, .type = {}, .real = {}, .text = {}});
    if (f.parameter[i]) {
      trim.items.push_back({.ref = {}, .type = "PARAMETER_VALUE", .real = *f.parameter[i], .text = {}});
    }
  }
  return m.add(std::move(c));
}

}  // namespace

void helices_to_via_points(model::Plan& plan, std::vector<std::string>& losses) {
  auto& m = plan.model;
  std::map<AnyRef, AnyRef> by;
  for (const AnyRef at : m.all(model::TypeId::kTrimmedCurve)) {
    const auto curve = m.at<model::TrimmedCurve>(at);
    if (!m.holds<model::Helix>(curve.basis_curve)) continue;
    const auto form = form_of(m, curve);
    bool upright = true;
    const auto points = points_of(m, at, upright, kMostPoints);
    if (!form || !points) {
      losses.emplace_back("a trimmed HELIX that cannot be followed, or takes more than " +
                          std::to_string(kMostPoints) + " points, is left out");
      continue;
    }
    by[at] = polyline(m, *points, trim_point(curve.trim_1), trim_point(curve.trim_2), text_of(*form));
    if (!upright)
      losses.emplace_back("a HELIX that does not turn about z is written as points within a micrometre");
  }
  if (!by.empty()) replace(m, by);
}

void via_points_to_helices(model::Plan& plan) {
  auto& m = plan.model;
  std::map<AnyRef, AnyRef> by;
  for (const AnyRef at : m.all(model::TypeId::kPolyline)) {
    const auto line = m.at<model::Polyline>(at);
    if (!line.name || line.name->rfind(kName, 0) != 0 || line.points.items.size() < 2) continue;
    const auto form = form_of(*line.name);
    if (!form) continue;
    const AnyRef curve = trimmed_helix(m, *form, line.points.items.front(), line.points.items.back());
    bool upright = true;
    const auto points = points_of(m, curve, upright, line.points.items.size());
    bool same = points && points->size() == line.points.items.size();
    for (std::size_t i = 0; same && i < points->size(); ++i) {
      const auto p = model::point(m, line.points[i]);
      same = p && norm(*p - (*points)[i].at) <= kSameMm &&
             (*points)[i].via == m.holds<model::ViaHelixPoint>(line.points.items[i]);
    }
    if (same) by[at] = curve;
  }
  if (!by.empty()) replace(m, by);
}

}  // namespace capstan::exchange::ap238
