#pragma once

#include <cstdint>
#include <string>
#include <tl/expected.hpp>
#include <utility>

namespace capstan {

enum class Severity : std::uint8_t { kNote, kWarning, kError };

/// One thing to say about an input, a plan or a program: where, what, what was expected, what to do.
///
/// Printed as `file:line: severity: #instance path: message; expected; hint [CODE]` by `to_text`.
struct Diagnostic {
  std::string code;  ///< stable, upper case, e.g. "P21-SYNTAX"
  Severity severity = Severity::kError;
  std::string message;         ///< what is the matter, a sentence without a full stop
  std::string file = {};       ///< as the user named it; empty when not about a file
  std::uint64_t line = 0;      ///< 1-based; 0 unknown
  std::uint64_t instance = 0;  ///< Part 21 instance number; 0 none
  std::string path = {};       ///< attribute or workingstep, e.g. "its_boss"
  std::string expected = {};   ///< what should have stood there
  std::string hint = {};       ///< what the reader can do
  friend bool operator==(const Diagnostic&, const Diagnostic&) = default;
};

/// A value, or the one diagnostic that says why there is none. Outcomes that are not faults
/// (infeasible, no tool fits) are values, not errors. Keep to members that std::expected shares.
template <class T>
using Result = tl::expected<T, Diagnostic>;

using Status = Result<void>;

[[nodiscard]] inline tl::unexpected<Diagnostic> fail(Diagnostic d) {
  return tl::unexpected<Diagnostic>(std::move(d));
}

/// Shorthand for an error without a place.
[[nodiscard]] inline tl::unexpected<Diagnostic> fail(std::string code, std::string message) {
  return fail(Diagnostic{.code = std::move(code), .message = std::move(message)});
}

/// The one line a compiler would print.
[[nodiscard]] std::string to_text(const Diagnostic& d);

[[nodiscard]] const char* to_text(Severity s);

}  // namespace capstan
