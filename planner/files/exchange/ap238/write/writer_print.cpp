#include <algorithm>
#include <array>
#include <charconv>
#include <numbers>

#include "planner/files/exchange/ap238/read/auxiliary.h"
#include "planner/files/exchange/ap238/write/writer.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/append_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Storage;

namespace {

using Kind = express::TypeKind;

// The value of an attribute that the mapping does not set: '' and .F. if it is mandatory.
std::string nothing(const express::Type* t, bool optional) {
  while (t != nullptr && t->kind == Kind::kDefined) t = t->underlying;
  if (optional || t == nullptr) return "$";
  switch (t->kind) {
    case Kind::kString:
      return "''";
    case Kind::kBoolean:
    case Kind::kLogical:
      return ".F.";
    default:
      return "$";
  }
}

/// Room that the number of an instance needs, in characters.
constexpr std::size_t kIdRoom = 16;
/// Numbers of an instance that is printed in one piece, at most: a cross section has seven.
constexpr std::size_t kFewNumbers = 8;
constexpr std::size_t kKeywordRoom = 64;
/// Room that such an instance needs: its name and one list, and the marks between them.
constexpr std::size_t kLineRoom = kIdRoom + kKeywordRoom + 2 * kFewNumbers * (kNumberRoom + 1) + 16;

char* print_number_of(char* to, Id id) {
  *to = '#';
  return std::to_chars(to + 1, to + kIdRoom, id).ptr;
}

void append_number_of(Id id, std::string& out) {
  std::array<char, kIdRoom> text;
  const char* const end = print_number_of(text.data(), id);
  out.append(text.data(), static_cast<std::size_t>(end - text.data()));
}

char* print_text(char* to, std::string_view text) { return std::copy(text.begin(), text.end(), to); }

template <class List, class Show>
std::string listed(const List& items, const Show& show) {
  std::string out = "(";
  for (const auto& item : items) {
    if (out.size() > 1) out += ',';
    out += show(item);
  }
  return out + ")";
}

}  // namespace

const Writer::Geometry& Writer::geometry_of(model::TypeId type) {
  if (geometry_before_.second != nullptr && geometry_before_.first == type) return *geometry_before_.second;
  const auto [it, fresh] = geometry_.try_emplace(type);
  Geometry& g = it->second;
  geometry_before_ = {type, &g};
  if (!fresh) return g;
  const auto& noun = model::noun_type(type);
  g.plain = is_geometry({type, 0}) && map_.objects_of(type).empty();
  g.entity = schema_.find(noun.keyword);
  for (const Attribute& a : noun.attributes) {
    g.refers = g.refers || a.storage == Storage::kRef || a.storage == Storage::kRefList ||
               a.storage == Storage::kRefTable || a.storage == Storage::kSelect ||
               a.storage == Storage::kSelectList;
  }
  g.of_points = g.plain && g.entity != express::kNoEntity &&
                std::all_of(noun.attributes.begin(), noun.attributes.end(), [](const Attribute& a) {
                  return a.storage == Storage::kText || a.storage == Storage::kRealList ||
                         a.storage == Storage::kRefList;
                });
  if (g.entity == express::kNoEntity) return g;
  for (const express::Slot& s : schema_.slots(g.entity)) {
    g.slots.push_back({s.derived, s.attribute->name == "name", model::find_attribute(type, s.attribute->name),
                       nothing(s.type, s.optional)});
  }
  g.of_numbers = g.of_points && !g.refers && noun.keyword.size() <= kKeywordRoom && g.slots.size() == 2;
  return g;
}

std::string Writer::slot_text(const Made& made, const express::Slot& slot) const {
  if (slot.derived) return "*";
  for (const Value& v : made.values) {
    if (v.attribute != slot.attribute) continue;
    if (!v.aggregate) return v.items.back();
    const std::string list = listed(v.items, [](const std::string& s) { return s; });
    return v.wrapper.empty() ? list : v.wrapper + "(" + list + ")";
  }
  return nothing(slot.type, slot.optional);
}

std::size_t Writer::bytes() const {
  constexpr std::size_t kInInstance = 110;  // a point of a computed path has 60 to 100
  return instances_.size() * kInInstance;
}

void Writer::print(std::string& out, Seals& sealed, std::string& unsealed) {
  constexpr std::size_t kAtOnce = 64;  // whose seals are taken together
  struct Printed {
    std::string_view keyword;
    std::size_t line, number, begin, end;  // the text moves as it grows
  };
  std::vector<Printed> printed;
  std::vector<Seals::Text> texts;
  const auto seal = [&] {
    texts.clear();
    for (const Printed& p : printed) {
      const std::string_view text = out;
      texts.push_back(
          text_of_instance(text.substr(p.line, p.number), p.keyword, text.substr(p.begin, p.end - p.begin)));
    }
    sealed.add(texts);
    printed.clear();
  };
  std::array<char, kLineRoom> room;
  for (Id id = 1; id <= instances_.size(); ++id) {
    tick(2);
    if (!reserved_.empty() && reserved_.contains(id)) continue;
    const Instance& instance = instances_[id - 1];
    const std::size_t line = out.size();
    const Geometry* const points = instance.made == kAsItIs ? &geometry_of(instance.noun.type) : nullptr;
    if (points != nullptr && points->of_numbers) {
      char* const number_end = print_number_of(room.data(), id);
      *number_end = '=';
      if (char* end = print_numbers(instance.noun, *points, number_end + 1); end != nullptr) {
        const auto size = [&](const char* upto) { return static_cast<std::size_t>(upto - room.data()); };
        printed.push_back({model::noun_type(instance.noun.type).keyword, line, size(number_end),
                           line + size(number_end) + 1, line + size(end)});
        end = print_text(end, ";\n");
        out.append(room.data(), size(end));
        if (printed.size() == kAtOnce) seal();
        continue;
      }
    }
    append_number_of(id, out);
    const std::size_t number = out.size() - line;
    out += '=';
    const std::size_t begin = out.size();
    if (instance.made != kAsItIs) {
      print(made_[instance.made], out);
    } else {
      print_as_it_is(instance.noun, {}, out);
    }
    const std::size_t end = out.size();
    out += ";\n";
    if (points != nullptr && points->of_points) {
      printed.push_back({model::noun_type(instance.noun.type).keyword, line, number, begin, end});
      if (printed.size() == kAtOnce) seal();
    } else {
      unsealed.append(out, line);
    }
  }
  seal();
  for (const auto& [what, n] : lost_) {
    losses_.push_back(what + " has no place in AP238 (" + std::to_string(n) + " left out)");
  }
}

// An instance of a few numbers and no text, as most points are; nullptr: it is something else.
char* Writer::print_numbers(AnyRef noun, const Geometry& geometry, char* to) const {
  const void* const data = m_.object(noun);
  to = print_text(to, model::noun_type(noun.type).keyword);
  char before = '(';
  for (const Geometry::Slot& s : geometry.slots) {
    *to++ = before;
    before = ',';
    const Attribute* a = s.attribute;
    if (a == nullptr || s.derived) return nullptr;
    if (!model::has_value(*a, data)) {
      to = print_text(to, s.nothing);
    } else if (a->storage == Storage::kText && model::value_of<model::Text>(*a, data)->empty()) {
      to = print_text(to, "''");
    } else if (a->storage == Storage::kRealList) {
      const auto& items = model::value_of<model::RealList>(*a, data).items;
      if (items.size() > kFewNumbers) return nullptr;
      *to++ = '(';
      for (std::size_t i = 0; i < items.size(); ++i) {
        if (i != 0) *to++ = ',';
        to = print_part21_real(to, items[i]);
      }
      *to++ = ')';
    } else {
      return nullptr;
    }
  }
  *to++ = ')';
  return to;
}

void Writer::print_as_it_is(AnyRef noun, const std::string& name, std::string& out) {
  if (noun.type == model::TypeId::kKeptInstance) {
    print_kept(m_.at<model::KeptInstance>(noun), out);
  } else {
    print_geometry(noun, name, out);
  }
}

void Writer::print(const Made& made, std::string& out) {
  if (made.leaves.empty()) {
    print_as_it_is(made.noun, made.name, out);
  } else if (made.leaves.size() == 1) {
    out += schema_.keyword(made.leaves.front());
    out += listed(schema_.slots(made.leaves.front()),
                  [&](const express::Slot& s) { return slot_text(made, s); });
  } else {
    out += '(';
    for (const EntityId part : schema_.closure(made.leaves)) {
      out += schema_.keyword(part);
      out += listed(schema_.part_slots(part, made.leaves),
                    [&](const express::Slot& slot) { return slot_text(made, slot); });
    }
    out += ')';
  }
}

std::string Writer::reference_text(AnyRef r) {
  if (!r.set()) return "$";
  if (const auto* kept = m_.get<model::KeptInstance>(r)) {
    if (const auto part = auxiliary_part(*kept)) {
      const auto prefix = prefix_of_text_.find(part->second.path);
      if (prefix != prefix_of_text_.end()) {
        const auto it = memo_.find({part->first, prefix->second, part->second.ordinal, 0});
        if (it != memo_.end()) return "#" + std::to_string(it->second);
      }
      lose("a reference to a part of " + std::string(model::noun_type(part->first.type).keyword));
      return "$";
    }
  }
  const Id id = ids_.find(r).value_or(kNoId);
  return id == kNoId ? "$" : "#" + std::to_string(id);
}

void Writer::print_kept(const model::KeptInstance& kept, std::string& out) {
  for (const auto& piece : kept.pieces) {
    const auto* text = std::get_if<std::string>(&piece);
    out += text != nullptr ? *text : reference_text(std::get<AnyRef>(piece));
  }
}

void Writer::append_references(const std::vector<AnyRef>& items, std::string& out) {
  std::array<char, 256 * kIdRoom> buffer;
  char* to = buffer.data();
  const auto append = [&] {
    out.append(buffer.data(), static_cast<std::size_t>(to - buffer.data()));
    to = buffer.data();
  };
  *to++ = '(';
  bool first = true;
  for (const AnyRef r : items) {
    if (!first) *to++ = ',';
    first = false;
    if (r.type == model::TypeId::kKeptInstance) {
      append();
      out += reference_text(r);
    } else if (const Id id = r.set() ? ids_.find(r).value_or(kNoId) : kNoId; id != kNoId) {
      to = print_number_of(to, id);
    } else {
      *to++ = '$';
    }
    if (static_cast<std::size_t>(to - buffer.data()) > buffer.size() - 2 * kIdRoom) append();
  }
  *to++ = ')';
  append();
}

// What millions of points, and the lines through them, consist of; all else as `attribute_text`.
void Writer::append_attribute(const Attribute& a, const void* data, std::string& out) {
  if (a.storage == Storage::kRealList) {
    out += '(';
    append_part21_reals(out, model::value_of<model::RealList>(a, data).items);
    out += ')';
  } else if (a.storage == Storage::kRefList) {
    append_references(model::value_of<model::AnyRefList>(a, data).items, out);
  } else if (a.storage == Storage::kText && model::value_of<model::Text>(a, data)->empty()) {
    out += "''";
  } else {
    out += attribute_text(a, data);
  }
}

void Writer::print_geometry(AnyRef at, const std::string& name, std::string& out) {
  const auto& type = model::noun_type(at.type);
  const Geometry& geometry = geometry_of(at.type);
  out += type.keyword;
  if (geometry.entity == express::kNoEntity)
    throw std::logic_error("AP238 has no " + std::string(type.keyword));
  const void* const data = m_.object(at);
  const auto* trimmed = geometry.refers ? m_.get<model::TrimmedCurve>(at) : nullptr;
  const bool of_angles = trimmed != nullptr && (m_.holds<model::Circle>(trimmed->basis_curve) ||
                                                m_.holds<model::Ellipse>(trimmed->basis_curve));
  const auto slot = [&](const Geometry::Slot& s) {
    const Attribute* a = s.attribute;
    if (s.derived) {
      out += '*';
    } else if (s.name && !name.empty()) {
      out += name;
    } else if (a == nullptr || !model::has_value(*a, data)) {
      out += s.nothing;
    } else if (of_angles && a->storage == Storage::kSelectList) {
      auto values = model::value_of<model::SelectList>(*a, data);
      for (auto& v : values.items) {  // degrees in the model, radians in the written context
        if (v.real) v.real = *v.real * std::numbers::pi / 180.0;
      }
      out += listed(values.items, [&](const model::SelectValue& v) { return select_text(v); });
    } else {
      append_attribute(*a, data, out);
    }
  };
  char before = '(';
  for (const Geometry::Slot& s : geometry.slots) {
    out += before;
    slot(s);
    before = ',';
  }
  out += geometry.slots.empty() ? "()" : ")";
}

std::string Writer::select_text(const model::SelectValue& v) {
  if (v.ref.set()) return reference_text(v.ref);
  const std::string bare = v.real ? part21_real(*v.real) : "." + v.text + ".";
  return v.type.empty() ? bare : v.type + "(" + bare + ")";
}

std::string Writer::attribute_text(const Attribute& a, const void* data) {
  const auto number = [](double v) { return part21_real(v); };
  const auto whole = [](std::int64_t v) { return std::to_string(v); };
  const auto text = [](const std::string& s) { return p21::quoted(s); };
  const auto ref = [&](AnyRef r) { return reference_text(r); };
  const auto select = [&](const model::SelectValue& v) { return select_text(v); };
  switch (a.storage) {
    case Storage::kReal:
      return number(*model::value_of<model::Real>(a, data));
    case Storage::kInteger:
      return whole(*model::value_of<model::Integer>(a, data));
    case Storage::kBoolean:
      return *model::value_of<model::Boolean>(a, data) ? ".T." : ".F.";
    case Storage::kText:
      return text(*model::value_of<model::Text>(a, data));
    case Storage::kEnum:
      return "." +
             std::string(
                 a.enumerators[static_cast<std::size_t>(model::value_of<model::AnyEnum>(a, data).code)]) +
             ".";
    case Storage::kRef:
      return ref(model::value_of<AnyRef>(a, data));
    case Storage::kSelect:
      return select(model::value_of<model::SelectValue>(a, data));
    case Storage::kRefList:
      return listed(model::value_of<model::AnyRefList>(a, data).items, ref);
    case Storage::kSelectList:
      return listed(model::value_of<model::SelectList>(a, data).items, select);
    case Storage::kRealList:
      return listed(model::value_of<model::RealList>(a, data).items, number);
    case Storage::kIntegerList:
      return listed(model::value_of<model::IntegerList>(a, data).items, whole);
    case Storage::kTextList:
      return listed(model::value_of<model::TextList>(a, data).items, text);
    case Storage::kRefTable:
      return listed(model::value_of<model::RefTable>(a, data).items,
                    [&](const auto& row) { return listed(row, ref); });
    case Storage::kRealTable:
      return listed(model::value_of<model::RealTable>(a, data).items,
                    [&](const auto& row) { return listed(row, number); });
    case Storage::kPath:
      return "$";
  }
  return "$";
}

}  // namespace capstan::exchange::ap238
