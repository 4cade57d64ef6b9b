#pragma once

#include <optional>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/resources/machine.h"
#include "planner/physics/mechanics/loads/section.h"

/// Depths without chatter: lobes from modes of the tool point, else a limit on slenderness.
namespace capstan::mechanics {

/// Input of the stability lobes: cutter, arc of contact and force coefficients.
struct ChatterCut {
  ImmersionArc arc = {};
  int teeth = 0;
  double ktc_n_mm2 = 0.0;  ///< the largest that it may be: margins are the caller's
  double krc_n_mm2 = 0.0;
  /// Direction of the feed from the machine's +x, counter-clockwise seen from above; not given: the worst.
  std::optional<double> feed_direction_rad = {};
};

/// The limiting depth over spindle speed of one cut, zero order: the directional coefficients' mean over a
/// turn,
///
///     a (1 - exp(-i w T)) = 2 pi / (N Kt e(w)),     e: eigenvalues of A0 G(i w)
///
/// for each chatter frequency w the depth a that is real and the speeds at which w T = theta + 2 k pi.
///
/// Range     straight or helical teeth, immersion so large that the mean speaks for the cut. Against a
///           simulation in time (stability_test.cpp) the depth is within 10 % where more than one tooth is in
///           the cut, up to 1.64 times too large in down milling with one: kSingleToothMargin. For thin cuts
///           it misses the lobes of period doubling. Process damping (low speeds) is left out: the limit is
///           then too low, on the safe side.
/// Uncertainty  depth in the ratio of Kt; speeds as the frequencies (a few per cent between tap test and
///           turning spindle): limit_mm takes the least over kSpeedBand.
/// Source    Altintas & Budak 1995, "Analytical prediction of stability lobes in milling", CIRP Annals 44(1).
class StabilityLobes {
 public:
  /// Relative band of speed over which the least limit counts. Default, unsourced.
  static constexpr double kSpeedBand = 0.02;

  /// A direction without modes takes those of the other.
  /// Fails     MECH-MODES: no modes, or a value out of range; MECH-DOMAIN for the cut.
  [[nodiscard]] static Result<StabilityLobes> make(const std::vector<model::ToolPointMode>& modes,
                                                   const ChatterCut& cut);

  /// Depth below which the cut is stable at this speed, mm; infinity when nothing limits it.
  [[nodiscard]] double limit_mm(double n_rpm, double speed_band = kSpeedBand) const;

  /// Depth that is stable at every speed.
  [[nodiscard]] double absolute_limit_mm() const { return absolute_mm_; }

 private:
  struct Point {
    double frequency_hz = 0.0;
    double depth_mm = 0.0;  ///< negative: no limit here
    double phase = 0.0;     ///< theta / (2 pi), 0 .. 1
  };
  [[nodiscard]] double at(double n_rpm) const;
  std::vector<std::vector<Point>> branches_;
  int teeth_ = 0;
  double absolute_mm_ = 0.0;
};

/// Factor on the lobes' depth where fewer than kSafeTeeth are in the cut on average.
/// Source    1 / 1.64, the largest excess found in our own simulations in time; kSafeTeeth: there, six teeth
///           at half immersion (1.5) agree.
inline constexpr double kSingleToothMargin = 0.6;
inline constexpr double kSafeTeeth = 1.5;

/// The modes of a cutter: those that name it, else those that name no cutter.
[[nodiscard]] std::vector<model::ToolPointMode> modes_for(const model::Machine& machine,
                                                          const std::string& cutter_id);

/// Ratio of stick-out to diameter from which chatter is likely; up to it a slot may be as deep as
/// model::kDeepestSlotRatio says.
/// Source    "a stickout-to-diameter ratio above about 4:1 is where deflection and chatter risk start
///           climbing quickly": formulafactory.tools, tool deflection calculator.
inline constexpr double kSlenderRatio = 4.0;

/// Deflection of the tip above which end mills are likely to chatter, leave a poor surface and wear early.
/// Source    "Deflection of .001 inch or less is recommended for end milling operations": Ingersoll Cutting
///           Tools, rigidity analysis (generalcuttingtool.com).
inline constexpr double kQuietDeflectionMm = 0.0254;

/// The depth that is taken without modal data: model::kDeepestSlotRatio D up to kSlenderRatio, then falling
/// with the cube of the slenderness, as the stiffness of the stick-out does (a limiting depth is proportional
/// to it).
///
/// Needs     positive values; else 0.
/// Uncertainty  a rule of thumb: machines differ by a factor of two and more.
/// Source    these constants; the cube: F L^3 / (3 E I), derived.
[[nodiscard]] double slender_depth_mm(double diameter_mm, double stick_out_mm);

}  // namespace capstan::mechanics
