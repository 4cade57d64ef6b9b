#include "tooling/library/words/comment_words.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/plan/assumed_tool_material.h"

namespace capstan::tooling {
namespace {

using model::CutterClass;

bool holds(const std::string& text, const char* word) { return text.find(word) != std::string::npos; }

bool digit(char c) { return c >= '0' && c <= '9'; }
/// A byte of an umlaut counts as a letter.
bool letter(char c) { return (c >= 'a' && c <= 'z') || static_cast<unsigned char>(c) >= 0x80; }

/// True if the text at this position is a word of its own: no letters beside it.
bool word_at(const std::string& text, std::size_t at, std::size_t size) {
  return (at == 0 || !letter(text[at - 1])) && (at + size >= text.size() || !letter(text[at + size]));
}

constexpr int kMostTeeth = 12;  // of a cutter that a comment counts them of; default, unsourced

/// Whether it is the number of teeth: one to twelve, no part of a size ("1/4 fl", "0.5 flutes").
int small_number(const std::string& text, std::size_t from, std::size_t end) {
  if (end <= from || end - from > 2) return 0;
  if (from > 0 &&
      (letter(text[from - 1]) || std::string_view("./,").find(text[from - 1]) != std::string_view::npos))
    return 0;
  const int n = std::stoi(text.substr(from, end - from));
  return n <= kMostTeeth ? n : 0;
}

/// The number that ends before a place: in digits, or in words ("four", "vier").
int number_before(const std::string& text, std::size_t at) {
  while (at > 0 && (text[at - 1] == ' ' || text[at - 1] == '-')) --at;
  std::size_t from = at;
  while (from > 0 && digit(text[from - 1])) --from;
  if (from < at) return small_number(text, from, at);
  constexpr std::pair<std::string_view, int> kNumbers[] = {
      {"single", 1},      {"one", 1},   {"two", 2},   {"double", 2}, {"three", 3}, {"four", 4},
      {"five", 5},        {"six", 6},   {"ein", 1},   {"zwei", 2},   {"drei", 3},  {"vier", 4},
      {"f\xC3\xBCnf", 5}, {"fuenf", 5}, {"sechs", 6}, {"eight", 8},  {"acht", 8}};
  while (from > 0 && letter(text[from - 1])) --from;
  const std::string_view said = std::string_view(text).substr(from, at - from);
  for (const auto& [name, n] : kNumbers)
    if (said == name) return n;
  return 0;
}

/// "4 flute", "3fl", "two flutes", "4 Schneiden", "vierschneidig", "Z4", "z=3". Two that differ say nothing.
int teeth_from_words(const std::string& text) {
  std::vector<int> said;
  const auto add = [&](int n) {
    if (n > 0) said.push_back(n);
  };
  for (const std::string_view word :
       {"fl", "flt", "flts", "flute", "flutes", "fluted", "tooth", "teeth", "lip", "lips", "zahn",
        "z\xC3\xA4hne", "zaehne", "schneider", "schneide", "schneiden", "schneidig", "schneidiger"}) {
    for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
      const bool ends = at + word.size() >= text.size() || !letter(text[at + word.size()]);
      if (ends) add(number_before(text, at));
    }
  }
  for (auto at = text.find('z'); at != std::string::npos; at = text.find('z', at + 1)) {
    std::size_t from = at + 1;
    if (at > 0 && (letter(text[at - 1]) || digit(text[at - 1]))) continue;
    // "z4", "z = 4"; "z 12" is a height.
    if (const auto sign = text.find_first_not_of(' ', from); sign != std::string::npos && text[sign] == '=')
      from = std::min(text.find_first_not_of(' ', sign + 1), text.size());
    std::size_t end = from;
    while (end < text.size() && digit(text[end])) ++end;
    if (end == from || end - from > 2) continue;
    // "z 20 mm" is a length.
    const auto next = text.find_first_not_of(' ', end);
    const bool whole = next == std::string::npos || (!letter(text[next]) && text[next] != '.') ||
                       (next > end && text[next] != 'm');
    const int n = std::stoi(text.substr(from, end - from));
    if (whole && n <= kMostTeeth) add(n);
  }
  for (const int n : said)
    if (n != said.front()) return 0;
  return said.empty() ? 0 : said.front();
}

/// Material of the edges; if both are named ("HSS, carbide tipped") the slower one.
/// What a plan's own table says that it assumes is nobody's statement.
std::optional<model::Substrate> substrate_from_words(std::string text) {
  for (const auto s : {model::Substrate::kCarbide, model::Substrate::kHss}) {
    const std::string words = std::string(model::kAssumedWord) + std::string(model::to_text(s));
    for (auto at = text.find(words); at != std::string::npos; at = text.find(words))
      text.erase(at, words.size());
  }
  for (auto at = text.find("hss"); at != std::string::npos; at = text.find("hss", at + 1)) {
    // "HSS", "HSSE", "HSS-Co5", "HSSPM"; no part of another word.
    if (at == 0 || !letter(text[at - 1])) return model::Substrate::kHss;
  }
  for (const char* word : {"high speed steel", "high-speed steel", "schnellarbeitsstahl", "schnellstahl"})
    if (holds(text, word)) return model::Substrate::kHss;
  for (const char* word : {"carbide", "vhm", "hartmetall", "metal duro"})
    if (holds(text, word)) return model::Substrate::kCarbide;
  for (auto at = text.find("hm"); at != std::string::npos; at = text.find("hm", at + 1))
    if (word_at(text, at, 2)) return model::Substrate::kCarbide;
  if (holds(text, "cobalt")) return model::Substrate::kHss;  // of a bare "cobalt drill"
  return std::nullopt;
}

}  // namespace

std::optional<CutterClass> class_from_words(std::string_view comment) {
  return model::cutter_class_called(lower_text(comment));
}

CommentWords words_of_comment(std::string_view comment, CutterClass c, double diameter_mm,
                              double mm_per_unit) {
  const std::string words = lower_text(comment);
  CommentWords out;
  out.substrate = substrate_from_words(words);
  out.teeth = teeth_from_words(words);
  out.sizes = sizes_of_words(words, c, diameter_mm, mm_per_unit);
  return out;
}

}  // namespace capstan::tooling
