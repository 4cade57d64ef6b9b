#include "planner/files/exchange/common/file_sections.h"

#include <algorithm>
#include <string_view>
#include <variant>

#include "planner/files/p21/print.h"

namespace capstan::exchange {

using model::AnyRef;
using model::KeptInstance;
using model::KeptSection;

namespace {

std::string text_or(const p21::Value& v) { return v.is(p21::Kind::kString) ? v.as_text() : std::string(); }

std::vector<std::string> texts_or(const p21::Value& v) {
  std::vector<std::string> out;
  if (v.is(p21::Kind::kString)) out.push_back(v.as_text());
  for (std::size_t i = 0; v.is(p21::Kind::kList) && i < v.size(); ++i) out.push_back(text_or(v[i]));
  return out;
}

p21::Value at_or_omitted(const p21::Value& list, std::size_t i) {
  return list.is(p21::Kind::kList) && i < list.size() ? list[i] : p21::Value{};
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

// The end of what begins at i and is no place for references: a string, <name>, a comment. i when nothing
// does.
std::size_t past_quoted(std::string_view s, std::size_t i) {
  const auto behind = [&](std::string_view end, std::size_t from) {
    const auto at = s.find(end, from);
    return at == std::string_view::npos ? s.size() : at + end.size();
  };
  if (s[i] == '\'') return behind("'", i + 1);
  if (s[i] == '"') return behind("\"", i + 1);
  if (s[i] == '<') return behind(">", i + 1);
  if (s.substr(i, 2) == "/*") return behind("*/", i + 2);
  return i;
}

// Calls with the text between references, and with each number behind a #.
template <class Text, class Number>
void parts_of(std::string_view s, const Text& text, const Number& number) {
  std::size_t from = 0;
  for (std::size_t i = 0; i < s.size();) {
    if (const auto past = past_quoted(s, i); past != i) {
      i = past;
    } else if (s[i] == '#' && i + 1 < s.size() && is_digit(s[i + 1])) {
      std::size_t end = i + 1;
      std::uint64_t n = 0;
      while (end < s.size() && is_digit(s[end]) && n < (std::uint64_t{1} << 53)) {
        n = 10 * n + static_cast<std::uint64_t>(s[end++] - '0');
      }
      if (i != from) text(s.substr(from, i - from));
      number(n, s.substr(i, end - i), i);
      from = i = end;
    } else {
      ++i;
    }
  }
  if (from != s.size()) text(s.substr(from));
}

// The <name> of the entry that contains a place.
std::string entry_name(std::string_view s, std::size_t at) {
  const auto open = s.rfind('<', at);
  const auto close = open == std::string_view::npos ? open : s.find('>', open);
  return close == std::string_view::npos ? std::string() : std::string(s.substr(open, close + 1 - open));
}

void add_text(KeptInstance& kept, std::string_view text) {
  if (kept.pieces.empty() || !std::holds_alternative<std::string>(kept.pieces.back())) {
    kept.pieces.emplace_back(std::string());
  }
  std::get<std::string>(kept.pieces.back()) += text;
}

}  // namespace

void read_header(const p21::File& file, model::Plan& plan) {
  plan.file_name = file.name();
  if (const auto d = file.header("FILE_DESCRIPTION")) {
    const auto lines = texts_or(at_or_omitted(d->parameters(), 0));
    for (const std::string& line : lines) {
      if (!plan.header_description.empty()) plan.header_description += '\n';
      plan.header_description += line;
    }
  }
  if (const auto n = file.header("FILE_NAME")) {
    plan.header_time_stamp = text_or(at_or_omitted(n->parameters(), 1));
    plan.header_authors = texts_or(at_or_omitted(n->parameters(), 2));
    plan.header_organizations = texts_or(at_or_omitted(n->parameters(), 3));
  }
}

void keep_sections(const p21::File& file, model::KeptSchema schema,
                   const std::function<AnyRef(std::uint64_t)>& resolve, model::Plan& plan,
                   Reporter& reporter) {
  for (const p21::VerbatimSection& s : file.verbatim_sections()) {
    if (s.keyword == "SIGNATURE") {
      reporter.report({.code = "EXC-SIGNATURE",
                       .severity = Severity::kNote,
                       .message = "the file's signature is not kept: what is written is not what was signed",
                       .line = s.line});
      continue;
    }
    KeptInstance kept;
    kept.keyword = s.keyword;
    kept.schema = schema;
    kept.section = s.keyword == "ANCHOR" ? KeptSection::kAnchor : KeptSection::kReference;
    std::uint64_t line = s.line;
    std::size_t counted = 0, missing = 0;
    parts_of(
        s.text, [&](std::string_view text) { add_text(kept, text); },
        [&](std::uint64_t n, std::string_view spelled, std::size_t at) {
          const AnyRef to = resolve(n);
          if (to.set()) {
            kept.pieces.emplace_back(to);
            return;
          }
          add_text(kept, spelled);
          const auto& external = file.external_ids();
          if (kept.section == KeptSection::kReference ||
              std::binary_search(external.begin(), external.end(), n)) {
            return;
          }
          if (++missing > Reporter::kPerCode) return;
          line +=
              static_cast<std::uint64_t>(std::count(s.text.begin() + static_cast<std::ptrdiff_t>(counted),
                                                    s.text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
          counted = at;
          reporter.report({.code = "EXC-ANCHOR",
                           .severity = Severity::kWarning,
                           .message = "the anchor " + entry_name(s.text, at) + " names " +
                                      std::string(spelled) + ", which the file does not hold; kept as it is",
                           .line = line});
        });
    if (kept.section == KeptSection::kReference) {
      reporter.report({.code = "EXC-EXTERNAL",
                       .severity = Severity::kNote,
                       .message = std::to_string(file.external_ids().size()) +
                                  " references to other files are kept and not followed",
                       .line = s.line});
    }
    plan.kept.push_back(plan.model.add(std::move(kept)));
  }
}

std::string sections_text(const model::Plan& plan, const std::function<std::string(AnyRef)>& reference) {
  std::string out;
  for (const KeptSection section : {KeptSection::kAnchor, KeptSection::kReference}) {
    for (const AnyRef at : plan.kept) {
      const auto* kept = plan.model.get<KeptInstance>(at);
      if (kept == nullptr || kept->section != section) continue;
      out += kept->keyword + ";";
      for (const auto& piece : kept->pieces) {
        const auto* text = std::get_if<std::string>(&piece);
        out += text != nullptr ? *text : reference(std::get<AnyRef>(piece));
      }
      out += "ENDSEC;\n";
    }
  }
  return out;
}

std::string implementation_level(const model::Plan& plan) {
  const bool sections = std::any_of(plan.kept.begin(), plan.kept.end(), [&](AnyRef at) {
    const auto* kept = plan.model.get<KeptInstance>(at);
    return kept != nullptr && kept->section != KeptSection::kData;
  });
  return sections ? "4;1" : "2;1";
}

std::set<std::uint64_t> unresolved_numbers(const KeptInstance& kept) {
  std::set<std::uint64_t> out;
  for (const auto& piece : kept.pieces) {
    const auto* text = std::get_if<std::string>(&piece);
    if (text == nullptr) continue;
    parts_of(
        *text, [](std::string_view) {},
        [&](std::uint64_t n, std::string_view, std::size_t) { out.insert(n); });
  }
  return out;
}

}  // namespace capstan::exchange
