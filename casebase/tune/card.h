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
/// Force   each case gives ln(kc observed / kc of the card) at its mean chip, where kc observed is the
/// specific
///         force that the plan of the case used, times observed over predicted peak force without its margin.
///         One factor is fitted to them, each edge a group of its own, with the card's spread as its prior.
///         Kienzle's law is taken for a rake of 0 and the rake of a case's mill taken out of its force, so
///         that what raked mills saved does not count for mills without a rake.
/// Life    the extended Taylor law, as `correct_life`.
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

enum class CardModel : unsigned char { kForce, kLife };

struct CardCorrection {
  CardModel model = CardModel::kForce;
  model::Substrate substrate = model::Substrate::kCarbide;
  std::size_t cases = 0, edges = 0;
  double factor = 1.0;         ///< force at `chip_mm`, or life at the law's reference, over the card's
  double spread_before = 1.0;  ///< factor of one standard deviation: the card's,
  double spread = 1.0;         ///< and of a further edge by these cases
  double chip_mm = 0.0;        ///< mean of the chips observed (geometric)
  model::ToolLifeLaw law;      ///< of kLife
  std::string why_not;         ///< why planning does not take it; empty: it does

  [[nodiscard]] bool taken() const { return why_not.empty(); }
  /// "cutting force of carbide mills: 0.82 of the card's, spread 1.14 instead of 1.5 (18 cases on 6 edges)".
  [[nodiscard]] std::string words() const;
};

/// The spread of a card's forces for milling with a substrate, as a factor (mechanics::ForceMargin::spread).
using SpreadOf = std::function<double(model::Substrate)>;

/// What these cases say of the card, in the order of substrates; nothing where none says anything. Heard are
/// measured figures of named edges, of cases of this material whose plan says what it expected; equal figures
/// count once. `card`: without the correction of any case.
[[nodiscard]] std::vector<CardCorrection> card_corrections(std::span<const Case> cases,
                                                           const model::WorkMaterial& card,
                                                           const SpreadOf& spread_of);

}  // namespace capstan::casebase::tune
