#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace capstan::casebase {

/// Version of the record. What version 1 kept is read as `store/version_1.h` says.
inline constexpr int kCaseVersion = 2;

/// Where a number comes from, best first. A measured number was taken at the machine or on the part; an
/// entered one was stated by a person; a simulated one was computed by a planner.
enum class Origin : std::uint8_t { kMeasured, kEntered, kSimulated };
/// Whether the workingstep met its requirements.
enum class Verdict : std::uint8_t { kUnknown, kGood, kBad };
enum class Coolant : std::uint8_t { kUnknown, kDry, kMist, kFlood, kThrough };

/// The words of files and texts: "measured", "good", "flood".
[[nodiscard]] std::string_view to_text(Origin o);
[[nodiscard]] std::string_view to_text(Verdict v);
[[nodiscard]] std::string_view to_text(Coolant c);
[[nodiscard]] std::optional<Origin> origin_of(std::string_view word);
[[nodiscard]] std::optional<Verdict> verdict_of(std::string_view word);
[[nodiscard]] std::optional<Coolant> coolant_of(std::string_view word);

/// The question, key of a search. The four categories must be equal; the numbers are near or far by
/// their logarithms (key/normalisation.h).
///
/// Units   as the names say. Zero, or kUnknown: the size does not apply, or is not known. If one question has
///         a diameter, a depth or a width and the other has none, they never match; no tolerance counts as
///         one of 1 mm. Any other number that the question does not state is not asked for; one that the
///         question states and the case does not know adds a fixed distance.
/// Shape   categories are keywords: 1 to 80 of letters, digits and `_ . / + -`.
struct Question {
  std::string operation = {};       ///< keyword of the operation, e.g. "DRILLING"
  std::string material_group = {};  ///< ISO 513 letter and the material's id, e.g. "P/mild_steel"
  std::string tool_class = {};      ///< substrate and class, e.g. "carbide/endmill"
  std::string machine_class = {};   ///< the machine's id, as the machine file names it
  std::string feature = {};  ///< kind of feature, e.g. "ROUND_HOLE"; kept, no part of the key; may be empty
  double diameter_mm = 0.0, depth_mm = 0.0, width_mm = 0.0;  ///< of the feature
  double tolerance_mm = 0.0;                                 ///< width of the tolerance zone
  double asked_ra_um = 0.0;                                  ///< roughness asked for
  double cutter_diameter_mm = 0.0;                           ///< the cutting diameter (ISO 13399: DC)
  int teeth = 0;
  double stick_out_mm = 0.0;  ///< from the holder's face to the tip (ISO 13399: LPR)
  double hardness_hb = 0.0;   ///< Brinell
  double hardness_hrc = 0.0;  ///< Rockwell C; asked for where Brinell is not known
  Coolant coolant = Coolant::kUnknown;
  bool operator==(const Question&) const = default;
};

/// One number with its origin.
struct Figure {
  double value = 0.0;
  double std_dev = 0.0;  ///< of the value, in its unit; 0: not known
  Origin origin = Origin::kMeasured;
  bool operator==(const Figure&) const = default;
};

/// What was bound: the cut as the program commanded it. Zero or empty: not known, but vc and fz.
struct Bound {
  double vc_m_min = 0.0, fz_mm = 0.0;
  double ap_mm = 0.0, ae_mm = 0.0;  ///< as cut
  double allowance_side_mm = 0.0, allowance_bottom_mm = 0.0;
  double corner_radius_mm = 0.0;
  /// The size that the path aims at less the nominal one: the middle of the zone. Nothing: nobody knows, as
  /// of a path that the file gave.
  std::optional<Figure> aimed_over_mm = {};
  std::string strategy = {};  ///< keyword, e.g. "contour_parallel"; may be empty
  // The path: of its cutting moves.
  double path_length_mm = 0.0;
  int path_blocks = 0;
  double mean_block_mm = 0.0;
  double arc_share = 0.0;  ///< of the length, in [0, 1]
  // The cross-section parameters along the path.
  double mean_area_mm2 = 0.0, peak_area_mm2 = 0.0;  ///< of the chip
  double mean_chip_mm = 0.0;                        ///< hm, mean thickness of the chip
  double mean_contact_rad = 0.0;                    ///< arc of contact
  bool operator==(const Bound&) const = default;
};

/// What the planner expected of this step. It is no evidence: it is kept to be held against `Observed`.
/// Zero: not known.
struct Predicted {
  double time_s = 0.0, peak_force_n = 0.0, torque_nm = 0.0, power_w = 0.0;
  double deflection_mm = 0.0, tool_life_min = 0.0;
  /// What the forces were computed with: the factor of the plan's margin in them, and, of a mill, the
  /// specific force of the plan's law at the mean chip of `Bound` (model/plan/resources/specific_force.h).
  /// Without them nobody can tell what an observed force says of the law.
  double force_margin = 0.0, specific_force_n_mm2 = 0.0;
  /// Feed per tooth that the plan's schedule holds longest, found as of a log (record/held.h): the forces are
  /// of the schedule, `Bound::fz_mm` is what it began from.
  double held_fz_mm = 0.0;
  bool operator==(const Predicted&) const = default;
};

/// A value that changes over the cutting time of the edge.
struct Sample {
  double t_s = 0.0;  ///< cutting time since the edge was new, or since the step began
  double value = 0.0;
  bool operator==(const Sample&) const = default;
};
struct Series {
  std::vector<Sample> samples;  ///< by rising time; at most kMaxSamples
  Origin origin = Origin::kMeasured;
  bool operator==(const Series&) const = default;
};
inline constexpr std::size_t kMaxSamples = 4096;

/// What came of it. Nothing: not observed.
struct Observed {
  std::optional<Figure> time_s = {};                ///< executed, of the workingstep
  std::optional<Figure> spindle_load_percent = {};  ///< of rated load, peak
  std::optional<Figure> peak_force_n = {}, torque_nm = {}, power_w = {};
  std::optional<Figure> size_deviation_mm = {};  ///< actual size - asked size: a bore that is too wide is > 0
  std::optional<Figure> depth_deviation_mm = {};     ///< the same of a depth: one that is too deep is > 0
  std::optional<Figure> position_deviation_mm = {};  ///< distance of the actual place from the asked one
  std::optional<Figure> lag_mm = {};                 ///< largest following error
  std::optional<Figure> surface_ra_um = {};
  std::optional<Figure> wear_mm = {};   ///< flank wear (VB) at the end
  std::optional<Figure> chatter = {};   ///< 0 none, 1 heavy
  std::optional<Figure> breakage = {};  ///< 0 or 1: the tool broke
  /// Feed per tooth and cutting speed as they were executed, override and control included, those held
  /// longest: what forces and wear are of. `Bound` has the ones that were planned.
  std::optional<Figure> executed_fz_mm = {}, executed_vc_m_min = {};
  Series wear_series_mm;                ///< flank wear over cutting time
  Series load_series_percent;           ///< spindle load over cutting time
  Verdict verdict = Verdict::kUnknown;  ///< as recorded; a later judgement supersedes it (`CaseBase::judge`)
  bool operator==(const Observed&) const = default;
};

/// Where the case is from. Empty: not known.
struct From {
  std::string machine = {};        ///< serial or inventory number of the very machine
  std::string tool_instance = {};  ///< serial number of the very tool
  std::string tool_edge =
      {};                     ///< edge or regrind of it: wear of one edge says nothing about another's spread
  std::string time_utc = {};  ///< end of the step, ISO 8601, "2016-06-28T17:32:31Z"
  std::string plan_hash = {};    ///< `plan_hash_of` of the plan that it was cut by
  std::string workingstep = {};  ///< its persistent id in that plan
  std::string part = {};         ///< number of the part: repeats of a run differ here
  std::string source = {};       ///< who, which file; never empty
  bool operator==(const From&) const = default;
};

/// One executed or simulated workingstep.
struct Case {
  std::string id;  ///< given by `id_of`; a value set before adding is ignored
  /// What the case as a whole is: measured, if it was cut and recorded; simulated, if it never was cut.
  /// Single figures may be of another origin (a force that was computed, of a cut that was timed).
  Origin origin = Origin::kEntered;
  Question asked;
  Bound bound;
  Predicted predicted;
  Observed observed;
  From from;
  bool operator==(const Case&) const = default;
};

/// Who said something of a case that is stored, when (ISO 8601, UTC) and why.
struct Remark {
  std::string by = {}, time_utc = {}, reason = {};
  bool operator==(const Remark&) const = default;
};

/// 32 hexadecimal digits of a SHA-256 (FIPS 180-4). Of a measured or entered case: of all but id and verdict,
/// so that a cut has one id whatever is said of it. Of a simulated one that names its plan: of the plan's
/// hash, the workingstep and the question alone: one simulation is one case whatever file it came from.
[[nodiscard]] std::string id_of(const Case& c);

/// Whether a time ("2016-06-28T17:32:31Z") begins with a day of the calendar. A case that is entered has such a
/// one; earlier versions kept others.
[[nodiscard]] bool is_of_calendar(std::string_view time_utc);

/// Why a case cannot be one (a number that is not finite, beyond what any machine does, an unknown word);
/// nothing when it can. Asked before writing and again after reading. The limits: record/fields.h.
[[nodiscard]] std::optional<std::string> fault_of(const Case& c);
[[nodiscard]] std::optional<std::string> fault_of(const Question& q);
[[nodiscard]] std::optional<std::string> fault_of(const Remark& r);

}  // namespace capstan::casebase
