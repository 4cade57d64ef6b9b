#pragma once

/// The door for programs that plan with Capstan: link `capstan::capstan`, include this header.
/// It names nothing but the standard library.

#include <cstddef>
#include <functional>
#include <map>
#include <stop_token>
#include <string>
#include <string_view>
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
  std::string margin = {};  ///< of loads against their limits: "careful", "usual", "bold", or a number of
                            ///< standard deviations above 0 and at most 3: "1.28"
  std::string cases = {};              ///< a case base to begin from
  std::string stock = {};              ///< the raw piece: "block:+2" or "box:x0,y0,z0,x1,y1,z1", mm
  std::string solver = {};             ///< as `capstan plan --solver` lists them
  std::string workholding = {};        ///< ids or a file of fixtures, "auto", "none"
  std::string general_tolerance = {};  ///< of sizes without one: "ISO 2768-m", "ISO 22081 0.2", "+-0.1"
  std::string assume = {};             ///< "tool-material=carbide": of tools that do not state it
  int batch = 1;                       ///< pieces to be made
  double edge_break_mm = 0.0;          ///< edges that the part leaves sharp are chamfered by this
  std::string bind = {};      ///< how far `plan_...` closes decisions: "none", "strategy", "tools", "all"
  std::string deadline = {};  ///< of `bind_...`, since the call: "200ms", "2s"; then PlanOutput::late
  bool strict = false;        ///< no program and no form of a plan that has findings
  std::string profile = {};   ///< `bind_...`, `check_...`: hold plans against this control: an id, or a file
  bool schema = false;        ///< `check_...`: what does not follow the schema is a finding, too
  /// Called with the name of a stage and a fraction from 0 to 1, by the calling thread or one of its workers;
  /// it must not throw.
  std::function<void(std::string_view stage, double fraction)> progress = {};
  /// Ends the call early: there is a plan only where one was made by then, and no program without its check.
  std::stop_token stop = {};
  std::string cache = {};  ///< a folder that keeps results of stages from call to call
  std::string may = {};    ///< what a control may decide at the machine: "all", "none", "tools,feeds", ...
  std::string mesh_unit = {};  ///< of an STL mesh, which does not state it: "mm" (the default), "inch"
  std::string body = {};       ///< of a CAD file: the number from 1 or the name of the body that is the part
  bool features_only = false;  ///< of a CAD file: its features and tolerances are written, nothing is planned
  std::string time = {};       ///< of `bind_...`: when, for the plan's record; any text
  std::string control =
      {};  ///< in place of the machine's own: "fanuc", "grbl", "haas", "heidenhain", "linuxcnc", "mach3", "siemens"
  unsigned next = 0;  ///< of `bind_...`: so many workingsteps only; 0: the whole plan
  unsigned from = 0;  ///< of `bind_...`: the first of them, from 1; 0: the first of which something is open
  bool stop_at_deadline =
      false;                  ///< of `bind_...`: nothing, in time, where nothing is checked by the deadline
  std::string measured = {};  ///< of `bind_...`: "wall=0.04,floor=-0.01", what if and while statements ask
  /// What a person decides of the plan, one edit each, as the command takes it: "POCKET*/tool=T5";
  /// "POCKET*/tool"; "feed<=2000"; "tool=em12*"; "HOLE<POCKET". `edits` is a file of them.
  std::vector<std::string> set = {}, pin = {}, limit = {}, forbid = {}, order = {};
  std::string edits = {};
  /// Of `bind_...`: what a control says of its running machine: the most that the spindle gives, kW; the
  /// feed override, %, at most 100. 0: as the machine has it.
  double spindle_power_kw = 0.0;
  unsigned feed_override = 0;
  /// Where its axes may be, "X=0:350,Z=-200:-5", and where the work offset lies, "X=120,Y=80,Z=-310", mm in
  /// machine coordinates: a program that leaves the limits is not given.
  std::string axis_limits = {}, work_offset = {};
  std::string shop = {};  ///< a file of the shop's settings (`capstan shop init` writes one); what is empty
                          ///< here is as it says
  std::string without = {};              ///< "sections": plans without the cross sections along their paths
  std::vector<std::string> tapped = {};  ///< of a CAD file: threads of its holes, "HOLE 3=M8:16"
  /// Of `bind_...`: a file of what became of the loaded tools, "T3 broken", "T5 wear 0.02 life-left 12.5".
  std::string tool_state = {};
  /// The steps whose paths pictures ("svg", "png") draw, each by number or by a pattern; empty: all.
  std::vector<std::string> draw = {};
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
  std::string tool_table;     ///< the control's tool table of the program: LinuxCNC's .tbl
  std::size_t steps = 0;      ///< workingsteps planned
  std::size_t unplanned = 0;  ///< features that are not; each has an error among `diagnostics`
  double time_s = 0.0;        ///< of the whole program
  std::vector<PlanMessage> diagnostics;
  std::vector<PlanMessage> findings;  ///< of checking the plan and the program; a plan to be run has none
  /// Why there is no program (with `allow_findings`: why it stops): errors of the check, limits that are
  /// exceeded, features that are not planned and that others rest on.
  std::vector<PlanMessage> condemned;
  /// All forms by the name of their format, those above included: "iso14649", "ap238", "json", "linuxcnc",
  /// "linuxcnc_tools", "report", "svg" and "png" (pictures of the paths; none of a call with a deadline), and
  /// what later versions add.
  std::map<std::string, std::string> forms = {};
  bool late = false;  ///< the deadline was past when the plan was there
};

/// What checking came to.
struct CheckOutput {
  bool checked = false;  ///< whether anything could be checked; otherwise `diagnostics` says why
  bool clean = false;    ///< no finding, no deviation from the schema that was asked for, nothing unplanned
  std::vector<PlanMessage> findings;
  std::vector<PlanMessage> diagnostics;
};

/// A file to check, by its content: a plan, a program, or the tool table of programs.
struct CheckInput {
  std::string name;  ///< what findings call it
  std::string bytes;
};

/// Plans a part: an ISO 14649 or AP238 file, a plan as JSON, or an STL mesh; the content says which. `name`
/// is what diagnostics call it. Throws  std::logic_error and what derives from it for a fault of the library
/// itself; std::bad_alloc.
[[nodiscard]] CAPSTAN_API PlanOutput plan_bytes(std::string part, const std::string& name,
                                                const PlanOptions& options = {});

/// As above, from a file.
[[nodiscard]] CAPSTAN_API PlanOutput plan_file(const std::string& path, const PlanOptions& options = {});

/// Closes at the machine what a plan leaves open, with the tools that `options.tools` says are loaded (else
/// the plan's own): first a checked fallback, then an improvement while the deadline allows.
[[nodiscard]] CAPSTAN_API PlanOutput bind_bytes(std::string plan, const std::string& name,
                                                const PlanOptions& options = {});
[[nodiscard]] CAPSTAN_API PlanOutput bind_file(const std::string& path, const PlanOptions& options = {});

/// Proves plans and programs safe, or says what is wrong with them. Of the options machine, tools, control,
/// profile, schema, threads, progress and stop count.
[[nodiscard]] CAPSTAN_API CheckOutput check_bytes(std::vector<CheckInput> files,
                                                  const PlanOptions& options = {});
[[nodiscard]] CAPSTAN_API CheckOutput check_files(const std::vector<std::string>& paths,
                                                  const PlanOptions& options = {});

/// What `explain_...` gives.
struct ExplainOutput {
  bool explained = false;  ///< otherwise `diagnostics` says why
  std::string text;        ///< for people
  std::vector<PlanMessage> diagnostics;
};

/// Why each value of a plan is what it is: of the whole plan, of one workingstep (its id, or its number in
/// the order of execution), or of one of its attributes.
[[nodiscard]] CAPSTAN_API ExplainOutput explain_bytes(std::string plan, const std::string& name,
                                                      const std::string& step = {},
                                                      const std::string& attribute = {});

/// Logs of machines and what is known beside them. An empty text: not known, or the default.
struct CaseImport {
  std::string cases;              ///< the case base: a file, made where there is none, or postgresql://...
  std::string format;             ///< of the logs: "trace", "csv", "linuxcnc", "times", "wear"
  std::vector<std::string> logs;  ///< files
  std::string plan;               ///< file: the plan that was cut, or a sheet (CSV) that describes a program
  std::string program = {};       ///< file: the plan's program, whose markers tell a line's workingstep
  std::string inspection = {};    ///< file: what was measured of the parts (CSV)
  std::vector<std::string> parts = {};     ///< numbers of the parts: one per log, or none
  std::string serial = {};                 ///< number of the machine
  std::string unit = {};                   ///< "mm" or "inch", where a log does not say
  std::vector<std::string> triggers = {};  ///< what makes a step a bad case: "lag_mm>0.05:0.2" (for 0.2 s)
  std::vector<std::string> columns = {};   ///< names in order, of tables that do not say
  double period_s = 0.001;                 ///< of LinuxCNC's servo thread, 1e-6 to 1
};

/// What `import_cases` came to.
struct CaseImportOutput {
  bool imported = false;                 ///< otherwise nothing was kept, and `diagnostics` says why
  std::size_t cases = 0;                 ///< that the logs make
  std::size_t added = 0;                 ///< of them, that were not there before
  std::size_t held = 0;                  ///< in the base now
  std::vector<PlanMessage> diagnostics;  ///< what was left out, and why, among them
};

/// Keeps what logs show of a plan's workingsteps as cases, as `capstan cases import` does: all cases of all
/// logs, or none. Importing a log again adds nothing. Planning leans on them by PlanOptions::cases. Throws
/// as plan_bytes.
[[nodiscard]] CAPSTAN_API CaseImportOutput import_cases(const CaseImport& what);

/// The names of the command's options that PlanOptions has fields for, without their dashes.
[[nodiscard]] CAPSTAN_API std::vector<std::string> option_names();

}  // namespace capstan
