#include "planner/files/exchange/ap238/tables/addresses.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/reached.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

namespace {

constexpr std::string_view kMarks = "{}:.%[]";

std::string escaped(const std::string& s) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string out;
  for (const char c : s) {
    if (kMarks.find(c) == std::string_view::npos) {
      out += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += '%';
    out += kDigits[byte >> 4U];
    out += kDigits[byte & 15U];
  }
  return out;
}

std::string unescaped(std::string_view s) {
  std::string out;
  for (std::size_t i = 0; i < s.size(); ++i) {
    unsigned byte = 0;
    if (s[i] == '%' && i + 2 < s.size() &&
        std::from_chars(s.data() + i + 1, s.data() + i + 3, byte, 16).ptr == s.data() + i + 3) {
      out += static_cast<char>(byte);
      i += 2;
    } else {
      out += s[i];
    }
  }
  return out;
}

/// Whether an object of this kind refers to others: a point, of which there are millions, does not.
bool leads_on(TypeId t) {
  const auto& all = model::noun_type(t).attributes;
  return std::any_of(all.begin(), all.end(), [](const Attribute& a) {
    return a.storage == Storage::kRef || a.storage == Storage::kRefList;
  });
}

bool has_a_name(TypeId t) {
  return model::is_a(t, TypeId::kExecutable) || model::is_a(t, TypeId::kManufacturingFeature) ||
         model::is_a(t, TypeId::kWorkpiece);
}

}  // namespace

// Calls `visit` with the way and what it leads to, for each reference outside tables and selects.
template <class Visit>
void Addresses::for_each_way(AnyRef at, const Visit& visit) const {
  if (at.type == TypeId::kKeptInstance) return;
  const void* data = m_.object(at);
  for (const Attribute& a : model::noun_type(at.type).attributes) {
    if (a.storage == Storage::kRef) {
      const AnyRef to = model::value_of<AnyRef>(a, data);
      if (to.set()) visit(Way{&a, kNoItem}, to);
    } else if (a.storage == Storage::kRefList) {
      const auto& items = model::value_of<model::AnyRefList>(a, data).items;
      for (std::uint32_t i = 0; i < items.size(); ++i) {
        if (items[i].set()) visit(Way{&a, i}, items[i]);
      }
    }
  }
}

Addresses::Addresses(const model::Plan& plan, const std::function<std::uint64_t(AnyRef)>& number)
    : m_(plan.model) {
  name_objects(number);
  if (const auto* p = m_.get<model::Project>(plan.project)) main_ = p->main_workplan;
  if (!m_.holds<model::Executable>(main_)) main_ = {};
  const AnyRef roots[] = {main_};
  for (const AnyRef at : model::reached_of(m_, roots, TypeId::kExecutable)) place_from(at);
  for (const auto& [name, objects] : named_) {
    for (const AnyRef at : objects) place_from(at);
  }
}

std::string Addresses::its_id(AnyRef at) const {
  const Attribute* a = model::find_attribute(at.type, "its_id");
  if (a == nullptr || a->storage != Storage::kText) return {};
  return model::value_of<model::Text>(*a, m_.object(at)).value_or("");
}

void Addresses::name_objects(const std::function<std::uint64_t(AnyRef)>& number) {
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    if (!has_a_name(type)) continue;
    for (const AnyRef at : m_.all(type)) {
      if (number(at) != 0) named_[{type, its_id(at)}].push_back(at);
    }
  }
  for (auto& [name, objects] : named_) {
    std::sort(objects.begin(), objects.end(), [&](AnyRef a, AnyRef b) { return number(a) < number(b); });
  }
}

bool Addresses::put(AnyRef at, const Place& place) {
  auto& places = places_[static_cast<std::size_t>(at.type)];
  if (places.empty()) places.resize(m_.count(at.type));
  Place& here = places[at.index];
  if (here.order != 0) return false;
  here = place;
  here.order = ++placed_;
  return true;
}

const Addresses::Place* Addresses::place_of(AnyRef at) const {
  const auto& places = places_[static_cast<std::size_t>(at.type)];
  return at.index < places.size() && places[at.index].order != 0 ? &places[at.index] : nullptr;
}

// Breadth first, so that each object has the shortest way; not into what has a name of its own.
void Addresses::place_from(AnyRef base) {
  if (!put(base, {.base = base, .from = {}, .way = {}})) return;
  std::vector<AnyRef> level = {base};
  while (!level.empty()) {
    std::vector<AnyRef> next;
    for (const AnyRef from : level) {
      for_each_way(from, [&](Way way, AnyRef to) {
        if (!has_a_name(to.type) && put(to, {.base = base, .from = from, .way = way}) && leads_on(to.type))
          next.push_back(to);
      });
    }
    level = std::move(next);
  }
}

std::string Addresses::path_to(AnyRef object) const {
  std::vector<Way> ways;
  for (const Place* p = place_of(object); p->from.set(); p = place_of(p->from)) ways.push_back(p->way);
  std::string out;
  for (auto way = ways.rbegin(); way != ways.rend(); ++way) {
    if (!out.empty()) out += '.';
    out += way->attribute->name;
    if (way->item != kNoItem) out += "[" + std::to_string(way->item) + "]";
  }
  return out;
}

std::uint64_t Addresses::order(AnyRef object) const {
  const Place* place = place_of(object);
  return place == nullptr ? 0 : place->order;
}

AnyRef Addresses::executable(AnyRef object) const {
  const Place* place = place_of(object);
  return place != nullptr && m_.holds<model::Executable>(place->base) ? place->base : main_;
}

std::string Addresses::from(AnyRef executable, AnyRef object) const {
  const Place* known = place_of(object);
  if (known == nullptr) throw std::logic_error("an object without an address has no way to it");
  const Place& place = *known;
  const std::string path = path_to(object);
  if (place.base == executable) return path;
  const std::string id = its_id(place.base);
  const auto& same = named_.at({place.base.type, id});
  const auto k = std::find(same.begin(), same.end(), place.base) - same.begin();
  std::string out = "{" + std::string(model::noun_type(place.base.type).keyword) + ":" + escaped(id);
  if (k > 0) out += ":" + std::to_string(k + 1);
  out += "}";
  return path.empty() ? out : out + "." + path;
}

AnyRef Addresses::find(AnyRef executable, std::string_view address) const {
  AnyRef at = executable;
  if (!address.empty() && address.front() == '{') {
    const auto end = address.find('}');
    if (end == std::string_view::npos) return {};
    std::string_view name = address.substr(1, end - 1);
    address.remove_prefix(end + 1);
    if (!address.empty() && address.front() == '.') address.remove_prefix(1);
    const auto colon = name.find(':');
    if (colon == std::string_view::npos) return {};
    const auto type = model::find_noun(name.substr(0, colon));
    name.remove_prefix(colon + 1);
    std::size_t k = 1;
    if (const auto second = name.find(':'); second != std::string_view::npos) {
      std::from_chars(name.data() + second + 1, name.data() + name.size(), k);
      name = name.substr(0, second);
    }
    const auto it = type ? named_.find({*type, unescaped(name)}) : named_.end();
    if (it == named_.end() || k == 0 || k > it->second.size()) return {};
    at = it->second[k - 1];
  }
  while (!address.empty() && at.set()) {
    const auto dot = address.find('.');
    const std::string_view step = address.substr(0, dot);
    address.remove_prefix(dot == std::string_view::npos ? address.size() : dot + 1);
    AnyRef to;
    for_each_way(at, [&](Way way, AnyRef next) {
      const std::string_view name = way.attribute->name;
      if (!step.starts_with(name)) return;
      const std::string_view item = step.substr(name.size());
      if (way.item == kNoItem ? item.empty() : item == "[" + std::to_string(way.item) + "]") to = next;
    });
    at = to;
  }
  return at;
}

}  // namespace capstan::exchange::ap238
