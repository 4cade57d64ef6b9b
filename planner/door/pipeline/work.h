#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/pipeline/tries.h"
#include "planner/ground/geometry/placement.h"
#include "planner/ground/geometry/region.h"
#include "planner/ground/vocabulary/operation.h"
#include "planner/model/features/requirements.h"
#include "planner/model/features/shape.h"
#include "planner/model/nouns/all.h"
#include "planner/model/plan/plan.h"
#include "planner/model/plan/proposal.h"

// What the stages hand to each other; only planner/door/pipeline/*.cpp include this.

namespace capstan::pipeline {

using model::AnyRef;
using model::Ref;

/// One clamping while it is planned.
struct SetupWork {
  Ref<model::Setup> setup;
  geometry::Placement workpiece;  ///< the workpiece's frame in the set-up's
  double security_z_mm = 0.0;
  geometry::Box3 stock;  ///< of the raw piece, set-up frame
  model::Workholding holding = {};
};

/// A measurement that a chain wants before one of its steps.
struct Probing {
  std::vector<model::ProposedStep> chain;  ///< whole
  std::size_t at = 0;                      ///< of the measuring step in it
  std::optional<model::Candidate> probe;   ///< unset: by hand
};

/// One workingstep while it is planned.
struct StepWork {
  Ref<model::Executable> step;
  AnyRef feature;    ///< unset for a rapid movement
  AnyRef operation;  ///< unset for a rapid movement
  std::size_t setup = 0;
  std::vector<model::FeatureShape> shapes;  ///< workpiece coordinates; more than one for patterns
  std::string no_shape;                     ///< why there are none
  model::Cutter cutter;
  bool proposed = false;                     ///< made by rules in this run
  Member member = {};                        ///< when proposed: what its chain is for,
  std::string chain = {};                    ///< which chain that is (Tries::key_of),
  std::size_t in_chain = 0;                  ///< and its place in it
  model::ProposedStep proposal;              ///< when proposed
  double start_in_chain_mm = 0.0;            ///< of its proposal, before the drill ahead of it was known
  std::vector<model::Candidate> candidates;  ///< when the cutter was selected in this run, best first
  std::vector<model::Rejected> rejected_tools;
  bool open_technology = false;  ///< feed or speed to be chosen
  bool keep_speed = false;       ///< of an open technology: the stated speed stays, the feed is chosen for it
  bool keep_feed = false;        ///< the other way round
  bool open_tool = false;
  std::vector<std::size_t> after;       ///< indices into Work::steps that must come before; chain order
  std::string unreadable = {};          ///< what its file states wrongly of it or its feature: not made
  std::optional<Probing> probing = {};  ///< measured right before this step, if it can be
};

/// A shape as it is drawn: its feature, and its number among those of a pattern or compound.
using Drawn = std::pair<AnyRef, int>;

struct Work {
  model::Plan plan;
  const Inputs& inputs;
  const Policy& policy;
  Job& job;
  Tries& tries;
  std::vector<SetupWork> setups;
  std::vector<StepWork> steps;  ///< in order of execution once sequenced
  std::vector<model::FeatureShape>
      faces;  ///< planar faces of the part: cut first, so that less stands above the rest
  std::vector<std::string> used_cutters;  ///< ids, each once: a further tool change is not asked for lightly
  std::vector<model::Cutter> recorded;    ///< what the plan said of its cutters when it was read
  mechanics::MarginPolicy margin = mechanics::kUsualMargin;  ///< of loads against their limits
  std::optional<model::GeneralTolerance> general = {};  ///< of what states none: the user's, else the file's
  std::map<AnyRef, model::Quality> qualities = {};      ///< by feature
  std::vector<model::Tie> ties = {};                    ///< features that a tolerance ties together
  std::vector<std::pair<Ref<model::Setup>, model::Workholding>> held =
      {};                                        ///< as the plan said when it was read
  std::vector<model::FeatureShape> shapes = {};  ///< of all features, workpiece coordinates
  std::set<std::pair<Drawn, Drawn>> twins = {};  ///< shapes that are one removal, drawn twice; both ways
  std::vector<model::FeatureShape> whole_shapes =
      {};  ///< of these each once: elements and bosses count with what holds them
  std::map<AnyRef, std::string> unreadable = {};  ///< features and steps whose file states something wrongly
  double earning_per_min = 0.0;                   ///< Objective::kProfit: what a minute earns above its cost
  std::vector<model::StepResult> recorded_steps = {};  ///< as the plan said when it was read,
  model::Machine recorded_machine = {};                ///< and for which machine
  model::WorkMaterial recorded_material = {};          ///< and material that was
  std::set<AnyRef> left_out = {};                      ///< steps that were proposed and cut nothing
  bool again = false;  ///< something failed and `tries` says what: the plan is to be made again
};

// The stages, in the order bind() runs them.
Status resolve_workpiece(Work& w);      ///< material and raw piece
Status list_given(Work& w);             ///< set-ups and workingsteps of the file, what is re-opened marked
Status take_requirements(Work& w);      ///< general tolerance, what is asked of each feature
Status propose_missing(Work& w);        ///< rules and tooling for features that have no bound operations
Status leave_what_rests(Work& w);       ///< what rests on features that are not planned is not planned either
Status select_open_tools(Work& w);      ///< cutters for given operations
Status order_steps(Work& w);            ///< set-ups, order, pockets
Status hold_workpieces(Work& w);        ///< fixtures and clamps of each set-up, where that is wanted
Status carry_tools(Work& w);            ///< which tool carries out a rapid movement
Status raise_security_planes(Work& w);  ///< above the material and every feature that is cut
Status make_paths(Work& w);             ///< depths, paths, sections, feeds, step by step
Status join_paths(Work& w);             ///< given paths are reached from the security plane, and left to it

/// The box of the finished part: what of the raw piece lies beyond it is nobody's. Workpiece coordinates.
[[nodiscard]] geometry::Box3 part_box(const Work& w);
/// The shapes of a feature in this raw piece: a hole right through reaches the underside.
[[nodiscard]] Result<std::vector<model::FeatureShape>> shapes_in_piece(const Work& w, AnyRef feature);
void report_outside(Work& w);  ///< features that the raw piece does not hold

// Shared pieces.

/// `after` cannot be cut rightly while `before` still stands.
struct RestsOn {
  AnyRef before, after;
};
/// By geometry, as the order of steps has it: what begins within or at the floor of a feature, a thread in
/// its hole, an edge, and what lies in a face; but a plain hole only needs its drill to be long enough to
/// start above the face. Both are features as workingsteps name them.
[[nodiscard]] std::vector<RestsOn> what_rests(const Work& w);
/// Those that rest on one of `roots`, directly or through others.
[[nodiscard]] std::set<AnyRef> resting_on(const std::vector<RestsOn>& all, const std::set<AnyRef>& roots);
/// Names, at each feature that is not planned, those that rest on it.
void name_what_rests(Work& w);

/// How much raw material stands above a feature when its steps begin, mm: faces are cut first.
[[nodiscard]] double stock_above(const Work& w, const model::FeatureShape& shape);
/// What stays beside and below a feature when all are made, mm; unset where there is nothing or it is not
/// known. Features of the same and of the opposite side are seen, and the raw piece; not those across.
struct Thickness {
  std::optional<double> wall_mm, floor_mm;
};
[[nodiscard]] Thickness thickness_beside(const Work& w, const model::FeatureShape& shape);
/// From a hole's axis to the nearest wall that stands above its mouth when what is around is cut, mm; unset:
/// none is near. Tools wider than the hole must pass there.
[[nodiscard]] std::optional<double> clear_beside(const Work& w, const model::FeatureShape& hole);
/// A face is left over its sides, but not where the part stands beside it above its floor: there its reach
/// ends. Walls are known once the requirements are taken; before, nothing is changed.
void stop_at_walls(const Work& w, model::FeatureShape& face);
/// A feature with open sides may be left through them, but only where the part has nothing in the way: what
/// stays beside it at its depth is the part's box less its own area and those of the features that are cut as
/// deep there.
[[nodiscard]] geometry::Region stays_beside(const Work& w, const model::FeatureShape& shape);
/// An area in the frame of another height, seen from above; turned over, its loops run the other way round.
[[nodiscard]] geometry::Region moved(const geometry::Region& r, const geometry::Placement& at);

/// What surrounds a feature, for the rules: thinnest wall and floor of its shapes.
[[nodiscard]] rules::Context context_of(const Work& w, AnyRef feature,
                                        const std::vector<model::FeatureShape>& shapes);
/// The cutters that may be used: the library, or what of it is loaded.
[[nodiscard]] std::vector<model::Cutter> usable(const Work& w);

/// Why a face cannot be cut as it is drawn: it crosses a boss that another feature leaves standing above the
/// face's floor. Empty when it can.
[[nodiscard]] std::string crosses_a_wall(const Work& w, const model::FeatureShape& face);

/// Why a feature cannot be cut from this raw piece: solid stands above its top, or its drill's point comes
/// out on the other side. Empty when it can.
[[nodiscard]] std::string not_in_piece(const Work& w, const model::FeatureShape& shape);
/// The radius that may stay in the inner corners of a step, an outside or a closed pocket that are drawn
/// sharp and state none; 0: it has none.
[[nodiscard]] double sharp_corner_of(const Work& w, const model::FeatureShape& shape);
/// Why a hole cannot be told from another feature's: it lies wholly within that, or differs from it at the
/// same place. Empty when it can.
[[nodiscard]] std::string lies_within_another(const Work& w, const model::FeatureShape& shape);
/// Whether two features' shapes are one removal, drawn twice; as they are drawn, however they are cut.
[[nodiscard]] bool same_removal(const Work& w, const model::FeatureShape& a, const model::FeatureShape& b);
/// Says which features are the same at the same place: they are made once.
void tell_twins(Work& w);
/// Says which radius stays where corners are drawn sharp and no radius is stated.
void tell_corners(Work& w);
/// A hole at an edge of the raw piece is milled, or not made: its chains that drill are rejected.
[[nodiscard]] model::Proposal without_drills_at_edges(const Work& w, const model::FeatureShape& hole,
                                                      const model::Proposal& p);

/// Whether two shapes ask for the same steps and cutters: members of a pattern.
[[nodiscard]] bool alike(const model::FeatureShape& a, const model::FeatureShape& b);
[[nodiscard]] Ref<model::Setup> add_setup(Work& w, const geometry::Placement& workpiece_in_setup);
/// The nouns of a proposed step, bound in the ledger; gives the new workingstep.
[[nodiscard]] Ref<model::MachiningWorkingstep> add_nouns(Work& w, const model::ProposedStep& step,
                                                         const model::Candidate& tool,
                                                         const model::FeatureShape& shape,
                                                         std::vector<model::Rejected> rejected_chains,
                                                         std::vector<model::Rejected> rejected_tools);
/// Puts what is to be measured before the steps that want it, once the order is known: a workpiece_probing
/// per touch, start and direction in workpiece coordinates, the distance expected from the start until the
/// ball touches (its radius taken off, and what later steps still take off).
///
/// Measured is the datum that the position refers to, where that is a hole, a pocket or an outside made
/// before in the same set-up, else the feature itself: of a hole, a pocket or an outside opposite walls in x
/// and in y, of a slot across, of a face its level. Where no start is known to be free and no wall known to
/// be there, nothing is proposed: a chain that leans on the measurement for its size is banned (by hand where
/// the probe's ball does not come); for a position PIP-PROBE says why.
void add_probings(Work& w);
/// The noun of a cutter, made once per plan.
[[nodiscard]] Ref<model::MachiningTool> tool_noun(Work& w, const model::Cutter& cutter);

}  // namespace capstan::pipeline
