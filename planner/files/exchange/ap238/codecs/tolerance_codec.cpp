#include "planner/files/exchange/ap238/codecs/tolerance_codec.h"

#include <algorithm>

#include "planner/ground/base/text.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::AnyRefList;
using model::Attribute;
using model::TypeId;
using model::Unit;
using p21::Kind;
using p21::Value;

namespace {

constexpr const char* kGroup = "toleranced together";
constexpr const char* kRegardless = "regardless_of_feature_size";
constexpr std::uint32_t kFirstOwnOrdinal = 2000;  // of instances that no path of the row leads to

// The older conditions by the newer words.
std::string modifier_of_condition(const std::string& condition) {
  if (condition == "maximum_material_condition") return "maximum_material_requirement";
  if (condition == "least_material_condition") return "least_material_requirement";
  return condition;
}

// --- what it is stated of ---

bool read_toleranced(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  const Terminal& t = found.front();
  if (g.is(t.node, "PRODUCT_DEFINITION_SHAPE")) return false;  // of the whole part
  for (const Node n : members_of_group(reader, row, at, t.node)) {
    const AnyRef to = reader.object_at(n, a.targets, t.scale);
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
  }
  return true;
}

void write_toleranced(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data,
                      Id root) {
  const Id target = group_of(writer, owner, model::value_of<AnyRefList>(a, data).items);
  if (target != kNoId) writer.link(root, "toleranced_shape_aspect", target);
}

bool read_whole_part(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  const Node n = product_of(reader.graph(), found.front().node);
  if (n == kNoNode) return false;
  assign_to(reader, at, a, AnyRef(reader.object_at(n, a.targets, found.front().scale)));
  return true;
}

void write_whole_part(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data,
                      Id root) {
  const auto* t = writer.model().get<model::GeometricTolerance>(owner);
  if (t == nullptr || !t->applied_to.empty()) return;
  const Id shape = shape_of(writer, model::value_of<AnyRef>(a, data));
  if (shape != kNoId) writer.link(root, "toleranced_shape_aspect", shape);
}

// --- datums ---

AnyRef system_of(Reader& reader, const Row& row, AnyRef at, std::vector<Node> references) {
  const Graph& g = reader.graph();
  static constexpr TypeId kDatum[] = {TypeId::kDatum};
  const auto precedence = [&](Node n) {
    const Value v = g.get(n, "precedence");
    return v.is(Kind::kInteger) ? v.as_integer() : 0;
  };
  std::stable_sort(references.begin(), references.end(),
                   [&](Node x, Node y) { return precedence(x) < precedence(y); });
  model::Model& m = reader.plan().model;
  model::DatumSystem system;
  if (const Node part = product_of(g, g.referred(references.front(), "referenced_datum")); part != kNoNode) {
    static constexpr TypeId kPart[] = {TypeId::kWorkpiece};
    system.its_workpiece = model::Ref<model::Workpiece>(reader.object_at(part, kPart, Scale{}));
  }
  std::uint32_t k = kFirstOwnOrdinal;
  for (const Node n : references) {
    model::DatumReference r;
    const Node datum = g.referred(n, "referenced_datum");
    if (datum != kNoNode)
      r.referenced_datum = model::Ref<model::Datum>(reader.object_at(datum, kDatum, Scale{}));
    const Value modifier = g.get(n, "modifier");
    if (modifier.is(Kind::kEnumeration)) {
      r.modifiers.items.push_back(modifier_of_condition(lower_text(modifier.enumeration())));
      r.modifiers.given = true;
    }
    const auto ref = m.add(std::move(r));
    m.set_origin(ref, {g.instance(n).id(), g.instance(n).line()});
    system.constituents.push_back(ref);
    mark_one(reader, row, at, n, k++);
  }
  return m.add(std::move(system));
}

bool read_datums(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                 const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  std::vector<Node> systems, references;
  g.references(g.get(found.front().node, "datum_system"), systems);
  for (const Node n : systems) {
    if (g.is(n, "DATUM_REFERENCE")) references.push_back(n);
  }
  if (systems.empty()) return false;
  const AnyRef to = references.empty() ? reader.object_at(systems.front(), a.targets, found.front().scale)
                                       : system_of(reader, row, at, references);
  assign_to(reader, at, a, AnyRef(to));
  return true;
}

void write_datums(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  const Id system = writer.instance_of(model::value_of<AnyRef>(a, data));
  if (system == kNoId) return;
  writer.become(root, "geometric_tolerance_with_datum_reference");
  writer.link(root, "datum_system", system);
}

// --- modifiers ---

bool read_modifiers(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                    const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  model::TextList out;
  const Value list = g.get(found.front().node, "modifiers");
  for (std::size_t i = 0; list.is(Kind::kList) && i < list.size(); ++i) {
    if (list[i].is(Kind::kEnumeration)) out.items.push_back(lower_text(list[i].enumeration()));
  }
  const Value older = g.get(found.front().node, "modifier");
  if (older.is(Kind::kEnumeration))
    out.items.push_back(modifier_of_condition(lower_text(older.enumeration())));
  if (out.items.empty()) return false;
  out.given = true;
  assign_to(reader, at, a, std::move(out));
  return true;
}

void write_modifiers(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  for (const std::string& word : model::value_of<model::TextList>(a, data).items) {
    if (word == kRegardless) {  // of the older form only
      writer.become(root, "modified_geometric_tolerance");
      writer.set(root, "modifier", enumerated(word));
      continue;
    }
    writer.become(root, "geometric_tolerance_with_modifiers");
    writer.set(root, "modifiers", enumerated(word));
  }
}

// --- numbers of the other forms ---

struct Form {
  std::string_view attribute, entity, parameter;
};
constexpr Form kForms[] = {
    {"maximum_tolerance", "geometric_tolerance_with_maximum_tolerance", "maximum_upper_tolerance"},
    {"displacement", "unequally_disposed_geometric_tolerance", "displacement"},
    {"unit_size", "geometric_tolerance_with_defined_unit", "unit_size"},
    {"unit_angle", "geometric_tolerance_with_defined_unit", "unit_size"},
    {"second_unit_size", "geometric_tolerance_with_defined_area_unit", "second_unit_size"},
    {"second_unit_angle", "geometric_tolerance_with_defined_area_unit", "second_unit_size"}};

const Form& form_of(const Attribute& a) {
  const auto it = std::find_if(std::begin(kForms), std::end(kForms),
                               [&](const Form& f) { return f.attribute == a.name; });
  if (it == std::end(kForms)) throw std::logic_error("no form of a tolerance for " + std::string(a.name));
  return *it;
}

bool read_form(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  const Form& form = form_of(a);
  const Node n = reader.graph().referred(found.front().node, form.parameter.data());
  if (n == kNoNode || !measures(reader, n, a.unit)) return false;
  const auto x = reader.measure(n, a.unit, found.front().scale);
  if (!x) return false;
  assign_to(reader, at, a, model::Real(*x));
  mark_one(reader, row, at, n, kFirstOwnOrdinal + static_cast<std::uint32_t>(&form - kForms));
  return true;
}

void write_form(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  const Form& form = form_of(a);
  writer.become(root, form.entity);
  writer.link(root, form.parameter, writer.measure(*model::value_of<model::Real>(a, data), a.unit, "", {}));
}

bool read_area(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  const Value v = reader.graph().get(found.front().node, "area_type");
  if (!v.is(Kind::kEnumeration)) return false;
  const auto it = std::find(a.enumerators.begin(), a.enumerators.end(), v.enumeration());
  if (it == a.enumerators.end()) return false;
  assign_to(reader, at, a, model::AnyEnum{static_cast<std::int8_t>(it - a.enumerators.begin())});
  return true;
}

void write_area(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  const auto code = static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code);
  writer.become(root, "geometric_tolerance_with_defined_area_unit");
  writer.set(root, "area_type", enumerated(a.enumerators[code]));
}

// --- zones ---

bool read_zone(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  const Terminal& t = found.front();
  if (!t.text.is(Kind::kString) || t.text.as_text().empty()) {
    reader.mark(t, at);
    return false;
  }
  assign_to(reader, at, a, model::Text(t.text.as_text()));
  return true;
}

void write_zone(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  const Id form = writer.walk(row, owner, root, 0, 0);
  const auto& text = *model::value_of<model::Text>(a, data);
  writer.set(form, "name", writer.quoted(text));
  in_shape(writer, writer.walk(row, owner, root, 1, 0), owner);
}

bool read_projected(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                    const std::vector<Terminal>& found) {
  const auto x = reader.measure(found.front().node, a.unit, found.front().scale);
  if (!x) return false;
  assign_to(reader, at, a, model::Real(*x));
  return true;
}

void write_projected(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                     Id root) {
  const Id definition = writer.walk(row, owner, root, 1, 0);
  const Id zone = writer.walk(row, owner, root, 2, 0);
  writer.set(definition, "boundaries", "()");
  writer.link(definition, "projected_length",
              writer.measure(*model::value_of<model::Real>(a, data), a.unit, "", {}));
  in_shape(writer, zone, owner);
  if (writer.model().at<model::GeometricTolerance>(owner).zone_form) return;
  const Id form = writer.make("tolerance_zone_form");  // a zone has one
  writer.link(zone, "form", form);
}

// --- composites ---

bool read_elements(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                   const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  if (!g.is(reader.root_of(at), "COMPOSITE_SHAPE_ASPECT")) return false;
  bool any = false;
  for (const Terminal& t : found) {
    if (g.is(t.node, "DATUM")) continue;  // what it establishes
    const AnyRef to = reader.object_at(t.node, a.targets, t.scale);
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
    reader.mark(t, at);
    any = true;
  }
  return any;
}

void write_elements(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                    Id root) {
  writer.become(root, "composite_group_shape_aspect");
  std::uint32_t i = 0;
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id target = to.set() ? writer.instance_of(to) : kNoId;
    if (target == kNoId) continue;
    ++i;
    writer.connect(row.steps.back(), writer.walk(row, owner, root, 1, i), target, i, owner);
  }
}

}  // namespace

// --- shared ---

Node product_of(const Graph& g, Node n) {
  constexpr int kDeepest = 8;  // dimension, component, its feature, its shape
  for (int depth = 0; depth < kDeepest && n != kNoNode; ++depth) {
    if (g.is(n, "PRODUCT_DEFINITION")) return n;
    if (g.is(n, "GEOMETRIC_TOLERANCE")) {
      n = g.referred(n, "toleranced_shape_aspect");
    } else if (g.is(n, "PROPERTY_DEFINITION")) {
      n = g.referred(n, "definition");
    } else if (g.is(n, "DIMENSIONAL_SIZE") && !g.is(n, "SHAPE_ASPECT")) {
      n = g.referred(n, "applies_to");
    } else if (g.is(n, "SHAPE_ASPECT_RELATIONSHIP")) {
      n = g.referred(n, "relating_shape_aspect");
    } else if (g.is(n, "SHAPE_ASPECT")) {
      const Node shape = g.referred(n, "of_shape");
      const Node definition = shape == kNoNode ? kNoNode : g.referred(shape, "definition");
      if (definition != kNoNode && !g.is(definition, "FEATURE_COMPONENT_DEFINITION")) {
        n = definition;
        continue;
      }
      // A component of a feature: on to the feature.
      Node feature = kNoNode;
      for (const Node user : g.users(n)) {
        if (g.is(user, "FEATURE_COMPONENT_RELATIONSHIP") && g.referred(user, "relating_shape_aspect") == n)
          feature = g.referred(user, "related_shape_aspect");
      }
      n = feature;
    } else {
      return kNoNode;
    }
  }
  return kNoNode;
}

AnyRef workpiece_of(const model::Model& m, AnyRef owner) {
  const Attribute* a = model::find_attribute(owner.type, "its_workpiece");
  return a == nullptr ? AnyRef{} : model::value_of<AnyRef>(*a, m.object(owner));
}

void in_shape(Writer& writer, Id aspect, AnyRef owner) {
  const AnyRef workpiece = workpiece_of(writer.model(), owner);
  const Id shape = workpiece.set() ? shape_of(writer, workpiece) : kNoId;
  if (shape != kNoId) writer.link(aspect, "of_shape", shape);
}

void mark_one(Reader& reader, const Row& row, AnyRef owner, Node n, std::uint32_t ordinal) {
  Terminal t;
  t.trail.push_back({n, row.steps.empty() ? 0 : row.steps.back().prefix, ordinal});
  reader.mark(t, owner);
}

std::vector<Node> members_of_group(Reader& reader, const Row& row, AnyRef owner, Node n) {
  const Graph& g = reader.graph();
  const Value name = g.get(n, "shape_aspect.description");
  if (!g.is(n, "COMPOSITE_GROUP_SHAPE_ASPECT") || !name.is(Kind::kString) || name.as_text() != kGroup)
    return {n};
  std::vector<Node> out;
  std::uint32_t k = kFirstOwnOrdinal + 100;
  mark_one(reader, row, owner, n, k++);
  for (const Node user : g.users(n)) {
    if (!g.is(user, "SHAPE_ASPECT_RELATIONSHIP") || g.referred(user, "relating_shape_aspect") != n) continue;
    const Node member = g.referred(user, "related_shape_aspect");
    if (member == kNoNode) continue;
    mark_one(reader, row, owner, user, k++);
    out.push_back(member);
  }
  return out;
}

Id group_of(Writer& writer, AnyRef owner, const std::vector<AnyRef>& items) {
  std::vector<Id> ids;
  for (const AnyRef to : items) {
    const Id id = to.set() ? writer.instance_of(to) : kNoId;
    if (id != kNoId) ids.push_back(id);
  }
  if (ids.size() < 2) return ids.empty() ? kNoId : ids.front();
  const Id group = writer.make("composite_group_shape_aspect");
  writer.set(group, "description", std::string("'") + kGroup + "'");
  writer.set(group, "product_definitional", ".T.");
  in_shape(writer, group, owner);
  for (const Id id : ids) {
    const Id relation = writer.make("shape_aspect_relationship");
    writer.link(relation, "relating_shape_aspect", group);
    writer.link(relation, "related_shape_aspect", id);
  }
  return group;
}

bool measures(Reader& reader, Node n, Unit unit) {
  const Node u = reader.graph().referred(n, "unit_component");
  if (u == kNoNode) return unit == Unit::kLength;
  const auto of = reader.units().unit(u);
  return of && Units::factor(*of, unit).has_value();
}

std::string enumerated(std::string_view word) {
  std::string out = ".";
  for (const char c : word) out += static_cast<char>(c >= 'a' && c <= 'z' ? c - 32 : c);
  return out + ".";
}

const Codec kTolerancedCodecOfShape{"toleranced_shape", &read_toleranced, &write_toleranced};
const Codec kWholePartCodec{"whole_part", &read_whole_part, &write_whole_part};
const Codec kToleranceDatumsCodec{"tolerance_datums", &read_datums, &write_datums};
const Codec kToleranceModifiersCodec{"tolerance_modifiers", &read_modifiers, &write_modifiers};
const Codec kToleranceMeasureCodec{"tolerance_measure", &read_form, &write_form};
const Codec kToleranceAreaCodec{"tolerance_area", &read_area, &write_area};
const Codec kToleranceZoneCodec{"tolerance_zone", &read_zone, &write_zone};
const Codec kProjectedLengthCodec{"projected_length", &read_projected, &write_projected};
const Codec kShapeElementsCodec{"shape_elements", &read_elements, &write_elements};

const Codec* find_requirement_codec(std::string_view name) {
  static constexpr const Codec* kCodecs[] = {
      &kTolerancedCodecOfShape,   &kWholePartCodec,           &kToleranceDatumsCodec,
      &kToleranceModifiersCodec,  &kToleranceMeasureCodec,    &kToleranceAreaCodec,
      &kToleranceZoneCodec,       &kProjectedLengthCodec,     &kShapeElementsCodec,
      &kEstablishedByCodec,       &kDatumBaseCodec,           &kCommonDatumCodec,
      &kDatumModifiersCodec,      &kValuedModifierCodec,      &kTargetDescriptionCodec,
      &kDimensionValueCodec,      &kDimensionQualifiersCodec, &kDimensionToleranceCodec,
      &kDimensionAngleLimitCodec, &kDimensionKindCodec,       &kMeasurementPathCodec,
      &kTextureValueCodec,        &kTextureNameCodec,         &kTextureSurfacesCodec,
      &kPropertyOfCodec,          &kPartPropertiesCodec,      &kGeneralPropertyCodec,
      &kRequirementsCodec};
  for (const Codec* c : kCodecs) {
    if (c->name == name) return c;
  }
  return nullptr;
}

}  // namespace capstan::exchange::ap238
