#pragma once

#include <array>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/model/plan/order/cut_before.h"
#include "planner/model/plan/plan.h"
#include "planner/proof/verify/findings.h"
#include "planner/proof/verify/moves.h"

namespace capstan::verify {

struct PartShapes;
using model::CutBefore;

/// The moves of every step with a path whose numbers are finite; what is not becomes a finding (1).
[[nodiscard]] std::vector<StepMoves> moves_of(const model::Plan& plan, Findings& findings);
/// The same of its first steps only.
[[nodiscard]] std::vector<StepMoves> moves_of_first(const model::Plan& plan, std::size_t steps,
                                                    Findings& findings);

/// The moves of one step; nothing where it has no path, or one with columns that differ or numbers that are
/// not finite.
[[nodiscard]] std::optional<StepMoves> moves_of_step(const model::Plan& plan, const model::StepResult& step,
                                                     std::size_t order, const std::string& id);

/// Values of machine, tools, material, raw piece and steps against what they can be at all: 1.
void check_ranges(const model::Plan& plan, Findings& findings);

/// Facts that stand twice in a plan, against each other: 1.
void check_twice(const model::Plan& plan, Findings& findings);

/// Units, offsets, tools, changes, ends: 3, 4, 5, 6, 7, 32.
void check_tools(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings);

/// What tools are taken to be made of though nobody states it: carbide that is assumed is reported, 16.
void check_tool_materials(const model::Plan& plan, Findings& findings);

/// Limits that need no stock: 16, 18, 20, 22, 23, 24.
void check_limits(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings);
/// Speed, feed, arcs of one step; shared by plans and programs. `radius_gap_mm`: by how much the two radii of
/// an arc may differ.
void check_moves(const StepMoves& step, const model::Machine& machine, double radius_gap_mm,
                 Findings& findings);

/// How far the paths of each set-up reach, against the travel: 22. Where the work lies on the machine is not
/// known, so that only lengths are compared.
class Extents {
 public:
  explicit Extents(const model::Machine& machine) : machine_(machine) {}
  void add(const StepMoves& step, Findings& findings);

 private:
  const model::Machine& machine_;
  std::map<std::size_t, geometry::Box3> boxes_;
  std::map<std::size_t, std::array<bool, 3>> said_;
};

/// Coolant: what the operation asks for is on, and machine and tool can give it: 29.
void check_coolant(const model::Plan& plan, const std::vector<StepMoves>& steps, Findings& findings);
/// The time that each tool cuts against the life it and its sisters have left: 30. Tools without a stated
/// life are not judged.
void check_life(const std::vector<StepMoves>& steps, Findings& findings);
/// Cutters of the plan that take another one's place (Cutter::sisters names that one): loaded under a number
/// of their own, measured, and of the same sizes: 30.
void check_sisters(const model::Plan& plan, Findings& findings);

/// What follows from each step's own numbers, whoever chose them: cutting speed against the material's card
/// or the tool's own (16), the life of an edge at it against the step's time, edges that a tool takes in all
/// (30); bending that the plan states against the feature's tolerance (21). `speed_shares`: of each step's
/// speed, what its arcs of contact leave of it (check_removal).
void check_predicted(const model::Plan& plan, const PartShapes& part, const std::vector<StepMoves>& steps,
                     const std::vector<double>& speed_shares, Findings& findings);

/// What the plan or the part's file says that a machine must have (its_minimum_machine_params): 16, 17,
/// 18, 22; and what follows from its steps: diameters of tools (4), tapping (22), accuracy (22, a warning).
void check_machine(const model::Plan& plan, Findings& findings);

/// A tool against what the machine can take: its diameter (4) and its length (6).
struct ToolSize {
  std::string name;
  double length_mm = 0.0, diameter_mm = 0.0;  ///< 0: not known
};
void check_tool_size(const ToolSize& tool, const model::Machine& machine, const Findings::Where& at,
                     Findings& findings);

/// What holds the piece: gripping solids in one place (error), a clamp alone, a holding force below twice the
/// cutting force (warnings): 31. The force is that which the plan states for its milling steps; outlines that
/// are not convex are not compared.
void check_holding(const model::Plan& plan, Findings& findings);

/// What must come first: 28.
void check_order(const model::Plan& plan, const PartShapes& part, Findings& findings,
                 const CutBefore* before = nullptr);

/// Every feature planned, or said not to be: 34.
void check_coverage(const model::Plan& plan, Findings& findings, const CutBefore* before = nullptr);
/// The features of which steps are still to come (CutBefore).
[[nodiscard]] std::set<model::AnyRef> to_come(const model::Plan& plan, const CutBefore& before);

/// What thread mills cut against the thread that the file states: pitch of their profiles and of their
/// helix, and its hand: 11; how much of the thread they reach: 36.
void check_threads(const model::Plan& plan, const PartShapes& part, const std::vector<StepMoves>& steps,
                   Findings& findings);

/// Planned features within the raw piece; holes that a drill makes apart from others: 37.
void check_within(const model::Plan& plan, const PartShapes& part, Findings& findings);

/// Two radii of an arc differ by no more than coordinates rounded to three decimals explain:
/// each of start, end and centre by 0.0005 sqrt(2), derived.
inline constexpr double kRadiusGapMm = 0.0022;
/// Ends nearer than this become equal, or nearly, in a program: derived, the third decimal.
inline constexpr double kShortestChordMm = 0.001;

}  // namespace capstan::verify
