#include <cmath>
#include <numbers>

#include "planner/files/exchange/ap238/codecs/feature_codec.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Unit;
using p21::Kind;
using p21::Value;

namespace {

using p21::quoted;

/// The text of a spelling: 'width' without its quotes.
std::string bare(const std::string& spelling) {
  return spelling.size() >= 2 ? spelling.substr(1, spelling.size() - 2) : std::string();
}

/// The name the row's last step asks for, as spelled.
std::string role(const Row& row) {
  for (const Constraint& c : row.steps.back().constraints) {
    if (c.attribute == "name" && !c.texts.empty()) return c.texts.front();
  }
  return "''";
}

Value number_of(const Graph& g, Node n) {
  const Value v = g.get(n, "value_component");
  return v.is(Kind::kTyped) ? v[0] : v;
}

/// Factor from a number beside the measure (a limit) to millimetres or radians.
double factor_of(Reader& reader, Node n, Unit unit, const Scale& scale) {
  const Value u = reader.graph().get(n, "unit_component");
  if (u.is(Kind::kReference)) {
    const Node at = reader.graph().find(u.reference());
    const auto of = at == kNoNode ? std::nullopt : reader.units().unit(at);
    return of ? Units::factor(*of, unit).value_or(1.0) : 1.0;
  }
  return unit == Unit::kAngle ? scale.angle : scale.length;
}

void mark_one(Reader& reader, const Row& row, AnyRef at, Node n, std::uint32_t ordinal) {
  Terminal t;
  t.trail.push_back({n, row.steps.back().prefix, ordinal});
  reader.mark(t, at);
}

void came_from(Reader& reader, AnyRef at, Node n) {
  const auto i = reader.graph().instance(n);
  reader.plan().model.set_origin(at, {i.id(), i.line()});
}

void put(Reader& reader, AnyRef at, const Attribute& a, AnyRef value) {
  *static_cast<AnyRef*>(a.at(reader.plan().model.object(at))) = value;
}

struct Qualifiers {
  std::optional<double> upper, lower, deviation;
  std::optional<std::int64_t> digits;
  std::string type;
};

Qualifiers qualifiers(Reader& reader, const Row& row, AnyRef owner, Node n, double factor) {
  const Graph& g = reader.graph();
  Qualifiers out;
  std::vector<Node> found;
  g.references(g.get(n, "qualifiers"), found);
  std::uint32_t k = 1000;  // ordinals that no list has
  for (const Node q : found) {
    const Value name = g.get(q, "measure_name"), value = g.get(q, "uncertainty_value");
    const Value digits = g.get(q, "precision_value");
    const std::string which = name.is(Kind::kString) ? name.as_text() : "";
    std::optional<double>* limit = !value.is_number()       ? nullptr
                                   : which == "upper limit" ? &out.upper
                                   : which == "lower limit" ? &out.lower
                                   : which == "deviation"   ? &out.deviation
                                                            : nullptr;
    if (limit != nullptr) {
      const auto x = reader.finite(q, value.as_real(), factor, "the " + which);
      if (!x) continue;
      *limit = *x;
    } else if (digits.is(Kind::kInteger)) {
      out.digits = digits.as_integer();
    } else if (g.is(q, g.schema().find("TYPE_QUALIFIER")) && g.get(q, "name").is(Kind::kString)) {
      out.type = g.get(q, "name").as_text();
    } else {
      continue;  // kept
    }
    mark_one(reader, row, owner, q, k++);
  }
  return out;
}

/// The fit of the dimension that the measure represents: the nodes on the way, the LIMITS_AND_FITS last.
std::vector<Node> way_to_fit(const Graph& g, Node measure) {
  const auto& s = g.schema();
  for (const Node r : g.users(measure)) {
    if (!g.is(r, s.find("SHAPE_DIMENSION_REPRESENTATION"))) continue;
    for (const Node c : g.users(r)) {
      if (!g.is(c, s.find("DIMENSIONAL_CHARACTERISTIC_REPRESENTATION"))) continue;
      const Value d = g.get(c, "dimension");
      const Node dimension = d.is(Kind::kReference) ? g.find(d.reference()) : kNoNode;
      if (dimension == kNoNode) continue;
      for (const Node t : g.users(dimension)) {
        if (!g.is(t, s.find("PLUS_MINUS_TOLERANCE"))) continue;
        const Value range = g.get(t, "range");
        const Node fit = range.is(Kind::kReference) ? g.find(range.reference()) : kNoNode;
        if (fit != kNoNode && g.is(fit, s.find("LIMITS_AND_FITS"))) return {r, c, dimension, t, fit};
      }
    }
  }
  return {};
}

AnyRef read_fit(Reader& reader, const std::vector<Node>& way, const Qualifiers& q) {
  const Graph& g = reader.graph();
  const auto text = [&](const char* attribute) {
    const Value v = g.get(way.back(), attribute);
    return v.is(Kind::kString) ? v.as_text() : std::string();
  };
  model::LimitsAndFits out;
  const std::string zone = text("zone_variance"), grade = text("grade"), form = text("form_variance");
  if (const auto number = parse_double(grade)) out.grade = *number;
  if (zone == "shaft" || zone == "hole") {
    out.its_fitting_type = zone == "hole" ? model::FittingType::kHole : model::FittingType::kShaft;
  }
  if (q.deviation) {  // as ISO 14649 has it
    out.deviation = *q.deviation;
  } else {
    out.zone_variance = zone;
    out.tolerance_grade = grade;
  }
  if (!form.empty()) out.form_variance = form;
  if (const std::string source = text("source"); !source.empty()) out.source = source;
  const auto at = reader.plan().model.add(std::move(out));
  came_from(reader, at, way.back());
  return at;
}

bool read_toleranced(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                     const std::vector<Terminal>& found) {
  for (const Terminal& t : found) {
    const Value v = number_of(reader.graph(), t.node);
    if (v.is(Kind::kOmitted)) {  // says nothing
      reader.mark(t, at);
      continue;
    }
    const auto x = reader.measure(t.node, Unit::kLength, t.scale);
    if (!x) continue;
    model::TolerancedLengthMeasure out;
    out.theoretical_size = *x;
    const Qualifiers q =
        qualifiers(reader, row, at, t.node, factor_of(reader, t.node, Unit::kLength, t.scale));
    const auto way = way_to_fit(reader.graph(), t.node);
    if (!way.empty()) {
      out.implicit_tolerance = decltype(out.implicit_tolerance)(read_fit(reader, way, q));
      std::uint32_t k = 2000;
      for (const Node n : way) mark_one(reader, row, at, n, k++);
    } else if (q.upper || q.lower || q.digits) {
      model::PlusMinusValue limits;
      if (q.upper) limits.upper_limit = *q.upper;
      if (q.lower) limits.lower_limit = *q.lower;
      if (q.digits) limits.significant_digits = *q.digits;
      const auto tolerance = reader.plan().model.add(std::move(limits));
      came_from(reader, tolerance, t.node);
      out.implicit_tolerance = decltype(out.implicit_tolerance)(AnyRef(tolerance));
    }
    const auto made = reader.plan().model.add(std::move(out));
    came_from(reader, made, t.node);
    put(reader, at, a, made);
    return true;
  }
  return false;
}

Id qualifier(Writer& writer, const char* name, double value) {
  const Id id = writer.make("standard_uncertainty");
  writer.set(id, "measure_name", quoted(name));
  writer.set(id, "uncertainty_value", part21_real(value));
  return id;
}

/// A measure or text with its qualifiers.
Id qualified(Writer& writer, std::string entity, const std::string& name, const std::vector<Id>& by) {
  if (!by.empty()) entity += "&qualified_representation_item";
  const Id id = writer.make(entity);
  writer.set(id, "representation_item.name", name);
  for (const Id q : by) writer.link(id, "qualifiers", q);
  return id;
}

void write_fit(Writer& writer, const model::LimitsAndFits& fit, const std::string& name, Id measure,
               Id root) {
  const Id range = writer.make("limits_and_fits");
  const std::string zone = !fit.its_fitting_type.set()                         ? ""
                           : fit.its_fitting_type == model::FittingType::kHole ? "hole"
                                                                               : "shaft";
  writer.set(range, "form_variance", quoted(fit.form_variance.value_or("")));
  writer.set(range, "zone_variance", quoted(fit.zone_variance.value_or(zone)));
  writer.set(range, "grade", quoted(fit.tolerance_grade.value_or(fit.grade ? shortest(*fit.grade) : "")));
  writer.set(range, "limits_and_fits.source", quoted(fit.source.value_or("")));
  const Id size = writer.make("dimensional_size");
  writer.link(size, "applies_to", root);
  writer.set(size, "name", name);
  const Id tolerance = writer.make("plus_minus_tolerance");
  writer.link(tolerance, "range", range);
  writer.link(tolerance, "toleranced_dimension", size);
  const Id shape = writer.make("shape_dimension_representation");
  writer.link(shape, "items", measure);
  writer.link(shape, "context_of_items", writer.shared("context"));
  const Id dimension = writer.make("dimensional_characteristic_representation");
  writer.link(dimension, "dimension", size);
  writer.link(dimension, "representation", shape);
}

void join(Writer& writer, const Row& row, AnyRef owner, Id root, Id target) {
  writer.connect(row.steps.back(), writer.walk(row, owner, root, 1, 0), target, 0, owner);
}

void write_measure_as(Writer& writer, const Row& row, AnyRef owner, AnyRef value, Id root,
                      const std::string& name) {
  const auto* m = writer.model().get<model::TolerancedLengthMeasure>(value);
  if (m == nullptr) {
    if (const Id id = value.set() ? writer.instance_of(value) : kNoId; id != kNoId)
      join(writer, row, owner, root, id);
    return;
  }
  const auto* limits = writer.model().get<model::PlusMinusValue>(m->implicit_tolerance);
  const auto* fit = writer.model().get<model::LimitsAndFits>(m->implicit_tolerance);
  std::vector<Id> by;
  if (limits != nullptr) {
    if (limits->lower_limit) by.push_back(qualifier(writer, "lower limit", *limits->lower_limit));
    if (limits->upper_limit) by.push_back(qualifier(writer, "upper limit", *limits->upper_limit));
    if (limits->significant_digits) {
      by.push_back(writer.make("precision_qualifier"));
      writer.set(by.back(), "precision_value", std::to_string(*limits->significant_digits));
    }
  }
  if (fit != nullptr && fit->deviation) by.push_back(qualifier(writer, "deviation", *fit->deviation));
  const Id id = qualified(writer, "length_measure_with_unit&measure_representation_item", name, by);
  writer.set(id, "value_component",
             m->theoretical_size ? "LENGTH_MEASURE(" + part21_real(*m->theoretical_size) + ")" : "$");
  writer.link(id, "unit_component", writer.shared("mm"));
  join(writer, row, owner, root, id);
  if (fit != nullptr) write_fit(writer, *fit, name, id, root);
}

void write_toleranced(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                      Id root) {
  write_measure_as(writer, row, owner, model::value_of<AnyRef>(a, data), root, role(row));
}

// --- parameters with a name and a unit in words ---

struct Role {
  Unit unit;
  std::string_view entity, measure, shared, canonical;
};

Role role_of(const std::string& name) {
  if (name.find("angle") != std::string::npos) {
    return {Unit::kAngle, "plane_angle_measure_with_unit&measure_representation_item", "PLANE_ANGLE_MEASURE",
            "radian", "rad"};
  }
  if (name.find("number of") != std::string::npos) {
    return {Unit::kRatio, "ratio_measure_with_unit&measure_representation_item", "RATIO_MEASURE", "ratio",
            "1/mm"};
  }
  return {Unit::kLength, "length_measure_with_unit&measure_representation_item", "LENGTH_MEASURE", "mm",
          "mm"};
}

/// Factor from a number in a unit given in words to the role's unit; 1 for unknown words.
double factor_of_words(std::string words, Unit unit) {
  for (char& c : words) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  struct Word {
    std::string_view text;
    Unit unit;
    double factor;
  };
  static constexpr Word kWords[] = {{"in", Unit::kLength, kMmPerInch},
                                    {"inch", Unit::kLength, kMmPerInch},
                                    {"inches", Unit::kLength, kMmPerInch},
                                    {"cm", Unit::kLength, 10.0},
                                    {"m", Unit::kLength, 1000.0},
                                    {"deg", Unit::kAngle, std::numbers::pi / 180.0},
                                    {"degree", Unit::kAngle, std::numbers::pi / 180.0},
                                    {"degrees", Unit::kAngle, std::numbers::pi / 180.0}};
  for (const Word& w : kWords) {
    if (w.unit == unit && w.text == words) return w.factor;
  }
  return 1.0;
}

/// 'NAME [UNIT]', as the qualifier of a parameter that its role does not say all of.
void take_type(const std::string& type, model::Text& name, model::Text* unit) {
  const auto open = type.rfind(" [");
  if (unit != nullptr && open != std::string::npos && type.back() == ']') {
    name = type.substr(0, open);
    *unit = type.substr(open + 2, type.size() - open - 3);
  } else {
    name = type;
    if (unit != nullptr) unit->reset();
  }
}

bool read_parameter(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                    const std::vector<Terminal>& found) {
  const std::string name = bare(role(row));
  const Role as = role_of(name);
  for (const Terminal& t : found) {
    if (number_of(reader.graph(), t.node).is(Kind::kOmitted)) {
      reader.mark(t, at);
      continue;
    }
    const auto x = reader.measure(t.node, as.unit, t.scale);
    if (!x) continue;
    model::NumericParameter out;
    out.parameter_name = name;
    // A number of threads is per unit of length: of the file's own.
    out.its_parameter_unit =
        as.unit == Unit::kRatio && t.scale.length == kMmPerInch ? "1/in" : std::string(as.canonical);
    out.its_parameter_value = *x;
    const Qualifiers q = qualifiers(reader, row, at, t.node, 1.0);
    if (!q.type.empty()) {
      take_type(q.type, out.parameter_name, &out.its_parameter_unit);
      const double factor = factor_of_words(out.its_parameter_unit.value_or(""), as.unit);
      const auto said = reader.finite(t.node, *x / factor, 1.0, name);
      if (!said) continue;
      out.its_parameter_value = *said;
    }
    const auto made = reader.plan().model.add(std::move(out));
    came_from(reader, made, t.node);
    put(reader, at, a, made);
    return true;
  }
  return false;
}

std::vector<Id> type_qualifier(Writer& writer, const std::string& role_name, const model::Text& name,
                               const std::string& unit_words, bool usual_unit) {
  if (usual_unit && name.value_or("") == role_name) return {};
  const Id id = writer.make("type_qualifier");
  writer.set(id, "name", quoted(name.value_or("") + unit_words));
  return {id};
}

void write_parameter(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                     Id root) {
  const auto* p = writer.model().get<model::NumericParameter>(model::value_of<AnyRef>(a, data));
  if (p == nullptr) return;
  const std::string name = bare(role(row));
  const Role as = role_of(name);
  const std::string words = p->its_parameter_unit ? " [" + *p->its_parameter_unit + "]" : "";
  const auto by = type_qualifier(writer, name, p->parameter_name, words,
                                 p->its_parameter_unit == std::string(as.canonical));
  const Id id = qualified(writer, std::string(as.entity), role(row), by);
  std::string value = "$";
  if (p->its_parameter_value) {
    const double x = *p->its_parameter_value * factor_of_words(p->its_parameter_unit.value_or(""), as.unit);
    if (std::isfinite(x)) {
      value = std::string(as.measure) + "(" + part21_real(x) + ")";
    } else {
      writer.lose("a parameter that is not finite in " + std::string(as.canonical));
    }
  }
  writer.set(id, "value_component", value);
  writer.link(id, "unit_component", writer.shared(as.shared));
  join(writer, row, owner, root, id);
}

bool read_parameter_text(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                         const std::vector<Terminal>& found) {
  const Terminal& t = found.front();
  model::DescriptiveParameter out;
  out.parameter_name = bare(role(row));
  out.descriptive_string = reader.description(t.node);
  const Qualifiers q = qualifiers(reader, row, at, t.node, 1.0);
  if (!q.type.empty()) take_type(q.type, out.parameter_name, nullptr);
  const auto made = reader.plan().model.add(std::move(out));
  came_from(reader, made, t.node);
  put(reader, at, a, made);
  return true;
}

void write_parameter_text(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                          Id root) {
  const auto* p = writer.model().get<model::DescriptiveParameter>(model::value_of<AnyRef>(a, data));
  if (p == nullptr) return;
  const auto by = type_qualifier(writer, bare(role(row)), p->parameter_name, "", true);
  const Id id = qualified(writer, "descriptive_representation_item", role(row), by);
  writer.set(id, "description", quoted(p->descriptive_string.value_or("")));
  join(writer, row, owner, root, id);
}

// --- the diameter of a polygon ---

bool read_across_flats(Reader& reader, const Row& row, AnyRef at, const Attribute& a,
                       const std::vector<Terminal>&) {
  *static_cast<model::Boolean*>(a.at(reader.plan().model.object(at))) =
      role(row) == "'diameter across flats'";
  return true;
}

void write_ngon_diameter(Writer& writer, const Row& row, AnyRef owner, const Attribute& a, const void* data,
                         Id root) {
  const bool across = writer.model().at<model::NgonClosedProfile>(owner).circumscribed.value_or(false);
  write_measure_as(writer, row, owner, model::value_of<AnyRef>(a, data), root,
                   across ? "'diameter across flats'" : "'circumscribed diameter'");
}

void write_nothing(Writer&, const Row&, AnyRef, const Attribute&, const void*, Id) {}

}  // namespace

const Codec kTolerancedCodec{"toleranced", &read_toleranced, &write_toleranced};
const Codec kParameterCodec{"parameter", &read_parameter, &write_parameter};
const Codec kParameterTextCodec{"parameter_text", &read_parameter_text, &write_parameter_text};
const Codec kAcrossFlatsCodec{"across_flats", &read_across_flats, &write_nothing};
const Codec kNgonDiameterCodec{"ngon_diameter", &read_toleranced, &write_ngon_diameter};

}  // namespace capstan::exchange::ap238
