#pragma once

#include <array>
#include <tuple>

#include "planner/model/plan/cutter/cutter_fields.h"

namespace capstan::tooling {

/// The field of a cutter for a symbol of ISO 13399 or of our own.
struct SymbolRow {
  const char* symbol;
  double model::Cutter::*field;
  const char* name = "";
  const char* unit = "";

  /// Name and unit are those of the table of fields.
  constexpr SymbolRow(const char* of_symbol, double model::Cutter::*of_field)
      : symbol(of_symbol), field(of_field) {
    std::apply([this](const auto&... row) { (look_at(row), ...); }, model::kFields<model::Cutter>);
  }

 private:
  constexpr void look_at(const model::Field<model::Cutter, double>& row) {
    if (row.member != field) return;
    name = row.name;
    unit = row.unit == model::Unit::kLength ? "mm" : row.unit == model::Unit::kAngle ? "deg" : "";
  }
  template <class T>
  constexpr void look_at(const model::Field<model::Cutter, T>&) {}
};
/// The first symbol of a field that a record has is taken; the first is written.
inline constexpr std::array kCutterSymbols{
    SymbolRow{"DC", &model::Cutter::cutting_diameter_mm},
    SymbolRow{"DCX", &model::Cutter::adjustable_to_mm},
    SymbolRow{"RE", &model::Cutter::corner_radius_mm},
    SymbolRow{"SIG", &model::Cutter::point_angle_rad},
    SymbolRow{"DCN", &model::Cutter::tip_diameter_mm},
    SymbolRow{"APMX", &model::Cutter::maximum_depth_of_cut_mm},
    SymbolRow{"LCF", &model::Cutter::maximum_depth_of_cut_mm},
    SymbolRow{"LU", &model::Cutter::usable_length_mm},
    SymbolRow{"LPR", &model::Cutter::stick_out_mm},
    SymbolRow{"LF", &model::Cutter::functional_length_mm},
    SymbolRow{"DMM", &model::Cutter::shank_diameter_mm},
    SymbolRow{"DCONMS", &model::Cutter::shank_diameter_mm},
    SymbolRow{"FHA", &model::Cutter::helix_rad},
    SymbolRow{"PSIR", &model::Cutter::lead_angle_rad},
    SymbolRow{"TP", &model::Cutter::thread_pitch_mm},
    SymbolRow{"RMPX", &model::Cutter::maximum_ramp_angle_rad},
    SymbolRow{"RPMX", &model::Cutter::maximum_speed_rpm},
    SymbolRow{"FZMIN", &model::Cutter::fz_min_mm},
    SymbolRow{"FZMAX", &model::Cutter::fz_max_mm},
    SymbolRow{"OAL", &model::Cutter::overall_length_mm},
    SymbolRow{"DN", &model::Cutter::neck_diameter_mm},
    SymbolRow{"LN", &model::Cutter::neck_length_mm},
    SymbolRow{"TA", &model::Cutter::taper_angle_rad},
    SymbolRow{"CW", &model::Cutter::cutting_width_mm},
    SymbolRow{"TDZ", &model::Cutter::thread_size_mm},
    SymbolRow{"LEADLENGTH", &model::Cutter::lead_length_mm},
    SymbolRow{"LEADTHREADS", &model::Cutter::lead_threads},
    SymbolRow{"RUNOUT", &model::Cutter::runout_mm},
};

}  // namespace capstan::tooling
