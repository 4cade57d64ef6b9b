#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/files/p21/file.h"

namespace capstan::p21 {

/// UTF-8 as the inside of a Part 21 string: quotes and backslashes doubled, everything outside
/// printable ASCII as \X2\ or \X4\. Invalid UTF-8 throws std::logic_error: decode before writing.
[[nodiscard]] std::string encode_text(std::string_view utf8);
/// The same between its apostrophes: a whole Part 21 string.
[[nodiscard]] std::string quoted(std::string_view utf8);

/// Writes an exchange file from top to bottom:
///
///     Writer w;
///     w.entity("FILE_DESCRIPTION").list().text("").end().text("2;1").end();   // and the other two
///     w.data();
///     w.instance(1, "CARTESIAN_POINT").text("").list().real(0).real(1.5).end().end();
///     w.complex(2).part("NAMED_UNIT").derived().end().part("SI_UNIT").omitted().end().end();
///     std::string bytes = std::move(w).finish();
///
/// `end()` closes what was opened last: list, typed parameter, part, instance or entity. One instance
/// per line. Misuse (a value outside an entity, a bad keyword, an entity left open) throws
/// std::logic_error. Instance numbers must be above 0; that they are unique is the caller's part.
class Writer {
 public:
  Writer();

  // Structure.
  Writer& entity(std::string_view keyword);  ///< a header entity; "!NAME" for a user-defined one
  /// A verbatim section of edition 3: ANCHOR and REFERENCE before the data, SIGNATURE last.
  Writer& section(std::string_view keyword, std::string_view text);
  Writer& data();  ///< begins a data section
  Writer& data(std::string_view name, const std::vector<std::string>& schemas);
  Writer& data(const Value& parameters);
  Writer& instance(std::uint64_t id, std::string_view keyword);
  Writer& complex(std::uint64_t id);
  Writer& part(std::string_view keyword);  ///< of a complex instance
  Writer& list();
  Writer& typed(std::string_view keyword);
  Writer& end();

  // Parameters.
  Writer& omitted();  ///< $
  Writer& derived();  ///< *
  Writer& integer(std::int64_t v);
  Writer& real(double v);  ///< by part21_real: reads back to the same double; finite
  /// A real as it was spelled elsewhere; must be one.
  Writer& real_lexeme(std::string_view lexeme);
  Writer& text(std::string_view utf8);
  Writer& enumeration(std::string_view name);  ///< without dots
  Writer& boolean(bool v) { return enumeration(v ? "T" : "F"); }
  Writer& binary(std::string_view hex);
  Writer& reference(std::uint64_t id);
  Writer& value(const Value& v);  ///< any parameter of a parsed file, with all that is in it

  /// Closes the file and yields its text.
  [[nodiscard]] std::string finish() &&;

 private:
  enum class Open : std::uint8_t { kEntity, kInstance, kComplex, kPart, kList, kTyped };
  enum class Place : std::uint8_t { kHeader, kBeforeData, kData, kBetween, kEnded };

  void begin_value();
  void end_header();
  void end_data();
  void append_keyword(std::string_view keyword);
  void append_id(std::uint64_t id);

  std::string out_;
  std::vector<Open> open_;
  bool comma_ = false;
  Place place_ = Place::kHeader;
};

/// A parsed file as text: one instance per line, no comments, strings re-encoded, numbers as they were
/// spelled (put right where the spelling was only tolerated). print(parse(x)) reads back to the same
/// content, and printing that again gives the same bytes.
[[nodiscard]] std::string print(const File& file);

}  // namespace capstan::p21
