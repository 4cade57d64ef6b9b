#include <algorithm>
#include <map>
#include <set>

#include "planner/ground/geometry/region.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/proof/verify/copies/copies.h"
#include "planner/proof/verify/plan/plan_checks.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/verify.h"

namespace capstan::verify {

using geometry::Region;
using geometry::Vec2;
using model::AnyRef;
using model::ShapeKind;
using model::TypeId;

namespace {

std::string name_of(TypeId t) { return std::string(model::noun_type(t).keyword); }

/// A thread and the hole that it is cut into are one thing to the order.
AnyRef group_of(const model::Model& m, AnyRef feature) {
  if (const auto* t = m.get<model::Thread>(feature)) {
    if (!t->applied_shape.empty()) return t->applied_shape.items.front();
  }
  return feature;
}

struct Entry {
  std::size_t order = 0;
  std::string id;
  AnyRef feature, operation;
  std::size_t setup = 0;
  const model::Cutter* cutter = nullptr;
  bool cut = false;  ///< before the plan's steps
};

void add_entries(const model::Plan& plan, std::size_t steps, bool cut, std::vector<Entry>& out) {
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < std::min(steps, plan.steps.size()); ++i) {
    const model::StepResult& s = plan.steps[i];
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    if (ws == nullptr || !s.path) continue;
    out.push_back(
        {i, ids[i], ws->its_feature, ws->its_operation, s.setup, model::find_cutter(plan, s.cutter_id), cut});
  }
}

std::vector<Entry> entries_of(const model::Plan& plan, const CutBefore* before) {
  std::vector<Entry> out;
  if (before != nullptr) add_entries(before->plan, before->steps, true, out);
  add_entries(plan, plan.steps.size(), false, out);
  return out;
}

/// A cone along the side of a feature breaks its edge: it comes when the feature is done.
bool breaks_edges(const Entry& e) {
  return e.operation.type == TypeId::kSideFinishMilling && e.cutter != nullptr &&
         verify::breaks_edges(e.cutter->cutter_class);
}

void check_ranks(const model::Plan& plan, const std::vector<Entry>& entries, Findings& findings) {
  std::map<AnyRef, const Entry*> highest;
  for (const Entry& e : entries) {
    const int rank = order_rank(e.operation.type);
    if (rank == 0 || breaks_edges(e)) continue;
    const Entry*& before = highest[group_of(plan.model, e.feature)];
    if (before != nullptr && !e.cut && rank < order_rank(before->operation.type)) {
      findings.error(28, "CHK-ORDER", {e.order + 1, e.id, -1},
                     name_of(e.operation.type) + " comes after " + name_of(before->operation.type) + " (" +
                         before->id + ") on the same feature; put it before");
      continue;
    }
    before = &e;
  }
}

/// A feature's outline in the set-up, with the heights of its top and its bottom.
struct Footprint {
  bool good = false, face = false;
  Region area;
  geometry::Box2 box;
  double top = 0.0, bottom = 0.0;
};

Footprint footprint(const PartShapes& part, const geometry::Placement& workpiece, AnyRef feature) {
  Footprint out;
  const auto* e = part.find(feature);
  if (e == nullptr || e->shapes.empty()) return out;
  std::vector<geometry::Loop> loops;
  out.top = -1e300;
  out.bottom = 1e300;
  for (const auto& s : e->shapes) {
    const geometry::Placement at = compose(workpiece, s.frame());
    if (at.z.z < 1.0 - 1e-9) return {};
    for (const auto& loop : s.area.loops) {
      geometry::Loop moved;
      for (const Vec2 p : loop) moved.push_back(xy(at.to_parent({p.x, p.y, 0.0})));
      loops.push_back(std::move(moved));
    }
    out.face = s.kind == ShapeKind::kFace;
    out.top = std::max(out.top, at.origin.z);
    out.bottom = std::min(out.bottom, at.origin.z - s.depth_mm());
  }
  out.area = geometry::clean(loops);
  out.box = geometry::bounds(out.area);
  out.good = !out.area.empty();
  return out;
}

bool overlap(const Footprint& a, const Footprint& b) {
  if (a.box.lo.x >= b.box.hi.x || b.box.lo.x >= a.box.hi.x || a.box.lo.y >= b.box.hi.y ||
      b.box.lo.y >= a.box.hi.y)
    return false;
  return geometry::area(geometry::intersect(a.area, b.area)) > 1e-3 * geometry::area(b.area);
}

void check_faces(const model::Plan& plan, const PartShapes& part, const std::vector<Entry>& entries,
                 Findings& findings) {
  const auto has_face = [](const PartShapes::Entry& e) {
    return std::any_of(e.shapes.begin(), e.shapes.end(),
                       [](const auto& s) { return s.kind == ShapeKind::kFace; });
  };
  if (std::none_of(part.entries.begin(), part.entries.end(), has_face)) return;
  struct First {
    const Entry* entry;
    Footprint print;
  };
  std::vector<First> firsts;
  std::set<std::pair<std::size_t, AnyRef>> seen;
  for (const Entry& e : entries) {
    if (!seen.emplace(e.setup, e.feature).second) continue;
    firsts.push_back({&e, footprint(part, workpiece_in(plan, e.setup), e.feature)});
  }
  for (std::size_t f = 0; f < firsts.size(); ++f) {
    const Footprint& face = firsts[f].print;
    if (!face.good || !face.face || firsts[f].entry->cut) continue;
    for (std::size_t g = 0; g < f; ++g) {
      const Footprint& other = firsts[g].print;
      if (!other.good || firsts[g].entry->setup != firsts[f].entry->setup) continue;
      // In the face lies what goes on below it.
      if (other.bottom >= face.bottom - 1e-6 || !overlap(face, other)) continue;
      findings.error(28, "CHK-FACE-FIRST", {firsts[f].entry->order + 1, firsts[f].entry->id, -1},
                     "the face is begun after " + firsts[g].entry->id +
                         ", whose feature lies in it: put the face first");
    }
  }
}

}  // namespace

void check_order(const model::Plan& plan, const PartShapes& part, Findings& findings,
                 const CutBefore* before) {
  const std::vector<Entry> entries = entries_of(plan, before);
  check_ranks(plan, entries, findings);
  check_faces(plan, part, entries, findings);
}

std::set<AnyRef> to_come(const model::Plan& plan, const CutBefore& before) {
  std::set<AnyRef> there, out;
  for (const model::StepResult& s : plan.steps) there.insert(s.step);
  for (std::size_t i = 0; i < std::min(before.steps, before.plan.steps.size()); ++i)
    there.insert(before.plan.steps[i].step);
  const std::vector<AnyRef> roots = {plan.project};
  for (const AnyRef r : model::reachable(plan.model, roots)) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(r);
    if (ws == nullptr || there.contains(r) || !ws->enabled.value_or(true)) continue;
    out.insert(ws->its_feature);
    out.insert(ws->final_features.items.begin(), ws->final_features.items.end());
  }
  return out;
}

void check_coverage(const model::Plan& plan, Findings& findings, const CutBefore* before) {
  const model::Model& m = plan.model;
  std::set<AnyRef> covered, said;
  if (before != nullptr) covered = to_come(plan, *before);
  for (const auto& u : plan.unplanned) {
    said.insert(u.feature);
    if (!u.reason.empty()) continue;
    const auto* feature = m.get<model::ManufacturingFeature>(u.feature);
    findings.error(34, "CHK-UNPLANNED", {0, "", -1},
                   "feature " + (feature == nullptr ? std::string() : feature->its_id.value_or("")) + " (" +
                       name_of(u.feature.type) +
                       ") is listed as not planned, without a reason; plan it again, or state the reason");
  }
  const auto cover = [&](const model::StepResult& s) {
    const auto* ws = m.get<model::MachiningWorkingstep>(s.step);
    if (ws == nullptr || !s.path || s.path->size() < 2) return;
    covered.insert(ws->its_feature);
    for (const auto& f : ws->final_features.items) covered.insert(f);
  };
  for (const auto& s : plan.steps) cover(s);
  for (std::size_t i = 0; before != nullptr && i < before->steps; ++i) cover(before->plan.steps[i]);
  // What is only a piece of another feature is planned with it.
  const std::set<AnyRef> parts = volumes::parts_of_others(m);
  for (const auto f : m.all_below(TypeId::kManufacturingFeature)) {
    if (covered.contains(f) || said.contains(f) || parts.contains(f)) continue;
    if (const auto* c = m.get<model::CompoundFeature>(f)) {
      // A compound whose elements have their own steps is planned by them.
      const auto& elements = c->elements.items;
      if (!elements.empty() && std::all_of(elements.begin(), elements.end(), [&](AnyRef e) {
            return covered.contains(e) || said.contains(e);
          })) {
        continue;
      }
    }
    const auto* feature = m.get<model::ManufacturingFeature>(f);
    findings.error(34, "CHK-UNPLANNED", {0, "", -1},
                   "feature " + feature->its_id.value_or("") + " (" + name_of(f.type) +
                       ") has no step with a path, and is not listed as not planned; plan it again");
  }
}

}  // namespace capstan::verify
