#pragma once

#include "planner/model/plan/fields.h"
#include "planner/model/plan/resources/material.h"

// The fields of a work material. A new one is a member and a row here, in a piece of the record of its own.

namespace capstan::model {

// clang-format off
template <>
inline constexpr auto kRecordParts<MechanisticSet> =
    std::array{RecordPart{}, RecordPart{.opens = true, .closes = true}, RecordPart{}};
template <>
inline constexpr auto kFields<MechanisticSet> = std::tuple{
    field("substrate", &MechanisticSet::substrate).record("substrate"),
    field("ktc_n_mm2", &MechanisticSet::ktc_n_mm2, Unit::kPressure).record("Ktc", 1),
    field("kte_n_mm", &MechanisticSet::kte_n_mm).record("Kte [N/mm]", 1),
    field("krc_n_mm2", &MechanisticSet::krc_n_mm2, Unit::kPressure).record("Krc", 1),
    field("kre_n_mm", &MechanisticSet::kre_n_mm).record("Kre [N/mm]", 1),
    field("kac_n_mm2", &MechanisticSet::kac_n_mm2, Unit::kPressure).record("Kac", 1),
    field("kae_n_mm", &MechanisticSet::kae_n_mm).record("Kae [N/mm]", 1),
    field("uncertainty", &MechanisticSet::uncertainty, Unit::kRatio).record("uncertainty", 1),
    field("source", &MechanisticSet::source).record("source", 2),
};
template <>
inline constexpr auto kRecordParts<ToolLifeLaw> =
    std::array{RecordPart{}, RecordPart{.opens = true, .closes = true}, RecordPart{}};
template <>
inline constexpr auto kFields<ToolLifeLaw> = std::tuple{
    field("substrate", &ToolLifeLaw::substrate).record("substrate"),
    field("v0_m_min", &ToolLifeLaw::v0_m_min).record("cutting speed [m/min]", 1),
    field("life_min", &ToolLifeLaw::life_min).record("life [min]", 1),
    field("h0_mm", &ToolLifeLaw::h0_mm, Unit::kLength).record("chip thickness", 1),
    field("a0_mm", &ToolLifeLaw::a0_mm, Unit::kLength).record("depth", 1),
    field("n", &ToolLifeLaw::n).record("n", 1),
    field("p", &ToolLifeLaw::p).record("p", 1),
    field("q", &ToolLifeLaw::q).record("q", 1),
    field("scatter", &ToolLifeLaw::scatter).record("scatter", 1),
    field("source", &ToolLifeLaw::source).record("source", 2),
};

/// The pieces of a material's record, in order.
enum MaterialPart : std::size_t {
  kMaterialNames, kMaterialSizes, kMaterialSources, kMaterialHardness, kMaterialLaws, kMaterialParts
};
template <>
inline constexpr auto kRecordParts<WorkMaterial> = [] {
  std::array<RecordPart, kMaterialParts> out{};
  out[kMaterialSizes] = {.opens = true, .closes = true};
  out[kMaterialSources] = {.since = 2};
  out[kMaterialHardness] = {.since = 3};
  out[kMaterialLaws] = {.since = 4};
  return out;
}();
template <>
inline constexpr auto kFields<WorkMaterial> = std::tuple{
    field("id", &WorkMaterial::id).record("id", kMaterialNames),
    field("iso_group", &WorkMaterial::iso_group).record("iso group", kMaterialNames),
    field("names", &WorkMaterial::names).record("name", kMaterialSources)
        .untold("what files call it changes nothing"),
    field("kc11_n_mm2", &WorkMaterial::kc11_n_mm2, Unit::kPressure).record("kc1.1", kMaterialSizes),
    field("mc", &WorkMaterial::mc, Unit::kRatio).record("mc", kMaterialSizes),
    field("vc_hss_m_min", &WorkMaterial::vc_hss_m_min).record("cutting speed of HSS [m/min]", kMaterialSizes),
    field("vc_carbide_m_min", &WorkMaterial::vc_carbide_m_min)
        .record("cutting speed of carbide [m/min]", kMaterialSizes),
    field("tensile_strength_n_mm2", &WorkMaterial::tensile_strength_n_mm2, Unit::kPressure)
        .record("tensile strength", kMaterialSizes),
    field("kc_uncertainty", &WorkMaterial::kc_uncertainty, Unit::kRatio)
        .record("uncertainty of kc", kMaterialSizes),
    field("hardness_hb", &WorkMaterial::hardness_hb).record("hardness [HB]", kMaterialHardness),
    field("mechanistic", &WorkMaterial::mechanistic).record("mechanistic set", kMaterialLaws),
    field("life", &WorkMaterial::life).record("life law", kMaterialLaws),
    field("sources", &WorkMaterial::sources).record("source", kMaterialSources)
        .untold("where values are from changes none"),
};
// clang-format on

static_assert(has_row_per_member<MechanisticSet>() && has_row_per_member<ToolLifeLaw>() &&
                  has_row_per_member<WorkMaterial>(),
              "a field of the material has no row in material_fields.h, or two");

}  // namespace capstan::model
