#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

#include "casebase/record/case.h"

/// The one table of what a case holds: the id, the stored record, CSV, JSON, texts and the limits visit it.
/// A new number of a case is a member of its struct and a row here.
namespace capstan::casebase {

/// How a text is limited.
enum class TextKind : std::uint8_t {
  kKeyword,       ///< 1 to 80 of letters, digits and `_ . / + -`
  kMaybeKeyword,  ///< the same, or empty
  kText,          ///< at most 1000 bytes without control characters
  kSource,        ///< the same, but not empty
  kTime,          ///< ISO 8601 in UTC to the second, or empty
};

using TextAt = std::string& (*)(Case&);
using NumberAt = double& (*)(Case&);
using CountAt = int& (*)(Case&);
using FigureAt = std::optional<Figure>& (*)(Case&);
using SeriesAt = Series& (*)(Case&);
/// A value of an enumeration, by its word.
struct WordAt {
  std::string_view (*get)(const Case&);
  bool (*set)(Case&, std::string_view);  ///< false: no such word
};
using FieldPlace = std::variant<TextAt, NumberAt, CountAt, FigureAt, SeriesAt, WordAt>;

struct Field {
  std::uint8_t tag;  ///< names the field in stored records: never changed, never used again
  std::string_view name;
  std::string_view unit;  ///< "mm", "1", ...; empty: it has none
  FieldPlace at;
  double low = 0.0, high = 0.0;             ///< physical limits of numbers, both allowed
  TextKind text = TextKind::kMaybeKeyword;  ///< of texts
  bool needed = false;                      ///< a record from outside that lacks it is refused
};

/// All fields by rising tag. The question's come first: they are `question_fields()`.
[[nodiscard]] std::span<const Field> fields();
[[nodiscard]] std::span<const Field> question_fields();
/// The field of a name that the table has, e.g. for its limits. Throws std::logic_error for another name.
[[nodiscard]] const Field& field_named(std::string_view name);

/// The place of a field in a case that may only be read.
template <class At>
[[nodiscard]] const auto& value(At at, const Case& c) {
  return at(const_cast<Case&>(c));
}

/// Whether a field has its default: it is not known, and left out of stored records.
[[nodiscard]] bool is_default(const Field& f, const Case& c);

}  // namespace capstan::casebase
