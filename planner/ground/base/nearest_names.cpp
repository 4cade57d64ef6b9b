#include "planner/ground/base/nearest_names.h"

#include <algorithm>
#include <utility>

// Optimal string alignment: rows of the table of edits, two of them kept behind the present one.

namespace capstan {
namespace {

std::string letters_of(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c >= 'A' && c <= 'Z') out += static_cast<char>(c - 'A' + 'a');
    if ((c >= 'a' && c <= 'z') || (c >= '0' && c <= '9')) out += c;
  }
  return out;
}

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out(1);
  for (const char c : text) {
    if (letters_of(std::string_view(&c, 1)).empty()) {
      if (!out.back().empty()) out.emplace_back();
    } else {
      out.back() += c;
    }
  }
  if (out.back().empty()) out.pop_back();
  return out;
}

std::size_t distance(const std::string& a, const std::string& b) {
  std::vector<std::size_t> before_last(b.size() + 1), last(b.size() + 1), row(b.size() + 1);
  for (std::size_t j = 0; j <= b.size(); ++j) row[j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    before_last = std::exchange(last, row);
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] =
          std::min({last[j] + 1, row[j - 1] + 1, last[j - 1] + (a[i - 1] == b[j - 1] ? std::size_t{0} : 1)});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], before_last[j - 2] + 1);
    }
  }
  return row[b.size()];
}

}  // namespace

std::vector<std::string> nearest_names(std::string_view asked, const std::vector<std::string>& known,
                                       std::size_t most) {
  constexpr std::size_t kLongestName = 200;  // nobody means a longer one
  const std::string wanted = letters_of(asked.substr(0, kLongestName));
  const std::size_t furthest = std::max<std::size_t>(1, wanted.size() / 2);
  std::vector<std::pair<std::size_t, const std::string*>> near;
  for (const std::string& name : known) {
    std::size_t d = distance(wanted, letters_of(name));
    const auto words = words_of(name);
    for (const std::string& word : words) {
      if (words.size() > 1) d = std::min(d, distance(wanted, letters_of(word)) + 1);
    }
    if (d <= furthest) near.emplace_back(d, &name);
  }
  std::stable_sort(near.begin(), near.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<std::string> out;
  for (const auto& [d, name] : near) {
    if (out.size() == most) break;
    const auto same = [&, letters = letters_of(*name)](const auto& o) { return letters_of(o) == letters; };
    if (std::none_of(out.begin(), out.end(), same)) out.push_back(*name);
  }
  return out;
}

Diagnostic unknown_name(std::string_view what, std::string_view asked, const std::vector<std::string>& known,
                        std::string_view list_by) {
  Diagnostic d{.code = std::string(kUnknownName),
               .message = "unknown " + std::string(what) + " '" + std::string(asked) + "'"};
  const auto near = nearest_names(asked, known);
  for (std::size_t i = 0; i < near.size(); ++i) {
    d.message += i == 0 ? ". Did you mean '" : i + 1 == near.size() ? " or '" : ", '";
    d.message += near[i] + "'";
  }
  if (!near.empty()) d.message += "?";
  d.hint = "`" + std::string(list_by) + "` shows all";
  return d;
}

bool only_a_name(std::string_view text) { return text.find_first_of("/\\.") == std::string_view::npos; }

}  // namespace capstan
