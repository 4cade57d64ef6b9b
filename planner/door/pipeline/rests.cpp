#include <algorithm>
#include <map>
#include <utility>

#include "planner/door/pipeline/work.h"
#include "planner/making/sequence/precedence.h"

// Which features need others to be made first. What rests on a feature that is not planned is left out, too:
// a tap does not run into the solid, a pocket is not begun in the material of a face. The relation is the one
// that orders the steps (sequence/precedence): of two features that meet, the upper comes first.

namespace capstan::pipeline {
namespace {

using model::FeatureShape;
using model::Model;
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

std::string name_of(const Model& m, AnyRef f) {
  const auto* named = m.get<model::ManufacturingFeature>(f);
  return named == nullptr ? std::string() : named->its_id.value_or("");
}

std::set<AnyRef> unplanned_of(const Work& w) {
  std::set<AnyRef> out;
  for (const model::Unplanned& u : w.plan.unplanned) out.insert(u.feature);
  return out;
}

}  // namespace

std::vector<RestsOn> what_rests(const Work& w) {
  const Shaped all = shaped(w.plan.model);
  sequence::Options options;
  for (const SetupWork& s : w.setups)
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

Status leave_what_rests(Work& w) {
  const std::set<AnyRef> roots = unplanned_of(w);
  if (roots.empty()) return {};
  std::set<AnyRef> planned;
  for (const StepWork& s : w.steps) {
    if (s.proposed) planned.insert(s.feature);
  }
  const std::vector<RestsOn> all = what_rests(w);
  const std::set<AnyRef> resting = resting_on(all, roots);
  for (const RestsOn& r : all) {
    if (!resting.contains(r.after) || !(roots.contains(r.before) || resting.contains(r.before))) continue;
    if (!planned.contains(r.after)) continue;
    // Of the root, where it rests on one through others.
    const auto is_why = [&](const model::Unplanned& u) {
      return u.feature == r.before || resting_on(all, {u.feature}).contains(r.before);
    };
    const auto why = std::find_if(w.plan.unplanned.begin(), w.plan.unplanned.end(), is_why);
    w.tries.rests(r.after, r.before, why == w.plan.unplanned.end() ? std::string() : why->reason);
    w.again = true;
  }
  return {};
}

void name_what_rests(Work& w) {
  const std::set<AnyRef> roots = unplanned_of(w);
  if (roots.empty()) return;
  const std::vector<RestsOn> all = what_rests(w);
  std::set<AnyRef> named;
  for (model::Unplanned& u : w.plan.unplanned) {
    if (!named.insert(u.feature).second) continue;
    for (const AnyRef f : resting_on(all, {u.feature})) u.needed_by.push_back(name_of(w.plan.model, f));
    std::sort(u.needed_by.begin(), u.needed_by.end());
  }
}

}  // namespace capstan::pipeline
