#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/life/tool_life.h"

/// Tool life from the model's law, with its scatter, and what a minute of cutting costs in edges.
namespace capstan::mechanics {

/// Standard deviation of ln T where a law states none. Default, unsourced: half as much again as the 0.20
/// found for the wear to 0.3 mm in 15 cases of the NASA / UC Berkeley milling data (Agogino & Goebel 2007).
inline constexpr double kLifeScatter = 0.3;

/// The material's law for the cutter's substrate; else one of the textbook's exponent through the table's
/// speed and the cutter's stated life (kLifeAtTableMin when it states none), without influence of feed and
/// depth. Uncertainty  of the textbook law: a factor of two in life, and more away from the table's speed.
[[nodiscard]] model::ToolLifeLaw life_law(const model::WorkMaterial& material, const model::Cutter& cutter);

/// The median life in minutes of cutting (half of the edges live longer):
///
///     T = T0 (v / v0)^(-1/n) (h / h0)^(-1/p) (a / a0)^(-1/q)
///
/// Needs     positive values; else 0: an edge of which nothing is known lives no time.
/// Source    Taylor's law in its extended form, model::ToolLifeLaw.
[[nodiscard]] double median_life_min(const model::ToolLifeLaw& law, double v_m_min, double h_mm, double a_mm);

/// Scatter of the law; kLifeScatter where it states none.
[[nodiscard]] double scatter_of(const model::ToolLifeLaw& law);

/// The mean of a lognormal life: median exp(s^2 / 2).
[[nodiscard]] double mean_life_min(const model::ToolLifeLaw& law, double v_m_min, double h_mm, double a_mm);

/// The life that a share `confidence` of the edges reaches: median exp(-z s), z the normal quantile. A share
/// of 0.5 is the median; outside 0 .. 1: 0.
[[nodiscard]] double sure_life_min(const model::ToolLifeLaw& law, double confidence, double v_m_min,
                                   double h_mm, double a_mm);

/// z with P(x <= z) = share, for 0 < share < 1; within 1e-12.
[[nodiscard]] double normal_quantile(double share);

/// Cost of edges per minute of cutting: edge and the machine's time to change it, spread over its life;
/// infinite without a life.
[[nodiscard]] double edge_cost_per_min(const EdgeCost& cost, double life_min);

}  // namespace capstan::mechanics
