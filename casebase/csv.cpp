#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>

#include "casebase/casebase.h"
#include "casebase/fields.h"
#include "casebase/store.h"
#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/tables/separated.h"

namespace capstan::casebase {
namespace {

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
  for (const std::string& f : fields) out += (out.empty() ? "" : ",") + separated_cell(f, ',');
  return out + "\r\n";
}

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

std::optional<std::string> read_case(const std::vector<std::string>& head, const SeparatedRow& row, Case& c) {
  if (row.cells.size() != head.size()) {
    return fmt::format("{} fields instead of {}", row.cells.size(), head.size());
  }
  for (std::size_t i = 0; i < head.size(); ++i) {
    if (auto wrong = put(c, head[i], row.cells[i])) return wrong;
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
  const auto rows = separated_rows(text, ',', file, "CASE-CSV", StrayQuotes::kRefused);
  if (!rows) return fail(rows.error());
  if (rows->empty()) return wrong(1, "there is nothing in it");
  const SeparatedRow& head = rows->front();
  if (const auto fault = fault_of_head(head.cells)) return wrong(head.line, *fault);
  std::vector<Case> cases;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    const SeparatedRow& row = (*rows)[i];
    Case c;
    if (const auto fault = read_case(head.cells, row, c)) return wrong(row.line, *fault);
    cases.push_back(std::move(c));
    if (cases.size() > Store::kMaxCases) return wrong(row.line, "more cases than a case base holds");
  }
  return cases;
}

}  // namespace capstan::casebase
