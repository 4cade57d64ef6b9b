#include "planner/files/json/printer.h"

#include <array>
#include <bit>
#include <charconv>
#include <cstddef>

#include "planner/ground/base/append_number.h"
#include "planner/ground/base/text.h"

namespace capstan::json {
namespace {

constexpr std::string_view kHex = "0123456789abcdef";

unsigned char byte_at(std::string_view s, std::size_t i) {
  return i < s.size() ? static_cast<unsigned char>(s[i]) : 0;
}

bool continues(unsigned char c) { return (c & 0xC0U) == 0x80U; }

// U+10FF00 .. U+10FFFF: F4 8F BC..BF 80..BF.
bool stands_for_byte(std::string_view s, std::size_t i) {
  return byte_at(s, i) == 0xF4 && byte_at(s, i + 1) == 0x8F && byte_at(s, i + 2) >= 0xBC &&
         continues(byte_at(s, i + 2)) && continues(byte_at(s, i + 3));
}

void put_byte(std::string& out, unsigned char byte) {
  out += "\xF4\x8F";
  out += static_cast<char>(0xBCU + (byte >> 6U));
  out += static_cast<char>(0x80U + (byte & 0x3FU));
}

/// Whether a character stands for itself in a string.
bool is_plain(char c) {
  return static_cast<unsigned char>(c) >= 0x20 && static_cast<unsigned char>(c) < 0x7F && c != '"' &&
         c != '\\';
}

void put_ascii(std::string& out, char c) {
  if (c == '"' || c == '\\') {
    out += '\\';
    out += c;
  } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7F) {
    out += "\\u00";
    out += kHex[static_cast<unsigned char>(c) >> 4U];
    out += kHex[static_cast<unsigned char>(c) & 15U];
  } else {
    out += c;
  }
}

}  // namespace

std::string quoted(std::string_view bytes) {
  std::string out = "\"";
  out.reserve(bytes.size() + 2);
  for (std::size_t i = 0; i < bytes.size();) {
    const std::size_t from = i;
    while (i < bytes.size() && is_plain(bytes[i])) ++i;
    out.append(bytes, from, i - from);
    if (i == bytes.size()) break;
    const std::size_t n = utf8_length(bytes, i);
    if (n == 1) {
      put_ascii(out, bytes[i++]);
    } else if (n == 0 || stands_for_byte(bytes, i)) {
      for (std::size_t k = 0; k < (n == 0 ? 1 : n); ++k) put_byte(out, byte_at(bytes, i++));
    } else {
      out += bytes.substr(i, n);
      i += n;
    }
  }
  return out += '"';
}

std::string unquoted_bytes(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (std::size_t i = 0; i < text.size();) {
    if (stands_for_byte(text, i)) {
      out += static_cast<char>((byte_at(text, i + 2) - 0xBC) * 64 + (byte_at(text, i + 3) - 0x80));
      i += 4;
    } else {
      out += text[i++];
    }
  }
  return out;
}

void Printer::next() {
  if (after_key_) {
    after_key_ = false;
    return;
  }
  if (levels_.empty()) return;
  Level& level = levels_.back();
  if (!level.empty) out_ += ',';
  level.empty = false;
  if (level.in_lines) {
    out_ += '\n';
    out_.append(levels_.size(), ' ');
  }
}

void Printer::open(char bracket, bool in_lines) {
  next();
  out_ += bracket;
  const bool lines = in_lines && (levels_.empty() || levels_.back().in_lines);
  levels_.push_back({bracket == '{' ? '}' : ']', lines});
}

void Printer::close() {
  const Level level = levels_.back();
  levels_.pop_back();
  if (level.in_lines && !level.empty) {
    out_ += '\n';
    out_.append(levels_.size(), ' ');
  }
  out_ += level.close;
}

void Printer::key(std::string_view name) {
  next();
  out_ += quoted(name);
  out_ += ':';
  after_key_ = true;
}

void Printer::text(std::string_view bytes) {
  next();
  out_ += quoted(bytes);
}
void Printer::number(double v) {
  next();
  append_shortest(out_, v);
}
void Printer::integer(std::int64_t v) {
  next();
  out_ += std::to_string(v);
}
void Printer::natural(std::uint64_t v) {
  next();
  out_ += std::to_string(v);
}
void Printer::numbers(std::span<const double> column) {
  open('[', false);
  // Neighbours are often equal: feeds, depths, centres of no arc.
  std::array<char, kNumberRoom> text;
  std::size_t length = 0;
  std::uint64_t before = 0;
  for (const double v : column) {
    const auto bits = std::bit_cast<std::uint64_t>(v);
    if (length == 0) {
      levels_.back().empty = false;
    } else {
      out_ += ',';
    }
    if (length == 0 || bits != before) {
      length = static_cast<std::size_t>(print_shortest(text.data(), v) - text.data());
      before = bits;
    }
    out_.append(text.data(), length);
  }
  close();
}
void Printer::naturals(std::span<const std::uint32_t> column) {
  open('[', false);
  std::array<char, kNumberRoom> text;
  for (const std::uint32_t v : column) {
    if (!levels_.back().empty) out_ += ',';
    levels_.back().empty = false;
    out_.append(text.data(), std::to_chars(text.data(), text.data() + text.size(), v).ptr);
  }
  close();
}
void Printer::boolean(bool v) {
  next();
  out_ += v ? "true" : "false";
}
void Printer::null() {
  next();
  out_ += "null";
}

std::string Printer::take() {
  out_ += '\n';
  return std::move(out_);
}

}  // namespace capstan::json
