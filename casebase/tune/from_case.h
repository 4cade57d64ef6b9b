#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "casebase/record/case.h"
#include "casebase/record/failing.h"
#include "casebase/tune/advise.h"
#include "casebase/tune/corrections.h"

/// From the records of the case base to what tuning sees.
namespace capstan::casebase::tune {

/// Share of the life expected after which an edge is changed where nobody says when. Default, unsourced:
/// edges of one kind differ by 30 to 40 %, and few may be worn out before.
inline constexpr double kLifeUsed = 0.5;

/// The very edge that a case was cut with: tool instance and edge; empty: not known.
[[nodiscard]] std::string edge_of(const From& from);

/// The readings of a wear series over cutting time; none of a simulated one.
[[nodiscard]] std::vector<WearReading> readings_of(const Series& wear);

/// Days since 1970-01-01 of a date or a time in ISO 8601; nothing where it is none.
[[nodiscard]] std::optional<long> day_of(const std::string& time_utc);

/// A step as it is planned now, without cases: what cases are held against.
struct PlannedStep {
  Case step;  ///< its question, its bound speed and feed, what is expected of it: `case_of` of the plan
  double force_margin = 1.0;   ///< factor in its predicted loads, on those of a sharp edge (model::StepLoads)
  double force_spread = 1.5;   ///< factor of one standard deviation of its forces (mechanics::ForceMargin)
  double power_limit_w = 0.0;  ///< of the spindle at this speed; 0: not known
  double mc = 0.25;            ///< Kienzle's exponent
  double taylor_n = 0.25;
  /// Cutting time at the planned values after which an edge is changed, min: so many parts. 0: kLifeUsed of
  /// the life that is expected, and wear is watched only where a case tells it.
  double edge_min = 0.0;
  HardLimits hard;  ///< of the planner; empty: nothing is raised
};

/// Of a force the limit is the one that the plan was proved with, its margin included: no case lifts it.
/// Power against the spindle, size against half the tolerance, roughness against what is asked, wear when
/// the edge is changed against `kWornMm`; what is not asked or not known is not watched. Wear grows
/// with the time in the cut to the power of kWearByTime, and is kWornMm at the end of the life
/// expected.
[[nodiscard]] Handbook handbook_of(const PlannedStep& planned);

/// A case as evidence on a step.
///
/// Its speed is compared as it is, its feed per cutter diameter: makers' feeds go with the diameter. Its time
/// counts by the length of path, or where it is a case of this very step. Figures that were computed are no
/// evidence: only what was measured or entered. Its wear is carried by `wear_after` to the time at which this
/// step's edge is changed, after as many parts at the case's speed and feed. That takes readings since the
/// edge was new; a wear whose age is not known counts where it is beyond what is allowed already.
[[nodiscard]] Evidence evidence_of(const Case& c, const PlannedStep& planned);

/// Cases of which times and bores are heard, at most: reading one takes some 10 us. Default, unsourced.
inline constexpr std::size_t kMostHeard = 1000;

/// Whether the step mills a bore, whose size is the path's: of a drill, a reamer or a tap it is the tool's.
[[nodiscard]] bool mills_bore(const Question& question);
/// Whether it is the step that gives a milled bore its size: a finish, or one that leaves nothing on the
/// wall.
[[nodiscard]] bool finishes_bore(const Case& step);
/// Whether the tool broke or chattered heavily: what was observed is not what such a cut does.
[[nodiscard]] bool cut_short(const Observed& observed);
/// What measured cases observed of times, each part a group. Cuts that were judged bad are left out, and
/// those whose tool broke or chattered.
[[nodiscard]] std::vector<TimeSample> times_of(std::span<const Case> cases);
/// What they observed of milled bores, each part a group; without those whose tool broke or chattered. One
/// that was judged bad is heard: its size may be why.
[[nodiscard]] std::vector<BoreSample> bores_of(std::span<const Case> cases);
/// Whether bores by cutters of these diameters tell of each other: each size has a stiffness and a deviation
/// of its own. Regrinds are of one size, the next size is not.
[[nodiscard]] bool same_cutter(const Question& a, const Question& b);
/// Their diameters differ by no more. Default, unsourced.
inline constexpr double kSameDiameter = 0.01;
/// `bores_of`, by the diameter in mm of the smallest cutter of that size.
[[nodiscard]] std::map<double, std::vector<BoreSample>> bores_by_cutter(std::span<const Case> cases);

/// What the handbook says where cases correct it.
struct CorrectionHandbook {
  ForceHandbook force;
  /// Factor in the forces that planning predicted for the cases, on those of a sharp edge and mean
  /// coefficients: a case keeps what was predicted, not its margin.
  double force_margin = 1.0;
  model::ToolLifeLaw life;  ///< n and life 0: not known, no correction
};
/// The corrections that measured cases of one material and tool class make. A specific force is the
/// handbook's at the mean chip of the case, times the observed peak force over the predicted one without its
/// margin: which teeth are in the cut, and where, is then the model's in both.
/// `others`: cases of the tool class in other materials; lives of theirs help to tell the exponents of the
/// life.
[[nodiscard]] Corrections corrections_of(std::span<const Case> cases, const CorrectionHandbook& handbook,
                                         std::span<const Case> others = {});

}  // namespace capstan::casebase::tune
