#include "planner/door/report/picture/png.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace capstan::report::picture {
namespace {

using Bytes = std::vector<std::uint8_t>;

std::uint32_t crc_of(std::string_view bytes) {
  static const std::array<std::uint32_t, 256> kTable = [] {
    std::array<std::uint32_t, 256> table{};
    for (std::uint32_t n = 0; n < 256; ++n) {
      std::uint32_t c = n;
      for (int k = 0; k < 8; ++k) c = (c & 1U) != 0 ? 0xEDB88320U ^ (c >> 1U) : c >> 1U;
      table[n] = c;
    }
    return table;
  }();
  std::uint32_t c = 0xFFFFFFFFU;
  for (const char b : bytes) c = kTable[(c ^ static_cast<std::uint8_t>(b)) & 0xFFU] ^ (c >> 8U);
  return c ^ 0xFFFFFFFFU;
}

std::uint32_t adler_of(const Bytes& bytes) {
  std::uint32_t a = 1, b = 0;
  for (const std::uint8_t byte : bytes) {
    a = (a + byte) % 65521U;
    b = (b + a) % 65521U;
  }
  return b << 16U | a;
}

void append_big_endian(std::string& out, std::uint32_t v) {
  for (const unsigned shift : {24U, 16U, 8U, 0U}) out += static_cast<char>(v >> shift & 0xFFU);
}

void append_chunk(std::string& out, std::string_view type, std::string_view data) {
  append_big_endian(out, static_cast<std::uint32_t>(data.size()));
  std::string named(type);
  named += data;
  out += named;
  append_big_endian(out, crc_of(named));
}

/// Bits from the lowest of each byte on.
class BitWriter {
 public:
  explicit BitWriter(std::string& out) : out_(out) {}
  void bits(std::uint32_t value, unsigned count) {
    held_ |= static_cast<std::uint64_t>(value) << held_bits_;
    held_bits_ += count;
    for (; held_bits_ >= 8; held_bits_ -= 8, held_ >>= 8U) out_ += static_cast<char>(held_ & 0xFFU);
  }
  /// A Huffman code, which stands with its highest bit first.
  void code(std::uint32_t value, unsigned count) {
    std::uint32_t turned = 0;
    for (unsigned i = 0; i < count; ++i) turned |= (value >> i & 1U) << (count - 1 - i);
    bits(turned, count);
  }
  void finish() {
    if (held_bits_ > 0) bits(0, 8 - held_bits_);
  }

 private:
  std::string& out_;
  std::uint64_t held_ = 0;
  unsigned held_bits_ = 0;
};

/// Literals and lengths by the fixed code (RFC 1951, 3.2.6).
void write_symbol(BitWriter& to, unsigned symbol) {
  if (symbol < 144) {
    to.code(0x30U + symbol, 8);
  } else if (symbol < 256) {
    to.code(0x190U + symbol - 144, 9);
  } else if (symbol < 280) {
    to.code(symbol - 256, 7);
  } else {
    to.code(0xC0U + symbol - 280, 8);
  }
}

/// A range of lengths or distances: its least, and the bits that say where in it (RFC 1951, 3.2.5).
struct Range {
  unsigned least, extra_bits;
};
/// Lengths from 3 on: four ranges for each number of extra bits; 258 has a range of its own.
const std::vector<Range>& length_ranges() {
  static const std::vector<Range> kRanges = [] {
    std::vector<Range> out;
    unsigned least = 3;
    for (unsigned i = 0; i < 28; ++i) {
      const unsigned bits = i < 8 ? 0 : i / 4 - 1;
      out.push_back({least, bits});
      least += 1U << bits;
    }
    out.push_back({258, 0});
    return out;
  }();
  return kRanges;
}
/// Distances from 1 on: two ranges for each number of extra bits.
const std::vector<Range>& distance_ranges() {
  static const std::vector<Range> kRanges = [] {
    std::vector<Range> out;
    unsigned least = 1;
    for (unsigned i = 0; i < 30; ++i) {
      const unsigned bits = i < 4 ? 0 : i / 2 - 1;
      out.push_back({least, bits});
      least += 1U << bits;
    }
    return out;
  }();
  return kRanges;
}
std::size_t range_of(const std::vector<Range>& ranges, unsigned v) {
  const auto above = std::upper_bound(ranges.begin(), ranges.end(), v,
                                      [](unsigned x, const Range& r) { return x < r.least; });
  return static_cast<std::size_t>(above - ranges.begin()) - 1;
}

void write_copy(BitWriter& to, unsigned length, unsigned distance) {
  const std::size_t l = range_of(length_ranges(), length), d = range_of(distance_ranges(), distance);
  write_symbol(to, 257 + static_cast<unsigned>(l));
  to.bits(length - length_ranges()[l].least, length_ranges()[l].extra_bits);
  to.code(static_cast<std::uint32_t>(d), 5);
  to.bits(distance - distance_ranges()[d].least, distance_ranges()[d].extra_bits);
}

/// Where three bytes stood before, the latest first, by chains of places with the same hash.
class EarlierPlaces {
 public:
  explicit EarlierPlaces(const Bytes& bytes)
      : bytes_(bytes), last_(kHashes, kNone), before_(kWindow, kNone) {}
  /// The longest copy for a place, and its distance; no longer than 2 is none.
  [[nodiscard]] std::pair<std::size_t, std::size_t> find(std::size_t at) const {
    std::pair<std::size_t, std::size_t> best{0, 0};
    const std::size_t most = std::min(kLongest, bytes_.size() - at);
    if (most < 3) return best;
    std::size_t from = last_[hash(at)];
    for (int tries = 0; tries < kTries && from != kNone && at - from < kWindow; ++tries) {
      std::size_t n = 0;
      while (n < most && bytes_[from + n] == bytes_[at + n]) ++n;
      if (n > best.first) best = {n, at - from};
      if (n == most) break;
      const std::size_t next = before_[from % kWindow];
      if (next == kNone || next >= from) break;
      from = next;
    }
    return best;
  }
  void add(std::size_t at) {
    if (bytes_.size() - at < 3) return;
    std::size_t& last = last_[hash(at)];
    before_[at % kWindow] = last;
    last = at;
  }

 private:
  static constexpr std::size_t kNone = static_cast<std::size_t>(-1), kHashes = 1U << 15U, kWindow = 1U << 15U,
                               kLongest = 258;
  static constexpr int kTries = 24;
  [[nodiscard]] std::size_t hash(std::size_t at) const {
    const std::uint32_t v = static_cast<std::uint32_t>(bytes_[at]) |
                            static_cast<std::uint32_t>(bytes_[at + 1]) << 8U |
                            static_cast<std::uint32_t>(bytes_[at + 2]) << 16U;
    return v * 2654435761U >> 17U;
  }
  const Bytes& bytes_;
  std::vector<std::size_t> last_, before_;
};

/// A zlib stream of one block.
std::string zlib_of(const Bytes& bytes) {
  std::string out = "\x78\x01";  // deflate, window of 32 KiB, fastest
  BitWriter to(out);
  to.bits(1, 1);  // the last block
  to.bits(1, 2);  // of the fixed code
  EarlierPlaces earlier(bytes);
  for (std::size_t at = 0; at < bytes.size();) {
    const auto [length, distance] = earlier.find(at);
    const std::size_t step = std::max<std::size_t>(1, length > 2 ? length : 1);
    if (step == 1) {
      write_symbol(to, bytes[at]);
    } else {
      write_copy(to, static_cast<unsigned>(length), static_cast<unsigned>(distance));
    }
    for (const std::size_t end = at + step; at < end; ++at) earlier.add(at);
  }
  write_symbol(to, 256);
  to.finish();
  append_big_endian(out, adler_of(bytes));
  return out;
}

}  // namespace

std::string png_bytes(const Pixels& p) {
  std::string head;
  append_big_endian(head, static_cast<std::uint32_t>(p.wide));
  append_big_endian(head, static_cast<std::uint32_t>(p.high));
  for (const int b : {8, 2, 0, 0, 0}) head += static_cast<char>(b);  // 8 bits, RGB; not interlaced
  Bytes rows;
  rows.reserve(p.rgb.size() + p.high);
  for (std::size_t y = 0; y < p.high; ++y) {
    rows.push_back(0);  // no filter
    const auto from = p.rgb.begin() + static_cast<std::ptrdiff_t>(3 * p.wide * y);
    rows.insert(rows.end(), from, from + static_cast<std::ptrdiff_t>(3 * p.wide));
  }
  std::string out = "\x89PNG\r\n\x1A\n";
  append_chunk(out, "IHDR", head);
  append_chunk(out, "IDAT", zlib_of(rows));
  append_chunk(out, "IEND", {});
  return out;
}

}  // namespace capstan::report::picture
