#include "planner/files/from_cad/asked/requirements.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "planner/files/from_cad/solid/part.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/ground/base/text.h"
#include "planner/model/features/fit/fit.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/all.h"

namespace capstan::from_cad {
namespace {

using model::AnyRef;
using model::Model;
using model::Ref;

enum class Kind : std::uint8_t { kDiameter, kRadius, kLength };

/// A size of a feature that may have a tolerance.
struct Measure {
  Ref<model::TolerancedLengthMeasure> at;
  Kind kind = Kind::kLength;
  std::optional<Vec3> across;   ///< the normal of the plane faces that a length is between, where it is known
  std::optional<Vec3> along;    ///< the axis of the cylinders that a radius is of: upright edges of a pocket
  std::optional<Vec3> athwart;  ///< no axis of the cylinders that a radius is of: fillets of a floor
};

/// The frame of a placement; the parent's where there is none.
geometry::Placement frame_of(const Model& m, Ref<model::Axis2Placement3d> at) {
  const auto frame = model::placement_or_identity(m, at);
  return frame ? *frame : geometry::Placement{};
}

/// The sizes of a profile of a feature.
void sizes_of(const Model& m, AnyRef profile, const geometry::Placement& feature, std::vector<Measure>& out) {
  if (const auto* c = m.get<model::CircularClosedProfile>(profile)) {
    out.push_back({c->diameter, Kind::kDiameter, {}, {}, {}});
  } else if (const auto* r = m.get<model::RectangularClosedProfile>(profile)) {
    const geometry::Placement at = frame_of(m, r->placement);
    out.push_back({r->profile_length, Kind::kLength, feature.direction_to_parent(at.x), {}, {}});
    out.push_back({r->profile_width, Kind::kLength, feature.direction_to_parent(at.y), {}, {}});
  } else if (const auto* u = m.get<model::SquareUProfile>(profile)) {
    out.push_back({u->width, Kind::kLength, {}, {}, {}});
  }
}

/// The sizes of a feature, and of the elements that it is made of; each once.
std::vector<Measure> sizes_of(const Model& m, AnyRef feature) {
  std::vector<Measure> out;
  std::vector<AnyRef> of{feature};
  if (const auto* c = m.get<model::CompoundFeature>(feature))
    of.insert(of.end(), c->elements.items.begin(), c->elements.items.end());
  for (const AnyRef f : of) {
    const auto* placed = m.get<model::Two5dManufacturingFeature>(f);
    const geometry::Placement frame =
        placed == nullptr ? geometry::Placement{} : frame_of(m, placed->feature_placement);
    if (const auto* h = m.get<model::RoundHole>(f)) out.push_back({h->diameter, Kind::kDiameter, {}, {}, {}});
    if (const auto* p = m.get<model::Pocket>(f)) {
      out.push_back({p->planar_radius, Kind::kRadius, {}, {}, frame.z});
      out.push_back({p->orthogonal_radius, Kind::kRadius, {}, frame.z, {}});
    }
    if (const auto* p = m.get<model::ClosedPocket>(f)) sizes_of(m, p->feature_boundary, frame, out);
    if (const auto* s = m.get<model::Slot>(f)) sizes_of(m, s->swept_shape, frame, out);
    if (const auto* o = m.get<model::GeneralOutsideProfile>(f)) sizes_of(m, o->feature_boundary, frame, out);
  }
  std::erase_if(out,
                [&](const Measure& s) { return m.get<model::TolerancedLengthMeasure>(s.at) == nullptr; });
  return out;
}

bool parallel(Vec3 a, Vec3 b) { return norm(cross(a, b)) <= recognise::kSameAngleRad; }

/// Whether a size can be of a face, or between it and another; a face that does not tell may have any size.
bool can_be_of(const Measure& at, const exchange::Face& face) {
  if (face.carrier == exchange::Carrier::kPlane) return !at.across || parallel(normal_of(face), *at.across);
  if (face.carrier != exchange::Carrier::kCylinder) return true;
  const Vec3 axis{face.axis.x, face.axis.y, face.axis.z};
  return (!at.along || parallel(axis, *at.along)) && (!at.athwart || !parallel(axis, *at.athwart));
}

Kind kind_of(const exchange::StatedSize& s) {
  const std::string kind = lower_text(s.kind);
  if (kind.find("diameter") != std::string::npos) return Kind::kDiameter;
  if (kind.find("radius") != std::string::npos) return Kind::kRadius;
  return Kind::kLength;
}

/// How many times a stated size the size of a noun is; nothing: it is another kind of size.
std::optional<double> times(Kind stated, Kind noun) {
  if (stated == noun) return 1.0;
  if (stated == Kind::kRadius && noun == Kind::kDiameter) return 2.0;
  return std::nullopt;
}

std::string words(const exchange::StatedSize& s) {
  std::string out = s.kind.empty() ? "size" : s.kind;
  if (s.nominal_mm) out += " " + trimmed(*s.nominal_mm, 4);
  if (!s.fit.empty()) out += " " + s.fit;
  if (s.lower_mm) out += " " + trimmed(*s.lower_mm, 4) + "/" + trimmed(*s.upper_mm, 4);
  if (s.least_mm) out += " " + trimmed(*s.least_mm, 4) + ".." + trimmed(*s.greatest_mm, 4);
  return out;
}

bool has_tolerance(const exchange::StatedSize& s) {
  return s.lower_mm.has_value() || s.least_mm.has_value() || !s.fit.empty();
}

/// "FLATNESS_TOLERANCE" -> "flatness".
std::string word_of_zone(const std::string& keyword) {
  std::string out = lower_text(keyword.substr(0, keyword.rfind("_TOLERANCE")));
  std::replace(out.begin(), out.end(), '_', ' ');
  return out;
}

class Attacher {
 public:
  Attacher(const exchange::Brep& brep, const std::vector<MadeOf>& made, Ref<model::Workpiece> piece,
           model::Plan& plan)
      : brep_(brep), made_(made), piece_(piece), plan_(plan), m_(plan.model) {
    for (std::uint32_t f = 0; f < brep.faces.size(); ++f) {
      if (brep.faces[f].id != 0) face_of_[brep.faces[f].id].push_back(f);
    }
    for (std::size_t i = 0; i < made.size(); ++i) {
      for (const std::uint32_t f : made[i].faces) makers_[f].push_back(i);
    }
    for (const exchange::StatedTexture& t : brep.pmi.textures) ++parameters_[t.id];
  }

  Attached attach() {
    for (const exchange::StatedSize& s : brep_.pmi.sizes) {
      if (has_tolerance(s)) count(s.id, words(s), size(s));
    }
    for (const exchange::StatedZone& z : brep_.pmi.zones)
      count(z.id, word_of_zone(z.keyword) + " " + trimmed(z.value_mm, 4), zone(z));
    for (const exchange::StatedTexture& t : brep_.pmi.textures)
      count(t.id, t.parameter + " " + trimmed(t.value_um, 4), texture(t));
    for (const exchange::UnreadPmi& u : brep_.pmi.unread) {
      if (u.has_tolerance) count(u.id, u.what, u.why);
    }
    return std::move(out_);
  }

 private:
  void count(std::int64_t id, const std::string& what, const std::string& why) {
    tick();
    ++out_.stated;
    if (why.empty()) {
      ++out_.attached;
    } else {
      out_.lost.push_back("#" + std::to_string(id) + " " + what + ": " + why);
    }
  }

  /// The features that make faces, in the order of the plan.
  [[nodiscard]] std::vector<const MadeOf*> features_of(const std::vector<std::int64_t>& ids) const {
    std::set<std::size_t> wanted;
    for (const std::int64_t id : ids) {
      tick();
      const auto faces = face_of_.find(id);
      if (faces == face_of_.end()) continue;
      for (const std::uint32_t f : faces->second) {
        if (const auto it = makers_.find(f); it != makers_.end())
          wanted.insert(it->second.begin(), it->second.end());
      }
    }
    std::vector<const MadeOf*> out;
    for (const std::size_t i : wanted) out.push_back(&made_[i]);
    return out;
  }

  static std::string listed(const std::vector<std::int64_t>& ids) {
    std::string list;
    for (std::size_t i = 0; i < ids.size() && i < 4; ++i) list += " #" + std::to_string(ids[i]);
    return "face" + list + (ids.size() > 4 ? " and others" : "");
  }

  [[nodiscard]] std::string no_feature(const std::vector<std::int64_t>& ids) const {
    if (ids.empty()) return "it names no face";
    return "no planned feature makes " + listed(ids);
  }

  /// What is wrong where some faces of a statement are made by none of the features that got it; empty: none
  /// is. `why`: why the other features have not got it.
  [[nodiscard]] std::string rest(const std::vector<std::int64_t>& ids, const std::vector<const MadeOf*>& got,
                                 const std::string& why) const {
    std::vector<std::int64_t> without;
    for (const std::int64_t id : ids) {
      const auto by = features_of({id});
      if (std::none_of(by.begin(), by.end(), [&](const MadeOf* f) {
            return std::binary_search(got.begin(), got.end(), f, std::less<>());
          }))
        without.push_back(id);
    }
    if (without.empty()) return {};
    return "asked of some of its faces only: " +
           (features_of(without).empty() ? no_feature(without) : listed(without) + ": " + why);
  }

  // --- sizes ---

  std::string size(const exchange::StatedSize& s) {
    std::vector<const MadeOf*> of = features_of(s.faces);
    if (!s.to.empty()) {
      const auto ends = features_of(s.to);
      std::erase_if(of,
                    [&](const MadeOf* f) { return std::find(ends.begin(), ends.end(), f) == ends.end(); });
      if (of.empty()) return "its two ends are not of one feature";
    }
    if (of.empty()) return no_feature(s.faces);
    // Limits alone: the size that the shape has between them is nominal.
    const double lo = s.nominal_mm ? *s.nominal_mm - recognise::kSameLengthMm : *s.least_mm;
    const double hi = s.nominal_mm ? *s.nominal_mm + recognise::kSameLengthMm : *s.greatest_mm;
    const std::string said = words(s) + " mm";
    std::string why = "no size of its feature is " + said;
    std::vector<std::int64_t> ids = s.faces;
    ids.insert(ids.end(), s.to.begin(), s.to.end());
    std::vector<const MadeOf*> got;
    std::set<AnyRef> given;
    for (const MadeOf* f : of) {
      std::map<AnyRef, double> fitting;  // a size, and how many times the stated one it is
      for (const Measure& at : sizes_of(m_, f->feature)) {
        const auto factor = times(kind_of(s), at.kind);
        const double shape = m_.at<model::TolerancedLengthMeasure>(at.at).theoretical_size.value_or(0.0);
        if (!factor || shape < *factor * lo || shape > *factor * hi) continue;
        if (can_be_of(at, *f, ids)) fitting.emplace(at.at, *factor);
      }
      if (fitting.size() > 1)
        why = "more than one size of its feature is " + said + ", which one is not stated";
      if (fitting.size() != 1) continue;
      const auto& [to, factor] = *fitting.begin();
      const std::string fault =
          given.insert(to).second ? tolerate(s, Ref<model::TolerancedLengthMeasure>(to), factor) : "";
      if (fault.empty()) {
        got.push_back(f);
      } else {
        why = fault;
      }
    }
    return got.empty() ? why : rest(ids, got, why);
  }

  /// Whether a size can be of, or between, the faces that a feature makes of some.
  [[nodiscard]] bool can_be_of(const Measure& at, const MadeOf& f,
                               const std::vector<std::int64_t>& ids) const {
    return std::all_of(ids.begin(), ids.end(), [&](std::int64_t id) {
      tick();
      const auto it = face_of_.find(id);
      return it == face_of_.end() ||
             std::all_of(it->second.begin(), it->second.end(), [&](std::uint32_t face) {
               return !std::binary_search(f.faces.begin(), f.faces.end(), face) ||
                      from_cad::can_be_of(at, brep_.faces[face]);
             });
    });
  }

  /// Puts a tolerance to a size. What is wrong; empty: nothing.
  std::string tolerate(const exchange::StatedSize& s, Ref<model::TolerancedLengthMeasure> to, double factor) {
    if (m_.at<model::TolerancedLengthMeasure>(to).implicit_tolerance.set())
      return "its size has a tolerance already";
    const double shape = *m_.at<model::TolerancedLengthMeasure>(to).theoretical_size;
    if (!s.fit.empty()) {
      const auto c = model::parse_fit(s.fit);
      if (!c) return c.error().message;
      if (c->hole == s.of_shaft)
        return "the fit " + s.fit + " is stated of a " + (s.of_shaft ? "shaft" : "hole");
      const auto zone = model::fit(shape, *c);
      if (!zone) return zone.error().message;
      model::LimitsAndFits fit;
      fit.deviation = c->hole == (c->letter.front() <= 'h') ? zone->lower_mm : zone->upper_mm;
      fit.grade = zone->width();
      fit.its_fitting_type = c->hole ? model::FittingType::kHole : model::FittingType::kShaft;
      fit.form_variance = std::string(s.fit.substr(0, c->letter.size()));
      fit.zone_variance = std::string(c->hole ? "hole" : "shaft");
      fit.tolerance_grade = s.fit.substr(c->letter.size());
      m_.at<model::TolerancedLengthMeasure>(to).implicit_tolerance = m_.add(fit);
    } else {
      const double lower = s.lower_mm ? factor * *s.lower_mm : factor * *s.least_mm - shape;
      const double upper = s.upper_mm ? factor * *s.upper_mm : factor * *s.greatest_mm - shape;
      if (!(lower < upper)) return "its limits leave nothing between them";
      model::PlusMinusValue range;
      range.upper_limit = upper;
      range.lower_limit = 0.0 - lower;  // what is taken away from the nominal size
      range.significant_digits = kDigits;
      m_.at<model::TolerancedLengthMeasure>(to).implicit_tolerance = m_.add(range);
    }
    plan_.ledger.bind(to, "implicit_tolerance", model::Binder::kRecognition,
                      {"recognise.pmi", "stated of its faces by #" + std::to_string(s.id) + ": " + words(s),
                       plan_.file_name});
    return {};
  }

  // --- geometric tolerances ---

  Ref<model::Datum> datum(const std::string& letter) {
    const auto known = datums_.find(letter);
    if (known != datums_.end()) return known->second;
    model::Datum d;
    d.identification = letter;
    d.its_workpiece = piece_;
    for (const exchange::StatedDatum& s : brep_.pmi.datums) {
      if (s.letter != letter) continue;
      for (const MadeOf* f : features_of(s.faces))
        d.established_by.push_back(Ref<model::ManufacturingFeature>(f->feature));
      if (!d.established_by.empty()) continue;
      model::DatumFeature side;  // a face that stays as the raw piece has it
      side.its_id = "faces";
      for (const std::int64_t id : s.faces) *side.its_id += " #" + std::to_string(id);
      side.its_workpiece = piece_;
      d.established_by.push_back(m_.add(side));
    }
    const Ref<model::Datum> made = m_.add(d);
    datums_.emplace(letter, made);
    require(made);
    return made;
  }

  Ref<model::DatumSystem> system_of(const std::vector<std::vector<std::string>>& letters) {
    const auto known = systems_.find(letters);
    if (known != systems_.end()) return known->second;
    const auto reference = [&](const std::string& letter) {
      model::DatumReference r;
      r.referenced_datum = datum(letter);
      return m_.add(r);
    };
    model::DatumSystem system;
    system.its_workpiece = piece_;
    for (const auto& compartment : letters) {
      if (compartment.size() == 1) {
        system.constituents.push_back(reference(compartment.front()));
        continue;
      }
      model::DatumReference common;
      for (const std::string& letter : compartment) common.its_elements.push_back(reference(letter));
      system.constituents.push_back(m_.add(common));
    }
    const auto made = m_.add(system);
    systems_.emplace(letters, made);
    return made;
  }

  std::string zone(const exchange::StatedZone& z) {
    const auto of = features_of(z.faces);
    if (of.empty() && !z.whole) return no_feature(z.faces);
    const auto type = model::find_noun(z.keyword);
    if (!type || !model::is_a(*type, model::TypeId::kGeometricTolerance)) return "it has no noun";
    const AnyRef made = m_.add_object(*type);
    const Ref<model::DatumSystem> system = z.datums.empty() ? Ref<model::DatumSystem>() : system_of(z.datums);
    auto& t = m_.at<model::GeometricTolerance>(made);
    t.its_id = "#" + std::to_string(z.id);
    t.tolerance_value = z.value_mm;
    t.its_workpiece = piece_;
    t.applied_to.given = true;
    for (const MadeOf* f : of) t.applied_to.push_back(Ref<model::ManufacturingFeature>(f->feature));
    if (system.set()) t.its_datum_system = system;
    for (const std::string& word : z.modifiers) {
      t.modifiers.items.push_back(word);
      t.modifiers.given = true;
    }
    if (!z.form.empty()) t.zone_form = z.form;
    require(Ref<model::GeometricTolerance>(made));
    return z.whole ? std::string() : rest(z.faces, of, {});
  }

  // --- texture ---

  /// Whether faces of a feature are its bottom, its side, or both.
  [[nodiscard]] model::BottomOrSide element_of(const MadeOf& f, const std::vector<std::int64_t>& ids) const {
    bool bottom = false;
    bool side = false;
    const Vec3 access = axis_of(f.feature);
    for (const std::int64_t id : ids) {
      const auto it = face_of_.find(id);
      if (it == face_of_.end()) continue;
      for (const std::uint32_t face : it->second) {
        if (!std::binary_search(f.faces.begin(), f.faces.end(), face)) continue;
        const exchange::Face& g = brep_.faces[face];
        const bool floor = g.carrier == exchange::Carrier::kPlane && dot(normal_of(g), access) > 0.5;
        (floor ? bottom : side) = true;
      }
    }
    if (bottom && side) return model::BottomOrSide::kBottomAndSide;
    return bottom ? model::BottomOrSide::kBottom : model::BottomOrSide::kSide;
  }

  /// From the material to the tool.
  [[nodiscard]] Vec3 axis_of(AnyRef feature) const {
    const auto* f = m_.get<model::Two5dManufacturingFeature>(feature);
    const auto* at = f == nullptr ? nullptr : m_.get<model::Axis2Placement3d>(f->feature_placement);
    const auto* d = at == nullptr ? nullptr : m_.get<model::Direction>(at->axis);
    if (d == nullptr || d->direction_ratios.items.size() != 3) return {0.0, 0.0, 1.0};
    const auto& r = d->direction_ratios.items;
    return {r[0], r[1], r[2]};
  }

  std::string texture(const exchange::StatedTexture& s) {
    const auto of = features_of(s.faces);
    if (of.empty() && !s.whole) return no_feature(s.faces);
    model::SurfaceTextureParameter t;
    t.its_id = "#" + std::to_string(s.id) + (parameters_[s.id] > 1 ? " " + s.parameter : "");
    t.its_value = s.value_um;
    t.parameter_name = s.parameter;
    t.measuring_method = s.method;
    t.its_workpiece = piece_;
    t.applied_surfaces.given = true;
    for (const MadeOf* f : of) {
      if (!m_.holds<model::MachiningFeature>(f->feature)) {  // a compound has no surface of its own
        t.applied_to.push_back(Ref<model::ManufacturingFeature>(f->feature));
        continue;
      }
      model::MachinedSurface surface;
      surface.its_machining_feature = Ref<model::MachiningFeature>(f->feature);
      surface.surface_element = element_of(*f, s.faces);
      t.applied_surfaces.push_back(m_.add(surface));
    }
    require(m_.add(t));
    return s.whole ? std::string() : rest(s.faces, of, {});
  }

  template <class T>
  void require(Ref<T> what) {
    m_.at<model::Workpiece>(piece_).its_requirements.push_back(what);
  }

  /// Digits of a tolerance: of a micrometre, as sizes are written here.
  static constexpr int kDigits = 3;

  const exchange::Brep& brep_;
  const std::vector<MadeOf>& made_;
  Ref<model::Workpiece> piece_;
  model::Plan& plan_;
  Model& m_;
  std::map<std::int64_t, std::vector<std::uint32_t>> face_of_;
  std::map<std::uint32_t, std::vector<std::size_t>> makers_;  ///< face -> into made_, ascending
  std::map<std::int64_t, std::size_t> parameters_;            ///< texture -> how many parameters it states
  std::map<std::string, Ref<model::Datum>> datums_;
  std::map<std::vector<std::vector<std::string>>, Ref<model::DatumSystem>> systems_;
  Attached out_;
};

}  // namespace

Attached attach_requirements(const exchange::Brep& brep, const std::vector<MadeOf>& made,
                             Ref<model::Workpiece> piece, model::Plan& plan) {
  return Attacher(brep, made, piece, plan).attach();
}

}  // namespace capstan::from_cad
