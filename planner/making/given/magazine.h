#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::given {

/// A loaded tool that may not be called, and why: "is broken".
struct OutOfUse {
  model::Cutter tool;
  std::string why;
};

/// The source of a size that is less by the wear that a control tells.
inline constexpr const char* kLessWear = "stated: less the wear that the control tells";

/// What is open since the tools of a plan are held against those that are loaded.
struct Matched {
  /// The mill of an operation as it measures.
  struct Measured {
    model::AnyRef operation;
    model::Cutter mill;
    std::string why;
  };
  std::vector<std::string> why;          ///< one sentence each, in the order of the plan
  std::vector<model::DecisionKey> open;  ///< to be re-opened (Ledger::reopen), in that order
  std::vector<Measured> worn;            ///< mills of another diameter: only their paths are made anew
};

/// Holds the tools of a plan against what is in the magazine (of `library`, Cutter::pocket > 0).
///
/// A tool that is there (same class and diameter, or the same id) keeps its decisions and takes pocket and
/// length from the table; one that is not is to be re-opened, and with it, by the ledger, what depends on it.
/// A mill that measures otherwise under its number, by wear or a regrind, is neither: it is `worn`.
/// `library` then has the plan's tools as they are loaded, and the loaded ones that it does not name.
/// `of`: of these operations only.
/// `gone`: tools that `library` has not, for they may not be called; it says why one of them is re-opened.
/// Fails  LATE-TOOL for a tool of the plan that is loaded but has no length in the table
///        (model::offset_fault). Such a tool that the plan does not name is not used.
[[nodiscard]] Result<Matched> match_loaded(const model::Plan& plan, std::vector<model::Cutter>& library,
                                           Job& job, const std::set<model::AnyRef>* of = nullptr,
                                           const std::vector<OutOfUse>& gone = {});

/// The name of an operation's given tool, where none like it is loaded; nothing where one is, or the tool is
/// open.
[[nodiscard]] std::optional<std::string> missing_tool(const model::Plan& plan, model::AnyRef operation,
                                                      const std::vector<model::Cutter>& library);

/// The loaded cutter (Cutter::loaded, a pocket) that equals this one by class and every size that both state,
/// whatever its name. Of several: a measured one first, then the same name, the same number, the lowest
/// number. Null if there is none.
[[nodiscard]] const model::Cutter* loaded_like(const std::vector<model::Cutter>& library,
                                               const model::Cutter& wanted);

/// The measured ones of the loaded cutters that equal this one as above, but for those of its number: by
/// number.
[[nodiscard]] std::vector<const model::Cutter*> sisters_of(const std::vector<model::Cutter>& library,
                                                           const model::Cutter& wanted);

/// Why a planned tool may not be called: one like it, of the same number where several are; nothing where
/// none is.
[[nodiscard]] std::optional<std::string> out_of_use(const std::vector<OutOfUse>& tools,
                                                    const model::Cutter& planned);

/// The loaded cutter of the same class and sizes that states what it is made of: of the same name, else where
/// all that state it state the same. Null if there is none.
[[nodiscard]] const model::Cutter* stating_material(const std::vector<model::Cutter>& library,
                                                    const model::Cutter& wanted);

/// Gives an operation another tool in place of its own, which the plan has as one of its cutters then; what
/// depends on it stays. A tool that the operator pinned is not replaced in the ledger.
void give_tool(model::Plan& plan, model::AnyRef operation, const model::Cutter& tool, model::Reason why,
               std::vector<model::Rejected> instead_of);

/// Takes the length, the stick-out (if shorter) and the tool table's line of the loaded tool.
void take_length(const model::Cutter& loaded, model::Cutter& into);

}  // namespace capstan::given
