#include "planner/model/features/fit/fit.h"

#include <algorithm>
#include <cctype>
#include <cmath>

#include "planner/ground/base/number.h"
#include "planner/model/features/fit/deviation.h"

namespace capstan::model {
namespace {

constexpr std::string_view kExpected =
    "a letter (A to ZC for a hole, a to zc for a shaft) and a grade, 01 to 18";

bool is_upper(char c) { return std::isupper(static_cast<unsigned char>(c)) != 0; }
bool is_lower(char c) { return std::islower(static_cast<unsigned char>(c)) != 0; }
char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

std::string_view trimmed_text(std::string_view s) {
  while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
  while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
  return s;
}

tl::unexpected<Diagnostic> no_class(std::string_view designation, std::string_view why,
                                    std::string hint = {}) {
  return fail(Diagnostic{
      .code = "MDL-FIT",
      .message = "\"" + std::string(designation) + "\" is no tolerance class of ISO 286: " + std::string(why),
      .expected = std::string(kExpected),
      .hint = std::move(hint)});
}

std::optional<int> grade_from(std::string_view digits) {
  if (digits == "01") return kIt01;
  if (digits.empty() || digits.size() > 2 || (digits.size() == 2 && digits[0] == '0')) return std::nullopt;
  int n = 0;
  for (const char c : digits) {
    if (c < '0' || c > '9') return std::nullopt;
    n = 10 * n + (c - '0');
  }
  if (n > kCoarsestGrade) return std::nullopt;
  return n;
}

std::string size_text(double mm) { return std::isfinite(mm) ? trimmed(mm, 4) + " mm" : "an endless size"; }

// Why the tables are silent, most general reason first.
std::string silence(double nominal_mm, const FitClass& c) {
  if (!(nominal_mm > 0.0) || nominal_mm > kLargestSize) {
    return "ISO 286 speaks of sizes above 0 up to " + size_text(kLargestSize);
  }
  if (!tolerance_grade(nominal_mm, c.grade)) {
    return grade_name(c.grade) + " is stated up to " + size_text(kLargestCommonSize);
  }
  const auto span = sizes_of(c.letter);
  std::string name(c.letter);
  if (c.hole)
    std::transform(name.begin(), name.end(), name.begin(),
                   [](char x) { return static_cast<char>(std::toupper(static_cast<unsigned char>(x))); });
  if (nominal_mm <= span.over_mm || nominal_mm > span.upto_mm) {
    return name + " is stated above " + size_text(span.over_mm) + " up to " + size_text(span.upto_mm);
  }
  if (nominal_mm <= 1.0 && (c.grade >= 14 || (c.letter == "n" && c.grade > 8))) return "above 1 mm only";
  if (c.letter == "j") {
    return c.hole ? "J is stated for IT6 to IT8" : "j is stated for IT5 to IT7, and for IT8 up to 3 mm";
  }
  if (c.hole && c.letter == "k" && c.grade > 8) return "K is stated to IT8, above that up to 3 mm only";
  return "the value delta that raises " + name + " is stated from IT3";
}

tl::unexpected<Diagnostic> not_stated(double nominal_mm, const FitClass& c) {
  return fail(Diagnostic{.code = "MDL-FIT",
                         .message = "ISO 286 has no limits for " + size_text(nominal_mm) + " " + to_text(c),
                         .expected = silence(nominal_mm, c)});
}

}  // namespace

Result<FitClass> parse_fit(std::string_view designation) {
  const auto text = trimmed_text(designation);
  const auto digit = std::find_if(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  const auto n = static_cast<std::size_t>(digit - text.begin());
  const auto letters = text.substr(0, n), digits = text.substr(n);
  if (letters.empty() || digits.empty()) return no_class(designation, "a letter and a grade make one");
  const bool hole = std::all_of(letters.begin(), letters.end(), is_upper);
  if (!hole && !std::all_of(letters.begin(), letters.end(), is_lower)) {
    return no_class(designation, "its letters are not all upper or all lower case",
                    "JS9 is a hole's, js9 a shaft's");
  }
  std::string name(letters);
  std::transform(name.begin(), name.end(), name.begin(), lower);
  const auto& known = fit_letters();
  const auto letter = std::find(known.begin(), known.end(), name);
  if (letter == known.end()) return no_class(designation, "it has no letter " + std::string(letters));
  const auto grade = grade_from(digits);
  if (!grade) return no_class(designation, "it has no grade " + std::string(digits));
  return FitClass{*letter, hole, *grade};
}

std::string to_text(const FitClass& c) {
  std::string out(c.letter);
  if (c.hole)
    std::transform(out.begin(), out.end(), out.begin(),
                   [](char x) { return static_cast<char>(std::toupper(static_cast<unsigned char>(x))); });
  return out + grade_name(c.grade).substr(2);
}

Result<Deviations> fit(double nominal_mm, const FitClass& c) {
  const auto tolerance = tolerance_grade(nominal_mm, c.grade);
  if (!tolerance || (nominal_mm <= 1.0 && c.grade >= 14)) return not_stated(nominal_mm, c);
  const double it = 1000.0 * *tolerance;
  const auto limits = [](double lower_um, double upper_um) {
    return Deviations{from_micrometres(lower_um), from_micrometres(upper_um)};
  };
  if (c.letter == "js") return limits(-0.5 * it, 0.5 * it);
  const auto at = c.hole ? hole_deviation_um(nominal_mm, c.letter, c.grade)
                         : shaft_deviation_um(nominal_mm, c.letter, c.grade);
  if (!at) return not_stated(nominal_mm, c);
  // The stated limit of a hole is the lower one up to H, that of a shaft the upper one up to h.
  const bool lower_stated = c.hole == (c.letter[0] <= 'h');
  return lower_stated ? limits(*at, *at + it) : limits(*at - it, *at);
}

Result<Deviations> fit(double nominal_mm, std::string_view designation) {
  const auto c = parse_fit(designation);
  if (!c) return tl::unexpected(c.error());
  return fit(nominal_mm, *c);
}

}  // namespace capstan::model
