#pragma once

/// The door for programs that plan with Capstan: link `capstan::capstan`, include this header.
/// It names nothing but the standard library.

#include <cstddef>
#include <string>
#include <vector>

/// Marks what the library exports; nothing else of it is visible to a linker.
#define CAPSTAN_API __attribute__((visibility("default")))

namespace capstan {

/// The version of the library that is linked, as "major.minor.patch": what the program got, which need not be
/// what it was compiled against.
[[nodiscard]] CAPSTAN_API std::string version();

/// What planning is given beside the part. An empty text is the built-in default.
struct PlanOptions {
  std::string machine;    ///< file, or id of a built-in machine
  std::string tools;      ///< file of a tool library
  std::string material;   ///< a name, `like:NAME`, or a file of one; instead of the part's
  std::string rules;      ///< folder of rule tables, added to the built-in ones
  std::string objective;  ///< "time", "cost", "profit" (per time; needs `revenue`)
  std::string feeds;      ///< "scheduled" along the path, "constant"
  std::string reopen;  ///< "operations", "tools", "technology", "all": planned anew although the file has it
  double stock_allowance_mm = -1.0;  ///< at least 0: the raw piece is the part grown by this
  double revenue = 0.0;  ///< what a piece brings less its material, in the currency of the machine's rate
  unsigned threads = 1;  ///< results do not depend on it
  bool allow_findings =
      false;  ///< a program although the check condemns it; it stops before what is condemned. Never of a
              ///< plan that its file states in two ways, or whose workpiece or set-ups it states wrongly
  std::string margin = {};  ///< of loads against their limits: "careful", "usual", "bold"
};

/// A thing said about the input or the plan, as the command prints it.
struct PlanMessage {
  std::string severity;  ///< "note", "warning", "error"
  std::string code;      ///< stable, upper case
  std::string text;      ///< one line
};

/// A plan in each of its forms. Forms that cannot be made are empty, with an error among `diagnostics`.
struct PlanOutput {
  bool planned = false;       ///< whether there is a plan at all
  std::string json;           ///< all of the plan
  std::string iso14649;       ///< as Part 21
  std::string ap238;          ///< ISO 10303-238, as Part 21
  std::string linuxcnc;       ///< the program; empty when the check condemns it
  std::string tool_table;     ///< LinuxCNC's .tbl of the program
  std::size_t steps = 0;      ///< workingsteps planned
  std::size_t unplanned = 0;  ///< features that are not; each has an error among `diagnostics`
  double time_s = 0.0;        ///< of the whole program
  std::vector<PlanMessage> diagnostics;
  std::vector<PlanMessage> findings;  ///< of checking the plan and the program; a plan to be run has none
  /// Why there is no program (with `allow_findings`: why it stops): errors of the check, limits that are
  /// exceeded, features that are not planned and that others rest on.
  std::vector<PlanMessage> condemned;
};

/// Plans a part: an ISO 14649 or AP238 file, a plan as JSON, or an STL mesh, told by content. `name` is what
/// diagnostics call it. Throws  std::logic_error and what derives from it for a fault of the library itself;
/// std::bad_alloc.
[[nodiscard]] CAPSTAN_API PlanOutput plan_bytes(std::string part, const std::string& name,
                                                const PlanOptions& options = {});

/// As above, from a file.
[[nodiscard]] CAPSTAN_API PlanOutput plan_file(const std::string& path, const PlanOptions& options = {});

}  // namespace capstan
