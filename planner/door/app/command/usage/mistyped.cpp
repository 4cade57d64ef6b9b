#include "planner/door/app/command/usage/mistyped.h"

#include <algorithm>
#include <string_view>
#include <vector>

#include "planner/ground/base/nearest_names.h"

namespace capstan::app {
namespace {

constexpr std::string_view kDiagnostics = "--diagnostics";

/// Where a command line has come to: a command and those that it lies in, whose options count, too.
struct Place {
  std::vector<const CommandText*> commands;
  std::string called = "capstan";

  [[nodiscard]] const CommandText& now() const { return *commands.back(); }
  [[nodiscard]] std::string help() const { return called + " --help"; }
};

const OptionText* find_option(const Place& at, std::string_view name, std::vector<std::string>& known) {
  for (auto c = at.commands.rbegin(); c != at.commands.rend(); ++c) {
    for (const OptionText& o : (*c)->options) {
      if (o.positional) continue;
      if (std::find(o.names.begin(), o.names.end(), name) != o.names.end()) return &o;
      known.insert(known.end(), o.names.begin(), o.names.end());
    }
  }
  return nullptr;
}

std::optional<Diagnostic> wrong_choice(const Place& at, const OptionText& o, std::string_view value) {
  if (o.choices.empty() || o.open || std::find(o.choices.begin(), o.choices.end(), value) != o.choices.end())
    return std::nullopt;
  Diagnostic d = unknown_name("value of " + o.names.back(), value, o.choices, at.help());
  for (const std::string& c : o.choices) d.expected += (d.expected.empty() ? "" : ", ") + c;
  return d;
}

}  // namespace

std::optional<Diagnostic> mistyped(const CommandText& all, std::span<const char* const> words) {
  Place at{{&all}, "capstan"};
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word == "--") return std::nullopt;
    if (word.size() > 1 && word.front() == '-') {
      const bool whole = word.starts_with("--");
      const auto sign = whole ? word.find('=') : std::string_view::npos;
      const std::string_view name = whole ? word.substr(0, sign) : word.substr(0, 2);
      std::vector<std::string> known;
      const OptionText* o = find_option(at, name, known);
      if (o == nullptr) return unknown_name("option", name, known, at.help());
      if (o->value.empty()) continue;
      const bool joined = sign != std::string_view::npos || (!whole && word.size() > 2);
      if (!joined && ++i == words.size()) return std::nullopt;
      const std::string_view value = !joined ? std::string_view(words[i])
                                     : whole ? word.substr(sign + 1)
                                             : word.substr(2);
      if (auto wrong = wrong_choice(at, *o, value)) return wrong;
      continue;
    }
    if (at.now().commands.empty()) continue;  // a file or a word
    const auto& below = at.now().commands;
    const auto found =
        std::find_if(below.begin(), below.end(), [&](const CommandText& c) { return c.name == word; });
    if (found == below.end()) {
      std::vector<std::string> known;
      for (const CommandText& c : below) known.push_back(c.name);
      return unknown_name("command", word, known, at.help());
    }
    at.commands.push_back(&*found);
    at.called += " " + found->name;
  }
  return std::nullopt;
}

bool wants_json(std::span<const char* const> words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::string_view word = words[i];
    if (word == std::string(kDiagnostics) + "=json") return true;
    if (word == kDiagnostics && i + 1 < words.size() && std::string_view(words[i + 1]) == "json") return true;
  }
  return false;
}

}  // namespace capstan::app
