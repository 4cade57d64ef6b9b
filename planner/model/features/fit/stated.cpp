#include "planner/model/features/fit/stated.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "planner/model/features/fit/deviation.h"
#include "planner/model/nouns/support.h"

namespace capstan::model {
namespace {

constexpr double kSame = 5e-5;     // mm; half the last digit of the standard's tables
constexpr double kRounded = 5e-4;  // mm; a limit stated in whole micrometres
constexpr double kEmpty = 1e-9;    // mm; a width below is none

enum class Side { kUnknown, kHole, kShaft };

tl::unexpected<Diagnostic> wrong(std::string message, std::string expected, std::string hint = {}) {
  return fail(Diagnostic{.code = "MDL-TOLERANCE",
                         .message = std::move(message),
                         .expected = std::move(expected),
                         .hint = std::move(hint)});
}

std::string text_of(const Deviations& d) { return mm_text(d.lower_mm, 5) + " to " + mm_text(d.upper_mm, 5); }

std::string plain(const Text& t) {
  std::string out;
  for (const char c : t.value_or("")) {
    if (c != ' ') out += c;
  }
  return out;
}
std::string lowered(std::string s) {
  for (char& c : s) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return s;
}

Result<Side> side_of(const LimitsAndFits& t) {
  const std::string zone = lowered(plain(t.zone_variance));
  const Side by_zone = zone == "hole" ? Side::kHole : zone == "shaft" ? Side::kShaft : Side::kUnknown;
  const Side by_type = t.its_fitting_type == FittingType::kHole    ? Side::kHole
                       : t.its_fitting_type == FittingType::kShaft ? Side::kShaft
                                                                   : Side::kUnknown;
  if (by_zone == Side::kUnknown) return by_type;
  if (by_type != Side::kUnknown && by_type != by_zone)
    return wrong("a fit is called a hole's and a shaft's at once",
                 "zone_variance and its_fitting_type agreeing");
  return by_zone;
}

// The number of the grade, or the width when that is no standard tolerance of the size.
struct Width {
  std::optional<int> grade;
  double mm = 0.0;
};
Result<Width> width_of(double nominal_mm, double grade) {
  if (!(nominal_mm > 0.0) || nominal_mm > kLargestSize)
    return wrong("a fit at " + mm_text(nominal_mm, 5), "a size above 0 up to " + mm_text(kLargestSize, 5));
  const auto exact = grade_of_exact(nominal_mm, grade);
  const bool whole = grade >= 1.0 && grade <= kCoarsestGrade && grade == std::floor(grade);
  if (exact && whole)
    return wrong("the grade " + trimmed(grade, 5) + " of a fit at " + mm_text(nominal_mm, 5) + " is both IT" +
                     trimmed(grade, 0) + " and the width of " + grade_name(*exact),
                 "a grade that says one thing", "state the tolerance by its limits");
  if (exact) return Width{exact, *tolerance_grade(nominal_mm, *exact)};
  if (whole) {
    const int n = static_cast<int>(grade);
    return Width{n, *tolerance_grade(nominal_mm, n)};
  }
  const double widest = *tolerance_grade(nominal_mm, kCoarsestGrade);
  if (!(grade > kEmpty) || grade > widest)
    return wrong("the grade of a fit is " + trimmed(grade, 5),
                 "a width above 0 up to IT18, " + mm_text(widest, 5) + " at " + mm_text(nominal_mm, 5) +
                     ", or a grade 1 to 18");
  return Width{std::nullopt, grade};
}

bool same(const Deviations& a, const Deviations& b) {
  return std::abs(a.lower_mm - b.lower_mm) <= kSame && std::abs(a.upper_mm - b.upper_mm) <= kSame;
}

struct Reading {
  std::string name;
  Deviations zone;
};

// The classes of this grade whose stated limit is `deviation`, one of each interval.
std::vector<Reading> classes_at(double nominal_mm, int grade, Side side, double deviation_mm) {
  std::vector<Reading> out;
  for (const bool hole : {true, false}) {
    if (side != Side::kUnknown && hole != (side == Side::kHole)) continue;
    for (const auto letter : fit_letters()) {
      const FitClass c{letter, hole, grade};
      const auto zone = fit(nominal_mm, c);
      if (!zone) continue;
      const bool lower = hole == (letter[0] <= 'h');
      const double at = letter == "js" ? std::copysign(zone->upper_mm, deviation_mm)
                                       : (lower ? zone->lower_mm : zone->upper_mm);
      if (std::abs(at - deviation_mm) > kSame) continue;
      const bool known =
          std::any_of(out.begin(), out.end(), [&](const Reading& r) { return same(r.zone, *zone); });
      if (!known) out.push_back({to_text(c), *zone});
    }
  }
  return out;
}

Result<Deviations> by_numbers(double nominal_mm, const LimitsAndFits& t, Side side) {
  const auto width = width_of(nominal_mm, *t.grade);
  if (!width) return tl::unexpected(width.error());
  const double d = *t.deviation, w = width->mm;
  const Deviations up{d, d + w}, down{d - w, d};
  if (std::abs(d) <= kEmpty) {  // H or h: what the deviation 0 stands for
    if (side == Side::kUnknown)
      return wrong("a fit with the deviation 0 lies above or below " + mm_text(nominal_mm, 5),
                   "its_fitting_type");
    if (width->grade) return fit(nominal_mm, FitClass{"h", side == Side::kHole, *width->grade});
    return side == Side::kHole ? up : down;
  }
  if (width->grade) {
    const auto found = classes_at(nominal_mm, *width->grade, side, d);
    if (found.size() == 1) return found.front().zone;
    if (found.size() > 1)
      return wrong("a fit of deviation " + mm_text(d, 5) + " and grade " + grade_name(*width->grade) +
                       " at " + mm_text(nominal_mm, 5) + " is " + found[0].name + " or " + found[1].name,
                   "a fit that only one class has", "name the letter, or state the tolerance by its limits");
  }
  if (w >= 2.0 * std::abs(d))
    return wrong("a fit of deviation " + mm_text(d, 5) + " and width " + mm_text(w, 5) + " at " +
                     mm_text(nominal_mm, 5) + " may be " + text_of(up) + " or " + text_of(down),
                 "a class of ISO 286", "state the tolerance by its limits");
  return d < 0.0 ? down : up;
}

Result<Deviations> by_letter(double nominal_mm, const LimitsAndFits& t, Side side) {
  std::string letter = plain(t.form_variance);
  std::string grade = plain(t.tolerance_grade);
  if (lowered(grade).rfind("it", 0) == 0) grade.erase(0, 2);
  if (grade.empty() && std::isdigit(static_cast<unsigned char>(letter.back())) == 0) {
    if (!t.grade) return wrong("the fit " + letter + " has no grade", "a grade, 01 to 18");
    const auto width = width_of(nominal_mm, *t.grade);
    if (!width) return tl::unexpected(width.error());
    if (!width->grade)
      return wrong("the fit " + letter + " has the width " + mm_text(width->mm, 5),
                   "a standard tolerance of ISO 286");
    grade = grade_name(*width->grade).substr(2);
  }
  const auto c = parse_fit(letter + grade);
  if (!c) return tl::unexpected(c.error());
  if (side != Side::kUnknown && c->hole != (side == Side::kHole))
    return wrong("the fit " + to_text(*c) + " is a " + (c->hole ? "hole's" : "shaft's") + ", stated of a " +
                     (c->hole ? "shaft" : "hole"),
                 "upper case letters for a hole, lower case for a shaft");
  auto zone = fit(nominal_mm, *c);
  if (zone && t.deviation && std::abs(*t.deviation - zone->lower_mm) > kRounded &&
      std::abs(*t.deviation - zone->upper_mm) > kRounded)
    return wrong("the fit " + to_text(*c) + " at " + mm_text(nominal_mm, 5) + " is " + text_of(*zone) +
                     ", its deviation stated as " + mm_text(*t.deviation, 5),
                 "one of its limits");
  return zone;
}

}  // namespace

Result<std::optional<Deviations>> stated(const PlusMinusValue& t) {
  if (!t.upper_limit && !t.lower_limit) return std::nullopt;
  if (!t.upper_limit || !t.lower_limit)
    return wrong(std::string("a tolerance has no ") + (t.upper_limit ? "lower" : "upper") + " limit",
                 "both limits");
  if (!std::isfinite(*t.upper_limit) || !std::isfinite(*t.lower_limit))
    return wrong("a limit of a tolerance is no finite number", "both limits");
  Deviations d{0.0 - *t.lower_limit, *t.upper_limit};
  if (d.width() <= kEmpty && *t.lower_limit < 0.0) d.lower_mm = *t.lower_limit;
  if (!(d.width() > kEmpty)) {
    const bool none = std::abs(d.width()) <= kEmpty;
    return wrong(
        none ? "a tolerance has no width: both limits are " + mm_text(d.upper_mm, 5) + " from nominal"
             : "a tolerance ends at " + mm_text(d.upper_mm, 5) + " and begins at " + mm_text(d.lower_mm, 5),
        "a lower limit below the upper one", none ? "leave the tolerance out where none is meant" : "");
  }
  return d;
}

Result<std::optional<Deviations>> stated(double nominal_mm, const LimitsAndFits& t) {
  const bool letter = !plain(t.form_variance).empty();
  for (const double x : {nominal_mm, t.deviation.value_or(0.0), t.grade.value_or(0.0)}) {
    if (!std::isfinite(x)) return wrong("a number of a fit is not finite", "a size, a deviation and a grade");
  }
  if (!letter && !t.deviation && !t.grade) return std::nullopt;
  const auto side = side_of(t);
  if (!side) return tl::unexpected(side.error());
  if (!letter && (!t.deviation || !t.grade))
    return wrong(std::string("a fit has no ") + (t.grade ? "deviation" : "grade"), "deviation and grade");
  const auto d = letter ? by_letter(nominal_mm, t, *side) : by_numbers(nominal_mm, t, *side);
  if (!d) return tl::unexpected(d.error());
  return *d;
}

}  // namespace capstan::model
