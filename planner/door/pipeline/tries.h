#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "planner/making/draft/bans.h"

// What earlier tries at one plan taught; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

class KnownCuts;

/// The smallest cutter that the steps of a set-up ended with, and how often that was another than before.
struct Smallest {
  double mm = 0.0;
  int times = 0;
};

/// What makes a set-up the same in another try: its noun, and how the workpiece lies in it. Its number is
/// not it, for tries order set-ups anew; a noun alone is not it either, for a try that makes other set-ups
/// gives them the same nouns.
using SameSetup = std::pair<model::AnyRef, std::array<double, 9>>;

/// Where a proposed step comes from.
struct MadeStep {
  draft::Member member;
  std::string chain;
  std::size_t in_chain = 0;
  std::string cutter, name;
  bool as_found = false;    ///< cuts as deep as what was left: a thinner cut cannot be asked for
  bool cut_around = false;  ///< of a boss that stands by others' steps
};

/// What earlier tries at one plan taught.
struct Tries {
  draft::Bans bans;
  /// What was planned anew, and why; a sentence each, in the order it happened.
  std::vector<std::string> said;
  /// Of the last try that ended: its proposed steps.
  std::map<model::AnyRef, MadeStep> made;
  /// Answers of the optimiser that hold in every try.
  std::shared_ptr<KnownCuts> cuts;
  /// By set-up, where the last try began with another: the stock's cells follow it.
  std::map<SameSetup, Smallest> smallest;
};

}  // namespace capstan::pipeline
