#include "casebase/retain/lines.h"

#include <fmt/format.h>

#include <utility>

#include "planner/ground/base/number.h"

namespace capstan::casebase::retain {
namespace {

constexpr std::uint64_t kAlwaysForgiven = 2;
constexpr std::uint64_t kForgivenShare = 100;  // one line in so many

}  // namespace

std::optional<std::string_view> Lines::refuse(std::string message, std::string expected) {
  fault_ = Diagnostic{.code = "LOG-TEXT",
                      .message = std::move(message),
                      .file = file_,
                      .line = number_,
                      .expected = std::move(expected),
                      .hint = "is it the file that was meant?"};
  return std::nullopt;
}

std::optional<std::string_view> Lines::next() {
  if (fault_) return std::nullopt;
  line_.clear();
  std::streambuf* const bytes = in_.rdbuf();
  constexpr int kEnd = std::char_traits<char>::eof();
  int c = bytes->sbumpc();
  if (c == kEnd) return std::nullopt;
  ++number_;
  for (; c != kEnd && c != '\n'; c = bytes->sbumpc()) {
    if (c == 0) return refuse("there is a NUL byte in the line", "text in UTF-8");
    if (line_.size() == kLongest) {
      return refuse(fmt::format("the line is longer than {} bytes", kLongest), "a line per reading");
    }
    line_.push_back(static_cast<char>(c));
  }
  std::string_view out = line_;
  if (number_ == 1 && out.starts_with("\xEF\xBB\xBF")) out.remove_prefix(3);
  if (out.ends_with('\r')) out.remove_suffix(1);
  return out;
}

void LostLines::lose(std::uint64_t line, std::string why) {
  if (count_++ != 0) return;
  first_ = line;
  why_ = std::move(why);
}

Status LostLines::end(const std::string& file, std::uint64_t lines, const std::string& expected,
                      Job& job) const {
  if (count_ == 0) return {};
  Diagnostic d{.code = "LOG-LINES",
               .severity = Severity::kWarning,
               .message = fmt::format("{} of {} left out; the first: {}", counted(count_, "line", "lines"),
                                      lines, why_),
               .file = file,
               .line = first_,
               .expected = expected};
  if (count_ <= kAlwaysForgiven || count_ <= lines / kForgivenShare) {
    job.report(std::move(d));
    return {};
  }
  d.code = "LOG-FORMAT";
  d.severity = Severity::kError;
  d.message =
      fmt::format("{} of {} cannot be read; the first: {}", counted(count_, "line", "lines"), lines, why_);
  d.hint = "name the format of the file, or the columns and units that it has";
  return fail(std::move(d));
}

}  // namespace capstan::casebase::retain
