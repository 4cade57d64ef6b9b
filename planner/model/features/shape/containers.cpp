#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/features/resolve.h"
#include "planner/model/features/shape/build.h"
#include "planner/model/features/shape/patterns.h"
#include "planner/model/nouns/geometric_item.h"
#include "planner/model/nouns/support.h"

// Compounds and patterns: the places of their elements.
//
// The standard's reading: elements are placed relative to their compound, the base of a pattern and its
// locations relative to the pattern, and so on through what is nested (ISO 14649-11, example 2; ISO 10303-214
// says the same of placed compounds). Published files also state elements in workpiece coordinates. So a
// compound or pattern is built by the standard's reading, and where that puts an element outside the piece it
// is built again with its elements in workpiece coordinates; that reading is taken only when it brings all of
// them inside, and then each shape says so in its assumptions. Where both are possible the standard's is
// taken. `decided` is the one place where this is decided; an element that is asked for alone (`standing`) is
// placed by the same decision of what holds it.
//
// Threads and edges have no place of their own: they are where the feature is that they are on.

namespace capstan::model::shape {

using geometry::Placement;
using geometry::Vec3;

namespace {

constexpr double kTurnedDeg = 1e-6;        // below it a rotation is none; rounding of a file's numbers
constexpr std::size_t kMaxPlaces = 1'000;  // in which one element is listed

std::string place(const Vec3& p) {
  const std::string out = "X" + trimmed(p.x, 2) + " Y" + trimmed(p.y, 2);
  return std::abs(p.z) < kSamePlace ? out : out + " Z" + trimmed(p.z, 2);
}

/// Whether the noun has a place of its own. Threads and edges have that of the feature that they are on.
bool placed(const Model& m, AnyRef feature) {
  return m.holds<Two5dManufacturingFeature>(feature) && !m.holds<Thread>(feature);
}

Result<Placement> own_placement(const Model& m, AnyRef feature) {
  const auto* f = m.get<Two5dManufacturingFeature>(feature);
  if (f == nullptr) return Placement{};
  return placement_or_identity(m, f->feature_placement);
}

/// What a reading makes of a compound or pattern.
struct Built {
  Shapes shapes;
  std::vector<Placement> own;  ///< the placements of its elements or base, as they are stated
};

/// A reading: the coordinates of the elements (or base), and of the locations of a general pattern.
struct Reading {
  Within elements;
  Placement locations;
  const char* absolute = nullptr;  ///< what is read as workpiece coordinates; null: nothing
};

struct Decided {
  Within elements;
  Shapes shapes;
};

bool inside(const Built& built, const Within& in) {
  return std::all_of(built.shapes.begin(), built.shapes.end(),
                     [&](const FeatureShape& s) { return in.piece->holds(s); }) &&
         std::all_of(built.own.begin(), built.own.end(),
                     [&](const Placement& p) { return in.piece->has(compose(in.frame, p).origin); });
}

/// The reading of a compound or pattern, and what it makes. `build` makes shapes of a reading.
template <class Build>
Result<Decided> decided(const Model& m, AnyRef self, const Within& in, Build&& build) {
  const auto own = own_placement(m, self);
  if (!own) return tl::unexpected(own.error());
  const Placement frame = in.container.set() ? compose(in.frame, *own) : *own;
  const auto within = [&](const Placement& f, bool by_the_standard) {
    return Within{f, self, in.depth + 1, by_the_standard, in.piece};
  };
  const Reading standard{within(frame, true), frame, nullptr};
  auto first = build(standard);
  if (!first) return tl::unexpected(first.error());
  Decided plain{standard.elements, first->shapes};
  if (in.by_the_standard) return plain;
  // An element whose placement repeats its container's may well mean the workpiece: then its top, too, must
  // be in the piece; else what meets the piece at all is taken for placed by the standard.
  const bool repeats = std::any_of(first->own.begin(), first->own.end(), [&](const Placement& p) {
    return same(p, *own) && !same(p, Placement{});
  });
  const auto beyond = std::find_if(first->shapes.begin(), first->shapes.end(),
                                   [&](const FeatureShape& s) { return !in.piece->meets(s, repeats); });
  if (beyond == first->shapes.end()) {
    if (!repeats) return plain;
    const auto other = build({within(Placement{}, true), frame, nullptr});
    if (!other || !inside(*other, within(Placement{}, true))) return plain;
    const std::string text =
        std::string("its ") + (m.holds<CompoundFeature>(self) ? "elements repeat" : "base repeats") +
        " its placement; read relative to it, as the standard has it, at " +
        place(middle(first->shapes.front(), 0.0)) + "; in workpiece coordinates that would be " +
        place(middle(other->shapes.front(), 0.0));
    for (FeatureShape& s : plain.shapes) s.assumptions.push_back(text);
    return plain;
  }
  const Placement workpiece{};
  std::vector<Reading> readings{{within(frame, false), frame, nullptr}};
  if (!same(frame, workpiece)) {
    readings.push_back({within(workpiece, false), frame, "placement of its elements"});
    if (m.holds<GeneralPattern>(self)) {
      readings.push_back({within(workpiece, false), workpiece, "placement of its base and its locations"});
      readings.push_back({within(frame, false), workpiece, "its locations"});
    }
  }
  for (const Reading& r : readings) {
    auto out = build(r);
    if (!out || !inside(*out, r.elements)) continue;
    if (r.absolute != nullptr) {
      const std::string text = std::string(r.absolute) + " read as workpiece coordinates: relative to the " +
                               (m.holds<CompoundFeature>(self) ? "compound" : "pattern") +
                               " they would lie at " + place(middle(*beyond, 0.0)) + ", outside the piece";
      for (FeatureShape& s : out->shapes) s.assumptions.push_back(text);
    }
    return Decided{r.elements, std::move(out->shapes)};
  }
  return plain;
}

/// Shapes of an element as those of what lists it.
void take(Shapes& out, Shapes&& part, AnyRef self, AnyRef element, const Text& name) {
  for (FeatureShape& s : part) {
    s.feature = self;
    s.name = name.value_or(s.name);
    s.made_of.insert(s.made_of.begin(), element);
    out.push_back(std::move(s));
  }
}

Result<Decided> decide(const Model& m, AnyRef self, const CompoundFeature& f, const Within& in) {
  if (f.elements.empty()) return missing(m, self, "elements");
  return decided(m, self, in, [&](const Reading& r) -> Result<Built> {
    Built out;
    for (const AnyRef element : f.elements.items) {
      auto part = any(m, element, r.elements);
      if (!part) return tl::unexpected(part.error());
      const auto own = own_placement(m, element);
      if (own && placed(m, element)) out.own.push_back(*own);
      take(out.shapes, *std::move(part), self, element, f.its_id);
      if (out.shapes.size() > kMaxCopies) return unsupported(m, self, "has more than 100,000 elements");
    }
    return out;
  });
}

Result<Decided> decide(const Model& m, AnyRef self, const ReplicateFeature& f, const Within& in) {
  return decided(m, self, in, [&](const Reading& r) -> Result<Built> {
    const auto basis = any(m, f.replicate_base_feature, r.elements);
    if (!basis) return tl::unexpected(basis.error());
    const AnyRef base_feature = f.replicate_base_feature;
    const auto own = own_placement(m, base_feature);
    if (!own) return tl::unexpected(own.error());
    Built out;
    const bool by_itself = placed(m, base_feature);
    const Placement stands = by_itself ? compose(r.elements.frame, *own) : basis->front().frame;
    if (by_itself) out.own.push_back(*own);
    const auto own_frame = own_placement(m, self);
    if (!own_frame) return tl::unexpected(own_frame.error());
    const Placement about = in.container.set() ? compose(in.frame, *own_frame) : *own_frame;
    std::string assumed;
    const auto frames = pattern_frames(m, self, *basis, {about, r.locations, stands}, assumed);
    if (!frames) return tl::unexpected(frames.error());
    for (const Placement& frame : *frames) {
      Shapes copy = *basis;
      const bool moved = !same(frame, stands);
      for (FeatureShape& s : copy) {
        if (moved) s.frame = compose(frame, compose(inverse(stands), s.frame));
        if (!assumed.empty()) s.assumptions.push_back(assumed);
      }
      take(out.shapes, std::move(copy), self, base_feature, f.its_id);
    }
    return out;
  });
}

Result<Decided> decide(const Model& m, AnyRef self, const Within& in) {
  if (in.depth > kNesting) return unsupported(m, self, "is nested too deeply, or in itself");
  if (const auto* c = m.get<CompoundFeature>(self)) return decide(m, self, *c, in);
  if (const auto* p = m.get<ReplicateFeature>(self)) return decide(m, self, *p, in);
  // A boss is placed in the coordinates of its pocket.
  return Decided{{in.frame, in.container, in.depth, in.by_the_standard, in.piece}, {}};
}

/// The coordinates in which a feature is stated: one for each place where it is listed.
Result<std::vector<Within>> coordinates(const Model& m, AnyRef feature, const Within& in, int upwards) {
  if (upwards > kNesting) return unsupported(m, feature, "is nested too deeply, or in itself");
  std::vector<Within> out;
  for (const AnyRef holder : holders(m, feature)) {
    const auto outer = coordinates(m, holder, in, upwards + 1);
    if (!outer) return outer;
    for (const Within& w : *outer) {
      if (auto d = decide(m, holder, w)) {
        out.push_back(d->elements);
      } else {  // another element cannot be read: the standard's reading
        const auto own = own_placement(m, holder);
        if (!own) return tl::unexpected(own.error());
        out.push_back({compose(w.frame, *own), holder, w.depth + 1, true, w.piece});
      }
      if (out.size() > kMaxPlaces) return unsupported(m, feature, "is listed in more than 1,000 places");
    }
  }
  if (out.empty()) out.push_back(in);
  return out;
}

}  // namespace

const RefList<Boss>* bosses_of(const Model& m, AnyRef feature) {
  if (const auto* f = m.get<Pocket>(feature)) return &f->its_boss;
  if (const auto* f = m.get<PlanarFace>(feature)) return &f->its_boss;
  if (const auto* f = m.get<Step>(feature)) return &f->its_boss;
  return nullptr;
}

std::vector<AnyRef> holders(const Model& m, AnyRef feature) {
  std::vector<AnyRef> out;
  const auto lists = [&](const auto& items) {
    return std::any_of(items.begin(), items.end(), [&](const auto& i) { return AnyRef(i) == feature; });
  };
  for (const AnyRef r : m.all_below(TypeId::kCompoundFeature)) {
    if (lists(m.at<CompoundFeature>(r).elements.items)) out.push_back(r);
  }
  for (const AnyRef r : m.all_below(TypeId::kReplicateFeature)) {
    if (AnyRef(m.at<ReplicateFeature>(r).replicate_base_feature) == feature) out.push_back(r);
  }
  if (!m.holds<Boss>(feature)) return out;
  for (const AnyRef r : m.all_below(TypeId::kMachiningFeature)) {
    if (const auto* bosses = bosses_of(m, r); bosses != nullptr && lists(bosses->items)) out.push_back(r);
  }
  return out;
}

Result<Shapes> compound(const Model& m, AnyRef self, const CompoundFeature& f, const Within& in) {
  auto out = decide(m, self, f, in);
  if (!out) return tl::unexpected(out.error());
  return std::move(out->shapes);
}

Result<Shapes> replicate(const Model& m, AnyRef self, const ReplicateFeature& f, const Within& in) {
  auto out = decide(m, self, f, in);
  if (!out) return tl::unexpected(out.error());
  if (const auto* c = m.get<CircularPattern>(self)) {
    const double turn_deg = c->base_feature_rotation.value_or(0.0) * 180.0 / std::numbers::pi;
    const AnyRef base = f.replicate_base_feature;
    const bool round = !m.holds<CompoundFeature>(base) && !m.holds<ReplicateFeature>(base) &&
                       std::all_of(out->shapes.begin(), out->shapes.end(), [](const FeatureShape& s) {
                         return model::has(s.kind, ShapeTrait::kRound);
                       });
    if (std::abs(turn_deg) > kTurnedDeg && !round) {
      return unsupported(m, self,
                         "its base_feature_rotation of " + trimmed(turn_deg, 3) +
                             " degrees turns members that are not round, and ISO 14649-10 does not say about "
                             "which axis: state each member with its own placement, in a general_pattern");
    }
  }
  return std::move(out->shapes);
}

Result<Shapes> standing(const Model& m, AnyRef feature, const Within& in) {
  if (!feature.set()) return fail("SHP-MISSING", "a feature is missing");
  if (in.depth > kNesting) return unsupported(m, feature, "is nested too deeply, or in itself");
  const auto places = coordinates(m, feature, in, in.depth);
  if (!places) return tl::unexpected(places.error());
  Shapes out;
  for (const Within& w : *places) {
    auto part = any(m, feature, w);
    if (!part) return part;
    out.insert(out.end(), std::make_move_iterator(part->begin()), std::make_move_iterator(part->end()));
  }
  return out;
}

Result<Within> stated_in(const Model& m, AnyRef feature, const Within& in) {
  auto places = coordinates(m, feature, in, in.depth);
  if (!places) return tl::unexpected(places.error());
  return places->front();
}

Result<Shapes> referred(const Model& m, AnyRef feature, const Within& in) {
  Within next = in;
  ++next.depth;
  if (in.container.set()) {
    const auto by = holders(m, feature);
    if (std::find(by.begin(), by.end(), in.container) != by.end()) return any(m, feature, next);
  }
  return standing(m, feature, Within{{}, {}, in.depth + 1, false, in.piece});
}

}  // namespace capstan::model::shape

namespace capstan::model {

std::set<AnyRef> parts_of_others(const Model& m) {
  std::set<AnyRef> out;
  for (const AnyRef f : m.all_below(TypeId::kManufacturingFeature)) {
    if (const auto* bosses = shape::bosses_of(m, f)) out.insert(bosses->items.begin(), bosses->items.end());
    if (const auto* c = m.get<CompoundFeature>(f))
      out.insert(c->elements.items.begin(), c->elements.items.end());
    if (const auto* p = m.get<ReplicateFeature>(f)) out.insert(p->replicate_base_feature);
  }
  out.erase(AnyRef{});
  return out;
}

}  // namespace capstan::model
