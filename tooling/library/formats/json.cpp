#include "tooling/library/formats/json.h"

#include <algorithm>
#include <set>

#include "tooling/library/formats/byte_cap.h"

namespace capstan::tooling {
namespace {

constexpr std::size_t kFewKeys = 16;  // up to here a look at all is quicker than a set

void append_utf8(std::uint32_t c, std::string& out) {
  const auto put = [&out](std::uint32_t byte) { out.push_back(static_cast<char>(byte)); };
  if (c < 0x80) {
    put(c);
  } else if (c < 0x800) {
    put(0xC0 | (c >> 6));
    put(0x80 | (c & 0x3F));
  } else if (c < 0x10000) {
    put(0xE0 | (c >> 12));
    put(0x80 | ((c >> 6) & 0x3F));
    put(0x80 | (c & 0x3F));
  } else {
    put(0xF0 | (c >> 18));
    put(0x80 | ((c >> 12) & 0x3F));
    put(0x80 | ((c >> 6) & 0x3F));
    put(0x80 | (c & 0x3F));
  }
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& file) : s_(text), file_(file) {}

  Result<Json> parse() {
    if (s_.size() > kLibraryBytesCap)
      return fail({.code = "FILE-TOO-LARGE",
                   .message = "more than " + std::to_string(kLibraryBytesCap) + " bytes",
                   .file = file_});
    if (s_.starts_with("\xEF\xBB\xBF")) at_ = 3;
    while (fault_.empty() && step()) {
    }
    if (fault_.empty()) {
      blanks();
      if (at_ < s_.size()) refuse("there is text behind the end of the document", "one JSON document");
    }
    if (!fault_.empty())
      return fail({.code = code_,
                   .message = fault_,
                   .file = file_,
                   .line = line_,
                   .expected = expected_,
                   .hint = "is it the whole file, as it was exported?"});
    return std::move(root_);
  }

 private:
  struct Open {
    Json value;
    std::string key = {};             // of the entry being read
    std::set<std::string> keys = {};  // only of maps with many
  };

  void refuse(std::string message, std::string expected = {}, const char* code = "JSON-SYNTAX") {
    if (!fault_.empty()) return;
    fault_ = std::move(message);
    expected_ = std::move(expected);
    code_ = code;
  }
  void blanks() {
    while (at_ < s_.size() && (s_[at_] == ' ' || s_[at_] == '\t' || s_[at_] == '\r' || s_[at_] == '\n')) {
      if (s_[at_] == '\n') ++line_;
      ++at_;
    }
  }
  [[nodiscard]] char peek() const { return at_ < s_.size() ? s_[at_] : '\0'; }

  /// Reads one token; false when the document is complete.
  bool step() {
    blanks();
    if (at_ >= s_.size()) {
      refuse("the text ends within the document", "a whole JSON document");
      return false;
    }
    if (open_.empty()) return value();
    Open& top = open_.back();
    const bool map = top.value.kind == Json::Kind::kMap;
    const char close = map ? '}' : ']';
    const bool empty = map ? top.value.entries.empty() : top.value.items.empty();
    if (peek() == close) {
      ++at_;
      Json done = std::move(top.value);
      open_.pop_back();
      return put(std::move(done));
    }
    if (!empty) {
      if (peek() != ',') {
        refuse(std::string("'") + peek() + "' where the next element should be",
               std::string("',' or '") + close + "'");
        return false;
      }
      ++at_;
      blanks();
    }
    if (at_ < s_.size() && map && !key(top)) return false;
    if (at_ >= s_.size()) {
      refuse("the text ends within the document", "a whole JSON document");
      return false;
    }
    return value();
  }

  bool key(Open& top) {
    if (peek() != '"') {
      refuse(std::string("'") + peek() + "' where a key should be", "a key in double quotes");
      return false;
    }
    std::string name = string();
    if (!fault_.empty()) return false;
    const auto& entries = top.value.entries;
    bool twice = false;
    if (entries.size() < kFewKeys) {
      twice = top.value.find(name) != nullptr;
    } else {
      if (top.keys.empty())
        for (const auto& [k, v] : entries) top.keys.insert(k);
      twice = !top.keys.insert(name).second;
    }
    if (twice) {
      refuse("the key '" + name.substr(0, 80) + "' is given twice", "each key once", "DATA-DUPLICATE");
      return false;
    }
    blanks();
    if (peek() != ':') {
      refuse("no value follows the key '" + name.substr(0, 80) + "'", "':'");
      return false;
    }
    ++at_;
    blanks();
    top.key = std::move(name);
    return true;
  }

  /// False when the document is complete or wrong.
  bool value() {
    if (++nodes_ > kJsonNodesCap) {
      refuse("more than " + std::to_string(kJsonNodesCap) + " values", {}, "FILE-TOO-LARGE");
      return false;
    }
    const char c = peek();
    if (c == '{' || c == '[') {
      if (open_.size() >= kJsonDepthCap) {
        refuse("nested deeper than " + std::to_string(kJsonDepthCap), "a tool library", "JSON-DEPTH");
        return false;
      }
      ++at_;
      Json v;
      v.kind = c == '{' ? Json::Kind::kMap : Json::Kind::kList;
      v.line = line_;
      open_.push_back({std::move(v)});
      return true;
    }
    Json v;
    v.line = line_;
    if (c == '"') {
      v.kind = Json::Kind::kString;
      v.text = string();
    } else if (c == '-' || (c >= '0' && c <= '9')) {
      v.kind = Json::Kind::kNumber;
      v.text = number();
    } else {
      word(v);
    }
    return fault_.empty() && put(std::move(v));
  }

  void word(Json& v) {
    for (const auto& [text, kind] :
         {std::pair("true", Json::Kind::kBool), std::pair("false", Json::Kind::kBool),
          std::pair("null", Json::Kind::kNull)}) {
      if (!s_.substr(at_).starts_with(text)) continue;
      v.kind = kind;
      if (kind == Json::Kind::kBool) v.text = text;
      at_ += std::string_view(text).size();
      return;
    }
    const auto end = std::min(s_.find_first_of(" \t\r\n,]}", at_), s_.size());
    refuse("'" + std::string(s_.substr(at_, std::min<std::size_t>(end - at_, 40))) + "' is no JSON value",
           "a number, a text in quotes, true, false, null, [ or {");
  }

  std::string number() {
    const auto begin = at_;
    const auto digits = [this] {
      const auto from = at_;
      while (peek() >= '0' && peek() <= '9') ++at_;
      return at_ - from;
    };
    if (peek() == '-') ++at_;
    const bool zero = peek() == '0';
    const auto whole = digits();
    bool good = whole > 0 && !(zero && whole > 1);
    if (peek() == '.') {
      ++at_;
      good = digits() > 0 && good;
    }
    if (peek() == 'e' || peek() == 'E') {
      ++at_;
      if (peek() == '+' || peek() == '-') ++at_;
      good = digits() > 0 && good;
    }
    const std::string text(s_.substr(begin, at_ - begin));
    if (!good || text.size() > 400) refuse("'" + text.substr(0, 40) + "' is no number", "a decimal number");
    return text;
  }

  std::uint32_t hex4() {
    std::uint32_t out = 0;
    for (int i = 0; i < 4; ++i) {
      const char c = peek();
      const int d = c >= '0' && c <= '9'   ? c - '0'
                    : c >= 'a' && c <= 'f' ? c - 'a' + 10
                    : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                           : -1;
      if (d < 0) {
        refuse("a \\u escape without four hex digits", "\\u and four hex digits");
        return 0;
      }
      out = out * 16 + static_cast<std::uint32_t>(d);
      ++at_;
    }
    return out;
  }

  void escape(std::string& out) {
    ++at_;  // the backslash
    const char c = peek();
    ++at_;
    constexpr std::string_view kFrom = "\"\\/bfnrt", kTo = "\"\\/\b\f\n\r\t";
    if (const auto i = kFrom.find(c); c != '\0' && i != std::string_view::npos) {
      out.push_back(kTo[i]);
      return;
    }
    if (c != 'u') {
      refuse(std::string("the escape \\") + c + " is not known",
             "one of \\\" \\\\ \\/ \\b \\f \\n \\r \\t \\u");
      return;
    }
    std::uint32_t code = hex4();
    if (code >= 0xD800 && code < 0xE000) {
      std::uint32_t low = 0;
      if (code < 0xDC00 && s_.substr(at_).starts_with("\\u")) {
        at_ += 2;
        low = hex4();
      }
      if (low < 0xDC00 || low >= 0xE000) {
        refuse("a \\u escape is half of a surrogate pair", "both halves");
        return;
      }
      code = 0x10000 + ((code - 0xD800) << 10) + (low - 0xDC00);
    }
    append_utf8(code, out);
  }

  std::string string() {
    std::string out;
    ++at_;
    while (fault_.empty()) {
      const auto end = s_.find_first_of("\"\\\n", at_);
      if (end == std::string_view::npos || s_[end] == '\n') {
        refuse("a text in quotes does not end on its line", "'\"'");
        break;
      }
      out.append(s_.substr(at_, end - at_));
      at_ = end;
      if (s_[end] == '"') {
        ++at_;
        break;
      }
      escape(out);
    }
    return out;
  }

  bool put(Json v) {
    if (open_.empty()) {
      root_ = std::move(v);
      return false;
    }
    Open& top = open_.back();
    if (top.value.kind == Json::Kind::kMap)
      top.value.entries.emplace_back(std::move(top.key), std::move(v));
    else
      top.value.items.push_back(std::move(v));
    return true;
  }

  std::string_view s_;
  const std::string& file_;
  std::size_t at_ = 0, nodes_ = 0;
  std::uint64_t line_ = 1;
  std::vector<Open> open_;
  Json root_;
  std::string fault_, expected_;
  const char* code_ = "";
};

void newline(std::string& out, int indent, std::size_t depth) {
  if (indent <= 0) return;
  out.push_back('\n');
  out.append(static_cast<std::size_t>(indent) * depth, ' ');
}

}  // namespace

const Json* Json::find(std::string_view key) const {
  for (const auto& [name, value] : entries)
    if (name == key) return &value;
  return nullptr;
}

std::string Json::text_of(std::string_view key) const {
  const Json* v = find(key);
  return v == nullptr ? std::string() : v->text;
}

Json Json::string(std::string_view text) { return {.kind = Kind::kString, .text = std::string(text)}; }
Json Json::number(std::string_view spelled) { return {.kind = Kind::kNumber, .text = std::string(spelled)}; }
Json Json::truth(bool value) { return {.kind = Kind::kBool, .text = value ? "true" : "false"}; }
Json Json::list() { return {.kind = Kind::kList}; }
Json Json::map() { return {.kind = Kind::kMap}; }

Json& Json::set(std::string_view key, Json value) {
  for (auto& [name, old] : entries) {
    if (name != key) continue;
    old = std::move(value);
    return old;
  }
  return entries.emplace_back(std::string(key), std::move(value)).second;
}

Result<Json> parse_json(std::string_view text, const std::string& file) { return Parser(text, file).parse(); }

std::string json_quoted(std::string_view text) {
  std::string out = "\"";
  constexpr std::string_view kHex = "0123456789abcdef";
  for (const char c : text) {
    const auto u = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      out.push_back('\\');
      out.push_back(c);
    } else if (c == '\n') {
      out += "\\n";
    } else if (c == '\t') {
      out += "\\t";
    } else if (c == '\r') {
      out += "\\r";
    } else if (u < 0x20) {
      out += "\\u00";
      out.push_back(kHex[u >> 4]);
      out.push_back(kHex[u & 15]);
    } else {
      out.push_back(c);
    }
  }
  return out + "\"";
}

// A tree that was parsed or built here is no deeper than kJsonDepthCap, so a stack suffices.
std::string json_text(const Json& value, int indent) {
  struct Level {
    const Json* value;
    std::size_t next;
  };
  std::string out;
  std::vector<Level> open;
  const auto begin = [&](const Json& v) {
    switch (v.kind) {
      case Json::Kind::kNull:
        out += "null";
        return;
      case Json::Kind::kBool:
      case Json::Kind::kNumber:
        out += v.text;
        return;
      case Json::Kind::kString:
        out += json_quoted(v.text);
        return;
      case Json::Kind::kList:
      case Json::Kind::kMap:
        out.push_back(v.kind == Json::Kind::kMap ? '{' : '[');
        open.push_back({&v, 0});
    }
  };
  begin(value);
  while (!open.empty()) {
    Level& top = open.back();
    const Json& v = *top.value;
    const bool map = v.kind == Json::Kind::kMap;
    const std::size_t size = map ? v.entries.size() : v.items.size();
    if (top.next == size) {
      open.pop_back();
      if (size > 0) newline(out, indent, open.size());
      out.push_back(map ? '}' : ']');
      continue;
    }
    if (top.next > 0) out += indent > 0 ? "," : ", ";
    newline(out, indent, open.size());
    const std::size_t i = top.next++;
    if (map) out += json_quoted(v.entries[i].first) + ": ";
    begin(map ? v.entries[i].second : v.items[i]);
  }
  return out;
}

void sort_keys(Json& value) {
  std::vector<Json*> todo = {&value};
  while (!todo.empty()) {
    Json* v = todo.back();
    todo.pop_back();
    std::sort(v->entries.begin(), v->entries.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    for (auto& [name, child] : v->entries) todo.push_back(&child);
    for (Json& child : v->items) todo.push_back(&child);
  }
}

}  // namespace capstan::tooling
