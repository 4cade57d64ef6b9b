#include "planner/door/service/explain/values.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/physics/motion/time.h"

namespace capstan::service {

using model::AnyRef;
using model::Attribute;
using model::Model;
using model::Storage;
using model::value_of;

namespace {

std::string number(double v, int decimals) {
  if (!std::isfinite(v)) return "not a number";
  return decimals < 0 ? shortest(v) : trimmed(v, decimals);
}

std::size_t characters(const std::string& s) {
  return static_cast<std::size_t>(std::count_if(
      s.begin(), s.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

template <class Items, class Show>
std::string listed(const Items& items, const Show& show) {
  std::string out = "(";
  std::size_t n = 0;
  for (const auto& x : items) {
    if (n == kListShown) {
      out += ", and " + std::to_string(items.size() - n) + " more";
      break;
    }
    if (n++ != 0) out += ", ";
    out += show(x);
  }
  return out + ")";
}

std::string enumerator(const Attribute& a, model::AnyEnum v) {
  const auto i = static_cast<std::size_t>(v.code);
  return i < a.enumerators.size() ? std::string(a.enumerators[i]) : std::to_string(v.code);
}

std::string own_name(const Model& m, AnyRef at) {
  for (const char* attribute : {"its_id", "name"}) {
    const Attribute* a = model::find_attribute(at.type, attribute);
    if (a == nullptr || a->storage != Storage::kText) continue;
    const auto& text = value_of<model::Text>(*a, m.object(at));
    if (text && !text->empty()) return *text;
  }
  return {};
}

}  // namespace

std::string name_of(const Model& m, AnyRef at) {
  if (!at.set()) return "nothing";
  if (const auto* kept = m.get<model::KeptInstance>(at)) return kept->keyword + " (unhandled)";
  std::string out(model::noun_type(at.type).keyword);
  const std::string own = own_name(m, at);
  return own.empty() ? out : out + " '" + own + "'";
}

std::string label(const Model& m, AnyRef at) {
  if (!at.set()) return "nothing";
  const auto n = m.origin(at).instance;
  return (n != 0 ? "#" + std::to_string(n) + " " : std::string()) + name_of(m, at);
}

std::string with_unit(double value, model::Unit unit, int decimals) {
  std::string out = number(value, decimals);
  if (unit == model::Unit::kNone || unit == model::Unit::kRatio) return out;
  out += " " + std::string(symbol(unit));
  if (unit == model::Unit::kAngle) out += " (" + trimmed(value * 180.0 / std::numbers::pi, 4) + " deg)";
  return out;
}

std::string value_text(const Model& m, const Attribute& a, const void* object, int decimals) {
  if (!model::has_value(a, object)) return "absent";
  const auto ref = [&](AnyRef r) { return label(m, r); };
  const auto real = [&](double v) { return with_unit(v, a.unit, decimals); };
  const auto bare = [&](double v) { return number(v, decimals); };
  const auto select = [&](const model::SelectValue& v) {
    if (v.ref.set()) return label(m, v.ref);
    if (v.real) return v.type + (v.type.empty() ? "" : " ") + number(*v.real, decimals);
    return v.text;
  };
  const auto unit = [&](std::string list) {
    const auto s = symbol(a.unit);
    return s.empty() ? list : list + " " + std::string(s);
  };
  switch (a.storage) {
    case Storage::kReal:
      return real(*value_of<model::Real>(a, object));
    case Storage::kInteger:
      return std::to_string(*value_of<model::Integer>(a, object));
    case Storage::kBoolean:
      return *value_of<model::Boolean>(a, object) ? "true" : "false";
    case Storage::kText:
      return "'" + *value_of<model::Text>(a, object) + "'";
    case Storage::kEnum:
      return enumerator(a, value_of<model::AnyEnum>(a, object));
    case Storage::kRef:
      return ref(value_of<AnyRef>(a, object));
    case Storage::kSelect:
      return select(value_of<model::SelectValue>(a, object));
    case Storage::kRefList:
      return listed(value_of<model::AnyRefList>(a, object).items, ref);
    case Storage::kSelectList:
      return listed(value_of<model::SelectList>(a, object).items, select);
    case Storage::kRealList:
      return unit(listed(value_of<model::RealList>(a, object).items, bare));
    case Storage::kIntegerList:
      return listed(value_of<model::IntegerList>(a, object).items,
                    [](std::int64_t v) { return std::to_string(v); });
    case Storage::kTextList:
      return listed(value_of<model::TextList>(a, object).items,
                    [](const std::string& v) { return "'" + v + "'"; });
    case Storage::kRefTable:
      return listed(value_of<model::RefTable>(a, object).items,
                    [&](const std::vector<AnyRef>& row) { return listed(row, ref); });
    case Storage::kRealTable:
      return unit(listed(value_of<model::RealTable>(a, object).items,
                         [&](const std::vector<double>& row) { return listed(row, bare); }));
    case Storage::kPath:
      return "a path of " + std::to_string(value_of<model::PathHandle>(a, object)->size()) + " points";
  }
  return {};
}

std::string duration(double seconds) { return motion::duration_text(seconds); }

std::string box_text(const geometry::Box3& box) {
  if (box.empty()) return "not known";
  const geometry::Vec3 size = box.size();
  const auto n = [](double v) { return trimmed(v, 3); };
  return n(size.x) + " x " + n(size.y) + " x " + n(size.z) + " mm, x " + n(box.lo.x) + ".." + n(box.hi.x) +
         ", y " + n(box.lo.y) + ".." + n(box.hi.y) + ", z " + n(box.lo.z) + ".." + n(box.hi.z);
}

std::string table(const std::vector<std::vector<std::string>>& rows, const std::string& indent) {
  std::vector<std::size_t> width;
  for (const auto& row : rows) {
    width.resize(std::max(width.size(), row.size()));
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], characters(row[i]));
  }
  std::string out;
  for (const auto& row : rows) {
    std::string line = indent;
    for (std::size_t i = 0; i < row.size(); ++i) {
      line += row[i];
      if (i + 1 < row.size()) line.append(width[i] - characters(row[i]) + 2, ' ');
    }
    while (!line.empty() && line.back() == ' ') line.pop_back();
    out += line + "\n";
  }
  return out;
}

}  // namespace capstan::service
