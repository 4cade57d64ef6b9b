#include "planner/files/exchange/records/instance_hashes.h"

#include <algorithm>
#include <vector>

#include "planner/files/p21/print.h"
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

std::string spelled(const Value& v) {
  switch (v.kind()) {
    case Kind::kReal:
      return part21_real(v.as_real());
    case Kind::kString:
      return quoted(v.as_text());
    case Kind::kEnumeration:
      return "." + std::string(v.enumeration()) + ".";
    case Kind::kReference:
      return "#" + std::to_string(v.reference());
    case Kind::kInteger:
      return std::to_string(v.as_integer());
    case Kind::kList:
    case Kind::kTyped: {
      std::string out = v.is(Kind::kTyped) ? std::string(v.keyword()) + "(" : "(";
      for (std::size_t i = 0; i < v.size(); ++i) out += (i == 0 ? "" : ",") + spelled(v[i]);
      return out + ")";
    }
    case Kind::kOmitted:
    case Kind::kDerived:
    case Kind::kBinary:
      return std::string(v.lexeme());
  }
  return {};
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
