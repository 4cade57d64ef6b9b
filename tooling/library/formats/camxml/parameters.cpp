#include "tooling/library/formats/camxml/parameters.h"

#include <algorithm>

#include "planner/ground/base/number.h"

namespace capstan::tooling::camxml {

std::string parameter(const XmlNode& tool, std::string_view name) {
  for (const XmlNode& c : tool.children)
    if (c.name == "param" && c.attribute("name") == name) return c.attribute("value");
  return {};
}

void read_parameters(const XmlNode& tool, std::span<const Parameter> known,
                     std::span<const std::string_view> taken_elsewhere, std::string_view unit,
                     std::string_view system, const Place& place, CatalogueItem& item, ItemGatherer& gatherer,
                     LossReport& report) {
  for (const XmlNode& c : tool.children) {
    if (c.name != "param") continue;
    const std::string name = c.attribute("name"), value = c.attribute("value");
    if (value.empty() || std::ranges::find(taken_elsewhere, name) != taken_elsewhere.end()) continue;
    const auto at = std::ranges::find(known, name, &Parameter::name);
    const bool zero = parse_double(value) == 0.0;
    if (at == known.end()) {
      item.kept.emplace_back(name, value);
      if (!zero)
        report.dropped.push_back({item.id, name, "no symbol that is known; kept word for word: " + value});
      continue;
    }
    if (zero && at->symbol != "DC" && at->symbol != "ZEFF") continue;
    const SymbolFact* fact = symbol_fact(at->symbol);
    std::string_view u;
    if (fact != nullptr && fact->quantity == Quantity::kLength) u = unit;
    if (fact != nullptr && fact->quantity == Quantity::kAngle) u = "deg";
    Place here = place;
    here.line = c.line;
    here.path = item.id + ", " + name;
    gatherer.fault(add_value(item, {at->symbol, value, u, std::string(system) + " " + name}, here));
  }
}

std::optional<double> positive(std::string_view text, const Place& place, ItemGatherer& gatherer) {
  if (trimmed_text(text).empty()) return std::nullopt;
  const auto v = number_from(text, place);
  if (!v) {
    gatherer.fault(v.error());
    return std::nullopt;
  }
  if (*v < 0.0) gatherer.fault(place, "'" + std::string(text) + "' is negative", "a number from 0");
  if (*v <= 0.0) return std::nullopt;
  return *v;
}

}  // namespace capstan::tooling::camxml
