#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/door/service/code.h"
#include "planner/door/service/state/machine_state.h"
#include "planner/files/from_cad/asked/threads.h"
#include "planner/ground/geometry/vec.h"
#include "planner/making/optimise/solver/solver.h"
#include "planner/model/plan/edit/edit.h"
#include "planner/model/plan/plan.h"
#include "tooling/library/cutters/holders.h"

namespace capstan::service {

/// The caller's choices beside the part: every option of `plan`, `bind` and `check` (options.h has the
/// table). Unset or empty means the built-in default.
struct Request {
  /// What suits the part where the caller names none, and why.
  struct Suited {
    std::string name, why;
  };
  std::optional<Suited> machine_of_part, tools_of_part;
  std::optional<std::string> machine, control, tools, material, rules, cases, cache;
  std::optional<geometry::Box3> stock;
  std::optional<double> stock_allowance_mm;
  std::string stock_text;                           ///< as given
  std::optional<std::string> mesh_unit;             ///< "mm" or "inch", of an STL mesh
  std::optional<std::string> body;                  ///< of a CAD file: the number or the name of the part's
  std::vector<from_cad::StatedThread> tapped = {};  ///< of a CAD file: threads of its holes
  bool features_only = false;  ///< of a CAD file: features and tolerances, nothing planned
  std::optional<pipeline::Objective> objective;
  std::optional<optimise::Solver> solver;
  std::optional<std::string> general_tolerance, workholding;
  std::optional<std::string> assume;  ///< "tool-material=carbide", of tools that do not state it
  std::optional<std::string> feeds;   ///< "constant" or "scheduled"
  std::optional<std::string> margin;  ///< by name, of mechanics/loads/margin.h
  std::optional<double> revenue;
  int batch = 1;
  double edge_break_mm = 0.0;
  pipeline::Reopen reopen = pipeline::Reopen::kNothing;
  pipeline::Bind bind = pipeline::Bind::kAll;
  std::optional<std::chrono::milliseconds> deadline;  ///< bind: since the call began
  bool strict = false;                                ///< nothing is given when there is a finding
  bool allow_findings = false;                        ///< a program even when the check condemns it
  bool sections = true;                               ///< plans are written with their cross sections
  std::vector<std::string> draw = {};                 ///< steps that pictures show; empty: all
  std::optional<std::string> may;                     ///< bind: what may be decided (late/changes.h)
  std::optional<std::size_t> next, from;              ///< bind: how many workingsteps, and from which on
  bool stop_at_deadline = false;                      ///< bind: what is not checked by then is given up
  std::optional<std::string> measured;                ///< bind: of NC variables (late/branches.h)
  std::string time;                                   ///< bind: when it is, for the record
  MachineState state = {};                            ///< bind: of the machine as it runs
  std::optional<std::string> profile;                 ///< bind, check: a control's profile, by id or file
  bool schema = false;                                ///< check: what reading found is a finding, too
  std::vector<model::Edit> edits;                     ///< of the operator, in the order they were given
  std::optional<std::string> edits_file;              ///< more of them, which come first
  std::optional<std::string> shop;                    ///< a shop file (shop_file/shop_file.h)
  std::vector<std::string> materials = {};            ///< files of the shop's own, beside the shipped table
  std::vector<std::string> fixtures = {};             ///< files of the shop's own, before the shipped ones
  tooling::ShopHolders holders = {};                  ///< of the shop, for tools without their own
  std::vector<model::Provenance> texts = {};          ///< the shop's own (model/plan/resources/shop_texts.h)
  std::set<std::string> given = {};                   ///< names of the options that were set
  std::map<std::string, std::string> from_shop = {};  ///< which of them came from which shop file
  unsigned threads = 1;

  /// Solvers that this program links beside NLopt.
  optimise::Backends backends;
  /// How this caller writes an option, for messages and provenance: "--machine" on a command line.
  std::string sign = "--";
};

/// Why a call gives nothing.
struct Failure {
  Diagnostic what;
  Code code = Code::kImpossible;
};
template <class T>
using Outcome = tl::expected<T, Failure>;

[[nodiscard]] inline auto failed(Diagnostic what, Code code) {
  return tl::unexpected(Failure{std::move(what), code});
}

}  // namespace capstan::service
