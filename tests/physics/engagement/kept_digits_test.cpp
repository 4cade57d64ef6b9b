#include "planner/physics/engagement/kept_digits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "planner/ground/base/number.h"

namespace capstan::engagement {
namespace {

model::SectionSeries noise(unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> mantissa(-1.0, 1.0), power(-6.0, 4.0);
  model::SectionSeries s;
  for (std::uint32_t i = 0; i < 2000; ++i) {
    const auto number = [&] { return mantissa(random) * std::pow(10.0, power(random)); };
    s.move.push_back(i);
    s.at_mm.push_back(std::abs(number()));
    for (auto* c : {&s.ad_max_mm, &s.rd_max_mm, &s.x_max_ofs_mm, &s.y_max_ofs_mm, &s.x_cg_ofs_mm,
                    &s.y_cg_ofs_mm, &s.csa_mm2, &s.removed_mm3})
      c->push_back(number());
  }
  return s;
}

std::size_t digits_of(double v) {
  std::size_t n = 0;
  const std::string text = shortest(v);
  for (const char c : text.substr(0, text.find('e'))) {
    if (c >= '0' && c <= '9' && (n != 0 || c != '0')) ++n;
  }
  return n;
}

TEST(KeptDigits, AreAsManyAsAreKnown) {
  const model::SectionSeries all = noise(1);
  struct Case {
    double known_to_mm, length_mm;
    std::size_t digits;
  };
  for (const Case c : {Case{0.0, 1e-6, 7}, Case{0.1, 1e-3, 5}, Case{0.25, 1e-3, 5}, Case{2.0, 1e-2, 5}}) {
    model::SectionSeries s = all;
    keep_digits(s, c.known_to_mm);
    EXPECT_EQ(s.move, all.move);
    for (std::size_t i = 0; i < s.size(); ++i) {
      // Half of the last place kept, and of seven digits.
      EXPECT_NEAR(s.rd_max_mm[i], all.rd_max_mm[i],
                  0.51 * std::max(c.length_mm, 1e-6 * std::abs(all.rd_max_mm[i])));
      EXPECT_NEAR(s.at_mm[i], all.at_mm[i], 0.51e-6);
      const double share = 0.51 * std::pow(10.0, 1.0 - static_cast<double>(c.digits));
      EXPECT_NEAR(s.csa_mm2[i], all.csa_mm2[i], std::max(0.51e-9, share * std::abs(all.csa_mm2[i])));
      EXPECT_LE(digits_of(s.csa_mm2[i]), c.digits);
      EXPECT_LE(digits_of(s.removed_mm3[i]), c.digits);
      EXPECT_LE(digits_of(s.y_cg_ofs_mm[i]), 7U);
    }
  }
}

TEST(KeptDigits, StayWhenKeptAgain) {
  for (const double known : {0.0, 0.1}) {
    model::SectionSeries once = noise(2);
    keep_digits(once, known);
    model::SectionSeries twice = once;
    keep_digits(twice, known);
    EXPECT_EQ(once, twice);
  }
}

}  // namespace
}  // namespace capstan::engagement
