#include <algorithm>
#include <stdexcept>
#include "planner/files/exchange/ap238/codecs/codecs.h"
#include "planner/files/exchange/ap238/read/auxiliary.h"
#include "planner/files/exchange/ap238/records.h"
#include "planner/files/exchange/ap238/write/writer.h"
#include "planner/files/exchange/common/file_sections.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

// Values by the rows of the mapping: measures, texts, references.

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

namespace {

// The name that a step demands, as spelled; empty if it demands none.
std::string demanded_name(const Step& s) {
  for (const Constraint& c : s.constraints) {
    if ((c.attribute == "name" || c.attribute == "representation_item.name") && !c.texts.empty() &&
        !c.negated) {
      return c.texts.front();
    }
  }
  return {};
}

}  // namespace

// --- leaves ---

Id Writer::unit(model::Unit u) {
  static constexpr std::string_view kNames[] = {"count",      "mm",     "radian",      "mm_per_minute",
                                                "per_minute", "second", "ratio",       "newton_per_mm2",
                                                "cubic_mm",   "watt",   "newton_metre"};
  return shared(kNames[static_cast<std::size_t>(u)]);
}

Id Writer::measure(double value, model::Unit u, std::string_view name, std::span<const EntityId> entities) {
  struct Form {
    model::Unit unit;
    std::string_view type, entity;
  };
  static constexpr Form kForms[] = {
      {model::Unit::kLength, "LENGTH_MEASURE", "length_measure_with_unit&measure_representation_item"},
      {model::Unit::kAngle, "PLANE_ANGLE_MEASURE",
       "plane_angle_measure_with_unit&measure_representation_item"},
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
      if (row->only[i] != TypeId::kNone && holder.set() && !model::is_a(holder.type, row->only[i]))
        holder = {};
    }
    if (a == nullptr || !holder.set() || !model::has_value(*a, m_.object(holder))) continue;
    if (const Attribute* other =
            row->unless.empty() ? nullptr : model::find_attribute(holder.type, row->unless);
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
      const bool inner =
          object != nullptr && std::any_of(object->with.begin(), object->with.end(), [&](const auto& w) {
            std::string d;
            for (const auto& part : w.first) d += (d.empty() ? "" : ".") + part;
            return d == dotted;
          });
      // Rows for what is inside say nothing of an object that was kept as it is.
      const bool kept = a.storage == Storage::kRef &&
                        model::value_of<AnyRef>(a, m_.object(holder)).type == TypeId::kKeptInstance;
      if (!inner && !mapped(dotted, kept))
        lose(std::string(model::noun_type(holder.type).keyword) + "." + std::string(a.name));
    }
  };
  look(at, "");
  for (const auto& [path, type] :
       object == nullptr ? std::vector<std::pair<std::vector<std::string>, TypeId>>{} : object->with) {
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

void Writer::write_text(const Row& row, AnyRef owner, Id root, std::uint32_t ordinal,
                        const std::string& text) {
  if (!row.value_of.empty()) {
    const bool enumerator =
        text.size() > 2 && text.front() == '.' && text.back() == '.' && !row.texts.empty();
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

void Writer::write_measure(const Row& row, AnyRef owner, Id root, std::uint32_t ordinal, double v,
                           model::Unit u) {
  if (!row.value_of.empty()) {
    set(walk(row, owner, root, 0, ordinal), row.value_of, part21_real(v));
    return;
  }
  write_leaf(row, owner, root, ordinal,
             measure(v, u, demanded_name(row.steps.back()), row.steps.back().entities));
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
  if (ordinal == 0)
    memo_.emplace(MemoKey{owner, last.prefix, 0, copy_}, target);  // rows may lead on from there
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
    const bool fits = row.when.empty() || (row.when == "text" && !v.text.empty()) ||
                      (row.when == "real" && v.real) ||
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
    if (v.real)
      return write_measure(row, owner, root, i, *v.real,
                           a.unit == model::Unit::kNone ? model::Unit::kRatio : a.unit);
    std::string s = v.text;
    for (char& c : s) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
    write_text(row, owner, root, i, s);
  };
  switch (a.storage) {
    case Storage::kReal:
      return write_measure(row, owner, root, 0, *model::value_of<model::Real>(a, data), a.unit);
    case Storage::kInteger:
      if (!row.value_of.empty()) {
        return set(walk(row, owner, root, 0, 0), row.value_of,
                   std::to_string(*model::value_of<model::Integer>(a, data)));
      }
      return write_measure(row, owner, root, 0,
                           static_cast<double>(*model::value_of<model::Integer>(a, data)),
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
      if (code >= row.texts.size())
        throw std::logic_error(row.place + ": a text for each enumerator is missing");
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
