#include "tests/validation/power.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace capstan::validation {
namespace {

// What planning expects may be more than a table says; far less would overload a spindle.
TEST(ExpectedPower, IsNowhereFarBelowAPublishedTable) {
  const auto rows = power_rows();
  ASSERT_FALSE(rows.empty());
  for (const PowerRow& r : rows)
    EXPECT_GE(r.ratio(), 1.0 - kPowerBound) << r.source << ": " << r.row << " at " << r.fz_mm;
}

TEST(ExpectedPower, OfCommonMaterialsIsNearSomeTable) {
  for (const char* material : {"C45", "42CrMo4", "42CrMo4+QT", "C60", "AISI 303", "GG25", "EN AW-6061"}) {
    double nearest = 1e300;
    for (const PowerRow& r : power_rows()) {
      if (r.material == material) nearest = std::min(nearest, std::abs(r.ratio() - 1.0));
    }
    EXPECT_LE(nearest, kPowerBound) << material;
  }
}

}  // namespace
}  // namespace capstan::validation
