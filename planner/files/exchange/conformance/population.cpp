#include "planner/files/exchange/conformance/population.h"

#include <algorithm>
#include <utility>

namespace capstan::exchange::conformance {

using express::EntityId;
using express::kNoEntity;

namespace {

std::string joined(const std::vector<std::string_view>& names) {
  std::string out;
  for (const auto name : names) {
    if (!out.empty()) out += ", ";
    out += name;
  }
  return out;
}

}  // namespace

Population::Population(const p21::File& file, const express::Dictionary& dictionary)
    : file_(file), dictionary_(dictionary), of_entity_(dictionary.size(), kNone) {
  layout_of_.reserve(file.size());
  for (const p21::Instance i : file) layout_of_.push_back(i.is_complex() ? complex(i) : simple(i));
}

std::uint32_t Population::simple(const p21::Instance& i) {
  if (i.user_defined()) return kNone;
  const std::string_view keyword = i.keyword();
  const EntityId entity = dictionary_.find(keyword);
  if (entity != kNoEntity) {
    std::uint32_t& at = of_entity_[static_cast<std::size_t>(entity)];
    if (at != kNone) return at;
    at = static_cast<std::uint32_t>(layouts_.size());
    Layout& layout = layouts_.emplace_back();
    const auto slots = dictionary_.slots(entity);
    layout.parts.push_back(entity);
    layout.slots.emplace_back(slots.begin(), slots.end());
    layout.known.push_back(true);
    if (dictionary_.abstract(entity))
      layout.faults.push_back({"SCH-COMPLEX",
                               std::string(keyword) + " is abstract and cannot be instantiated alone",
                               {},
                               "an instance of one of its subtypes"});
    return at;
  }
  const auto [found, fresh] =
      of_key_.try_emplace(std::string(keyword), static_cast<std::uint32_t>(layouts_.size()));
  if (fresh) {
    Layout& layout = layouts_.emplace_back();
    layout.slots.emplace_back();
    layout.known.push_back(false);
    layout.faults.push_back({"SCH-ENTITY", std::string(keyword) + " is not an entity of the schema"});
  }
  return found->second;
}

std::uint32_t Population::complex(const p21::Instance& i) {
  std::string key = "(";
  for (std::size_t p = 0; p < i.part_count(); ++p) key.append(i.part(p).keyword).push_back(',');
  const auto [found, fresh] =
      of_key_.try_emplace(std::move(key), static_cast<std::uint32_t>(layouts_.size()));
  if (fresh) {
    Layout& layout = layouts_.emplace_back();
    layout.complex = true;
    judge(i, layout);
  }
  return found->second;
}

// Which parts there are, which should be, and in which order.
void Population::judge(const p21::Instance& i, Layout& layout) const {
  std::string_view before;
  bool sorted = true;
  std::vector<EntityId> entities;  // of each part
  for (std::size_t p = 0; p < i.part_count(); ++p) {
    const std::string_view keyword = i.part(p).keyword;
    const EntityId e = dictionary_.find(keyword);
    entities.push_back(e);
    layout.known.push_back(e != kNoEntity);
    if (p > 0 && keyword < before) sorted = false;
    before = keyword;
    const bool user_defined = !keyword.empty() && keyword.front() == '!';
    if (e == kNoEntity) {
      if (!user_defined)
        layout.faults.push_back({"SCH-ENTITY", std::string(keyword) + " is not an entity of the schema"});
      continue;
    }
    if (std::find(layout.parts.begin(), layout.parts.end(), e) != layout.parts.end())
      layout.faults.push_back({"SCH-COMPLEX", "the part " + std::string(keyword) + " is there twice"});
    else
      layout.parts.push_back(e);
  }
  if (!sorted)
    layout.faults.push_back(
        {"SCH-COMPLEX", "the parts of the complex instance are not in alphabetical order"});

  std::vector<std::string_view> missing;
  for (const EntityId e : dictionary_.closure(layout.parts)) {
    if (std::find(layout.parts.begin(), layout.parts.end(), e) == layout.parts.end())
      missing.push_back(dictionary_.keyword(e));
  }
  if (!missing.empty())
    layout.faults.push_back(
        {"SCH-COMPLEX", "the complex instance lacks supertypes of its parts", {}, joined(missing)});
  for (const EntityId e : layout.parts) {
    const bool leaf = std::none_of(layout.parts.begin(), layout.parts.end(),
                                   [&](EntityId other) { return other != e && dictionary_.is_a(other, e); });
    if (leaf && dictionary_.abstract(e))
      layout.faults.push_back(
          {"SCH-COMPLEX",
           "the part " + std::string(dictionary_.keyword(e)) + " is abstract, and no subtype of it is there",
           {},
           "one of its subtypes"});
  }
  for (const EntityId e : layout.parts) {
    for (const auto& group : dictionary_.exclusive(e)) {
      std::vector<std::string_view> there;
      for (const EntityId member : group) {
        if (std::find(layout.parts.begin(), layout.parts.end(), member) != layout.parts.end())
          there.push_back(dictionary_.keyword(member));
      }
      if (there.size() > 1)
        layout.faults.push_back(
            {"SCH-COMPLEX", "the parts " + joined(there) + " exclude each other", {}, "one of them"});
    }
  }
  for (const EntityId e : entities) {
    if (e == kNoEntity)
      layout.slots.emplace_back();
    else
      layout.slots.push_back(dictionary_.part_slots(e, layout.parts));
  }
}

bool Population::admits(const express::Type& type, const Layout& layout) const {
  return std::any_of(layout.parts.begin(), layout.parts.end(),
                     [&](EntityId e) { return dictionary_.admits(type, e); });
}

bool Population::is_a(const Layout& layout, EntityId entity) const {
  return std::any_of(layout.parts.begin(), layout.parts.end(),
                     [&](EntityId e) { return dictionary_.is_a(e, entity); });
}

}  // namespace capstan::exchange::conformance
