#include "planner/files/exchange/ap238/write/writer.h"

#include <algorithm>
#include <stdexcept>

#include "planner/files/exchange/ap238/codecs/codecs.h"
#include "planner/files/exchange/ap238/read/auxiliary.h"
#include "planner/files/exchange/ap238/records.h"
#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

namespace {

bool is_aggregate(const express::Type* t) {
  while (t != nullptr && t->kind == express::TypeKind::kDefined) t = t->underlying;
  return t != nullptr && t->kind == express::TypeKind::kAggregate;
}

std::pair<std::string_view, std::string_view> qualified(std::string_view attribute) {
  const auto dot = attribute.find('.');
  if (dot == std::string_view::npos) return {{}, attribute};
  return {attribute.substr(0, dot), attribute.substr(dot + 1)};
}

}  // namespace

Writer::Writer(const model::Plan& plan, const Mapping& mapping, std::vector<std::string>& losses)
    : plan_(plan), m_(plan.model), map_(mapping), schema_(express::Dictionary::ap238()), losses_(losses) {
  for (const Row& r : map_.rows()) {
    for (const Step& s : r.steps) prefix_of_text_.emplace(map_.prefix_text(s.prefix), s.prefix);
  }
  for (const AnyRef at : m_.all(TypeId::kKeptInstance)) {
    const auto& kept = m_.at<model::KeptInstance>(at);
    if (kept.schema == model::KeptSchema::kAp238) reserved_.merge(unresolved_numbers(kept));
  }
}

void Writer::run(const std::vector<Unlisted>& unlisted) {
  shared("protocol");
  if (plan_.project) instance_of(plan_.project);
  for (const AnyRef f : m_.all_below(TypeId::kManufacturingFeature)) require(f);
  for (const AnyRef k : plan_.kept) require(k);
  while (!tasks_.empty() || !to_scan_.empty()) {
    tick(8);  // rows of a noun take up to some 50 us
    if (!tasks_.empty()) {
      const Task t = tasks_.front();
      tasks_.pop_front();
      write_rows(t);
      continue;
    }
    const AnyRef at = to_scan_.front();
    to_scan_.pop_front();
    model::for_each_reference(m_, at, [&](AnyRef to) {
      if (to.set()) require(to);
    });
  }
  write_records(*this, unlisted);
  fall_back();
}

// Sets texts that the standard requires and the plan does not have.
void Writer::fall_back() {
  const auto pending = std::move(fallbacks_);
  for (const auto& [at, constraint] : pending) {
    const auto& values = made_of(at).values;
    const auto name = qualified(constraint->attribute).second;
    if (std::any_of(values.begin(), values.end(), [&](const Value& v) { return v.attribute->name == name; }))
      continue;
    Constraint c = *constraint;
    c.fallback = false;
    constrain(at, {c}, 0, {});
  }
}

// --- instances ---

Id Writer::written(AnyRef at) const { return ids_.find(at).value_or(kNoId); }

bool Writer::is_lost(AnyRef at) const { return ids_.find(at) == kNoId; }

bool Writer::is_geometry(AnyRef at) {
  return model::is_a(at.type, TypeId::kRepresentationItem) || at.type == TypeId::kCompositeCurveSegment;
}

void Writer::require(AnyRef at) {
  if (at.type == TypeId::kKeptInstance) {
    const auto* kept = &m_.at<model::KeptInstance>(at);
    if (kept->section != model::KeptSection::kData) return to_scan_.push_back(at);
    if (const auto part = auxiliary_part(*kept)) {
      instance_of(part->first);
      return;
    }
  }
  instance_of(at);
}

void Writer::skip_reserved() {
  while (reserved_.contains(instances_.size() + 1)) instances_.emplace_back();  // printed as nothing
}

Id Writer::add(Made made) {
  skip_reserved();
  instances_.push_back({static_cast<std::uint32_t>(made_.size()), {}});
  made_.push_back(std::move(made));
  return static_cast<Id>(instances_.size());
}

Id Writer::add_as_it_is(AnyRef noun) {
  skip_reserved();
  instances_.push_back({kAsItIs, noun});
  return static_cast<Id>(instances_.size());
}

Writer::Made& Writer::made_of(Id at) {
  Instance& i = instances_[at - 1];
  if (i.made == kAsItIs) {
    i.made = static_cast<std::uint32_t>(made_.size());
    made_.push_back({.leaves = {}, .noun = i.noun, .name = {}, .values = {}});
  }
  return made_[i.made];
}

Id Writer::make(std::vector<EntityId> leaves) {
  return add({.leaves = std::move(leaves), .noun = {}, .name = {}, .values = {}});
}

Id Writer::make(std::string_view entity) {
  std::vector<EntityId> leaves;
  while (!entity.empty()) {
    const auto n = entity.find('&');
    leaves.push_back(schema_.find(entity.substr(0, n)));
    if (leaves.back() == express::kNoEntity) throw std::logic_error("no entity " + std::string(entity));
    entity.remove_prefix(n == std::string_view::npos ? entity.size() : n + 1);
  }
  return make(std::move(leaves));
}

void Writer::become(Id at, std::string_view entity) {
  const EntityId e = schema_.find(entity);
  if (e == express::kNoEntity) throw std::logic_error("no entity " + std::string(entity));
  if (instances_[at - 1].made == kAsItIs) return;
  auto& leaves = made_of(at).leaves;
  if (leaves.empty()) return;  // kept, or geometry: written as it is
  if (std::any_of(leaves.begin(), leaves.end(), [&](EntityId l) { return schema_.is_a(l, e); })) return;
  std::erase_if(leaves, [&](EntityId l) { return schema_.is_a(e, l); });
  leaves.push_back(e);
}

void Writer::turn_into(Id at, std::string_view entity) {
  const EntityId e = schema_.find(entity);
  if (e == express::kNoEntity) throw std::logic_error("no entity " + std::string(entity));
  if (instances_[at - 1].made == kAsItIs) return;
  if (auto& leaves = made_of(at).leaves; !leaves.empty()) leaves = {e};
}

std::string Writer::quoted(std::string_view text) { return p21::quoted(text); }

const ObjectRow* Writer::object_row(AnyRef at) const {
  const auto leads_to = [&](const std::vector<std::string>& path) {
    AnyRef holder = at;
    for (const auto& name : path) {
      const Attribute* a = holder.set() ? model::find_attribute(holder.type, name) : nullptr;
      if (a == nullptr || a->storage != Storage::kRef) return AnyRef{};
      holder = model::value_of<AnyRef>(*a, m_.object(holder));
    }
    return holder;
  };
  const auto given = [&](const std::vector<std::string>& path) {
    const AnyRef holder = leads_to({path.begin(), path.end() - 1});
    const Attribute* a = holder.set() ? model::find_attribute(holder.type, path.back()) : nullptr;
    return a != nullptr && model::has_value(*a, m_.object(holder));
  };
  for (const std::uint32_t r : map_.objects_of(at.type)) {
    const ObjectRow& row = map_.objects()[r];
    const bool with = std::all_of(row.with.begin(), row.with.end(),
                                  [&](const auto& w) { return leads_to(w.first).type == w.second; });
    const bool when = std::all_of(row.when.begin(), row.when.end(), [&](const auto& w) {
      const AnyRef there = leads_to(w.first);
      return there.set() && model::is_a(there.type, w.second);
    });
    if (with && when && (row.unless.empty() || !given(row.unless))) return &row;
  }
  return nullptr;
}

Id Writer::instance_of(AnyRef at) {
  if (const auto known = ids_.find(at)) return *known;
  if (const auto* kept = at.type == TypeId::kKeptInstance ? &m_.at<model::KeptInstance>(at) : nullptr;
      kept != nullptr && kept->schema != model::KeptSchema::kAp238 && kept->keyword.rfind('!', 0) != 0) {
    lose(kept->keyword + ", kept from ISO 14649,");
    ids_.set(at, kNoId);
    return kNoId;
  }
  const Geometry& geometry = geometry_of(at.type);
  if (geometry.plain && geometry.entity == express::kNoEntity) {
    lose(std::string(model::noun_type(at.type).keyword));  // a helix that no toolpath runs along
    ids_.set(at, kNoId);
    return kNoId;
  }
  // BLOCK and the like are geometry that AP238 has as representations.
  if (at.type == TypeId::kKeptInstance || geometry.plain) {
    const Id id = add_as_it_is(at);
    ids_.set(at, id);
    if (at.type == TypeId::kKeptInstance || geometry.refers) to_scan_.push_back(at);
    return id;
  }
  const ObjectRow* row = object_row(at);
  if (row == nullptr) {
    lose(std::string(model::noun_type(at.type).keyword));
    ids_.set(at, kNoId);
    return kNoId;
  }
  const Id id = make(row->root.entities);
  ids_.set(at, id);
  begin(at, *row, id, 0);
  return id;
}

void Writer::begin(AnyRef at, const ObjectRow& row, Id id, std::uint32_t copy) {
  for (const Constraint& c : row.root.constraints) {
    if ((c.attribute == "description" || c.attribute == "action_method.description") && !c.texts.empty())
      descriptions_[at] = c.texts.front();
  }
  constrain(id, row.root.constraints, 0, at);
  tasks_.push_back({at, id, copy});
}

// Whether an attribute that holds one reference holds another one already.
bool Writer::is_taken(Id at, std::string_view attribute, Id by) const {
  const auto [owner, bare] = qualified(attribute);
  const EntityId wanted = owner.empty() ? express::kNoEntity : schema_.find(owner);
  if (instances_[at - 1].made == kAsItIs) return false;
  const auto& values = made_[instances_[at - 1].made].values;
  return std::any_of(values.begin(), values.end(), [&, name = bare](const Value& v) {
    return v.attribute->name == name && (wanted == express::kNoEntity || v.attribute->owner == wanted) &&
           !v.aggregate && !v.items.empty() && v.items.front().rfind('#', 0) == 0 &&
           v.items.front() != "#" + std::to_string(by);
  });
}

// Another instance of an object: where it says itself whose it is, and is two objects' at once.
Id Writer::copy_of(AnyRef at) {
  const ObjectRow* row = at.type == TypeId::kKeptInstance ? nullptr : object_row(at);
  if (row == nullptr) {
    lose("another use of the same " + std::string(model::noun_type(at.type).keyword));
    return kNoId;
  }
  const Id id = make(row->root.entities);
  begin(at, *row, id, ++copies_);
  return id;
}

Id Writer::instance_named(AnyRef at, const std::string& name) {
  if (!is_geometry(at) || name.empty()) return instance_of(at);
  if (schema_.find(model::noun_type(at.type).keyword) == express::kNoEntity) return instance_of(at);
  const auto [it, added] = named_.emplace(std::pair(at, name), kNoId);
  if (!added) return it->second;
  it->second = add({.leaves = {}, .noun = at, .name = name, .values = {}});
  to_scan_.push_back(at);
  return it->second;
}

Id Writer::shared(std::string_view name) {
  const auto it = shared_.find(name);
  if (it != shared_.end()) return it->second;
  const SharedRow* row = map_.shared(name);
  if (row == nullptr) throw std::logic_error("mapping tables: nothing is shared as @" + std::string(name));
  const Id id = make(row->root.entities);
  shared_.emplace(name, id);
  constrain(id, row->root.constraints, 0, {});
  return id;
}

// Spellings may name shared instances: (@mm,@radian).
std::string Writer::resolved(const std::string& spelling) {
  std::string out;
  bool quote = false;
  for (std::size_t i = 0; i < spelling.size(); ++i) {
    if (spelling[i] == '\'') quote = !quote;
    if (quote || spelling[i] != '@') {
      out += spelling[i];
      continue;
    }
    std::size_t end = i + 1;
    while (end < spelling.size() &&
           (std::isalnum(static_cast<unsigned char>(spelling[end])) != 0 || spelling[end] == '_'))
      ++end;
    out += "#" + std::to_string(shared(std::string_view(spelling).substr(i + 1, end - i - 1)));
    i = end - 1;
  }
  return out;
}

void Writer::constrain(Id at, const std::vector<Constraint>& constraints, std::uint32_t ordinal,
                       AnyRef owner) {
  for (const Constraint& c : constraints) {
    if (c.negated) continue;
    if (c.fallback) {
      fallbacks_.emplace_back(at, &c);
      continue;
    }
    switch (c.kind) {
      case Constraint::Kind::kPlain:
        set(at, c.attribute, resolved(c.texts.front()));
        break;
      case Constraint::Kind::kShared:
        set(at, c.attribute, "#" + std::to_string(shared(c.texts.front())));
        break;
      case Constraint::Kind::kOrdinal:
        set(at, c.attribute, std::to_string(ordinal) + ".");
        break;
      case Constraint::Kind::kDescription: {
        const auto d = descriptions_.find(owner);
        set(at, c.attribute, d == descriptions_.end() ? "''" : d->second);
        break;
      }
    }
  }
}

void Writer::set(Id at, std::string_view attribute, std::string spelling) {
  Made& made = made_of(at);
  const auto [owner, bare] = qualified(attribute);
  const EntityId wanted = owner.empty() ? express::kNoEntity : schema_.find(owner);
  for (const EntityId leaf : made.leaves) {
    for (const express::Slot& s : schema_.slots(leaf)) {
      if (s.attribute->name != bare || (wanted != express::kNoEntity && s.attribute->owner != wanted))
        continue;
      for (Value& v : made.values) {
        if (v.attribute != s.attribute) continue;
        if (!v.aggregate) v.items.clear();
        v.items.push_back(std::move(spelling));
        return;
      }
      made.values.push_back(
          {.attribute = s.attribute,
           .aggregate = is_aggregate(s.type) && (spelling.empty() || spelling.front() != '('),
           .wrapper = {},
           .items = {std::move(spelling)}});
      return;
    }
  }
  throw std::logic_error("mapping tables: " + std::string(schema_.keyword(made.leaves.front())) +
                         " has no attribute " + std::string(attribute));
}

Id Writer::walk(const Row& row, AnyRef owner, Id root, std::size_t leave, std::uint32_t ordinal) {
  Id at = root;
  std::uint32_t element = 0;
  for (std::size_t k = 0; k + leave < row.steps.size(); ++k) {
    const Step& s = row.steps[k];
    if (s.fan) element = ordinal;
    const MemoKey key{owner, s.prefix, element, copy_};
    const auto it = memo_.find(key);
    if (it != memo_.end()) {
      at = it->second;
      continue;
    }
    if (s.entities.empty()) throw std::logic_error(row.place + ": nothing to make at '" + s.attribute + "'");
    const Id next = make(s.entities);
    memo_.emplace(key, next);
    connect(s, at, next, element, owner);
    constrain(next, s.constraints, element, owner);
    at = next;
  }
  return at;
}

void Writer::connect(const Step& s, Id from, Id to, std::uint32_t, AnyRef) {
  if (s.inverse) {
    set(to, s.attribute, "#" + std::to_string(from));
    return;
  }
  set(from, s.attribute, "#" + std::to_string(to));
  if (s.wrapper.empty()) return;
  for (Value& v : made_of(from).values) {
    if (v.attribute->name == s.attribute) {
      v.wrapper = s.wrapper;
      v.aggregate = true;
    }
  }
}

}  // namespace capstan::exchange::ap238
