#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/door/app/command/telling/telling.h"
#include "planner/door/service/logs/import_logs.h"
#include "planner/door/service/request.h"

namespace capstan::app {

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
  kMachinesShow,
  kFixturesList,
  kFixturesShow,
  kControlsList,
  kControlsShow,
  kShopInit,
  kShopShow,
  kRulesCheck,
  kRulesList,
  kCasesAdd,
  kCasesList,
  kCasesShow,
  kCasesJudge,
  kCasesRemove,
  kCasesExport,
  kCasesMetric,
  kCasesNearest,
  kCasesTune,
  kCasesImport,
  kCasesTrace,
  kCasesReport,
  kServe,
};

/// The question of `cases nearest`.
struct CaseQuestion {
  std::string operation, material, tool_class;
  double diameter_mm = 0.0, depth_mm = 0.0, width_mm = 0.0, tolerance_mm = 0.0;
  double cutter_diameter_mm = 0.0, stick_out_mm = 0.0, hardness_hb = 0.0;
  unsigned teeth = 0;
  std::string coolant;  ///< a word, or empty
  unsigned count = 5;
};

/// What `cases judge` and `cases remove` say of cases.
struct CaseJudgement {
  std::string verdict, by, time_utc, reason;
};

/// How tool libraries are read and written.
struct ToolsOptions {
  std::string column_map, save_map;  ///< files
  std::string unit;                  ///< mm or inch, of files that do not say
  std::string format;                ///< overrides the format of the output's ending
  bool report = false;               ///< every line of the loss report
};

/// The options of `serve` beside those of `bind`.
struct ServeOptions {
  std::string socket, tcp, certificate, key, client_ca;
  std::vector<std::uint32_t> users;  ///< user ids
  unsigned workers = 1, queue = 16;
  /// The options of `bind` that were given, by name.
  std::vector<std::pair<std::string, std::string>> session;
};

/// A command line, understood.
struct Options {
  Command command = Command::kPlan;
  std::vector<std::string> files;    ///< positional, in order
  std::vector<std::string> outputs;  ///< -o
  std::string step, attribute;       ///< explain; `path` of inspect is in `step`
  service::Request inputs;           ///< what the library takes, too
  bool force = false;                ///< an output may be an input, too
  bool json = false;                 ///< check: findings as JSON on standard output
  bool json_diagnostics = false;     ///< one JSON object per line on standard error
  bool quiet = false;                ///< errors only, and the last line where not all is well
  bool verbose = false;              ///< each diagnostic, none folded
  ProgressForm progress = ProgressForm::kAuto;
  std::vector<std::string> words;  ///< tools: a filter, an id; cases: ids, a filter
  ToolsOptions tools;
  std::string today;      ///< cases tune: a date
  CaseQuestion question;  ///< cases nearest; the base is in `inputs.cases`
  CaseJudgement judgement;
  bool learn = false;      ///< cases metric
  service::LogImport log;  ///< cases import
  ServeOptions serve;
};

/// The options, or what to print and the exit code to end with (help, version: 0; wrong usage: 2).
struct Ending {
  int code = 0;
  std::string text;
  Diagnostic fault = {};  ///< of wrong usage, for programs
};
struct Parsed {
  std::optional<Options> options;
  Ending ending;
};
[[nodiscard]] Parsed parse_command_line(int argc, const char* const* argv);

/// An option of `plan`, `bind` or `check` that only a command line has, and why a library has no use for it.
struct TerminalOption {
  std::string_view name, why;
};
/// All of them; every other option of these commands is one of service::options().
[[nodiscard]] std::span<const TerminalOption> terminal_options();

}  // namespace capstan::app
