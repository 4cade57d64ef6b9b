#include "casebase/retain/join/steps.h"

#include <algorithm>
#include <charconv>
#include <optional>
#include <utility>

#include "planner/ground/base/tables/separated.h"
#include "planner/model/plan/order/step_ids.h"

// A sheet is the cases' own CSV with three columns more: these are taken out, what a case needs and a sheet
// has no word of is put in, and the rest is read by `from_csv`. So each column means here what it means
// there, has the same limits, and the same messages.

namespace capstan::casebase::retain {
namespace {

constexpr const char* kCode = "LOG-SHEET";

std::vector<std::string> words_of(std::string_view text) {
  std::vector<std::string> out;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    if (!word.empty()) out.emplace_back(word);
    text.remove_prefix(std::min(text.size(), word.size() + 1));
  }
  return out;
}

std::optional<long> whole(std::string_view text) {
  long out = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out);
  if (error != std::errc() || end != text.data() + text.size() || out < 0) return std::nullopt;
  return out;
}

std::optional<PartRange> range_of(std::string_view word) {
  const auto dash = word.find('-');
  const auto first = whole(word.substr(0, dash));
  const auto last = dash == std::string_view::npos ? first : whole(word.substr(dash + 1));
  if (!first || !last || *last < *first) return std::nullopt;
  return PartRange{*first, *last};
}

// A column that the cases' CSV needs and a sheet may leave out or empty, and what is put there.
struct Default {
  std::string_view name, value;
  bool from_log = false;  // the value stands for one that the log says
};
constexpr Default kDefaults[] = {
    {"origin", "measured"}, {"source", "sheet"}, {"vc_m_min", "1", true}, {"fz_mm", "1", true}};

tl::unexpected<Diagnostic> wrong(const std::string& file, std::uint64_t line, std::string message,
                                 std::string expected) {
  return fail(Diagnostic{.code = kCode,
                         .message = std::move(message),
                         .file = file,
                         .line = line,
                         .expected = std::move(expected),
                         .hint = "the first row names the columns, as `capstan cases export` does, and "
                                 "tool, characteristics, parts"});
}

// Whether there is a part that both are for.
bool meet(const Step& a, const Step& b) {
  if (a.parts.empty() || b.parts.empty()) return true;
  for (const PartRange& x : a.parts) {
    for (const PartRange& y : b.parts) {
      if (x.first <= y.last && y.first <= x.last) return true;
    }
  }
  return false;
}

std::size_t place_of(const std::vector<std::string>& head, std::string_view name) {
  return static_cast<std::size_t>(std::find(head.begin(), head.end(), name) - head.begin());
}

// The cells of one row but for those of the sheet's own columns.
struct Split {
  std::vector<std::string> of_case;
  std::string tool, characteristics, parts;
};
Split split(const std::vector<std::string>& head, std::vector<std::string> cells) {
  Split out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (head[i] == "tool") {
      out.tool = std::move(cells[i]);
    } else if (head[i] == "characteristics") {
      out.characteristics = std::move(cells[i]);
    } else if (head[i] == "parts") {
      out.parts = std::move(cells[i]);
    } else {
      out.of_case.push_back(std::move(cells[i]));
    }
  }
  return out;
}

std::string row_of(const std::vector<std::string>& cells) {
  std::string out;
  for (const std::string& cell : cells) out += (&cell == cells.data() ? "" : ",") + separated_cell(cell, ',');
  return out + '\n';
}

}  // namespace

bool Step::is_for(std::string_view part) const {
  if (parts.empty()) return true;
  const auto number = whole(part);
  return number && std::any_of(parts.begin(), parts.end(),
                               [&](const PartRange& r) { return *number >= r.first && *number <= r.last; });
}

std::vector<Step> steps_of(const model::Plan& plan, Job& job) {
  std::vector<Step> out;
  const std::vector<std::string> ids = model::step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const model::StepResult& s = plan.steps[i];
    auto planned = case_of(plan, s);
    if (!planned) {
      Diagnostic d = planned.error();
      d.severity = Severity::kNote;
      job.report(std::move(d));
      continue;
    }
    const model::Cutter* cutter = model::find_cutter(plan, s.cutter_id);
    out.push_back({.id = ids[i],
                   .tool = cutter == nullptr ? 0 : cutter->pocket,
                   .planned = *std::move(planned),
                   .characteristics = {},
                   .parts = {}});
  }
  return out;
}

Result<std::vector<Step>> read_sheet(std::string_view text, const std::string& file) {
  auto rows = separated_rows(text, ',', file, kCode, StrayQuotes::kRefused);
  if (!rows) return fail(rows.error());
  std::erase_if(*rows, [](const SeparatedRow& r) { return r.cells.front().starts_with('#'); });
  if (rows->size() < 2) return wrong(file, 1, "there is no step in it", "a row per workingstep");
  const std::vector<std::string> head = rows->front().cells;
  if (place_of(head, "workingstep") == head.size()) {
    return wrong(file, rows->front().line, "the column 'workingstep' is missing", "a name of each step");
  }
  std::vector<Step> out;
  for (std::size_t i = 1; i < rows->size(); ++i) {
    SeparatedRow& row = (*rows)[i];
    if (row.cells.size() != head.size()) {
      return wrong(file, row.line, std::to_string(row.cells.size()) + " cells",
                   std::to_string(head.size()) + ", as the first row has");
    }
    Split names = split(head, head);
    Split cells = split(head, std::move(row.cells));
    std::vector<std::string_view> from_log;
    for (const Default& d : kDefaults) {
      const std::size_t at = place_of(names.of_case, d.name);
      if (at == names.of_case.size()) {
        names.of_case.emplace_back(d.name);
        cells.of_case.emplace_back();
      }
      if (!cells.of_case[at].empty()) continue;
      cells.of_case[at] = d.value;
      if (d.from_log) from_log.push_back(d.name);
    }
    auto one = from_csv(row_of(names.of_case) + row_of(cells.of_case), file);
    if (!one) {
      const bool of_head = one.error().line == 1;
      return wrong(file, of_head ? rows->front().line : row.line, one.error().message, "a column of a case");
    }
    Step step{.id = one->front().from.workingstep,
              .tool = 0,
              .planned = one->front(),
              .characteristics = words_of(cells.characteristics),
              .parts = {}};
    if (step.id.empty()) return wrong(file, row.line, "the step has no name", "a cell in 'workingstep'");
    for (const std::string_view name : from_log)
      (name == "fz_mm" ? step.planned.bound.fz_mm : step.planned.bound.vc_m_min) = 0.0;
    if (!cells.tool.empty()) {
      const auto number = whole(cells.tool);
      if (!number || *number > 1'000'000)
        return wrong(file, row.line, "'" + cells.tool.substr(0, 40) + "' is no tool", "a whole number");
      step.tool = static_cast<int>(*number);
    }
    for (const std::string& word : words_of(cells.parts)) {
      const auto range = range_of(word);
      if (!range) return wrong(file, row.line, "'" + word.substr(0, 40) + "' is no part", "\"1-9 20\"");
      step.parts.push_back(*range);
    }
    const auto same =
        std::find_if(out.begin(), out.end(), [&](const Step& s) { return s.id == step.id && meet(s, step); });
    if (same != out.end())
      return wrong(file, row.line, "two steps of one part are called '" + step.id.substr(0, 40) + "'",
                   "a name of its own, or other parts");
    out.push_back(std::move(step));
  }
  return out;
}

}  // namespace capstan::casebase::retain
