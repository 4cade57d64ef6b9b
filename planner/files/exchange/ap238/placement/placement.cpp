#include "planner/files/exchange/ap238/placement/placement.h"

#include <algorithm>
#include <cmath>

#include "planner/files/exchange/ap238/placement/frames.h"
#include "planner/files/exchange/ap238/placement/locations.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/arena/reached.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/nouns/placed_nouns.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Model;
using model::Ref;
using model::Storage;
using model::TypeId;

namespace frames {

Ref<model::Direction> direction(Model& m, Vec3 d, std::string_view name) {
  return model::add_direction(m, d, name);
}

PlacementRef placement(Model& m, const Placement& at, std::string_view name) {
  return model::add_placement(m, at, name);
}

Ref<model::ElementarySurface> plane(Model& m, const Placement& at, std::string_view name) {
  model::Plane out;
  out.name = std::string(name);
  out.position = placement(m, at);
  return Ref<model::ElementarySurface>(AnyRef(m.add(std::move(out))));
}

std::string name_of(const Model& m, AnyRef at) {
  const auto* d = m.get<model::Direction>(at);
  return d == nullptr ? std::string() : d->name.value_or("");
}

std::string feature_name(const Model& m, AnyRef feature) {
  const auto* f = m.get<model::ManufacturingFeature>(feature);
  return std::string(model::noun_type(feature.type).keyword) + " '" +
         (f == nullptr ? std::string() : f->its_id.value_or("")) + "'";
}

AnyRef copy_of(Model& m, AnyRef at) {
  const AnyRef out = m.add_object(at.type);
  m.set_origin(out, m.origin(at));
  const auto put = [&]<class T>(const Attribute& a, const T*) {
    *static_cast<T*>(a.at(m.object(out))) = model::value_of<T>(a, m.object(at));
  };
  for (const Attribute& a : model::noun_type(at.type).attributes) {
    switch (a.storage) {
      case Storage::kReal:
        put(a, static_cast<model::Real*>(nullptr));
        break;
      case Storage::kInteger:
        put(a, static_cast<model::Integer*>(nullptr));
        break;
      case Storage::kBoolean:
        put(a, static_cast<model::Boolean*>(nullptr));
        break;
      case Storage::kText:
        put(a, static_cast<model::Text*>(nullptr));
        break;
      case Storage::kRef:
        put(a, static_cast<AnyRef*>(nullptr));
        break;
      case Storage::kRefList:
        put(a, static_cast<model::AnyRefList*>(nullptr));
        break;
      default:
        throw std::logic_error("profiles and paths have no attribute such as " + std::string(a.name));
    }
  }
  return out;
}

}  // namespace frames

namespace {

using namespace frames;

// Depths nearer than this are the same; the uncertainty of what is written.
constexpr double kSame = 1e-5;

// --- profiles and paths: their placements ---

bool is_component(AnyRef at) {
  return model::is_a(at.type, TypeId::kProfile) || model::is_a(at.type, TypeId::kTravelPath);
}

PlacementRef& placement_in(Model& m, AnyRef component) {
  if (auto* p = m.get<model::Profile>(component)) return p->placement;
  return m.at<model::TravelPath>(component).placement;
}

template <class Visit>
void for_each_component(Model& m, AnyRef feature, const Visit& visit) {
  for (const Attribute& a : model::noun_type(feature.type).attributes) {
    if (a.storage != Storage::kRef) continue;
    const AnyRef to = model::value_of<AnyRef>(a, m.object(feature));
    if (to.set() && is_component(to)) visit(a, to);
  }
}

// Components without a placement have the feature's; AP238 requires it to be stated.
void place_components(Model& m, AnyRef feature, PlacementRef at, std::map<AnyRef, AnyRef>& placed) {
  if (!at) return;
  for_each_component(m, feature, [&](const Attribute& a, AnyRef to) {
    const auto before = placed.find(to);
    if (before != placed.end() &&
        before->second != AnyRef(at)) {  // shared with a feature at another placement
      const AnyRef own = copy_of(m, to);
      placement_in(m, own) = at;
      *static_cast<AnyRef*>(a.at(m.object(feature))) = own;
      return;
    }
    if (before != placed.end() || placement_in(m, to)) return;
    placement_in(m, to) = at;
    placed.emplace(to, at);
  });
}

// --- pockets and holes ---

struct Drilled {
  Ref<model::TravelPath>* course = nullptr;
  model::Boolean* bottom_at_end = nullptr;
};

Drilled drilled(Model& m, AnyRef feature) {
  if (auto* f = m.get<model::Pocket>(feature)) return {&f->course_of_travel, &f->bottom_at_path_end};
  if (auto* f = m.get<model::RoundHole>(feature)) return {&f->course_of_travel, &f->bottom_at_path_end};
  return {};
}

// Along the course of travel, in the feature's frame; nothing when it is not straight.
std::optional<Vec3> travel(const Model& m, AnyRef course) {
  const auto* path = m.get<model::LinearPath>(course);
  if (path == nullptr || !path->its_direction) return std::nullopt;
  const auto length = model::length(m, path->distance);
  const auto d = model::direction(m, path->its_direction);
  if (!length || !d) return std::nullopt;
  return length->nominal_mm * *d;
}

Ref<model::TolerancedLengthMeasure> length_of(Model& m, double mm) {
  model::TolerancedLengthMeasure out;
  out.theoretical_size = mm;
  return m.add(std::move(out));
}

// Explicit placements of profiles and paths are in the feature's frame, which moves by `local`.
void keep_in_place(Model& m, AnyRef feature, Vec3 local, AnyRef own) {
  for_each_component(m, feature, [&](const Attribute&, AnyRef to) {
    PlacementRef& at = placement_in(m, to);
    if (!at || AnyRef(at) == own) return;
    auto frame = model::placement(m, at);
    if (!frame) return;
    frame->origin = frame->origin - local;
    at = frames::placement(m, *frame);
  });
}

// False, with nothing changed, when the placement is not understood.
bool shift(Model& m, AnyRef feature, Vec3 local) {
  auto& f = m.at<model::Two5dManufacturingFeature>(feature);
  const auto frame = model::placement_or_identity(m, f.feature_placement);
  if (!frame) return false;
  keep_in_place(m, feature, local, f.feature_placement);
  const PlacementRef at = placement(m, moved(*frame, local));
  m.at<model::Two5dManufacturingFeature>(feature).feature_placement = at;
  return true;
}

void drilled_to_ap238(Model& m, AnyRef feature, std::vector<std::string>& losses) {
  const Drilled f = drilled(m, feature);
  const auto depth = model::depth_of(m, feature);
  if (!*f.course) {
    if (!depth || depth->tilted || !(depth->depth_mm > 0.0)) {
      // On top, as AP238 has it if the bottom is at the end of the course; no course states how deep.
      if (m.at<model::MachiningFeature>(feature).depth) {
        losses.push_back(feature_name(m, feature) +
                         ": its depth is not one along its axis; it has no course of travel in AP238");
      }
      return;
    }
    const AnyRef given = m.at<model::MachiningFeature>(feature).depth;
    const bool as_length = m.holds<model::TolerancedLengthMeasure>(given);
    model::LinearPath path;
    path.distance = as_length ? Ref<model::TolerancedLengthMeasure>(given) : length_of(m, depth->depth_mm);
    path.its_direction = direction(m, {0.0, 0.0, -1.0}, as_length ? kDerivedFromLength : kDerived);
    const AnyRef course = m.add(std::move(path));
    const Drilled again = drilled(m, feature);
    *again.course = Ref<model::TravelPath>(course);
    *again.bottom_at_end = true;
    return;
  }
  if (f.bottom_at_end->value_or(true)) return;
  // The course starts at the bottom: so does the frame, and the depth surface is left to the course.
  const auto along = travel(m, *f.course);
  if (!along || !shift(m, feature, {-along->x, -along->y, -along->z})) {
    losses.push_back(
        feature_name(m, feature) + ": its " + (along ? "placement" : "course of travel") +
        " is not understood; its placement in AP238 is on top, though its course of travel starts "
        "at the bottom");
    return;
  }
  m.at<model::MachiningFeature>(feature).depth = {};
}

void warn(const Reader& reader, AnyRef feature, const std::string& message) {
  reader.about(reader.root_of(feature),
               {.code = "EXC-DEPTH", .severity = Severity::kWarning, .message = message});
}

std::string mm(double v) {
  std::string out = std::to_string(v);
  while (out.back() == '0') out.pop_back();
  if (out.back() == '.') out.pop_back();
  return out;
}

void set_depth(Model& m, AnyRef feature, double depth_mm) {
  Placement at;
  at.origin.z = -depth_mm;
  m.at<model::MachiningFeature>(feature).depth = plane(m, at, "depth");
}

// z points into the material: turned half round about x.
void flip(Model& m, AnyRef feature) {
  auto& f = m.at<model::Two5dManufacturingFeature>(feature);
  const auto frame = model::placement_or_identity(m, f.feature_placement);
  if (!frame) return;
  const Placement turn{.origin = {}, .x = {1.0, 0.0, 0.0}, .y = {0.0, -1.0, 0.0}, .z = {0.0, 0.0, -1.0}};
  for_each_component(m, feature, [&](const Attribute& a, AnyRef to) {
    if (a.name == "course_of_travel") return;
    const auto own = model::placement_or_identity(m, placement_in(m, to));
    if (own) placement_in(m, to) = placement(m, compose(turn, *own));
  });
  if (auto* path = m.get<model::LinearPath>(*drilled(m, feature).course)) {
    const auto d = model::direction(m, path->its_direction);
    if (d) {
      const auto turned = direction(m, {d->x, -d->y, -d->z});
      m.get<model::LinearPath>(*drilled(m, feature).course)->its_direction = turned;
    }
  }
  const PlacementRef at = placement(m, compose(*frame, turn));
  m.at<model::Two5dManufacturingFeature>(feature).feature_placement = at;
}

// Files whose course of travel is the very direction that is the placement's axis mean one of the two only
// (the pocket of the standard's own example: its axis points into the part). The feature opens towards the
// security plane.
void right_way_up(Reader& reader, AnyRef feature, const std::vector<AnyRef>& steps) {
  Model& m = reader.plan().model;
  const auto at = m.at<model::Two5dManufacturingFeature>(feature).feature_placement;
  const auto* path = m.get<model::LinearPath>(*drilled(m, feature).course);
  const auto* axes = m.get<model::Axis2Placement3d>(at);  // null: kept, and without meaning here
  if (axes == nullptr || path == nullptr || !path->its_direction) return;
  if (AnyRef(path->its_direction) != AnyRef(axes->axis)) return;
  const auto frame = model::placement(m, at);
  if (!frame) return;
  for (const AnyRef s : steps) {
    const auto* plane = m.get<model::ElementarySurface>(m.at<model::MachiningWorkingstep>(s).its_secplane);
    if (plane == nullptr) continue;
    const auto security = model::placement(m, plane->position);
    if (!security || dot(security->z, frame->z) > -0.9) continue;
    Placement up = *frame;
    up.z = -1.0 * frame->z;
    up.y = -1.0 * frame->y;
    const PlacementRef turned = placement(m, up);
    m.at<model::Two5dManufacturingFeature>(feature).feature_placement = turned;
    reader.about(
        reader.root_of(feature),
        {.code = "EXC-PLACEMENT",
         .severity = Severity::kWarning,
         .message = "the axis of the placement is the direction of the course of travel and points away from "
                    "the security plane; it is taken the other way round"});
    return;
  }
}

// Removes a course of travel that was made from the depth, and keeps the depth. False: the depth was removed
// or the course reversed since; then it counts like any other.
bool drop_derived(Reader& reader, AnyRef feature) {
  Model& m = reader.plan().model;
  const Drilled f = drilled(m, feature);
  const auto* path = m.get<model::LinearPath>(*f.course);
  const std::string name = path == nullptr ? "" : name_of(m, path->its_direction);
  if (name != kDerived && name != kDerivedFromLength) return false;
  auto& given = m.at<model::MachiningFeature>(feature).depth;
  const auto along = travel(m, *f.course);
  const bool down = f.bottom_at_end->value_or(true) && (!along || along->z < 0.0);
  if (name == kDerivedFromLength && !given) {
    if (!down) return false;
    *static_cast<AnyRef*>(&given) = path->distance;
  } else {
    const auto depth = model::depth_of(m, feature);
    if (!depth) return false;
    if (!along || !down || std::abs(depth->depth_mm + along->z) > kSame) {
      warn(reader, feature,
           "the course of travel was made of the depth" +
               (along ? " and goes " + mm(along->z) + " mm along z now"
                      : std::string(" and has no length now")) +
               ", but the depth surface lies " + mm(depth->depth_mm) +
               " mm below the placement; the surface is taken, the placement for the top");
    } else if (name == kDerivedFromLength) {
      *static_cast<AnyRef*>(&given) = path->distance;
    }
  }
  *f.course = {};
  f.bottom_at_end->reset();
  return true;
}

void drilled_to_model(Reader& reader, AnyRef feature) {
  if (drop_derived(reader, feature)) return;
  Model& m = reader.plan().model;
  const Drilled f = drilled(m, feature);
  const auto along = travel(m, *f.course);
  const auto surface = m.at<model::MachiningFeature>(feature).depth;
  if (!along || !(std::abs(along->z) > kSame)) return;
  const bool known = f.bottom_at_end->has_value();
  const bool at_end = f.bottom_at_end->value_or(along->z < 0.0);
  if (surface) {
    const auto depth = model::depth_of(m, feature);
    if (!depth || depth->tilted) return;
    const double by_path = at_end ? -along->z : along->z;
    if (at_end && std::abs(depth->depth_mm - by_path) < kSame) return;
    if (!at_end &&
        std::abs(depth->depth_mm) < kSame) {  // the surface is where the course starts, at the bottom
      if (shift(m, feature, *along)) set_depth(m, feature, by_path);
      return;
    }
    if (!at_end && std::abs(depth->depth_mm + along->z) < kSame) {  // it is where the course ends, on top
      if (shift(m, feature, *along)) set_depth(m, feature, by_path);
      return;
    }
    warn(reader, feature,
         "the course of travel goes " + mm(along->z) + " mm along z from a placement " +
             (known ? (at_end ? "on top" : "at the bottom") : "that may be either") +
             ", but the depth surface lies " + mm(depth->depth_mm) +
             " mm below it; the surface is taken, the placement for the top");
    return;
  }
  if (at_end) {
    if (along->z > 0.0) flip(m, feature);
    set_depth(m, feature, std::abs(along->z));
    return;
  }
  if (along->z < 0.0) flip(m, feature);
  const auto up = travel(m, *drilled(m, feature).course);
  if (!up || !shift(m, feature, *up)) {
    warn(reader, feature,
         "the placement at the bottom, where the course of travel starts, is not understood; it stays there, "
         "without a depth");
    return;
  }
  set_depth(m, feature, std::abs(along->z));
}

// --- profiles ---

// A square U asks for the angles of its sides.
void sides(Model& m, bool to_ap238) {
  for (const AnyRef at : m.all(TypeId::kSquareUProfile)) {
    auto& p = m.at<model::SquareUProfile>(at);
    for (model::Real* angle : {&p.first_angle, &p.second_angle}) {
      if (to_ap238 && !*angle) {
        *angle = kUpright;
      } else if (!to_ap238 && *angle == kUpright) {
        angle->reset();
      }
    }
  }
}

// --- operations ---

// The operations of the plan's workingsteps on each feature, in the order of the plan.
std::map<AnyRef, std::vector<AnyRef>> by_workingstep(const model::Plan& plan) {
  std::vector<AnyRef> roots;
  if (plan.project) roots.push_back(plan.project);
  std::vector<AnyRef> steps = model::reached_of(plan.model, roots, TypeId::kMachiningWorkingstep);
  for (const AnyRef s : plan.model.all(TypeId::kMachiningWorkingstep)) steps.push_back(s);
  std::map<AnyRef, std::vector<AnyRef>> out;
  for (const AnyRef s : steps) {
    const auto* step = plan.model.get<model::MachiningWorkingstep>(s);
    if (step == nullptr || !step->its_feature || !AnyRef(step->its_operation).set()) continue;
    auto& list = out[step->its_feature];
    if (std::find(list.begin(), list.end(), AnyRef(step->its_operation)) == list.end())
      list.push_back(step->its_operation);
  }
  return out;
}

}  // namespace

std::vector<Unlisted> to_ap238(model::Plan& plan, std::vector<std::string>& losses) {
  std::vector<Unlisted> unlisted;
  Model& m = plan.model;
  const auto operations = by_workingstep(plan);
  const Locations locations(m);
  sides(m, true);
  std::map<AnyRef, AnyRef> placed;
  for (const AnyRef at : m.all_below(TypeId::kManufacturingFeature)) {
    {
      auto& f = m.at<model::ManufacturingFeature>(at);
      if (const auto known = operations.find(at); known != operations.end()) {
        auto& own = f.its_operations.items;
        for (const AnyRef o : known->second) {
          if (std::find(own.begin(), own.end(), o) == own.end()) unlisted.push_back({at, o});
        }
        if (known->second == own) own.clear();
      }
      // The schema has no feature without a part.
      const auto* project = m.get<model::Project>(plan.project);
      if (!f.its_workpiece && project != nullptr && !project->its_workpieces.empty()) {
        f.its_workpiece = Ref<model::Workpiece>(project->its_workpieces.items.front());
      }
    }
    if (auto* face = m.get<model::PlanarFace>(at); face != nullptr && !face->removal_direction) {
      const auto out = direction(m, {0.0, 0.0, 1.0}, kDerived);
      m.at<model::PlanarFace>(at).removal_direction = out;
    }
    if (drilled(m, at).course != nullptr) drilled_to_ap238(m, at, losses);
    if (m.holds<model::Slot>(at) || m.holds<model::Step>(at)) sweep_to_ap238(plan, at, losses);
    if (const auto* f = m.get<model::Two5dManufacturingFeature>(at))
      place_components(m, at, f->feature_placement, placed);
  }
  locations.follow(m);
  return unlisted;
}

void to_model(Reader& reader) {
  Model& m = reader.plan().model;
  const auto features = m.all_below(TypeId::kManufacturingFeature);
  const Locations locations(m);
  sides(m, false);
  for (const AnyRef at : features) {
    const auto* f = m.get<model::Two5dManufacturingFeature>(at);
    if (f == nullptr || !f->feature_placement) continue;
    for_each_component(m, at, [&](const Attribute&, AnyRef to) {
      if (AnyRef(placement_in(m, to)) == AnyRef(f->feature_placement)) placement_in(m, to) = {};
    });
  }
  std::map<AnyRef, std::vector<AnyRef>> steps;
  for (const AnyRef s : m.all(TypeId::kMachiningWorkingstep)) {
    if (const AnyRef f = m.at<model::MachiningWorkingstep>(s).its_feature; f.set()) steps[f].push_back(s);
  }
  for (const AnyRef at : features) {
    if (auto* face = m.get<model::PlanarFace>(at);
        face != nullptr && name_of(m, face->removal_direction) == kDerived) {
      face->removal_direction = {};
    }
    if (drilled(m, at).course != nullptr) {
      right_way_up(reader, at, steps[at]);
      drilled_to_model(reader, at);
    }
    if (m.holds<model::Slot>(at) || m.holds<model::Step>(at)) sweep_to_model(reader, at);
  }
  locations.follow(m);
  const auto operations = by_workingstep(reader.plan());
  for (const AnyRef at : features) {
    const auto known = operations.find(at);
    if (known == operations.end()) continue;
    auto& list = m.at<model::ManufacturingFeature>(at).its_operations;
    list.given = true;
    for (const AnyRef o : known->second) {
      if (std::find(list.items.begin(), list.items.end(), o) == list.items.end()) list.items.push_back(o);
    }
  }
}

}  // namespace capstan::exchange::ap238
