#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "casebase/recall/evidence.h"

namespace capstan::casebase {

/// Probability of success of a cut by the table, before any case. Default, unsourced.
inline constexpr double kTrustInTable = 0.9;

/// A near case that an advice leans on.
struct Leaned {
  std::string id;
  double distance = 0.0;
  Origin origin = Origin::kEntered;
  Verdict verdict = Verdict::kUnknown;
  double weight = 0.0;  ///< how much it counts, 0 to 1: near, and not counted before
  Values cut;
  friend bool operator==(const Leaned&, const Leaned&) = default;
};

/// What near cases say of a cut: from where to start, how much it may be, how likely it is to go well.
struct Advice {
  /// Speed and feed to start from, and the most that is taken: the asked values, or the centre of good cuts;
  /// lowered where cuts failed. Depth: the most that is taken; 0: whatever the limits allow. Width is kept.
  Values start;
  bool leads = false;                ///< good cuts say where to start
  Origin origin = Origin::kEntered;  ///< of those
  bool lowered = false;              ///< failed cuts made speed, feed or depth less
  bool at_bottom = false;            ///< ... and at the least values it is still likelier to fail than it may
  bool held_back = false;            ///< good cuts were harder than the asked values allow to start
  Values centre;                     ///< of good cuts, before it is held back or lowered
  int good = 0, bad = 0, unjudged = 0;  ///< near cuts, each counted once
  int cut_good = 0;                     ///< of the good ones those that were not simulated
  bool careful = false;  ///< cases are lost: what went well raises nothing (`Evidence::raises`)
  int doubted = 0;       ///< of the unjudged ones those reported as good, but cut too hard to believe; cuts
  double nearest = 0.0;  ///< distance of the nearest
  double success_asked = kTrustInTable;  ///< probability that the asked values (else the centre) go well
  double success = kTrustInTable;        ///< the same of `start`
  std::vector<Leaned> cases;             ///< heaviest first, one of each cut, at most kLeanedShown
  std::string why;                       ///< one line for people, also when there is none

  [[nodiscard]] std::size_t cuts() const { return static_cast<std::size_t>(good + bad + unjudged); }
  [[nodiscard]] bool any() const { return cuts() > 0; }
};

/// Cases that an advice names.
inline constexpr std::size_t kLeanedShown = 8;
/// Nearest cuts that an advice counts, each once. Default, unsourced.
inline constexpr std::size_t kNearAsked = 64;
/// How far above the asked values (the table's) good cuts may start, and how many it takes: one says little,
/// for the life of edges at constant values varies by more than 100 %. Below there is no such limit.
/// Defaults, unsourced.
inline constexpr double kCaseReach = 1.25;
inline constexpr int kRepeats = 3;
/// How many times as hard as the asked values a cut may have been for its success to be believed: what is
/// above is rather a slip of the pen, or another unit. Default, unsourced.
inline constexpr double kBelieved = 3.0;
/// Least probability of success that a cut is started with. Default, unsourced.
inline constexpr double kLeastSuccess = 0.75;

/// What these cases, all near enough to count, say of a cut with the asked values; zero values are open: the
/// start is then the good cuts' own.
///
/// Each case weighs by its distance; cases of one run, or with the same observations, share the weight of
/// one. Of good cuts the weighted median of log vc and of log fz is the centre, by the most trusted origin
/// that there is; origins are never mixed in it. A simulated cut without a verdict leads only where the
/// question gives no values: a computation that went well proves no cut. Whether values go well is the mean
/// of a beta distribution: prior, good cuts that were as hard or harder, bad ones that were as hard or less.
/// Values beyond what is likely enough are lowered, until it is. A good cut more than kBelieved times as hard
/// as the asked values counts as one without a verdict. One that may not raise (`Evidence::raises`) starts no
/// cut above the asked values and adds nothing to what is likely to go well; a failure that is lost counts as
/// one by the asked values.
///
/// Determinism  the same for any order of the cases. Neither their time nor their number in the base counts.
///
/// least_fz_mm   Good cuts start no lower; failed ones may still lower it. 0: no such bound.
[[nodiscard]] Advice advise(std::vector<Evidence> near, const Values& asked, double least_fz_mm = 0.0);

/// The probability that values go well, by these cases: what `advise` computes with. Falls, or stays, where
/// any of the values rises.
[[nodiscard]] double success_of(const std::vector<Evidence>& near, const Values& values);

/// How many cuts these cases tell of.
[[nodiscard]] std::size_t cuts_told(const std::vector<Evidence>& near);

/// "180 m/min and 0.08 mm per tooth, at most 4 mm deep".
[[nodiscard]] std::string words_of(const Values& v);
/// Cases a person can look up: "a1b2c3d4e5f6 (measured, bad, 0.02 away) and 2 more", at most `most` of those
/// that tell of so many cuts.
[[nodiscard]] std::string words_of(const std::vector<Leaned>& cases, std::size_t most, std::size_t cuts);

}  // namespace capstan::casebase
