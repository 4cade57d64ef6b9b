#include "planner/exchange/ap238/codecs.h"

#include <array>

namespace capstan::exchange::ap238 {

const Codec* find_codec(std::string_view name) {
  static constexpr std::array<const Codec*, 0> kCodecs{};
  for (const Codec* c : kCodecs) {
    if (c->name == name) return c;
  }
  return nullptr;
}

}  // namespace capstan::exchange::ap238
