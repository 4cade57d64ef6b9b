#include "planner/proof/verify/volumes/form/limits.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "planner/model/features/fit/deviation.h"
#include "planner/model/features/fit/fit.h"
#include "planner/model/nouns/all.h"
#include "planner/proof/verify/volumes/nouns.h"

// What a file allows a size. A class of ISO 286 is named by its letter, or by two numbers: the width of its
// interval (or the grade's number) and the limit next to the nominal size. The numbers are held against every
// class of that width; one interval must remain.

namespace capstan::verify::volumes {

using model::AnyRef;
using model::Model;

namespace {

constexpr double kSameMm = 5e-5;  ///< half the last digit of the tables of ISO 286
constexpr double kNoWidthMm = 1e-9;

Limits between(double nominal, double lower, double upper) {
  if (!std::isfinite(lower) || !std::isfinite(upper) || !(upper - lower > kNoWidthMm))
    return {nominal, 0.0, 0.0, false};
  return {nominal, lower, upper, true};
}

std::string without_blanks(const model::Text& t) {
  std::string out = t.value_or("");
  std::erase(out, ' ');
  return out;
}

/// Of a hole, of a shaft; nothing: not said, or said in two ways.
std::optional<bool> of_hole(const model::LimitsAndFits& t) {
  std::string zone = without_blanks(t.zone_variance);
  for (char& c : zone) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  std::optional<bool> out;
  if (t.its_fitting_type == model::FittingType::kHole) out = true;
  if (t.its_fitting_type == model::FittingType::kShaft) out = false;
  if (zone != "hole" && zone != "shaft") return out;
  const bool hole = zone == "hole";
  return out && *out != hole ? std::nullopt : std::optional<bool>(hole);
}

/// The width of an interval that a number says, by itself or as the number of a grade, and the grade. Width
/// 0: it says neither, or both.
struct Width {
  std::optional<int> grade;
  double mm = 0.0;
};
Width width_said(double nominal, double number) {
  if (!(nominal > 0.0) || nominal > model::kLargestSize) return {};
  const auto by_width = model::grade_of_exact(nominal, number);
  const bool whole = number >= 1.0 && number <= model::kCoarsestGrade && number == std::floor(number);
  if (by_width && whole) return {};
  const auto grade = by_width ? by_width
                     : whole  ? std::optional<int>(static_cast<int>(number))
                              : std::nullopt;
  if (grade) return {grade, model::tolerance_grade(nominal, *grade).value_or(0.0)};
  const auto widest = model::tolerance_grade(nominal, model::kCoarsestGrade);
  return {std::nullopt, widest && number > kNoWidthMm && number <= *widest ? number : 0.0};
}

Limits named(double nominal, const model::LimitsAndFits& t) {
  std::string designation = without_blanks(t.form_variance);
  std::string grade = without_blanks(t.tolerance_grade);
  if (grade.size() > 2 && std::toupper(static_cast<unsigned char>(grade[0])) == 'I') grade.erase(0, 2);
  if (grade.empty() && std::isdigit(static_cast<unsigned char>(designation.back())) == 0) {
    const auto said = t.grade ? width_said(nominal, *t.grade).grade : std::nullopt;
    if (!said) return between(nominal, 0.0, 0.0);
    grade = model::grade_name(*said).substr(2);
  }
  const auto zone = model::fit(nominal, designation + grade);
  return zone ? between(nominal, zone->lower_mm, zone->upper_mm) : between(nominal, 0.0, 0.0);
}

Limits numbered(double nominal, double number, double next, std::optional<bool> hole) {
  const auto [grade, wide] = width_said(nominal, number);
  if (!(wide > 0.0)) return between(nominal, 0.0, 0.0);
  if (std::abs(next) <= kNoWidthMm) {  // H, h
    if (!hole) return between(nominal, 0.0, 0.0);
    return *hole ? between(nominal, 0.0, wide) : between(nominal, -wide, 0.0);
  }
  std::vector<Limits> found;
  for (const bool of : {true, false}) {
    if (!grade || (hole && *hole != of)) continue;
    for (const auto letter : model::fit_letters()) {
      const auto zone = model::fit(nominal, model::FitClass{letter, of, *grade});
      if (!zone) continue;
      // A letter fixes the lower limit of holes A to H and of shafts j to zc, else the upper one; of js
      // either.
      const bool lower = of == (letter[0] <= 'h');
      const double fixed = letter == "js" ? std::copysign(zone->upper_mm, next)
                           : lower        ? zone->lower_mm
                                          : zone->upper_mm;
      if (std::abs(fixed - next) > kSameMm) continue;
      const bool known = std::any_of(found.begin(), found.end(), [&](const Limits& l) {
        return std::abs(l.lower_mm - zone->lower_mm) <= kSameMm &&
               std::abs(l.upper_mm - zone->upper_mm) <= kSameMm;
      });
      if (!known) found.push_back(between(nominal, zone->lower_mm, zone->upper_mm));
    }
  }
  if (found.size() == 1) return found.front();
  if (found.size() > 1 || wide >= 2.0 * std::abs(next)) return between(nominal, 0.0, 0.0);
  return next < 0.0 ? between(nominal, next - wide, next) : between(nominal, next, next + wide);
}

}  // namespace

Limits deviations_of(const Model& m, double nominal, AnyRef tolerance) {
  if (const auto* t = m.get<model::PlusMinusValue>(tolerance)) {
    if (!t->upper_limit || !t->lower_limit) return between(nominal, 0.0, 0.0);
    const Limits out = between(nominal, -*t->lower_limit, *t->upper_limit);
    return out.given || *t->lower_limit >= 0.0 ? out : between(nominal, *t->lower_limit, *t->upper_limit);
  }
  const auto* t = m.get<model::LimitsAndFits>(tolerance);
  if (t == nullptr || !std::isfinite(nominal)) return between(nominal, 0.0, 0.0);
  if (!without_blanks(t->form_variance).empty()) return named(nominal, *t);
  if (!t->grade || !t->deviation) return between(nominal, 0.0, 0.0);
  return numbered(nominal, *t->grade, *t->deviation, of_hole(*t));
}

Limits limits_of(const Model& m, AnyRef length) {
  const auto* t = m.get<model::TolerancedLengthMeasure>(length);
  if (t == nullptr) return {};
  return deviations_of(m, size_of(m, length).value_or(0.0), t->implicit_tolerance);
}

}  // namespace capstan::verify::volumes
