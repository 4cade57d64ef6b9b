// Depth first, as `reachable`: an object that holds no reference leads to no other, so that leaving it out
// changes neither which others are reached nor in which order.
#include "planner/model/nouns/arena/reached.h"

#include <algorithm>
#include <array>
#include <functional>

#include "planner/model/nouns/arena/walk.h"

namespace capstan::model {
namespace {

bool refers(const NounType& type) {
  return std::any_of(type.attributes.begin(), type.attributes.end(), [](const Attribute& a) {
    return a.storage == Storage::kRef || a.storage == Storage::kRefList || a.storage == Storage::kRefTable ||
           a.storage == Storage::kSelect || a.storage == Storage::kSelectList;
  });
}

}  // namespace

std::vector<AnyRef> reached_of(const Model& model, std::span<const AnyRef> roots, TypeId kind) {
  // By the code of a kind.
  std::array<bool, kTypeCount> wanted{}, leads{};
  std::array<std::vector<bool>, kTypeCount> seen;
  for (std::size_t t = 1; t < kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    const std::uint32_t count = model.count(type);
    if (count == 0) continue;
    wanted[t] = is_a(type, kind);
    leads[t] = type == TypeId::kKeptInstance || refers(noun_type(type));
    if (wanted[t] || leads[t]) seen[t].resize(count);
  }
  std::vector<AnyRef> out;
  std::vector<AnyRef> pending;
  const std::function<void(AnyRef)> add = [&](AnyRef r) {
    const auto t = static_cast<std::size_t>(r.type);
    if (r.set() && (wanted[t] || leads[t])) pending.push_back(r);
  };
  std::for_each(roots.rbegin(), roots.rend(), add);
  while (!pending.empty()) {
    const AnyRef at = pending.back();
    pending.pop_back();
    const auto t = static_cast<std::size_t>(at.type);
    auto mark = seen[t][at.index];
    if (mark) continue;
    mark = true;
    if (wanted[t]) out.push_back(at);
    if (!leads[t]) continue;
    const auto first = static_cast<std::ptrdiff_t>(pending.size());
    for_each_reference(model, at, add);
    std::reverse(pending.begin() + first, pending.end());
  }
  return out;
}

}  // namespace capstan::model
