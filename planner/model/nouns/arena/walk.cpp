#include "planner/model/nouns/arena/walk.h"

#include <algorithm>
#include <array>
#include <variant>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"

namespace capstan::model {
namespace {

constexpr int kHashDepth = 6;  // levels of references a value's hash looks through
/// Words that go into one value's hash: the rest does not count. Lists of one thing many times, level by
/// level, would otherwise never end. Ten times what a boundary of two thousand segments needs.
constexpr std::size_t kHashWords = 1'000'000;

/// Hashes an attribute's value: numbers by their shortest text, references by what they point to.
class Hasher {
 public:
  explicit Hasher(const Model& model) : model_(model) {}

  void attribute(const Attribute& a, const void* object, int depth) {
    switch (a.storage) {
      case Storage::kReal:
        if (const auto& v = value_of<Real>(a, object)) text(shortest(*v));
        break;
      case Storage::kInteger:
        if (const auto& v = value_of<Integer>(a, object)) text(std::to_string(*v));
        break;
      case Storage::kBoolean:
        if (const auto& v = value_of<Boolean>(a, object)) text(*v ? "T" : "F");
        break;
      case Storage::kText:
        if (const auto& v = value_of<Text>(a, object)) text(*v);
        break;
      case Storage::kEnum:
        text(std::to_string(value_of<AnyEnum>(a, object).code));
        break;
      case Storage::kRef:
        reference(value_of<AnyRef>(a, object), depth);
        break;
      case Storage::kRefList:
        for (const AnyRef r : value_of<AnyRefList>(a, object).items) reference(r, depth);
        break;
      case Storage::kRefTable:
        for (const auto& row : value_of<RefTable>(a, object).items) {
          for (const AnyRef r : row) reference(r, depth);
        }
        break;
      case Storage::kSelect:
        select(value_of<SelectValue>(a, object), depth);
        break;
      case Storage::kSelectList:
        for (const auto& v : value_of<SelectList>(a, object).items) select(v, depth);
        break;
      case Storage::kRealList:
        for (const double v : value_of<RealList>(a, object).items) text(shortest(v));
        break;
      case Storage::kIntegerList:
        for (const auto v : value_of<IntegerList>(a, object).items) text(std::to_string(v));
        break;
      case Storage::kTextList:
        for (const auto& v : value_of<TextList>(a, object).items) text(v);
        break;
      case Storage::kRealTable:
        for (const auto& row : value_of<RealTable>(a, object).items) {
          for (const double v : row) text(shortest(v));
        }
        break;
      case Storage::kPath:
        break;  // a path follows from the decisions it was computed from
    }
    text(";");
  }

  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  void text(std::string_view s) {
    if (words_ >= kHashWords) return;
    ++words_;
    hash_ = fnv1a("|", fnv1a(s, hash_));
  }

  void select(const SelectValue& v, int depth) {
    reference(v.ref, depth);
    text(v.type);
    if (v.real) text(shortest(*v.real));
    text(v.text);
  }

  // What is decided about these is decided one by one: a reference to them says only which kind it is.
  static bool stands_for_itself(TypeId t) {
    return is_a(t, TypeId::kExecutable) || is_a(t, TypeId::kOperation) ||
           is_a(t, TypeId::kManufacturingFeature) || is_a(t, TypeId::kWorkpiece) ||
           is_a(t, TypeId::kToolpathList);
  }

  // Depth is bounded, so that circles of references end.
  void reference(AnyRef r, int depth) {
    if (words_ >= kHashWords) return;
    if (!r.set()) return text("$");
    const NounType& type = noun_type(r.type);
    text(type.keyword);
    if (depth >= kHashDepth || stands_for_itself(r.type)) return;
    const void* object = model_.object(r);
    for (const Attribute& a : type.attributes) {
      if (a.in_iso14649) attribute(a, object, depth + 1);  // a value is the same in every file that holds it
    }
  }

  const Model& model_;
  std::uint64_t hash_ = fnv1a("");
  std::size_t words_ = 0;
};

}  // namespace

std::uint64_t hash_attribute(const Model& model, AnyRef object, std::string_view attribute) {
  const Attribute* a = find_attribute(object.type, attribute);
  if (a == nullptr) return 0;
  Hasher hasher(model);
  hasher.attribute(*a, model.object(object), 0);
  return hasher.value();
}

void for_each_reference(const Model& model, AnyRef object, const std::function<void(AnyRef)>& visit) {
  const auto one = [&](AnyRef r) {
    if (r.set()) visit(r);
  };
  const void* data = model.object(object);
  if (object.type == TypeId::kKeptInstance) {
    for (const auto& piece : model.at<KeptInstance>(object).pieces) {
      if (const auto* r = std::get_if<AnyRef>(&piece)) one(*r);
    }
    return;
  }
  for (const Attribute& a : noun_type(object.type).attributes) {
    switch (a.storage) {
      case Storage::kRef:
        one(value_of<AnyRef>(a, data));
        break;
      case Storage::kRefList:
        for (const AnyRef r : value_of<AnyRefList>(a, data).items) one(r);
        break;
      case Storage::kRefTable:
        for (const auto& row : value_of<RefTable>(a, data).items) {
          for (const AnyRef r : row) one(r);
        }
        break;
      case Storage::kSelect:
        one(value_of<SelectValue>(a, data).ref);
        break;
      case Storage::kSelectList:
        for (const auto& v : value_of<SelectList>(a, data).items) one(v.ref);
        break;
      default:
        break;
    }
  }
}

std::vector<AnyRef> reachable(const Model& model, std::span<const AnyRef> roots) {
  std::array<std::vector<bool>, kTypeCount> seen;
  for (std::size_t t = 1; t < kTypeCount; ++t) seen[t].resize(model.count(static_cast<TypeId>(t)));
  std::vector<AnyRef> out;
  std::vector<AnyRef> pending(roots.rbegin(), roots.rend());
  const std::function<void(AnyRef)> add = [&](AnyRef r) { pending.push_back(r); };
  while (!pending.empty()) {
    const AnyRef at = pending.back();
    pending.pop_back();
    if (!at.set()) continue;
    auto mark = seen[static_cast<std::size_t>(at.type)][at.index];
    if (mark) continue;
    mark = true;
    out.push_back(at);
    const auto first = static_cast<std::ptrdiff_t>(pending.size());
    for_each_reference(model, at, add);
    std::reverse(pending.begin() + first, pending.end());
  }
  return out;
}

bool has_value(const Attribute& a, const void* object) {
  switch (a.storage) {
    case Storage::kReal:
      return value_of<Real>(a, object).has_value();
    case Storage::kInteger:
      return value_of<Integer>(a, object).has_value();
    case Storage::kBoolean:
      return value_of<Boolean>(a, object).has_value();
    case Storage::kText:
      return value_of<Text>(a, object).has_value();
    case Storage::kEnum:
      return value_of<AnyEnum>(a, object).set();
    case Storage::kRef:
      return value_of<AnyRef>(a, object).set();
    case Storage::kRefList:
      return value_of<AnyRefList>(a, object).given;
    case Storage::kRefTable:
      return value_of<RefTable>(a, object).given;
    case Storage::kSelect:
      return value_of<SelectValue>(a, object).set();
    case Storage::kSelectList:
      return value_of<SelectList>(a, object).given;
    case Storage::kRealList:
      return value_of<RealList>(a, object).given;
    case Storage::kIntegerList:
      return value_of<IntegerList>(a, object).given;
    case Storage::kTextList:
      return value_of<TextList>(a, object).given;
    case Storage::kRealTable:
      return value_of<RealTable>(a, object).given;
    case Storage::kPath:
      return value_of<PathHandle>(a, object) != nullptr;
  }
  return false;
}

}  // namespace capstan::model
