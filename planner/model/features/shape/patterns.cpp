#include "planner/model/features/shape/patterns.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "planner/model/features/resolve.h"
#include "planner/model/nouns/geometric_item.h"

// The members of patterns: turned about the pattern's axis, set out in rows and columns, or at the locations
// that it lists. A member that the pattern leaves out is no member; one that it moves is at its new place. Of
// several members at one place one counts.

namespace capstan::model::shape {

using geometry::Placement;
using geometry::Vec3;

bool same(const Placement& a, const Placement& b) {
  return norm(a.origin - b.origin) < kSamePlace && norm(a.x - b.x) < kSamePlace &&
         norm(a.z - b.z) < kSamePlace;
}

namespace {

constexpr double kSameCircle = 0.01;  // mm; default, unsourced

Placement turned(const Placement& about, const Placement& p, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double n = std::sin(angle_rad);
  const Placement turn{.origin = {}, .x = {c, n, 0.0}, .y = {-n, c, 0.0}, .z = {0.0, 0.0, 1.0}};
  return compose(about, compose(turn, compose(inverse(about), p)));
}

Placement shifted(Placement p, Vec3 by) {
  p.origin = p.origin + by;
  return p;
}

/// A number that a pattern leaves out or moves, and that none of its members has.
Status numbered(const Model& m, AnyRef pattern, AnyRef by, const char* what, std::optional<std::int64_t> at,
                std::int64_t most) {
  if (at && *at >= 1 && *at <= most) return {};
  return unsupported(m, pattern,
                     "its " + std::string(noun_type(by.type).keyword) + " #" +
                         std::to_string(m.origin(by).instance) + " names " + what + " " +
                         (at ? std::to_string(*at) : "$") + ", and there are 1 to " + std::to_string(most));
}

template <class T>
bool omitted(const Model& m, const RefList<T>& list, std::int64_t a) {
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto* o = m.get<T>(list[i]);
    if (o != nullptr && o->index == a) return true;
  }
  return false;
}

/// The frames of a pattern's members as its base's, workpiece coordinates, by the pattern's frame `about`.
Result<std::vector<Placement>> members(const Model& m, AnyRef self, const CircularPattern& c,
                                       const Placement& about, const Placement& base) {
  const std::int64_t n = c.number_of_feature.value_or(0);
  if (n < 1 || n > kMaxCopies) return unsupported(m, self, "number_of_feature is not between 1 and 100,000");
  for (const AnyRef by : c.missing_base_feature.items) {
    const auto* o = m.get<CircularOmit>(by);
    if (auto ok = numbered(m, self, by, "member", o != nullptr ? o->index : std::nullopt, n); !ok)
      return tl::unexpected(ok.error());
  }
  for (const AnyRef by : c.relocated_base_feature.items) {
    const auto* o = m.get<CircularOffset>(by);
    if (auto ok = numbered(m, self, by, "member", o != nullptr ? o->index : std::nullopt, n); !ok)
      return tl::unexpected(ok.error());
  }
  std::vector<Placement> out;
  for (std::int64_t i = 0; i < n; ++i) {
    if (omitted(m, c.missing_base_feature, i + 1)) continue;
    double angle = static_cast<double>(i) * c.angle_increment.value_or(0.0);
    for (std::size_t k = 0; k < c.relocated_base_feature.size(); ++k) {
      const auto* o = m.get<CircularOffset>(c.relocated_base_feature[k]);
      if (o != nullptr && o->index == i + 1) angle += o->angular_offset.value_or(0.0);
    }
    out.push_back(turned(about, base, angle));
  }
  return out;
}

Result<std::vector<Placement>> members(const Model& m, AnyRef self, const RectangularPattern& r,
                                       const Placement& about, const Placement& base) {
  const auto spacing = length(m, r.spacing);
  const auto along = direction(m, r.its_direction);
  if (!spacing) return missing(m, self, "spacing", spacing.error());
  if (!along) return missing(m, self, "its_direction");
  const std::int64_t rows = r.number_of_rows.value_or(1);
  const std::int64_t columns = r.number_of_columns.value_or(0);
  if (rows < 1 || columns < 1 || rows > kMaxCopies || columns > kMaxCopies / rows)
    return unsupported(m, self, "its rows and columns are not between 1 and 100,000 copies");
  const auto in_rows = [&](AnyRef by, const auto* o) -> Status {
    if (auto ok = numbered(m, self, by, "row", o != nullptr ? o->row_index : std::nullopt, rows); !ok)
      return ok;
    return numbered(m, self, by, "column", o != nullptr ? o->column_index : std::nullopt, columns);
  };
  for (const AnyRef by : r.missing_base_feature.items) {
    if (auto ok = in_rows(by, m.get<RectangularOmit>(by)); !ok) return tl::unexpected(ok.error());
  }
  for (const AnyRef by : r.relocated_base_feature.items) {
    if (auto ok = in_rows(by, m.get<RectangularOffset>(by)); !ok) return tl::unexpected(ok.error());
  }
  Vec3 row_step;
  if (rows > 1) {
    const auto row_spacing = length(m, r.row_spacing);
    const auto row_direction = direction(m, r.row_layout_direction);
    if (!row_spacing) return missing(m, self, "row_spacing", row_spacing.error());
    if (!row_direction) return missing(m, self, "row_layout_direction");
    row_step = row_spacing->nominal_mm * about.direction_to_parent(*row_direction);
  }
  const Vec3 column_step = spacing->nominal_mm * about.direction_to_parent(*along);
  std::vector<Placement> out;
  for (std::int64_t i = 0; i < rows; ++i) {
    for (std::int64_t j = 0; j < columns; ++j) {
      bool left_out = false;
      for (std::size_t k = 0; k < r.missing_base_feature.size(); ++k) {
        const auto* o = m.get<RectangularOmit>(r.missing_base_feature[k]);
        left_out = left_out || (o != nullptr && o->row_index == i + 1 && o->column_index == j + 1);
      }
      if (left_out) continue;
      Vec3 by = static_cast<double>(i) * row_step + static_cast<double>(j) * column_step;
      for (std::size_t k = 0; k < r.relocated_base_feature.size(); ++k) {
        const auto* o = m.get<RectangularOffset>(r.relocated_base_feature[k]);
        if (o == nullptr || o->row_index != i + 1 || o->column_index != j + 1) continue;
        if (const auto d = direction(m, o->offset_direction))
          by = by + o->offset_distance.value_or(0.0) * about.direction_to_parent(*d);
      }
      out.push_back(shifted(base, by));
    }
  }
  return out;
}

/// Whether all of a feature is round about its axis, so that turning it about that makes no other.
bool all_round(const Shapes& shapes, const Placement& base) {
  return std::all_of(shapes.begin(), shapes.end(), [&](const FeatureShape& s) {
    const Vec3 off = base.to_local(s.frame.origin);
    return has(s.kind, ShapeTrait::kRound) && std::hypot(off.x, off.y) < kSamePlace;
  });
}

bool same_member(const Placement& a, const Placement& b, bool round) {
  return round ? norm(a.origin - b.origin) < kSamePlace && norm(a.z - b.z) < kSamePlace : same(a, b);
}

/// The base where it is, and one more at each location that is not taken. A location is the base's frame, as
/// the pattern sees it.
Result<std::vector<Placement>> members(const Model& m, const GeneralPattern& g, const Placement& about,
                                       const Placement& base, bool round) {
  std::vector<Placement> out{base};
  for (std::size_t i = 0; i < g.replicate_locations.size(); ++i) {
    const auto at = placement(m, g.replicate_locations[i]);
    if (!at) return tl::unexpected(at.error());
    const Placement there = compose(about, *at);
    const bool taken =
        std::any_of(out.begin(), out.end(), [&](const Placement& p) { return same_member(p, there, round); });
    if (!taken) out.push_back(there);
  }
  return out;
}

/// Removes members at the place of another: they would be cut in air. Fails if all are at one place, which is
/// a slip of the pen.
Status each_once(const Model& m, AnyRef self, std::vector<Placement>& frames, bool round,
                 std::string& assumed) {
  // Sorted by a sum in which few places are as near to each other as one place is to itself.
  std::vector<std::pair<double, std::size_t>> order;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const Vec3& p = frames[i].origin;
    order.emplace_back(p.x + 1.618 * p.y + 2.718 * p.z, i);
  }
  std::sort(order.begin(), order.end());
  std::vector<bool> again(frames.size());
  for (std::size_t i = 0; i < order.size(); ++i) {
    for (std::size_t k = i; k-- > 0 && order[i].first - order[k].first < 6.0 * kSamePlace;) {
      const auto [a, b] = std::minmax(order[i].second, order[k].second);
      again[b] = again[b] || same_member(frames[a], frames[b], round);
    }
  }
  std::vector<Placement> out;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!again[i]) out.push_back(frames[i]);
  }
  const std::size_t n = frames.size();
  if (out.size() == n) return {};
  if (out.size() == 1)
    return unsupported(
        m, self,
        "all of its " + std::to_string(n) + " members stand at one place; look at its angle or spacing");
  const std::string text = std::to_string(n - out.size()) + " of its " + std::to_string(n) +
                           " members stand where others do; each place is cut once";
  assumed += (assumed.empty() ? "" : "; ") + text;
  frames = std::move(out);
  return {};
}

/// How the base of a circular pattern is moved out to the circle that the pattern states.
Placement on_circle(const Model& m, const CircularPattern& c, const Placement& about, const Placement& base,
                    std::string& assumed) {
  const auto d = length(m, c.base_feature_diameter);
  if (!d || !(d->nominal_mm > 0.0)) return base;
  const Vec3 local = about.to_local(base.origin);
  const double r = std::hypot(local.x, local.y);
  char text[160];
  if (r < kSamePlace) {
    std::snprintf(text, sizeof text,
                  "its base stands on the pattern's axis; moved along x to base_feature_diameter, %.6g mm",
                  d->nominal_mm);
    assumed = text;
    return shifted(base, 0.5 * d->nominal_mm * about.x);
  }
  if (std::abs(2.0 * r - d->nominal_mm) > kSameCircle) {
    std::snprintf(
        text, sizeof text,
        "base_feature_diameter is %.6g mm, but its base stands on a circle of %.6g mm; that is taken",
        d->nominal_mm, 2.0 * r);
    assumed = text;
  }
  return base;
}

}  // namespace

Result<std::vector<Placement>> pattern_frames(const Model& m, AnyRef self, const Shapes& basis,
                                              const PatternFrames& in, std::string& assumed) {
  Placement base = in.stands;
  Result<std::vector<Placement>> frames = unsupported(m, self, "is a pattern that is not understood");
  if (const auto* c = m.get<CircularPattern>(self)) {
    base = on_circle(m, *c, in.about, in.stands, assumed);
    frames = members(m, self, *c, in.about, base);
  } else if (const auto* p = m.get<RectangularPattern>(self)) {
    frames = members(m, self, *p, in.about, base);
  } else if (const auto* g = m.get<GeneralPattern>(self)) {
    frames = members(m, *g, in.locations, base, all_round(basis, base));
  }
  if (!frames) return frames;
  if (frames->size() > kMaxCopies / basis.size())
    return unsupported(m, self, "would be more than 100,000 copies");
  if (auto ok = each_once(m, self, *frames, all_round(basis, base), assumed); !ok)
    return tl::unexpected(ok.error());
  return frames;
}

}  // namespace capstan::model::shape
