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

using testing::Arm;
using testing::ArmSummary;
using testing::Said;
namespace tune = casebase::tune;

constexpr std::uint64_t kFirstSeed = 4001;  // of which none was seen when a constant or a rule was chosen
constexpr int kShops = 30, kParts = 40, kForceShops = 60;

const ArmSummary& arm_of(const testing::Summary& shops, Arm arm) {
  return shops.arms[static_cast<std::size_t>(arm)];
}

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
  const auto lines = arm_of(shops, Arm::kRegression).time_ratios(false),
             process = arm_of(shops, Arm::kProcess).time_ratios(false);
  for (std::size_t i = 0; i < lines.size(); ++i) ln.push_back(std::log(lines[i] / process[i]));
  return mean_of(ln);
}

std::string of(int hits, int n) { return std::to_string(hits) + " of " + std::to_string(n); }
std::string of(const testing::Tally& t) { return t.parts > 0 ? of(t.over, t.parts) : std::string("-"); }

/// A row a shop: the time of its last ten parts over the handbook's, and its parts over a hidden limit.
Table shop_by_shop(const testing::Summary& shops) {
  Table out{{"seed", "handbook over a limit"}, {}};
  for (std::size_t a = 1; a < testing::kArmNames.size(); ++a) {
    out.head.push_back(std::string(testing::kArmNames[a]) + ": time");
    out.head.emplace_back("own settings");
    out.head.emplace_back("handbook's");
    out.head.emplace_back("against advice");
  }
  for (std::size_t i = 0; i < shops.seeds.size(); ++i) {
    std::vector<std::string> row{std::to_string(shops.seeds[i]),
                                 std::to_string(arm_of(shops, Arm::kHandbook).shops[i].all().over)};
    for (std::size_t a = 1; a < testing::kArmNames.size(); ++a) {
      const testing::ShopOutcome& shop = shops.arms[a].shops[i];
      row.push_back(fixed(shop.time_ratio, 3));
      for (const Said said : {Said::kOwn, Said::kHandbook, Said::kAgainst}) row.push_back(of(shop.of(said)));
    }
    out.rows.push_back(std::move(row));
  }
  return out;
}

/// Times of the last ten parts over the handbook's, a row an arm.
Table times(const testing::Summary& shops) {
  Table out{{"speeds and feeds", "time over the handbook's, mean", "interval of 90 %",
             "half of the shops between", "best", "worst", "largest load over a limit of the planner's",
             "shops whose values it never doubted", "time of those"},
            {}};
  for (std::size_t a = 0; a < shops.arms.size(); ++a) {
    const ArmSummary& arm = shops.arms[a];
    const std::vector<double> ratios = arm.time_ratios(false), undoubted = arm.time_ratios(true);
    std::vector<double> ln;
    for (const double r : ratios) ln.push_back(std::log(r));
    const Mean mean = mean_of(ln);
    const bool tuned = a > 0;
    out.rows.push_back({testing::kArmNames[a], fixed(testing::geometric_mean(ratios), 3),
                        fixed(std::exp(mean.value - mean.half_90), 3) + " to " +
                            fixed(std::exp(mean.value + mean.half_90), 3),
                        fixed(quantile(ratios, 0.25), 3) + " and " + fixed(quantile(ratios, 0.75), 3),
                        fixed(quantile(ratios, 0.0), 3), fixed(quantile(ratios, 1.0), 3),
                        tuned ? fixed(1.0 + arm.worst_planner_excess, 4) : "-",
                        tuned ? of(static_cast<int>(undoubted.size()), static_cast<int>(ratios.size())) : "-",
                        tuned ? fixed(testing::geometric_mean(undoubted), 3) : "-"});
  }
  return out;
}

/// Parts over a hidden limit, told apart by what the tuner had said of them.
Table parts_over(const testing::Summary& shops) {
  Table out{{"speeds and feeds", "parts", "over a hidden limit", "as the tuner said before, mean",
             "upper bound (95 %)", "the same, shops drawn", "shops with such a part"},
            {}};
  const auto row = [&](std::size_t a, Said said, const char* words) {
    const std::vector<testing::Tally> by_shop = shops.arms[a].by_shop(said);
    const testing::Tally all = shops.arms[a].of(said);
    if (all.parts == 0) return;
    const auto with = std::count_if(by_shop.begin(), by_shop.end(), [](const auto& t) { return t.over > 0; });
    out.rows.push_back({testing::kArmNames[a], words, of(all),
                        a > 0 ? fixed(100.0 * all.stated / all.parts, 1) + " %" : "-",
                        fixed(100.0 * testing::clopper_pearson_upper(all.over, all.parts), 2) + " %",
                        fixed(100.0 * std::min(1.0, testing::upper_by_shops(by_shop)), 2) + " %",
                        of(static_cast<int>(with), static_cast<int>(by_shop.size()))});
  };
  row(0, Said::kHandbook, "all");
  for (std::size_t a = 1; a < shops.arms.size(); ++a) {
    row(a, Said::kOwn, "at settings of the tuner's own");
    row(a, Said::kHandbook, "at the handbook's values, which it did not advise against");
    row(a, Said::kAgainst, "cut against its advice to take another depth, width or tool");
  }
  return out;
}

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
  const Mean between = ln_lines_over_process(shops);
  out.text =
      std::to_string(kShops) + " shops, " + std::to_string(kParts) +
      " parts in each, times of the last ten:\n\n" + markdown(times(shops)) + "\nShop by shop, lines take " +
      fixed(std::exp(between.value), 3) + " of the process's time, with an interval of 90 % from " +
      fixed(std::exp(between.value - between.half_90), 3) + " to " +
      fixed(std::exp(between.value + between.half_90), 3) +
      ".\n\nParts over a hidden limit, by what the tuner had said of them:\n\n" +
      markdown(parts_over(shops)) +
      "\nEach shop; a time is that of the last ten parts over the handbook's, the others are parts over a "
      "hidden limit:\n\n" +
      markdown(each);
  out.text += "\n" + forces_text();
  const bool lines = tune::TuneOptions{}.learner == tune::Learner::kRegression;
  const ArmSummary& taken = arm_of(shops, lines ? Arm::kRegression : Arm::kProcess);
  out.headline = "time " + percent(testing::geometric_mean(taken.time_ratios(false)) - 1.0) +
                 " against the handbook's in " + std::to_string(kShops) + " simulated shops; " +
                 of(taken.of(Said::kOwn)) +
                 " parts at its own settings over a hidden limit (stated: 5 %), none "
                 "over the planner's; " +
                 of(taken.of(Said::kAgainst)) + " cut against its advice to take another depth or tool";
  Table data{
      {"part", "regression", "regression_low", "regression_high", "process", "process_low", "process_high"},
      {}};
  for (std::size_t k = 0; k < static_cast<std::size_t>(kParts); ++k) {
    std::vector<std::string> row = {std::to_string(k + 1)};
    for (const Arm arm : {Arm::kRegression, Arm::kProcess}) {
      std::vector<double> ratios;
      for (const testing::ShopOutcome& shop : arm_of(shops, arm).shops)
        ratios.push_back(shop.ratio_by_part[k]);
      for (const double q : {0.5, 0.25, 0.75}) row.push_back(fixed(quantile(ratios, q), 4));
    }
    data.rows.push_back(std::move(row));
  }
  out.data.emplace_back("tuning.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
