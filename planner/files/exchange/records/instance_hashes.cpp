#include "planner/files/exchange/records/instance_hashes.h"

#include <algorithm>
#include <vector>

#include "planner/files/p21/print.h"
#include "planner/ground/base/append_number.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/stopping.h"

namespace capstan::exchange {

using p21::Kind;
using p21::Value;

namespace {

using p21::quoted;

void refers_to(const Value& v, const std::set<std::uint64_t>& numbers, std::set<std::uint64_t>& out) {
  if (v.is(Kind::kReference) && numbers.contains(v.reference())) out.insert(v.reference());
  for (std::size_t i = 0; i < v.size(); ++i) refers_to(v[i], numbers, out);
}

void add_texts(const Value& v, std::string& out) {
  if (v.is(Kind::kString)) out += quoted(v.as_text());
  for (std::size_t i = 0; i < v.size(); ++i) add_texts(v[i], out);
}

}  // namespace

namespace {

bool all_digits(std::string_view s) {
  bool good = true;
  for (const char c : s) good = good && c >= '0' && c <= '9';
  return good;
}

/// Whether a real is spelled as `part21_real` spells it, which few are not: no sign but -, no zero in front
/// or behind, no exponent, at most 15 digits (no other of so few is the same double), and between 0.001 and
/// 1e5, where the fixed notation is the shortest.
bool spelled_shortest(std::string_view lexeme) {
  constexpr std::size_t kDigits = 15, kMostWhole = 5;
  if (lexeme.starts_with('-')) lexeme.remove_prefix(1);
  const std::size_t point = lexeme.find('.');
  if (point == 0 || point > kMostWhole || lexeme.size() > kDigits) return false;
  const std::string_view whole = lexeme.substr(0, point), decimals = lexeme.substr(point + 1);
  if (!all_digits(whole) || !all_digits(decimals)) return false;
  if (!decimals.empty() && decimals.back() == '0') return false;
  if (lexeme.front() != '0') return true;
  return point == 1 && decimals.substr(0, 3).find_first_not_of('0') != std::string_view::npos;
}

}  // namespace

void spell(const Value& v, std::string& out) {
  switch (v.kind()) {
    case Kind::kReal:
      if (const std::string_view lexeme = v.lexeme(); spelled_shortest(lexeme)) {
        out += lexeme;
      } else {
        append_part21_real(out, v.as_real());
      }
      return;
    case Kind::kString: {
      std::string buffer;
      const std::string_view text = v.as_text(buffer);
      if (text.data() == v.lexeme().data()) {  // nothing in it is escaped
        out.append(1, '\'').append(text).append(1, '\'');
      } else {
        out += quoted(text);
      }
      return;
    }
    case Kind::kEnumeration:
      out.append(1, '.').append(v.enumeration()).append(1, '.');
      return;
    case Kind::kReference:
      if (const std::string_view lexeme = v.lexeme(); lexeme[1] != '0') {
        out += lexeme;
      } else {
        out.append(1, '#').append(std::to_string(v.reference()));
      }
      return;
    case Kind::kInteger:
      out += std::to_string(v.as_integer());
      return;
    case Kind::kList:
    case Kind::kTyped:
      if (v.is(Kind::kTyped)) out += v.keyword();
      out += '(';
      for (std::size_t i = 0; i < v.size(); ++i) {
        if (i != 0) out += ',';
        spell(v[i], out);
      }
      out += ')';
      return;
    case Kind::kOmitted:
    case Kind::kDerived:
    case Kind::kBinary:
      out += v.lexeme();
      return;
  }
}

std::string spelled(const Value& v) {
  std::string out;
  spell(v, out);
  return out;
}

std::map<std::uint64_t, std::string> hashes_of(const p21::File& file,
                                               const std::set<std::uint64_t>& numbers) {
  std::map<std::uint64_t, std::string> out;
  if (numbers.empty()) return out;
  std::map<std::uint64_t, std::vector<std::string>> named_by;
  for (const p21::Instance i : file) {
    tick();
    std::set<std::uint64_t> to;
    for (std::size_t k = 0; k < i.part_count(); ++k) refers_to(i.part(k).parameters, numbers, to);
    if (to.empty()) continue;
    std::string names;
    for (std::size_t k = 0; k < i.part_count(); ++k) {
      names += i.part(k).keyword;
      add_texts(i.part(k).parameters, names);
    }
    for (const std::uint64_t n : to) named_by[n].push_back(names);
  }
  for (const std::uint64_t n : numbers) {
    tick();
    const auto instance = file.find(n);
    if (!instance) continue;
    std::string text;
    for (std::size_t k = 0; k < instance->part_count(); ++k)
      text += std::string(instance->part(k).keyword) + spelled(instance->part(k).parameters);
    auto& names = named_by[n];
    std::sort(names.begin(), names.end());
    for (const std::string& name : names) text += " " + name;
    out[n] = hex64(fnv1a(text));
  }
  return out;
}

}  // namespace capstan::exchange
