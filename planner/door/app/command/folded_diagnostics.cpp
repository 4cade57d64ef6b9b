#include "planner/door/app/command/folded_diagnostics.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <tuple>

namespace capstan::app {
namespace {

/// "operation 'DRILL': spins backwards" is about the operation 'DRILL'.
struct Subject {
  std::string_view kind, name, rest;
};

std::optional<Subject> subject_of(std::string_view message) {
  static constexpr std::array<std::string_view, 3> kKinds = {"operation", "step", "feature"};
  for (const std::string_view kind : kKinds) {
    if (!message.starts_with(kind) || message.substr(kind.size(), 2) != " '") continue;
    const auto begin = kind.size() + 2;
    const auto end = message.find("': ", begin);
    if (end == std::string_view::npos) return std::nullopt;
    return Subject{kind, message.substr(begin, end - begin), message.substr(end + 3)};
  }
  return std::nullopt;
}

struct Group {
  const Diagnostic* first = nullptr;
  std::vector<std::string_view> names;  ///< each once, as met
  std::size_t times = 0;
};

/// The sentence of a group; a finding names its step in the path, others in the message.
Diagnostic told(const Group& g) {
  Diagnostic d = *g.first;
  if (g.times == 1) return d;
  const bool by_path = !subject_of(d.message);
  const std::string said = by_path ? d.path + ": " : d.message;
  const auto subject = subject_of(said);
  if (!subject || g.names.size() < 2) {
    d.message += " (" + std::to_string(g.times) + " times)";
    return d;
  }
  std::string who = std::to_string(g.names.size()) + " " + std::string(subject->kind) + "s (";
  for (const std::string_view name : g.names) {
    if (name != g.names.front()) who += ", ";
    who += "'" + std::string(name) + "'";
  }
  who += ")";
  if (by_path) {
    d.path = std::move(who);
  } else {
    d.message = who + ": " + std::string(subject->rest);
  }
  d.line = d.instance = 0;  // of the first alone
  return d;
}

}  // namespace

std::vector<Diagnostic> without_repeats(const std::vector<Diagnostic>& all) {
  using Key = std::tuple<std::string_view, Severity, std::string_view, std::uint64_t, std::uint64_t,
                         std::string_view, std::string_view, std::string_view, std::string_view>;
  std::set<Key> said;
  std::vector<Diagnostic> out;
  out.reserve(all.size());
  for (const Diagnostic& d : all) {
    const bool placed = d.line != 0 || d.instance != 0;
    const Key key{d.code, d.severity, d.file, d.line, d.instance, d.path, d.message, d.expected, d.hint};
    if (!placed || said.insert(key).second) out.push_back(d);
  }
  return out;
}

std::vector<Diagnostic> folded_diagnostics(const std::vector<Diagnostic>& all) {
  using Key = std::tuple<std::string_view, Severity, std::string_view, std::string_view, std::string_view,
                         std::string_view, std::string_view>;
  std::map<Key, std::size_t> where;
  std::vector<Group> groups;
  std::vector<std::string> paths;  // that the names of some subjects are parts of
  paths.reserve(all.size());
  for (const Diagnostic& d : all) {
    auto subject = subject_of(d.message);
    std::string_view path = d.path, text = d.message;
    if (subject) {
      text = subject->rest;
    } else {
      paths.push_back(d.path + ": ");
      subject = subject_of(paths.back());
      if (subject) path = {};
    }
    const std::string_view kind = subject ? subject->kind : std::string_view{};
    const auto [it, fresh] =
        where.try_emplace(Key{d.code, d.severity, d.file, path, kind, text, d.expected}, groups.size());
    if (fresh) groups.push_back({&d, {}, 0});
    Group& g = groups[it->second];
    ++g.times;
    if (subject && std::find(g.names.begin(), g.names.end(), subject->name) == g.names.end())
      g.names.push_back(subject->name);
  }
  std::vector<Diagnostic> out;
  out.reserve(groups.size());
  for (const Group& g : groups) out.push_back(told(g));
  return out;
}

}  // namespace capstan::app
