#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "casebase/tune/evidence.h"
#include "casebase/tune/process.h"

namespace capstan::casebase::tune {

/// What the handbook and the planner's models hold of one load before anything was cut: ln(load / limit) at
/// the handbook's setting with a sharp edge, and how it changes with ln vc, ln fz and wear (0 sharp, 1 worn).
struct LoadPrior {
  bool watched = false;         ///< there is such a limit
  bool needs_evidence = false;  ///< what is expected is so little sure that it counts with a case of it alone
  PriorTerm ln_load, by_vc, by_fz, by_wear;
  double noise = 0.1;  ///< std dev of ln load from part to part on one edge
  double edges = 0.1;  ///< from edge to edge
};

/// The limits that hold whatever a case says: the planner's own, margins included.
///
/// The largest load over its limit at a setting, 1 when it is just kept. Empty: nothing beyond the handbook's
/// values in either direction may be proposed.
using HardLimits = std::function<double(const Setting&)>;

struct Handbook {
  std::array<LoadPrior, kWatchedCount> loads;
  /// z of the probability that the handbook's setting fails (chatter, breakage) and how sure that is.
  /// Default, unsourced: one cut in 160, between one in 2000 and one in 25.
  PriorTerm failure = {.mean = -2.5, .std_dev = 0.8};
  double cutting_share = 0.9;  ///< of the time: what speed and feed shorten
  std::string machine;
  HardLimits hard;
  double most_vc = kMostMultiplier, most_fz = kMostMultiplier;  ///< at most that
};

/// How tuning learns. `kRegression`: lines only; `kProcess`: what departs from the lines, too. The default is
/// the one that takes less time among those whose parts exceed a hidden limit no more often than stated,
/// with the bound of 95 %: in the shops of docs/validation.md, section 15, lines.
enum class Learner : unsigned char { kRegression, kProcess };

struct TuneOptions {
  Learner learner = Learner::kRegression;
  double probability = 0.05;     ///< that one part exceeds any of its limits, at most
  double step = 0.14;            ///< trust region: ln of the largest change from what is proven (15 %)
  double grid = 0.02;            ///< distance of the settings that are looked at, in ln
  double least_gain = 0.005;     ///< share of the time below which nothing new is tried
  std::size_t repeats = 3;       ///< good cuts that prove a setting,
  std::size_t edges = 2;         ///< on so many edges or days
  std::size_t most_cases = 150;  ///< the nearest of them are heard
  std::optional<long> today;     ///< days since 1970-01-01
};

/// One limit at a setting.
struct LimitView {
  std::string name;
  double load = 0.0;         ///< expected over limit, with a worn edge
  double load_95 = 0.0;      ///< 95 of 100 parts stay below
  double probability = 0.0;  ///< that the next part exceeds it
};

struct SettingView {
  Setting at;
  double time = 1.0, time_std_dev = 0.0;  ///< over the handbook's; expected ratio, std dev of its logarithm
  std::vector<LimitView> limits = {};     ///< those watched, and "chatter or breakage"
  double probability = 0.0;               ///< sum over the limits
  double hard = 0.0;                      ///< of HardLimits; 0: not asked
  Repeats repeats = {};
};

/// What tuning would change.
struct Advice {
  SettingView handbook = {};  ///< what is now known of the handbook's own values
  SettingView proven =
      {};  ///< the fastest that repeats have shown: planning's start value. The handbook's at first
  SettingView trial = {};  ///< the next to be cut; the proven one where nothing better is safe
  bool lowered = false;    ///< evidence speaks against the proven setting: `trial` is gentler, cut that
  /// ... and no speed or feed near keeps the limits as often as allowed: another depth, width or tool is
  /// needed. `trial` is then the gentlest near that fails less than every other time, else the proven one.
  bool another_cut = false;
  std::string binding = {};  ///< the limit that keeps the trial from more; empty: none of those watched
  std::string why = {};      ///< in a sentence
  std::size_t heard = 0, edges = 0, days = 0;
  std::vector<Refused> refused = {};
  std::size_t days_in_future = 0;
  std::array<ProcessSpreads, kWatchedCount> spreads = {};  ///< as learnt
};

/// The fastest setting that repeats have proven and that keeps its limits: what planning may start from.
/// Nothing where that is the handbook's own. `options.today` is heard as in `advise`.
///
/// Cost  where no setting has its repeats nothing is learnt; else cubic in the cases heard.
[[nodiscard]] std::optional<SettingView> proven(std::span<const Evidence> evidence, const Handbook& handbook,
                                                const TuneOptions& options);

/// The setting to start from and the one to try next.
///
/// Determinism  same evidence in the same order, same advice.
/// Cost         cubic in the cases heard.
[[nodiscard]] Advice advise(std::span<const Evidence> evidence, const Handbook& handbook,
                            const TuneOptions& options);

/// One point of a line through the settings: for plots.
struct LinePoint {
  double multiplier = 1.0;
  SettingView view;
};
/// Views along speed (`of_feed` false) or feed through the trial's other value.
[[nodiscard]] std::vector<LinePoint> along(std::span<const Evidence> evidence, const Handbook& handbook,
                                           const TuneOptions& options, const Setting& through, bool of_feed);

}  // namespace capstan::casebase::tune
