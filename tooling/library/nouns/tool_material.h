#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/material.h"

namespace capstan::tooling {

/// What tells of which material a tool is whose file does not say it.
struct ToolMaterialHints {
  const model::WorkMaterial* material = nullptr;  ///< that it cuts; null: not known
  double vc_m_min = 0.0;                          ///< the fastest that the file gives for the tool; 0: none
  std::optional<model::Substrate> settled;        ///< somebody has settled it,
  std::string settled_by;                         ///< and this is the field's source
};

/// The material of a tool's edges, with the text for `Cutter::sources`.
struct ToolMaterial {
  model::Substrate substrate = model::Substrate::kHss;
  std::string source;
};

/// Chooses for a tool whose file states no tool material; class and diameter have to be set. What is settled
/// holds. Else it is what alone allows, by the card of the work material, the speed that the file gives; else
/// today's practice for the class and size. A speed that HSS allows keeps HSS: carbide in its place would be
/// run several times as fast, and a tool of HSS burns then. Nothing is taken for carbide only because HSS
/// does not cut the material.
[[nodiscard]] ToolMaterial likely_material(const model::Cutter& c, const ToolMaterialHints& hints);

/// Whether neither file nor list states what the cutter is made of: it is assumed, or the caller settled it.
[[nodiscard]] bool material_is_assumed(const model::Cutter& c);
/// The same, and the caller has not settled it.
[[nodiscard]] bool material_is_open(const model::Cutter& c);

/// The source of an assumed tool material: "default: not stated; carbide taken: " and the reason.
[[nodiscard]] std::string assumed_source(model::Substrate s, std::string_view why);
/// The source of one that the caller has settled by an option.
[[nodiscard]] std::string settled_source(std::string_view option);
/// The reason of such a source.
[[nodiscard]] std::string reason_of_source(std::string_view source);

}  // namespace capstan::tooling
