#pragma once

#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/fields.h"

// The fields of a cutter. A new one is a member of Cutter and a row here: in a piece of the record of its
// own, behind the last one, and with a key in the own list or the reason why it has none.

namespace capstan::model {

/// The pieces of a cutter's record, in order.
enum CutterPart : std::size_t {
  kCutterNames,
  kCutterSizes,
  kCutterNumbers,
  kCutterFlags,
  kCutterHand,
  kCutterSetTo,
  kCutterLists,
  kCutterBody,
  kCutterHolderId,
  kCutterHolder,
  kCutterTableLine,
  kCutterRunout,
  kCutterParts
};
template <>
inline constexpr auto kRecordParts<Cutter> = [] {
  std::array<RecordPart, kCutterParts> out{};
  out[kCutterSizes] = {.opens = true, .closes = true};
  out[kCutterSetTo] = {.since = 2};
  out[kCutterLists] = {.since = 2};
  out[kCutterBody] = {.opens = true, .since = 3};
  out[kCutterHolderId] = {.closes = true, .since = 3};
  out[kCutterHolder] = {.since = 3};
  out[kCutterTableLine] = {.since = 4};
  out[kCutterRunout] = {.since = 5};
  return out;
}();
/// The version of the table; the tool store's follows it.
inline constexpr int kCutterFieldsVersion = kRecordParts<Cutter>.back().since;

template <>
inline constexpr auto kFields<CuttingPreset> = std::tuple{
    field("material_group", &CuttingPreset::material_group).record("material").repeated(),
    field("vc_m_min", &CuttingPreset::vc_m_min).record("cutting speed [m/min]"),
    field("fz_mm", &CuttingPreset::fz_mm, Unit::kLength).record("feed per tooth"),
    field("source", &CuttingPreset::source).record("source").repeated(),
};
template <>
inline constexpr auto kFields<HolderSegment> = std::tuple{
    field("height_mm", &HolderSegment::height_mm, Unit::kLength).record("height").own("height", 1),
    field("lower_diameter_mm", &HolderSegment::lower_diameter_mm, Unit::kLength)
        .record("lower diameter")
        .own("lower_diameter", 2),
    field("upper_diameter_mm", &HolderSegment::upper_diameter_mm, Unit::kLength)
        .record("upper diameter")
        .own("upper_diameter", 3),
};
template <>
inline constexpr auto kFields<SisterTool> = std::tuple{
    field("id", &SisterTool::id).record("id"),
    field("pocket", &SisterTool::pocket).record("pocket"),
    field("life_left_min", &SisterTool::life_left_min).record("life left [min]"),
};
template <>
inline constexpr auto kFields<ToolTableWord> = std::tuple{
    field("letter", &ToolTableWord::letter).record("letter"),
    field("value", &ToolTableWord::value).record("value"),
};
/// The words come last in the record.
template <>
inline constexpr auto kRecordParts<ToolTableLine> = std::array<RecordPart, 2>{};
template <>
inline constexpr auto kFields<ToolTableLine> = std::tuple{
    field("words", &ToolTableLine::words).record("word", 1),
    field("against_reference", &ToolTableLine::against_reference).record("against a reference"),
    field("untouched", &ToolTableLine::untouched).record("untouched"),
};

inline constexpr const char* kOfCatalogue = "the list is of a shop's tools, not of a catalogue's parts";

// clang-format off
template <>
inline constexpr auto kFields<Cutter> = std::tuple{
    field("id", &Cutter::id).record("id", kCutterNames).own("id", 1),
    field("description", &Cutter::description).record("description", kCutterNames).own("description", 2),
    field("cutter_class", &Cutter::cutter_class).record("class", kCutterNames).own("class", 3).load(),
    field("substrate", &Cutter::substrate).record("substrate", kCutterNames).own("substrate", 4).sourced().load(),
    field("cutting_diameter_mm", &Cutter::cutting_diameter_mm, Unit::kLength)
        .record("cutting diameter", kCutterSizes).own("cutting_diameter", 5).sourced().load(),
    field("corner_radius_mm", &Cutter::corner_radius_mm, Unit::kLength)
        .record("corner radius", kCutterSizes).own("corner_radius", 7).sourced().load(),
    field("point_angle_rad", &Cutter::point_angle_rad, Unit::kAngle)
        .record("point angle", kCutterSizes).own("point_angle_deg", 25).sourced().load(),
    field("tip_diameter_mm", &Cutter::tip_diameter_mm, Unit::kLength)
        .record("tip diameter", kCutterSizes).own("tip_diameter", 8).sourced(),
    field("maximum_depth_of_cut_mm", &Cutter::maximum_depth_of_cut_mm, Unit::kLength)
        .record("maximum depth of cut", kCutterSizes).own("maximum_depth_of_cut", 9).sourced().load(),
    field("usable_length_mm", &Cutter::usable_length_mm, Unit::kLength)
        .record("usable length", kCutterSizes).own("usable_length", 10).sourced().load(),
    field("stick_out_mm", &Cutter::stick_out_mm, Unit::kLength)
        .record("stick-out", kCutterSizes).own("stick_out", 11).sourced().load(),
    field("functional_length_mm", &Cutter::functional_length_mm, Unit::kLength)
        .record("functional length", kCutterSizes).own("functional_length", 12).sourced(),
    field("shank_diameter_mm", &Cutter::shank_diameter_mm, Unit::kLength)
        .record("shank diameter", kCutterSizes).own("shank_diameter", 14).sourced().load(),
    field("holder_diameter_mm", &Cutter::holder_diameter_mm, Unit::kLength)
        .record("holder diameter", kCutterSizes).own("holder_diameter", 18).sourced(),
    field("teeth", &Cutter::teeth).record("teeth", kCutterNumbers).own("teeth", 34).sourced().load(),
    field("helix_rad", &Cutter::helix_rad, Unit::kAngle)
        .record("helix", kCutterSizes).own("helix_deg", 26).sourced().load(),
    field("lead_angle_rad", &Cutter::lead_angle_rad, Unit::kAngle)
        .record("lead angle", kCutterSizes).own("lead_angle_deg", 27).sourced().load(),
    field("thread_pitch_mm", &Cutter::thread_pitch_mm, Unit::kLength)
        .record("thread pitch", kCutterSizes).own("thread_pitch", 19).sourced().load(),
    field("centre_cutting", &Cutter::centre_cutting)
        .record("centre cutting", kCutterFlags).own("centre_cutting", 35).sourced(),
    field("maximum_ramp_angle_rad", &Cutter::maximum_ramp_angle_rad, Unit::kAngle)
        .record("maximum ramp angle", kCutterSizes).own("maximum_ramp_angle_deg", 29).sourced(),
    field("hand", &Cutter::hand).record("left hand", kCutterHand).own("hand", 37),
    field("coolant_through", &Cutter::coolant_through)
        .record("coolant through", kCutterFlags).own("coolant_through", 36),
    field("maximum_speed_rpm", &Cutter::maximum_speed_rpm, Unit::kRotSpeed)
        .record("maximum speed", kCutterSizes).own("maximum_speed_rpm", 30).sourced(),
    field("life_min", &Cutter::life_min).record("life [min]", kCutterSizes).own("life_min", 31).sourced(),
    field("price", &Cutter::price).record("price", kCutterSizes).own("price", 33).sourced(),
    field("fz_min_mm", &Cutter::fz_min_mm, Unit::kLength)
        .record("least feed per tooth", kCutterSizes).own("fz_min", 23).sourced(),
    field("fz_max_mm", &Cutter::fz_max_mm, Unit::kLength)
        .record("greatest feed per tooth", kCutterSizes).own("fz_max", 24).sourced(),
    field("presets", &Cutter::presets).record("preset", kCutterLists).own("presets", 46)
        .untold("start values; what came of them is compared step by step"),
    field("sources", &Cutter::sources).record("source", kCutterLists).repeated()
        .no_own("the list is the source of what it states, and says no more")
        .untold("where values are from changes none"),
    field("pocket", &Cutter::pocket).record("pocket", kCutterNumbers).own("pocket", 40),
    field("adjustable_to_mm", &Cutter::adjustable_to_mm, Unit::kLength)
        .record("adjustable to", kCutterSetTo).own("adjustable_to", 6).sourced(),
    field("overall_length_mm", &Cutter::overall_length_mm, Unit::kLength)
        .record("overall length", kCutterBody).own("overall_length", 13).sourced(),
    field("neck_diameter_mm", &Cutter::neck_diameter_mm, Unit::kLength)
        .record("neck diameter", kCutterBody).own("neck_diameter", 15).sourced().load(),
    field("neck_length_mm", &Cutter::neck_length_mm, Unit::kLength)
        .record("neck length", kCutterBody).own("neck_length", 16).sourced().load(),
    field("taper_angle_rad", &Cutter::taper_angle_rad, Unit::kAngle)
        .record("taper angle", kCutterBody).own("taper_angle_deg", 28).sourced().load(),
    field("cutting_width_mm", &Cutter::cutting_width_mm, Unit::kLength)
        .record("cutting width", kCutterBody).own("cutting_width", 17).sourced(),
    field("thread_size_mm", &Cutter::thread_size_mm, Unit::kLength)
        .record("thread size", kCutterBody).own("thread_size", 20).sourced(),
    field("thread_form", &Cutter::thread_form).record("thread form", kCutterBody).own("thread_form", 38),
    field("lead_threads", &Cutter::lead_threads)
        .record("threads of the chamfer", kCutterBody).own("lead_threads", 22).sourced(),
    field("lead_length_mm", &Cutter::lead_length_mm, Unit::kLength)
        .record("length of the chamfer", kCutterBody).own("lead_length", 21).sourced(),
    field("holder_id", &Cutter::holder_id).record("holder", kCutterHolderId).own("holder_id", 44),
    field("holder", &Cutter::holder).record("holder segment", kCutterHolder).own("holder", 45).load(),
    field("library_reference", &Cutter::library_reference)
        .record("library reference", kCutterBody).no_own(kOfCatalogue),
    field("library_source", &Cutter::library_source).record("library", kCutterBody).no_own(kOfCatalogue),
    field("product_id", &Cutter::product_id).record("product", kCutterBody).own("product_id", 39),
    field("carousel", &Cutter::carousel).record("carousel", kCutterBody).own("carousel", 42),
    field("stated_in_inches", &Cutter::stated_in_inches).record("stated in inches", kCutterBody)
        .no_own("the whole list has one unit, stated at its top"),
    field("loaded", &Cutter::loaded).record("loaded", kCutterBody).own("loaded", 41),
    field("in_stock", &Cutter::in_stock).record("in stock", kCutterBody).own("in_stock", 43),
    field("life_used_min", &Cutter::life_used_min)
        .record("life used [min]", kCutterBody).own("life_used_min", 32).sourced(),
    field("sisters", &Cutter::sisters).record("sister", kCutterHolder)
        .no_own("the list has one entry per kind of tool, and the machine knows its pieces"),
    field("runout_mm", &Cutter::runout_mm, Unit::kLength)
        .record("run-out", kCutterRunout).own("runout", 34).sourced().load(),
    field("table_line", &Cutter::table_line).record("tool table line", kCutterTableLine)
        .no_own("it is the machine's tool table that says it"),
};
// clang-format on

static_assert(has_row_per_member<Cutter>(), "a field of Cutter has no row in cutter_fields.h, or two");
static_assert(has_row_per_member<CuttingPreset>() && has_row_per_member<HolderSegment>() &&
                  has_row_per_member<SisterTool>() && has_row_per_member<ToolTableWord>() &&
                  has_row_per_member<ToolTableLine>(),
              "a field of what a cutter consists of has no row in cutter_fields.h, or two");

}  // namespace capstan::model
