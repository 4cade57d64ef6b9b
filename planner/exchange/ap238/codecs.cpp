#include "planner/exchange/ap238/codecs.h"

#include <array>

#include "planner/exchange/ap238/toolpath_codec.h"

namespace capstan::exchange::ap238 {

const Codec* find_codec(std::string_view name) {
  static constexpr std::array<const Codec*, 6> kCodecs{&kToolpathListCodec, &kToolpathSpeedCodec,
                                                       &kDirectionsCodec,   &kSectionsCodec,
                                                       &kAxisCommandsCodec, &kAxisNamesCodec};
  for (const Codec* c : kCodecs) {
    if (c->name == name) return c;
  }
  return nullptr;
}

}  // namespace capstan::exchange::ap238
