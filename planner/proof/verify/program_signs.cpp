#include "planner/proof/verify/program_signs.h"

#include <algorithm>
#include <array>
#include <cctype>

#include "planner/proof/verify/program/readers.h"

namespace capstan::verify {
namespace {

constexpr std::string_view kFanuc = "fanuc", kHaas = "haas", kLinuxCnc = "linuxcnc", kSiemens = "siemens";
constexpr std::size_t kMostOfABlock = 256;  // characters; a longer one is no block of any control

bool digit(char c) { return c >= '0' && c <= '9'; }

/// A block in capitals, without spaces, comments, skip mark and number.
std::string bare(std::string_view line) {
  std::string out;
  int depth = 0;
  for (const char c : line.substr(0, kMostOfABlock)) {
    if (c == '(') ++depth;
    if (c == ')') depth = std::max(0, depth - 1);
    if (depth > 0 || c == ')') continue;
    if (c == ';') break;
    if (std::isspace(static_cast<unsigned char>(c)) == 0)
      out += static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  }
  if (!out.empty() && out.front() == '/') out.erase(0, 1);
  if (!out.empty() && out.front() == 'N') {
    std::size_t n = 1;
    while (n < out.size() && digit(out[n])) ++n;
    out.erase(0, n);
  }
  return out;
}

/// Where a word begins, so that what follows is no further digit or decimal of it.
std::size_t find_word(const std::string& block, std::string_view word) {
  for (std::size_t at = block.find(word); at != std::string::npos; at = block.find(word, at + 1)) {
    const std::size_t end = at + word.size();
    if (end >= block.size() || !(digit(block[end]) || block[end] == '.')) return at;
  }
  return std::string::npos;
}

/// Whether an address with a value stands in a block: the letter, and behind it a number, a parameter or an
/// expression.
bool has_address(const std::string& block, std::string_view letter) {
  for (std::size_t at = block.find(letter); at != std::string::npos; at = block.find(letter, at + 1)) {
    const std::size_t next = at + letter.size();
    if (next < block.size() &&
        std::string_view("0123456789.+-#[").find(block[next]) != std::string_view::npos)
      return true;
  }
  return false;
}

/// O<name> or O100 with a keyword behind it, as LinuxCNC's subroutines and loops begin.
bool is_o_word(const std::string& block) {
  if (block.size() > 1 && block[1] == '<') return true;
  std::size_t n = 1;
  while (n < block.size() && digit(block[n])) ++n;
  constexpr std::array<std::string_view, 14> kKeywords = {
      "SUB",      "ENDSUB", "CALL",   "IF",        "ELSE",     "ENDIF", "WHILE",
      "ENDWHILE", "DO",     "REPEAT", "ENDREPEAT", "CONTINUE", "BREAK", "RETURN"};
  return n > 1 && std::any_of(kKeywords.begin(), kKeywords.end(), [&](std::string_view keyword) {
           return std::string_view(block).substr(n).starts_with(keyword);
         });
}

struct Word {
  std::string_view word, other;  ///< `other`: an address that must stand in the block, too; empty: none need
  std::vector<std::string_view> dialects;
  std::string_view what;
};

const std::array<Word, 10>& words() {
  static const std::array<Word, 10> kWords = {{
      {"CYCLE832", "", {kSiemens}, "a tolerance"},
      {"MCALL", "", {kSiemens}, "a modal call"},
      {"SUPA", "", {kSiemens}, "a place in machine coordinates"},
      {"G54.1", "P", {kFanuc, kHaas}, "an extended work offset"},
      {"M29", "S", {kFanuc, kHaas}, "rigid tapping"},
      {"G5.1", "Q", {kFanuc}, "look-ahead"},
      {"G05.1", "Q", {kFanuc}, "look-ahead"},
      {"G187", "", {kHaas}, "smoothness"},
      {"G154", "P", {kHaas}, "an extended work offset"},
      {"G64", "P", {kLinuxCnc}, "a path tolerance"},
  }};
  return kWords;
}

std::optional<DialectSign> of_block(const std::string& block) {
  if (block.size() > 1 && block.front() == 'O') {
    const bool number = std::all_of(block.begin() + 1, block.end(), digit);
    if (number) return DialectSign{{kFanuc, kHaas}, block + ", a program number", 0};
    if (is_o_word(block)) return DialectSign{{kLinuxCnc}, block.substr(0, 20) + ", an O-word", 0};
  }
  for (const DialectReader& reader : readers()) {
    if (!reader.sign.empty() && block.find(reader.sign) != std::string::npos)
      return DialectSign{{reader.dialect}, std::string(reader.sign_meaning), 0};
  }
  if (block.find("#<") != std::string::npos) return DialectSign{{kLinuxCnc}, "#<...>, a named parameter", 0};
  for (const Word& w : words()) {
    if (find_word(block, w.word) == std::string::npos) continue;
    if (!w.other.empty() && !has_address(block, w.other)) continue;
    return DialectSign{w.dialects, std::string(w.word) + ", " + std::string(w.what), 0};
  }
  return std::nullopt;
}

}  // namespace

std::optional<DialectSign> dialect_sign(std::string_view program) {
  std::optional<DialectSign> found;
  long line = 0;
  while (!program.empty()) {
    const std::size_t end = program.find('\n');
    ++line;
    auto sign = of_block(bare(program.substr(0, end)));
    // A Haas begins with a number as a Fanuc does; what only one of them reads tells them apart.
    const bool closer = sign && (!found || (sign->dialects.size() < found->dialects.size() &&
                                            std::find(found->dialects.begin(), found->dialects.end(),
                                                      sign->dialects.front()) != found->dialects.end()));
    if (closer) {
      found = std::move(sign);
      found->line = line;
    }
    if (found && found->dialects.size() == 1) break;
    if (end == std::string_view::npos) break;
    program.remove_prefix(end + 1);
  }
  return found;
}

std::vector<std::string> steps_of_program(std::string_view text, const model::Machine& machine) {
  const DialectReader* reader = reader_of(machine.control.dialect);
  std::vector<std::string> out;
  if (reader == nullptr) return out;
  for (const StepMarker& m : reader->program(text, machine).markers) out.push_back(m.id);
  return out;
}

}  // namespace capstan::verify
