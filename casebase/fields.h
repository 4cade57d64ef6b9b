#pragma once

#include <array>
#include <string>
#include <string_view>

#include "casebase/casebase.h"

namespace capstan::casebase {

/// The columns of a case, in one order for the id, the store and CSV. Not among them: the id, teeth and
/// coolant, which are integers.
struct TextField {
  std::string_view name;
  std::string& (*in)(Case&);
};
struct NumberField {
  std::string_view name;
  double& (*in)(Case&);
  double low, high;  ///< physical limits, both allowed
};

[[nodiscard]] const std::array<TextField, 7>& text_fields();
[[nodiscard]] const std::array<NumberField, 14>& number_fields();

inline const std::string& value(const TextField& f, const Case& c) { return f.in(const_cast<Case&>(c)); }
inline double value(const NumberField& f, const Case& c) { return f.in(const_cast<Case&>(c)); }

}  // namespace capstan::casebase
