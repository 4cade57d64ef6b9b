#include "tests/validation/forces/power.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace capstan::validation {
namespace {

// What planning expects may be more than a table says; far less would overload a spindle.
TEST(ExpectedPower, IsWithinAQuarterOfHalfOfTheTablesRowsAndNowhereBelow84Percent) {
  const auto rows = power_rows();
  EXPECT_EQ(rows.size(), 52U);
  EXPECT_EQ(std::count_if(rows.begin(), rows.end(),
                          [](const PowerRow& r) { return std::abs(r.ratio() - 1.0) <= kPowerBound; }),
            27);
  for (const PowerRow& r : rows) EXPECT_GE(r.ratio(), 0.84) << r.source << ": " << r.row << " at " << r.fz_mm;
}

TEST(ExpectedPower, OfEachCommonMaterialIsWithinAQuarterOfOneRowAtLeast) {
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
