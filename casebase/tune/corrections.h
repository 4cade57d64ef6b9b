#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "casebase/tune/regression.h"
#include "planner/model/plan/resources/material.h"

/// What cases correct of the planner's models, each with its uncertainty. Each starts from the handbook's
/// value with the handbook's spread as its prior: few cases move it little, and only evidence narrows it.
namespace capstan::casebase::tune {

/// One number of a model: before, and as the cases have it.
struct CorrectedTerm {
  std::string name, unit;
  double handbook = 0.0, handbook_std_dev = 0.0;
  double value = 0.0, std_dev = 0.0;
};

/// A row of a robust fit that weighs less is doubted.
inline constexpr double kDoubtedWeight = 0.5;

struct Corrected {
  std::string model;  ///< "cutting force", "tool life", "time", "size of bores by a cutter of 4 mm"
  std::vector<CorrectedTerm> terms;
  std::size_t cases = 0, groups = 0, doubted = 0;  ///< doubted: by kDoubtedWeight
  /// Each edge or part predicted from the others: rms of the error (of the logarithm; of bores in mm), and
  /// the share within the stated interval of 90 %. Nothing where there are fewer than three of them, or more
  /// than 300.
  struct LeftOutFigures {
    double rms = 0.0, within_90 = 0.0;
    std::vector<LeftOut> each = {};  ///< of the samples that were heard, in their order
  };
  std::optional<LeftOutFigures> left_out;
  Regression fit;
};

/// The specific force of one cut: kc, force over area of the chip, at the mean thickness of the chip.
struct ForceSample {
  double chip_mm = 0.0, kc_n_mm2 = 0.0;
  std::size_t group = 0;  ///< the edge
};
struct ForceHandbook {
  double kc11_n_mm2 = 0.0, mc = 0.0;
  double spread = 1.5;  ///< factor of one standard deviation of the force
};
struct ForceCorrection {
  double kc11_n_mm2 = 0.0, mc = 0.0;
  /// Factor of one standard deviation of the force of a further edge, at the mean of the chips observed:
  /// `spread` of mechanics::ForceMargin, in place of the handbook's, in its root of the sum of squares.
  double spread = 1.0;
  Corrected how;
};
/// Least squares of ln kc on ln h. Nothing without a usable sample.
[[nodiscard]] std::optional<ForceCorrection> correct_force(std::span<const ForceSample> samples,
                                                           const ForceHandbook& handbook);

/// One factor on a law of force, whatever its form.
struct FactorCorrection {
  double factor = 1.0, spread = 1.0;  ///< spread: of a further edge, one standard deviation
  double ln_std_dev = 0.0;            ///< of the logarithm of the factor itself
  double chip_mm = 0.0;               ///< mean of the chips observed (geometric)
  std::size_t cases = 0, edges = 0;
  /// Samples, by their place, of more force than the others explain (`kBeyondChance`): nobody may lower or
  /// narrow anything against them.
  std::vector<std::size_t> beyond = {};
};
/// Chance of the farthest of all rows on the unsafe side of a robust fit to lie as far as that; one that is
/// less likely is not explained by the others (Bonferroni's bound). Default, unsourced.
inline constexpr double kBeyondChance = 0.01;
/// The factor that the samples ask of `law`, the specific force in N/mm2 at a chip in mm, whose own spread is
/// `spread`. A smaller force that lies far from the others counts little, a larger one in full: what is
/// unsafe is no outlier. Nothing without a usable sample.
[[nodiscard]] std::optional<FactorCorrection> correct_force_factor(std::span<const ForceSample> samples,
                                                                   const std::function<double(double)>& law,
                                                                   double spread);

/// Wear of one edge after a time in the cut.
struct WearReading {
  double time_min = 0.0, wear_mm = 0.0;
};
/// The time after which the edge is as worn as allowed, by a curve VB = c t^b through all its readings of at
/// least 0.05 mm: a reading scatters, so that the two around the limit tell less than all. Nothing where
/// fewer than two can be used or none is as worn as that: no life is given beyond what was seen.
[[nodiscard]] std::optional<double> life_of(std::span<const WearReading> readings, double allowed_mm);

/// b of VB = c t^b where readings do not tell it: wear runs in fast and goes on slower. Default, unsourced.
inline constexpr double kWearByTime = 0.7;
/// Its std dev, and that of ln VB of one reading. Defaults, unsourced.
inline constexpr double kWearByTimeSpread = 0.3, kReadingNoise = 0.1;
/// Wear below is the scatter of the reading.
inline constexpr double kLeastReadingMm = 0.05;
/// Std dev of ln T0 of a table's law (default, unsourced), and of the lives of edges of one kind: as
/// mechanics/life.
inline constexpr double kLifeSpread = 0.5, kLifeScatter = 0.3;
/// Wear of the edge after a time in the cut, mm, by the same curve through the readings of at least 0.05 mm,
/// of which one is enough: then b is `kWearByTime`. Nothing where none can be used.
[[nodiscard]] std::optional<double> wear_after(std::span<const WearReading> readings, double time_min);

/// One edge's life to the wear that is allowed.
struct LifeSample {
  double vc_m_min = 0.0, feed_mm = 0.0, depth_mm = 0.0, life_min = 0.0;
  std::size_t group = 0;  ///< the edge
  /// 0: the material that the handbook's law is of. Any other material has a life of its own, of which
  /// nothing is held beforehand, and shares the exponents alone.
  std::size_t material = 0;
};
/// The extended Taylor law as exponents of the life, and what the cases make of it.
struct LifeCorrection {
  model::ToolLifeLaw
      law;  ///< scatter: of a further edge, the law's own uncertainty at its reference included
  Corrected how;
  std::vector<std::size_t> beyond =
      {};  ///< samples of a shorter life than the others explain, by their place
};
/// `handbook`: v0 and life at v0; n; h0, a0, p, q where they are known. Where speed, feed or depth do not
/// vary, their exponents stay the handbook's. A longer life that lies far from the others counts little, a
/// shorter one in full. What is counted, left out in turn and called beyond are samples of the handbook's
/// material; nothing where there is none of it.
[[nodiscard]] std::optional<LifeCorrection> correct_life(std::span<const LifeSample> samples,
                                                         const model::ToolLifeLaw& handbook);

/// The time of one step beside the planned one, and the mean time that is planned for a block of its path.
struct TimeSample {
  double planned_s = 0.0, observed_s = 0.0, block_s = 0.0;
  std::size_t group = 0;  ///< the part
};
struct TimeCorrection {
  Corrected how;
  /// Observed over planned for blocks of this time, and the std dev of its logarithm for one further part.
  [[nodiscard]] double factor(double block_s) const;
  [[nodiscard]] double ln_std_dev(double block_s) const;
};
/// `leave_out`: whether `how.left_out` is asked for, which costs a fit for each part.
[[nodiscard]] std::optional<TimeCorrection> correct_time(std::span<const TimeSample> samples,
                                                         bool leave_out = true);

/// The deviation of a bore's diameter from what was programmed, and what it was milled with.
struct BoreSample {
  double deviation_mm = 0.0;
  double feed_per_turn_mm = 0.0, stick_out_ratio = 0.0;  ///< stick-out over the cutter's diameter
  std::size_t group = 0;                                 ///< the part
};
/// Cutters of one slenderness scatter alike: stick-outs over diameter within a factor of two, 3 and 11 apart.
/// Default, unsourced. Needs a positive number.
[[nodiscard]] std::size_t slenderness_of(double stick_out_ratio);
struct BoreCorrection {
  Corrected how;
  [[nodiscard]] double deviation_mm(double feed_per_turn_mm, double stick_out_ratio) const;
  [[nodiscard]] double std_dev_mm(double feed_per_turn_mm, double stick_out_ratio) const;
  /// Half the interval of 90 % of one further part, by Student's t of what tells the scatter: of cutters as
  /// slender (of those that scatter most, where none is), and of no more than the parts; of the parts,
  /// where all are as slender.
  [[nodiscard]] double half_90_mm(double feed_per_turn_mm, double stick_out_ratio) const;
};
/// The cutter's own deviation, and what grows as a cantilever bends: with the feed and the cube of its
/// slenderness (Timoshenko, Strength of Materials, part I). `samples`: of one cutter diameter
/// (`bores_by_cutter`), for neither is the same of another. Nothing without a usable sample.
[[nodiscard]] std::optional<BoreCorrection> correct_bores(std::span<const BoreSample> samples,
                                                          bool leave_out = true);

/// What planning may take: every member by itself.
struct Corrections {
  std::optional<ForceCorrection> force;
  std::optional<LifeCorrection> life;
  std::optional<TimeCorrection> time;
  std::map<double, BoreCorrection> bores;  ///< by the cutter's diameter, mm
};

/// A material with the corrected coefficients in place of the handbook's, their origin named.
[[nodiscard]] model::WorkMaterial corrected(model::WorkMaterial material, const Corrections& corrections);

}  // namespace capstan::casebase::tune
