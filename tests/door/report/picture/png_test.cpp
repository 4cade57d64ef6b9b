#include "planner/door/report/picture/png.h"

#include <gtest/gtest.h>

#include <array>
#include <random>
#include <stdexcept>

namespace capstan::report::picture {
namespace {

/// Reads a stream of blocks of the fixed code, from the tables of RFC 1951 as they are printed.
class Inflated {
 public:
  explicit Inflated(const std::string& bytes) : bytes_(bytes) {
    bool last = false;
    while (!last) {
      last = bits(1) != 0;
      if (bits(2) != 1) throw std::runtime_error("not of the fixed code");
      while (block()) {
      }
    }
  }
  std::vector<std::uint8_t> out;
  /// Bytes that were read, the last one begun.
  [[nodiscard]] std::size_t end() const { return (at_ + 7) / 8; }

 private:
  unsigned bit() {
    const auto byte = static_cast<std::uint8_t>(bytes_.at(at_ / 8));
    return static_cast<unsigned>(byte) >> (at_++ % 8) & 1U;
  }
  unsigned bits(unsigned n) {
    unsigned v = 0;
    for (unsigned i = 0; i < n; ++i) v |= bit() << i;
    return v;
  }
  unsigned symbol() {
    unsigned v = 0;
    for (int i = 0; i < 7; ++i) v = v << 1U | bit();
    if (v <= 0x17) return 256 + v;
    v = v << 1U | bit();
    if (v >= 0x30 && v <= 0xBF) return v - 0x30;
    if (v >= 0xC0 && v <= 0xC7) return 280 + v - 0xC0;
    return 144 + (v << 1U | bit()) - 0x190;
  }
  bool block() {
    static constexpr std::array kLength = {3,  4,  5,  6,  7,  8,  9,  10, 11,  13,  15,  17,  19,  23, 27,
                                           31, 35, 43, 51, 59, 67, 83, 99, 115, 131, 163, 195, 227, 258};
    static constexpr std::array kLengthBits = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 2, 2, 2,
                                               2, 3, 3, 3, 3, 4, 4, 4, 4, 5, 5, 5, 5, 0};
    static constexpr std::array kDistance = {1,    2,    3,    4,    5,    7,    9,    13,    17,    25,
                                             33,   49,   65,   97,   129,  193,  257,  385,   513,   769,
                                             1025, 1537, 2049, 3073, 4097, 6145, 8193, 12289, 16385, 24577};
    const unsigned s = symbol();
    if (s == 256) return false;
    if (s < 256) {
      out.push_back(static_cast<std::uint8_t>(s));
      return true;
    }
    const unsigned length =
        static_cast<unsigned>(kLength.at(s - 257)) + bits(static_cast<unsigned>(kLengthBits.at(s - 257)));
    unsigned d = 0;
    for (int i = 0; i < 5; ++i) d = d << 1U | bit();
    const unsigned distance = static_cast<unsigned>(kDistance.at(d)) + bits(d < 4 ? 0 : d / 2 - 1);
    for (unsigned i = 0; i < length; ++i) out.push_back(out.at(out.size() - distance));
    return true;
  }
  const std::string& bytes_;
  std::size_t at_ = 0;
};

std::uint32_t big_endian(const std::string& s, std::size_t at) {
  std::uint32_t v = 0;
  for (std::size_t i = 0; i < 4; ++i) v = v << 8U | static_cast<std::uint8_t>(s.at(at + i));
  return v;
}

/// The bytes before compression; `png` has the one chunk of data that begins behind the 33 bytes of its head.
std::vector<std::uint8_t> rows_of(const std::string& png) {
  EXPECT_EQ(png.substr(37, 4), "IDAT");
  const std::string data = png.substr(41, big_endian(png, 33));
  EXPECT_EQ((static_cast<unsigned>(data[0]) * 256U + static_cast<unsigned>(data[1])) % 31U, 0U);
  const std::string deflated = data.substr(2, data.size() - 6);
  const Inflated read(deflated);
  EXPECT_EQ(read.end(), deflated.size());
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t v : read.out) {
    a = (a + v) % 65521;
    b = (b + a) % 65521;
  }
  EXPECT_EQ(big_endian(data, data.size() - 4), b << 16U | a);
  return read.out;
}

TEST(Png, HasTheHeadAndTheChecksumsOfTheStandard) {
  const std::string png = png_bytes({1, 1, {1, 2, 3}});
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1A\n");
  EXPECT_EQ(png.substr(8, 8), std::string("\0\0\0\x0DIHDR", 8));
  EXPECT_EQ(png.substr(16, 13), std::string("\0\0\0\1\0\0\0\1\x08\2\0\0\0", 13));
  // CRCs of an IHDR of 1 x 1 RGB and of IEND, as they stand in every such file.
  EXPECT_EQ(big_endian(png, 29), 0x907753DEU);
  EXPECT_EQ(png.substr(png.size() - 12), std::string("\0\0\0\0IEND\xAE\x42\x60\x82", 12));
}

TEST(Png, HoldsThePixelsOfRandomPicturesWithRunsOfEveryLength) {
  for (unsigned seed = 0; seed < 60; ++seed) {
    std::mt19937 random(seed);
    const std::size_t wide = 1 + random() % 400, high = 1 + random() % 60;
    Pixels p{wide, high, {}};
    while (p.rgb.size() < 3 * wide * high) {
      const auto value = static_cast<std::uint8_t>(random() % (seed % 2 == 0 ? 256U : 4U));
      const std::size_t run = 1 + random() % (seed % 3 == 0 ? 3U : 900U);
      for (std::size_t i = 0; i < run && p.rgb.size() < 3 * wide * high; ++i) p.rgb.push_back(value);
    }
    std::vector<std::uint8_t> rows;
    for (std::size_t y = 0; y < high; ++y) {
      rows.push_back(0);
      for (std::size_t i = 0; i < 3 * wide; ++i) rows.push_back(p.rgb[3 * wide * y + i]);
    }
    ASSERT_EQ(rows_of(png_bytes(p)), rows) << "seed " << seed;
  }
}

TEST(Png, OfABlankSheetIsSmall) {
  EXPECT_LT(png_bytes({2000, 1000, std::vector<std::uint8_t>(6'000'000, 255)}).size(), 60'000U);
}

}  // namespace
}  // namespace capstan::report::picture
