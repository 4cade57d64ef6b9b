#include <algorithm>

#include "planner/files/p21/store.h"

namespace capstan::p21::detail {
namespace {

/// An array of numbers may have this many places per instance.
constexpr std::uint64_t kSparsest = 4;

}  // namespace

std::vector<std::size_t> IdIndex::build(const Buffer<Entity>& entities, std::size_t count) {
  std::vector<std::size_t> duplicates;
  std::uint64_t highest = 0;
  for (std::size_t i = 0; i < count; ++i) highest = std::max(highest, entities[i].id);
  if (highest <= count * kSparsest + 1024) {
    dense_.assign(highest + 1, 0);
    for (std::size_t i = 0; i < count; ++i) {
      std::uint32_t& place = dense_[entities[i].id];
      if (place != 0) {
        duplicates.push_back(i);
      } else {
        place = static_cast<std::uint32_t>(i + 1);
      }
    }
    return duplicates;
  }
  sparse_.reserve(count);
  for (std::size_t i = 0; i < count; ++i) sparse_.emplace_back(entities[i].id, static_cast<std::uint32_t>(i));
  if (!std::is_sorted(sparse_.begin(), sparse_.end())) std::sort(sparse_.begin(), sparse_.end());
  for (std::size_t i = 1; i < count; ++i) {
    if (sparse_[i].first == sparse_[i - 1].first) duplicates.push_back(sparse_[i].second);
  }
  std::sort(duplicates.begin(), duplicates.end());
  return duplicates;
}

std::optional<std::uint32_t> IdIndex::find(std::uint64_t id) const {
  if (!dense_.empty()) {
    if (id >= dense_.size() || dense_[id] == 0) return std::nullopt;
    return dense_[id] - 1;
  }
  const auto at =
      std::lower_bound(sparse_.begin(), sparse_.end(), id,
                       [](const auto& pair, std::uint64_t wanted) { return pair.first < wanted; });
  if (at == sparse_.end() || at->first != id) return std::nullopt;
  return at->second;
}

}  // namespace capstan::p21::detail
