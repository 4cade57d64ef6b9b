#pragma once

#include <string>

namespace capstan::model {

/// Which values a quantity can have at all. Whoever reads one (data files, tool libraries, plans) and whoever
/// checks one asks here. The bounds lie far outside of what shops have: beyond them is a slip, a wrong unit,
/// or an attack. Default, unsourced, where nothing else is said.
struct Range {
  double least = 0.0, most = 0.0;
  bool or_zero = false;  ///< 0 stands for "none" or "not known"
  /// Not for what is not a number.
  [[nodiscard]] constexpr bool holds(double v) const {
    return (v >= least && v <= most) || (or_zero && v == 0.0);
  }
};

/// "0.001 to 2000", "0, or 0.001 to 2000".
[[nodiscard]] std::string to_text(const Range& range);
/// A value for a message, as near as a person reads it and never another one: "0.05", "1000000", "1e-320",
/// "not a finite number".
[[nodiscard]] std::string value_text(double v);

namespace range {

// --- machines ---
inline constexpr Range kTravelMm{1.0, 100'000.0};
inline constexpr Range kAxisPositionMm{-100'000.0, 100'000.0};
inline constexpr Range kAxisSpeedMmMin{0.1, 1e6};
inline constexpr Range kAccelerationMmS2{0.1, 1e6};
inline constexpr Range kJerkMmS3{1.0, 1e9};
inline constexpr Range kSpindleRpm{0.0, 500'000.0};
inline constexpr Range kCurveRpm{0.001, 500'000.0};
inline constexpr Range kPowerW{1e-3, 1e6, true};
inline constexpr Range kTorqueNm{1e-6, 1e5, true};
/// Cutting power / motor power: no gear takes nineteen parts of twenty.
inline constexpr Range kEfficiency{0.05, 1.0};
inline constexpr Range kSpinUpS{0.0, 600.0};
inline constexpr Range kPockets{0.0, 10'000.0};
inline constexpr Range kMagazineMm{1.0, 10'000.0};
inline constexpr Range kToolChangeS{0.0, 3600.0};
inline constexpr Range kCost{0.0, 1e9};
inline constexpr Range kDecimals{0.0, 9.0};
inline constexpr Range kPathToleranceMm{0.0, 10.0};
inline constexpr Range kBlockTimeS{0.0, 1.0};
inline constexpr Range kAxes{3.0, 16.0};
inline constexpr Range kAccuracyMm{0.0, 10.0};
inline constexpr Range kTableMm{1.0, 100'000.0, true};
inline constexpr Range kPressureBar{0.0, 1000.0};
/// As a factor: 1.2 is 120 %.
inline constexpr Range kFeedOverride{1.0, 3.0};
inline constexpr Range kMassKg{0.001, 1000.0, true};
inline constexpr Range kModeHz{5.0, 20'000.0};
inline constexpr Range kDamping{1e-4, 0.5};
inline constexpr Range kStiffnessNMm{10.0, 1e7};

// --- materials: what real ones span, with room; public tables have held coefficients a hundred times too
// large ---
inline constexpr Range kKc11NMm2{100.0, 8000.0};
inline constexpr Range kMc{0.0, 0.6};
inline constexpr Range kVcHssMMin{0.0, 500.0};
inline constexpr Range kVcCarbideMMin{1.0, 3000.0};
inline constexpr Range kStrengthNMm2{0.0, 5000.0};
inline constexpr Range kHardnessHb{0.0, 800.0};
inline constexpr Range kKcUncertainty{0.0, 1.0};
inline constexpr Range kKtcNMm2{50.0, 10'000.0};
inline constexpr Range kKrcNMm2{0.0, 10'000.0};
inline constexpr Range kEdgeNMm{0.0, 200.0};
inline constexpr Range kSetUncertainty{0.0, 5.0};
inline constexpr Range kLifeSpeedMMin{1.0, 3000.0};
inline constexpr Range kLifeMin{0.1, 10'000.0};
inline constexpr Range kTaylorN{0.02, 1.0};
inline constexpr Range kTaylorPq{0.0, 20.0};
inline constexpr Range kLifeScatter{0.0, 2.0};
inline constexpr Range kLifeChipMm{0.001, 5.0};
inline constexpr Range kLifeDepthMm{0.01, 200.0};

// --- tools ---
/// The longest is above any milling tool; the shortest that is not zero is an atom's.
inline constexpr Range kToolLengthMm{1e-6, 2000.0, true};
inline constexpr Range kToolDiameterMm{0.001, 2000.0};
inline constexpr Range kTeeth{1.0, 60.0};
inline constexpr Range kToolSpeedRpm{1e-3, 1e6, true};
inline constexpr Range kToolLifeMin{1e-3, 1e6, true};
inline constexpr Range kPrice{0.0, 1e9};
inline constexpr Range kLeadThreads{1e-3, 100.0, true};

// --- steps, set-ups, fixtures ---
/// Anything beyond is no position on a machine.
inline constexpr Range kPositionMm{-1e5, 1e5};
inline constexpr Range kRawPieceMm{0.001, 100'000.0};
inline constexpr Range kDepthMm{0.0, 10'000.0};
/// Of a step's technology, by magnitude: the sign of a speed is its sense.
inline constexpr Range kTurningRpm{1e-3, 1e6, true};
/// Of a step's technology, by magnitude, in whatever unit the model has it.
inline constexpr Range kSpeed{1e-6, 1e9, true};
inline constexpr Range kCuttingSpeedMMin{0.0, 10'000.0};
inline constexpr Range kFeedPerToothMm{0.0, 100.0};
inline constexpr Range kFeedMmMin{0.0, 1e6};
inline constexpr Range kStepTimeS{0.0, 1e8};
inline constexpr Range kContourMm{0.0, 100.0};
inline constexpr Range kFixtureMm{1e-3, 10'000.0};  ///< more is a mistake of units
inline constexpr Range kFixtureAtMm{-kFixtureMm.most, kFixtureMm.most};
inline constexpr Range kClearanceMm{0.1, 100.0};
inline constexpr Range kHoldingForceN{0.0, 1e7};

}  // namespace range
}  // namespace capstan::model
