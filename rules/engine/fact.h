#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::rules {

/// How a fact is valued. Integers are numbers whose intervals may also name an inclusive end.
enum class FactKind : std::uint8_t { kNumber, kInteger, kSymbol };

/// Something a row may ask about: its name, and every value it can take.
///
/// Units   numbers wear theirs in the name (diameter_mm, chamfer_angle_deg).
struct FactType {
  std::string_view name;
  FactKind kind = FactKind::kNumber;
  double from = 0.0, below = 0.0;         ///< numbers: the domain, [from, below)
  std::vector<std::string_view> symbols;  ///< symbols: the domain, at most 32
  std::string_view meaning;
};

/// Every fact there is. A row cannot ask about anything else.
[[nodiscard]] const std::vector<FactType>& fact_types();
[[nodiscard]] std::optional<std::size_t> find_fact(std::string_view name);

/// Known facts about one feature: a value per fact, or none. Symbols are stored as their index in the domain.
class Facts {
 public:
  Facts() : values_(fact_types().size()) {}
  /// Throws std::logic_error for a name or symbol that does not exist.
  void set(std::string_view fact, double value);
  void set(std::string_view fact, std::string_view symbol);
  [[nodiscard]] std::optional<double> value(std::size_t fact) const { return values_.at(fact); }
  [[nodiscard]] std::optional<double> number(std::string_view fact) const;
  /// The symbol's text; empty when unknown.
  [[nodiscard]] std::string_view symbol(std::string_view fact) const;
  /// "it_grade = 7", for people.
  [[nodiscard]] std::string text(std::size_t fact) const;

 private:
  std::vector<std::optional<double>> values_;
};

}  // namespace capstan::rules
