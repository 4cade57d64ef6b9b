#include "planner/files/json/ids.h"

#include <charconv>
#include <cstdint>
#include <limits>

namespace capstan::json {
namespace {

// A count from 1, without signs and leading zeros.
std::optional<std::uint32_t> number_of(std::string_view text) {
  if (text.empty() || text.front() < '1' || text.front() > '9') return std::nullopt;
  std::uint32_t value = 0;
  const auto [end, ec] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (ec != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value - 1;
}

}  // namespace

std::string kind_name(model::TypeId t) {
  std::string out(model::noun_type(t).keyword);
  for (char& c : out) c = c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  return out;
}

std::optional<model::TypeId> kind_from_name(std::string_view name) {
  std::string keyword(name);
  for (char& c : keyword) {
    if (c >= 'A' && c <= 'Z') return std::nullopt;
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return model::find_noun(keyword);
}

std::string object_id(model::AnyRef r) {
  return kind_name(r.type) + ":" + std::to_string(std::uint64_t{r.index} + 1);
}

std::optional<model::AnyRef> object_from_id(std::string_view id) {
  const auto colon = id.find(':');
  if (colon == std::string_view::npos) return std::nullopt;
  const auto kind = kind_from_name(id.substr(0, colon));
  const auto number = number_of(id.substr(colon + 1));
  if (!kind || !number) return std::nullopt;
  return model::AnyRef{*kind, *number};
}

std::string shared_id(std::string_view what, std::size_t index) {
  return std::string(what) + ":" + std::to_string(index + 1);
}

std::optional<std::size_t> shared_from_id(std::string_view what, std::string_view id) {
  if (id.size() <= what.size() || id.substr(0, what.size()) != what || id[what.size()] != ':')
    return std::nullopt;
  return number_of(id.substr(what.size() + 1));
}

}  // namespace capstan::json
