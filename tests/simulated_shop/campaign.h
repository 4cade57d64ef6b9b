#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "casebase/tune/advise.h"
#include "casebase/tune/from_case.h"
#include "planner/making/optimise/cut.h"
#include "tests/simulated_shop/shop.h"

namespace capstan::testing {

/// How the shop sets speed and feed.
enum class Arm : unsigned char { kHandbook, kRegression, kProcess };
inline constexpr std::array<const char*, 3> kArmNames = {"handbook", "regression", "Gaussian process"};

/// A part's job as the planner sees it: its question, its start values, its limits and what it expects.
struct PlannedJob {
  optimise::CutQuestion question;
  double ap_mm = 0.0, ae_mm = 0.0, vc_m_min = 0.0, fz_mm = 0.0;
  ShopJob job;
  ShopTables tables;
  casebase::tune::PlannedStep planned;
  double time_s = 0.0;  ///< as planned
};
/// Drawn by the seed: sizes, and how far the limits lie from what the planner expects of its start values.
[[nodiscard]] PlannedJob drawn_job(std::uint64_t seed);

/// The planner's own limits at a setting: the largest load with its margin over its limit, minus one; by
/// `optimise` alone, whatever the tuner says.
[[nodiscard]] double planner_excess(const PlannedJob& job, const casebase::tune::Setting& at);

/// What the tuner had said of a part when it was cut: all that a shop can tell the parts apart by.
enum class Said : unsigned char {
  kOwn,       ///< a setting of the tuner's own
  kHandbook,  ///< the handbook's values: nothing yet, or no evidence that they are worse than was thought
  kAgainst,   ///< take another depth, width or tool; this part was cut all the same, as gently as was said
};
inline constexpr std::size_t kSaidCount = static_cast<std::size_t>(Said::kAgainst) + 1;

struct CampaignPart {
  casebase::tune::Setting at;
  Said said = Said::kHandbook;
  double stated = 1.0;  ///< probability that it exceeds a limit, as the tuner said before the cut; at most 1
  double time_s = 0.0;
  double planner_excess = 0.0;
  bool over_force = false, over_power = false, over_size = false, over_finish = false, over_wear = false,
       chatter = false;
  [[nodiscard]] bool over() const {
    return over_force || over_power || over_size || over_finish || over_wear || chatter;
  }
};
struct Campaign {
  std::vector<CampaignPart> parts;
  casebase::tune::Advice last;
  bool doubted = false;  ///< of any part the tuner said that the present values exceed a limit too often
  std::vector<casebase::tune::Evidence> evidence;
  /// Mean time of the last parts over that of the handbook's arm.
  [[nodiscard]] double time_of_last(std::size_t count) const;
};

/// Some parts, eight a day, each cut at what the tuner advises after the ones before.
[[nodiscard]] Campaign run_campaign(std::uint64_t seed, Arm arm, int parts);

/// Parts, and those of them that exceeded a hidden limit.
struct Tally {
  int parts = 0, over = 0;
  double stated = 0.0;  ///< how many the tuner said would, of those that it said something of
  [[nodiscard]] double share() const { return parts > 0 ? static_cast<double>(over) / parts : 0.0; }
  Tally& operator+=(const Tally& other);
};
/// One shop under one arm.
struct ShopOutcome {
  double time_ratio = 1.0;  ///< mean of its last ten parts over the handbook's
  bool doubted = false;     ///< the tuner once said that the present values exceed a limit too often
  std::array<Tally, kSaidCount> by{};
  std::vector<double> ratio_by_part = {};
  [[nodiscard]] const Tally& of(Said said) const { return by[static_cast<std::size_t>(said)]; }
  [[nodiscard]] Tally all() const;
};
/// What an arm came to over all shops: none is left out by what is hidden.
struct ArmSummary {
  std::vector<ShopOutcome> shops;
  double worst_planner_excess = -1.0;  ///< of all settings but the handbook's own
  [[nodiscard]] Tally of(Said said) const;
  [[nodiscard]] Tally all() const;
  [[nodiscard]] std::vector<Tally> by_shop(Said said) const;  ///< of shops with such parts
  /// Of all shops, or of those alone whose values the tuner never doubted.
  [[nodiscard]] std::vector<double> time_ratios(bool undoubted) const;
};
struct Summary {
  std::array<ArmSummary, kArmNames.size()> arms;
  std::vector<std::uint64_t> seeds = {};
};
[[nodiscard]] double geometric_mean(const std::vector<double>& ratios);  ///< 1 of none
[[nodiscard]] Summary run_shops(std::uint64_t first_seed, int shops, int parts);

/// Forces of further edges against the loads that planning holds its limits against at the usual margin: by
/// the card, and by the card that `tune::card_corrections` corrects from the first edges of each shop.
struct ForceForecasts {
  /// taken: those whose cases the correction is taken of, and of which no cut was seen to chatter, where
  /// nothing is narrowed.
  int shops = 0, taken = 0;
  int cuts = 0, over_card = 0, over_cases = 0;
  int within_90 = 0, sharp = 0;  ///< of the first cuts of edges: within 1.645 standard deviations of `spread`
  /// Of each shop that is taken: ln of the load held over the true mean force.
  std::vector<double> ln_held_card = {}, ln_held_cases = {};
};
[[nodiscard]] ForceForecasts forecast_forces(std::uint64_t first_seed, int shops);

/// The upper bound of a probability at 95 % (one side) after `hits` of `n`.
/// Source  Clopper and Pearson, Biometrika 26 (1934) 404.
[[nodiscard]] double clopper_pearson_upper(int hits, int n, double confidence = 0.95);

/// The upper bound at 95 % (one side) of the share of parts over a limit where shops are drawn, and not
/// parts: those of one shop are not independent. A ratio estimator, its error linearised, by Student's t; 1
/// of fewer than two shops. Source  Cochran, Sampling Techniques, 3rd edition 1977, section 2.11.
[[nodiscard]] double upper_by_shops(const std::vector<Tally>& shops);

}  // namespace capstan::testing
