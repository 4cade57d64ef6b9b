#include <algorithm>
#include <array>
#include <cmath>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/reading.h"

// Where features stand. An element is placed in the coordinates of its compound, the base of a pattern and
// its locations in those of the pattern, and so on through what is nested. Files also place them in the
// workpiece: that is read only where the standard's way puts one of them beside or below the raw piece, and
// the other way puts all of them into it. Threads and edges stand where the feature is that they are on.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Model;

namespace {

constexpr int kDeepest = 8;  ///< patterns of compounds of patterns
constexpr std::int64_t kMostCopies = 100000;
constexpr std::size_t kMostPlaces = 1000;  ///< in which one element is listed
constexpr double kOn = 0.01;  ///< mm over an edge of the raw piece that count as on it; default, unsourced
constexpr double kSame = 1e-6;

/// The coordinates in which something is stated.
struct Within {
  Placement frame;
  AnyRef holder;
  int depth = 0;
  bool strict = false;  ///< only as the standard has it
};

bool on_another(const Model& m, AnyRef f) {
  return m.holds<model::Thread>(f) || m.holds<model::TransitionFeature>(f);
}

std::optional<Placement> own_frame(const Model& m, AnyRef f) {
  const auto* placed = m.get<model::Two5dManufacturingFeature>(f);
  return placed == nullptr ? Placement{} : frame_or_same(m, placed->feature_placement);
}

bool same_place(const Placement& a, const Placement& b) {
  return norm(a.origin - b.origin) < kSame && norm(a.x - b.x) < kSame && norm(a.z - b.z) < kSame;
}

bool in_box(const Box3& box, Vec3 p) {
  return p.x > box.lo.x - kOn && p.x < box.hi.x + kOn && p.y > box.lo.y - kOn && p.y < box.hi.y + kOn &&
         p.z > box.lo.z - kOn && p.z < box.hi.z + kOn;
}

/// The middle of a solid in plan, its frame; of what goes on for ever that of its walls.
Vec2 middle(const Solid& s) {
  const auto* area = std::get_if<Area>(&s.form);
  if (area == nullptr || !(area->only_mm > 0.0)) {
    const Box3 box = s.box();
    return 0.5 * (xy(box.lo) + xy(box.hi));
  }
  Outline walls;
  for (const Edge& e : area->outline.edges) {
    if (!e.open) walls.add(e);
  }
  return 0.5 * (walls.lo + walls.hi);
}

/// Whether the middle line of a solid, from its top to its floor, meets the raw piece anywhere.
bool meets(const Box3& raw, const Solid& s, bool by_its_top) {
  if (raw.empty()) return true;
  const auto [x, y] = middle(s);
  if (by_its_top) return in_box(raw, s.frame.to_parent({x, y, 0.0}));
  const Vec3 top = s.frame.to_parent({x, y, 0.0}),
             floor = s.frame.to_parent({x, y, -std::max(s.depth_mm, kOn)});
  // Halved from the outside in: the part of the line that lies between each pair of sides.
  double from = 0.0, to = 1.0;
  for (const auto& [a, b, lo, hi] : {std::array{top.x, floor.x, raw.lo.x - kOn, raw.hi.x + kOn},
                                     std::array{top.y, floor.y, raw.lo.y - kOn, raw.hi.y + kOn},
                                     std::array{top.z, floor.z, raw.lo.z - kOn, raw.hi.z + kOn}}) {
    if (std::abs(b - a) < 1e-9) {
      if (a < lo || a > hi) return false;
      continue;
    }
    const double t0 = (lo - a) / (b - a), t1 = (hi - a) / (b - a);
    from = std::max(from, std::min(t0, t1));
    to = std::min(to, std::max(t0, t1));
  }
  return from < to;
}

/// Whether the raw piece holds all that a solid opens at its top.
bool holds(const Box3& raw, const Solid& s) {
  if (!meets(raw, s, true)) return false;
  const auto* area = std::get_if<Area>(&s.form);
  if (area != nullptr && (area->around || area->overhead || area->only_mm > 0.0)) return true;
  const Box3 box = s.box();
  for (const double x : {box.lo.x, box.hi.x}) {
    for (const double y : {box.lo.y, box.hi.y}) {
      Vec3 p = s.frame.to_parent({x, y, 0.0});
      // How deep it may go is not what is asked.
      const Vec3 z = s.frame.z;
      if (std::abs(z.x) > 0.5) p.x = raw.lo.x;
      if (std::abs(z.y) > 0.5) p.y = raw.lo.y;
      if (std::abs(z.z) > 0.5) p.z = raw.lo.z;
      if (!in_box(raw, p)) return false;
    }
  }
  return true;
}

Reading expand(const Source& source, AnyRef feature, const Within& in);
Reading everywhere(const Source& source, AnyRef feature, int depth);

/// One way to read a compound or a pattern: the coordinates of its elements, and of its locations.
struct Way {
  Within elements;
  Placement locations;
};

struct Read {
  Reading reading;
  std::vector<Placement> stated;  ///< of its elements, as the file has them
  Within elements;                ///< the coordinates that were taken
};

template <class Build>
Read decided(const Source& source, AnyRef self, const Within& in, const Build& build) {
  const auto own = own_frame(source.m, self);
  if (!own) return {unread("its placement is none"), {}, in};
  const Placement here = compose(in.frame, *own);
  const auto within = [&](const Placement& f, bool strict) { return Within{f, self, in.depth + 1, strict}; };
  Read standard = build(Way{within(here, true), here});
  standard.elements = within(here, true);
  if (in.strict || !standard.reading.unread.empty() || source.raw.empty()) return standard;
  const bool repeats = std::any_of(standard.stated.begin(), standard.stated.end(), [&](const Placement& p) {
    return same_place(p, *own) && !same_place(p, Placement{});
  });
  const auto fits = [&](const Solid& s) {
    return meets(source.raw, s, false) && (!repeats || meets(source.raw, s, true));
  };
  const auto& solids = standard.reading.solids;
  if (std::all_of(solids.begin(), solids.end(), fits)) return standard;
  std::vector<Way> ways{{within(here, false), here}};
  if (!same_place(here, Placement{})) {
    ways.push_back({within(Placement{}, false), here});
    if (source.m.holds<model::GeneralPattern>(self)) {
      ways.push_back({within(Placement{}, false), Placement{}});
      ways.push_back({within(here, false), Placement{}});
    }
  }
  for (const Way& way : ways) {
    Read other = build(way);
    other.elements = way.elements;
    const auto& there = other.reading.solids;
    if (other.reading.unread.empty() &&
        std::all_of(there.begin(), there.end(), [&](const Solid& s) { return holds(source.raw, s); }) &&
        std::all_of(other.stated.begin(), other.stated.end(), [&](const Placement& p) {
          return in_box(source.raw, compose(way.elements.frame, p).origin);
        }))
      return other;
  }
  return standard;
}

Read compound(const Source& source, AnyRef self, const model::CompoundFeature& c, const Within& in) {
  return decided(source, self, in, [&](const Way& way) {
    Read out;
    if (c.elements.empty()) out.reading = unread("it has no elements");
    for (const AnyRef e : c.elements.items) {
      Reading part = expand(source, e, way.elements);
      if (!part.unread.empty()) {
        out.reading = unread("an element of it: " + part.unread);
        return out;
      }
      if (!on_another(source.m, e)) out.stated.push_back(own_frame(source.m, e).value_or(Placement{}));
      out.reading.solids.insert(out.reading.solids.end(), part.solids.begin(), part.solids.end());
      if (out.reading.solids.size() > static_cast<std::size_t>(kMostCopies)) {
        out.reading = unread("it has too many elements");
        return out;
      }
    }
    return out;
  });
}

template <class Entry, class Is>
bool listed(const Model& m, const model::RefList<Entry>& list, const Is& is) {
  return std::any_of(list.items.begin(), list.items.end(), [&](AnyRef r) {
    const auto* e = m.get<Entry>(r);
    return e != nullptr && is(*e);
  });
}

/// Where the members of a pattern have their base's frame. Empty: `fault` says why.
std::vector<Placement> members(const Model& m, AnyRef self, const Placement& pattern,
                               const Placement& locations, Placement base, std::string& fault) {
  std::vector<Placement> out;
  if (const auto* c = m.get<model::CircularPattern>(self)) {
    const auto n = c->number_of_feature.value_or(0);
    if (n < 1 || n > kMostCopies) fault = "its number of members cannot be";
    Vec3 at = pattern.to_local(base.origin);
    if (std::hypot(at.x, at.y) < kSame) {
      if (const auto d = size_of(m, c->base_feature_diameter))
        base.origin = base.origin + 0.5 * *d * pattern.x;
    }
    for (std::int64_t i = 1; fault.empty() && i <= n; ++i) {
      if (listed(m, c->missing_base_feature, [&](const auto& o) { return o.index == i; })) continue;
      double turn = static_cast<double>(i - 1) * c->angle_increment.value_or(0.0);
      for (const AnyRef r : c->relocated_base_feature.items) {
        const auto* o = m.get<model::CircularOffset>(r);
        if (o != nullptr && o->index == i) turn += o->angular_offset.value_or(0.0);
      }
      const double cs = std::cos(turn), sn = std::sin(turn);
      const auto turned = [&](Vec3 v) {  // about the pattern's axis
        const Vec3 l = pattern.direction_to_local(v);
        return pattern.direction_to_parent({cs * l.x - sn * l.y, sn * l.x + cs * l.y, l.z});
      };
      out.push_back({pattern.origin + turned(base.origin - pattern.origin), turned(base.x), turned(base.y),
                     turned(base.z)});
    }
    return out;
  }
  if (const auto* r = m.get<model::RectangularPattern>(self)) {
    const auto rows = r->number_of_rows.value_or(1), columns = r->number_of_columns.value_or(0);
    const auto step = size_of(m, r->spacing);
    const auto along = unit_of(m, r->its_direction);
    const auto row_step = size_of(m, r->row_spacing);
    const auto across = unit_of(m, r->row_layout_direction);
    if (rows < 1 || columns < 1 || rows > kMostCopies || columns > kMostCopies / rows || !step || !along ||
        (rows > 1 && (!row_step || !across)))
      fault = "its rows and columns cannot be laid out";
    for (std::int64_t i = 1; fault.empty() && i <= rows; ++i) {
      for (std::int64_t k = 1; k <= columns; ++k) {
        const auto here = [&](const auto& o) { return o.row_index == i && o.column_index == k; };
        if (listed(m, r->missing_base_feature, here)) continue;
        Vec3 way = (static_cast<double>(k - 1) * *step) * *along;
        if (i > 1) way = way + (static_cast<double>(i - 1) * *row_step) * *across;
        for (const AnyRef by : r->relocated_base_feature.items) {
          const auto* o = m.get<model::RectangularOffset>(by);
          const auto d = o != nullptr && here(*o) ? unit_of(m, o->offset_direction) : std::nullopt;
          if (d) way = way + o->offset_distance.value_or(0.0) * *d;
        }
        Placement p = base;
        p.origin = p.origin + pattern.direction_to_parent(way);
        out.push_back(p);
      }
    }
    return out;
  }
  const auto* g = m.get<model::GeneralPattern>(self);
  if (g == nullptr) {
    fault = "it is a pattern of a kind that this reading does not know";
    return out;
  }
  out.push_back(base);
  for (const AnyRef r : g->replicate_locations.items) {
    const auto at = frame_of(m, r);
    if (!at) {
      fault = "a location of it is none";
      return {};
    }
    out.push_back(compose(locations, *at));
  }
  return out;
}

Read pattern(const Source& source, AnyRef self, const model::ReplicateFeature& p, const Within& in) {
  const Model& m = source.m;
  return decided(source, self, in, [&](const Way& way) {
    Read out;
    const AnyRef base = p.replicate_base_feature;
    const Reading one = expand(source, base, way.elements);
    const auto own = own_frame(m, base), self_frame = own_frame(m, self);
    if (!one.unread.empty() || one.solids.empty() || !own || !self_frame) {
      out.reading =
          unread("its base: " + (one.unread.empty() ? std::string("it has no volume") : one.unread));
      return out;
    }
    const bool placed = !on_another(m, base);
    const Placement stands = placed ? compose(way.elements.frame, *own) : one.solids.front().frame;
    if (placed) out.stated.push_back(*own);
    std::string fault;
    const auto* turned = m.get<model::CircularPattern>(self);
    if (turned != nullptr && std::abs(turned->base_feature_rotation.value_or(0.0)) > kSame &&
        !std::all_of(one.solids.begin(), one.solids.end(),
                     [](const Solid& s) { return std::holds_alternative<Bore>(s.form); })) {
      out.reading = unread("its base_feature_rotation turns what is not round, and about what nobody says");
      return out;
    }
    const auto frames = members(m, self, compose(in.frame, *self_frame), way.locations, stands, fault);
    if (frames.size() > static_cast<std::size_t>(kMostCopies) / one.solids.size())
      fault = "it has too many members";
    if (!fault.empty()) {
      out.reading = unread(fault);
      return out;
    }
    const Placement back = inverse(stands);
    for (const Placement& there : frames) {
      for (Solid s : one.solids) {
        s.frame = compose(there, compose(back, s.frame));
        out.reading.solids.push_back(std::move(s));
      }
    }
    return out;
  });
}

Reading expand(const Source& source, AnyRef f, const Within& in) {
  const Model& m = source.m;
  if (in.depth > kDeepest) return unread("it is nested in itself, or too deeply");
  if (const auto* c = m.get<model::CompoundFeature>(f)) return compound(source, f, *c, in).reading;
  if (const auto* p = m.get<model::ReplicateFeature>(f)) return pattern(source, f, *p, in).reading;
  if (on_another(m, f)) {
    AnyRef other;
    if (const auto* t = m.get<model::Thread>(f)) {
      if (!t->applied_shape.empty()) other = t->applied_shape[0];
    }
    if (const auto* t = m.get<model::TransitionFeature>(f)) other = t->first_feature;
    if (!other.set()) return unread("it does not say what it is on");
    const auto by = source.in.find(other);
    const bool together = in.holder.set() && by != source.in.end() &&
                          std::find(by->second.begin(), by->second.end(), in.holder) != by->second.end();
    Within deeper = in;
    ++deeper.depth;
    return on_others(source, f,
                     together ? expand(source, other, deeper) : everywhere(source, other, in.depth + 1));
  }
  Reading out = simple(source, f);
  for (Solid& s : out.solids) s.frame = compose(in.frame, s.frame);
  return out;
}

/// The coordinates that a feature is stated in, once for each place where it is listed; none: it is nested in
/// itself, or too deeply.
std::vector<Within> coordinates(const Source& source, AnyRef f, int depth) {
  const auto by = source.in.find(f);
  if (by == source.in.end()) return {{{}, {}, depth, false}};
  std::vector<Within> out;
  if (depth > kDeepest) return out;
  for (const AnyRef holder : by->second) {
    const auto outer = coordinates(source, holder, depth + 1);
    if (outer.empty()) return {};
    for (const Within& w : outer) {
      if (const auto* c = source.m.get<model::CompoundFeature>(holder)) {
        out.push_back(compound(source, holder, *c, w).elements);
      } else if (const auto* p = source.m.get<model::ReplicateFeature>(holder)) {
        out.push_back(pattern(source, holder, *p, w).elements);
      } else {
        out.push_back(w);  // a boss stands in the coordinates of what lists it
      }
      if (out.size() > kMostPlaces) return {};
    }
  }
  return out;
}

Reading everywhere(const Source& source, AnyRef f, int depth) {
  const auto places = coordinates(source, f, depth);
  if (depth > kDeepest || places.empty()) return unread("it is nested in itself, or too deeply");
  Reading out;
  for (const Within& w : places) {
    Reading part = expand(source, f, w);
    if (!part.unread.empty()) return part;
    out.nothing = part.nothing;
    out.solids.insert(out.solids.end(), part.solids.begin(), part.solids.end());
  }
  return out;
}

}  // namespace

Reading placed_in(const Source& source, AnyRef feature) { return expand(source, feature, {}); }

Reading wherever(const Source& source, AnyRef feature) { return everywhere(source, feature, 0); }

}  // namespace capstan::verify::volumes
