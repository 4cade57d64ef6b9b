#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

#include "casebase/store/row.h"

namespace capstan::casebase {

struct HashId {
  std::size_t operator()(const Id& id) const { return static_cast<std::size_t>(id.low); }  // a hash itself
};
using IdSet = std::unordered_set<Id, HashId>;

/// Finds the places of a vector by the ids that stand in it. `id_at(place)` gives an id, and always the same.
///
/// Open addressing with linear probing, at most half full; the low half of an id, which is a hash, is the
/// hash.
class IdTable {
 public:
  /// Takes in the next place. Needs an id that no place before has.
  template <class IdAt>
  void add(std::size_t place, const IdAt& id_at) {
    if (2 * (count_ + 1) > slots_.size()) {
      slots_.assign(slots_.empty() ? kLeastSlots : 2 * slots_.size(), kFree);
      for (std::size_t before = 0; before < place; ++before) put(before, id_at(before));
    }
    put(place, id_at(place));
    ++count_;
  }

  template <class IdAt>
  [[nodiscard]] std::optional<std::uint32_t> find(const Id& id, const IdAt& id_at) const {
    if (slots_.empty()) return std::nullopt;
    for (std::size_t slot = first(id); slots_[slot] != kFree; slot = next(slot)) {
      if (id_at(slots_[slot]) == id) return slots_[slot];
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};
  static constexpr std::size_t kLeastSlots = 64;  // a power of two, as any number of slots

  [[nodiscard]] std::size_t first(const Id& id) const {
    return static_cast<std::size_t>(id.low) & (slots_.size() - 1);
  }
  [[nodiscard]] std::size_t next(std::size_t slot) const { return (slot + 1) & (slots_.size() - 1); }
  void put(std::size_t place, const Id& id) {
    std::size_t slot = first(id);
    while (slots_[slot] != kFree) slot = next(slot);
    slots_[slot] = static_cast<std::uint32_t>(place);
  }

  std::vector<std::uint32_t> slots_;
  std::size_t count_ = 0;
};

}  // namespace capstan::casebase
