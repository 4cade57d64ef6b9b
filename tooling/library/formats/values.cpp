#include "tooling/library/formats/values.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/plan/range/ranges.h"

namespace capstan::tooling {
namespace {

/// As in `faults_of`.
constexpr double kLongestMm = model::range::kToolLengthMm.most;
constexpr double kMostTeeth = model::range::kTeeth.most;
constexpr double kMostRpm = model::range::kToolSpeedRpm.most;

constexpr SymbolFact length(std::string_view symbol, std::string_view words) {
  return {symbol, Quantity::kLength, 0.0, kLongestMm, words};
}
constexpr SymbolFact count(std::string_view symbol, std::string_view words) {
  return {symbol, Quantity::kCount, 0.0, kMostTeeth, words};
}
constexpr SymbolFact text(std::string_view symbol, std::string_view words) {
  return {symbol, Quantity::kText, 0.0, 0.0, words};
}

constexpr std::array kFacts{
    length("DC", "cutting diameter"),
    length("DCX", "largest cutting diameter"),
    length("DCN", "diameter at the tip"),
    length("DN", "neck diameter"),
    length("LN", "neck length"),
    length("APMX", "depth of cut"),
    length("LCF", "flute length"),
    length("LU", "usable length"),
    length("LUX", "largest usable length"),
    length("OAL", "overall length"),
    length("LF", "functional length"),
    length("LPR", "protruding length"),
    length("DMM", "shank diameter"),
    length("DCONMS", "connection diameter"),
    length("LS", "shank length"),
    length("BD", "body diameter"),
    length("BDX", "largest body diameter"),
    length("LBX", "body length"),
    length("DF", "flange diameter"),
    length("RE", "corner radius"),
    length("CHW", "corner chamfer width"),
    length("CW", "cutting width"),
    length("TDZ", "thread size"),
    length("LEADLENGTH", "length of the lead"),
    SymbolFact{"LEADTHREADS", Quantity::kNumber, 0.0, model::range::kLeadThreads.most, "threads in the lead"},
    length("RUNOUT", "run-out of the teeth"),
    length("TP", "thread pitch"),
    length("TPN", "smallest thread pitch"),
    length("TPX", "largest thread pitch"),
    length("FZMIN", "least feed per tooth"),
    length("FZMAX", "largest feed per tooth"),
    SymbolFact{"KAPR", Quantity::kAngle, 0.0, 180.0, "cutting edge angle"},
    SymbolFact{"PSIR", Quantity::kAngle, -90.0, 90.0, "lead angle"},
    SymbolFact{"KCH", Quantity::kAngle, 0.0, 90.0, "corner chamfer angle"},
    SymbolFact{"SIG", Quantity::kAngle, 0.0, 180.0, "point angle"},
    SymbolFact{"FHA", Quantity::kAngle, -90.0, 90.0, "helix angle"},
    SymbolFact{"TA", Quantity::kAngle, -90.0, 90.0, "half taper angle"},
    SymbolFact{"RMPX", Quantity::kAngle, 0.0, 90.0, "largest ramp angle"},
    count("ZEFF", "number of effective teeth"),
    count("PCEDC", "number of peripheral edges"),
    count("FCEDC", "number of face edges"),
    count("CICT", "number of inserts"),
    SymbolFact{"RPMX", Quantity::kNumber, 0.0, kMostRpm, "largest speed"},
    SymbolFact{"WT", Quantity::kNumber, 0.0, 1000.0, "weight"},
    SymbolFact{"LIFE", Quantity::kNumber, 0.0, model::range::kToolLifeMin.most, "life"},
    SymbolFact{"PRICE", Quantity::kNumber, 0.0, model::range::kPrice.most, "price"},
    text("BMC", "body material"),
    text("SUBSTRATE", "substrate"),
    text("GRADE", "grade"),
    text("COATING", "coating"),
    text("HAND", "hand"),
    text("CCC", "cuts to the centre"),
    text("CSP", "coolant through the tool"),
    text("THFT", "thread form"),
};

bool is_inch(std::string_view unit) {
  const std::string u = lower_text(trimmed_text(unit));
  return u == "in" || u == "inch" || u == "inches" || u == "\"" || u == "imperial" || u == "in." ||
         u == "zoll";
}
bool is_mm(std::string_view unit) {
  const std::string u = lower_text(trimmed_text(unit));
  return u == "mm" || u == "millimeters" || u == "millimetres" || u == "millimeter" || u == "millimetre" ||
         u == "metric";
}
bool is_degree(std::string_view unit) {
  const std::string u = lower_text(trimmed_text(unit));
  return u == "deg" || u == "degree" || u == "degrees" || u == "\xC2\xB0" || u == "grad";
}

/// Ours per unit; nothing when the unit is not one of the quantity.
std::optional<double> factor_of(Quantity quantity, std::string_view unit) {
  if (quantity == Quantity::kLength) return mm_per_unit_of(unit);
  if (quantity == Quantity::kAngle) {
    if (is_degree(unit)) return kRadPerDegree;
    if (unit == "rad") return 1.0;
    return std::nullopt;
  }
  return 1.0;
}
/// Of a symbol that no one knows: by its unit alone.
double factor_of(std::string_view unit) {
  if (is_degree(unit)) return kRadPerDegree;
  return mm_per_unit_of(unit).value_or(1.0);
}

std::string said(const SymbolFact& fact, std::string_view text, std::string_view unit) {
  std::string out = std::string(fact.symbol) + " (" + std::string(fact.words) + ") is " + std::string(text);
  if (!unit.empty()) out += " " + std::string(unit);
  return out;
}

std::string range_text(const SymbolFact& fact) {
  const char* unit = fact.quantity == Quantity::kLength  ? " mm"
                     : fact.quantity == Quantity::kAngle ? " degrees"
                                                         : "";
  const std::string whole = fact.quantity == Quantity::kCount ? "a whole number from " : "a number from ";
  return whole + trimmed(fact.least, 3) + " to " + trimmed(fact.most, 3) + unit;
}

std::optional<Diagnostic> out_of_range(const SymbolFact& fact, double value, std::string_view text,
                                       std::string_view unit, const Place& place) {
  const double shown = fact.quantity == Quantity::kAngle ? value / kRadPerDegree : value;
  const bool broken = fact.quantity == Quantity::kCount && value != std::floor(value);
  constexpr double kSlack = 1e-9;
  if (!broken && shown >= fact.least - kSlack && shown <= fact.most + kSlack) return std::nullopt;
  return fault_at(place, "TOOL-VALUE", said(fact, text, unit), range_text(fact),
                  "correct the value or leave it out");
}

}  // namespace

const SymbolFact* symbol_fact(std::string_view symbol) {
  for (const SymbolFact& f : kFacts)
    if (f.symbol == symbol) return &f;
  return nullptr;
}

Diagnostic fault_at(const Place& place, std::string code, std::string message, std::string expected,
                    std::string hint) {
  return {.code = std::move(code),
          .message = std::move(message),
          .file = place.file,
          .line = place.line,
          .path = place.path,
          .expected = std::move(expected),
          .hint = std::move(hint)};
}

std::optional<double> mm_per_unit_of(std::string_view unit) {
  if (is_mm(unit)) return 1.0;
  if (is_inch(unit)) return kMmPerInch;
  return std::nullopt;
}

Result<double> number_from(std::string_view text, const Place& place, bool decimal_comma) {
  std::string_view t = trimmed_text(text);
  if (t.size() > 1 && t.front() == '+') t.remove_prefix(1);
  std::string with_point;
  const auto comma = t.find(',');
  if (comma != std::string_view::npos && comma == t.rfind(',') && t.find('.') == std::string_view::npos) {
    with_point = t;
    with_point[comma] = '.';
    if (!decimal_comma && parse_double(with_point))
      return fail(fault_at(place, "DATA-NUMBER", "'" + std::string(t) + "' has a decimal comma",
                           "a decimal point, as in " + with_point,
                           "write a point; CSV may declare decimal: ',' in its column map"));
    t = with_point;
  } else if (decimal_comma && comma != std::string_view::npos) {
    return fail(fault_at(place, "DATA-NUMBER",
                         "'" + std::string(t) + "' has more than one decimal or thousands mark",
                         "one decimal comma and no thousands marks", "remove the thousands marks"));
  }
  if (const auto v = parse_double(t)) return *v;
  return fail(fault_at(place, "DATA-NUMBER", no_number(t), "one finite decimal number",
                       "correct the value or leave it out"));
}

Result<Property> property_from(std::string_view symbol, std::string_view text, std::string_view unit,
                               std::string_view source, const Place& place, bool decimal_comma) {
  const SymbolFact* fact = symbol_fact(symbol);
  if (fact != nullptr && fact->quantity == Quantity::kText) return text_property(symbol, text, source);
  const auto value = number_from(text, place, decimal_comma);
  if (!value) return fail(value.error());
  double factor = 1.0;
  if (fact != nullptr) {
    const auto f = factor_of(fact->quantity, unit);
    if (!f)
      return fail(fault_at(
          place, "DATA-UNIT",
          unit.empty() ? "the unit of " + std::string(symbol) + " is missing"
                       : "the unit '" + std::string(unit) + "' is none of " + std::string(fact->words) + "s",
          fact->quantity == Quantity::kAngle ? "degrees" : "mm or inches", "state the unit in the file"));
    factor = *f;
    if (auto d = out_of_range(*fact, *value * factor, trimmed_text(text), unit, place)) return fail(*d);
  } else {
    factor = factor_of(unit);
  }
  std::string spelling(trimmed_text(text));
  if (decimal_comma) std::replace(spelling.begin(), spelling.end(), ',', '.');
  return Property{.symbol = std::string(symbol),
                  .number = *value * factor,
                  .text = std::move(spelling),
                  .unit = std::string(unit),
                  .state = ValueState::kStated,
                  .source = std::string(source)};
}

std::string words_of(const Property& p) {
  return std::string(to_text(p.state)) + ": " + (p.source.empty() ? p.symbol : p.source);
}

bool yes(std::string_view text) {
  const std::string t = lower_text(trimmed_text(text));
  return t == "true" || t == "yes" || t == "1" || t == "y" || t == "ja";
}

Property text_property(std::string_view symbol, std::string_view text, std::string_view source) {
  return {.symbol = std::string(symbol),
          .number = std::nullopt,
          .text = std::string(text),
          .unit = {},
          .state = ValueState::kStated,
          .source = std::string(source)};
}

Property number_property(std::string_view symbol, double number, std::string_view unit, ValueState state,
                         std::string_view source) {
  return {.symbol = std::string(symbol),
          .number = number,
          .text = spelled(number, factor_of(unit)),
          .unit = std::string(unit),
          .state = state,
          .source = std::string(source)};
}

std::string spelled(double ours, double factor) {
  return shortest(factor == 1.0 ? ours : unconverted(ours, factor));
}

std::string spelled_in(const Property& property, std::string_view unit) {
  if (!property.number) return property.text;
  const double wanted = factor_of(unit);
  if (!property.text.empty() && factor_of(property.unit) == wanted) return property.text;
  return spelled(*property.number, wanted);
}

std::string tool_words(std::size_t index, std::string_view description) {
  std::string out = "tool " + std::to_string(index + 1);
  if (!description.empty()) out += " '" + std::string(description.substr(0, 80)) + "'";
  return out;
}

std::string_view trimmed_text(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r\n");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\n") - first + 1);
}

std::string unique_id(const std::string& id, UniqueIds& ids) {
  std::string out = id;
  if (!ids.taken.insert(out).second) {
    int& n = ids.next.try_emplace(id, 2).first->second;
    do {
      out = id + " (" + std::to_string(n++) + ")";
    } while (!ids.taken.insert(out).second);
  }
  return out;
}

const std::string* find_kept(const std::vector<std::pair<std::string, std::string>>& kept,
                             std::string_view path) {
  for (const auto& [name, text] : kept)
    if (name == path) return &text;
  return nullptr;
}

}  // namespace capstan::tooling
