#include "casebase/retain/join/import.h"

#include <array>
#include <iterator>
#include <map>
#include <utility>

#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

constexpr std::array<std::pair<std::string_view, LogFormat>, 5> kWords = {{{"trace", LogFormat::kTrace},
                                                                           {"csv", LogFormat::kCsv},
                                                                           {"linuxcnc", LogFormat::kLinuxcnc},
                                                                           {"times", LogFormat::kTimes},
                                                                           {"wear", LogFormat::kWear}}};

// A row of a summary as what a log would have shown.
Executed executed_of(const Timed& t) {
  Executed e;
  e.run = kSummedUp;
  e.workingstep = t.workingstep;
  e.tool = t.tool;
  e.active_s = t.active_s;
  e.moving_s = t.moving_s > 0.0 ? t.moving_s : t.active_s;
  e.path_mm = t.path_mm;
  e.first_log_line = e.last_log_line = t.line;
  const auto hold = [&](Item item, double value) {
    if (value > 0.0) e.number[index_of(item)] = {e.moving_s, value, value, value, e.moving_s};
  };
  hold(Item::kSpindle, t.spindle_rpm);
  hold(Item::kFeed, t.feed_mm_min);
  return e;
}

std::string whole(std::istream& in) { return {std::istreambuf_iterator<char>(in), {}}; }

Result<std::vector<Case>> import_times(std::istream& in, std::span<const Step> steps, LogFrom from,
                                       const ImportOptions& options, Job& job) {
  const auto rows = read_times(whole(in), from.file, job);
  if (!rows) return tl::unexpected(rows.error());
  // Parts in the order in which the table names them first.
  std::vector<std::pair<std::string, std::vector<Executed>>> parts;
  std::map<std::string, std::size_t> at;
  for (const Timed& t : *rows) {
    if (!from.part.empty() && t.part != from.part) continue;
    const auto [found, fresh] = at.emplace(t.part, parts.size());
    if (fresh) parts.emplace_back(t.part, std::vector<Executed>{});
    parts[found->second].second.push_back(executed_of(t));
  }
  std::vector<Case> out;
  for (const auto& [part, executed] : parts) {
    from.part = part;
    std::vector<Case> cases = cases_of(steps, executed, nullptr, from, job);
    add_inspection(options.inspection, steps, from, cases, job);
    out.insert(out.end(), std::make_move_iterator(cases.begin()), std::make_move_iterator(cases.end()));
  }
  return out;
}

Result<std::vector<Case>> import_wear(std::istream& in, std::span<const Step> steps, const LogFrom& from,
                                      const ImportOptions& options, Job& job) {
  auto rows = read_wear(whole(in), from.file, options.units.value_or(LogUnits{}).mm, job);
  if (!rows) return tl::unexpected(rows.error());
  if (!from.part.empty()) {
    // A row that names no part is of the one that is named.
    for (Worn& w : *rows) {
      if (w.part.empty()) w.part = from.part;
    }
    std::erase_if(*rows, [&](const Worn& w) { return w.part != from.part; });
  }
  return cases_of_wear(steps, *rows, from, job);
}

}  // namespace

std::optional<LogFormat> log_format_of(std::string_view word) {
  for (const auto& [name, format] : kWords) {
    if (name == word) return format;
  }
  return std::nullopt;
}

std::optional<Trigger> trigger_of(std::string_view text) {
  const auto above = text.find('>');
  if (above == std::string_view::npos) return std::nullopt;
  std::string_view rest = text.substr(above + 1);
  Trigger out;
  if (const auto colon = rest.find(':'); colon != std::string_view::npos) {
    const auto seconds = parse_double(rest.substr(colon + 1));
    if (!seconds || *seconds < 0.0) return std::nullopt;
    out.for_s = *seconds;
    rest = rest.substr(0, colon);
  }
  const auto limit = parse_double(rest);
  if (!limit || *limit < 0.0) return std::nullopt;
  out.above = *limit;
  for (std::size_t i = 0; i < kNumbers; ++i) {
    out.item = static_cast<Item>(i);
    if (name_of(out.item) == text.substr(0, above)) return out;
  }
  return std::nullopt;
}

Result<std::vector<Case>> import_log(std::istream& in, LogFormat format, std::span<const Step> steps,
                                     const LogFrom& from, const ImportOptions& options, Job& job) {
  Result<std::vector<Case>> cases;
  if (format == LogFormat::kTimes) {
    cases = import_times(in, steps, from, options, job);
    if (!cases) return cases;
  } else if (format == LogFormat::kWear) {
    cases = import_wear(in, steps, from, options, job);
    if (!cases) return cases;
  } else {
    Splitter splitter({.marks = options.marks,
                       .triggers = options.triggers,
                       .runs_unless_said = format != LogFormat::kTrace});
    const Sink sink = [&](const Reading& r) { splitter.take(r); };
    const auto end =
        format == LogFormat::kTrace
            ? read_trace(in, from.file, options.units.value_or(kTraceUnits), sink, job)
        : format == LogFormat::kCsv
            ? read_table(in, from.file, options.units.value_or(LogUnits{}), options.columns, sink, job)
            : read_linuxcnc(in, from.file, options.units.value_or(LogUnits{}), options.columns,
                            options.period_s, sink, job);
    if (!end) return tl::unexpected(end.error());
    LogFrom dated = from;
    dated.dated = end->dated;
    cases = cases_of(steps, splitter.end(), options.marks, dated, job);
    add_inspection(options.inspection, steps, dated, *cases, job);
  }
  if (cases->empty()) {
    return fail(Diagnostic{.code = "LOG-JOIN",
                           .message = "no step of the plan is shown whole by the log",
                           .file = from.file,
                           .expected = "a log that names workingsteps, or lines of a program whose markers "
                                       "are given, or tools that one step uses each",
                           .hint = "the notes say what was left out and why; --program gives the markers"});
  }
  return cases;
}

}  // namespace capstan::casebase::retain
