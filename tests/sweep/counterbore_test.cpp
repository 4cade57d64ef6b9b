#include <gtest/gtest.h>

#include <string>

#include "tests/sweep/sweep.h"

// A shoulder that one mill opens without roughing is asked for as the ring it is, not as an allowance: at the
// allowance's speed the spindle of the Tormach has a fifth of its torque, and the helix crept (3.5 and 3.1
// times the catalogue).

namespace capstan::testing::sweep {
namespace {

Outcome counterbore_in(const std::string& material) {
  Case c;
  for (std::size_t i = 0; i < features().size(); ++i)
    if (features()[i].name == "counterbore") c.feature = i;
  while (kMaterials[c.material].name != material) ++c.material;
  c.machine = 1;
  return Sweep().plan(c);
}

TEST(Counterbore, IsOpenedAtASpeedWhoseTorqueTheSpindleHas) {
  for (const std::string material : {"EN AW-6061", "CW614N"}) {
    const Outcome o = counterbore_in(material);
    ASSERT_TRUE(o.whole()) << material;
    for (const auto& f : o.findings) EXPECT_NE(f.severity, Severity::kError) << f.code << " " << f.message;
    EXPECT_GT(o.ratio(), 0.0) << material;
    EXPECT_LT(o.ratio(), 2.5) << material;
  }
}

}  // namespace
}  // namespace capstan::testing::sweep
