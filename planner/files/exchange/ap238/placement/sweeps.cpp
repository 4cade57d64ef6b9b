#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "planner/files/exchange/ap238/placement/frames.h"
#include "planner/files/exchange/ap238/read/auxiliary.h"
#include "planner/model/features/curve_points.h"
#include "planner/model/features/resolve.h"
#include "planner/model/nouns/arena/kept.h"

// Slots and steps. AP238's frame lies in the middle of the profile's bottom where the travel starts, z along
// the travel, y out of the material. How the plan states it (any direction of travel, placements of path and
// profile) goes along in representations of their own, named below; they count as long as they agree with the
// frame.

namespace capstan::exchange::ap238::frames {

using model::AnyRef;
using model::KeptInstance;
using model::Model;
using model::Ref;

namespace {

constexpr const char* kFrame = "placement on top";
constexpr const char* kPath = "placement of the path on top";
constexpr const char* kDirection = "direction of the path on top";
constexpr const char* kProfile = "placement of the profile on top";
constexpr const char* kDepth = "depth on top";

constexpr double kAgree = 1e-5;  // the uncertainty of what is written

struct Sweep {
  Ref<model::TravelPath> path;
  Ref<model::OpenProfile> profile;
};

Sweep sweep_of(const Model& m, AnyRef feature) {
  // Instances kept in their place have no meaning here.
  const auto understood = [&](AnyRef path, AnyRef profile) {
    return Sweep{
        m.holds<model::TravelPath>(path) ? Ref<model::TravelPath>(path) : Ref<model::TravelPath>(),
        m.holds<model::OpenProfile>(profile) ? Ref<model::OpenProfile>(profile) : Ref<model::OpenProfile>()};
  };
  if (const auto* s = m.get<model::Slot>(feature)) return understood(s->course_of_travel, s->swept_shape);
  const auto& s = m.at<model::Step>(feature);
  return understood(s.open_boundary, s.wall_boundary);
}

void set_path(Model& m, AnyRef feature, AnyRef path) {
  if (auto* s = m.get<model::Slot>(feature)) {
    s->course_of_travel = Ref<model::TravelPath>(path);
  } else {
    m.at<model::Step>(feature).open_boundary = Ref<model::LinearPath>(path);
  }
}

void set_profile(Model& m, AnyRef feature, AnyRef profile) {
  if (auto* s = m.get<model::Slot>(feature)) {
    s->swept_shape = Ref<model::OpenProfile>(profile);
  } else {
    m.at<model::Step>(feature).wall_boundary = Ref<model::VeeProfile>(profile);
  }
}

/// AP238's frame in the model's: where and whither the path starts, lowered by the depth. Nothing when the
/// path goes nowhere in the plane, or is not understood.
std::optional<Placement> start_of(const Model& m, AnyRef path, const Placement& at, AnyRef its_direction,
                                  double depth_mm) {
  Vec3 start, along;
  if (m.holds<model::LinearPath>(path)) {
    const auto d = model::direction(m, Ref<model::Direction>(its_direction));
    if (!d) return std::nullopt;
    along = *d;
  } else if (const auto* c = m.get<model::CircularPath>(path)) {
    const auto r = model::length(m, c->radius);
    if (!r) return std::nullopt;
    start = {r->nominal_mm, 0.0, 0.0};
    along = {0.0, 1.0, 0.0};
  } else if (const auto* g = m.get<model::GeneralPath>(path)) {
    const auto points = model::curve_points(m, g->swept_path, 0.01);
    if (!points || points->size() < 2) return std::nullopt;
    start = points->front();
    along = (*points)[1] - start;
  }
  start = at.to_parent(start);
  along = at.direction_to_parent(along);
  along.z = 0.0;
  const double length = norm(along);
  if (!(length > 1e-9)) return std::nullopt;
  const Vec3 z = (1.0 / length) * along;
  return Placement{
      .origin = {start.x, start.y, -depth_mm}, .x = {-z.y, z.x, 0.0}, .y = {0.0, 0.0, 1.0}, .z = z};
}

/// Depth of AP238's frame below the top, mm; nothing if the depth is not along the axis: then it is on top.
std::optional<double> sunk(const Model& m, AnyRef feature) {
  const auto depth = model::depth_of(m, feature);
  return depth && !depth->tilted ? std::optional(depth->depth_mm) : std::nullopt;
}

/// The limit of an open profile lies on top: its plane in AP238's frame.
Placement limit(double depth_mm) {
  return {.origin = {0.0, depth_mm, 0.0}, .x = {1.0, 0.0, 0.0}, .y = {0.0, 0.0, -1.0}, .z = {0.0, 1.0, 0.0}};
}

// --- what goes along ---

AnyRef kept(model::Plan& plan, std::string keyword, std::vector<std::variant<std::string, AnyRef>> pieces) {
  KeptInstance out;
  out.keyword = std::move(keyword);
  out.pieces = std::move(pieces);
  out.schema = model::KeptSchema::kAp238;
  const AnyRef at = plan.model.add(std::move(out));
  plan.kept.push_back(at);
  return at;
}

// The feature's PRODUCT_DEFINITION_SHAPE, which its own rows make.
AnyRef shape_of(model::Plan& plan, AnyRef feature) {
  for (const Row* row : Mapping::instance().rows_of(feature.type)) {
    if (row->attribute.size() != 1 || row->attribute.front() != "feature_placement") continue;
    const auto path = Mapping::instance().prefix_text(row->steps.front().prefix);
    return plan.model.add(auxiliary_instance(feature, {std::string(path), 0}));
  }
  throw std::logic_error("mapping tables: features have no placement");
}

/// Copies the decisions on one object to its copy, which is the one that the file holds.
void decided_alike(model::Plan& plan, AnyRef from, AnyRef copy) {
  std::vector<std::pair<std::string, model::Decision>> known;
  for (const auto& [key, d] : plan.ledger.entries()) {
    if (key.object == from) known.emplace_back(key.attribute, d);
  }
  for (auto& [attribute, d] : known) plan.ledger.set({copy, attribute}, std::move(d));
}

void state(model::Plan& plan, AnyRef shape, AnyRef context, const char* role, AnyRef what) {
  if (!what.set()) return;
  const AnyRef drawn = kept(plan, "SHAPE_REPRESENTATION",
                            {"SHAPE_REPRESENTATION('" + std::string(role) + "',(", what, "),", context, ")"});
  kept(plan, "PROPERTY_DEFINITION_REPRESENTATION",
       {"PROPERTY_DEFINITION_REPRESENTATION(", shape, ",", drawn, ")"});
}

AnyRef stated(Reader& reader, AnyRef feature, const char* role) {
  const Graph& g = reader.graph();
  const auto is = [&](Node n, const char* e) { return g.is(n, g.schema().find(e)); };
  const Node root = reader.root_of(feature);
  if (root == kNoNode) return {};
  for (const Node p : g.users(root)) {
    if (!is(p, "PROPERTY_DEFINITION")) continue;
    for (const Node r : g.users(p)) {
      if (!is(r, "PROPERTY_DEFINITION_REPRESENTATION")) continue;
      std::vector<Node> shapes, items;
      g.references(g.get(r, "used_representation"), shapes);
      if (shapes.empty() || !g.get(shapes.front(), "name").is(p21::Kind::kString) ||
          g.get(shapes.front(), "name").as_text() != role) {
        continue;
      }
      g.references(g.get(shapes.front(), "items"), items);
      if (!items.empty())
        return reader.object_at(items.front(), {}, reader.units().scale(shapes.front(), Scale{}));
    }
  }
  return {};
}

/// Height of a limit above AP238's frame; nothing if it does not lie across the profile.
std::optional<double> limit_height(const Model& m, AnyRef depth) {
  const auto* plane = m.get<model::ElementarySurface>(depth);  // null: kept, and without meaning here
  const auto surface = model::placement(m, plane != nullptr ? plane->position : PlacementRef{});
  if (!surface || !(std::abs(surface->z.y) > 1.0 - 1e-9)) return std::nullopt;
  return surface->origin.y;
}

double apart(const Placement& a, const Placement& b) {
  return norm(a.origin - b.origin) + norm(a.x - b.x) + norm(a.y - b.y) + norm(a.z - b.z);
}

/// Restores the frame that the plan stated, if it agrees with AP238's data. A frame that cannot be turned is
/// stated as it is.
bool restore(Reader& reader, AnyRef feature, const Placement& frame) {
  Model& m = reader.plan().model;
  const Sweep s = sweep_of(m, feature);
  const PlacementRef top(stated(reader, feature, kFrame));
  if (!top) return false;
  const PlacementRef at(stated(reader, feature, kPath));
  const AnyRef d = stated(reader, feature, kDirection), depth = stated(reader, feature, kDepth);
  const PlacementRef profile(stated(reader, feature, kProfile));
  const auto outer = model::placement(m, top);
  const auto inner = model::placement_or_identity(m, at);
  if (outer && apart(*outer, frame) <= kAgree) return true;
  auto& f = m.at<model::MachiningFeature>(feature);
  const auto before = f.depth;
  *static_cast<AnyRef*>(&f.depth) = depth;
  const auto h = sunk(m, feature);
  const auto start =
      s.path && outer && inner ? start_of(m, s.path, *inner, d, h.value_or(0.0)) : std::nullopt;
  const auto limit = limit_height(m, before);
  const bool limit_agrees = !before || (h && (!limit || std::abs(*limit - *h) <= kAgree));
  if (!start || !limit_agrees || apart(compose(*outer, *start), frame) > kAgree) {
    f.depth = before;
    reader.about(reader.root_of(feature), {.code = "EXC-PLACEMENT",
                                           .severity = Severity::kWarning,
                                           .message = "how the plan stated this feature no longer agrees "
                                                      "with its placement or limit; these are taken"});
    return false;
  }
  f.feature_placement = top;
  m.at<model::TravelPath>(s.path).placement = at;
  if (auto* line = m.get<model::LinearPath>(s.path)) line->its_direction = Ref<model::Direction>(d);
  if (s.profile) m.at<model::OpenProfile>(s.profile).placement = profile;
  return true;
}

/// How far the profile reaches out of the material.
std::optional<double> profile_depth(const Model& m, AnyRef profile) {
  Ref<model::TolerancedLengthMeasure> at;
  if (const auto* p = m.get<model::SquareUProfile>(profile)) at = p->depth;
  if (const auto* p = m.get<model::RoundedUProfile>(profile)) at = p->depth;
  if (const auto* p = m.get<model::TeeProfile>(profile)) at = p->depth;
  const auto l = model::length(m, at);
  return l ? std::optional(l->nominal_mm) : std::nullopt;
}

}  // namespace

void sweep_to_ap238(model::Plan& plan, AnyRef feature, std::vector<std::string>& losses) {
  Model& m = plan.model;
  const Sweep s = sweep_of(m, feature);
  const auto depth_mm = sunk(m, feature);
  auto& f = m.at<model::MachiningFeature>(feature);
  const auto frame = model::placement_or_identity(m, f.feature_placement);
  if (!frame) {
    losses.push_back(feature_name(m, feature) +
                     ": its placement is not understood; it goes to AP238 unturned");
    return;
  }
  const auto* path = m.get<model::TravelPath>(s.path);
  const auto* line = m.get<model::LinearPath>(s.path);
  const auto at = model::placement_or_identity(m, path == nullptr ? PlacementRef{} : path->placement);
  const AnyRef d = line == nullptr ? AnyRef{} : AnyRef(line->its_direction);
  const auto start =
      path != nullptr && at ? start_of(m, s.path, *at, d, depth_mm.value_or(0.0)) : std::nullopt;

  const AnyRef context =
      kept(plan, "GEOMETRIC_REPRESENTATION_CONTEXT+REPRESENTATION_CONTEXT",
           {"(GEOMETRIC_REPRESENTATION_CONTEXT(3)REPRESENTATION_CONTEXT('','placement on top'))"});
  const AnyRef shape = shape_of(plan, feature);
  state(plan, shape, context, kFrame,
        f.feature_placement.set() ? AnyRef(f.feature_placement) : AnyRef(placement(m, *frame)));
  if (!start) {
    losses.push_back(feature_name(m, feature) +
                     ": its path is not understood; its placement in AP238 is on top, not along the travel");
    return;
  }
  const PlacementRef turned = placement(m, compose(*frame, *start));
  const AnyRef own_path = copy_of(m, s.path);
  decided_alike(plan, s.path, own_path);
  state(plan, shape, context, kPath, m.at<model::TravelPath>(s.path).placement);
  state(plan, shape, context, kDirection, d);
  const auto* unknown = m.get<KeptInstance>(f.depth);
  if (unknown == nullptr || unknown->schema == model::KeptSchema::kAp238) {
    state(plan, shape, context, kDepth, f.depth);
  }
  if (f.depth && !depth_mm) {
    losses.push_back(
        feature_name(m, feature) +
        ": its depth is not one along its axis; it has no limit in AP238, and begins at the top");
  }
  if (auto* own = m.get<model::LinearPath>(own_path)) {
    own->its_direction = direction(m, {0.0, 0.0, 1.0});
    own->placement = turned;
  } else {
    m.at<model::TravelPath>(own_path).placement = placement(m, compose(inverse(*start), *at));
  }
  set_path(m, feature, own_path);
  if (s.profile && m.at<model::OpenProfile>(s.profile).placement) {
    const auto q = m.at<model::OpenProfile>(s.profile).placement;
    state(plan, shape, context, kProfile, q);
    if (const auto inside = model::placement(m, q)) {
      const AnyRef own = copy_of(m, s.profile);
      decided_alike(plan, s.profile, own);
      m.at<model::OpenProfile>(own).placement = placement(m, compose(inverse(*start), *inside));
      set_profile(m, feature, own);
    }
  }
  f.feature_placement = turned;
  f.depth = {};
  if (depth_mm) f.depth = plane(m, limit(*depth_mm), "limit");
}

void sweep_to_model(Reader& reader, AnyRef feature) {
  Model& m = reader.plan().model;
  auto& f = m.at<model::MachiningFeature>(feature);
  const auto frame = model::placement_or_identity(m, f.feature_placement);
  if (!frame || restore(reader, feature, *frame)) return;
  const Sweep s = sweep_of(m, feature);
  std::optional<double> depth_mm;
  double up = 0.0;
  if (const auto limit = limit_height(m, f.depth); limit && std::abs(*limit) > 1e-9) {
    depth_mm = std::abs(*limit);
    up = std::max(*limit, 0.0);
  }
  if (!depth_mm && s.profile) {
    depth_mm = profile_depth(m, s.profile);
    up = depth_mm.value_or(0.0);
  }
  if (!depth_mm) {
    reader.about(reader.root_of(feature),
                 {.code = "EXC-DEPTH",
                  .severity = Severity::kWarning,
                  .message = "neither a limit nor the profile says how deep this is"});
  }
  const Placement top{
      .origin = {0.0, up, 0.0}, .x = {-1.0, 0.0, 0.0}, .y = {0.0, 0.0, 1.0}, .z = {0.0, 1.0, 0.0}};
  const Placement back = inverse(top);
  if (s.path) {
    auto& path = m.at<model::TravelPath>(s.path);
    auto* line = m.get<model::LinearPath>(s.path);
    if (path.placement || line == nullptr) {
      const auto at = model::placement_or_identity(m, path.placement);
      if (at) path.placement = placement(m, compose(back, *at));
    } else if (const auto d = model::direction(m, line->its_direction)) {
      line->its_direction = direction(m, back.direction_to_parent(*d));
    }
  }
  if (s.profile && m.at<model::OpenProfile>(s.profile).placement) {
    auto& at = m.at<model::OpenProfile>(s.profile).placement;
    if (const auto q = model::placement(m, at)) at = placement(m, compose(back, *q));
  }
  f.feature_placement = placement(m, compose(*frame, top));
  f.depth = {};
  if (depth_mm) {
    Placement bottom;
    bottom.origin.z = -*depth_mm;
    f.depth = plane(m, bottom, "depth");
  }
}

}  // namespace capstan::exchange::ap238::frames
