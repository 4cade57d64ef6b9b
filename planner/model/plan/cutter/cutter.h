#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner/ground/base/shared_text.h"
#include "planner/ground/geometry/profile.h"
#include "planner/ground/vocabulary/cutter_class.h"
#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/enumerations.h"

namespace capstan::model {

struct MachiningTool;

/// Start values for one material group, from a catalogue or the shipped table.
struct CuttingPreset {
  SharedText material_group;  ///< ISO 513 letter (P, M, K, N, S, H) or a material's name
  double vc_m_min = 0.0;
  double fz_mm = 0.0;  ///< per tooth; drills, reamers: per revolution divided by teeth
  SharedText source;   ///< a sentence or two, which all sizes of a series say
  friend bool operator==(const CuttingPreset&, const CuttingPreset&) = default;
};

/// A frustum of a holder's outline; the first of a list begins at the holder's face, nearest to the tip.
struct HolderSegment {
  double height_mm = 0.0, lower_diameter_mm = 0.0, upper_diameter_mm = 0.0;
  friend bool operator==(const HolderSegment&, const HolderSegment&) = default;
};

/// A tool that may take another's place when its life is used up.
struct SisterTool {
  std::string id;  ///< of the instance
  int pocket = 0;  ///< 0: not loaded
  double life_left_min = 0.0;
  friend bool operator==(const SisterTool&, const SisterTool&) = default;
};

/// A word of the machine's tool table: "Z" and 115.0, "P" and 3. Lengths in mm, other numbers as written.
struct ToolTableWord {
  std::string letter;
  double value = 0.0;
  friend bool operator==(const ToolTableWord&, const ToolTableWord&) = default;
};
/// What the machine's tool table says of a tool. It is measured, so it comes out again as it went in.
struct ToolTableLine {
  std::vector<ToolTableWord> words;  ///< P, axes, D, I, J, Q; T is the cutter's pocket
  bool against_reference = false;  ///< its offsets count from a reference tool or gauge: they are no lengths
  bool untouched = false;          ///< several tools have this Z of 0, so that one of them is not measured
  friend bool operator==(const ToolTableLine&, const ToolTableLine&) = default;
};

/// A cutter in its holder: what is put into the spindle. mm, rad. Field names in words; ISO 13399 symbol
/// behind.
struct Cutter {
  std::string id;  ///< unique in its library
  std::string description;
  CutterClass cutter_class = CutterClass::kEndmill;
  Substrate substrate = Substrate::kCarbide;
  double cutting_diameter_mm = 0.0;  ///< DC
  double corner_radius_mm = 0.0;     ///< RE
  double point_angle_rad = 0.0;      ///< SIG, full angle; 0 when the tip is flat
  double tip_diameter_mm = 0.0;  ///< flat at the tip of countersinks, chamfer mills; pilot of centre drills
  double maximum_depth_of_cut_mm = 0.0;  ///< APMX, flute length for drills (LCF)
  double usable_length_mm = 0.0;         ///< LU, reach below the holder or a thicker neck
  double stick_out_mm = 0.0;             ///< LPR, from the holder's face to the tip
  double functional_length_mm = 0.0;     ///< LF, gage line to tip: the tool length offset
  double shank_diameter_mm = 0.0;        ///< DMM
  double holder_diameter_mm = 0.0;       ///< largest diameter of the holder near the tool; 0 unknown
  int teeth = 0;                         ///< ZEFF
  double helix_rad = 0.0;                ///< FHA
  double lead_angle_rad = 0.0;           ///< PSIR of face mills, 0: square shoulder
  double thread_pitch_mm = 0.0;          ///< TP
  bool centre_cutting = false;           ///< CCC
  double maximum_ramp_angle_rad = 0.0;   ///< 0: must not ramp
  Hand hand = Hand::kRight;              ///< HAND of cut
  bool coolant_through = false;
  double maximum_speed_rpm = 0.0;           ///< RPMX; 0 unknown
  double life_min = 0.0, price = 0.0;       ///< 0 unknown
  double fz_min_mm = 0.0, fz_max_mm = 0.0;  ///< chip thickness range the maker allows; 0 unknown
  std::vector<CuttingPreset> presets;
  std::vector<std::pair<std::string, std::string>>
      sources;                     ///< (field, "stated: ...", "derived: ...", "default: ...")
  int pocket = 0;                  ///< tool number in the machine; 0 not loaded
  double adjustable_to_mm = 0.0;   ///< DCX: the largest diameter a boring tool can be set to; 0: fixed
  double overall_length_mm = 0.0;  ///< OAL of the tool alone; 0 unknown
  double neck_diameter_mm = 0.0, neck_length_mm = 0.0;  ///< DN, LN from the tip; 0: no neck
  double taper_angle_rad = 0.0;                         ///< half angle of a conical flank; 0: upright
  double cutting_width_mm = 0.0;                        ///< CW of side mills, head height of T-slot cutters
  double thread_size_mm = 0.0;                          ///< TDZ, nominal major diameter; 0 unknown
  std::string thread_form;                              ///< THFT: "M", "UN", ...
  double lead_threads = 0.0;                            ///< taps: threads in the chamfer; 0 unknown
  double lead_length_mm = 0.0;                          ///< reamers: length of the chamfer; 0 unknown
  std::string holder_id;
  std::vector<HolderSegment> holder;  ///< from its face up; empty: only holder_diameter_mm is known
  std::string library_reference, library_source;  ///< ISO 13399 / PLIB link and where it is defined
  std::string product_id, carousel;
  bool stated_in_inches = false;  ///< the library gave its sizes in inches
  bool loaded = false;            ///< it is in the machine's magazine, in `pocket`
  int in_stock = -1;              ///< pieces; -1 unknown
  double life_used_min = 0.0;     ///< of `life_min`
  double runout_mm = 0.0;         ///< of the teeth in the spindle, radial, total indicated; 0 unknown
  std::vector<SisterTool> sisters;
  std::optional<ToolTableLine> table_line;  ///< of the machine's tool table; nothing: it has none
  bool operator==(const Cutter&) const = default;
};

/// The axisymmetric outline that cuts.
[[nodiscard]] geometry::CutterProfile profile_of(const Cutter& c);
/// The radius of its rounded end: of its corners, or of the ball that it ends in; 0: square. mm.
[[nodiscard]] double end_radius_mm(const Cutter& c);
/// How far its flank leans outwards from the axis, rad; 0: upright, as that of a face mill, whose lead angle is
/// another.
[[nodiscard]] double flank_lean_rad(const Cutter& c);
/// How deep the cutter may go beside a wall that it cuts: its usable length; beyond, where shank and holder
/// are no thicker than what cuts.
[[nodiscard]] double reach_of(const Cutter& c);
/// Height of the conical or rounded tip: how far the tip runs ahead of the full diameter, mm.
[[nodiscard]] double tip_length(const Cutter& c);

/// A word of its line in the machine's tool table.
[[nodiscard]] std::optional<double> table_word(const Cutter& c, std::string_view letter);
/// What G43 adds for the tool: the table's Z where a table says one, else its length. mm.
[[nodiscard]] double length_offset_mm(const Cutter& c);
/// Sets the tool's length to the table's, and its stick-out to at most that. An offset that counts from a
/// reference, or that no such tool can have as its length, changes no length.
void take_table_line(Cutter& c, const ToolTableLine& line);
/// Why the tool cannot run at the machine with what its tool table says of its length; empty: it can. A
/// length from the gage line is above zero and not shorter than the flutes; an offset from a reference is any
/// number, and 0 for the reference alone.
[[nodiscard]] std::string offset_fault(const Cutter& c);

}  // namespace capstan::model
