#include "planner/files/exchange/ap238/codecs/feature_codec.h"

#include <algorithm>

#include "planner/files/exchange/ap238/codecs/tolerance_codec.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::AnyRefList;
using model::Attribute;
using model::TypeId;
using p21::Kind;
using p21::Value;

namespace {

AnyRefList& list_at(Reader& reader, AnyRef at, const Attribute& a) {
  auto& out = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
  out.given = true;
  return out;
}

void append(Reader& reader, AnyRef at, const Attribute& a, const Terminal& t) {
  const AnyRef to = reader.object_at(t.node, a.targets, t.scale);
  list_at(reader, at, a).items.push_back(to);  // making an object may have moved what the attribute is in
  reader.mark(t, at);
}

// --- workpiece ---

bool read_workpiece(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                    const std::vector<Terminal>& found) {
  const AnyRef to = reader.object_at(found.front().node, a.targets, found.front().scale);
  if (!to.set()) return false;
  *static_cast<AnyRef*>(a.at(reader.plan().model.object(at))) = to;
  return true;
}

void write_workpiece(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  const AnyRef workpiece = model::value_of<AnyRef>(a, data);
  if (!workpiece.set()) return;
  if (const Id shape = shape_of(writer, workpiece); shape != kNoId) writer.link(root, "of_shape", shape);
}

// --- operations of a feature ---

bool read_operations(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  const EntityId workingstep = g.schema().find("MACHINING_WORKINGSTEP");
  const EntityId feature = g.schema().find("MACHINING_FEATURE_RELATIONSHIP");
  const EntityId operation = g.schema().find("MACHINING_OPERATION_RELATIONSHIP");
  bool any = false;
  for (const Terminal& t : found) {
    // Only by a workingstep that nothing carries out.
    const auto step = std::find_if(t.trail.begin(), t.trail.end(),
                                   [&](const auto& m) { return g.is(m.node, workingstep); });
    if (step == t.trail.end()) continue;
    const auto users = g.users(step->node);
    if (!std::all_of(users.begin(), users.end(),
                     [&](Node u) { return g.is(u, feature) || g.is(u, operation); }))
      continue;
    append(reader, at, a, t);
    any = true;
  }
  (void)row;
  return any;
}

void write_operations(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                      Id root) {
  std::uint32_t i = 0;
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id target = to.set() ? writer.instance_of(to) : kNoId;
    if (target == kNoId) continue;
    ++i;
    writer.connect(row.steps.back(), writer.walk(row, owner, root, 1, i), target, i, owner);
  }
}

// --- items of the part ---

bool read_items(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  for (const Terminal& t : found) append(reader, at, a, t);
  return true;
}

void write_faces(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  const auto* w = writer.model().get<model::Workpiece>(workpiece_of(writer.model(), owner));
  std::uint32_t i = 0;
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id target = to.set() ? writer.instance_of(to) : kNoId;
    if (target == kNoId) continue;
    ++i;
    const Id usage = writer.walk(row, owner, root, 1, i);
    writer.link(usage, "identified_item", target);
    const Id shape = w != nullptr && w->its_geometry ? writer.instance_of(w->its_geometry) : kNoId;
    if (shape != kNoId) writer.link(usage, "used_representation", shape);
  }
}

// --- ends of slots ---

bool read_ends(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  std::vector<const Terminal*> ends;
  for (const Terminal& t : found) ends.push_back(&t);
  const auto last = [&](const Terminal* t) {
    const Value name = t->trail.size() < 2 ? Value() : g.get(t->trail[t->trail.size() - 2].node, "name");
    return name.is(Kind::kString) && name.as_text() == "course of travel end";
  };
  std::stable_sort(ends.begin(), ends.end(),
                   [&](const auto* x, const auto* y) { return !last(x) && last(y); });
  for (const Terminal* t : ends) append(reader, at, a, *t);
  return true;
}

void write_ends(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  std::uint32_t i = 0;
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id target = to.set() ? writer.instance_of(to) : kNoId;
    if (target == kNoId) continue;
    ++i;
    const Id usage = writer.walk(row, owner, root, 1, i);
    writer.set(usage, "name", i == 1 ? "'course of travel start'" : "'course of travel end'");
    writer.connect(row.steps.back(), usage, target, i, owner);
  }
}

// --- beside a curve ---

bool read_beside(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                 const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  const EntityId curve = g.schema().find("BOUNDED_CURVE");
  bool taken = false, any = false;
  for (const Terminal& t : found) {
    if (!taken && g.is(t.node, curve)) {
      taken = true;  // the curve itself
      continue;
    }
    append(reader, at, a, t);
    any = true;
  }
  return any;
}

void write_beside(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                  Id root) {
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id target = to.set() ? writer.instance_of(to) : kNoId;
    if (target != kNoId)
      writer.connect(row.steps.back(), writer.walk(row, owner, root, 1, 0), target, 0, owner);
  }
}

}  // namespace

// A product definition has one shape: the instance that the workpiece's own rows lead through.
Id shape_of(Writer& writer, AnyRef workpiece) {
  const Id root = writer.instance_of(workpiece);
  if (root == kNoId) return kNoId;
  const EntityId shape = writer.schema().find("PRODUCT_DEFINITION_SHAPE");
  for (const Row* row : Mapping::instance().rows_of(TypeId::kWorkpiece)) {
    if (row->steps.empty() || !row->steps.front().inverse || row->steps.front().attribute != "definition")
      continue;
    if (row->steps.front().entities.front() != shape) continue;
    Row way = *row;
    way.steps.resize(1);
    return writer.walk(way, workpiece, root, 0, 0);
  }
  return kNoId;
}

const Codec kItsWorkpieceCodec{"its_workpiece", &read_workpiece, &write_workpiece};
const Codec kFeatureOperationsCodec{"feature_operations", &read_operations, &write_operations};
const Codec kFacesInPartCodec{"faces_in_part", &read_items, &write_faces};
const Codec kSlotEndsCodec{"slot_ends", &read_ends, &write_ends};
const Codec kBesideCodec{"beside", &read_beside, &write_beside};

}  // namespace capstan::exchange::ap238
