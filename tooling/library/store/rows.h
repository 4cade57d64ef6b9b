#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"

namespace capstan::tooling {

/// The index entry of a cutter in a store.
struct IndexKey {
  std::int64_t place = 0;
  int cutter_class = 0;
  std::array<double, 6> value{};  ///< diameter, diameter_to, reach, flutes, corner, pitch
  friend bool operator==(const IndexKey&, const IndexKey&) = default;
};
[[nodiscard]] IndexKey key_of(const model::Cutter& c, std::int64_t place);

/// The hash that a row of the index has beside it.
[[nodiscard]] std::int64_t hash_of(const IndexKey& k);
/// The same of a row of records or cutters. Its place is part of it: rows that changed places are found, too.
/// For faults, not for malice.
[[nodiscard]] std::int64_t hash_of(std::string_view kind, std::int64_t place, std::string_view body);

}  // namespace capstan::tooling
