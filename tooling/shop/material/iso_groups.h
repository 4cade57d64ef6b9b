#pragma once

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace capstan::tooling {

/// The groups of ISO 513, in its order.
struct IsoGroup {
  std::string_view letter, words;
};
inline constexpr std::array<IsoGroup, 6> kIsoGroups = {
    {{"P", "steel"},
     {"M", "austenitic and duplex stainless steel"},
     {"K", "cast iron"},
     {"N", "light metals, copper and its alloys, plastics"},
     {"S", "titanium and heat-resistant alloys"},
     {"H", "hardened steel"}}};

[[nodiscard]] inline bool is_iso_group(std::string_view text) {
  return std::any_of(kIsoGroups.begin(), kIsoGroups.end(),
                     [&](const IsoGroup& g) { return g.letter == text; });
}

/// "P, M, K, N, S or H", for a message.
[[nodiscard]] inline std::string iso_group_letters() {
  std::string out;
  for (std::size_t i = 0; i < kIsoGroups.size(); ++i)
    out += (i == 0 ? "" : i + 1 == kIsoGroups.size() ? " or " : ", ") + std::string(kIsoGroups[i].letter);
  return out;
}

}  // namespace capstan::tooling
