#include "planner/files/exchange/brep/pmi_values.h"

#include <cmath>
#include <map>

#include "planner/ground/base/stopping.h"

namespace capstan::exchange {

using p21::Instance;
using p21::Kind;
using p21::Value;

namespace {

constexpr double kMmPerMetre = 1000.0;
/// Units that are defined by another may be nested so deep.
constexpr int kDeepestUnit = 8;

}  // namespace

std::optional<Value> as(const Instance& i, std::string_view keyword) {
  if (i.is_complex()) return i.part(keyword);
  if (i.keyword() == keyword) return i.parameters();
  return std::nullopt;
}

bool is(const Instance& i, std::string_view keyword) { return as(i, keyword).has_value(); }

std::optional<std::uint64_t> reference_at(const Value& list, std::size_t n) {
  if (!list.is(Kind::kList) || n >= list.size() || !list[n].is(Kind::kReference)) return std::nullopt;
  return list[n].reference();
}

std::string text_at(const Value& list, std::size_t n) {
  return list.is(Kind::kList) && n < list.size() && list[n].is(Kind::kString) ? list[n].as_text()
                                                                              : std::string();
}

void references_in(const Value& v, std::vector<std::uint64_t>& out) {
  std::vector<Value> pending{v};
  while (!pending.empty()) {
    tick();
    const Value at = pending.back();
    pending.pop_back();
    if (at.is(Kind::kReference)) out.push_back(at.reference());
    for (std::size_t i = at.size(); i-- > 0;) pending.push_back(at[i]);
  }
}

std::optional<std::pair<double, std::uint64_t>> number_of(const Instance& i) {
  std::optional<Value> p;
  std::size_t at = 0;
  if (i.is_complex()) {
    p = i.part("MEASURE_WITH_UNIT");
  } else if (i.keyword() == "MEASURE_REPRESENTATION_ITEM") {
    p = i.parameters();
    at = 1;
  } else if (i.keyword().ends_with("MEASURE_WITH_UNIT")) {
    p = i.parameters();
  }
  if (!p || p->size() < at + 2) return std::nullopt;
  Value number = (*p)[at];
  if (number.is(Kind::kTyped)) number = number[0];
  const auto unit = reference_at(*p, at + 1);
  if (!number.is_number() || !unit) return std::nullopt;
  return std::pair{number.as_real(), *unit};
}

namespace {

/// How many mm a unit of length is.
std::optional<double> mm_of(const p21::File& file, std::uint64_t unit) {
  double factor = 1.0;
  for (int depth = 0; depth < kDeepestUnit; ++depth) {
    const auto i = file.find(unit);
    if (!i) return std::nullopt;
    if (const auto si = as(*i, "SI_UNIT")) {
      static const std::map<std::string_view, double> kPrefixes = {
          {"KILO", 1e3}, {"DECI", 1e-1}, {"CENTI", 1e-2}, {"MILLI", 1e-3}, {"MICRO", 1e-6}};
      const std::size_t last = si->size();
      if (last < 2 || !(*si)[last - 1].is(Kind::kEnumeration)) return std::nullopt;
      if ((*si)[last - 1].enumeration() != "METRE") return std::nullopt;
      const Value prefix = (*si)[last - 2];
      if (!prefix.is(Kind::kEnumeration)) return factor * kMmPerMetre;
      const auto known = kPrefixes.find(prefix.enumeration());
      if (known == kPrefixes.end()) return std::nullopt;
      return factor * kMmPerMetre * known->second;
    }
    const auto by = as(*i, "CONVERSION_BASED_UNIT");
    const auto of = by ? reference_at(*by, 1) : std::nullopt;
    const auto measure = of ? file.find(*of) : std::nullopt;
    const auto number = measure ? number_of(*measure) : std::nullopt;
    if (!number) return std::nullopt;
    factor *= number->first;
    unit = number->second;
  }
  return std::nullopt;
}

}  // namespace

std::optional<double> length_of(const p21::File& file, std::uint64_t id) {
  const auto i = file.find(id);
  const auto number = i ? number_of(*i) : std::nullopt;
  const auto unit = number ? mm_of(file, number->second) : std::nullopt;
  if (!unit || !std::isfinite(number->first * *unit)) return std::nullopt;
  return number->first * *unit;
}

std::string name_of(const p21::File& file, const Instance& i) {
  if (!i.is_complex()) return text_at(i.parameters(), 0);
  const auto q = i.part("QUALIFIED_REPRESENTATION_ITEM");
  std::vector<std::uint64_t> qualifiers;
  if (q) references_in(*q, qualifiers);
  for (const std::uint64_t id : qualifiers) {
    const auto qualifier = file.find(id);
    const auto type = qualifier ? as(*qualifier, "TYPE_QUALIFIER") : std::nullopt;
    if (!type) continue;
    const std::string said = text_at(*type, 0);
    if (said == "maximum") return "upper limit";
    if (said == "minimum") return "lower limit";
  }
  const auto item = i.part("REPRESENTATION_ITEM");
  return item ? text_at(*item, 0) : std::string();
}

}  // namespace capstan::exchange
