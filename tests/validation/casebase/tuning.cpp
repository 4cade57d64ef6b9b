#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "casebase/tune/advise.h"
#include "casebase/tune/regression.h"
#include "planner/ground/base/number.h"
#include "tests/simulated_shop/campaign.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using testing::ArmSummary;
namespace tune = casebase::tune;

constexpr std::uint64_t kFirstSeed =
    2001;  // none of which the tuner's or the shop's constants were chosen by
constexpr int kShops = 30, kParts = 40, kForceShops = 60;

double quantile(std::vector<double> values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1) + 0.5)];
}

struct Mean {
  double value = 0.0, half_90 = 0.0;  ///< half the interval of 90 %, by Student's t
};
Mean mean_of(const std::vector<double>& values) {
  const auto n = static_cast<double>(values.size());
  Mean out;
  for (const double v : values) out.value += v / n;
  double square = 0.0;
  for (const double v : values) square += (v - out.value) * (v - out.value);
  if (n > 1.0) out.half_90 = tune::deviations_90(n - 1.0) * std::sqrt(square / (n - 1.0) / n);
  return out;
}

/// The time that lines take over that of the process, shop by shop.
Mean ln_lines_over_process(const testing::Summary& shops) {
  std::vector<double> ln;
  const auto& lines = shops.arms[static_cast<std::size_t>(testing::Arm::kRegression)].time_ratio;
  const auto& process = shops.arms[static_cast<std::size_t>(testing::Arm::kProcess)].time_ratio;
  for (std::size_t i = 0; i < lines.size(); ++i) ln.push_back(std::log(lines[i] / process[i]));
  return mean_of(ln);
}

/// A row a shop: the time of its last ten parts over the handbook's, and its parts over a hidden limit.
Table shop_by_shop(const testing::Summary& shops) {
  Table out{{"seed", "handbook over a limit"}, {}};
  for (std::size_t a = 1; a < testing::kArmNames.size(); ++a) {
    out.head.push_back(std::string(testing::kArmNames[a]) + ": time");
    out.head.emplace_back("over a limit");
  }
  for (const testing::Summary::Shop& shop : shops.each) {
    std::vector<std::string> row{std::to_string(shop.seed), std::to_string(shop.over[0])};
    for (std::size_t a = 1; a < shop.over.size(); ++a) {
      row.push_back(fixed(shop.time_ratio[a], 3));
      row.push_back(std::to_string(shop.over[a]));
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

std::string of(int hits, int n) { return std::to_string(hits) + " of " + std::to_string(n); }

/// Forces of further edges by the card and by the corrected card.
std::string forces_text() {
  const testing::ForceForecasts f = testing::forecast_forces(kFirstSeed, kForceShops);
  const auto row = [&](const char* name, std::vector<double> ln, int over) {
    return std::vector<std::string>{
        name, fixed(std::exp(quantile(ln, 0.0)), 2) + " to " + fixed(std::exp(quantile(ln, 1.0)), 2),
        fixed(std::exp(quantile(ln, 0.5)), 2), of(over, f.cuts),
        fixed(100.0 * testing::clopper_pearson_upper(over, f.cuts), 1) + " %"};
  };
  const Table table{{"load that limits are held against", "over a shop's true mean force", "median",
                     "cuts beyond it", "upper bound (95 %)"},
                    {row("by the card", f.ln_held_card, f.over_card),
                     row("by the card as four edges correct it", f.ln_held_cases, f.over_cases)}};
  return "Forces of ten further edges in each of " + of(f.taken, f.shops) +
         " shops whose first four, cut at 80, 100 and 110 % of the planned feed, correct the card (the usual "
         "margin states 16 %):\n\n" +
         markdown(table) + "\nOf the first cuts of those edges " + of(f.within_90, f.sharp) +
         " lie within the interval of 90 % that the correction states.\n";
}

}  // namespace

Comparison tuning(Extent extent) {
  constexpr int kSample = 4;  // shops
  Comparison out{.name = "tuning"};
  const testing::Summary shops =
      testing::run_shops(kFirstSeed, extent == Extent::kSample ? kSample : kShops, kParts);
  const Table each = shop_by_shop(shops);
  if (extent == Extent::kSample) {
    out.lines = lines_of(each);
    return out;
  }
  Table arms{{"speeds and feeds", "time over the handbook's, mean", "half of the shops between", "best",
              "worst", "parts over a hidden limit", "upper bound (95 %)", "the same, a shop counted as one",
              "shops with such a part", "largest load over a limit of the planner's"},
             {}};
  for (std::size_t a = 0; a < shops.arms.size(); ++a) {
    const ArmSummary& arm = shops.arms[a];
    const bool tuned = a > 0;
    arms.rows.push_back(
        {testing::kArmNames[a], fixed(arm.mean_ratio(), 3),
         fixed(quantile(arm.time_ratio, 0.25), 3) + " and " + fixed(quantile(arm.time_ratio, 0.75), 3),
         fixed(quantile(arm.time_ratio, 0.0), 3), fixed(quantile(arm.time_ratio, 1.0), 3),
         of(arm.over, arm.parts),
         fixed(100.0 * testing::clopper_pearson_upper(arm.over, arm.parts), 2) + " %",
         fixed(100.0 * (mean_of(arm.over_share).value + mean_of(arm.over_share).half_90), 2) + " %",
         of(arm.shops_over, shops.sound), tuned ? fixed(1.0 + arm.worst_planner_excess, 4) : "-"});
  }
  Table unsound{{"speeds and feeds", "parts over a hidden limit"}, {}};
  for (std::size_t a = 0; a < shops.arms.size(); ++a) {
    unsound.rows.push_back(
        {testing::kArmNames[a], of(shops.arms[a].unsound_over, shops.arms[a].unsound_parts)});
  }
  const Mean between = ln_lines_over_process(shops);
  out.text = std::to_string(shops.sound) + " of " + std::to_string(shops.shops) +
             " shops in which the handbook's values keep the hidden limits in 95 of 100 parts, " +
             std::to_string(kParts) + " parts in each, times of the last ten:\n\n" + markdown(arms) +
             "\nShop by shop, lines take " + fixed(std::exp(between.value), 3) +
             " of the process's time, with an interval of 90 % from " +
             fixed(std::exp(between.value - between.half_90), 3) + " to " +
             fixed(std::exp(between.value + between.half_90), 3) + ".\n" + "\nThe other " +
             std::to_string(shops.shops - shops.sound) + ":\n\n" + markdown(unsound) +
             "\nEach shop; a time is that of the last ten parts over the handbook's:\n\n" + markdown(each);
  out.text += "\n" + forces_text();
  const bool lines = tune::TuneOptions{}.learner == tune::Learner::kRegression;
  const ArmSummary& taken =
      shops.arms[static_cast<std::size_t>(lines ? testing::Arm::kRegression : testing::Arm::kProcess)];
  out.headline = "time " + percent(taken.mean_ratio() - 1.0) + " against the handbook's in " +
                 std::to_string(shops.sound) + " simulated shops; " + of(taken.over, taken.parts) +
                 " parts over a hidden limit (stated: 5 %), none over the planner's";
  Table data{
      {"part", "regression", "regression_low", "regression_high", "process", "process_low", "process_high"},
      {}};
  for (std::size_t k = 0; k < static_cast<std::size_t>(kParts); ++k) {
    std::vector<std::string> row = {std::to_string(k + 1)};
    for (const testing::Arm arm : {testing::Arm::kRegression, testing::Arm::kProcess}) {
      std::vector<double> ratios;
      for (const auto& shop : shops.arms[static_cast<std::size_t>(arm)].ratio_by_part)
        ratios.push_back(shop[k]);
      for (const double q : {0.5, 0.25, 0.75}) row.push_back(fixed(quantile(ratios, q), 4));
    }
    data.rows.push_back(std::move(row));
  }
  out.data.emplace_back("tuning.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
