#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

#include "casebase/retain/join/join.h"
#include "planner/ground/base/text.h"

/// What joining says of rows and steps, and texts of files as records may hold them.
namespace capstan::casebase::retain {

inline constexpr std::size_t kLongestText = 200;  ///< of names that go into a case or a message

/// A note on what makes no case.
[[nodiscard]] inline Diagnostic left_out(const LogFrom& from, std::uint64_t line, std::string message,
                                         std::string step) {
  return {.code = "LOG-STEP",
          .severity = Severity::kNote,
          .message = std::move(message),
          .file = from.file,
          .line = line,
          .path = std::move(step)};
}

/// The text without characters that a record may not hold, as UTF-8.
[[nodiscard]] inline std::string printable(std::string_view text) {
  std::string out = utf8_text(text, kLongestText);
  for (char& c : out) {
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  }
  return out;
}

/// Name of the log without its folders: what a case is must not depend on how its path is spelt.
[[nodiscard]] inline std::string name_of_log(const LogFrom& from) {
  return from.file.substr(from.file.find_last_of('/') + 1);
}
/// What cases of a log state as their source.
[[nodiscard]] inline std::string source_of(const LogFrom& from) {
  return "log " + printable(name_of_log(from));
}

}  // namespace capstan::casebase::retain
