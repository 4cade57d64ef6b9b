#pragma once

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/making/draft/bans.h"
#include "planner/making/draft/draft.h"
#include "planner/making/optimise/solver/solver.h"
#include "planner/making/piece/piece.h"
#include "planner/model/plan/proposal.h"

// Which chain of a proposal is taken: the rules' order says what is good practice, the estimates of time what
// would be absurd.

namespace capstan::casebase {
class CaseBase;
}
namespace capstan::tooling {
class Selections;
}

namespace capstan::propose {

/// How few tools a plan is made with, where the magazine does not hold those that it would be made with best.
enum class Thrift {
  kNone,    ///< by time: a tool change is what it costs
  kShared,  ///< a tool that the plan uses already does whatever it can
  kChains,  ///< also of the chains the one that needs the fewest further tools
};

/// What a step may take longer, s, so that a plan has one tool less where the magazine is full; what rules
/// take off for a class that they like less included. Default, unsourced.
inline constexpr double kMostForFewerS = 1200.0;

/// How many shapes of a part ask for the same chain (piece::alike) and share its tools. They are counted once
/// for all, so that n equal features are not n walks over n shapes.
///
/// Refers to the shapes, which must stay as they are.
class AlikeShapes {
 public:
  /// Shapes that are like this one, itself counted, at least 1. Those that the file's steps make are not:
  /// they ask for no chain. `steps`: the file's before the proposed ones, the file's always the same or none.
  [[nodiscard]] int of(const piece::Piece& piece, const model::FeatureShape& shape,
                       const std::vector<draft::StepDraft>& steps);

 private:
  struct Form {
    const model::FeatureShape* first;
    int shapes;
  };
  using Sizes = std::array<double, 6>;  ///< some that are the same of all that are alike
  using Forms = std::map<Sizes, std::vector<Form>>;
  static Sizes sizes_of(const model::FeatureShape& shape);
  static Forms counted(const piece::Piece& piece, const std::vector<draft::StepDraft>& steps,
                       std::size_t of_file);
  std::map<std::size_t, Forms> known_;  ///< by the number of the file's steps
};

/// Criteria for chains and their cutters.
struct Choice {
  const piece::Piece& piece;
  const std::vector<model::Cutter>& usable;  ///< cutters that may be used
  const draft::Bans& bans;
  const optimise::Options& options;
  double margin_deviations = 0.0;             ///< of loads against their limits
  int batch = 1;                              ///< pieces
  const casebase::CaseBase* cases = nullptr;  ///< null: no precedents
  Thrift thrift = Thrift::kNone;
  const std::vector<model::Edit>* edits = nullptr;  ///< of the operator; null: none
  tooling::Selections* selections = nullptr;        ///< from `usable`; null: each question is answered anew
  std::shared_ptr<AlikeShapes> alike = std::make_shared<AlikeShapes>();  ///< of `piece`; copies share it
};

struct Chosen {
  const std::vector<model::ProposedStep>* chain = nullptr;  ///< null: no chain
  std::string key;                                          ///< draft::key_of
  std::vector<model::Selection> tools;                      ///< one per step
  double seconds = 0.0;              ///< cutting of this shape alone, and tool changes; estimated
  std::vector<std::string> further;  ///< cutters of it that were not in use
};

/// Whether one estimate is so much shorter than another that it is surely less, and worth a choice.
[[nodiscard]] bool decisively_quicker(double seconds, double than_seconds);

/// Chooses the first chain that was not tried in vain and finds a cutter for every step; another where all
/// shapes that are alike are made in surely less time by it, tool changes included: by the estimates that
/// also rank cutters, as far as planned times were measured to be off from them. Gives the reasons against
/// the others, with their estimated times. `steps` are those of the plan so far, as for AlikeShapes, `used`
/// the cutters in use.
[[nodiscard]] Chosen choose(const Choice& choice, const model::Proposal& p, const model::FeatureShape& shape,
                            const draft::Member& member, const std::vector<draft::StepDraft>& steps,
                            const std::vector<std::string>& used, std::vector<model::Rejected>& rejected,
                            Job& job);

/// A chain by its steps: "centre + drill + ream [hole.ream.it7]".
[[nodiscard]] std::string chain_text(const std::vector<model::ProposedStep>& chain,
                                     const model::FeatureShape& shape);

}  // namespace capstan::propose
