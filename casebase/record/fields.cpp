#include "casebase/record/fields.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string>

namespace capstan::casebase {
namespace {

// Limits against wrong units and altered records, not advice: wider than what any machine tool does. They are
// defaults, unsourced, unless a line says more.
constexpr double kSizeMax = 100000.0;
constexpr double kTimeMax = 1e6, kForceMax = 1e6, kRaMax = 1000.0, kDeviationMax = 100.0, kWearMax = 20.0;
constexpr double kTeethMax = 200.0, kToolMax = 2000.0, kPathMax = 1e9, kBlocksMax = 1e9;
constexpr double kHardestHb = 1200.0;  // sintered carbide is harder, but is not milled
constexpr double kHardestHrc = 72.0;   // the scale of ASTM E18 ends near 70
constexpr double kPi = 3.141592653589793;

template <auto Group, auto Member>
auto& at(Case& c) {
  return c.*Group.*Member;
}

template <auto Get, auto Parse>
WordAt word() {
  return {[](const Case& c) { return to_text(Get(const_cast<Case&>(c))); },
          [](Case& c, std::string_view text) {
            const auto v = Parse(text);
            if (v) Get(c) = *v;
            return v.has_value();
          }};
}
Origin& origin_in(Case& c) { return c.origin; }

using Q = Question;
using B = Bound;
using P = Predicted;
using O = Observed;
constexpr auto kAsked = &Case::asked;
constexpr auto kBound = &Case::bound;
constexpr auto kPredicted = &Case::predicted;
constexpr auto kObserved = &Case::observed;
constexpr auto kFrom = &Case::from;

constexpr std::size_t kQuestionFields = 16;

Field keyword(std::uint8_t tag, std::string_view name, TextAt place) {
  return {tag, name, "", place, 0, 0, TextKind::kKeyword, true};
}
Field text(std::uint8_t tag, std::string_view name, TextAt place, TextKind kind) {
  return {tag, name, "", place, 0, 0, kind, kind == TextKind::kSource};
}
Field needed(Field f) {
  f.needed = true;
  return f;
}

auto table() {
  return std::array{
      keyword(1, "operation", at<kAsked, &Q::operation>),
      keyword(2, "material_group", at<kAsked, &Q::material_group>),
      keyword(3, "tool_class", at<kAsked, &Q::tool_class>),
      keyword(4, "machine_class", at<kAsked, &Q::machine_class>),
      text(5, "feature", at<kAsked, &Q::feature>, TextKind::kMaybeKeyword),
      Field{6, "diameter_mm", "mm", NumberAt{at<kAsked, &Q::diameter_mm>}, 0.0, kSizeMax},
      Field{7, "depth_mm", "mm", NumberAt{at<kAsked, &Q::depth_mm>}, 0.0, kSizeMax},
      Field{8, "width_mm", "mm", NumberAt{at<kAsked, &Q::width_mm>}, 0.0, kSizeMax},
      Field{9, "tolerance_mm", "mm", NumberAt{at<kAsked, &Q::tolerance_mm>}, 0.0, 100.0},
      Field{10, "asked_ra_um", "um", NumberAt{at<kAsked, &Q::asked_ra_um>}, 0.0, kRaMax},
      Field{11, "cutter_diameter_mm", "mm", NumberAt{at<kAsked, &Q::cutter_diameter_mm>}, 0.0, kToolMax},
      Field{12, "teeth", "1", CountAt{at<kAsked, &Q::teeth>}, 0.0, kTeethMax},
      Field{13, "stick_out_mm", "mm", NumberAt{at<kAsked, &Q::stick_out_mm>}, 0.0, kToolMax},
      Field{14, "hardness_hb", "HB", NumberAt{at<kAsked, &Q::hardness_hb>}, 0.0, kHardestHb},
      Field{15, "hardness_hrc", "HRC", NumberAt{at<kAsked, &Q::hardness_hrc>}, 0.0, kHardestHrc},
      Field{16, "coolant", "", word<at<kAsked, &Q::coolant>, coolant_of>()},

      needed({20, "origin", "", word<origin_in, origin_of>()}),
      needed({21, "vc_m_min", "m/min", NumberAt{at<kBound, &B::vc_m_min>}, 0.01, 20000.0}),
      needed({22, "fz_mm", "mm", NumberAt{at<kBound, &B::fz_mm>}, 1e-5, 10.0}),
      Field{23, "ap_mm", "mm", NumberAt{at<kBound, &B::ap_mm>}, 0.0, 1000.0},
      Field{24, "ae_mm", "mm", NumberAt{at<kBound, &B::ae_mm>}, 0.0, kToolMax},
      Field{25, "allowance_side_mm", "mm", NumberAt{at<kBound, &B::allowance_side_mm>}, 0.0, 100.0},
      Field{26, "allowance_bottom_mm", "mm", NumberAt{at<kBound, &B::allowance_bottom_mm>}, 0.0, 100.0},
      Field{27, "corner_radius_mm", "mm", NumberAt{at<kBound, &B::corner_radius_mm>}, 0.0, 1000.0},
      text(28, "strategy", at<kBound, &B::strategy>, TextKind::kMaybeKeyword),
      Field{29, "path_length_mm", "mm", NumberAt{at<kBound, &B::path_length_mm>}, 0.0, kPathMax},
      Field{30, "path_blocks", "1", CountAt{at<kBound, &B::path_blocks>}, 0.0, kBlocksMax},
      Field{31, "mean_block_mm", "mm", NumberAt{at<kBound, &B::mean_block_mm>}, 0.0, kSizeMax},
      Field{32, "arc_share", "1", NumberAt{at<kBound, &B::arc_share>}, 0.0, 1.0},
      Field{33, "mean_area_mm2", "mm2", NumberAt{at<kBound, &B::mean_area_mm2>}, 0.0, 1e4},
      Field{34, "peak_area_mm2", "mm2", NumberAt{at<kBound, &B::peak_area_mm2>}, 0.0, 1e4},
      Field{35, "mean_chip_mm", "mm", NumberAt{at<kBound, &B::mean_chip_mm>}, 0.0, 10.0},
      Field{36, "mean_contact_rad", "rad", NumberAt{at<kBound, &B::mean_contact_rad>}, 0.0, 2.0 * kPi},
      Field{38, "aimed_over_mm", "mm", FigureAt{at<kBound, &B::aimed_over_mm>}, -100.0, 100.0},

      Field{50, "predicted_time_s", "s", NumberAt{at<kPredicted, &P::time_s>}, 0.0, kTimeMax},
      Field{51, "predicted_peak_force_n", "N", NumberAt{at<kPredicted, &P::peak_force_n>}, 0.0, kForceMax},
      Field{52, "predicted_torque_nm", "Nm", NumberAt{at<kPredicted, &P::torque_nm>}, 0.0, 1e5},
      Field{53, "predicted_power_w", "W", NumberAt{at<kPredicted, &P::power_w>}, 0.0, 1e6},
      Field{54, "predicted_deflection_mm", "mm", NumberAt{at<kPredicted, &P::deflection_mm>}, 0.0,
            kDeviationMax},
      Field{55, "predicted_tool_life_min", "min", NumberAt{at<kPredicted, &P::tool_life_min>}, 0.0, 1e12},
      Field{56, "predicted_force_margin", "1", NumberAt{at<kPredicted, &P::force_margin>}, 0.0, 100.0},
      Field{57, "predicted_specific_force_n_mm2", "N/mm2", NumberAt{at<kPredicted, &P::specific_force_n_mm2>},
            0.0, 1e6},
      Field{58, "predicted_held_fz_mm", "mm", NumberAt{at<kPredicted, &P::held_fz_mm>}, 0.0, 10.0},

      Field{70, "time_s", "s", FigureAt{at<kObserved, &O::time_s>}, 0.0, kTimeMax},
      Field{71, "spindle_load_percent", "%", FigureAt{at<kObserved, &O::spindle_load_percent>}, -1000.0,
            1000.0},
      Field{72, "peak_force_n", "N", FigureAt{at<kObserved, &O::peak_force_n>}, 0.0, kForceMax},
      Field{73, "torque_nm", "Nm", FigureAt{at<kObserved, &O::torque_nm>}, -1e5, 1e5},
      Field{74, "power_w", "W", FigureAt{at<kObserved, &O::power_w>}, -1e6, 1e6},
      Field{75, "size_deviation_mm", "mm", FigureAt{at<kObserved, &O::size_deviation_mm>}, -kDeviationMax,
            kDeviationMax},
      Field{76, "position_deviation_mm", "mm", FigureAt{at<kObserved, &O::position_deviation_mm>}, 0.0,
            kDeviationMax},
      Field{77, "lag_mm", "mm", FigureAt{at<kObserved, &O::lag_mm>}, 0.0, kDeviationMax},
      Field{78, "surface_ra_um", "um", FigureAt{at<kObserved, &O::surface_ra_um>}, 0.0, kRaMax},
      Field{79, "wear_mm", "mm", FigureAt{at<kObserved, &O::wear_mm>}, 0.0, kWearMax},
      Field{80, "chatter", "1", FigureAt{at<kObserved, &O::chatter>}, 0.0, 1.0},
      Field{81, "breakage", "1", FigureAt{at<kObserved, &O::breakage>}, 0.0, 1.0},
      Field{82, "executed_fz_mm", "mm", FigureAt{at<kObserved, &O::executed_fz_mm>}, 1e-5, 10.0},
      Field{83, "executed_vc_m_min", "m/min", FigureAt{at<kObserved, &O::executed_vc_m_min>}, 0.01, 20000.0},
      Field{84, "depth_deviation_mm", "mm", FigureAt{at<kObserved, &O::depth_deviation_mm>}, -kDeviationMax,
            kDeviationMax},
      Field{90, "wear_series_mm", "mm", SeriesAt{at<kObserved, &O::wear_series_mm>}, 0.0, kWearMax},
      Field{91, "load_series_percent", "%", SeriesAt{at<kObserved, &O::load_series_percent>}, -1000.0,
            1000.0},
      Field{99, "verdict", "", word<at<kObserved, &O::verdict>, verdict_of>()},

      text(100, "machine", at<kFrom, &From::machine>, TextKind::kText),
      text(101, "tool_instance", at<kFrom, &From::tool_instance>, TextKind::kText),
      text(102, "tool_edge", at<kFrom, &From::tool_edge>, TextKind::kText),
      text(103, "time_utc", at<kFrom, &From::time_utc>, TextKind::kTime),
      text(104, "plan_hash", at<kFrom, &From::plan_hash>, TextKind::kMaybeKeyword),
      text(105, "workingstep", at<kFrom, &From::workingstep>, TextKind::kText),
      text(106, "part", at<kFrom, &From::part>, TextKind::kText),
      text(107, "source", at<kFrom, &From::source>, TextKind::kSource),
  };
}

const auto& all() {
  static const auto kAll = table();
  return kAll;
}

}  // namespace

std::span<const Field> fields() { return all(); }
std::span<const Field> question_fields() { return fields().first(kQuestionFields); }

const Field& field_named(std::string_view name) {
  const auto& table = all();
  const auto at = std::find_if(table.begin(), table.end(), [&](const Field& f) { return f.name == name; });
  if (at == table.end()) throw std::logic_error("a case has no field " + std::string(name));
  return *at;
}

bool is_default(const Field& f, const Case& c) {
  if (const auto* t = std::get_if<TextAt>(&f.at)) return value(*t, c).empty();
  if (const auto* n = std::get_if<NumberAt>(&f.at)) return value(*n, c) == 0.0;
  if (const auto* n = std::get_if<CountAt>(&f.at)) return value(*n, c) == 0;
  if (const auto* g = std::get_if<FigureAt>(&f.at)) return !value(*g, c).has_value();
  if (const auto* s = std::get_if<SeriesAt>(&f.at)) return value(*s, c).samples.empty();
  return f.tag != 20 && std::get<WordAt>(f.at).get(c) == "unknown";  // the origin is always said
}

}  // namespace capstan::casebase
