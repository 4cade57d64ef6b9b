#include "planner/files/exchange/conformance/links.h"

#include <algorithm>

namespace capstan::exchange::conformance {
namespace {

using express::Attribute;
using express::EntityId;
using p21::Kind;
using p21::Value;

constexpr std::array<std::string_view, kLinkCount> kAttributes = {
    "action_property.definition",
    "action_property_representation.property",
    "resource_property.resource",
    "resource_property_representation.property",
    "property_definition.definition",
    "property_definition_representation.definition",
    "shape_aspect.of_shape",
    "shape_aspect_relationship.related_shape_aspect",
    "action_method_relationship.relating_method",
    "action.chosen_method",
    "action_resource.usage",
};

// "action_property.name" as declared; null when the schema has no such attribute.
const Attribute* attribute_of(const express::Dictionary& d, std::string_view qualified) {
  const auto dot = qualified.find('.');
  const EntityId e = d.find(qualified.substr(0, dot));
  if (e == express::kNoEntity) return nullptr;
  const auto at = d.position(e, qualified.substr(dot + 1));
  return at ? d.slots(e)[*at].attribute : nullptr;
}

struct Place {
  std::size_t part, position;
};

std::optional<Place> place_of(const Layout& layout, const Attribute* attribute) {
  for (std::size_t part = 0; part < layout.slots.size(); ++part) {
    const auto& slots = layout.slots[part];
    for (std::size_t i = 0; i < slots.size(); ++i) {
      if (slots[i].attribute == attribute) return Place{part, i};
    }
  }
  return std::nullopt;
}

std::optional<Value> at(const p21::Instance& i, const Place& place) {
  const Value parameters = i.part(place.part).parameters;
  if (place.position >= parameters.size()) return std::nullopt;
  const Value v = parameters[place.position];
  if (v.is(Kind::kOmitted) || v.is(Kind::kDerived)) return std::nullopt;
  return v;
}

}  // namespace

Links::Links(const Population& population) : p_(population) {
  for (std::size_t link = 0; link < kLinkCount; ++link) gather(link, kAttributes[link]);
}

void Links::gather(std::size_t link, std::string_view attribute) {
  const Attribute* a = attribute_of(p_.dictionary(), attribute);
  std::vector<std::optional<Place>> places;
  bool any = false;
  for (const Layout& layout : p_.layouts()) {
    places.push_back(place_of(layout, a));
    any |= places.back().has_value();
  }
  if (!any) return;
  auto& pairs = pairs_[link];
  for (std::size_t i = 0; i < p_.file().size(); ++i) {
    const std::uint32_t layout = p_.layout_number(i);
    if (layout == Population::kNone || !places[layout]) continue;
    const auto v = at(p_.file().instance(i), *places[layout]);
    if (!v) continue;
    const auto add = [&](const Value& reference) {
      if (const auto t = target(reference))
        pairs.push_back({static_cast<std::uint32_t>(*t), static_cast<std::uint32_t>(i)});
    };
    if (!v->is(Kind::kList)) {
      add(*v);
      continue;
    }
    for (std::size_t k = 0; k < v->size(); ++k) add((*v)[k]);
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  for (const Pair& pair : pairs) sources_[link].push_back(pair.source);
}

std::span<const std::uint32_t> Links::to(Link link, std::size_t instance) const {
  const auto& pairs = pairs_[static_cast<std::size_t>(link)];
  const auto key = static_cast<std::uint32_t>(instance);
  const auto first = std::lower_bound(pairs.begin(), pairs.end(), key,
                                      [](const Pair& p, std::uint32_t k) { return p.target < k; });
  const auto last =
      std::upper_bound(first, pairs.end(), key, [](std::uint32_t k, const Pair& p) { return k < p.target; });
  return std::span(sources_[static_cast<std::size_t>(link)])
      .subspan(static_cast<std::size_t>(first - pairs.begin()), static_cast<std::size_t>(last - first));
}

std::optional<Value> Links::value(std::size_t instance, std::string_view attribute) const {
  const Layout* layout = p_.layout(instance);
  if (layout == nullptr) return std::nullopt;
  const Attribute* a = attribute_of(p_.dictionary(), attribute);
  if (a == nullptr) return std::nullopt;
  const auto place = place_of(*layout, a);
  return place ? at(p_.file().instance(instance), *place) : std::nullopt;
}

std::optional<std::string> Links::text(std::size_t instance, std::string_view attribute) const {
  const auto v = value(instance, attribute);
  if (!v || !v->is(Kind::kString)) return std::nullopt;
  return v->as_text();
}

std::optional<std::size_t> Links::target(const Value& reference) const {
  if (!reference.is(Kind::kReference)) return std::nullopt;
  const auto found = p_.file().find(reference.reference());
  if (!found) return std::nullopt;
  return found->index();
}

std::optional<std::size_t> Links::target(std::size_t instance, std::string_view attribute) const {
  const auto v = value(instance, attribute);
  return v ? target(*v) : std::nullopt;
}

std::vector<std::size_t> Links::targets(std::size_t instance, std::string_view attribute) const {
  std::vector<std::size_t> out;
  const auto v = value(instance, attribute);
  if (!v) return out;
  const Value list = v->is(Kind::kTyped) ? (*v)[0] : *v;  // a select of aggregates
  if (!list.is(Kind::kList)) return out;
  visits_ += list.size() + 1;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (const auto t = target(list[i])) out.push_back(*t);
  }
  return out;
}

bool Links::is_a(std::size_t instance, EntityId entity) const {
  const Layout* layout = p_.layout(instance);
  return layout != nullptr && p_.is_a(*layout, entity);
}

}  // namespace capstan::exchange::conformance
