#include "planner/proof/verify/program_signs.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

#include "planner/proof/verify/program/readers.h"

namespace capstan::verify {
namespace {

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

/// What a block says of it, for people; empty: not this sign.
std::string found(const Sign& sign, const std::string& block) {
  const bool o = block.size() > 1 && block.front() == 'O';
  const std::string_view what = sign.what;
  switch (sign.of) {
    case Sign::Of::kProgramNumber:
      if (!o || !std::all_of(block.begin() + 1, block.end(), digit)) return {};
      return block + ", " + std::string(what);
    case Sign::Of::kOWord:
      if (!o || !is_o_word(block)) return {};
      return block.substr(0, 20) + ", " + std::string(what);
    case Sign::Of::kText:
      return block.find(sign.text) != std::string::npos ? std::string(what) : std::string();
    case Sign::Of::kWord:
      if (find_word(block, sign.text) == std::string::npos) return {};
      if (!sign.other.empty() && !has_address(block, sign.other)) return {};
      return std::string(sign.text) + ", " + std::string(what);
  }
  return {};
}

std::optional<DialectSign> of_block(const std::string& block) {
  for (const auto of : {Sign::Of::kProgramNumber, Sign::Of::kOWord, Sign::Of::kText, Sign::Of::kWord}) {
    for (const DialectReader& reader : readers()) {
      for (const Sign& sign : reader.signs) {
        if (sign.of != of) continue;
        std::string text = found(sign, block);
        if (text.empty()) continue;
        DialectSign out{{}, std::move(text), 0};
        for (const DialectReader& r : readers())
          if (std::find(r.signs.begin(), r.signs.end(), sign) != r.signs.end())
            out.dialects.push_back(r.dialect);
        return out;
      }
    }
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

std::string machine_of_program(std::string_view program) {
  constexpr std::string_view kHead = "MACHINE: ", kMarker = "CAPSTAN STEP";
  const auto begins = [](std::string_view text, std::string_view with) {
    const auto same = [](char a, char b) { return (a >= 'a' && a <= 'z' ? a - 'a' + 'A' : a) == b; };
    return text.size() >= with.size() &&
           std::equal(with.begin(), with.end(), text.begin(), [&](char b, char a) { return same(a, b); });
  };
  while (!program.empty()) {
    std::string_view line = program.substr(0, program.find('\n'));
    program.remove_prefix(std::min(line.size() + 1, program.size()));
    // A comment of any control: (text), ;text, or behind the number of a line.
    line.remove_prefix(std::min(line.find_first_not_of("0123456789 \t"), line.size()));
    if (line.empty() || (line.front() != '(' && line.front() != ';')) continue;
    line.remove_prefix(std::min(line.find_first_not_of("(; \t"), line.size()));
    if (begins(line, kMarker)) break;
    if (!begins(line, kHead)) continue;
    line.remove_prefix(kHead.size());
    line = line.substr(0, line.find_first_of(")\r"));
    return std::string(line.substr(0, line.find_last_not_of(" \t") + 1));
  }
  return {};
}

std::vector<std::string> steps_of_program(std::string_view text, const model::Machine& machine) {
  const DialectReader* reader = reader_of(machine.control.dialect);
  std::vector<std::string> out;
  if (reader == nullptr) return out;
  for (const StepMarker& m : reader->program(text, machine).markers) out.push_back(m.id);
  return out;
}

}  // namespace capstan::verify
