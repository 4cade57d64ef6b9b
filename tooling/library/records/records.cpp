#include "tooling/library/records/records.h"

namespace capstan::tooling {

std::string_view to_text(ValueState s) {
  switch (s) {
    case ValueState::kStated:
      return "stated";
    case ValueState::kDerived:
      return "derived";
    case ValueState::kDefault:
      return "default";
  }
  return "";
}

const Property* find(const std::vector<Property>& properties, std::string_view symbol) {
  for (const Property& p : properties)
    if (p.symbol == symbol) return &p;
  return nullptr;
}

std::optional<double> number_of(const CatalogueItem& item, std::string_view symbol) {
  const Property* p = find(item.properties, symbol);
  return p == nullptr ? std::nullopt : p->number;
}

}  // namespace capstan::tooling
