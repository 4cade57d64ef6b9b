#include "tooling/library/store/rows.h"

#include <algorithm>
#include <cstring>
#include <string>

#include "planner/ground/base/file.h"

// Rows of a store as its index knows them, and their hashes.

namespace capstan::tooling {

IndexKey key_of(const model::Cutter& c, std::int64_t place) {
  return {place,
          static_cast<int>(c.cutter_class),
          {c.cutting_diameter_mm, std::max(c.cutting_diameter_mm, c.adjustable_to_mm), reach_of(c),
           c.maximum_depth_of_cut_mm, c.corner_radius_mm, c.thread_pitch_mm}};
}

std::int64_t hash_of(const IndexKey& k) {
  std::string bytes(16 + sizeof k.value, '\0');
  std::memcpy(bytes.data(), &k.place, 8);
  const std::int64_t c = k.cutter_class;
  std::memcpy(bytes.data() + 8, &c, 8);
  std::memcpy(bytes.data() + 16, k.value.data(), sizeof k.value);
  return static_cast<std::int64_t>(fnv1a(bytes));
}

namespace {

/// Eight bytes at a time; each step can be undone, so that two texts of a length that differ in one word
/// never share a hash. For faults, not for malice.
std::uint64_t hash_words(std::string_view bytes, std::uint64_t h) {
  constexpr std::uint64_t kOdd = 0x9e3779b97f4a7c15ULL;
  const auto mix = [&h](std::uint64_t word) {
    h = (h ^ word) * kOdd;
    h ^= h >> 32;
  };
  mix(bytes.size());
  for (; bytes.size() >= 8; bytes.remove_prefix(8)) {
    std::uint64_t word = 0;
    for (std::size_t i = 0; i < 8; ++i)
      word |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
    mix(word);
  }
  std::uint64_t rest = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i)
    rest |= static_cast<std::uint64_t>(static_cast<unsigned char>(bytes[i])) << (8 * i);
  mix(rest);
  return h;
}

}  // namespace

std::int64_t hash_of(std::string_view kind, std::int64_t place, std::string_view body) {
  return static_cast<std::int64_t>(hash_words(body, fnv1a(kind) ^ static_cast<std::uint64_t>(place)));
}

}  // namespace capstan::tooling
