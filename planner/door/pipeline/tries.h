#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/cases/corrected_card.h"
#include "planner/ground/memo/memo.h"
#include "planner/making/draft/bans.h"
#include "planner/making/propose/choose.h"
#include "planner/making/step/cut/cuts.h"
#include "planner/making/step/path/stocks.h"
#include "planner/model/plan/needed_tool.h"

// Results of earlier tries at one plan; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

/// Where a proposed step comes from.
struct MadeStep {
  draft::Member member;
  std::string chain;
  std::size_t in_chain = 0;
  std::string cutter, name;
  std::optional<draft::Mill> mill;  ///< size of an end mill, with whatever corner or nose
  bool as_found = false;            ///< depth is that of the material left there: it cannot be made thinner
  bool may_cut_nothing = false;     ///< it may be left out where it cuts nothing
  bool of_rest = false;  ///< it roughs what an earlier step of its chain left: its feature is made without it
};

/// Results of a stage for the next try.
struct Learned {
  std::vector<draft::GivenUp> given_up;
  std::vector<std::pair<model::AnyRef, std::string>> left_out;  ///< features, with why
  struct Rests {
    model::AnyRef feature, on;
    std::string why;
  };
  std::vector<Rests> rests;                       ///< features on others that are not planned
  std::vector<std::string> said;                  ///< what is planned anew, and why
  std::optional<step::SmallestCutters> smallest;  ///< of all tries so far
  std::optional<propose::Thrift> thrift;          ///< of the next try
  bool again = false;                             ///< the plan is to be made again
};

/// Results of all earlier tries. A ban is never removed: each try adds at least one, so that the tries come
/// to an end.
struct Tries {
  draft::Bans bans;
  /// Replannings and their reasons; a sentence each, in order.
  std::vector<std::string> said;
  /// Of the last try that ended: its proposed steps.
  std::map<model::AnyRef, MadeStep> made;
  /// Tools that features lack for which no cutter fits, of all tries.
  std::vector<model::NeededTool> needed = {};
  /// Answers of the optimiser that hold in every try.
  step::KnownCuts cuts;
  /// By set-up, where the last try began with another: the stock's cells follow it.
  step::SmallestCutters smallest;
  /// How few tools: more thrift where the magazine was full, never less again.
  propose::Thrift thrift = propose::Thrift::kNone;
  /// The material's card as cases correct it; made once.
  std::optional<CorrectedCard> card = std::nullopt;
  /// Results of stages: the caller's, or those of these tries alone.
  std::shared_ptr<memo::Memo> memo;

  /// Keeps what features lack; what a feature asked for in an earlier try no longer counts.
  void need(const std::vector<model::NeededTool>& tools);
  /// Keeps what a stage learned; whether the plan is to be made again.
  bool learn(Learned learned);
};

}  // namespace capstan::pipeline
