#include "planner/model/plan/assumed_tool_material.h"

namespace capstan::model {
namespace {

constexpr std::string_view kOfTool = "material of tool ";
constexpr std::string_view kAssumed = "assumed: ";

}  // namespace

Provenance provenance_of(const AssumedToolMaterial& a) {
  return {std::string(kOfTool) + a.tool, std::string(to_text(a.substrate)),
          std::string(a.settled ? kSettledBy : kAssumed) + a.why};
}

std::optional<AssumedToolMaterial> assumed_tool_material(const Provenance& p) {
  if (!p.what.starts_with(kOfTool)) return std::nullopt;
  const auto substrate = substrate_from_text(p.value);
  const bool settled = p.source.starts_with(kSettledBy);
  if (!substrate || (!settled && !p.source.starts_with(kAssumed))) return std::nullopt;
  return AssumedToolMaterial{p.what.substr(kOfTool.size()), *substrate,
                             p.source.substr(settled ? kSettledBy.size() : kAssumed.size()), settled};
}

std::vector<AssumedToolMaterial> assumed_tool_materials(const Plan& plan) {
  std::vector<AssumedToolMaterial> out;
  for (const Provenance& p : plan.provenance) {
    if (auto a = assumed_tool_material(p)) out.push_back(*std::move(a));
  }
  return out;
}

std::optional<AssumedToolMaterial> assumed_material_of(const Plan& plan, std::string_view cutter) {
  for (const Provenance& p : plan.provenance) {
    if (auto a = assumed_tool_material(p); a && a->tool == cutter) return a;
  }
  return std::nullopt;
}

}  // namespace capstan::model
