#include "planner/exchange/ap238/writer.h"

#include <algorithm>
#include <stdexcept>

#include "planner/base/number.h"
#include "planner/exchange/ap238/auxiliary.h"
#include "planner/exchange/ap238/codecs.h"
#include "planner/exchange/ap238/records.h"
#include "planner/exchange/sections.h"
#include "planner/model/nouns/all.h"
#include "planner/model/walk.h"
#include "planner/p21/print.h"

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

// The name a step demands, as spelled; empty when it demands none.
std::string demanded_name(const Step& s) {
  for (const Constraint& c : s.constraints) {
    if ((c.attribute == "name" || c.attribute == "representation_item.name") && !c.texts.empty() && !c.negated) {
      return c.texts.front();
    }
  }
  return {};
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

std::string Writer::run() {
  shared("protocol");
  if (plan_.project) instance_of(plan_.project);
  for (const AnyRef f : m_.all_below(TypeId::kManufacturingFeature)) require(f);
  for (const AnyRef k : plan_.kept) require(k);
  while (!tasks_.empty() || !to_scan_.empty()) {
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
  write_records(*this);
  fall_back();
  std::string out;
  for (Id id = 1; id <= made_.size(); ++id) {
    if (!reserved_.contains(id)) print(id, made_[id - 1], out);
  }
  for (const auto& [what, n] : lost_) {
    losses_.push_back(what + " has no place in AP238 (" + std::to_string(n) + " left out)");
  }
  return out;
}

// What the standard wants said where the plan says nothing.
void Writer::fall_back() {
  const auto pending = std::move(fallbacks_);
  for (const auto& [at, constraint] : pending) {
    const auto& values = made_[at - 1].values;
    const auto name = qualified(constraint->attribute).second;
    if (std::any_of(values.begin(), values.end(), [&](const Value& v) { return v.attribute->name == name; })) continue;
    Constraint c = *constraint;
    c.fallback = false;
    constrain(at, {c}, 0, {});
  }
}

// --- instances ---

Id Writer::written(AnyRef at) const {
  const auto it = ids_.find(at);
  return it == ids_.end() ? kNoId : it->second;
}

bool Writer::is_lost(AnyRef at) const {
  const auto it = ids_.find(at);
  return it != ids_.end() && it->second == kNoId;
}

bool Writer::is_geometry(AnyRef at) {
  return model::is_a(at.type, TypeId::kRepresentationItem) || at.type == TypeId::kCompositeCurveSegment;
}

void Writer::require(AnyRef at) {
  if (const auto* kept = m_.get<model::KeptInstance>(at)) {
    if (kept->section != model::KeptSection::kData) return to_scan_.push_back(at);
    if (const auto part = auxiliary_part(*kept)) {
      instance_of(part->first);
      return;
    }
  }
  instance_of(at);
}

Id Writer::add(Made made) {
  while (reserved_.contains(made_.size() + 1)) made_.emplace_back();  // printed as nothing
  made_.push_back(std::move(made));
  return static_cast<Id>(made_.size());
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
  auto& leaves = made_[at - 1].leaves;
  if (leaves.empty()) return;  // kept, or geometry: written as it is
  if (std::any_of(leaves.begin(), leaves.end(), [&](EntityId l) { return schema_.is_a(l, e); })) return;
  std::erase_if(leaves, [&](EntityId l) { return schema_.is_a(e, l); });
  leaves.push_back(e);
}

void Writer::turn_into(Id at, std::string_view entity) {
  const EntityId e = schema_.find(entity);
  if (e == express::kNoEntity) throw std::logic_error("no entity " + std::string(entity));
  if (!made_[at - 1].leaves.empty()) made_[at - 1].leaves = {e};
}

std::string Writer::quoted(std::string_view text) { return "'" + p21::encode_text(text) + "'"; }

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
  const auto it = ids_.find(at);
  if (it != ids_.end()) return it->second;
  if (const auto* kept = m_.get<model::KeptInstance>(at);
      kept != nullptr && kept->schema != model::KeptSchema::kAp238 && kept->keyword.rfind('!', 0) != 0) {
    lose(kept->keyword + ", kept from ISO 14649,");
    ids_.emplace(at, kNoId);
    return kNoId;
  }
  if (is_geometry(at) && map_.objects_of(at.type).empty() &&
      schema_.find(model::noun_type(at.type).keyword) == express::kNoEntity) {
    lose(std::string(model::noun_type(at.type).keyword));  // a helix that no toolpath runs along
    ids_.emplace(at, kNoId);
    return kNoId;
  }
  // BLOCK and the like are geometry that AP238 has as representations.
  if (at.type == TypeId::kKeptInstance || (is_geometry(at) && map_.objects_of(at.type).empty())) {
    const Id id = add({.leaves = {}, .noun = at, .name = {}, .values = {}});
    ids_.emplace(at, id);
    to_scan_.push_back(at);
    return id;
  }
  const ObjectRow* row = object_row(at);
  if (row == nullptr) {
    lose(std::string(model::noun_type(at.type).keyword));
    ids_.emplace(at, kNoId);
    return kNoId;
  }
  const Id id = make(row->root.entities);
  ids_.emplace(at, id);
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
  return std::any_of(made_[at - 1].values.begin(), made_[at - 1].values.end(), [&](const Value& v) {
    return v.attribute->name == bare && (wanted == express::kNoEntity || v.attribute->owner == wanted) &&
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
    while (end < spelling.size() && (std::isalnum(static_cast<unsigned char>(spelling[end])) != 0 || spelling[end] == '_')) ++end;
    out += "#" + std::to_string(shared(std::string_view(spelling).substr(i + 1, end - i - 1)));
    i = end - 1;
  }
  return out;
}

void Writer::constrain(Id at, const std::vector<Constraint>& constraints, std::uint32_t ordinal, AnyRef owner) {
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
  Made& made = made_[at - 1];
  const auto [owner, bare] = qualified(attribute);
  const EntityId wanted = owner.empty() ? express::kNoEntity : schema_.find(owner);
  for (const EntityId leaf : made.leaves) {
    for (const express::Slot& s : schema_.slots(leaf)) {
      if (s.attribute->name != bare || (wanted != express::kNoEntity && s.attribute->owner != wanted)) continue;
      for (Value& v : made.values) {
        if (v.attribute != s.attribute) continue;
        if (!v.aggregate) v.items.clear();
        v.items.push_back(std::move(spelling));
        return;
      }
      made.values.push_back({.attribute = s.attribute,
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
  for (Value& v : made_[from - 1].values) {
    if (v.attribute->name == s.attribute) {
      v.wrapper = s.wrapper;
      v.aggregate = true;
    }
  }
}

// --- leaves ---

Id Writer::unit(model::Unit u) {
  static constexpr std::string_view kNames[] = {"count",        "mm",    "radian",      "mm_per_minute",
                                                "per_minute",   "second", "ratio",      "newton_per_mm2",
                                                "cubic_mm",     "watt",  "newton_metre"};
  return shared(kNames[static_cast<std::size_t>(u)]);
}

Id Writer::measure(double value, model::Unit u, std::string_view name, std::span<const EntityId> entities) {
  struct Form {
    model::Unit unit;
    std::string_view type, entity;
  };
  static constexpr Form kForms[] = {
      {model::Unit::kLength, "LENGTH_MEASURE", "length_measure_with_unit&measure_representation_item"},
      {model::Unit::kAngle, "PLANE_ANGLE_MEASURE", "plane_angle_measure_with_unit&measure_representation_item"},
      {model::Unit::kTime, "TIME_MEASURE", "time_measure_with_unit&measure_representation_item"},
      {model::Unit::kRatio, "RATIO_MEASURE", "ratio_measure_with_unit&measure_representation_item"},
      {model::Unit::kNone, "COUNT_MEASURE", "measure_representation_item"}};
  std::string_view type = "NUMERIC_MEASURE", entity = "measure_representation_item";
  for (const Form& f : kForms) {
    if (f.unit == u) {
      type = f.type;
      entity = f.entity;
    }
  }
  (void)entities;
  const Id id = make(entity);
  set(id, "value_component", std::string(type) + "(" + part21_real(value) + ")");
  link(id, "unit_component", unit(u));
  set(id, "representation_item.name", name.empty() ? "''" : std::string(name));
  return id;
}

Id Writer::description(std::string_view name, std::string_view text) {
  const Id id = make("descriptive_representation_item");
  set(id, "representation_item.name", name.empty() ? "''" : std::string(name));
  set(id, "description", quoted(text));
  return id;
}

// --- rows ---

void Writer::write_rows(const Task& t) {
  copy_ = t.copy;
  std::vector<std::string> written;
  for (const Row* row : map_.rows_of(t.at.type)) {
    if (!row->written) continue;
    if (row->attribute.empty()) {
      walk(*row, t.at, t.root, 0, 0);
      continue;
    }
    AnyRef holder = t.at;
    const Attribute* a = nullptr;
    for (std::size_t i = 0; i < row->attribute.size(); ++i) {
      a = holder.set() ? model::find_attribute(holder.type, row->attribute[i]) : nullptr;
      if (a == nullptr) break;
      if (i + 1 == row->attribute.size()) break;
      holder = model::value_of<AnyRef>(*a, m_.object(holder));
      if (row->only[i] != TypeId::kNone && holder.set() && !model::is_a(holder.type, row->only[i])) holder = {};
    }
    if (a == nullptr || !holder.set() || !model::has_value(*a, m_.object(holder))) continue;
    if (const Attribute* other = row->unless.empty() ? nullptr : model::find_attribute(holder.type, row->unless);
        other != nullptr && model::has_value(*other, m_.object(holder))) {
      continue;
    }
    std::string dotted;
    for (const auto& part : row->attribute) dotted += (dotted.empty() ? "" : ".") + part;
    if (row->when.empty() && std::find(written.begin(), written.end(), dotted) != written.end()) continue;
    written.push_back(dotted);
    write_value(*row, t.at, *a, m_.object(holder), t.root);
  }
  copy_ = 0;
  if (t.copy == 0) note_unmapped(t.at, object_row(t.at));
}

void Writer::note_unmapped(AnyRef at, const ObjectRow* object) {
  const auto mapped = [&](const std::string& dotted, bool whole) {
    for (const Row* row : map_.rows_of(at.type)) {
      std::string d;
      for (const auto& part : row->attribute) d += (d.empty() ? "" : ".") + part;
      if (row->written && (d == dotted || (!whole && d.rfind(dotted + ".", 0) == 0))) return true;
    }
    return false;
  };
  const auto look = [&](AnyRef holder, const std::string& prefix) {
    for (const Attribute& a : model::noun_type(holder.type).attributes) {
      if (a.storage == Storage::kPath || !model::has_value(a, m_.object(holder))) continue;
      if (a.name == "persistent_id") continue;  // goes with the records of the plan
      const std::string dotted = prefix + std::string(a.name);
      const bool inner = object != nullptr && std::any_of(object->with.begin(), object->with.end(), [&](const auto& w) {
                           std::string d;
                           for (const auto& part : w.first) d += (d.empty() ? "" : ".") + part;
                           return d == dotted;
                         });
      // Rows for what is inside say nothing of an object that was kept as it is.
      const bool kept = a.storage == Storage::kRef && model::value_of<AnyRef>(a, m_.object(holder)).type == TypeId::kKeptInstance;
      if (!inner && !mapped(dotted, kept)) lose(std::string(model::noun_type(holder.type).keyword) + "." + std::string(a.name));
    }
  };
  look(at, "");
  for (const auto& [path, type] : object == nullptr ? std::vector<std::pair<std::vector<std::string>, TypeId>>{} : object->with) {
    AnyRef holder = at;
    std::string prefix;
    for (const auto& name : path) {
      const Attribute* a = model::find_attribute(holder.type, name);
      holder = a == nullptr ? AnyRef{} : model::value_of<AnyRef>(*a, m_.object(holder));
      prefix += name + ".";
      if (!holder.set()) break;
    }
    if (holder.set()) look(holder, prefix);
  }
}

void Writer::write_text(const Row& row, AnyRef owner, Id root, std::uint32_t ordinal, const std::string& text) {
  if (!row.value_of.empty()) {
    const bool enumerator = text.size() > 2 && text.front() == '.' && text.back() == '.' && !row.texts.empty();
    set(walk(row, owner, root, 0, ordinal), row.value_of, enumerator ? text : quoted(text));
    return;
  }
  write_leaf(row, owner, root, ordinal, description(demanded_name(row.steps.back()), text));
}

void Writer::write_leaf(const Row& row, AnyRef owner, Id root, std::uint32_t ordinal, Id leaf) {
  const Id from = walk(row, owner, root, 1, ordinal);
  const Step& last = row.steps.back();
  connect(last, from, leaf, ordinal, owner);
  if (last.fan || !last.constraints.empty()) {
    std::vector<Constraint> others;
    for (const Constraint& c : last.constraints) {
      if (c.attribute != "name" && c.attribute != "representation_item.name") others.push_back(c);
    }
    constrain(leaf, others, ordinal, owner);
  }
  memo_.emplace(MemoKey{owner, last.prefix, ordinal, copy_}, leaf);
}

void Writer::write_measure(const Row& row, AnyRef owner, Id root, std::uint32_t ordinal, double v, model::Unit u) {
  if (!row.value_of.empty()) {
    set(walk(row, owner, root, 0, ordinal), row.value_of, part21_real(v));
    return;
  }
  write_leaf(row, owner, root, ordinal, measure(v, u, demanded_name(row.steps.back()), row.steps.back().entities));
}

void Writer::write_reference(const Row& row, AnyRef owner, AnyRef to, Id root, std::uint32_t ordinal) {
  if (!to.set()) return;
  if (!row.when.empty()) {
    const auto want = model::find_noun(row.when);
    if (want && !model::is_a(to.type, *want)) return;
  }
  const Step& last = row.steps.back();
  Id target = instance_named(to, demanded_name(last));
  if (target == kNoId) return;
  if (last.inverse && to.type == TypeId::kKeptInstance) return;  // says it itself
  const Id from = walk(row, owner, root, 1, ordinal);
  if (last.inverse && is_geometry(to)) return;
  if (last.inverse && is_taken(target, last.attribute, from)) target = copy_of(to);
  if (target == kNoId) return;
  connect(last, from, target, ordinal, owner);
  if (ordinal == 0) memo_.emplace(MemoKey{owner, last.prefix, 0, copy_}, target);  // rows may lead on from there
}

void Writer::write_value(const Row& row, AnyRef owner, const Attribute& a, const void* data, Id root) {
  if (!row.codec.empty()) {
    const Codec* codec = find_codec(row.codec);
    if (codec == nullptr) throw std::logic_error(row.place + ": no codec " + row.codec);
    codec->write(*this, row, owner, a, data, root);
    return;
  }
  const auto each = [&](const auto& items, const auto& write) {
    for (std::size_t i = 0; i < items.size(); ++i) write(items[i], static_cast<std::uint32_t>(i + 1));
  };
  const auto select = [&](const model::SelectValue& v, std::uint32_t i) {
    const bool fits = row.when.empty() || (row.when == "text" && !v.text.empty()) || (row.when == "real" && v.real) ||
                      (v.ref.set() && row.when != "text" && row.when != "real");
    if (!fits) return;
    if (v.ref.set()) {
      if (row.when == "ref") {
        Row any = row;
        any.when.clear();
        return write_reference(any, owner, v.ref, root, i);
      }
      return write_reference(row, owner, v.ref, root, i);
    }
    if (v.real) return write_measure(row, owner, root, i, *v.real, a.unit == model::Unit::kNone ? model::Unit::kRatio : a.unit);
    std::string s = v.text;
    for (char& c : s) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
    write_text(row, owner, root, i, s);
  };
  switch (a.storage) {
    case Storage::kReal:
      return write_measure(row, owner, root, 0, *model::value_of<model::Real>(a, data), a.unit);
    case Storage::kInteger:
      if (!row.value_of.empty()) {
        return set(walk(row, owner, root, 0, 0), row.value_of, std::to_string(*model::value_of<model::Integer>(a, data)));
      }
      return write_measure(row, owner, root, 0, static_cast<double>(*model::value_of<model::Integer>(a, data)),
                           model::Unit::kNone);
    case Storage::kText:
      return write_text(row, owner, root, 0, *model::value_of<model::Text>(a, data));
    case Storage::kBoolean: {
      const bool v = *model::value_of<model::Boolean>(a, data);
      if (row.texts.empty() && !row.value_of.empty()) {
        return set(walk(row, owner, root, 0, 0), row.value_of, v ? ".T." : ".F.");
      }
      if (row.texts.size() < 2) throw std::logic_error(row.place + ": texts for true and false are missing");
      return write_text(row, owner, root, 0, row.texts[v ? 0 : 1]);
    }
    case Storage::kEnum: {
      const auto code = static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code);
      if (code >= row.texts.size()) throw std::logic_error(row.place + ": a text for each enumerator is missing");
      return write_text(row, owner, root, 0, row.texts[code]);
    }
    case Storage::kRef:
      return write_reference(row, owner, model::value_of<AnyRef>(a, data), root, 0);
    case Storage::kSelect:
      return select(model::value_of<model::SelectValue>(a, data), 0);
    case Storage::kRefList:
      return each(model::value_of<model::AnyRefList>(a, data).items,
                  [&](AnyRef to, std::uint32_t i) { write_reference(row, owner, to, root, i); });
    case Storage::kSelectList:
      return each(model::value_of<model::SelectList>(a, data).items, select);
    case Storage::kRealList:
      return each(model::value_of<model::RealList>(a, data).items,
                  [&](double v, std::uint32_t i) { write_measure(row, owner, root, i, v, a.unit); });
    case Storage::kIntegerList:
      return each(model::value_of<model::IntegerList>(a, data).items, [&](std::int64_t v, std::uint32_t i) {
        write_measure(row, owner, root, i, static_cast<double>(v), model::Unit::kNone);
      });
    case Storage::kTextList:
      return each(model::value_of<model::TextList>(a, data).items,
                  [&](const std::string& v, std::uint32_t i) { write_text(row, owner, root, i, v); });
    case Storage::kRefTable:
    case Storage::kRealTable:
    case Storage::kPath:
      throw std::logic_error(row.place + ": needs a codec");
  }
}

}  // namespace capstan::exchange::ap238
