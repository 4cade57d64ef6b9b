#include "casebase/retain/cells.h"
#include "casebase/retain/lines.h"

namespace capstan::casebase::retain {
namespace {

constexpr const char* kExpected = "TIME|ITEM|VALUE, e.g. 2017-02-01T14:59:58.28Z|Feed_Rate|11.4";

std::string_view taken(std::string_view& rest) {
  const auto end = rest.find('|');
  const std::string_view out = rest.substr(0, end);
  rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
  return out;
}

// One line; what is wrong with it. Items that are not known set nothing.
std::optional<std::string> read_line(std::string_view line, const LogUnits& units, Clock& clock, Reading& r) {
  if (line.find('|') == std::string_view::npos) return "there is no | in it";
  const auto at = seconds_of(without_blanks(taken(line)));
  if (!at) return "it does not begin with a time";
  if (line.find('|') == std::string_view::npos) return "an item has no value";
  if (auto back = clock.step(*at)) return back;
  r.t_s = *at;
  while (!line.empty()) {
    std::string_view name = without_blanks(taken(line));
    const std::string_view value = taken(line);
    // "device:item": adapters of several machines.
    if (const auto colon = name.rfind(':'); colon != std::string_view::npos) name.remove_prefix(colon + 1);
    const auto column = column_of(name, units);
    if (!column || column->item == Item::kTime) continue;
    if (auto wrong = put(r, *column, value)) return std::string(name.substr(0, 40)) + ": " + *wrong;
  }
  return std::nullopt;
}

}  // namespace

Result<LogEnd> read_trace(std::istream& in, const std::string& file, const LogUnits& units, const Sink& sink,
                          Job& job) {
  Lines lines(in, file);
  LostLines lost;
  LogEnd out{.dated = true};
  Clock clock;
  while (const auto line = lines.next()) {
    if (without_blanks(*line).empty() || line->starts_with('*')) continue;  // `* PONG` and the like
    Reading r{.line = lines.number()};
    if (auto wrong = read_line(*line, units, clock, r)) {
      lost.lose(lines.number(), *std::move(wrong));
      continue;
    }
    ++out.readings;
    out.says_running = out.says_running || r.running.has_value();
    sink(r);
  }
  return ended(lines, lost, out, kExpected, job);
}

}  // namespace capstan::casebase::retain
