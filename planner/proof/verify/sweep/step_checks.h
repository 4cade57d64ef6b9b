#pragma once

#include <memory>
#include <string>

#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"
#include "planner/proof/verify/sweep/grid/closer_look.h"
#include "planner/proof/verify/sweep/grid/grid.h"
#include "planner/proof/verify/sweep/target/target.h"
#include "planner/proof/verify/sweep/tool_body.h"

namespace capstan::verify {

/// Largest feed per tooth, or per revolution for tools that work along their axis, mm, with where it is from.
struct FeedLimit {
  double mm = 0.0;
  bool per_revolution = false;
  std::string source;
};

/// Cells over a cutter's diameter that show what it meets: default, unsourced. On a piece that is too large
/// for so many, cells are wider.
inline constexpr double kCellsPerCutter = 8.0;

/// "(12.5, 3)", mm.
[[nodiscard]] std::string here(geometry::Vec2 p);

/// The checks of one step's moves while they cut. What they ask of the plan is listed in the key of known
/// steps (known/known_steps.cpp).
class StepChecks {
 public:
  StepChecks(const model::Plan& plan, const StepMoves& step, Grid& grid, Target& target, EarlierCuts& earlier,
             Findings& findings);
  void run();
  /// Whether it cut anything: known after `run`.
  [[nodiscard]] bool cuts() const { return cut_mm3_ > 0.0 || met_; }
  /// After `run`: the speed at which an edge in the cut for a quarter turn would wear as the step's edges do,
  /// and no less than that of its wide cuts, over their fastest; 1 where arcs of contact do not count (what
  /// is no roughing with carbide, a material whose speed no heat bounds).
  [[nodiscard]] double speed_share() const;
  /// After `run`: a step that cuts nothing is a finding, unless it finishes what `begun` says was cut before
  /// and follows its surface.
  void nothing(bool begun);

 private:
  void rapid(const Move& m);
  /// A rapid that the cells show as free, where they are coarse for the cutter.
  void closer(const Move& m);
  /// Where the tip is after a move.
  void follow(const Move& m);
  void feed(const Move& m);
  void gouge(const Move& m, const Bite& bite);
  void neck(const Move& m, const Grid& grid);
  void ring_up(const Move& m);
  void head(const Move& m);
  [[nodiscard]] bool follows_finished();
  [[nodiscard]] bool neck_in_core() const;
  void contact(const Move& m, const Bite& bite);
  void reach(const Move& m);
  void body(const Move& m);
  void entry(const Move& m, const Bite& bite);
  void chosen_ramp(const Move& m, double angle_rad);
  void spindle(const Move& m, const Bite& bite);
  void account(const Move& m, const Bite& bite);
  void settle();
  void heat(bool measured);
  void power(double volume, double minutes, double chip_mm);
  [[nodiscard]] double feed_per_tooth(const Move& m) const;
  void chips(const Move& m, const Bite& bite, double fz);
  /// The largest that is no finding.
  [[nodiscard]] double thickest_chip() const;
  void chip(const Move& m, double thickest_mm, double fz, geometry::Vec2 where);
  void rubbing();
  void axial_feed(double fz);
  void deflection(double torque_nm);
  struct Account;
  [[nodiscard]] double chip_of(const Account& a) const;
  [[nodiscard]] double arc_of(const Account& a) const;
  [[nodiscard]] double specific_force(double chip_mm) const;
  [[nodiscard]] double mean_force(const Account& a) const;
  void planned_section();
  [[nodiscard]] double override_most() const;
  void tapping(const Move& m);
  [[nodiscard]] bool hole_tool() const;
  [[nodiscard]] bool in_hole(const Move& m) const;
  [[nodiscard]] Findings::Where at(const Move& m) const { return {step_.order + 1, step_.id, m.where}; }

  const model::Plan& plan_;
  const StepMoves& step_;
  const model::Cutter& cutter_;
  Grid& grid_;
  Target& target_;
  EarlierCuts& earlier_;
  Findings& out_;
  std::shared_ptr<const CutterOutline> outline_;
  std::vector<BodyPart> body_;  ///< shank and holder, thicker than what cuts below them
  double radius_, tip_mm_;
  FeedLimit feed_limit_;
  double least_chip_mm_;
  double lowest_here_ = 1e300;  ///< of the tip since it came to its place across
  int rapid_looks_ = 400;       ///< closer looks at rapids that are left for this step; default, unsourced
  int looks_ = 8;               ///< closer looks at chips that are left for this step; default, unsourced
  bool judge_gouge_ = true;
  double rubbed_mm_ = 0.0;     ///< way in material at feeds below the thinnest chip
  double rubbed_at_mm_ = 0.0;  ///< the lowest feed per tooth there
  Findings::Where rubbed_ = {};
  bool ramp_chosen_ = false;  ///< by planning: neither the path nor its angle is the file's
  /// Short moves down, one behind the other, that are judged together.
  struct {
    double drop_mm = 0.0, along_mm = 0.0;
  } descent_;
  double helix_turned_ = 0.0;  ///< rad, of a descending spiral so far
  geometry::Vec2 helix_centre_;
  double cut_mm3_ = 0.0;  ///< by the step so far
  bool met_ = false;      ///< a head that heights do not follow was in material
  std::size_t mark_;      ///< in `earlier_`, before the step
  /// The heights before the step, where its cutter is a ring of teeth on a neck: the groove that it makes
  /// takes no more from what is above than the neck does, but heights lose all of it. Null: it is no such
  /// cutter.
  std::unique_ptr<const Grid> before_;

  // Moves taken together until they are long enough to be measured on the grid.
  struct Account {
    double length_mm = 0.0, edge_mm = 0.0, volume_mm3 = 0.0, minutes = 0.0, depth_mm = 0.0;
    double feed_mm_min = 0.0, rpm = 0.0;
    bool axial = false;
    long where = -1;
  } sum_;
  bool feed_chosen_ = false;                                    ///< by planning
  bool arcs_count_ = false;                                     ///< a short arc of contact allows more speed
  double heated_min_ = 0.0, heated_ = 0.0, fastest_rpm_ = 0.0;  ///< minutes; times speed to 1 / n; 1/min
  double widest_rpm_ = 0.0;                                     ///< the fastest of cuts half as wide as it is
  Account left_;  ///< the same for a diameter's way: against what the step was planned to take
};

/// Adds what the step's moves cut to the earlier cuts, as `StepChecks::run` does.
void cut_before(EarlierCuts& earlier, const StepMoves& step);
/// Whether planning chose how steep the step goes down: it made the path, and the file asks for no angle.
[[nodiscard]] bool chose_ramp(const model::Plan& plan, const model::MachiningWorkingstep& ws);
/// Whether planning chose the step's feed, and neither a file nor the operator.
[[nodiscard]] bool chose_feed(const model::Plan& plan, const model::MachiningWorkingstep& ws);
/// Specific force of a worn edge at this chip, N/mm2.
[[nodiscard]] double worn_specific_force(const model::Plan& plan, const model::Cutter& cutter,
                                         double chip_mm);
[[nodiscard]] FeedLimit feed_limit(const model::Cutter& c, const model::WorkMaterial& material);
[[nodiscard]] bool works_along_axis(const model::Cutter& c);
/// Motor power and torque for continuous running at a speed, between the curve's points; power linear
/// where torque is not stated.
[[nodiscard]] model::SpindlePoint spindle_at(const model::Spindle& s, double rpm);

}  // namespace capstan::verify
