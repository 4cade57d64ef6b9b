#include <set>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/form/limits.h"

// Which features a tolerance of location is of. It names features, or their surfaces, elements, dimensions
// and datums; these are followed down to features, each once. A compound or a pattern has what its elements
// have.

namespace capstan::verify::volumes {

using model::AnyRef;
using model::Model;

namespace {

constexpr std::size_t kMostFollowed = 10000;  ///< files may lead in circles

std::set<AnyRef> features_of(const Model& m, std::vector<AnyRef> pending,
                             const std::map<AnyRef, std::vector<AnyRef>>& of_face) {
  std::set<AnyRef> seen, out;
  const auto follow = [&](const std::vector<AnyRef>& more) {
    pending.insert(pending.end(), more.begin(), more.end());
  };
  const auto faces = [&](const std::vector<AnyRef>& list) {
    for (const AnyRef face : list) {
      if (const auto f = of_face.find(face); f != of_face.end())
        out.insert(f->second.begin(), f->second.end());
    }
  };
  while (!pending.empty() && seen.size() < kMostFollowed) {
    const AnyRef r = pending.back();
    pending.pop_back();
    if (!r.set() || !seen.insert(r).second) continue;
    if (m.holds<model::ManufacturingFeature>(r)) out.insert(r);
    if (const auto* s = m.get<model::MachinedSurface>(r)) follow({s->its_machining_feature});
    if (const auto* d = m.get<model::SizeDimension>(r)) follow({d->applied_to});
    if (const auto* d = m.get<model::Datum>(r)) follow(d->established_by.items);
    if (const auto* l = m.get<model::LocationDimension>(r)) {
      follow({l->target});
      if (!l->directed.value_or(false)) follow({l->origin});
    }
    if (const auto* t = m.get<model::DatumTarget>(r)) faces(t->explicit_representation.items);
    if (const auto* e = m.get<model::ShapeElement>(r)) {
      follow(e->its_elements.items);
      faces(e->explicit_representation.items);
    }
  }
  return out;
}

}  // namespace

std::map<AnyRef, double> location_zones(const Model& m) {
  std::map<AnyRef, std::vector<AnyRef>> of_face, holders;
  for (const AnyRef f : m.all_below(model::TypeId::kManufacturingFeature)) {
    for (const AnyRef face : m.at<model::ManufacturingFeature>(f).explicit_representation.items)
      of_face[face].push_back(f);
    if (const auto* c = m.get<model::CompoundFeature>(f)) {
      for (const AnyRef e : c->elements.items) holders[e].push_back(f);
    }
    if (const auto* p = m.get<model::ReplicateFeature>(f)) holders[p->replicate_base_feature].push_back(f);
  }
  std::map<AnyRef, double> out;
  const auto state = [&](const std::set<AnyRef>& features, double zone) {
    std::vector<AnyRef> pending(features.begin(), features.end());
    std::set<AnyRef> seen;
    while (!pending.empty()) {
      const AnyRef f = pending.back();
      pending.pop_back();
      if (!seen.insert(f).second) continue;
      const auto [at, first] = out.emplace(f, zone);
      if (!first) at->second = std::min(at->second, zone);
      if (const auto by = holders.find(f); by != holders.end())
        pending.insert(pending.end(), by->second.begin(), by->second.end());
    }
  };
  for (const auto type : {model::TypeId::kPositionTolerance, model::TypeId::kConcentricityTolerance,
                          model::TypeId::kCoaxialityTolerance, model::TypeId::kSymmetryTolerance}) {
    for (const AnyRef r : m.all(type)) {
      const auto& t = m.at<model::GeometricTolerance>(r);
      // 0 at maximum material: what the size leaves.
      if (t.tolerance_value.value_or(0.0) > 0.0)
        state(features_of(m, t.applied_to.items, of_face), *t.tolerance_value);
    }
  }
  for (const AnyRef r : m.all(model::TypeId::kLocationDimension)) {
    const auto& d = m.at<model::LocationDimension>(r);
    if (!m.holds<model::PlusMinusValue>(d.implicit_tolerance)) continue;
    const Limits l = deviations_of(m, d.nominal_value.value_or(0.0), d.implicit_tolerance);
    if (l.given) state(features_of(m, {r}, of_face), l.width());
  }
  return out;
}

}  // namespace capstan::verify::volumes
