#pragma once

#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
#include <string>
#include <string_view>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"

namespace capstan::casebase::retain {

/// Lines of a log, one at a time, however long the log is: one line is held in memory, no more. A mark of
/// byte order and the carriage return before a line feed are passed over.
class Lines {
 public:
  static constexpr std::size_t kLongest = std::size_t{64} << 10U;  ///< bytes of a line; default, unsourced

  Lines(std::istream& in, std::string file) : in_(in), file_(std::move(file)) {}

  /// The next line; nothing at the end of the log, or when it is no text (`fault`).
  [[nodiscard]] std::optional<std::string_view> next();
  [[nodiscard]] std::uint64_t number() const { return number_; }  ///< of the line that `next` gave, from 1
  [[nodiscard]] const std::string& file() const { return file_; }
  /// LOG-TEXT: a NUL byte (a binary file, UTF-16), a line longer than kLongest, a read error.
  [[nodiscard]] const std::optional<Diagnostic>& fault() const { return fault_; }

 private:
  [[nodiscard]] std::optional<std::string_view> refuse(std::string message, std::string expected);
  std::istream& in_;
  std::string file_, line_;
  std::uint64_t number_ = 0;
  std::optional<Diagnostic> fault_;
};

/// Lines that could not be taken. A recorder that loses a line now and then is usual: they are left out and
/// reported in one warning. A log of which more than one line in a hundred cannot be read is another kind of
/// file, and refused. The share, and the two lines that any log may lose, are defaults, unsourced.
class LostLines {
 public:
  void lose(std::uint64_t line, std::string why);
  [[nodiscard]] std::uint64_t count() const { return count_; }
  /// Warns LOG-LINES of what was left out of `lines`. Fails LOG-FORMAT when that is too much: `expected` says
  /// what a line should be.
  [[nodiscard]] Status end(const std::string& file, std::uint64_t lines, const std::string& expected,
                           Job& job) const;

 private:
  std::uint64_t count_ = 0, first_ = 0;
  std::string why_;
};

}  // namespace capstan::casebase::retain
