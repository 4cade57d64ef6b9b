#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "planner/door/pipeline/pipeline.h"
#include "planner/ground/geometry/vec.h"
#include "planner/making/optimise/solver/solver.h"

namespace capstan::app {

/// What planning is given beside the part; nothing stands for the built-in default.
struct InputOptions {
  std::optional<std::string> machine, tools, material, rules, cases;
  std::optional<geometry::Box3> stock;
  std::optional<double> stock_allowance_mm;
  std::string stock_text;  ///< as given
  std::optional<pipeline::Objective> objective;
  std::optional<optimise::Solver> solver;
  std::optional<std::string> general_tolerance, workholding;
  std::optional<std::string> feeds;   ///< "constant" or "scheduled"
  std::optional<std::string> margin;  ///< by name, of mechanics/margin.h
  std::optional<double> revenue;
  int batch = 1;
  double edge_break_mm = 0.0;
};

enum class Command : std::uint8_t {
  kPlan,
  kBind,
  kCheck,
  kExplain,
  kInspect,
  kDiff,
  kConvert,
  kToolsList,
  kToolsShow,
  kToolsImport,
  kToolsExport,
  kToolsConvert,
  kMaterialsList,
  kMaterialsShow,
  kMachinesList,
  kFixturesList,
  kRulesCheck,
  kRulesList,
  kCasesAdd,
  kCasesNearest,
};

/// What `cases nearest` is asked.
struct CaseQuestion {
  std::string operation, material, tool_class;
  double diameter_mm = 0.0, depth_mm = 0.0, width_mm = 0.0, tolerance_mm = 0.0;
  unsigned count = 5;
};

/// How tool libraries are read and written.
struct ToolsOptions {
  std::string column_map, save_map;  ///< files
  std::string unit;                  ///< mm or inch, of files that do not say
  std::string format;                ///< instead of what the output's ending tells
  bool report = false;               ///< every line of the loss report
};

/// A command line, understood.
struct Options {
  Command command = Command::kPlan;
  std::vector<std::string> files;    ///< positional, in order
  std::vector<std::string> outputs;  ///< -o
  std::string step, attribute;       ///< explain; `path` of inspect is in `step`
  InputOptions inputs;
  pipeline::Reopen reopen = pipeline::Reopen::kNothing;
  pipeline::Bind bind = pipeline::Bind::kAll;
  std::optional<std::chrono::milliseconds> deadline;
  bool strict = false;            ///< plan, bind: outputs only when there is no finding
  bool allow_findings = false;    ///< plan, bind: a program even when the check condemns it
  bool force = false;             ///< an output may be an input, too
  bool json = false;              ///< check: findings as JSON on standard output
  bool schema = false;            ///< check: what reading found is a finding, too
  bool json_diagnostics = false;  ///< one JSON object per line on standard error
  unsigned threads = 1;
  std::vector<std::string> words;  ///< tools: a filter, an id
  ToolsOptions tools;
  CaseQuestion question;  ///< cases nearest; the base is in `inputs.cases`
};

/// The options, or what to print and the exit code to end with (help, version: 0; wrong usage: 2).
struct Ending {
  int code = 0;
  std::string text;
};
struct Parsed {
  std::optional<Options> options;
  Ending ending;
};
[[nodiscard]] Parsed parse_command_line(int argc, const char* const* argv);

/// "200ms", "1.5s", "200" (milliseconds); nothing when it is no duration above 0.
[[nodiscard]] std::optional<std::chrono::milliseconds> parse_duration(const std::string& text);

/// "block:+2" sets the allowance, "box:x0,y0,z0,x1,y1,z1" the box; gives what is wrong, or nothing.
[[nodiscard]] std::string parse_stock(const std::string& text, InputOptions& into);

}  // namespace capstan::app
