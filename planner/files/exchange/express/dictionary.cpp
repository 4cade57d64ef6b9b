#include "planner/files/exchange/express/dictionary.h"

#include <algorithm>

#include "planner/files/exchange/common/embedded.h"
#include "planner/files/exchange/express/tables.h"

namespace capstan::exchange::express {
namespace {

std::size_t index(EntityId e) { return static_cast<std::size_t>(e); }

// The type behind its names.
const Type& behind(const Type& type) {
  const Type* t = &type;
  while (t->kind == TypeKind::kDefined) t = t->underlying;
  return *t;
}

Slot slot_of(const Attribute& a) { return {&a, a.name, a.type, a.optional, false}; }

}  // namespace

const Dictionary& Dictionary::ap238() {
  static const Dictionary dictionary(embedded_file("express/ap238.table"));
  return dictionary;
}

Dictionary::Dictionary(std::string_view table) : tables_(Tables::load(table).release()) {}
Dictionary::~Dictionary() { delete tables_; }

std::size_t Dictionary::size() const { return tables_->entities.size(); }

EntityId Dictionary::find(std::string_view keyword) const {
  const std::uint32_t found = tables_->names.find(keyword);
  return found < tables_->entities.size() ? EntityId{static_cast<std::uint16_t>(found)} : kNoEntity;
}

const Type* Dictionary::find_type(std::string_view name) const {
  const std::uint32_t found = tables_->names.find(name);
  if (found == Names::kNone || found < tables_->entities.size()) return nullptr;
  return tables_->named[found];
}

std::string_view Dictionary::keyword(EntityId e) const { return tables_->entities.at(index(e)).keyword; }
bool Dictionary::abstract(EntityId e) const { return tables_->entities.at(index(e)).abstract; }

bool Dictionary::is_a(EntityId e, EntityId ancestor) const {
  const std::size_t i = index(e), j = index(ancestor);
  if (i >= size() || j >= size()) return false;
  return (tables_->ancestors[i * tables_->row + j / 64] >> (j % 64) & 1U) != 0;
}

bool Dictionary::admits(const Type& type, EntityId e) const {
  const Type& t = behind(type);
  const std::size_t i = index(e);
  if (i >= size() || t.admitted.empty()) return false;
  return (t.admitted[i / 64] >> (i % 64) & 1U) != 0;
}

std::span<const std::vector<EntityId>> Dictionary::exclusive(EntityId e) const {
  return tables_->entities.at(index(e)).exclusive;
}

std::vector<EntityId> Dictionary::closure(std::span<const EntityId> leaves) const {
  std::vector<EntityId> out;
  for (const EntityId leaf : leaves) {
    const auto& all = tables_->entities.at(index(leaf)).ancestors_first;
    out.insert(out.end(), all.begin(), all.end());
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::span<const Attribute> Dictionary::own(EntityId e) const { return tables_->entities.at(index(e)).own; }
std::span<const Slot> Dictionary::slots(EntityId e) const { return tables_->entities.at(index(e)).slots; }

std::vector<Slot> Dictionary::part_slots(EntityId part, std::span<const EntityId> parts) const {
  std::vector<Slot> out;
  for (const Attribute& a : own(part)) out.push_back(slot_of(a));
  // A deeper entity has the last word.
  std::vector<EntityId> order(parts.begin(), parts.end());
  std::stable_sort(order.begin(), order.end(), [this](EntityId a, EntityId b) {
    return tables_->entities.at(index(a)).ancestors_first.size() <
           tables_->entities.at(index(b)).ancestors_first.size();
  });
  for (const EntityId e : order) redeclare(tables_->entities.at(index(e)), out);
  return out;
}

std::optional<std::size_t> Dictionary::position(EntityId e, std::string_view attribute) const {
  EntityId owner = kNoEntity;
  if (const auto dot = attribute.find('.'); dot != std::string_view::npos) {
    owner = find(attribute.substr(0, dot));
    if (owner == kNoEntity) return std::nullopt;
    attribute.remove_prefix(dot + 1);
  }
  const auto all = slots(e);
  for (std::size_t i = 0; i < all.size(); ++i) {
    const bool named = all[i].name == attribute || all[i].attribute->name == attribute;
    if (named && (owner == kNoEntity || is_a(owner, all[i].attribute->owner))) return i;
  }
  return std::nullopt;
}

EntityId Dictionary::owner(EntityId e, std::string_view attribute) const {
  const auto i = position(e, attribute);
  return i ? slots(e)[*i].attribute->owner : kNoEntity;
}

}  // namespace capstan::exchange::express
