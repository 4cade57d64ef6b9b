#include <algorithm>
#include <unordered_set>

#include "planner/files/exchange/ap238/codecs/tolerance_codec.h"
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

constexpr double kMicrometres = 1000.0;  // of a millimetre: what ISO 4287 states heights and widths in

bool fits_one(TypeId t, const Attribute& a) {
  return std::any_of(a.targets.begin(), a.targets.end(), [&](TypeId want) { return model::is_a(t, want); });
}

// --- surface texture ---

// Skewness, kurtosis and material ratio have no unit (ISO 4287).
bool is_ratio(std::string_view name) {
  const std::string what = lower_text(name.substr(std::min<std::size_t>(1, name.size())));
  return what.rfind("sk", 0) == 0 || what.rfind("ku", 0) == 0 || what.rfind("mr", 0) == 0;
}

bool read_value(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    if (!reader.graph().is(t.node, "MEASURE_REPRESENTATION_ITEM")) continue;
    const bool length = measures(reader, t.node, Unit::kLength);
    const auto x = reader.measure(t.node, length ? Unit::kLength : Unit::kRatio, t.scale);
    if (!x) continue;
    assign_to(reader, at, a, model::Real(length ? *x * kMicrometres : *x));
    return true;
  }
  return false;
}

void write_value(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  const auto& t = writer.model().at<model::SurfaceTextureParameter>(owner);
  const std::string name = t.parameter_name.value_or("");
  const double value = *model::value_of<model::Real>(a, data);
  const Id item =
      writer.measure(value, is_ratio(name) ? Unit::kRatio : Unit::kLength, Writer::quoted(name), {});
  if (!is_ratio(name)) writer.link(item, "unit_component", writer.shared("micrometre"));
  writer.link(writer.walk(row, owner, root, 1, 0), "items", item);
}

bool read_name(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    if (!reader.graph().is(t.node, "MEASURE_REPRESENTATION_ITEM")) continue;
    assign_to(reader, at, a, model::Text(reader.graph().text(t.node, "representation_item.name")));
    return true;
  }
  return false;
}

void write_nothing(Writer&, const Row&, AnyRef, const Attribute&, const void*, Id) {}

// The surfaces of a texture parameter are in two lists, by kind.
bool read_surfaces(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                   const std::vector<Terminal>& found) {
  static constexpr TypeId kAny[] = {TypeId::kManufacturingFeature, TypeId::kMachinedSurface,
                                    TypeId::kShapeElement};
  const Terminal& t = found.front();
  if (!reader.graph().is(t.node, "SHAPE_ASPECT")) return false;
  bool any = false;
  for (const Node n : members_of_group(reader, row, at, t.node)) {
    const AnyRef to = reader.object_at(n, kAny, t.scale);
    if (!fits_one(to.type, a) && !(to.type == TypeId::kKeptInstance && a.name == "applied_to")) continue;
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
    any = true;
  }
  return any;
}

std::vector<AnyRef> surfaces_of(const model::SurfaceTextureParameter& t) {
  std::vector<AnyRef> out = t.applied_surfaces.items;
  out.insert(out.end(), t.applied_to.items.begin(), t.applied_to.items.end());
  return out;
}

void write_definition(Writer& writer, AnyRef owner, Id root, const std::vector<AnyRef>& items) {
  Id target = group_of(writer, owner, items);
  const AnyRef workpiece = workpiece_of(writer.model(), owner);
  if (target == kNoId && workpiece.set()) target = shape_of(writer, workpiece);
  if (target != kNoId) writer.link(root, "definition", target);
}

void write_surfaces(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void*, Id root) {
  const auto& t = writer.model().at<model::SurfaceTextureParameter>(owner);
  if (a.name == "applied_to" && !t.applied_surfaces.empty()) return;  // both were written at once
  if (a.name == "applied_surfaces" && t.applied_surfaces.empty() && !t.applied_to.empty()) return;
  write_definition(writer, owner, root, surfaces_of(t));
}

// --- properties ---

bool read_of(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
             const std::vector<Terminal>& found) {
  const Terminal& t = found.front();
  if (!reader.graph().is(t.node, "SHAPE_ASPECT")) return false;
  for (const Node n : members_of_group(reader, row, at, t.node)) {
    const AnyRef to = reader.object_at(n, a.targets, t.scale);
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
  }
  return true;
}

void write_of(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data, Id root) {
  write_definition(writer, owner, root, model::value_of<AnyRefList>(a, data).items);
}

// A property always has its general property; one without an id is there for the association only.
bool read_general(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                  const std::vector<Terminal>& found) {
  const Terminal& t = found.front();
  if (reader.graph().text(t.node, "id").empty()) {
    mark_one(reader, row, at, t.node, 0);
    return false;
  }
  assign_to(reader, at, a, AnyRef(reader.object_at(t.node, a.targets, t.scale)));
  return true;
}

void write_general(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                   Id root) {
  const Id association = writer.walk(row, owner, root, 1, 0);
  if (a.name == "general_property") {
    const Id general = writer.instance_of(model::value_of<AnyRef>(a, data));
    if (general != kNoId) writer.link(association, "base_definition", general);
    return;
  }
  // Writes the name: of the property, and of its general property if that has no noun.
  const std::string name = Writer::quoted(*model::value_of<model::Text>(a, data));
  writer.set(root, "property_definition.name", name);
  if (writer.model().at<model::AssignedProperty>(owner).general_property) return;
  const Id general = writer.make("general_property");
  writer.set(general, "name", name);
  writer.link(association, "base_definition", general);
}

bool read_property_name(Reader& reader, AnyRef at, const Attribute& a) {
  assign_to(reader, at, a, model::Text(reader.graph().text(reader.root_of(at), "property_definition.name")));
  return true;
}

bool read_general_or_name(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                          const std::vector<Terminal>& found) {
  return a.name == "name" ? read_property_name(reader, at, a) : read_general(reader, row, at, a, found);
}

// --- what is stated of a workpiece ---

// A dimension by which a feature's own measure is toleranced: they share the measure.
bool is_of_a_parameter(const Graph& g, Node n) {
  for (const Node link : g.users(n)) {
    if (!g.is(link, "DIMENSIONAL_CHARACTERISTIC_REPRESENTATION")) continue;
    std::vector<Node> representations, items;
    g.references(g.get(link, "representation"), representations);
    for (const Node r : representations) g.references(g.get(r, "items"), items);
    for (const Node item : items) {
      const auto users = g.users(item);
      if (std::any_of(users.begin(), users.end(),
                      [&](Node u) { return g.is(u, "SHAPE_REPRESENTATION_WITH_PARAMETERS"); }))
        return true;
    }
  }
  return false;
}

bool is_requirement(const Graph& g, Node n) {
  static constexpr const char* kKinds[] = {"GEOMETRIC_TOLERANCE",  "DIMENSIONAL_SIZE",
                                           "DIMENSIONAL_LOCATION", "DATUM",
                                           "DATUM_TARGET",         "SHAPE_ASPECT"};
  if (g.is(n, "PROPERTY_DEFINITION")) return g.text(n, "property_definition.name") == "surface_condition";
  if (g.is(n, "DIMENSIONAL_SIZE") && is_of_a_parameter(g, n)) return false;
  if (g.is(n, "INSTANCED_FEATURE") || g.is(n, "DATUM_FEATURE")) return false;
  return std::any_of(std::begin(kKinds), std::end(kKinds), [&](const char* k) { return g.is(n, k); });
}

// Aspects of other kinds are parts of something: zones, systems, references, components.
bool is_other_aspect(const Graph& g, Node n) {
  return g.is(n, "SHAPE_ASPECT") && !g.is(n, "DATUM") && !g.is(n, "DATUM_TARGET");
}

bool is_used(const Graph& g, Node n) {
  const auto users = g.users(n);
  return std::any_of(users.begin(), users.end(), [&](Node u) {
    return g.is(u, "GEOMETRIC_TOLERANCE") || g.is(u, "DIMENSIONAL_SIZE") ||
           g.is(u, "SHAPE_ASPECT_RELATIONSHIP") || g.is(u, "PROPERTY_DEFINITION") ||
           g.is(u, "TOLERANCE_ZONE_DEFINITION");
  });
}

// A plain aspect is listed only when nothing else is stated of it: it is found there.
bool is_stated(const Graph& g, Node n) {
  const bool plain = g.entity(n) == g.schema().find("SHAPE_ASPECT") || g.is(n, "COMPOSITE_SHAPE_ASPECT");
  if (!plain) return is_requirement(g, n) && !is_other_aspect(g, n);
  return !is_used(g, n);
}

// Everything that leads to the part's shape by way of shape aspects, and what is stated of the part itself;
// in the file's order.
std::vector<Node> stated_of(const Graph& g, Node part) {
  static constexpr const char* kWays[] = {"SHAPE_ASPECT", "GEOMETRIC_TOLERANCE", "DIMENSIONAL_SIZE",
                                          "SHAPE_ASPECT_RELATIONSHIP", "PROPERTY_DEFINITION"};
  std::vector<Node> pending = {part}, out;
  std::unordered_set<Node> seen = {part};
  while (!pending.empty()) {
    const Node n = pending.back();
    pending.pop_back();
    for (const Node u : g.users(n)) {
      const bool way =
          std::any_of(std::begin(kWays), std::end(kWays), [&](const char* w) { return g.is(u, w); });
      if (!way || !seen.insert(u).second) continue;
      pending.push_back(u);
      if (product_of(g, u) == part) out.push_back(u);
    }
  }
  std::sort(out.begin(), out.end());
  return out;
}

// A property has a general property; texture is a requirement.
bool is_property(const Graph& g, Node n) {
  if (g.entity(n) != g.schema().find("PROPERTY_DEFINITION") ||
      g.text(n, "property_definition.name") == "surface_condition")
    return false;
  const auto users = g.users(n);
  return std::any_of(users.begin(), users.end(),
                     [&](Node u) { return g.is(u, "GENERAL_PROPERTY_ASSOCIATION"); });
}

bool read_stated(Reader& reader, AnyRef at, const Attribute& a, const Terminal& t,
                 bool (*wanted)(const Graph&, Node)) {
  bool any = false;
  for (const Node n : stated_of(reader.graph(), t.node)) {
    if (!wanted(reader.graph(), n)) continue;
    const AnyRef to = reader.object_at(n, a.targets, t.scale);
    if (to.type == TypeId::kKeptInstance) continue;
    auto& list = *static_cast<AnyRefList*>(a.at(reader.plan().model.object(at)));
    list.given = true;
    list.items.push_back(to);
    any = true;
  }
  return any;
}

bool read_requirements(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                       const std::vector<Terminal>& found) {
  return read_stated(reader, at, a, found.front(), &is_stated);
}

bool read_properties(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  return read_stated(reader, at, a, found.front(), &is_property);
}

void write_properties(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    const Id property = to.set() ? writer.instance_of(to) : kNoId;
    const auto* part = writer.model().get<model::PartProperty>(to);
    if (property != kNoId && part != nullptr && !part->its_workpiece)
      writer.link(property, "definition", root);
  }
}

void write_requirements(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id) {
  for (const AnyRef to : model::value_of<AnyRefList>(a, data).items) {
    if (to.set()) (void)writer.instance_of(to);
  }
}

}  // namespace

const Codec kTextureValueCodec{"texture_value", &read_value, &write_value};
const Codec kTextureNameCodec{"texture_name", &read_name, &write_nothing};
const Codec kTextureSurfacesCodec{"texture_surfaces", &read_surfaces, &write_surfaces};
const Codec kPropertyOfCodec{"property_of", &read_of, &write_of};
const Codec kPartPropertiesCodec{"part_properties", &read_properties, &write_properties};
const Codec kGeneralPropertyCodec{"general_property", &read_general_or_name, &write_general};
const Codec kRequirementsCodec{"requirements", &read_requirements, &write_requirements};

}  // namespace capstan::exchange::ap238
