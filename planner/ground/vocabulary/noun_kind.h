#pragma once

#include <cstddef>
#include <cstdint>

namespace capstan::model {

/// Every kind of application object, abstract ones included. The order is not stored anywhere: files
/// carry keywords.
enum class TypeId : std::uint16_t {
  kNone,
#define CAPSTAN_NOUN(T) k##T,
#include "planner/ground/vocabulary/noun_kinds.inc"
#undef CAPSTAN_NOUN
  // what no kind above describes, kept as it was read
  kKeptInstance,
  kCount,
};

inline constexpr std::size_t kTypeCount = static_cast<std::size_t>(TypeId::kCount);

}  // namespace capstan::model
