#include "planner/files/exchange/ap238/tables/measure.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/ground/vocabulary/unit_factors.h"

namespace capstan::exchange::ap238 {

using p21::Kind;
using p21::Value;

namespace {

// SI prefixes (ISO 10303-41 si_prefix).
std::optional<double> prefix(const Value& v) {
  if (!v.is(Kind::kEnumeration)) return 1.0;
  const auto p = v.enumeration();
  struct Row {
    std::string_view name;
    double factor;
  };
  static constexpr Row kRows[] = {{"EXA", 1e18},  {"PETA", 1e15},  {"TERA", 1e12},   {"GIGA", 1e9},
                                  {"MEGA", 1e6},  {"KILO", 1e3},   {"HECTO", 1e2},   {"DECA", 1e1},
                                  {"DECI", 1e-1}, {"CENTI", 1e-2}, {"MILLI", 1e-3},  {"MICRO", 1e-6},
                                  {"NANO", 1e-9}, {"PICO", 1e-12}, {"FEMTO", 1e-15}, {"ATTO", 1e-18}};
  for (const Row& r : kRows) {
    if (r.name == p) return r.factor;
  }
  return std::nullopt;
}

// SI unit names (ISO 10303-41 si_unit_name) that machining needs: exponents of m, kg, s, then rad.
std::optional<FileUnit> si_name(std::string_view name) {
  struct Row {
    std::string_view name;
    double factor, m, kg, s, rad;
  };
  static constexpr Row kRows[] = {{"METRE", 1, 1, 0, 0, 0},     {"GRAM", 1e-3, 0, 1, 0, 0},
                                  {"SECOND", 1, 0, 0, 1, 0},    {"RADIAN", 1, 0, 0, 0, 1},
                                  {"STERADIAN", 1, 0, 0, 0, 2}, {"HERTZ", 1, 0, 0, -1, 0},
                                  {"NEWTON", 1, 1, 1, -2, 0},   {"PASCAL", 1, -1, 1, -2, 0},
                                  {"JOULE", 1, 2, 1, -2, 0},    {"WATT", 1, 2, 1, -3, 0}};
  for (const Row& r : kRows) {
    if (r.name == name) return FileUnit{r.factor, {r.m, r.kg, r.s, 0, 0, 0, 0, r.rad}, false};
  }
  if (name == "KELVIN" || name == "DEGREE_CELSIUS") return FileUnit{1.0, {0, 0, 0, 0, 1, 0, 0, 0}, false};
  if (name == "AMPERE") return FileUnit{1.0, {0, 0, 0, 1, 0, 0, 0, 0}, false};
  return std::nullopt;
}

double number(const Value& v) {
  const Value bare = v.is(Kind::kTyped) ? v[0] : v;
  return bare.is_number() ? bare.as_real() : std::nan("");
}

bool is_revolution(const Value& name) {
  if (!name.is(Kind::kString)) return false;
  std::string s = name.as_text();
  for (char& c : s) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return s == "revolution" || s == "revolutions" || s == "rotation" || s == "turn" || s == "count" ||
         s == "each" || s == "tooth" || s == "rev";
}

}  // namespace

std::optional<FileUnit> Units::unit(Node n) { return part(n, 0); }

std::optional<FileUnit> Units::part(Node n, int depth) {
  const auto [it, fresh] =
      units_.try_emplace(n);  // nothing while it is being worked out: a part of itself is none
  if (!fresh) return it->second;
  auto out = work_out(n, depth);
  if (out && !(out->factor > 0.0 && std::isfinite(out->factor))) out.reset();
  units_[n] = out;
  return out;
}

std::optional<FileUnit> Units::work_out(Node n, int depth) {
  constexpr int kDeepest = 16;  // a unit of a unit of a unit: real ones need three
  if (depth > kDeepest) return std::nullopt;
  const auto& schema = g_.schema();
  const auto is = [&](const char* e) { return g_.is(n, schema.find(e)); };
  used_.push_back(n);
  for (const Node user : g_.users(n)) {  // its name, if it has one apart
    if (g_.is(user, schema.find("NAME_ATTRIBUTE"))) used_.push_back(user);
  }
  const auto follow = [&](const Value& v) {
    return v.is(Kind::kReference) ? g_.find(v.reference()) : kNoNode;
  };
  if (const Node d = follow(g_.get(n, "dimensions")); d != kNoNode) used_.push_back(d);
  if (is("SI_UNIT")) {
    const Value name = g_.get(n, "si_unit.name");
    const auto scale = prefix(g_.get(n, "prefix"));
    auto out = name.is(Kind::kEnumeration) ? si_name(name.enumeration()) : std::nullopt;
    if (!out || !scale) return std::nullopt;
    out->factor *= *scale;
    return out;
  }
  if (is("CONVERSION_BASED_UNIT")) {
    const Node m = follow(g_.get(n, "conversion_factor"));
    if (m == kNoNode) return std::nullopt;
    used_.push_back(m);
    const Node base = follow(g_.get(m, "unit_component"));
    const double value = number(g_.get(m, "value_component"));
    if (base == kNoNode || !(value > 0.0) || !std::isfinite(value)) return std::nullopt;
    auto out = part(base, depth + 1);
    if (!out) return std::nullopt;
    out->factor *= value;
    // Files spell the degree with 8 to 12 digits.
    if (out->exponents[7] == 1.0 && std::abs(out->factor - kRadPerDegree) < 1e-9) out->factor = kRadPerDegree;
    out->counted = out->exponents[7] == 1.0 && is_revolution(g_.get(n, "conversion_based_unit.name"));
    return out;
  }
  if (is("CONTEXT_DEPENDENT_UNIT")) {
    FileUnit out;
    out.counted = true;
    if (is_revolution(g_.get(n, "context_dependent_unit.name"))) return out;
    return is("RATIO_UNIT") ? std::optional(out) : std::nullopt;
  }
  if (is("DERIVED_UNIT")) {
    const Value elements = g_.get(n, "elements");
    FileUnit out;
    if (!elements.is(Kind::kList)) return std::nullopt;
    for (std::size_t i = 0; i < elements.size(); ++i) {
      const Node e = follow(elements[i]);
      const Node u = e == kNoNode ? kNoNode : follow(g_.get(e, "unit"));
      const double exponent = e == kNoNode ? 0.0 : number(g_.get(e, "exponent"));
      if (u == kNoNode || !std::isfinite(exponent)) return std::nullopt;
      used_.push_back(e);
      const auto by = part(u, depth + 1);
      if (!by) return std::nullopt;
      out.factor *= std::pow(by->factor, exponent);
      for (std::size_t k = 0; k < out.exponents.size(); ++k) out.exponents[k] += exponent * by->exponents[k];
      out.counted = out.counted || by->counted;
    }
    return out;
  }
  if (is("RATIO_UNIT")) return FileUnit{};
  return std::nullopt;
}

std::optional<double> Units::factor(const FileUnit& from, model::Unit to) {
  using model::Unit;
  struct Row {
    Unit unit;
    double m, kg, s, rad;
    double si;  // the model's unit in SI units
  };
  static constexpr Row kRows[] = {
      {Unit::kLength, 1, 0, 0, 0, 1e-3},      {Unit::kAngle, 0, 0, 0, 1, 1.0},
      {Unit::kSpeed, 1, 0, -1, 0, 1e-3 / 60}, {Unit::kRotSpeed, 0, 0, -1, 0, 1.0 / 60},
      {Unit::kTime, 0, 0, 1, 0, 1.0},         {Unit::kRatio, 0, 0, 0, 0, 1.0},
      {Unit::kNone, 0, 0, 0, 0, 1.0},         {Unit::kPressure, -1, 1, -2, 0, 1e6},
      {Unit::kVolume, 3, 0, 0, 0, 1e-9},      {Unit::kPower, 2, 1, -3, 0, 1.0},
      {Unit::kTorque, 2, 1, -2, 0, 1.0}};
  for (const Row& r : kRows) {
    if (r.unit != to) continue;
    FileUnit f = from;
    // Revolutions and radians per time are both spindle speeds; a counted thing has no angle.
    if (f.exponents[7] != 0.0 && r.rad == 0.0 && (f.counted || to == Unit::kRotSpeed)) {
      f.factor /= std::pow(kRadPerTurn, f.exponents[7]);
      f.exponents[7] = 0.0;
    }
    const std::array<double, 8> want = {r.m, r.kg, r.s, 0, 0, 0, 0, r.rad};
    if (f.exponents != want) return std::nullopt;
    // Exact for what files hold: millimetres, millimetres per minute, inches.
    const double raw = f.factor / r.si;
    const double tidy = std::round(raw * 1e9) / 1e9;
    return std::abs(raw - tidy) <= 1e-15 * std::abs(raw) * 8 && tidy != 0.0 ? tidy : raw;
  }
  return std::nullopt;
}

Scale Units::scale(Node context, const Scale& fallback) {
  if (context == kNoNode) return fallback;
  const auto it = scales_.find(context);
  if (it != scales_.end()) return it->second;
  used_.push_back(context);
  Scale out = fallback;
  out.stated = false;
  const Value units = g_.get(context, "units");
  bool failed = false, two = false;
  for (std::size_t i = 0; units.is(Kind::kList) && i < units.size(); ++i) {
    const Node n = units[i].is(Kind::kReference) ? g_.find(units[i].reference()) : kNoNode;
    const auto u = n == kNoNode ? std::nullopt : unit(n);
    if (!u) {
      failed = true;
      continue;
    }
    if (const auto f = factor(*u, model::Unit::kLength)) {
      // A micron's thousandth to a thousand kilometres: anything else is no unit for a workpiece.
      failed = failed || !(*f > 1e-9 && *f < 1e9);
      two = two || (out.stated && *f != out.length);
      out.length = *f;
      out.stated = true;
    } else if (const auto a = factor(*u, model::Unit::kAngle)) {
      out.angle = *a;
    }
  }
  const Value dimension = g_.get(context, "coordinate_space_dimension");
  const bool space = dimension.is(Kind::kInteger) && dimension.as_integer() == 3;
  const bool with_units = g_.is(context, g_.schema().find("GLOBAL_UNIT_ASSIGNED_CONTEXT"));
  out.unclear =
      two || (out.stated ? !(out.length > 1e-9 && out.length < 1e9) : with_units && (failed || space));
  const Value name = g_.get(context, "context_identifier");
  out.ours = out.stated && out.identity() && name.is(Kind::kString) && name.as_text() == kWrittenContext;
  const Value uncertainty = g_.get(context, "uncertainty");
  std::vector<Node> parts;
  g_.references(uncertainty, parts);
  used_.insert(used_.end(), parts.begin(), parts.end());
  // A context with units of its own has only the uncertainty that it states; of several lengths the least.
  double least = 0.0;
  for (const Node n : parts) {
    const Value of = g_.get(n, "unit_component");
    const Node base = of.is(Kind::kReference) ? g_.find(of.reference()) : kNoNode;
    const auto u = base == kNoNode ? std::nullopt : unit(base);
    const auto f = u ? factor(*u, model::Unit::kLength) : std::nullopt;
    const double mm = f ? *f * number(g_.get(n, "value_component")) : 0.0;
    if (mm > 0.0 && std::isfinite(mm)) least = least > 0.0 ? std::min(least, mm) : mm;
  }
  if (out.stated || least > 0.0) out.uncertainty_mm = least;
  scales_[context] = out;
  return out;
}

}  // namespace capstan::exchange::ap238
