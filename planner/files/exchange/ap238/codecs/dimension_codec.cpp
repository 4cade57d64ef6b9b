#include <algorithm>

#include "planner/files/exchange/ap238/codecs/tolerance_codec.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::TypeId;
using model::Unit;
using p21::Kind;
using p21::Value;

namespace {

constexpr std::uint32_t kFirstOwnOrdinal = 3000;  // of instances that no path of the row leads to

std::string demanded_name(const Row& row) {
  for (const Constraint& c : row.steps.back().constraints) {
    if (c.attribute == "name" && !c.texts.empty()) return c.texts.front();
  }
  return {};
}

// --- values ---

bool read_value(Reader& reader, const Row&, AnyRef at, const Attribute& a,
                const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    if (!measures(reader, t.node, a.unit)) continue;
    const auto x = reader.measure(t.node, a.unit, t.scale);
    if (!x) continue;
    assign_to(reader, at, a, model::Real(*x));
    return true;
  }
  return false;
}

void write_value(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                 Id root) {
  const std::string name = demanded_name(row);
  const Id item = writer.measure(*model::value_of<model::Real>(a, data), a.unit, name, {});
  writer.link(writer.walk(row, owner, root, 1, 0), "items", item);
  const auto& d = writer.model().at<model::ShapeDimension>(owner);
  if (name != "'nominal value'" || d.qualifiers.items.empty()) return;
  writer.become(item, "qualified_representation_item");
  for (const std::string& q : d.qualifiers.items) {
    const Id qualifier = writer.make("type_qualifier");
    writer.set(qualifier, "name", Writer::quoted(q));
    writer.link(item, "qualifiers", qualifier);
  }
}

bool read_qualifiers(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  model::TextList out;
  std::uint32_t k = kFirstOwnOrdinal;
  for (const Terminal& t : found) {
    std::vector<Node> qualifiers;
    g.references(g.get(t.node, "qualifiers"), qualifiers);
    for (const Node q : qualifiers) {
      if (!g.is(q, "TYPE_QUALIFIER")) continue;
      out.items.push_back(g.text(q, "name"));
      mark_one(reader, row, at, q, k++);
    }
  }
  if (out.items.empty()) return false;
  out.given = true;
  assign_to(reader, at, a, std::move(out));
  return true;
}

void write_qualifiers(Writer& writer, const Row&, AnyRef owner, const Attribute&, const void*, Id) {
  const auto& d = writer.model().at<model::ShapeDimension>(owner);
  // The nominal value has them.
  if (!d.nominal_value && !d.nominal_angle && !d.qualifiers.items.empty())
    writer.lose("the qualifiers of a dimension without a nominal value");
}

// --- tolerances ---

AnyRef read_fit(Reader& reader, Node n) {
  const Graph& g = reader.graph();
  model::LimitsAndFits out;
  const auto text = [&](const char* attribute, model::Text& to) {
    if (const std::string s = g.text(n, attribute); !s.empty()) to = s;
  };
  text("form_variance", out.form_variance);
  text("zone_variance", out.zone_variance);
  text("grade", out.tolerance_grade);
  text("source", out.source);
  const auto at = reader.plan().model.add(std::move(out));
  reader.plan().model.set_origin(at, {g.instance(n).id(), g.instance(n).line()});
  return at;
}

struct Bounds {
  std::optional<double> lower, upper;
  std::optional<std::int64_t> digits;
};

Bounds bounds_of(Reader& reader, const Row& row, AnyRef at, const Terminal& t, Unit unit) {
  const Graph& g = reader.graph();
  Bounds out;
  std::uint32_t k = kFirstOwnOrdinal;
  for (const bool upper : {false, true}) {
    const Node n = g.referred(t.node, upper ? "upper_bound" : "lower_bound");
    if (n == kNoNode || !measures(reader, n, unit)) return {};
    (upper ? out.upper : out.lower) = reader.measure(n, unit, t.scale);
    mark_one(reader, row, at, n, k++);
    std::vector<Node> qualifiers;
    g.references(g.get(n, "qualifiers"), qualifiers);
    for (const Node q : qualifiers) {
      const Value digits = g.get(q, "precision_value");
      if (!digits.is(Kind::kInteger)) continue;
      out.digits = digits.as_integer();
      mark_one(reader, row, at, q, k++);
    }
  }
  return out;
}

bool read_tolerance(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                    const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  const Terminal& t = found.front();
  if (g.is(t.node, "LIMITS_AND_FITS")) {
    assign_to(reader, at, a, AnyRef(read_fit(reader, t.node)));
    return true;
  }
  const Bounds b = bounds_of(reader, row, at, t, Unit::kLength);
  if (!b.lower || !b.upper) return false;
  model::PlusMinusValue out;
  out.upper_limit = *b.upper;
  out.lower_limit = -*b.lower;  // below nominal, as ISO 14649 has it
  out.significant_digits = b.digits;
  const auto value = reader.plan().model.add(std::move(out));
  reader.plan().model.set_origin(value, {g.instance(t.node).id(), g.instance(t.node).line()});
  assign_to(reader, at, a, AnyRef(value));
  return true;
}

void write_bounds(Writer& writer, const Row& row, AnyRef owner, Id root, double lower, double upper,
                  Unit unit, std::optional<std::int64_t> digits) {
  const Id range = writer.make("tolerance_value");
  for (const bool up : {false, true}) {
    const Id bound = writer.measure(up ? upper : lower, unit, "", {});
    writer.link(range, up ? "upper_bound" : "lower_bound", bound);
    if (!digits || !up) continue;
    writer.become(bound, "qualified_representation_item");
    const Id precision = writer.make("precision_qualifier");
    writer.set(precision, "precision_value", std::to_string(*digits));
    writer.link(bound, "qualifiers", precision);
  }
  writer.link(writer.walk(row, owner, root, 1, 0), "range", range);
}

void write_tolerance(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                     Id root) {
  const auto& m = writer.model();
  const AnyRef to = model::value_of<AnyRef>(a, data);
  if (const auto* v = m.get<model::PlusMinusValue>(to)) {
    return write_bounds(writer, row, owner, root, -v->lower_limit.value_or(0.0), v->upper_limit.value_or(0.0),
                        Unit::kLength, v->significant_digits);
  }
  const auto* fit = m.get<model::LimitsAndFits>(to);
  if (fit == nullptr) return;
  const Id range = writer.make("limits_and_fits");
  const auto text = [&](const char* attribute, const model::Text& v) {
    if (v) writer.set(range, attribute, Writer::quoted(*v));
  };
  if (!fit->zone_variance && fit->its_fitting_type.set())
    writer.set(range, "zone_variance",
               fit->its_fitting_type == model::FittingType::kHole ? "'hole'" : "'shaft'");
  text("form_variance", fit->form_variance);
  text("zone_variance", fit->zone_variance);
  text("grade", fit->tolerance_grade);
  text("source", fit->source);
  if (fit->deviation || (fit->grade && !fit->tolerance_grade))
    writer.lose("the fundamental deviation of a dimension's fit");
  writer.link(writer.walk(row, owner, root, 1, 0), "range", range);
}

bool read_angle_limit(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                      const std::vector<Terminal>& found) {
  const Bounds b = bounds_of(reader, row, at, found.front(), Unit::kAngle);
  const auto& x = a.name == "upper_angle_limit" ? b.upper : b.lower;
  if (!x) return false;
  assign_to(reader, at, a, model::Real(*x));
  return true;
}

void write_angle_limit(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void*,
                       Id root) {
  const auto& d = writer.model().at<model::ShapeDimension>(owner);
  if (a.name == "lower_angle_limit" && d.upper_angle_limit) return;  // written with the upper one
  write_bounds(writer, row, owner, root, d.lower_angle_limit.value_or(0.0), d.upper_angle_limit.value_or(0.0),
               Unit::kAngle, std::nullopt);
}

// --- kinds ---

bool read_kind(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  const Graph& g = reader.graph();
  const Node n = found.front().node;
  if (a.storage == model::Storage::kBoolean) {
    if (!g.is(n, "DIRECTED_DIMENSIONAL_LOCATION")) return false;
    assign_to(reader, at, a, model::Boolean(true));
    return true;
  }
  const Value v = g.get(n, "angle_selection");
  const auto it = v.is(Kind::kEnumeration)
                      ? std::find(a.enumerators.begin(), a.enumerators.end(), v.enumeration())
                      : a.enumerators.end();
  if (it == a.enumerators.end()) return false;
  assign_to(reader, at, a, model::AnyEnum{static_cast<std::int8_t>(it - a.enumerators.begin())});
  return true;
}

void write_kind(Writer& writer, const Row&, AnyRef owner, const Attribute& a, const void* data, Id root) {
  if (a.storage == model::Storage::kBoolean) {
    if (*model::value_of<model::Boolean>(a, data)) writer.become(root, "directed_dimensional_location");
    return;
  }
  writer.become(root, owner.type == TypeId::kSizeDimension ? "angular_size" : "angular_location");
  const auto code = static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code);
  writer.set(root, "angle_selection", enumerated(a.enumerators[code]));
}

bool read_path(Reader& reader, const Row&, AnyRef at, const Attribute& a,
               const std::vector<Terminal>& found) {
  const AnyRef to = reader.object_at(found.front().node, a.targets, found.front().scale);
  if (!to.set()) return false;
  assign_to(reader, at, a, AnyRef(to));
  return true;
}

void write_path(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  writer.become(root, owner.type == TypeId::kSizeDimension ? "dimensional_size_with_path"
                                                           : "dimensional_location_with_path");
  const Id curve = writer.instance_of(model::value_of<AnyRef>(a, data));
  const Id path = writer.walk(row, owner, root, row.steps.size() - 1, 0);
  in_shape(writer, path, owner);
  if (curve != kNoId) writer.link(writer.walk(row, owner, root, 1, 0), "items", curve);
}

}  // namespace

const Codec kDimensionValueCodec{"dimension_value", &read_value, &write_value};
const Codec kDimensionQualifiersCodec{"dimension_qualifiers", &read_qualifiers, &write_qualifiers};
const Codec kDimensionToleranceCodec{"dimension_tolerance", &read_tolerance, &write_tolerance};
const Codec kDimensionAngleLimitCodec{"dimension_angle_limit", &read_angle_limit, &write_angle_limit};
const Codec kDimensionKindCodec{"dimension_kind", &read_kind, &write_kind};
const Codec kMeasurementPathCodec{"measurement_path", &read_path, &write_path};

}  // namespace capstan::exchange::ap238
