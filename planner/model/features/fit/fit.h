#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"
#include "planner/model/features/fit/grade.h"

namespace capstan::model {

/// The two limits of a size, as what is added to the nominal one.
struct Deviations {
  double lower_mm = 0.0, upper_mm = 0.0;  ///< lower <= upper
  [[nodiscard]] double width() const { return upper_mm - lower_mm; }
  [[nodiscard]] double middle() const { return 0.5 * (lower_mm + upper_mm); }
};

/// A tolerance class: "H7" is {"h", true, 7}.
struct FitClass {
  std::string_view letter;  ///< of fit_letters, lower case
  bool hole = false;
  int grade = 0;  ///< numbered as in grade.h
};

/// Reads "H7", "g6", "JS9", "ZC01": upper case for holes, lower case for shafts, blanks around it left out.
/// Fails  MDL-FIT for anything else.
[[nodiscard]] Result<FitClass> parse_fit(std::string_view designation);

/// "H7".
[[nodiscard]] std::string to_text(const FitClass& c);

/// The limit deviations of a tolerance class at a size: 20 H7 is 0 to +0.021, 20 f7 is -0.041 to -0.020.
///
///     A .. H   EI stated, ES = EI + IT        a .. h   es stated, ei = es - IT
///     J .. ZC  ES stated, EI = ES - IT        j .. zc  ei stated, es = ei + IT
///     JS, js   -IT / 2 to +IT / 2 (not rounded, as the first edition allowed for odd IT7 to IT11)
///
/// Fails   MDL-FIT where the standard states no value, naming what it does state; IT14 and coarser only above
///         1 mm, as the first edition has it.
/// Source  ISO 286-1:2010, tables 1 to 5; the classes that ISO 286-2:2010 lists give its limits.
[[nodiscard]] Result<Deviations> fit(double nominal_mm, const FitClass& c);
[[nodiscard]] Result<Deviations> fit(double nominal_mm, std::string_view designation);

}  // namespace capstan::model
