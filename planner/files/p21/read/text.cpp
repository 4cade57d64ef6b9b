#include "planner/files/p21/read/text.h"

#include <stdexcept>

#include "planner/files/p21/print.h"
#include "planner/files/p21/read/code_pages.h"

namespace capstan::p21 {
namespace detail {
namespace {

void append_utf8(std::uint32_t code, std::string& out) {
  const auto byte = [&out](std::uint32_t b) { out += static_cast<char>(static_cast<unsigned char>(b)); };
  if (code < 0x80) {
    byte(code);
  } else if (code < 0x800) {
    byte(0xC0 | code >> 6);
    byte(0x80 | (code & 0x3F));
  } else if (code < 0x10000) {
    byte(0xE0 | code >> 12);
    byte(0x80 | (code >> 6 & 0x3F));
    byte(0x80 | (code & 0x3F));
  } else {
    byte(0xF0 | code >> 18);
    byte(0x80 | (code >> 12 & 0x3F));
    byte(0x80 | (code >> 6 & 0x3F));
    byte(0x80 | (code & 0x3F));
  }
}

bool is_surrogate(std::uint32_t code) { return code >= 0xD800 && code <= 0xDFFF; }

/// One pass over the inside of a string.
class Decoder {
 public:
  Decoder(std::string_view raw, std::string& out, TextIssues& issues)
      : raw_(raw), out_(out), issues_(issues) {}

  void run() {
    while (at_ < raw_.size()) {
      const auto c = static_cast<unsigned char>(raw_[at_]);
      if (c == '\'') {
        out_ += '\'';
        at_ += 2;  // the lexer let only pairs in
      } else if (c == '\\') {
        escape();
      } else if (c >= 0x20 && c < 0x7F) {
        out_ += raw_[at_++];
      } else {
        unusual(c);
      }
    }
  }

 private:
  void warn(const char* message) {
    if (issues_.warning.message == nullptr) issues_.warning = {message, at_};
  }
  void error(const char* message) {
    if (issues_.error.message == nullptr) issues_.error = {message, at_};
  }
  [[nodiscard]] bool starts(std::string_view what) const { return raw_.substr(at_, what.size()) == what; }

  void unusual(unsigned char c) {
    if (c == '\n' || c == '\r') {
      warn("a line break inside a string is dropped");
      ++at_;
    } else if (c < 0x80) {
      if (c == 0) error("a NUL byte inside a string");
      if (c != 0) warn("a control character inside a string");
      out_ += static_cast<char>(c);
      ++at_;
    } else {
      std::uint32_t code = 0;
      std::size_t length = utf8_at(raw_, at_, code);
      if (length == 0) {
        warn("bytes above 127 that are not UTF-8 are read as ISO 8859-1");
        code = c;
        length = 1;
      }
      append_utf8(code, out_);
      at_ += length;
    }
  }

  void escape() {
    if (starts("\\\\")) {
      out_ += '\\';
      at_ += 2;
    } else if (starts("\\X2\\")) {
      wide(4);
    } else if (starts("\\X4\\")) {
      wide(8);
    } else if (starts("\\X\\")) {
      narrow();
    } else if (starts("\\S\\")) {
      shifted();
    } else if (starts("\\N\\") || starts("\\F\\")) {
      at_ += 3;
    } else if (starts("\\X0\\")) {
      error("\\X0\\ without a \\X2\\ or \\X4\\ before it");
      at_ += 4;
    } else if (starts("\\P") && at_ + 3 < raw_.size() && raw_[at_ + 3] == '\\') {
      page();
    } else {
      warn(at_ + 1 == raw_.size() ? "a lone backslash at the end of a string is kept"
                                  : "a backslash that begins no known escape is kept");
      out_ += '\\';
      ++at_;
    }
  }

  void page() {
    const char c = raw_[at_ + 2];
    if (c >= 'A' && c <= 'I') {
      page_ = static_cast<std::size_t>(c - 'A');
    } else {
      error("\\P?\\ knows the pages A to I");
    }
    at_ += 4;
  }

  void shifted() {
    if (at_ + 3 >= raw_.size()) {
      error("\\S\\ with nothing behind it");
      at_ += 3;
      return;
    }
    const auto c = static_cast<unsigned char>(raw_[at_ + 3]);
    if (c < 0x20 || c > 0x7E) {
      error("\\S\\ before a byte that is not printable ASCII");
      at_ += 3;
      return;
    }
    const std::uint32_t code = kCodePages[page_][c - 0x20U];
    if (code == 0) error("\\S\\ before a character that the chosen page does not have");
    append_utf8(code == 0 ? 0xFFFD : code, out_);
    at_ += c == '\'' ? 5 : 4;  // the quote stands doubled, else it would have ended the string
  }

  /// Reads `digits` hexadecimal digits; false when there are not as many.
  bool hex(std::size_t at, std::size_t digits, std::uint32_t& code) {
    code = 0;
    if (at + digits > raw_.size()) return false;
    for (const char c : raw_.substr(at, digits)) {
      std::uint32_t digit = 0;
      if (c >= '0' && c <= '9') {
        digit = static_cast<std::uint32_t>(c - '0');
      } else if (c >= 'A' && c <= 'F') {
        digit = static_cast<std::uint32_t>(c - 'A' + 10);
      } else if (c >= 'a' && c <= 'f') {
        digit = static_cast<std::uint32_t>(c - 'a' + 10);
        warn("lower-case hexadecimal digits in an escape");
      } else {
        return false;
      }
      code = code << 4 | digit;
    }
    return true;
  }

  void narrow() {
    std::uint32_t code = 0;
    if (!hex(at_ + 3, 2, code)) {
      error("\\X\\ without two hexadecimal digits");
      at_ += 3;
      return;
    }
    append_utf8(code, out_);
    at_ += 5;
  }

  void wide(std::size_t digits) {
    at_ += 4;
    while (!starts("\\X0\\")) {
      std::uint32_t code = 0;
      if (!hex(at_, digits, code)) {
        error(digits == 4 ? "\\X2\\ without groups of four hexadecimal digits up to \\X0\\"
                          : "\\X4\\ without groups of eight hexadecimal digits up to \\X0\\");
        return;
      }
      at_ += digits;
      std::uint32_t low = 0;
      if (digits == 4 && code >= 0xD800 && code < 0xDC00 && hex(at_, 4, low) && low >= 0xDC00 &&
          low < 0xE000) {
        warn("a surrogate pair in \\X2\\ is read as UTF-16");
        code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
        at_ += 4;
      }
      if (is_surrogate(code)) error("a lone surrogate is no character");
      if (code > 0x10FFFF) error("a code beyond U+10FFFF is no character");
      append_utf8(is_surrogate(code) || code > 0x10FFFF ? 0xFFFD : code, out_);
    }
    at_ += 4;
  }

  std::string_view raw_;
  std::string& out_;
  TextIssues& issues_;
  std::size_t at_ = 0;
  std::size_t page_ = 0;
};

}  // namespace

std::size_t utf8_at(std::string_view text, std::size_t at, std::uint32_t& code) {
  const auto byte = [&](std::size_t i) -> std::uint32_t {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0U;
  };
  const auto follows = [&](std::size_t i) { return (byte(i) & 0xC0U) == 0x80U; };
  const std::uint32_t first = byte(0);
  if (first < 0x80) {
    code = first;
    return 1;
  }
  if (first >= 0xC2 && first < 0xE0 && follows(1)) {
    code = (first & 0x1FU) << 6 | (byte(1) & 0x3FU);
    return 2;
  }
  if (first >= 0xE0 && first < 0xF0 && follows(1) && follows(2)) {
    code = (first & 0x0FU) << 12 | (byte(1) & 0x3FU) << 6 | (byte(2) & 0x3FU);
    return code >= 0x800 && !is_surrogate(code) ? 3 : 0;
  }
  if (first >= 0xF0 && first < 0xF5 && follows(1) && follows(2) && follows(3)) {
    code = (first & 0x07U) << 18 | (byte(1) & 0x3FU) << 12 | (byte(2) & 0x3FU) << 6 | (byte(3) & 0x3FU);
    return code >= 0x10000 && code <= 0x10FFFF ? 4 : 0;
  }
  return 0;
}

void decode_text(std::string_view raw, std::string& out, TextIssues& issues) {
  Decoder(raw, out, issues).run();
}

}  // namespace detail

namespace {

void append_hex(std::uint32_t code, int digits, std::string& out) {
  for (int i = digits - 1; i >= 0; --i) out += "0123456789ABCDEF"[code >> (4 * i) & 0xFU];
}

}  // namespace

std::string encode_text(std::string_view utf8) {
  std::string out;
  out.reserve(utf8.size());
  int open = 0;  // digits per character of the open \X2\ or \X4\, else 0
  for (std::size_t at = 0; at < utf8.size();) {
    std::uint32_t code = 0;
    const std::size_t length = detail::utf8_at(utf8, at, code);
    if (length == 0) throw std::logic_error("p21: text to be written is not UTF-8");
    at += length;
    const int digits = code < 0x7F ? 0 : code < 0x10000 ? 4 : 8;
    if (open != digits && open != 0) out += "\\X0\\";
    if (open != digits && digits != 0) out += digits == 4 ? "\\X2\\" : "\\X4\\";
    open = digits;
    if (digits != 0) {
      append_hex(code, digits, out);
    } else if (code < 0x20) {
      out += "\\X\\";
      append_hex(code, 2, out);
    } else {
      out.append(code == '\'' || code == '\\' ? 2U : 1U, static_cast<char>(code));
    }
  }
  if (open != 0) out += "\\X0\\";
  return out;
}

std::string quoted(std::string_view utf8) { return "'" + encode_text(utf8) + "'"; }

}  // namespace capstan::p21
