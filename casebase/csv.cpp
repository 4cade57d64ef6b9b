#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "casebase/casebase.h"
#include "casebase/fields.h"
#include "casebase/store.h"
#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase {
namespace {

std::string quoted(const std::string& field) {
  if (field.find_first_of(",\"\r\n") == std::string::npos) return field;
  std::string out = "\"";
  for (const char c : field) {
    if (c == '"') out += '"';
    out += c;
  }
  return out + '"';
}

std::vector<std::string> names() {
  std::vector<std::string> out = {"id"};
  for (const TextField& f : text_fields()) out.emplace_back(f.name);
  for (const NumberField& f : number_fields()) out.emplace_back(f.name);
  out.emplace_back("teeth");
  out.emplace_back("coolant");
  return out;
}

std::string joined(const std::vector<std::string>& fields) {
  std::string out;
  for (const std::string& f : fields) out += (out.empty() ? "" : ",") + quoted(f);
  return out + "\r\n";
}

struct Row {
  std::uint64_t line = 0;
  std::vector<std::string> fields;
};

/// One record after another; ends by itself at the end of the text.
class Reader {
 public:
  explicit Reader(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }
  [[nodiscard]] bool done() const { return at_ >= text_.size(); }

  /// The next record, or what is wrong with it.
  tl::expected<Row, std::string> next() {
    Row row{line_, {}};
    while (true) {
      auto field = read_field();
      if (!field) return tl::unexpected(field.error());
      row.fields.push_back(std::move(*field));
      if (!done() && text_[at_] == ',') {
        ++at_;
        continue;
      }
      end_line();
      return row;
    }
  }
  [[nodiscard]] std::uint64_t line() const { return line_; }

 private:
  tl::expected<std::string, std::string> read_field() {
    std::string out;
    if (done() || text_[at_] != '"') {
      const std::size_t end = std::min(text_.find_first_of(",\r\n", at_), text_.size());
      out = text_.substr(at_, end - at_);
      at_ = end;
      if (out.find('"') != std::string::npos)
        return tl::unexpected<std::string>("a quote inside a field that is not quoted");
      return out;
    }
    for (++at_; !done(); ++at_) {
      if (text_[at_] == '\n') ++line_;
      if (text_[at_] != '"') {
        out += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        out += text_[++at_];
      } else {
        ++at_;
        if (!done() && text_[at_] != ',' && text_[at_] != '\r' && text_[at_] != '\n') {
          return tl::unexpected<std::string>("text behind a quoted field");
        }
        return out;
      }
    }
    return tl::unexpected<std::string>("a quoted field that does not end");
  }

  void end_line() {
    if (!done() && text_[at_] == '\r') ++at_;
    if (!done() && text_[at_] == '\n') ++at_;
    ++line_;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::uint64_t line_ = 1;
};

/// Puts one field where it belongs; what is wrong with it.
std::optional<std::string> put(Case& c, const std::string& name, const std::string& field) {
  if (name == "id") {
    c.id = field;
    return std::nullopt;
  }
  for (const TextField& f : text_fields()) {
    if (f.name != name) continue;
    f.in(c) = field;
    return std::nullopt;
  }
  const std::optional<double> number = parse_double(field);
  if (!number) return name + ": " + no_number(field);
  for (const NumberField& f : number_fields()) {
    if (f.name != name) continue;
    f.in(c) = *number;
    return std::nullopt;
  }
  int whole = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), whole);
  if (error != std::errc() || end != field.data() + field.size()) return name + " is not a whole number";
  if (name == "teeth") {
    c.teeth = whole;
    return std::nullopt;
  }
  if (whole != 0 && whole != 1) return "coolant is neither 0 nor 1";
  c.coolant = whole == 1;
  return std::nullopt;
}

std::optional<std::string> fault_of_head(const std::vector<std::string>& head) {
  const std::vector<std::string> known = names();
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (std::find(known.begin(), known.end(), head[i]) == known.end()) {
      return "the column '" + head[i].substr(0, 40) + "' is unknown";
    }
    if (std::find(head.begin(), head.begin() + static_cast<std::ptrdiff_t>(i), head[i]) !=
        head.begin() + static_cast<std::ptrdiff_t>(i)) {
      return "the column '" + head[i] + "' is there twice";
    }
  }
  for (const std::string& name : known) {
    if (name != "id" && std::find(head.begin(), head.end(), name) == head.end()) {
      return "the column '" + name + "' is missing";
    }
  }
  return std::nullopt;
}

std::optional<std::string> read_case(const std::vector<std::string>& head, const Row& row, Case& c) {
  if (row.fields.size() != head.size()) {
    return fmt::format("{} fields instead of {}", row.fields.size(), head.size());
  }
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (auto wrong = put(c, head[i], row.fields[i])) return wrong;
  }
  if (auto wrong = fault_of(c)) return wrong;
  const std::string id = id_of(c);
  if (!c.id.empty() && c.id != id)
    return "the id does not fit the case: it was altered; leave it empty if that is meant";
  c.id = id;
  return std::nullopt;
}

}  // namespace

std::string to_csv(std::span<const Case> cases) {
  std::string out = joined(names());
  for (const Case& c : cases) {
    std::vector<std::string> fields = {c.id};
    for (const TextField& f : text_fields()) fields.push_back(value(f, c));
    for (const NumberField& f : number_fields()) fields.push_back(shortest(value(f, c)));
    fields.push_back(std::to_string(c.teeth));
    fields.emplace_back(c.coolant ? "1" : "0");
    out += joined(fields);
  }
  return out;
}

Result<std::vector<Case>> from_csv(std::string_view text, const std::string& file) {
  const auto wrong = [&](std::uint64_t line, std::string message) {
    return fail(Diagnostic{.code = "CASE-CSV", .message = std::move(message), .file = file, .line = line});
  };
  Reader reader(text);
  if (reader.done()) return wrong(1, "there is nothing in it");
  const auto head = reader.next();
  if (!head) return wrong(1, head.error());
  if (const auto fault = fault_of_head(head->fields)) return wrong(1, *fault);
  std::vector<Case> cases;
  while (!reader.done()) {
    const std::uint64_t line = reader.line();
    const auto row = reader.next();
    if (!row) return wrong(line, row.error());
    if (row->fields.size() == 1 && row->fields.front().empty()) continue;  // a blank line
    Case c;
    if (const auto fault = read_case(head->fields, *row, c)) return wrong(line, *fault);
    cases.push_back(std::move(c));
    if (cases.size() > Store::kMaxCases) return wrong(line, "more cases than a case base holds");
  }
  return cases;
}

}  // namespace capstan::casebase
