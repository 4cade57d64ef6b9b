#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_set>
#include <utility>
#include <vector>

#include "casebase/store/row.h"

namespace capstan::casebase {

struct HashId {
  std::size_t operator()(const Id& id) const { return static_cast<std::size_t>(id.low); }  // a hash itself
};
using IdSet = std::unordered_set<Id, HashId>;

/// Finds the places of a vector by the ids that stand in it; `id_at(place)` gives that of a place.
///
/// Open addressing with linear probing, at most half full; the low half of an id, which is a hash, is the
/// hash. A slot keeps 32 bits of it, so that the vector is looked at where an id is found, and not where the
/// table grows.
class IdTable {
 public:
  /// Takes in the next place. Needs an id that no place before has.
  void add(std::size_t place, const Id& id) {
    if (2 * (count_ + 1) > slots_.size()) grow();
    put({static_cast<std::uint32_t>(place), tag_of(id)});
    ++count_;
  }

  template <class IdAt>
  [[nodiscard]] std::optional<std::uint32_t> find(const Id& id, const IdAt& id_at) const {
    if (slots_.empty()) return std::nullopt;
    const std::uint32_t tag = tag_of(id);
    for (std::size_t at = first(tag); slots_[at].place != kFree; at = next(at)) {
      if (slots_[at].tag == tag && id_at(slots_[at].place) == id) return slots_[at].place;
    }
    return std::nullopt;
  }

 private:
  static constexpr std::uint32_t kFree = ~std::uint32_t{0};
  static constexpr std::size_t kLeastSlots = 64;  // a power of two, as any number of slots
  struct Slot {
    std::uint32_t place = kFree, tag = 0;
  };

  static std::uint32_t tag_of(const Id& id) { return static_cast<std::uint32_t>(id.low); }
  [[nodiscard]] std::size_t first(std::uint32_t tag) const { return tag & (slots_.size() - 1); }
  [[nodiscard]] std::size_t next(std::size_t at) const { return (at + 1) & (slots_.size() - 1); }
  void put(const Slot& slot) {
    std::size_t at = first(slot.tag);
    while (slots_[at].place != kFree) at = next(at);
    slots_[at] = slot;
  }
  void grow() {
    const std::vector<Slot> before = std::exchange(slots_, {});
    slots_.resize(before.empty() ? kLeastSlots : 2 * before.size());
    for (const Slot& slot : before) {
      if (slot.place != kFree) put(slot);
    }
  }

  std::vector<Slot> slots_;
  std::size_t count_ = 0;
};

}  // namespace capstan::casebase
