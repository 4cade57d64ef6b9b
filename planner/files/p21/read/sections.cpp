#include <algorithm>
#include <array>
#include <cstring>

#include "planner/ground/base/stopping.h"

#include "planner/files/p21/read/parser.h"

namespace capstan::p21::detail {
namespace {

constexpr std::string_view kBegin = "ISO-10303-21";
constexpr std::string_view kEnd = "END-ISO-10303-21";

bool in_word(char c) { return word_class(c) != 0 || c == '-'; }

}  // namespace

bool Parser::peek_word(std::string_view word) const {
  const auto left = static_cast<std::size_t>(end_ - at_.p);
  return left >= word.size() && std::memcmp(at_.p, word.data(), word.size()) == 0 &&
         !in_word(at_.p[word.size()]);
}

bool Parser::encoding() {
  const std::string_view all(begin_, static_cast<std::size_t>(end_ - begin_));
  if (all.starts_with("\xEF\xBB\xBF")) {
    warn("P21-ENCODING", "the file begins with a byte order mark");
    at_.p += 3;
  }
  const bool utf16 = all.starts_with("\xFF\xFE") || all.starts_with("\xFE\xFF") ||
                     (all.size() >= 4 && ((all[0] == '\0' && all[1] != '\0' && all[2] == '\0') ||
                                          (all[1] == '\0' && all[0] != '\0' && all[3] == '\0')));
  if (utf16) {
    fault({.code = "P21-ENCODING",
           .message = "the file is UTF-16",
           .expected = "ASCII or UTF-8",
           .hint = "save it as UTF-8"});
  }
  return !utf16;
}

Status Parser::run() {
  if (encoding()) exchange();
  if (!stop_ && !store_.entities.empty()) finish_index();
  return summary();
}

void Parser::exchange() {
  skip();
  if (!peek_word(kBegin)) {
    fault({.code = "P21-STRUCTURE",
           .message = at_end() ? "the file is empty" : "this is not a Part 21 file",
           .expected = "ISO-10303-21;"});
    return;
  }
  at_.p += kBegin.size();
  if (!semicolon()) resync();
  header();
  check_header();
  bool data = false;
  while (!stop_) {
    skip();
    id_ = 0;
    const std::uint32_t line = at_.line;
    const std::uint32_t start = offset(at_.p);
    if (peek_word("DATA")) {
      data_section();
      data = true;
    } else if (peek_word("ANCHOR") || peek_word("REFERENCE")) {
      verbatim_section(start, *at_.p == 'A' ? 6 : 9, line);
    } else if (peek_word(kEnd)) {
      at_.p += kEnd.size();
      if (!semicolon()) resync();
      after_the_end();
      break;
    } else if (at_end()) {
      fault({.code = "P21-STRUCTURE",
             .message = "the file ends before END-ISO-10303-21;",
             .hint = "it may have been cut off"});
      break;
    } else {
      unexpected("DATA, ANCHOR, REFERENCE or END-ISO-10303-21");
      if (!at_end()) ++at_.p;
      resync();
    }
  }
  if (!data && errors_ == 0) warn("P21-STRUCTURE", "the file has no data section");
  Entity last;
  last.part = static_cast<std::uint32_t>(store_.parts.size()) & 0x7FFFFFFFU;
  store_.entities.push_back(last);
}

void Parser::header() {
  skip();
  if (!peek_word("HEADER")) {
    fault({.code = "P21-STRUCTURE", .message = "there is no header", .expected = "HEADER;"});
  } else {
    at_.p += 6;
    if (!semicolon()) resync();
    while (!stop_) {
      skip();
      if (peek_word("ENDSEC")) {
        at_.p += 6;
        if (!semicolon()) resync();
        break;
      }
      if (peek_word("DATA") || peek_word(kEnd) || at_end()) {
        fault({.code = "P21-STRUCTURE", .message = "the header does not end", .expected = "ENDSEC;"});
        break;
      }
      Entity entity{.line = at_.line};
      entity.part = static_cast<std::uint32_t>(store_.parts.size()) & 0x7FFFFFFFU;
      if (record() && semicolon()) {
        store_.header.push_back(entity);
      } else {
        resync();
      }
    }
  }
  Entity last;
  last.part = static_cast<std::uint32_t>(store_.parts.size()) & 0x7FFFFFFFU;
  store_.header.push_back(last);
}

void Parser::check_header() {
  struct Required {
    std::string_view keyword;
    std::size_t parameters;
    std::size_t seen = 0;
  };
  if (errors_ != 0) return;
  std::array<Required, 3> required{{{"FILE_DESCRIPTION", 2}, {"FILE_NAME", 7}, {"FILE_SCHEMA", 1}}};
  const Cursor here = at_;
  for (std::size_t i = 0; i + 1 < store_.header.size(); ++i) {
    const Part& part = store_.parts[store_.header[i].part];
    const std::string_view keyword = store_.view(part.keyword_start, part.keyword_length);
    for (Required& r : required) {
      if (keyword != r.keyword) continue;
      at_.line = store_.header[i].line;
      if (++r.seen == 2) {
        fault({.code = "P21-STRUCTURE", .message = std::string(keyword) + " occurs twice in the header"});
      }
      const std::size_t count = length_of(part.parameters);
      if (count != r.parameters) {
        warn("P21-STRUCTURE", std::string(keyword) + " has " + std::to_string(count) + " of " +
                                  std::to_string(r.parameters) + " parameters");
      }
    }
  }
  at_ = here;
  for (const Required& r : required) {
    if (r.seen == 0) warn("P21-STRUCTURE", "the header lacks " + std::string(r.keyword));
  }
}

void Parser::data_section() {
  at_.p += 4;
  skip();
  Node node = make_node(Tag::kList, store_.nodes.size(), 0);
  bool good = true;
  if (*at_.p == '(') good = parameters(node);
  if (!good || !semicolon()) resync();
  DataSection section{.parameters = Value(&store_.arena, node), .first = store_.entities.size()};
  while (!stop_) {
    tick();
    skip();
    if (*at_.p == '#') {
      if (store_.entities.size() >= limits_.instances) {
        fault({.code = "P21-LIMIT",
               .message = "there are more than " + std::to_string(limits_.instances) + " instances"});
        stop_ = true;
      } else if ((store_.entities.size() & 0xFFFU) == 0 && job_.stop_requested()) {
        stop_ = stopped_by_job_ = true;
      } else if (!instance()) {
        resync();
      }
      continue;
    }
    id_ = 0;
    if (peek_word("ENDSEC")) {
      at_.p += 6;
      if (!semicolon()) resync();
      break;
    }
    if (at_end() || peek_word(kEnd) || peek_word("DATA") || peek_word("SIGNATURE")) {
      fault({.code = "P21-STRUCTURE",
             .message = "the data section does not end",
             .expected = "ENDSEC;",
             .hint = at_end() ? "the file may have been cut off" : ""});
      break;
    }
    unexpected("an instance or ENDSEC;");
    resync();
  }
  section.count = store_.entities.size() - section.first;
  store_.data.push_back(section);
}

// ----------------------------------------------------------------------------- edition 3 sections

void Parser::verbatim_section(std::size_t keyword_start, std::size_t keyword_length, std::uint32_t line) {
  at_.p = begin_ + keyword_start + keyword_length;
  if (!semicolon()) {
    resync();
    return;
  }
  const bool references = begin_[keyword_start] == 'R';
  const std::size_t start = offset(at_.p);
  while (!stop_) {
    skip();
    if (peek_word("ENDSEC")) {
      store_.sections.push_back({keyword_start, keyword_length, start, offset(at_.p) - start, line});
      at_.p += 6;
      if (!semicolon()) resync();
      return;
    }
    if (!verbatim_statement(references)) return;
  }
}

// Reads to the ';' of an anchor or reference, past strings and <URIs>, which are never followed.
bool Parser::verbatim_statement(bool references) {
  if (references && *at_.p == '#') {
    std::uint64_t id = 0;
    if (!instance_id(id)) {
      resync();
      return true;
    }
    store_.external_ids.push_back(id);
  }
  for (;;) {
    skip();
    const char c = *at_.p;
    if (at_end()) {
      fault({.code = "P21-STRUCTURE", .message = "a section does not end", .expected = "ENDSEC;"});
      return false;
    }
    if (c == '\'') {
      Node ignored = 0;
      if (!string(ignored)) {
        resync();
        return true;
      }
      continue;
    }
    if (c == '<') {
      const char* p = at_.p;
      while (*p != '>' && static_cast<unsigned char>(*p) >= ' ') ++p;
      if (*p != '>') {
        fault({.message = "a resource is not closed", .expected = "'>'"});
        resync();
        return true;
      }
      at_.p = p;
    }
    ++at_.p;
    if (c == ';') return true;
  }
}

void Parser::signature_section(std::size_t keyword_start, std::uint32_t line) {
  constexpr std::size_t kLength = 9;
  const std::string_view rest =
      store_.view(keyword_start + kLength, store_.text.size() - keyword_start - kLength);
  const std::size_t length = rest.find("ENDSEC");
  if (length == std::string_view::npos) {
    fault({.code = "P21-STRUCTURE", .message = "the signature does not end", .expected = "ENDSEC;"});
    stop_ = true;
    return;
  }
  store_.sections.push_back({keyword_start, kLength, keyword_start + kLength, length, line});
  at_.line +=
      static_cast<std::uint32_t>(std::count(rest.begin(), rest.begin() + static_cast<long>(length), '\n'));
  at_.p = rest.data() + length + 6;
  if (!semicolon()) resync();
}

void Parser::after_the_end() {
  while (!stop_) {
    skip();
    if (at_end()) return;
    if (!peek_word("SIGNATURE")) {
      warn("P21-STRUCTURE", "what follows END-ISO-10303-21; is not read");
      return;
    }
    signature_section(offset(at_.p), at_.line);
  }
}

void Parser::finish_index() {
  std::sort(store_.external_ids.begin(), store_.external_ids.end());
  for (const Section& s : store_.sections) {
    store_.verbatim.push_back(
        {store_.view(s.keyword_start, s.keyword_length), store_.view(s.start, s.length), s.line});
  }
  for (const std::size_t i : store_.index.build(store_.entities, store_.entities.size() - 1)) {
    const Entity& entity = store_.entities[i];
    id_ = entity.id;
    const auto first = store_.index.find(entity.id);
    fault_at(entity.line, {.code = "P21-ID",
                           .message = "the instance number is taken already, on line " +
                                      std::to_string(store_.entities[*first].line)});
  }
}

}  // namespace capstan::p21::detail
