#include <algorithm>
#include <cmath>
#include <map>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/reading.h"

// What stands: bosses. A boss stays whichever feature is cut around it, with each copy of what lists it. And
// the frame and the depth that every simple feature has.

namespace capstan::verify::volumes {

using geometry::Box3;
using geometry::Placement;
using geometry::Vec2;
using geometry::Vec3;
using model::AnyRef;
using model::Model;

namespace {

constexpr int kDeepest = 8;   ///< patterns of compounds of patterns
constexpr double kOn = 0.01;  ///< mm beside an edge that count as on it; default, unsourced
constexpr double kSame = 1e-6;

/// A boss stands in what is cut around it: in a face or an outside wherever it is, in a pocket or a step
/// where that holds the whole of it. One whose top is not above the floor, or that begins above the feature,
/// does not.
void spare(const Source& source, Solid& s) {
  auto* area = std::get_if<Area>(&s.form);
  if (area == nullptr) return;
  const bool all_of_it = source.m.holds<model::Pocket>(s.noun) || source.m.holds<model::Step>(s.noun);
  for (const Solid& b : source.bosses) {
    const auto& form = std::get<Area>(b.form);
    const Placement rel = compose(inverse(s.frame), b.frame);
    if (rel.z.z < 1.0 - kSame) continue;
    const double top = rel.origin.z, foot = top - b.depth_mm;
    if (top <= -s.depth_mm + kSame || foot >= -kSame) continue;
    if (b.noun == s.noun && norm(rel.origin) < kSame) continue;
    const bool own = std::any_of(area->standing.begin(), area->standing.end(), [&](const Standing& x) {
      return x.boss == b.noun && norm(x.outline.edges.front().from -
                                      xy(rel.to_parent({form.outline.edges.front().from.x,
                                                        form.outline.edges.front().from.y, 0.0}))) < 1e-3;
    });
    if (own) continue;
    Course c;
    c.edges = form.outline.edges;
    c = moved(c, rel);
    Standing x;
    x.boss = b.noun;
    for (const Edge& e : c.edges) x.outline.add(e);
    x.top_mm = top;
    x.leaning_mm = form.leaning_mm;
    const auto* stated = source.m.get<model::Boss>(b.noun);
    x.foot_radius_mm =
        stated != nullptr && stated->fillet_radius.set() ? form.foot_radius_mm : area->foot_radius_mm;
    if (all_of_it) {
      // A boss that ends at the wall lies in the area, too.
      const bool held = std::all_of(x.outline.edges.begin(), x.outline.edges.end(), [&](const Edge& e) {
        for (const double share : {0.0, 0.5}) {
          const Vec2 q = e.at(share);
          if (!inside(area->outline, q) && nearest(area->outline, q).distance_mm > kOn) return false;
        }
        return true;
      });
      if (!held) continue;
    }
    area->standing.push_back(std::move(x));
  }
}

const model::RefList<model::Boss>* bosses_in(const Model& m, AnyRef f) {
  if (const auto* p = m.get<model::Pocket>(f)) return &p->its_boss;
  if (const auto* p = m.get<model::PlanarFace>(f)) return &p->its_boss;
  if (const auto* p = m.get<model::Step>(f)) return &p->its_boss;
  return nullptr;
}

/// The outermost compounds and patterns that bring a feature; none: itself.
void outermost(const Source& source, AnyRef f, int depth, std::vector<AnyRef>& out) {
  const auto by = source.in.find(f);
  bool held = false;
  if (by != source.in.end() && depth <= kDeepest) {
    for (const AnyRef h : by->second) {
      if (!source.m.holds<model::CompoundFeature>(h) && !source.m.holds<model::ReplicateFeature>(h)) continue;
      held = true;
      outermost(source, h, depth + 1, out);
    }
  }
  if (!held && std::find(out.begin(), out.end(), f) == out.end()) out.push_back(f);
}

/// All places where a boss stands: with each copy of what lists it, and of itself.
void stand_everywhere(const Source& source, AnyRef boss, std::vector<Solid>& out) {
  const Model& m = source.m;
  Reading one = simple(source, boss);
  const auto own = frame_or_same(m, m.get<model::Boss>(boss)->feature_placement);
  if (!one.unread.empty() || !own) return;
  const Placement raised = compose(inverse(*own), one.solids.front().frame);
  std::vector<AnyRef> bringers{boss};
  if (const auto by = source.in.find(boss); by != source.in.end()) {
    for (const AnyRef h : by->second) {
      if (bosses_in(m, h) != nullptr) bringers.push_back(h);
    }
  }
  const bool alone = bringers.size() == 1;
  for (const AnyRef y : bringers) {
    const auto* placed = m.get<model::Two5dManufacturingFeature>(y);
    const auto frame = placed == nullptr ? std::nullopt : frame_or_same(m, placed->feature_placement);
    std::vector<AnyRef> tops;
    outermost(source, y, 0, tops);
    for (const AnyRef top : tops) {
      if (!frame || (top == y && y == boss && !alone)) continue;
      const auto put = [&](const Placement& there) {
        Solid s = one.solids.front();
        s.frame = compose(compose(there, compose(inverse(*frame), *own)), raised);
        out.push_back(std::move(s));
      };
      if (top == y) {
        put(*frame);
        continue;
      }
      for (const Solid& s : placed_in(source, top).solids) {
        if (s.noun == y) put(s.frame);
      }
    }
  }
}

}  // namespace

PointState Reading::at(Vec3 p) const {
  PointState out = PointState::kStays;
  for (const Solid& s : solids) {
    const PointState said = s.at(s.frame.to_local(p));
    if (said == PointState::kRemoved) return said;
    if (said == PointState::kNotStated) out = said;
  }
  return out;
}

Reading simple(const Source& source, AnyRef f) {
  const Model& m = source.m;
  if (m.holds<model::Region>(f) || m.holds<model::ToolpathFeature>(f)) return {{}, {}, true};
  const auto* machined = m.get<model::MachiningFeature>(f);
  if (machined == nullptr) return unread("it is of a kind that this reading does not know");
  if (m.holds<model::SphericalCap>(f) || m.holds<model::RoundedEnd>(f))
    return unread("what of it stays and what goes the standard does not say in numbers");
  Solid s;
  s.noun = f;
  const auto frame = frame_or_same(m, machined->feature_placement);
  if (!frame) return unread("its placement is none");
  s.frame = *frame;
  std::optional<double> deep = size_of(m, machined->depth);
  const AnyRef at = machined->depth;
  if (const auto* surface = m.get<model::ElementarySurface>(at)) {
    const auto plane = frame_of(m, surface->position);
    if (!plane || m.holds<model::SphericalSurface>(at)) return unread("its depth is no plane");
    if (std::abs(std::abs(plane->z.z) - 1.0) > 1e-9) return unread("its depth is tilted");
    deep = -plane->origin.z;
  }
  if (const auto* p = m.get<model::ProfileFeature>(f); p != nullptr && !deep) {
    const auto* way = m.get<model::LinearPath>(p->profile_swept_shape);
    if (way != nullptr) deep = size_of(m, way->distance);
  }
  const bool boss = m.holds<model::Boss>(f);
  constexpr double kAnyHeight = 1e6;
  if (boss && !deep) deep = kAnyHeight;
  if (!deep) return unread("it has no depth");
  // A boss that is drawn at its foot: its top lies as much higher.
  if (boss && *deep < 0.0) {
    s.frame.origin = s.frame.to_parent({0.0, 0.0, -*deep});
    deep = -*deep;
  }
  if (*deep < 0.0) return unread("its depth lies above its placement");
  s.depth_mm = *deep;
  if (const ReadingRow* row = reading_of(f)) return row->read(source, f, std::move(s));
  return unread("it is of a kind that this reading does not know");
}

const ReadingRow* reading_of(AnyRef feature) {
  static const std::map<model::TypeId, ReadingRow> kRows = [] {
    std::map<model::TypeId, ReadingRow> all;
    for (const std::vector<ReadingRow>& of_a_file : readings())
      for (const ReadingRow& row : of_a_file) all.emplace(row.noun, row);
    return all;
  }();
  if (!feature.set()) return nullptr;
  for (model::TypeId t = feature.type; t != model::TypeId::kNone; t = model::noun_type(t).parent)
    if (const auto it = kRows.find(t); it != kRows.end()) return &it->second;
  return nullptr;
}

Source source_of(const Model& m, const Box3& raw) {
  Source out{m, raw, {}, {}};
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature)) {
    if (const auto* c = m.get<model::CompoundFeature>(f)) {
      for (const AnyRef e : c->elements.items) out.in[e].push_back(f);
    }
    if (const auto* p = m.get<model::ReplicateFeature>(f)) out.in[p->replicate_base_feature].push_back(f);
    if (const auto* bosses = bosses_in(m, f)) {
      for (const AnyRef b : bosses->items) out.in[b].push_back(f);
    }
  }
  for (const AnyRef b : m.all(model::TypeId::kBoss)) stand_everywhere(out, b, out.bosses);
  return out;
}

std::set<AnyRef> parts_of_others(const Model& m) {
  std::set<AnyRef> out;
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature)) {
    if (const auto* bosses = bosses_in(m, f)) out.insert(bosses->items.begin(), bosses->items.end());
    if (const auto* c = m.get<model::CompoundFeature>(f))
      out.insert(c->elements.items.begin(), c->elements.items.end());
    if (const auto* p = m.get<model::ReplicateFeature>(f)) out.insert(p->replicate_base_feature);
  }
  out.erase(AnyRef{});
  return out;
}

Reading read(const Source& source, AnyRef feature) {
  Reading out = wherever(source, feature);
  for (Solid& s : out.solids) {
    spare(source, s);
    if (auto* a = std::get_if<Area>(&s.form)) {
      a->outline.sort();
      for (Standing& b : a->standing) b.outline.sort();
    }
    if (auto* b = std::get_if<Bevel>(&s.form)) b->outline.sort();
  }
  return out;
}

}  // namespace capstan::verify::volumes
