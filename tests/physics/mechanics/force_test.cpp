#include "planner/physics/mechanics/force/force.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kHelix30 = kPi / 6.0;

// [S] the coefficients, [C] the forces. Al 7075-T6, Chin. J. Mech. Eng. 2021, doi 10.1186/s10033-021-00536-9,
// table 5, its reference [190].
constexpr CuttingCoefficients kAl7075{767.01, 27.7, 168.8, 26.6, 222.0, 0.7};
constexpr int kTeeth = 4;
constexpr double kDiameter = 12.0;

struct Case {
  const char* name;
  double ap;
  double fz;
  ImmersionArc arc;
  double fx, fy, fz_axial;
};

const Case kCases[] = {
    {"slot 2 x 0.1", 2.0, 0.10, {0.0, kPi}, -101.496, 223.939, 59.332},
    {"slot 4 x 0.08", 4.0, 0.08, {0.0, kPi}, -189.489, 386.518, 96.051},
    {"quarter, down", 4.0, 0.08, immersion_arc(3.0, kDiameter, CutDirection::kDown), 75.254, 154.810, 24.479},
    {"quarter, up", 4.0, 0.08, immersion_arc(3.0, kDiameter, CutDirection::kUp), -164.111, 11.696, 24.479},
};

TEST(MeanMillingForce, MatchesTheTabulatedCases) {
  for (const Case& c : kCases) {
    const ForceVector f = mean_milling_force(kAl7075, kTeeth, c.ap, c.fz, c.arc);
    EXPECT_NEAR(f.fx_n, c.fx, 5e-4) << c.name;
    EXPECT_NEAR(f.fy_n, c.fy, 5e-4) << c.name;
    EXPECT_NEAR(f.fz_n, c.fz_axial, 5e-4) << c.name;
  }
}

TEST(PeakMillingForce, MatchesTheTabulatedCasesWithAndWithoutHelix) {
  const double expected[][2] = {{468.6, 467.2}, {357.8, 327.7}, {357.6, 326.9}};
  for (int i = 0; i < 3; ++i) {
    const Case& c = kCases[i + 1];
    const auto peak = [&](double helix) {
      return peak_milling_force_n(kAl7075, kTeeth, c.ap, c.fz, kDiameter, helix, c.arc);
    };
    EXPECT_NEAR(peak(0.0), expected[i][0], 0.3) << c.name;
    EXPECT_NEAR(peak(kHelix30), expected[i][1], 0.3) << c.name;
  }
}

/// The same peak by brute force: thin discs, many rotations.
double sampled_peak(const CuttingCoefficients& k, double ap, double fz, double helix,
                    const ImmersionArc& arc) {
  constexpr int kDiscs = 400;
  constexpr int kRotations = 1440;
  double peak = 0.0;
  for (int r = 0; r < kRotations; ++r) {
    double x = 0.0;
    double y = 0.0;
    for (int j = 0; j < kTeeth; ++j) {
      for (int d = 0; d < kDiscs; ++d) {
        const double lag = helix_lag_rad(ap * (d + 0.5) / kDiscs, kDiameter, helix);
        double a = 2.0 * kPi * r / kRotations + 2.0 * kPi * j / kTeeth - lag;
        a -= 2.0 * kPi * std::floor(a / (2.0 * kPi));
        if (a < arc.entry_rad || a > arc.exit_rad) continue;
        const double h = fz * std::sin(a);
        const double ft = (k.ktc_n_mm2 * h + k.kte_n_mm) * ap / kDiscs;
        const double fr = (k.krc_n_mm2 * h + k.kre_n_mm) * ap / kDiscs;
        x += -ft * std::cos(a) - fr * std::sin(a);
        y += ft * std::sin(a) - fr * std::cos(a);
      }
    }
    peak = std::max(peak, std::hypot(x, y));
  }
  return peak;
}

TEST(PeakMillingForce, AgreesWithSampledDiscs) {
  for (const double helix : {0.2, kHelix30, 0.8, 1.3}) {
    for (const double ae : {0.6, 3.0, 7.0, 12.0}) {
      const auto arc = immersion_arc(ae, kDiameter, CutDirection::kDown);
      const double closed = peak_milling_force_n(kAl7075, kTeeth, 9.0, 0.06, kDiameter, helix, arc);
      const double sampled = sampled_peak(kAl7075, 9.0, 0.06, helix, arc);
      EXPECT_NEAR(closed, sampled, 0.01 * sampled) << helix << " " << ae;
    }
  }
}

TEST(PeakKienzleForce, EqualsTheMechanisticOneWhereTheLawsCoincide) {
  // mc = 0 and no edge forces: both are Ktc h.
  const WorkMaterial work{767.01, 0.0};
  const CuttingCoefficients k{767.01, 0.0, 0.22 * 767.01, 0.0, 0.0, 0.0};
  for (const double helix : {0.0, 0.05, kHelix30, 0.9}) {
    for (const double ae : {0.3, 3.0, 8.0, 12.0}) {
      const auto arc = immersion_arc(ae, kDiameter, CutDirection::kUp);
      const double a = peak_kienzle_force_n(work, 0.22, 4, 4.0, 0.08, kDiameter, helix, 1.0, arc);
      const double b = peak_milling_force_n(k, 4, 4.0, 0.08, kDiameter, helix, arc);
      EXPECT_NEAR(a, b, 1e-3 * b) << helix << " " << ae;
    }
  }
}

TEST(PeakKienzleForce, OfAFittedMaterialIsNearTheMechanisticOne) {
  // Ktc h + Kte seen as a specific force Ktc + Kte / h, fitted over chips of an end mill.
  std::vector<SpecificForcePoint> points;
  for (const double h : {0.01, 0.02, 0.04, 0.08}) {
    points.push_back({h, kAl7075.ktc_n_mm2 + kAl7075.kte_n_mm / h});
  }
  const WorkMaterial work = fit_kienzle(points)->work;
  for (const Case& c : kCases) {
    for (const double helix : {0.0, kHelix30}) {
      const double measured = peak_milling_force_n(kAl7075, kTeeth, c.ap, c.fz, kDiameter, helix, c.arc);
      const double ours = peak_kienzle_force_n(work, kRadialToTangentialRatio, kTeeth, c.ap, c.fz, kDiameter,
                                               helix, 1.0, c.arc);
      EXPECT_GT(ours, 0.95 * measured) << c.name;
      EXPECT_LT(ours, 1.25 * measured) << c.name;
    }
  }
}

TEST(PeakKienzleForce, HasNoJumpAsTheHelixVanishes) {
  const WorkMaterial work{2298.0, 0.20};
  const auto peak = [&](double helix) {
    return peak_kienzle_force_n(work, 0.6, 4, 2.0, 0.05, 10.0, helix, 1.0,
                                immersion_arc(0.5, 10.0, CutDirection::kDown));
  };
  for (const double helix : {1e-8, 1e-5, 2.6e-6, 1e-4})
    EXPECT_NEAR(peak(helix) / peak(0.0), 1.0, 1e-3) << helix;
}

TEST(PeakKienzleForce, OfOneStraightToothIsTheForceOfTheThickestChip) {
  const WorkMaterial work{2298.0, 0.20};
  const auto arc = immersion_arc(1.0, 10.0, CutDirection::kDown);
  const double h = max_chip_thickness_mm(0.05, 1.0, 10.0);
  const double tangential = specific_force_n_mm2(work, h) * h * 3.0;
  const double peak = peak_kienzle_force_n(work, kRadialToTangentialRatio, 2, 3.0, 0.05, 10.0, 0.0, 1.0, arc);
  EXPECT_NEAR(peak, tangential * std::hypot(1.0, kRadialToTangentialRatio), 1e-6 * peak);
}

TEST(PeakKienzleForce, IsNeverUnderTheMeanTangentialForce) {
  const WorkMaterial work{2809.0, 0.24};
  for (const double ae : {0.5, 2.0, 5.0, 9.0, 10.0}) {
    for (const double ap : {0.5, 5.0, 20.0, 60.0}) {
      const double kc = specific_force_n_mm2(work, mean_chip_thickness_mm(0.06, ae, 10.0));
      const double mean = mean_tangential_force_n(kc, ap, ae, 0.06, 4, 10.0);
      // A slot's forces cancel partly in the plane; that is the only way down, and not by more than half.
      const double peak = peak_kienzle_force_n(work, kRadialToTangentialRatio, 4, ap, 0.06, 10.0, kHelix30,
                                               1.0, immersion_arc(ae, 10.0, CutDirection::kDown));
      EXPECT_GT(peak, 0.5 * mean) << ae << " " << ap;
      if (ae <= 5.0) {
        EXPECT_GT(peak, mean) << ae << " " << ap;
      }
    }
  }
}

}  // namespace
}  // namespace capstan::mechanics
