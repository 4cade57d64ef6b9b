#pragma once

#include <string>
#include <vector>

#include "planner/files/recognise/recognise.h"

namespace capstan::testing {

/// The classes of MFCAD, as its labels number them: found by looking at the faces that carry each number, for
/// its publication lists the names in another order than its files number them.
enum class MfcadClass : int {
  kChamfer,
  kTriangularPassage,
  kRectangularPassage,
  kSixSidesPassage,
  kTriangularThroughSlot,
  kRectangularThroughSlot,
  kRectangularThroughStep,
  kTwoSidesThroughStep,
  kSlantedThroughStep,
  kTriangularPocket,
  kRectangularPocket,
  kSixSidesPocket,
  kRectangularBlindSlot,
  kTriangularBlindStep,
  kRectangularBlindStep,
  kStock,
  kCount,
};
inline constexpr int kNoMfcadClass = -1;
inline constexpr int kMfcadClasses = static_cast<int>(MfcadClass::kCount);

/// The label of each face, by the number that is the face's name.
[[nodiscard]] std::vector<int> mfcad_labels(const std::string& json);

/// The class of each face of the Brep as it was recognised; kNoMfcadClass where the vocabulary has none for
/// it.
[[nodiscard]] std::vector<int> mfcad_classes(const exchange::Brep& brep, const recognise::Recognition& found);

}  // namespace capstan::testing
