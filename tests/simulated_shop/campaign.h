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

struct CampaignPart {
  casebase::tune::Setting at;
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
  std::vector<casebase::tune::Evidence> evidence;
  /// Mean time of the last parts over that of the handbook's arm.
  [[nodiscard]] double time_of_last(std::size_t count) const;
};

/// Some parts, eight a day, each cut at what the tuner advises after the ones before.
[[nodiscard]] Campaign run_campaign(std::uint64_t seed, Arm arm, int parts);

/// What an arm came to over many shops.
struct ArmSummary {
  std::vector<double> time_ratio;  ///< of each sound shop: mean of its last ten parts over the handbook's
  std::vector<double> over_share;  ///< of each sound shop: parts that exceeded a hidden limit
  std::vector<std::vector<double>> ratio_by_part;  ///< of each sound shop, part by part
  int parts = 0, over = 0;                  ///< in sound shops: parts, and those that exceeded a hidden limit
  int shops_over = 0;                       ///< sound shops with any such part
  int unsound_parts = 0, unsound_over = 0;  ///< in the others
  double worst_planner_excess = -1.0;       ///< of all settings but the handbook's own, in all shops
  [[nodiscard]] double mean_ratio() const;  ///< geometric
};
/// Sound is a shop in which the handbook's own values exceed a hidden limit in at most 5 of 100 parts.
struct Summary {
  /// One shop: of each arm the mean time of its last ten parts over the handbook's, and its parts over a
  /// hidden limit.
  struct Shop {
    std::uint64_t seed = 0;
    std::array<double, kArmNames.size()> time_ratio{};
    std::array<int, kArmNames.size()> over{};
  };
  std::array<ArmSummary, kArmNames.size()> arms;
  std::vector<Shop> each = {};
  int shops = 0, sound = 0;
};
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

}  // namespace capstan::testing
