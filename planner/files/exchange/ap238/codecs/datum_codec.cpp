#include "planner/files/exchange/ap238/codecs/tolerance_codec.h"
#include "planner/ground/base/text.h"
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

// --- what establishes a datum ---

bool read_established(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                      const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    const AnyRef to = reader.object_at(t.node, a.targets, t.scale);
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
  }
  return true;
}

void write_established(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                       Id root) {
  std::uint32_t i = 0;
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id target = to.set() ? writer.instance_of(to) : kNoId;
    if (target == kNoId) continue;
    if (model::is_a(to.type, TypeId::kManufacturingFeature)) writer.become(target, "datum_feature");
    ++i;
    writer.connect(row.steps.back(), writer.walk(row, owner, root, 1, i), target, i, owner);
  }
}

// --- references ---

// A reference has the shape of the datum it refers to.
void in_shape_of_datum(Writer& writer, Id root, AnyRef reference) {
  const auto& m = writer.model();
  const auto* r = m.get<model::DatumReference>(reference);
  if (r != nullptr && !r->referenced_datum && !r->its_elements.empty())
    r = m.get<model::DatumReference>(r->its_elements[0]);
  if (r != nullptr && r->referenced_datum) in_shape(writer, root, r->referenced_datum);
}

bool read_base(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  if (!reader.graph().is(found.front().node, "DATUM")) return false;
  assign_to(reader, at, a, AnyRef(reader.object_at(found.front().node, a.targets, found.front().scale)));
  return true;
}

void write_base(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data, Id root) {
  const Id datum = writer.instance_of(model::value_of<AnyRef>(a, data));
  if (datum != kNoId) writer.link(root, "base", datum);
  in_shape_of_datum(writer, root, owner);
}

bool read_common(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                 const std::vector<Terminal>& found) {
  bool any = false;
  for (const Terminal& t : found) {
    if (!reader.graph().is(t.node, "DATUM_REFERENCE_ELEMENT")) continue;
    const AnyRef to = reader.object_at(t.node, a.targets, t.scale);
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
    any = true;
  }
  return any;
}

void write_common(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data, Id root) {
  std::string list;
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id element = to.set() ? writer.instance_of(to) : kNoId;
    if (element == kNoId) continue;
    writer.turn_into(element, "datum_reference_element");
    list += (list.empty() ? "#" : ",#") + std::to_string(element);
  }
  writer.set(root, "base", "COMMON_DATUM_LIST((" + list + "))");
  in_shape_of_datum(writer, root, owner);
}

bool read_modifiers(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                    const std::vector<Terminal>& found) {
  model::TextList out;
  const Value list = reader.graph().get(found.front().node, "modifiers");
  for (std::size_t i = 0; list.is(Kind::kList) && i < list.size(); ++i) {
    const Value v = list[i].is(Kind::kTyped) ? list[i][0] : list[i];
    if (v.is(Kind::kEnumeration)) out.items.push_back(lower_text(v.enumeration()));
  }
  if (out.items.empty()) return false;
  out.given = true;
  assign_to(reader, at, a, std::move(out));
  return true;
}

void write_modifiers(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  for (const std::string& word : model::value_of<model::TextList>(a, data).items) {
    writer.set(root, "modifiers", "SIMPLE_DATUM_REFERENCE_MODIFIER(" + enumerated(word) + ")");
  }
}

bool read_valued(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                 const std::vector<Terminal>& found) {
  const Terminal& t = found.front();
  const Graph& g = reader.graph();
  if (a.storage == model::Storage::kText) {
    const Value v = g.get(t.node, "modifier_type");
    if (!v.is(Kind::kEnumeration)) return false;
    assign_to(reader, at, a, model::Text(lower_text(v.enumeration())));
    return true;
  }
  const Value v = g.get(t.node, "modifier_value");
  const Node n = v.is(Kind::kReference) ? g.find(v.reference()) : kNoNode;
  const auto x = n == kNoNode ? std::nullopt : reader.measure(n, a.unit, t.scale);
  if (!x) return false;
  assign_to(reader, at, a, model::Real(*x));
  return true;
}

void write_valued(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                  Id root) {
  const Id modifier = writer.walk(row, owner, root, 0, 0);
  if (a.storage == model::Storage::kText) {
    writer.set(modifier, "modifier_type", enumerated(*model::value_of<model::Text>(a, data)));
  } else {
    writer.link(modifier, "modifier_value",
                writer.measure(*model::value_of<model::Real>(a, data), a.unit, "", {}));
  }
}

// --- targets ---

bool read_description(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                      const std::vector<Terminal>& found) {
  const Value v = found.front().text;
  if (model::is_a(at.type, TypeId::kPlacedDatumTarget) || !v.is(Kind::kString) || v.as_text().empty())
    return false;
  assign_to(reader, at, a, model::Text(v.as_text()));
  return true;
}

void write_description(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data,
                       Id root) {
  if (model::is_a(owner.type, TypeId::kPlacedDatumTarget))
    return writer.lose("the description of a placed DATUM_TARGET");
  writer.set(root, "shape_aspect.description", Writer::quoted(*model::value_of<model::Text>(a, data)));
}

}  // namespace

const Codec kEstablishedByCodec{"established_by", &read_established, &write_established};
const Codec kDatumBaseCodec{"datum_base", &read_base, &write_base};
const Codec kCommonDatumCodec{"common_datum", &read_common, &write_common};
const Codec kDatumModifiersCodec{"datum_modifiers", &read_modifiers, &write_modifiers};
const Codec kValuedModifierCodec{"valued_modifier", &read_valued, &write_valued};
const Codec kTargetDescriptionCodec{"target_description", &read_description, &write_description};

}  // namespace capstan::exchange::ap238
