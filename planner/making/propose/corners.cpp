#include "planner/making/propose/corners.h"

#include <algorithm>
#include <utility>

#include "planner/ground/base/number.h"
#include "planner/making/piece/raw_piece_limits.h"
#include "planner/model/features/in_piece.h"
#include "planner/model/plan/resources/changed_by_hand.h"

// Rest material in inside corners. The radii that may stay in place of the stated one are half the diameters
// of the mills that there are, for between two of them no other mill enters. They are tried from the least
// up, until a chain of the rules has all its cutters for one; those of mills that would be too slender for
// the depth come last, the stiffest first. Where that chain takes long of this one feature, a wider radius is
// taken if it is decisively quicker, up to widest_for_time_mm.

namespace capstan::propose {
namespace {

using model::CutterClass;
using model::FeatureShape;
using model::ShapeKind;

/// A mill cuts well down to so many of its diameters. Measured on a pocket of 60 x 40 mm in C45: 10 mm deep,
/// mills of 2 and 2.5 mm in its corners take 4:37 and 4:02 in all; 18 mm deep, of 3 and 4 mm 18:05 and 7:43.
/// Default, unsourced.
constexpr double kDiametersDeep = 4.0;
/// A ball that finishes a surface, whose last limit is how far it bends. Default, unsourced.
constexpr double kBallDiametersDeep = 2.5;
/// Radii for which a chain had its cutters and was tried in vain, before the feature is not planned: each
/// costs a try of the whole plan. Default, unsourced.
constexpr int kMostInVain = 3;
/// Cutting and tool changes of a feature that are not long, s. Default, unsourced.
constexpr double kLongS = 1200.0;
/// More than the alternatives of a row: chains of each radius have keys of their own (draft::key_of).
constexpr int kOneRadius = 1000;

/// The radius that may stay in the corners as they are stated, mm; nothing: none limits the cutters.
std::optional<double> may_stay(const rules::Context& context, const FeatureShape& s, bool square) {
  if (square) return s.corner_radius_mm;
  if (s.kind == ShapeKind::kFreeform)
    return context.surface_radius_mm > 0.0 ? std::optional(context.surface_radius_mm) : std::nullopt;
  if (s.kind != ShapeKind::kPocket && s.kind != ShapeKind::kSlot && context.sharp_corner_mm <= 0.0)
    return std::nullopt;
  if (s.corner_radius_mm > 0.0) return s.corner_radius_mm;
  return context.sharp_corner_mm > 0.0 ? std::optional(context.sharp_corner_mm) : std::nullopt;
}

/// The radii of mills above one, on a surface of balls, in the order in which they are tried for walls that
/// are this high.
std::vector<double> mill_radii_above(const std::vector<model::Cutter>& usable, double radius_mm,
                                     double depth_mm, bool balls) {
  std::vector<double> out;
  for (const model::Cutter& c : usable) {
    const bool mill = c.cutter_class == CutterClass::kBallEndmill ||
                      (!balls && (c.cutter_class == CutterClass::kEndmill ||
                                  c.cutter_class == CutterClass::kBullnoseEndmill));
    if (mill && 0.5 * c.cutting_diameter_mm > radius_mm) out.push_back(0.5 * c.cutting_diameter_mm);
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  const double well_mm = 0.5 * depth_mm / (balls ? kBallDiametersDeep : kDiametersDeep);
  const auto well = std::lower_bound(out.begin(), out.end(), well_mm);
  std::reverse(out.begin(), well);
  std::rotate(out.begin(), well, out.end());
  return out;
}

/// What the rules propose where the corners may keep a radius, the n-th that is tried.
model::Proposal proposal_for(const Choice& choice, const rules::RuleBase& rules, rules::Context context,
                             FeatureShape s, double radius_mm, int n) {
  const bool surface = s.kind == ShapeKind::kFreeform;
  if (surface) context.surface_radius_mm = radius_mm;
  if (context.sharp_corner_mm > 0.0) context.sharp_corner_mm = radius_mm;
  const bool unstated = context.sharp_corner_mm > 0.0 && !(s.corner_radius_mm > 0.0);
  if (!unstated && !surface) s.corner_radius_mm = radius_mm;
  model::Proposal p = piece::without_drills_at_edges(choice.piece, s, rules::propose(rules, s, context));
  for (auto& chain : p.chains) {
    for (model::ProposedStep& step : chain) {
      step.priority += n * kOneRadius;
      step.why.text += (step.why.text.empty() ? "" : "; ") +
                       ("rest material of radius " + trimmed(radius_mm, 4)) + " mm stays in " +
                       (surface ? "narrow places" : "the corners");
    }
  }
  return p;
}

bool tried(const Choice& choice, const model::Proposal& p, const draft::Member& member) {
  return std::any_of(p.chains.begin(), p.chains.end(), [&](const auto& chain) {
    return choice.bans.chain_banned(member, draft::key_of(chain)) != nullptr;
  });
}

}  // namespace

double widest_for_time_mm(const FeatureShape& s, bool square) {
  return square || s.corner_radius_mm > 0.0 ? model::unstated_corner_mm(s.depth_mm)
                                            : model::unstated_corner_mm(s);
}

InCorners choose_in_corners(const Choice& choice, const rules::RuleBase& rules, const rules::Context& context,
                            model::Proposal p, const FeatureShape& shape, const draft::Member& member,
                            const std::vector<draft::StepDraft>& steps, const std::vector<std::string>& used,
                            Job& job) {
  InCorners out;
  out.drawn_square = piece::drawn_square(choice.piece, shape);
  out.rejected = p.rejected;
  out.proposal = std::move(p);
  const bool square = !out.drawn_square.empty();
  if (!square) {
    out.chosen = choose(choice, out.proposal, shape, member, steps, used, out.rejected, job);
    if (out.chosen.chain != nullptr) return out;
  }
  const auto stated = may_stay(context, shape, square);
  if (!stated) return out;
  const std::vector<model::Rejected> before = out.rejected;
  const bool surface = shape.kind == ShapeKind::kFreeform;
  const int most_in_vain = surface ? 1 : kMostInVain;  // a path over a surface takes long
  const double widest = surface ? *stated : widest_for_time_mm(shape, square);
  const double depth = surface ? context.stock_above_mm : shape.depth_mm;
  int n = 0, in_vain = 0;
  for (const double radius : mill_radii_above(choice.usable, *stated, depth, surface)) {
    const bool taken = out.rest.has_value();
    if (taken && (out.chosen.seconds <= kLongS || radius < out.rest->radius_mm || radius > widest)) break;
    model::Proposal wider = proposal_for(choice, rules, context, shape, radius, ++n);
    std::vector<model::Rejected> rejected = before;
    Chosen chosen = choose(choice, wider, shape, member, steps, used, rejected, job);
    if (chosen.chain == nullptr) {
      if (!taken && tried(choice, wider, member) && ++in_vain == most_in_vain) break;
      continue;
    }
    if (taken && !decisively_quicker(chosen.seconds, out.chosen.seconds)) continue;
    const std::string why = square ? out.drawn_square + ", and a mill leaves them round"
                                   : std::string("no chain has its cutters for ") +
                                         (surface ? "places" : "corners") + " of radius " +
                                         trimmed(*stated, 4) + " mm, " + trimmed(depth, 3) + " mm deep";
    out.rest = model::CornerRest{shape.name, *stated, radius,
                                 why + "; this is the least radius that the mills that there are make well"};
    out.rejected = std::move(rejected);
    out.proposal = std::move(wider);
    out.chosen = std::move(chosen);
  }
  return out;
}

std::string full_magazine(const Choice& choice, const rules::RuleBase& rules, const rules::Context& context,
                          const model::Proposal& p, const FeatureShape& shape, const draft::Member& member,
                          const std::vector<std::string>& used) {
  const int pockets = choice.piece.plan.machine.magazine_pockets;
  if (model::changed_by_hand(choice.piece.plan.machine) || used.empty()) return {};
  Job unsaid;
  const Chosen alone = choose_in_corners(choice, rules, context, p, shape, member, {}, {}, unsaid).chosen;
  if (alone.chain == nullptr) return {};
  std::string further;
  for (const std::string& id : alone.further) {
    if (std::find(used.begin(), used.end(), id) == used.end()) further += (further.empty() ? "" : ", ") + id;
  }
  return "the magazine has " + std::to_string(pockets) + " pockets, and the tools of other features take " +
         std::to_string(used.size()) + " of them; it also needs " + further +
         ": make it in another run, or on a machine with more pockets";
}

}  // namespace capstan::propose
