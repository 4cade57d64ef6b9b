#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

/// Tool life from the model's law, and its scatter.
namespace capstan::mechanics {

/// Standard deviation of ln T if a law states none. Default, unsourced: half as much again as the 0.20 found
/// for the wear to 0.3 mm in 15 cases of the NASA / UC Berkeley milling data (Agogino & Goebel 2007).
inline constexpr double kLifeScatter = 0.3;

/// One factor of Taylor's law: (x / x0)^(-1/exponent); 1 where the law knows no such influence, that is where
/// `exponent` or `x0` is not positive.
[[nodiscard]] double taylor_factor(double x, double x0, double exponent);

/// Taylor's exponent of cutting speed where no law is given: kTaylorExponentCarbide or kTaylorExponentHss.
[[nodiscard]] double taylor_exponent(model::Substrate substrate);

/// The median life in minutes of cutting (half of the edges live longer):
///
///     T = T0 (v / v0)^(-1/n) (h / h0)^(-1/p) (a / a0)^(-1/q)
///
/// Needs     positive values; else 0: an edge of which nothing is known lives no time.
/// Source    Taylor's law in its extended form, model::ToolLifeLaw.
[[nodiscard]] double median_life_min(const model::ToolLifeLaw& law, double v_m_min, double h_mm, double a_mm);

/// Scatter of the law; kLifeScatter if it states none.
[[nodiscard]] double scatter_of(const model::ToolLifeLaw& law);

}  // namespace capstan::mechanics
