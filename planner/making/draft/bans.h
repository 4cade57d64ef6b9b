#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/making/draft/draft.h"

namespace capstan::draft {

/// A feature that is not planned.
struct LeftOut {
  std::vector<std::string> reasons;  ///< of its own: why each of its members cannot be made
  std::string why_rests;             ///< why the first of those is not planned
  std::vector<AnyRef> rests_on;      ///< features that are not planned and that this one needs
};

/// How often a step's cuts were found too large, and why last.
struct Thinner {
  int times = 0;
  std::string why;
};

/// A chain that does not work.
struct GivenUp {
  Member member;
  std::string chain, why;
};

/// Size of a mill, mm.
struct Mill {
  double diameter_mm = 0.0, corner_radius_mm = 0.0;
};

/// Choices that were tried in vain, with the reason. Proposing skips them and adds the reason to the rejected
/// alternatives, where `explain` lists them. A ban is never removed: each try adds at least one, so that the
/// tries come to an end.
class Bans {
 public:
  void ban_chain(const Member& m, const std::string& chain, const std::string& why);
  void ban_chain(const GivenUp& g) { ban_chain(g.member, g.chain, g.why); }
  void ban_cutter(const Member& m, const std::string& chain, std::size_t step, const std::string& cutter,
                  const std::string& why);
  /// A mill leaves material that none as wide reaches, nor one of its width with as large a corner: these are
  /// banned.
  void ask_narrower(const Member& m, const std::string& chain, std::size_t step, const Mill& than,
                    const std::string& why);
  /// The step's cuts are to be thinner, once more.
  void cut_thinner(const Member& m, const std::string& chain, std::size_t step, const std::string& why);
  /// The check found that the step cuts nothing, where others cut around a boss: it is left out.
  void cut_nothing(const Member& m, const std::string& chain, std::size_t step, const std::string& why);
  void leave_out(AnyRef feature, const std::string& why);
  void rests(AnyRef feature, AnyRef on, const std::string& why);

  [[nodiscard]] const std::string* chain_banned(const Member& m, const std::string& chain) const;
  [[nodiscard]] const std::string* cutter_banned(const Member& m, const std::string& chain, std::size_t step,
                                                 const model::Cutter& cutter) const;
  [[nodiscard]] const Thinner* thinner(const Member& m, const std::string& chain, std::size_t step) const;
  [[nodiscard]] const std::string* cuts_nothing(const Member& m, const std::string& chain,
                                                std::size_t step) const;
  [[nodiscard]] const LeftOut* left_out(AnyRef feature) const;

 private:
  std::map<std::pair<Member, std::string>, std::string> chains_;
  std::map<std::tuple<Member, std::string, std::size_t, std::string>, std::string> cutters_;
  std::map<std::tuple<Member, std::string, std::size_t>, std::pair<Mill, std::string>> narrower_;
  std::map<std::tuple<Member, std::string, std::size_t>, Thinner> thinner_;
  std::map<std::tuple<Member, std::string, std::size_t>, std::string> nothing_;
  std::map<AnyRef, LeftOut> left_out_;
};

}  // namespace capstan::draft
