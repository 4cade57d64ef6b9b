#include "planner/making/sequence/precedence.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

// What must precede what. Each feature is seen from its side: heights along the side's axis, a box across it.
// Pairs whose boxes meet are compared by kind and height (`precedes`), and then by their areas, which cost
// more. The chain of a feature's own operations and what the caller gives are added; wishes, at last, only
// where they close no circle.

namespace capstan::sequence {
namespace {

using geometry::Vec2;
using geometry::Vec3;
using model::FeatureShape;
using model::ShapeKind;

constexpr double kLevel = 1e-6;  // mm: heights that count as one

std::size_t find_or_add(std::vector<Vec3>& directions, Vec3 z) {
  for (std::size_t i = 0; i < directions.size(); ++i) {
    if (norm(directions[i] - z) <= kSameDirection) return i;
  }
  directions.push_back(z);
  return directions.size() - 1;
}

bool either_side(const FeatureShape& s) {
  return s.through && s.kind == ShapeKind::kHole &&
         std::abs(s.diameter.nominal_mm - s.bottom_diameter_mm) < kLevel;
}

/// A feature as its side sees it: heights along the side's direction, a box across it.
struct Seen {
  std::size_t feature = 0;
  double top = 0.0, bottom = 0.0;
  geometry::Box2 box;
  std::vector<Vec2> outline;  // a few points of the area, the middle of its box first
};

Seen see(const FeatureShape& s, std::size_t feature, const geometry::Placement& side) {
  constexpr std::size_t kOutline = 16;
  Seen out;
  out.feature = feature;
  const double a = side.to_local(s.frame.origin).z;
  const double b = side.to_local(s.frame.origin - s.depth_mm * s.frame.z).z;
  out.top = std::max(a, b);
  out.bottom = std::min(a, b);
  const auto in_side = [&](Vec2 p) { return xy(side.to_local(s.frame.to_parent({p.x, p.y, 0.0}))); };
  std::size_t points = 0;
  for (const auto& loop : s.area.loops) points += loop.size();
  const std::size_t stride = points / kOutline + 1;
  std::size_t at = 0;
  for (const auto& loop : s.area.loops) {
    for (const Vec2 p : loop) {
      const Vec2 q = in_side(p);
      out.box.lo = {std::min(out.box.lo.x, q.x), std::min(out.box.lo.y, q.y)};
      out.box.hi = {std::max(out.box.hi.x, q.x), std::max(out.box.hi.y, q.y)};
      if (at++ % stride == 0) out.outline.push_back(q);
    }
  }
  if (points > 0) out.outline.insert(out.outline.begin(), 0.5 * (out.box.lo + out.box.hi));
  return out;
}

bool overlap(const geometry::Box2& a, const geometry::Box2& b) {
  return a.lo.x <= b.hi.x && b.lo.x <= a.hi.x && a.lo.y <= b.hi.y && b.lo.y <= a.hi.y;
}

/// Not along a side only.
bool across(const geometry::Box2& a, const geometry::Box2& b) {
  return a.lo.x < b.hi.x - kLevel && b.lo.x < a.hi.x - kLevel && a.lo.y < b.hi.y - kLevel &&
         b.lo.y < a.hi.y - kLevel;
}

/// Whether some of b's outline lies in a's area, or the other way round.
bool meet(const FeatureShape& fa, const Seen& a, const FeatureShape& fb, const Seen& b,
          const geometry::Placement& side) {
  const auto any_in = [&](const FeatureShape& f, const std::vector<Vec2>& points) {
    return std::any_of(points.begin(), points.end(), [&](Vec2 p) {
      return geometry::contains(f.area, xy(f.frame.to_local(side.to_parent({p.x, p.y, 0.0}))));
    });
  };
  return any_in(fa, b.outline) || any_in(fb, a.outline);
}

/// Whether a comes before b by their kinds and heights alone; areas are looked at afterwards, for they cost
/// more.
///
/// Never both ways: an edge or a thread follows what it is on, a face precedes others from its top down and
/// deeper faces from its top, and for all else the top of `after` lies below that of `before`.
bool precedes(const FeatureShape& a, const Seen& sa, const FeatureShape& b, const Seen& sb, Cause& cause) {
  if (!model::has(a.kind, model::ShapeTrait::kFloor)) return false;
  const bool reached = sb.top >= sa.bottom - kLevel;
  if (model::has(b.kind, model::ShapeTrait::kEdge)) {
    cause = a.kind == ShapeKind::kFace ? Cause::kFaceFirst : Cause::kEdge;
    return reached && (a.kind == ShapeKind::kFace || std::abs(sa.top - sb.top) <= kLevel);
  }
  if (b.kind == ShapeKind::kThread && a.kind == ShapeKind::kHole) {
    cause = Cause::kThread;
    return norm(xy(a.frame.to_local(b.frame.origin))) <= kLevel && sb.top > sa.bottom;
  }
  if (a.kind == ShapeKind::kFace && b.kind != ShapeKind::kFace) {
    cause = Cause::kFaceFirst;
    return reached && sb.top <= sa.top + kLevel;
  }
  // Two faces that begin at one height: what the deeper one takes lies in the other where they overlap.
  if (a.kind == ShapeKind::kFace && std::abs(sa.top - sb.top) <= kLevel && across(sa.box, sb.box)) {
    cause = Cause::kFaceFirst;
    return sb.bottom < sa.bottom - kLevel;
  }
  if (b.kind == ShapeKind::kFace && a.kind != ShapeKind::kFace && sb.top >= sa.top - kLevel) return false;
  cause = a.kind == ShapeKind::kFace ? Cause::kFaceFirst : Cause::kLiesIn;
  return reached && sb.top < sa.top - kLevel;
}

/// Whether `to` comes after `from` by the edges so far.
bool follows(const std::vector<std::vector<std::size_t>>& next, std::size_t from, std::size_t to) {
  std::vector<bool> seen(next.size());
  std::vector<std::size_t> pending{from};
  while (!pending.empty()) {
    const std::size_t at = pending.back();
    pending.pop_back();
    if (at == to) return true;
    if (seen[at]) continue;
    seen[at] = true;
    pending.insert(pending.end(), next[at].begin(), next[at].end());
  }
  return false;
}

/// Wishes that contradict nothing that is there already, in their order.
void add_wishes(const std::vector<Wish>& wishes, const std::vector<std::vector<std::size_t>>& chains,
                std::size_t items, std::vector<Precedence>& out, std::vector<Precedence>& dropped) {
  std::vector<std::vector<std::size_t>> next(items);
  for (const Precedence& p : out) next[p.before].push_back(p.after);
  std::set<std::pair<std::size_t, std::size_t>> known;
  for (const Wish& w : wishes) {
    if (w.before == w.after || chains[w.before].empty() || chains[w.after].empty()) continue;
    const std::size_t a = chains[w.before].back();
    const std::size_t b = chains[w.after].front();
    if (!known.emplace(a, b).second) continue;
    const bool against = follows(next, b, a);
    (against ? dropped : out).push_back({a, b, Cause::kDatum, w.text});
    if (!against) next[a].push_back(b);
  }
}

std::string label(const FeatureShape& s, std::size_t i) {
  const std::string name = s.name.empty() ? "number " + std::to_string(i) : "'" + s.name + "'";
  return std::string(model::to_text(s.kind)) + " " + name;
}

std::string words(const std::vector<FeatureShape>& shapes, const FeaturePair& p) {
  const std::string a = label(shapes[p.before], p.before);
  const std::string b = label(shapes[p.after], p.after);
  switch (p.cause) {
    case Cause::kFaceFirst:
      return a + " is the surface in which " + b + " begins";
    case Cause::kLiesIn:
      return b + " begins within or at the floor of " + a;
    case Cause::kThread:
      return b + " is cut into " + a;
    case Cause::kEdge:
      return b + " breaks the edge of " + a;
    default:
      return a + " before " + b;
  }
}

}  // namespace

Access access_of(const std::vector<FeatureShape>& shapes, const Options& options) {
  Access out;
  out.of_feature.resize(shapes.size());
  for (const Vec3 d : options.directions) find_or_add(out.directions, normalised(d));
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!either_side(shapes[i])) out.of_feature[i] = find_or_add(out.directions, shapes[i].frame.z);
  }
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!either_side(shapes[i])) continue;
    const Vec3 z = shapes[i].frame.z;
    std::size_t own = 0, other = 0;
    while (own < out.directions.size() && norm(out.directions[own] - z) > kSameDirection) ++own;
    while (other < out.directions.size() && norm(out.directions[other] + z) > kSameDirection) ++other;
    if (own == out.directions.size() && other < out.directions.size()) {
      out.of_feature[i] = other;
    } else {
      out.of_feature[i] = find_or_add(out.directions, z);
    }
  }
  return out;
}

std::vector<FeaturePair> geometric_pairs(const std::vector<FeatureShape>& shapes, const Access& access) {
  std::vector<std::vector<Seen>> sides(access.directions.size());
  std::vector<geometry::Placement> frames;
  for (const Vec3 d : access.directions) {
    // x across d: from the axis that d is farthest from.
    const Vec3 helper = std::abs(d.z) > 0.9 ? Vec3{1.0, 0.0, 0.0} : Vec3{0.0, 0.0, 1.0};
    const Vec3 x = normalised(helper - dot(helper, d) * d);
    frames.push_back({{}, x, cross(d, x), d});
  }
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const std::size_t side = access.of_feature[i];
    if (!shapes[i].area.empty()) sides[side].push_back(see(shapes[i], i, frames[side]));
  }
  std::vector<FeaturePair> out;
  for (std::size_t side = 0; side < sides.size(); ++side) {
    auto& seen = sides[side];
    std::sort(seen.begin(), seen.end(), [](const Seen& a, const Seen& b) {
      return a.box.lo.x != b.box.lo.x ? a.box.lo.x < b.box.lo.x : a.feature < b.feature;
    });
    for (std::size_t i = 0; i < seen.size(); ++i) {
      for (std::size_t k = i + 1; k < seen.size() && seen[k].box.lo.x <= seen[i].box.hi.x; ++k) {
        if (!overlap(seen[i].box, seen[k].box)) continue;
        for (const auto& [a, b] : {std::pair(i, k), std::pair(k, i)}) {
          const FeatureShape& fa = shapes[seen[a].feature];
          const FeatureShape& fb = shapes[seen[b].feature];
          Cause cause = Cause::kLiesIn;
          if (!precedes(fa, seen[a], fb, seen[b], cause) || !meet(fa, seen[a], fb, seen[b], frames[side]))
            continue;
          out.push_back({seen[a].feature, seen[b].feature, cause});
          break;
        }
      }
    }
  }
  std::sort(out.begin(), out.end(), [](const FeaturePair& a, const FeaturePair& b) {
    return a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  return out;
}

std::vector<Precedence> all_precedences(const std::vector<FeatureShape>& shapes,
                                        const std::vector<Item>& items, const Options& options,
                                        const Access& access, std::vector<Precedence>& dropped) {
  std::vector<Precedence> out;
  std::vector<std::vector<std::size_t>> chains(shapes.size());
  for (std::size_t i = 0; i < items.size(); ++i) chains[items[i].feature].push_back(i);
  for (auto& chain : chains) {
    std::stable_sort(chain.begin(), chain.end(),
                     [&](std::size_t a, std::size_t b) { return items[a].in_chain < items[b].in_chain; });
    for (std::size_t i = 1; i < chain.size(); ++i)
      out.push_back({chain[i - 1], chain[i], Cause::kChain,
                     "the chain of " + label(shapes[items[chain[i]].feature], items[chain[i]].feature)});
  }
  std::set<std::pair<std::size_t, std::size_t>> given;
  for (const auto& [a, b] : options.given) {
    out.push_back({a, b, Cause::kGiven, "'" + items[a].name + "' is given before '" + items[b].name + "'"});
    given.emplace(items[a].feature, items[b].feature);
  }
  for (const FeaturePair& p : geometric_pairs(shapes, access)) {
    if (chains[p.before].empty() || chains[p.after].empty()) continue;
    Precedence edge{chains[p.before].back(), chains[p.after].front(), p.cause, words(shapes, p)};
    (given.contains({p.after, p.before}) ? dropped : out).push_back(std::move(edge));
  }
  add_wishes(options.wishes, chains, items.size(), out, dropped);
  std::stable_sort(out.begin(), out.end(), [](const Precedence& a, const Precedence& b) {
    return a.before != b.before ? a.before < b.before : a.after < b.after;
  });
  return out;
}

}  // namespace capstan::sequence
