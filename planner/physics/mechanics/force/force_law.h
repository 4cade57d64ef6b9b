#pragma once

#include <string>

#include "planner/ground/vocabulary/noun_kind.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"
#include "planner/model/plan/resources/specific_force.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/loads/margin.h"
#include "planner/physics/mechanics/loads/section.h"

/// From the nouns of the model to the values of this room: which law of force holds for a material, how far
/// it may be wrong, and what of a cutter cuts.
namespace capstan::mechanics {

/// Factors by which the force of a real cut may exceed the computed one, by cause; margin.h says how they
/// combine.
struct ForceMargin {
  double spread = 1.0;                          ///< of the coefficients
  double wear = kWearForceFactor;               ///< of a worn edge against a sharp one
  double override_up = 1.0;                     ///< of the feed turned up
  double deviations = kUsualMargin.deviations;  ///< how many standard deviations of these together
  [[nodiscard]] double factor() const;
};

/// Input of a margin: how far the operator may turn up the feed, and the shop's caution.
struct MarginAsked {
  double feed_up = 1.0;
  double deviations = kUsualMargin.deviations;
};

using model::measured_set;

/// Whether the law of milling holds for a cut: all but drilling, reaming and tapping; a thread or a hole may
/// be milled.
[[nodiscard]] bool is_milled(model::TypeId operation, const model::Cutter& cutter);
/// Which coefficients gave the forces of a cut, with their source: the measured set that `force_law` takes,
/// or Kienzle's law.
[[nodiscard]] std::string force_source(const model::WorkMaterial& material, model::Substrate substrate,
                                       bool milled);

/// Kienzle's coefficients of a material as they hold for milling with this cutter: less by
/// model::kForcePerDegreeOfRake for each degree of its rake (model::kEndMillRakeDeg).
[[nodiscard]] WorkMaterial milled_with(const model::WorkMaterial& material, const model::Cutter& cutter);

/// What cuts say of a card's law of milling: forces are this factor of the card's at this thickness of the
/// chip, mm, and those of a further edge lie within a factor of `spread` (one standard deviation).
struct SetCorrection {
  double factor = 1.0, spread = 1.0, chip_mm = 0.0;
  std::string source;
};
/// The card's law of milling with that correction, as a measured set that goes before the card's own: its set
/// for the substrate times the factor; where it has none, Kienzle's law for a rake of 0 times the factor, as
/// the tangent at that chip (never below the law), with kRadialToTangentialRatio and kAxialToTangentialRatio.
[[nodiscard]] model::MechanisticSet corrected_set(const model::WorkMaterial& material,
                                                  model::Substrate substrate, const SetCorrection& by);

/// The measured set where there is one for the cutter's substrate, else Kienzle's law; uncertainty_factor is
/// the margin's spread. The Kienzle values (`milled_with`) are there either way.
[[nodiscard]] ForceLaw force_law(const model::WorkMaterial& material, const model::Cutter& cutter);

/// Spread: 1 + the set's own uncertainty, kForceUncertaintyFactor for a set that states none; with Kienzle's
/// law the larger of kForceUncertaintyFactor and 1 + kc_uncertainty. Wear: kWearForceFactor. Override: forces
/// grow with feed^(1 - mc) by Kienzle's law, with the feed at most by a measured set.
///
/// Source    constants.h; the uncertainties of the sets are in tooling/data/materials.yaml.
[[nodiscard]] ForceMargin force_margin(const model::WorkMaterial& material, model::Substrate substrate,
                                       const MarginAsked& asked = {});

/// The same for Kienzle's law alone: drilling, reaming, tapping, and callers that cannot use a measured set.
[[nodiscard]] ForceMargin kienzle_margin(const model::WorkMaterial& material, const MarginAsked& asked = {});

/// The cutting edge of a milling cutter: a ball's corner radius is half its diameter, 0 teeth count as one.
[[nodiscard]] Tooth tooth_of(const model::Cutter& cutter);

}  // namespace capstan::mechanics
