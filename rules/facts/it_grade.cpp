#include "rules/facts/it_grade.h"

#include <algorithm>

#include "planner/model/features/fit/grade.h"

namespace capstan::rules {

double standard_tolerance_mm(int grade, double nominal_mm) {
  if (grade < 1) return 0.0;
  return model::tolerance_grade(nominal_mm, grade).value_or(0.0);
}

int grade_of_width(double nominal_mm, double width_mm) {
  return std::max(0, model::grade_of(nominal_mm, width_mm).value_or(0));
}

}  // namespace capstan::rules
