#include "casebase/retain/cells.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

#include "planner/ground/base/no_number.h"
#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

constexpr double kTimeMaxS = 1e11;  // of a clock, since 1970: more is a damaged log. Default, unsourced
constexpr double kWholeMax = 1e9;   // tools and lines of programs: more is a damaged log

// Words of a program that runs, or that goes on after a stop: it is one execution still.
// Source: MTConnect, part 3, EXECUTION.
constexpr std::array<std::string_view, 6> kExecuting = {"ACTIVE", "FEED_HOLD",     "INTERRUPTED",
                                                        "WAIT",   "OPTIONAL_STOP", "PROGRAM_OPTIONAL_STOP"};

bool digits(std::string_view text, std::size_t at, std::size_t n, int& out) {
  if (at + n > text.size()) return false;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + at + n, out);
  return error == std::errc() && end == text.data() + at + n && text[at] != '-';
}

// Days from 1970-01-01 to a date of the Gregorian calendar.
// Source: H. Hinnant, "chrono-Compatible Low-Level Date Algorithms", days_from_civil.
long days_of(long y, long m, long d) {
  y -= m <= 2 ? 1 : 0;
  const long era = y / 400;
  const long of_era = y - era * 400;
  const long of_year = (153 * (m + (m > 2 ? -3 : 9)) + 2) / 5 + d - 1;
  return era * 146097 + of_era * 365 + of_era / 4 - of_era / 100 + of_year - 719468;
}

bool equal_letters(std::string_view a, std::string_view upper) {
  if (a.size() != upper.size()) return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char c = a[i] >= 'a' && a[i] <= 'z' ? static_cast<char>(a[i] - 'a' + 'A') : a[i];
    if (c != upper[i]) return false;
  }
  return true;
}

}  // namespace

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::optional<double> seconds_of(std::string_view s) {
  int year = 0, month = 0, day = 0, hour = 0, minute = 0, second = 0;
  if (s.size() < 19 || s[4] != '-' || s[7] != '-' || (s[10] != 'T' && s[10] != ' ') || s[13] != ':' ||
      s[16] != ':') {
    return std::nullopt;
  }
  if (!digits(s, 0, 4, year) || !digits(s, 5, 2, month) || !digits(s, 8, 2, day) || !digits(s, 11, 2, hour) ||
      !digits(s, 14, 2, minute) || !digits(s, 17, 2, second)) {
    return std::nullopt;
  }
  constexpr int kDays[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};
  const bool leap = year % 4 == 0 && (year % 100 != 0 || year % 400 == 0);
  if (year < 1970 || month < 1 || month > 12 || day < 1 ||
      day > kDays[month - 1] + (month == 2 && leap ? 1 : 0) || hour > 23 || minute > 59 || second > 60) {
    return std::nullopt;
  }
  std::string_view rest = s.substr(19);
  if (rest.ends_with('Z')) rest.remove_suffix(1);
  double fraction = 0.0;
  if (!rest.empty()) {
    if (rest[0] != '.' || rest.size() < 2 || rest.size() > 16 ||
        rest.find_first_not_of("0123456789", 1) != std::string_view::npos) {
      return std::nullopt;
    }
    fraction = parse_double("0" + std::string(rest)).value_or(0.0);
  }
  return static_cast<double>(days_of(year, month, day)) * 86400.0 + hour * 3600.0 + minute * 60.0 + second +
         fraction;
}

std::string stamp_of(double seconds) {
  constexpr double kYear10000 = 253402300800.0;
  if (!(seconds >= 0.0) || seconds >= kYear10000) return {};
  const long whole = static_cast<long>(seconds);
  // The year by a guess that is never late, then the month.
  long year = 1970 + whole / 31622400;
  while (days_of(year + 1, 1, 1) * 86400 <= whole) ++year;
  long month = 1;
  while (month < 12 && days_of(year, month + 1, 1) * 86400 <= whole) ++month;
  const long left = whole - days_of(year, month, 1) * 86400;
  return fmt::format("{:04}-{:02}-{:02}T{:02}:{:02}:{:02}Z", year, month, left / 86400 + 1,
                     left % 86400 / 3600, left % 3600 / 60, left % 60);
}

std::optional<std::string> put(Reading& r, const Column& column, std::string_view cell) {
  const std::string_view text = without_blanks(cell);
  if (text.empty() || equal_letters(text, "UNAVAILABLE")) return std::nullopt;
  switch (column.item) {
    case Item::kRunning:
      r.running = text == "1" || equal_letters(text, "TRUE") ||
                  std::any_of(kExecuting.begin(), kExecuting.end(),
                              [&](std::string_view word) { return equal_letters(text, word); });
      return std::nullopt;
    case Item::kWorkingstep:
      r.workingstep = text;
      return std::nullopt;
    case Item::kToolInstance:
      r.tool_instance = text;
      return std::nullopt;
    case Item::kProgram:
      r.program = text;
      return std::nullopt;
    default:
      break;
  }
  const std::optional<double> number = parse_double(text);
  if (!number) {
    std::string why = no_number(std::string(text.substr(0, 40)));
    if (text.find(',') != std::string_view::npos) why += "; decimals are written with a point";
    return why;
  }
  if (column.item == Item::kTool || column.item == Item::kLine) {
    if (*number != std::floor(*number) || *number < 0.0 || *number > kWholeMax) {
      return fmt::format("{} is no number of a {}", shortest(*number),
                         column.item == Item::kTool ? "tool" : "line of a program");
    }
    if (column.item == Item::kTool) {
      r.tool = static_cast<int>(*number);
    } else {
      r.program_line = static_cast<long>(*number);
    }
    return std::nullopt;
  }
  if (column.item == Item::kTime) {
    r.t_s = *number * column.factor;
    if (!(r.t_s >= 0.0 && r.t_s <= kTimeMaxS)) return shortest(*number) + " is no time (0 to 1e11 s)";
    return std::nullopt;
  }
  const double value = *number * column.factor;
  if (auto wrong = fault_of(column.item, value)) return wrong;
  r.set(column.item, value);
  return std::nullopt;
}

std::optional<std::string> Clock::step(double t_s) {
  if (last_ && t_s < *last_) {
    return fmt::format("the time goes back by {} s", trimmed(*last_ - t_s, 3));
  }
  last_ = t_s;
  return std::nullopt;
}

Result<LogEnd> ended(const Lines& lines, const LostLines& lost, LogEnd out, const std::string& expected,
                     Job& job) {
  if (lines.fault()) return fail(*lines.fault());
  out.lines = lines.number();
  out.lost = lost.count();
  if (auto ok = lost.end(lines.file(), out.lines, expected, job); !ok) return tl::unexpected(ok.error());
  if (out.readings == 0) {
    return fail(Diagnostic{.code = "LOG-EMPTY",
                           .message = "there is no reading in it",
                           .file = lines.file(),
                           .expected = expected,
                           .hint = "was the recorder running?"});
  }
  return out;
}

}  // namespace capstan::casebase::retain
