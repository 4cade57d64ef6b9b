#include "rules/spots.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>

#include "planner/ground/base/number.h"
#include "rules/facts/facts.h"

namespace capstan::rules {
namespace {

using model::ProposedStep;

/// How deep a solid carbide drill starts by itself, in diameters: beyond 5 makers of drills agree on a spot,
/// others begin at 7 or 8 (Cutting Tool Engineering, June 2012, Starter kit, ctemag.com); up to there "a
/// solid-carbide drill usually doesn't need to be spotted" (the same, Get it straight).
constexpr double kStartsAloneRatio = 5.0;
/// Full angle of the spot before such a drill, whose point has 140 degrees: at least the drill's, so that its
/// middle meets the cone first (cncyangsen.com, spot drill vs center drill: equal or slightly larger); makers
/// grind 142 to 145.
constexpr double kBluntSpotRad = 142.0 * std::numbers::pi / 180.0;
/// Width of the mark over the drill's diameter, at most: a pilot needs no mark as wide as its hole's. As the
/// rows of hole.yaml mark for a drill; default, unsourced.
constexpr double kMarkOfDrill = 0.6;

/// Drills with inserts (ISO 13399: SIG near 180 degrees) are made from about this diameter. Default,
/// unsourced.
constexpr double kInsertsFromMm = 14.0;
/// How much wider than itself such a drill may cut, for one insert alone shapes the wall. Default, unsourced:
/// half of IT13 at 18 to 30 mm is 0.165.
constexpr double kInsertsOversizeMm = 0.15;
/// Without coolant through the drill its chips come out of holes this deep, in diameters. Default, unsourced.
constexpr double kInsertsByFloodRatio = 2.0;

/// Whether a drill with inserts may make the hole of the chain's drill: from the solid, at one go, through or
/// to a bottom that a mill makes level, where what follows, or the tolerance, leaves room for its oversize.
bool inserts_do(const model::FeatureShape& shape, const Context& context, const ProposedStep& drill,
                bool last) {
  const double most = model::upper_size(drill.tool);
  if (most < kInsertsFromMm || drill.peck || drill.start_diameter_mm > 0.0) return false;
  if (drill.tool.point_angle_rad > 0.0 || context.core_diameter_mm > 0.0) return false;
  const bool wet = context.has_coolant || context.has_through_coolant;
  const double deep = (drill.depth_mm + context.stock_above_mm) / most;
  if (!wet || (!context.has_through_coolant && deep > kInsertsByFloodRatio)) return false;
  const model::Toleranced size = facts_of(shape, context).diameter;
  const double widest = size.nominal_mm + (last ? size.upper_mm : size.lower_mm);
  return most + kInsertsOversizeMm <= widest + model::kSizeSlackMm;
}

/// A chain that begins with a spot and a twist drill, for a drill of solid carbide: without the spot where
/// none is needed, else with a spot as blunt as that drill. Nothing of other chains. Holes with a zone of
/// position keep the spot ("for a tight-tolerance hole, spotting is required", Starter kit).
std::optional<std::vector<ProposedStep>> by_carbide(const model::FeatureShape& shape, const Context& context,
                                                    std::vector<ProposedStep> chain) {
  if (shape.kind != model::ShapeKind::kHole || chain.size() < 2) return std::nullopt;
  ProposedStep& spot = chain[0];
  ProposedStep& drill = chain[1];
  const bool drills =
      drill.operation == model::TypeId::kDrilling || drill.operation == model::TypeId::kMultistepDrilling;
  const double least = model::lower_size(drill.tool);
  if (spot.operation != model::TypeId::kCenterDrilling || !drills || !(least > 0.0) ||
      drill.tool.classes != std::vector{model::CutterClass::kTwistDrill})
    return std::nullopt;
  const auto say = [](ProposedStep& s, const std::string& text) {
    s.tool.words = words_of(s.tool);
    s.why.text += (s.why.text.empty() ? "" : "; ") + text;
  };
  drill.tool.solid_carbide = true;
  const std::string most = trimmed(kStartsAloneRatio, 1) + " diameters";
  const bool deep = drill.depth_mm + context.stock_above_mm > kStartsAloneRatio * least;
  if (deep || context.quality.location_mm) {
    const double wide = std::min(2.0 * spot.depth_mm, kMarkOfDrill * least);  // at 90 degrees: the first
    const double depth = 0.5 * wide / std::tan(0.5 * kBluntSpotRad);
    spot.tool.diameter_min_mm = wide;
    spot.tool.reach_mm -= spot.depth_mm - depth;
    spot.tool.point_angle_rad = kBluntSpotRad;
    spot.tool.point_angle_most_rad = 0.0;
    spot.depth_mm = spot.tool.depth_of_cut_mm = depth;
    say(spot, "as blunt as a carbide drill's point, whose middle meets it first");
    say(drill, deep ? "spotted: deeper than " + most : "spotted: a zone of position is required");
    return chain;
  }
  say(drill,
      "not spotted: a solid carbide drill centres itself to " + most + " (ctemag.com, Get it straight)");
  if (inserts_do(shape, context, drill, chain.size() == 2)) {
    drill.tool.point_angle_most_rad = std::numbers::pi;
    if (context.has_through_coolant) drill.coolant_through = true;
    say(drill, "or one with inserts: at one go, " + trimmed(kInsertsOversizeMm, 2) + " mm wider at most");
  }
  chain.erase(chain.begin());
  for (ProposedStep& s : chain) {
    for (std::size_t& after : s.after) --after;
  }
  chain.front().after.clear();
  return chain;
}

/// Full angle of the spot that breaks an edge at 45 degrees.
constexpr double kBevelSpotRad = 0.5 * std::numbers::pi;

/// A chain that begins with a spot and breaks the hole's edge later: the spot goes as deep as the bevel is
/// wide beyond the hole, and the step that breaks the edge falls away. Nothing of other chains, nor where the
/// spot's tip would go through the hole's bottom or its body would not pass beside a wall. Its drill is none
/// of solid carbide, whose corners would meet the cone first.
std::optional<std::vector<ProposedStep>> by_spot(const model::FeatureShape& shape, const Context& context,
                                                 std::vector<ProposedStep> chain) {
  const double bevel = context.edge_break_mm;
  if (shape.kind != model::ShapeKind::kHole || !(bevel > 0.0) || chain.size() < 3) return std::nullopt;
  const auto edge = std::find_if(chain.begin() + 1, chain.end(), [](const ProposedStep& s) {
    return s.operation == model::TypeId::kSideFinishMilling && s.tool.point_angle_rad == kBevelSpotRad &&
           s.axial_depth_mm > 0.0;
  });
  ProposedStep& spot = chain[0];
  if (spot.operation != model::TypeId::kCenterDrilling || edge == chain.end()) return std::nullopt;
  const double wide = shape.diameter.nominal_mm + 2.0 * bevel, depth = 0.5 * wide;
  if (depth >= shape.depth_mm) return std::nullopt;
  if (const double most = spot.tool.diameter_max_mm; most > 0.0 && most < wide) return std::nullopt;
  spot.tool.classes = {model::CutterClass::kSpotDrill};
  spot.tool.diameter_min_mm = wide;
  spot.tool.point_angle_rad = kBevelSpotRad;
  spot.tool.point_angle_most_rad = 0.0;
  spot.tool.reach_mm += depth - spot.depth_mm;
  spot.depth_mm = spot.tool.depth_of_cut_mm = depth;
  spot.tool.words = words_of(spot.tool);
  spot.why.text += (spot.why.text.empty() ? "" : "; ") + ("breaks the hole's edge by " + trimmed(bevel, 3)) +
                   " mm as well, [" + edge->why.id + "]";
  const auto gone = static_cast<std::size_t>(edge - chain.begin());
  chain.erase(edge);
  for (ProposedStep& s : chain) {
    for (std::size_t& after : s.after) after -= after >= gone ? 1 : 0;
  }
  return chain;
}

}  // namespace

void carbide_first(const model::FeatureShape& shape, const Context& context, model::Proposal& proposal) {
  std::vector<std::vector<ProposedStep>> chains;
  for (std::vector<ProposedStep>& chain : proposal.chains) {
    if (auto carbide = by_carbide(shape, context, chain)) chains.push_back(*std::move(carbide));
    if (auto bevelled = by_spot(shape, context, chain)) chains.push_back(*std::move(bevelled));
    chains.push_back(std::move(chain));
  }
  proposal.chains = std::move(chains);
}

}  // namespace capstan::rules
