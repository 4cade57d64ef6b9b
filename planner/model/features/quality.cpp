#include "planner/model/features/quality.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/features/fit/stated.h"
#include "planner/model/features/raw_piece.h"
#include "planner/model/features/requirements.h"
#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

constexpr std::size_t kMostParts =
    10000;  // elements followed from one requirement; files may lead in circles

enum class Family { kForm, kOrientation, kLocation, kRunout, kProfile };
struct KindOfTolerance {
  TypeId type;
  Family family;
  const char* name;
};
// ISO 1101:2017, table 2.
constexpr std::array<KindOfTolerance, 15> kKinds{{
    {TypeId::kStraightnessTolerance, Family::kForm, "straightness"},
    {TypeId::kFlatnessTolerance, Family::kForm, "flatness"},
    {TypeId::kRoundnessTolerance, Family::kForm, "roundness"},
    {TypeId::kCylindricityTolerance, Family::kForm, "cylindricity"},
    {TypeId::kLineProfileTolerance, Family::kProfile, "profile of a line"},
    {TypeId::kSurfaceProfileTolerance, Family::kProfile, "profile of a surface"},
    {TypeId::kParallelismTolerance, Family::kOrientation, "parallelism"},
    {TypeId::kPerpendicularityTolerance, Family::kOrientation, "perpendicularity"},
    {TypeId::kAngularityTolerance, Family::kOrientation, "angularity"},
    {TypeId::kPositionTolerance, Family::kLocation, "position"},
    {TypeId::kConcentricityTolerance, Family::kLocation, "concentricity"},
    {TypeId::kCoaxialityTolerance, Family::kLocation, "coaxiality"},
    {TypeId::kSymmetryTolerance, Family::kLocation, "symmetry"},
    {TypeId::kCircularRunoutTolerance, Family::kRunout, "circular run-out"},
    {TypeId::kTotalRunoutTolerance, Family::kRunout, "total run-out"},
}};

const KindOfTolerance* kind_of(TypeId t) {
  const auto it = std::find_if(kKinds.begin(), kKinds.end(), [t](const auto& k) { return k.type == t; });
  return it == kKinds.end() ? nullptr : &*it;
}

void tighten(std::optional<double>& to, double value) { to = to ? std::min(*to, value) : value; }

// --- what a requirement is about ---

/// Follows what a requirement names down to features; without recursion, each object once.
class Followed {
 public:
  Followed(const Model& m, const std::map<AnyRef, std::vector<AnyRef>>& by_face) : m_(m), by_face_(by_face) {}

  void start(AnyRef requirement) {
    if (const auto* t = m_.get<GeometricTolerance>(requirement)) {
      push_all(t->applied_to.items);
    } else if (const auto* s = m_.get<SurfaceTextureParameter>(requirement)) {
      push_all(s->applied_surfaces.items);
      push_all(s->applied_to.items);
    } else if (const auto* p = m_.get<SurfaceProperty>(requirement)) {
      push_all(p->applied_to.items);
    } else {
      push(requirement);
    }
    run();
  }

  [[nodiscard]] std::vector<AnyRef> features() const { return {features_.begin(), features_.end()}; }

 private:
  void push(AnyRef r) {
    if (r.set() && seen_.size() < kMostParts && seen_.insert(r).second) pending_.push_back(r);
  }
  void push_all(const std::vector<AnyRef>& list) {
    for (const AnyRef r : list) push(r);
  }

  void run() {
    while (!pending_.empty()) {
      const AnyRef r = pending_.back();
      pending_.pop_back();
      visit(r);
    }
  }

  void visit(AnyRef r) {
    if (m_.holds<ManufacturingFeature>(r)) {
      features_.insert(r);
    } else if (const auto* s = m_.get<MachinedSurface>(r)) {
      push(s->its_machining_feature);
    } else if (const auto* e = m_.get<ShapeElement>(r)) {
      push_all(e->its_elements.items);
      faces(e->explicit_representation.items);
    } else if (const auto* d = m_.get<SizeDimension>(r)) {
      push(d->applied_to);
    } else if (const auto* l = m_.get<LocationDimension>(r)) {
      push(l->target);
      if (!l->directed.value_or(false)) push(l->origin);
    } else if (const auto* datum = m_.get<Datum>(r)) {
      push_all(datum->established_by.items);
    } else if (const auto* target = m_.get<DatumTarget>(r)) {
      faces(target->explicit_representation.items);
    }
  }

  void faces(const std::vector<AnyRef>& wanted) {
    for (const AnyRef face : wanted) {
      const auto it = by_face_.find(face);
      if (it != by_face_.end()) features_.insert(it->second.begin(), it->second.end());
    }
  }

  const Model& m_;
  const std::map<AnyRef, std::vector<AnyRef>>& by_face_;
  std::vector<AnyRef> pending_;
  std::set<AnyRef> seen_;
  std::set<AnyRef> features_;
};

/// A feature and what it is made of: elements of a compound, the base of a pattern.
std::set<AnyRef> with_parts(const Model& m, AnyRef feature) {
  std::set<AnyRef> out;
  std::vector<AnyRef> pending{feature};
  while (!pending.empty() && out.size() < kMostParts) {
    const AnyRef r = pending.back();
    pending.pop_back();
    if (!r.set() || !out.insert(r).second) continue;
    if (const auto* c = m.get<CompoundFeature>(r))
      pending.insert(pending.end(), c->elements.items.begin(), c->elements.items.end());
    if (const auto* p = m.get<ReplicateFeature>(r)) pending.push_back(p->replicate_base_feature);
  }
  return out;
}

// --- in words ---

/// Letters of one compartment: "A", "A-B" for a common datum. Elements are followed one level, as ISO 5459
/// has it.
std::string letters(const Model& m, Ref<DatumReference> reference) {
  const auto* r = m.get<DatumReference>(reference);
  if (r == nullptr) return {};
  if (const auto* d = m.get<Datum>(r->referenced_datum)) return d->identification.value_or("");
  std::string out;
  for (std::size_t i = 0; i < r->its_elements.size(); ++i) {
    const auto* e = m.get<DatumReference>(r->its_elements[i]);
    const auto* d = e == nullptr ? nullptr : m.get<Datum>(e->referenced_datum);
    if (d != nullptr) out += (out.empty() ? "" : "-") + d->identification.value_or("");
  }
  return out;
}

std::vector<AnyRef> datums_of(const Model& m, const GeometricTolerance& t) {
  std::vector<AnyRef> out;
  const auto* system = m.get<DatumSystem>(t.its_datum_system);
  if (system == nullptr) return out;
  for (const AnyRef c : system->constituents.items) {
    const auto* r = m.get<DatumReference>(c);
    if (r == nullptr) continue;
    if (r->referenced_datum.set()) out.push_back(r->referenced_datum);
    for (const AnyRef e : r->its_elements.items) {
      const auto* part = m.get<DatumReference>(e);
      if (part != nullptr && part->referenced_datum.set()) out.push_back(part->referenced_datum);
    }
  }
  return out;
}

std::string short_modifier(const std::string& word) {
  if (word == "maximum_material_requirement") return "(M)";
  if (word == "least_material_requirement") return "(L)";
  if (word == "reciprocity_requirement") return "(R)";
  if (word == "free_state") return "(F)";
  return "(" + word + ")";
}

std::string words(const Model& m, AnyRef r, const KindOfTolerance& kind) {
  const auto& t = m.at<GeometricTolerance>(r);
  std::string out = kind.name;
  const std::string zone = t.zone_form.value_or("");
  if (zone.find("cylind") != std::string::npos || zone.find("circular") != std::string::npos) out += " dia";
  if (zone.find("spher") != std::string::npos) out += " sphere dia";
  out += " " + trimmed(t.tolerance_value.value_or(0.0), 6);
  if (t.unit_size) out += " / " + trimmed(*t.unit_size, 6);
  if (t.projected_zone_length) out += " (P) " + trimmed(*t.projected_zone_length, 6);
  for (const std::string& word : t.modifiers.items) out += " " + short_modifier(word);
  const auto* system = m.get<DatumSystem>(t.its_datum_system);
  for (std::size_t i = 0; system != nullptr && i < system->constituents.size(); ++i) {
    const auto* reference = m.get<DatumReference>(system->constituents[i]);
    out += " | " + letters(m, system->constituents[i]);
    for (std::size_t k = 0; reference != nullptr && k < reference->modifiers.items.size(); ++k)
      out += short_modifier(reference->modifiers.items[k]);
  }
  return out;
}

/// Ra in micrometres of a texture, when it states Ra. Other parameters (Rz, Rmax) do not convert: their ratio
/// to Ra depends on the process.
std::optional<double> ra_of(const SurfaceTextureParameter& t) {
  if (!t.its_value || !(*t.its_value > 0.0)) return std::nullopt;
  const std::string name = lower_text(t.parameter_name.value_or(""));
  if (name == "ra" || name == "r_a" || name == "roughness average") return t.its_value;
  return std::nullopt;
}

std::string words(const SurfaceTextureParameter& t) {
  return t.parameter_name.value_or("texture") + " " + trimmed(t.its_value.value_or(0.0), 6);
}

/// A surface property whose numeric parameter is named Ra.
std::optional<double> ra_of(const Model& m, const SurfaceProperty& p) {
  for (const AnyRef r : p.its_parameters.items) {
    const auto* n = m.get<NumericParameter>(r);
    if (n == nullptr || lower_text(n->parameter_name.value_or("")) != "ra" || !n->its_parameter_value)
      continue;
    const std::string unit = lower_text(n->its_parameter_unit.value_or(""));
    if (unit == "mm" || unit == "millimetre") return 1000.0 * *n->its_parameter_value;
    if (unit == "um" || unit == "micrometre" || unit == "micron" || unit == "\xc2\xb5m")
      return n->its_parameter_value;
  }
  return std::nullopt;
}

void take(const Model& m, AnyRef r, Quality& out) {
  const auto& t = m.at<GeometricTolerance>(r);
  const KindOfTolerance* kind = kind_of(r.type);
  if (kind == nullptr) return;
  out.texts.push_back(words(m, r, *kind));
  for (const AnyRef d : datums_of(m, t)) {
    const std::string letter = m.at<Datum>(d).identification.value_or("");
    if (!letter.empty() && std::find(out.datums.begin(), out.datums.end(), letter) == out.datums.end())
      out.datums.push_back(letter);
  }
  if (!t.tolerance_value || !(*t.tolerance_value > 0.0))
    return;  // 0 at maximum material: what the size leaves
  switch (kind->family) {
    case Family::kForm:
      return tighten(out.form_mm, *t.tolerance_value);
    case Family::kOrientation:
      return tighten(out.orientation_mm, *t.tolerance_value);
    case Family::kLocation:
      return tighten(out.location_mm, *t.tolerance_value);
    case Family::kRunout:
      return tighten(out.runout_mm, *t.tolerance_value);
    case Family::kProfile:
      return tighten(out.profile_mm, *t.tolerance_value);
  }
}

void take_location(const Model& m, AnyRef r, Quality& out) {
  const auto& d = m.at<LocationDimension>(r);
  const auto* pm = m.get<PlusMinusValue>(d.implicit_tolerance);
  if (pm == nullptr) return;
  const auto s = stated(*pm);
  if (!s || !*s) return;
  tighten(out.location_mm, (*s)->width());
  out.texts.push_back("distance " + trimmed(d.nominal_value.value_or(0.0), 6) + " " +
                      ((*s)->upper_mm < 0.0 ? "" : "+") + trimmed((*s)->upper_mm, 6) + " " +
                      ((*s)->lower_mm < 0.0 ? "" : "+") + trimmed((*s)->lower_mm, 6));
}

/// Of the whole part is only a profile "all over" (ISO 1660, ISO 16792). A flatness or a position that names
/// nothing has lost what it is of: nobody knows of which feature, so it is no feature's.
bool names_nothing(const Model& m, AnyRef r) {
  if (const auto* t = m.get<GeometricTolerance>(r)) {
    const KindOfTolerance* kind = kind_of(r.type);
    return kind != nullptr && kind->family == Family::kProfile && t->applied_to.empty();
  }
  if (const auto* s = m.get<SurfaceTextureParameter>(r))
    return s->applied_surfaces.empty() && s->applied_to.empty();
  return false;
}

std::string words(const Model& m, AnyRef r) {
  if (const KindOfTolerance* kind = kind_of(r.type)) return words(m, r, *kind);
  const auto* t = m.get<SurfaceTextureParameter>(r);
  return t == nullptr ? std::string() : words(*t);
}

}  // namespace

Attribution::Attribution(const Model& model) : model_(model) {
  for (const AnyRef f : model.all_below(TypeId::kManufacturingFeature)) {
    for (const AnyRef face : model.at<ManufacturingFeature>(f).explicit_representation.items)
      faces_[face].push_back(f);
  }
  for (const KindOfTolerance& kind : kKinds) {
    for (const AnyRef r : model.all(kind.type)) add(r);
  }
  for (const TypeId type : {TypeId::kSurfaceTextureParameter, TypeId::kSurfaceProperty,
                            TypeId::kLocationDimension, TypeId::kSizeDimension, TypeId::kDatum}) {
    for (const AnyRef r : model.all(type)) add(r);
  }
}

void Attribution::add(AnyRef r) {
  if (names_nothing(model_, r)) {
    whole_.push_back(r);
    return;
  }
  Followed followed(model_, faces_);
  followed.start(r);
  auto& features = features_[r];
  features = followed.features();
  for (const AnyRef f : features) requirements_[f].push_back(r);
}

const std::vector<AnyRef>& Attribution::features(AnyRef requirement) const {
  static const std::vector<AnyRef> kNothing;
  const auto it = features_.find(requirement);
  return it == features_.end() ? kNothing : it->second;
}

std::vector<AnyRef> Attribution::requirements(AnyRef feature) const {
  std::set<AnyRef> out;
  for (const AnyRef part : with_parts(model_, feature)) {
    const auto it = requirements_.find(part);
    if (it != requirements_.end()) out.insert(it->second.begin(), it->second.end());
  }
  return {out.begin(), out.end()};
}

Quality Attribution::quality(AnyRef feature) const {
  Quality out;
  std::vector<AnyRef> all = requirements(feature);
  for (const AnyRef r : whole_) {
    if (model_.holds<GeometricTolerance>(r)) all.push_back(r);
  }
  for (const AnyRef r : all) {
    if (const auto* t = model_.get<SurfaceTextureParameter>(r)) {
      if (const auto ra = ra_of(*t)) tighten(out.ra_um, *ra);
      out.texts.push_back(words(*t));
    } else if (const auto* p = model_.get<SurfaceProperty>(r)) {
      const auto ra = ra_of(model_, *p);
      if (!ra) continue;
      tighten(out.ra_um, *ra);
      out.texts.push_back("Ra " + trimmed(*ra, 6));
    } else if (model_.holds<LocationDimension>(r)) {
      take_location(model_, r, out);
    } else if (model_.holds<GeometricTolerance>(r)) {
      take(model_, r, out);
    }
  }
  // A texture of the whole part is for what states none itself (ISO 21920-1: unless otherwise indicated).
  if (out.ra_um) return out;
  for (const AnyRef r : whole_) {
    const auto* t = model_.get<SurfaceTextureParameter>(r);
    const auto ra = t == nullptr ? std::nullopt : ra_of(*t);
    if (!ra) continue;
    tighten(out.ra_um, *ra);
    out.texts.push_back(words(*t) + " all over");
  }
  return out;
}

std::vector<Attribution::Lost> Attribution::lost() const {
  std::vector<Lost> out;
  for (const auto& [r, features] : features_) {
    if (!features.empty()) continue;
    if (const std::string text = words(model_, r); !text.empty()) out.push_back({r, text});
  }
  return out;
}

Quality quality_of(const Model& model, Ref<ManufacturingFeature> feature) {
  return Attribution(model).quality(feature);
}

std::vector<Tie> ties_of(const Model& m, const Attribution& attribution) {
  std::vector<Tie> out;
  for (const KindOfTolerance& kind : kKinds) {
    if (kind.family == Family::kForm) continue;
    for (const AnyRef r : m.all(kind.type)) {
      const auto& toleranced = attribution.features(r);
      const std::string text = words(m, r, kind);
      for (const AnyRef d : datums_of(m, m.at<GeometricTolerance>(r))) {
        const std::string letter = m.at<Datum>(d).identification.value_or("");
        for (const AnyRef base : attribution.features(d)) {
          for (const AnyRef f : toleranced) {
            if (f != base) out.push_back({base, f, letter, r, text});
          }
        }
      }
      // Toleranced together: a pattern as a whole.
      for (std::size_t i = 1; i < toleranced.size(); ++i)
        out.push_back({toleranced[i - 1], toleranced[i], "", r, text});
    }
  }
  return out;
}

Result<std::optional<GeneralTolerance>> general_tolerance_of(const Model& m, Ref<Workpiece> workpiece) {
  const auto* piece = m.get<Workpiece>(workpiece);
  if (piece == nullptr) return std::nullopt;
  for (const AnyRef r : piece->its_properties.items) {
    const auto* property = m.get<AssignedProperty>(r);
    if (property == nullptr) continue;
    for (const AnyRef p : property->its_parameters.items) {
      const auto* text = m.get<DescriptiveParameter>(p);
      const std::string words = text == nullptr ? "" : text->descriptive_string.value_or("");
      const std::string plain = lower_text(words);
      if (plain.find("2768") == std::string::npos && plain.find("22081") == std::string::npos) continue;
      auto read = parse_general(words);
      if (!read) return tl::unexpected(read.error());
      return std::optional<GeneralTolerance>(*std::move(read));
    }
  }
  const auto stated = global_tolerance_of(*piece);
  if (!stated) return std::nullopt;
  GeneralTolerance out;
  out.size_mm = *stated;
  out.text = "+-" + trimmed(*stated, 6);
  return std::optional<GeneralTolerance>(std::move(out));
}

}  // namespace capstan::model
