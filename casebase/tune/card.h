#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "casebase/record/case.h"
#include "casebase/tune/corrections.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

/// What measured cases say of a material's card: planning takes it in place of the card's own numbers.
///
/// Force   each case gives ln(kc observed / kc of the card) at its mean chip as it was executed: the feed of
///         the case over the one that its plan's schedule held longest, times the planned chip. kc observed
///         is the specific force that the plan of the case used, times observed over predicted peak force
///         without its margin, over that share of the feed. Runout is no part of that share: a tooth that it
///         makes cut deeper by r takes (s f + r) / (f + r) of its planned chip at a share s of the feed f,
///         more than s below 1, so that kc comes out too high there, and less above, so that it comes out too
///         low: by a factor of s at most, and above kMostFeedShare no force is heard. One factor is fitted to
///         them, each edge a group of its own, with the card's spread as its prior. It is of the whole force
///         of a mill: all six coefficients of a set, the axial edge force (kae) among them, are multiplied by
///         it, for a peak force tells no two of them apart. Kienzle's law is taken for a rake of 0, and the
///         rake of a case's mill is taken out of its force, so that what raked mills saved does not count for
///         mills without a rake. A set of the card is of the rake of the mills that it was measured with,
///         which nobody states.
/// Life    the extended Taylor law, as `correct_life`, of the speed and feed that were executed: those of the
///         case that holds the edge's readings stand for all of its cuts. The card's exponents stay: one
///         factor holds at every speed, the least that the fit gives at the card's reference and at the
///         speeds, feeds and depths that edges were worn with.
///
/// Bound  what goes the safe way, a lower force or a longer life, is taken no further than two bounds allow:
///        the end of its interval of 90 % that is nearer to the card, and one step of tuning's trust region
///        (TuneOptions::step) for every `kLeastEdges` edges. Of a life that step is of the speed, so that its
///        life may be longer by the step over Taylor's exponent. The other way is taken in full.
///
/// What is unsafe is no outlier: a force above, or a life below, what the others explain forbids that
/// anything is lowered or narrowed (`CardCorrection::beyond`), and so does a tool of the substrate that broke
/// or chattered heavily in this material (`cut_short`), of which no figure is heard. A force of a feed that
/// is not heard is still held against the others: at less feed than planned it is at most that of the planned
/// feed, and above it runout hides a part of it; where even so it lies `kBelievedDeviations` of the spread
/// above what they say, it is beyond.
///
/// While cases are lost (`Given::kSome`) any of them may have spoken against what the others say: nothing is
/// lowered or narrowed, and what raises a force or shortens a life is taken of fewer edges than kLeastEdges,
/// too, for others that said so may be among the lost.
namespace capstan::casebase::tune {

/// Named edges that were measured before planning takes what they say: fewer do not show how far edges
/// differ. Default, unsourced: as many as the repeats that prove a start (recall/advice.h).
inline constexpr std::size_t kLeastEdges = 3;
/// The least factor of one standard deviation of a force that evidence may narrow to: lots of one material
/// differ, and all cases may be of one lot. Default, unsourced.
inline constexpr double kLeastForceSpread = 1.1;
/// Standard deviations of what is held beforehand beyond which a smaller force, or a longer life, is not
/// believed: 98 of 100 lie within. A larger force and a shorter life are.
inline constexpr double kBelievedDeviations = 2.0;

/// Executed over planned feed within which a force is heard: far below, the law of the chip carries what the
/// cut does not show; above, see the runout. Defaults, unsourced; the upper one is kLeastForceSpread.
inline constexpr double kLeastFeedShare = 0.5, kMostFeedShare = 1.1;

/// Version of what `card_corrections` makes of the same cases: raised with every change of that, so that what
/// an earlier version put into a plan's card is not taken for today's.
inline constexpr int kCardRules = 2;

/// Whether the cases that are given are all that were stored.
enum class Given : unsigned char { kAll, kSome };

enum class CardModel : unsigned char { kForce, kLife };

struct CardCorrection {
  CardModel model = CardModel::kForce;
  model::Substrate substrate = model::Substrate::kCarbide;
  std::size_t cases = 0, edges = 0;
  /// Force at `chip_mm`, or life where it is least (above), over the card's: as cases have it, and as
  /// bounded.
  double seen = 1.0, factor = 1.0;
  double spread_before = 1.0;               ///< factor of one standard deviation: the card's,
  double spread = 1.0;                      ///< and of a further edge by these cases
  double chip_mm = 0.0;                     ///< mean of the chips observed (geometric)
  model::ToolLifeLaw law;                   ///< of kLife
  std::string of_what = {};                 ///< which cuts it holds for: "mills, as for a rake of 0"
  std::vector<std::string> ids = {};        ///< of the cases heard, by id
  std::vector<std::string> beyond = {};     ///< of those that the others do not explain, on the unsafe side
  std::vector<std::string> cut_short = {};  ///< of the cases whose tool broke or chattered heavily, by id
  /// Figures that are not heard, for nobody says at which feed (of lives: speed, too) they were measured, or
  /// which feed the plan of a force held.
  std::size_t unfed = 0;
  std::size_t far = 0;  ///< forces that are not heard, for their feed lies beyond kLeast- or kMostFeedShare
  std::string why_not;  ///< why planning does not take it; empty: it does

  [[nodiscard]] bool taken() const { return why_not.empty(); }
  /// "cutting force of carbide mills, as for a rake of 0: cases say 0.82 of the card's; 0.85 is used, spread
  /// 1.14 instead of 1.5 (18 cases on 6 edges)", and what is not heard or not explained.
  [[nodiscard]] std::string words() const;
  /// "2 forces of carbide mills were measured outside 0.5 to 1.1 times the planned feed and are not used";
  /// empty where there are none.
  [[nodiscard]] std::string far_words() const;
  /// Both, as records have them.
  [[nodiscard]] std::string all_words() const;
  /// "1f0c53c2b77a, 2b77a901f3c5 and 16 more".
  [[nodiscard]] std::string named() const;
};

/// The spread of a card's forces for milling with a substrate, as a factor (mechanics::ForceMargin::spread).
using SpreadOf = std::function<double(model::Substrate)>;

/// What these cases say of the card, in the order of substrates; nothing where none says anything. Heard are
/// measured figures of named edges, of cases of this material whose plan says what it expected, of forces
/// those whose executed feed was measured, too, near enough to the one that the plan's schedule holds, of
/// lives those whose executed speed and feed were; not of cuts whose tool broke or chattered, which are
/// counted. Equal figures count once. `card`: without the correction of any case.
[[nodiscard]] std::vector<CardCorrection> card_corrections(std::span<const Case> cases,
                                                           const model::WorkMaterial& card,
                                                           const SpreadOf& spread_of,
                                                           Given given = Given::kAll);

}  // namespace capstan::casebase::tune
