#include "planner/making/piece/rests.h"

#include <cmath>
#include <string>
#include <utility>

#include "planner/making/sequence/precedence.h"
#include "planner/model/features/shape.h"
#include "rules/rules.h"

// Which features need others to be made first. A feature that rests on an unplanned one is left out too: a
// tap would run into the solid, a pocket would begin in the material of a face. The relation is the one that
// orders the steps (sequence/precedence): of two features that meet, the upper comes first.

namespace capstan::piece {
namespace {

using model::AnyRef;
using model::FeatureShape;
using model::Model;
using model::Ref;
using model::ShapeKind;
using sequence::Cause;

constexpr double kSameMm = 1e-6;

/// Features of their own, each shape with the feature that workingsteps name.
struct Shaped {
  std::vector<FeatureShape> shapes;
  std::vector<AnyRef> of;
};

Shaped shaped(const Model& m) {
  Shaped out;
  const std::set<AnyRef> parts = model::parts_of_others(m);
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature)) {
    if (parts.contains(f) || m.holds<model::ToolpathFeature>(f)) continue;
    auto shapes = model::shapes_of(m, Ref<model::ManufacturingFeature>(f));
    if (!shapes) continue;
    for (FeatureShape& s : rules::from_the_top(*std::move(shapes))) {
      out.shapes.push_back(std::move(s));
      out.of.push_back(f);
    }
  }
  return out;
}

/// A hole needs its face, too: depths of spot drills and countersinks, and feeds, are chosen from the face
/// on.
bool needs(const FeatureShape& before, const FeatureShape& after, Cause cause) {
  const bool faces = before.kind == ShapeKind::kFace && after.kind == ShapeKind::kFace;
  // From one height down the deeper of two takes all that the other does.
  if (faces && std::abs(dot(before.frame.z, after.frame.origin - before.frame.origin)) < kSameMm)
    return false;
  return cause != Cause::kDatum;
}

}  // namespace

std::vector<RestsOn> what_rests(const Model& m, const std::vector<draft::SetupDraft>& setups) {
  const Shaped all = shaped(m);
  sequence::Options options;
  for (const draft::SetupDraft& s : setups)
    options.directions.push_back(s.workpiece.direction_to_local({0.0, 0.0, 1.0}));
  std::set<std::pair<AnyRef, AnyRef>> found;
  for (const auto& pair : sequence::geometric_pairs(all.shapes, sequence::access_of(all.shapes, options))) {
    if (all.of[pair.before] == all.of[pair.after]) continue;
    if (!needs(all.shapes[pair.before], all.shapes[pair.after], pair.cause)) continue;
    found.emplace(all.of[pair.before], all.of[pair.after]);
  }
  std::vector<RestsOn> out;
  for (const auto& [before, after] : found) out.push_back({before, after});
  return out;
}

std::set<AnyRef> resting_on(const std::vector<RestsOn>& all, const std::set<AnyRef>& roots) {
  std::set<AnyRef> reached = roots;
  for (bool grown = true; grown;) {
    grown = false;
    for (const RestsOn& r : all) {
      if (reached.contains(r.before)) grown = reached.insert(r.after).second || grown;
    }
  }
  for (const AnyRef root : roots) reached.erase(root);
  return reached;
}

}  // namespace capstan::piece
