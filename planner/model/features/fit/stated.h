#pragma once

#include <optional>

#include "planner/ground/base/result.h"
#include "planner/model/features/fit/fit.h"
#include "planner/model/nouns/forward.h"

namespace capstan::model {

/// What the tolerance of a TOLERANCED_LENGTH_MEASURE says, as deviations from its nominal size. Nothing when
/// it says nothing; always with a width.

/// [nominal - lower_limit, nominal + upper_limit], both limits signed: f7 at 20 mm is upper_limit -0.020,
/// lower_limit 0.041. Some writers put the lower deviation itself into lower_limit (-0.041). The first
/// reading is empty then, and the second is taken; where it is not empty, it lies within the second.
///
/// Fails   MDL-TOLERANCE when one limit is missing, when both readings are empty, and for a width of 0, which
///         nobody can make.
/// Source  ISO 14649-10, plus_minus_value: what is added to, and subtracted from, the exact value.
[[nodiscard]] Result<std::optional<Deviations>> stated(const PlusMinusValue& t);

/// A class of ISO 286: by its letter where the file has it (form_variance, zone_variance, tolerance_grade),
/// else by its numbers. grade is the width of the interval, or the number of the grade: a whole number that
/// is no standard tolerance of that size. deviation is the fundamental deviation, the limit that the letter
/// fixes; 0 is H or h. Which limit that is, is found by holding it against all letters of that grade; no
/// class has it: the limit nearer to nominal, as the standard defines the fundamental deviation.
///
/// Fails   MDL-TOLERANCE when a number is missing, when two readings are possible or none, and where the
/// parts
///         contradict each other; MDL-FIT for a class that the standard does not state.
/// Source  ISO 14649-10, limits_and_fits; ISO 10303-47, limits_and_fits; ISO 286-1:2010.
[[nodiscard]] Result<std::optional<Deviations>> stated(double nominal_mm, const LimitsAndFits& t);

}  // namespace capstan::model
