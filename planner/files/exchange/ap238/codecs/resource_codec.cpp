#include "planner/files/exchange/ap238/codecs/resource_codec.h"

#include <algorithm>

#include "planner/files/p21/print.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using p21::Kind;
using p21::Value;

namespace {

using p21::quoted;

template <class T>
void assign(Reader& reader, AnyRef at, const Attribute& a, T value) {
  *static_cast<T*>(a.at(reader.plan().model.object(at))) = std::move(value);
}

std::string name_of(const Step& last) {
  for (const Constraint& c : last.constraints) {
    if (c.attribute == "name" && !c.negated) return c.texts.front();
  }
  return {};
}

void write_measure(Writer& writer, const Row& row, AnyRef owner, Id root, double value, model::Unit unit) {
  const Step& last = row.steps.back();
  const Id from = writer.walk(row, owner, root, 1, 0);
  writer.connect(last, from, writer.measure(value, unit, name_of(last), last.entities), 0, owner);
}

// --- said ---

bool read_said(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    const std::string s = row.value_of.empty()       ? reader.description(t.node)
                          : t.text.is(Kind::kString) ? t.text.as_text()
                                                     : "";
    if (s.empty()) continue;
    assign(reader, at, a, model::Text(s));
    return true;
  }
  return false;
}

void write_said(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  writer.set(writer.walk(row, owner, root, 0, 0), row.value_of,
             quoted(*model::value_of<model::Text>(a, data)));
}

// --- twice, other_kind ---

bool read_number(Reader& reader, AnyRef at, const Attribute& a, const std::vector<Terminal>& found,
                 double (*model_value)(double)) {
  for (const Terminal& t : found) {
    const auto x = reader.measure(t.node, a.unit, t.scale);
    if (!x) continue;
    assign(reader, at, a, model::Real(model_value(*x)));
    return true;
  }
  return false;
}

bool read_twice(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  return read_number(reader, at, a, found, [](double x) { return 0.5 * x; });
}

void write_twice(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  write_measure(writer, row, owner, root, 2.0 * *model::value_of<model::Real>(a, data), a.unit);
}

bool read_other_kind(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  const bool named = found.empty() || !found.front().text.is(Kind::kString) ||
                     lower_text(found.front().text.as_text()) == "user defined milling tool";
  return !named && read_said(reader, row, at, a, found);
}

// --- texts, typed ---

bool read_texts(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    if (!t.text.is(Kind::kList)) continue;
    model::TextList out;
    out.given = true;
    for (std::size_t i = 0; i < t.text.size(); ++i) {
      if (t.text[i].is(Kind::kString)) out.items.push_back(t.text[i].as_text());
    }
    assign(reader, at, a, std::move(out));
    return true;
  }
  return false;
}

void write_texts(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  const Id at = writer.walk(row, owner, root, 0, 0);
  for (const auto& s : model::value_of<model::TextList>(a, data).items)
    writer.set(at, row.value_of, quoted(s));
}

bool read_typed(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    const Value v = t.text.is(Kind::kTyped) ? t.text[0] : t.text;
    if (!v.is(Kind::kString) || v.as_text().empty()) continue;
    assign(reader, at, a, model::Text(v.as_text()));
    return true;
  }
  return false;
}

void write_typed(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  writer.set(writer.walk(row, owner, root, 0, 0), row.value_of,
             "IDENTIFIER(" + quoted(*model::value_of<model::Text>(a, data)) + ")");
}

void write_library(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                   Id root) {
  write_typed(writer, row, owner, a, data, root);
  const auto* usage = writer.model().get<model::ToolUsage>(owner);
  if (usage == nullptr || usage->its_library_source) return;
  const Id source = writer.make("external_source");
  writer.set(source, "source_id", "IDENTIFIER('')");
  writer.link(writer.walk(row, owner, root, 0, 0), "source", source);
}

// --- measure ---

bool read_measure(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                  const std::vector<Terminal>& found) {
  // The other kind of measure is another attribute of the same object, not a fault.
  const auto& g = reader.graph();
  const char* entity =
      a.unit == model::Unit::kAngle ? "PLANE_ANGLE_MEASURE_WITH_UNIT" : "LENGTH_MEASURE_WITH_UNIT";
  if (found.empty() || !g.is(found.front().node, g.schema().find(entity))) return false;
  return read_number(reader, at, a, found, [](double x) { return x; });
}

void write_self(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  const bool angle = a.unit == model::Unit::kAngle;
  writer.set(root, "value_component",
             std::string(angle ? "PLANE_ANGLE_MEASURE(" : "LENGTH_MEASURE(") +
                 part21_real(*model::value_of<model::Real>(a, data)) + ")");
  writer.link(root, "unit_component", writer.shared(angle ? "radian" : "mm"));
}

// --- parameters ---

bool read_value(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    const Value v = t.text.is(Kind::kTyped) ? t.text[0] : t.text;
    if (!v.is_number()) continue;
    assign(reader, at, a, model::Real(v.as_real()));
    return true;
  }
  return false;
}

void write_value(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  writer.set(root, "value_component",
             "NUMERIC_MEASURE(" + part21_real(*model::value_of<model::Real>(a, data)) + ")");
}

// "newton", "millimetre", or the name that the file gives it; of derived units the parts with their
// exponents. `left` counts down the parts that it may still have.
constexpr std::size_t kMostParts = 64;  // real ones have four; default, unsourced
std::string unit_name(const Graph& g, Node n, int depth, std::size_t& left) {
  const Value elements = g.get(n, "elements");
  std::string out;
  if (elements.is(Kind::kList) && depth < 4) {
    std::vector<Node> parts;
    g.references(elements, parts);
    for (const Node p : parts) {
      const Value u = g.get(p, "unit"), x = g.get(p, "exponent");
      const Node of = u.is(Kind::kReference) ? g.find(u.reference()) : kNoNode;
      if (of == kNoNode) continue;
      if (left == 0) return out;
      --left;
      out += (out.empty() ? "" : " ") + unit_name(g, of, depth + 1, left);
      if (x.is_number() && x.as_real() != 1.0) out += "^" + shortest(x.as_real());
    }
    return out;
  }
  for (const char* attribute : {"context_dependent_unit.name", "conversion_based_unit.name"}) {
    const Value name = g.get(n, attribute);
    if (name.is(Kind::kString)) return name.as_text();
  }
  for (const char* attribute : {"prefix", "si_unit.name"}) {
    const Value part = g.get(n, attribute);
    if (part.is(Kind::kEnumeration)) out += lower_text(part.enumeration());
  }
  return out;
}

bool read_unit(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    std::size_t left = kMostParts;
    auto name = unit_name(reader.graph(), t.node, 0, left);
    if (left == 0) {
      reader.about(t.node, {.code = "EXC-VALUE",
                            .message = "a unit consists of " + std::to_string(kMostParts) + " parts or more",
                            .expected = "a unit of few parts"});
      return true;
    }
    assign(reader, at, a, model::Text(std::move(name)));
    (void)reader.units().unit(t.node);  // its parts are explained
    return true;
  }
  return false;
}

void write_unit(Writer& writer, const Row&, AnyRef, const Attribute& a, const void* data, Id root) {
  const Id unit = writer.make("context_dependent_unit");
  writer.set(unit, "context_dependent_unit.name", quoted(*model::value_of<model::Text>(a, data)));
  writer.link(unit, "dimensions", writer.shared("no_exponents"));
  writer.link(root, "unit_component", unit);
}

// --- role ---

bool read_role(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  return read_said(reader, row, at, a, found);
}

void write_role(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  const auto& m = writer.model();
  if (owner.type == model::TypeId::kLastModifiedTimestamp) return;  // fixed by the standard
  std::string_view entity = "person_and_organization_role";
  if (const auto* p = m.get<model::PersonOrganizationAssignment>(owner)) {
    if (p->assigned_person_organization.type == model::TypeId::kOrganization) entity = "organization_role";
  } else if (const auto* d = m.get<model::DateTimeAssignment>(owner)) {
    entity = d->assigned_date.type == model::TypeId::kDateAndTime ? "date_time_role" : "date_role";
  }
  const Id role = writer.make(entity);
  writer.set(role, row.value_of, quoted(*model::value_of<model::Text>(a, data)));
  writer.link(root, row.steps.back().attribute, role);
}

// --- transformation ---

bool read_transformation(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                         const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    const AnyRef to = reader.object_at(t.node, a.targets, t.scale);
    if (!to.set()) continue;
    assign(reader, at, a, to);
    return true;
  }
  return false;
}

// The representation that a placement is an item of: the shape of the workpiece when there is one.
Id around(Writer& writer, AnyRef workpiece, Id placement, std::string_view context) {
  const auto* w = writer.model().get<model::Workpiece>(workpiece);
  if (w != nullptr && w->its_geometry.set()) return writer.instance_of(w->its_geometry);
  const Id out = writer.make("shape_representation");
  writer.set(out, "representation.name", "'placement'");
  writer.link(out, "items", placement);
  writer.link(out, "context_of_items", writer.shared(context));
  return out;
}

// `item_transform` and `its_origin` are where the second placement lies; the first, unless it is given, is
// the origin of what is placed.
void write_transformation(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                          Id root) {
  const auto& m = writer.model();
  AnyRef child, parent, first;
  if (const auto* n = m.get<model::NextAssemblyUsage>(owner)) {
    child = n->child_workpiece;
    first = n->item_transform_origin;
    for (const AnyRef w : m.all_below(model::TypeId::kWorkpiece)) {
      const auto& parts = m.at<model::Workpiece>(w).its_components.items;
      if (std::find(parts.begin(), parts.end(), owner) != parts.end()) parent = w;
    }
  } else if (const auto* w = m.get<model::WorkpieceSetup>(owner)) {
    child = w->its_workpiece;
  }
  const Id transformation = writer.walk(row, owner, root, 1, 0);
  const Id relation = writer.walk(row, owner, root, 2, 0);
  const Id second = writer.instance_of(model::value_of<AnyRef>(a, data));
  const Id from = first.set() ? writer.instance_of(first) : writer.shared("origin");
  writer.link(transformation, "transform_item_1", from);
  writer.link(transformation, "transform_item_2", second);
  writer.link(relation, "rep_1", around(writer, child, from, "context"));
  writer.link(relation, "rep_2", around(writer, parent, second, "place_context"));
}

}  // namespace

const Codec kSaidCodec{"said", read_said, write_said};
const Codec kTwiceCodec{"twice", read_twice, write_twice};
const Codec kOtherKindCodec{"other_kind", read_other_kind, write_said};
const Codec kLibraryCodec{"library", read_typed, write_library};
const Codec kTextsCodec{"texts", read_texts, write_texts};
const Codec kMeasureCodec{"measure", read_measure, write_self};
const Codec kTypedCodec{"typed", read_typed, write_typed};
const Codec kParameterValueCodec{"parameter_value", read_value, write_value};
const Codec kParameterUnitCodec{"parameter_unit", read_unit, write_unit};
const Codec kRoleCodec{"role", read_role, write_role};
const Codec kTransformationCodec{"transformation", read_transformation, write_transformation};

}  // namespace capstan::exchange::ap238
