#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "planner/model/plan/cutter/cutter.h"
#include "tooling/library/formats/format.h"
#include "tooling/library/formats/json.h"

/// @file The words of Fusion's tool libraries and ours. Source: libraries exported by Fusion 360; no
/// description of the format is published.

namespace capstan::tooling::fusion {

/// ToolLibrary::kept: id of a holder that is listed by itself, not only in tools.
inline constexpr const char* kListedKey = "fusion:listed";
/// ToolLibrary::kept: the records were read from Fusion, and what they keep is Fusion's.
inline constexpr const char* kReadKey = "fusion:read";

/// A number of "geometry" and its ISO 13399 symbol; if no symbol means the same, the key itself.
struct GeometryKey {
  std::string_view key, symbol;
  std::string_view unit;  ///< "L" the tool's unit, "deg", "" a count
};
inline constexpr std::array kGeometry{
    GeometryKey{"DC", "DC", "L"},
    GeometryKey{"DCX", "DCX", "L"},
    GeometryKey{"RE", "RE", "L"},
    GeometryKey{"LCF", "LCF", "L"},
    GeometryKey{"LB", "LPR", "L"},
    GeometryKey{"OAL", "OAL", "L"},
    GeometryKey{"SFDM", "DMM", "L"},
    GeometryKey{"NOF", "ZEFF", ""},
    GeometryKey{"NT", "NT", ""},
    GeometryKey{"SIG", "SIG", "deg"},
    GeometryKey{"TA", "TA", "deg"},
    GeometryKey{"TP", "TP", "L"},
    GeometryKey{"TPN", "TPN", "L"},
    GeometryKey{"TPX", "TPX", "L"},
    GeometryKey{"tip-diameter", "DCN", "L"},
    GeometryKey{"tip-length", "tip-length", "L"},
    GeometryKey{"tip-offset", "tip-offset", "L"},
    GeometryKey{"shoulder-length", "shoulder-length", "L"},
    GeometryKey{"shoulder-diameter", "shoulder-diameter", "L"},
    GeometryKey{"assemblyGaugeLength", "assemblyGaugeLength", "L"},
    GeometryKey{"axial-distance", "axial-distance", "L"},
    GeometryKey{"lower-radius", "lower-radius", "L"},
    GeometryKey{"upper-radius", "upper-radius", "L"},
    GeometryKey{"profile-radius", "profile-radius", "L"},
    GeometryKey{"thread-profile-angle", "thread-profile-angle", "deg"},
    GeometryKey{"CW", "CW", "L"},
    GeometryKey{"JET_HEAD_CLEARANCE", "JET_HEAD_CLEARANCE", "L"},
    GeometryKey{"JET_NOZZLE_DIAMETER", "JET_NOZZLE_DIAMETER", "L"},
};

/// A number of a preset.
struct PresetKey {
  std::string_view key;
  std::optional<double> Preset::*field;
  char unit;  ///< 'L' length, 'V' cutting speed (m/min or ft/min), 'D' degrees, '1'
};
inline constexpr std::array kPreset{
    PresetKey{"n", &Preset::rpm, '1'},
    PresetKey{"v_c", &Preset::vc_m_min, 'V'},
    PresetKey{"f_z", &Preset::fz_mm, 'L'},
    PresetKey{"f_n", &Preset::feed_per_revolution_mm, 'L'},
    PresetKey{"v_f", &Preset::feed_mm_min, 'L'},
    PresetKey{"v_f_plunge", &Preset::plunge_mm_min, 'L'},
    PresetKey{"v_f_ramp", &Preset::ramp_mm_min, 'L'},
    PresetKey{"ramp-angle", &Preset::ramp_angle_rad, 'D'},
    PresetKey{"stepdown", &Preset::stepdown_mm, 'L'},
    PresetKey{"stepover", &Preset::stepover_mm, 'L'},
};
/// Ours per theirs.
[[nodiscard]] double preset_factor(char unit, bool inches);

/// The class of a "type"; nothing for kinds that planning does not know.
[[nodiscard]] std::optional<model::CutterClass> class_of(std::string_view type);
/// The "type" of a class; nothing if Fusion has none.
[[nodiscard]] std::optional<std::string_view> type_of(model::CutterClass c, bool left_hand);
[[nodiscard]] bool is_type(std::string_view text);

[[nodiscard]] Result<Imported> read(std::string_view bytes, const std::string& file,
                                    const FormatOptions& options, Job& job);
[[nodiscard]] Result<Imported> read_tree(const Json& root, const std::string& file, Job& job);
/// Derives values that planning needs under another name from those that a Fusion library states: usable
/// length, neck, point angle of chamfer mills.
void derive(CatalogueItem& item, ToolAssembly& assembly, LossReport& report);
/// The document of a library.
[[nodiscard]] Result<Json> write_tree(const ToolLibrary& library, LossReport& report);

}  // namespace capstan::tooling::fusion
