#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/plan/proposal.h"

// What earlier tries at one plan taught; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

class KnownCuts;

/// What one chain of steps is proposed for: a simple feature, or one member of a pattern or compound.
struct Member {
  model::AnyRef feature;  ///< as the workingsteps name it
  model::AnyRef part;     ///< the noun that the member's shape came from
  int number = 0;
  friend auto operator<=>(const Member&, const Member&) = default;
};

/// A feature that is not planned.
struct LeftOut {
  std::vector<std::string> reasons;     ///< of its own: why each of its members cannot be made
  std::string why_rests;                ///< why the first of those is not planned
  std::vector<model::AnyRef> rests_on;  ///< features that are not planned and that this one needs
};

/// How often a step's cuts were found too large, and why last.
struct Thinner {
  int times = 0;
  std::string why;
};

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
  Member member;
  std::string chain;
  std::size_t in_chain = 0;
  std::string cutter, name;
  bool as_found = false;    ///< cuts as deep as what was left: a thinner cut cannot be asked for
  bool cut_around = false;  ///< of a boss that stands by others' steps
};

/// Choices that were tried and did not work, with the reason. Proposing passes them over and puts the reason
/// among the rejected alternatives, so that `explain` tells them. Nothing is ever taken back: each try bans
/// at least one choice more, so tries come to an end.
class Tries {
 public:
  /// The name of a chain among those of a member: its row and which of the row's alternatives it is.
  [[nodiscard]] static std::string key_of(const std::vector<model::ProposedStep>& chain);

  void ban_chain(const Member& m, const std::string& chain, const std::string& why);
  void ban_cutter(const Member& m, const std::string& chain, std::size_t step, const std::string& cutter,
                  const std::string& why);
  /// The step's cuts are to be thinner, once more.
  void cut_thinner(const Member& m, const std::string& chain, std::size_t step, const std::string& why);
  /// The check found that the step cuts nothing, where others cut around a boss: it is left out.
  void cut_nothing(const Member& m, const std::string& chain, std::size_t step, const std::string& why);
  void leave_out(model::AnyRef feature, const std::string& why);
  void rests(model::AnyRef feature, model::AnyRef on, const std::string& why);

  [[nodiscard]] const std::string* chain_banned(const Member& m, const std::string& chain) const;
  [[nodiscard]] const std::string* cutter_banned(const Member& m, const std::string& chain, std::size_t step,
                                                 const std::string& cutter) const;
  [[nodiscard]] const Thinner* thinner(const Member& m, const std::string& chain, std::size_t step) const;
  [[nodiscard]] const std::string* cuts_nothing(const Member& m, const std::string& chain,
                                                std::size_t step) const;
  [[nodiscard]] const LeftOut* left_out(model::AnyRef feature) const;

  /// What was planned anew, and why; a sentence each, in the order it happened.
  std::vector<std::string> said;
  /// Of the last try that ended: its proposed steps.
  std::map<model::AnyRef, MadeStep> made;
  /// Answers of the optimiser that hold in every try.
  std::shared_ptr<KnownCuts> cuts;
  /// By set-up, where the last try began with another: the stock's cells follow it.
  std::map<SameSetup, Smallest> smallest;

 private:
  std::map<std::pair<Member, std::string>, std::string> chains_;
  std::map<std::tuple<Member, std::string, std::size_t, std::string>, std::string> cutters_;
  std::map<std::tuple<Member, std::string, std::size_t>, Thinner> thinner_;
  std::map<std::tuple<Member, std::string, std::size_t>, std::string> nothing_;
  std::map<model::AnyRef, LeftOut> left_out_;
};

}  // namespace capstan::pipeline
