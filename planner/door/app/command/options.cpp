#include "planner/door/app/command/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <sstream>
#include <tuple>

#include "planner/door/app/command/reference.h"
#include "planner/door/app/command/run.h"
#include "planner/ground/base/number.h"
#include "planner/model/features/fit/general.h"
#include "planner/physics/mechanics/loads/margin.h"

// The one file that knows CLI11.

namespace capstan::app {
namespace {

constexpr const char* kQueries = R"(PATH walks the application objects, the same in ISO 14649, AP238 and JSON:
  /project/main_workplan/its_elements[2]/its_operation   attributes and indices, from 0
  /ROUND_HOLE[*]/its_id, #12                             a kind of object, an instance number
  //round_hole, /project/main_workplan//tool_usage       everything of a kind, of all or below
  ...[condition]                                         what it holds of: =, !=, <, <=, >, >=, `is KIND`,
                                                         and, or, not, ( ); an attribute alone: it is set
  ...#size                                               how many
  //round_hole[diameter.theoretical_size > 10]/its_id
  //machining_workingstep[its_feature is pocket and its_operation.its_tool]/its_id
Numbers are in mm, rad, mm/min, 1/min and s. The whole grammar: docs/inspect.md)";

/// Texts as the library gives them, before they mean anything.
struct Raw {
  std::string file, machine, tools, material, rules, cases, stock, deadline;
  std::string objective, margin, solver, reopen, bind, diagnostics = "text";
  std::string workholding, general_tolerance, edges, feeds, revenue;
};

const std::map<std::string, pipeline::Reopen> kReopen = {{"operations", pipeline::Reopen::kOperations},
                                                         {"tools", pipeline::Reopen::kTools},
                                                         {"technology", pipeline::Reopen::kTechnology},
                                                         {"all", pipeline::Reopen::kAll}};
const std::map<std::string, pipeline::Bind> kBind = {{"none", pipeline::Bind::kNone},
                                                     {"strategy", pipeline::Bind::kStrategy},
                                                     {"tools", pipeline::Bind::kTools},
                                                     {"all", pipeline::Bind::kAll}};
const std::map<std::string, pipeline::Objective> kObjective = {{"time", pipeline::Objective::kTime},
                                                               {"cost", pipeline::Objective::kCost},
                                                               {"profit", pipeline::Objective::kProfit}};
const std::map<std::string, optimise::Solver> kSolver = {{"nlopt", optimise::Solver::kNlopt},
                                                         {"ipopt", optimise::Solver::kIpopt}};

template <class T>
std::vector<std::string> names(const std::map<std::string, T>& of) {
  std::vector<std::string> out;
  for (const auto& [name, value] : of) out.push_back(name);
  return out;
}

OptionText text_of(const CLI::Option& o) {
  OptionText out;
  out.positional = o.get_positional();
  for (const std::string& name : o.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : o.get_lnames()) out.names.push_back("--" + name);
  if (out.positional) out.names = {o.get_name(true)};
  // "TYPE", "TYPE:{choice,choice}" or "TYPE:limits"; a flag takes no item.
  const std::string type = o.get_items_expected_max() == 0 ? "" : o.get_type_name();
  out.value = type.substr(0, type.find(':'));
  if (out.value.size() < type.size()) out.limits = type.substr(out.value.size() + 1);
  if (out.limits.starts_with("{") && out.limits.ends_with("}")) {
    std::istringstream words(out.limits.substr(1, out.limits.size() - 2));
    for (std::string word; std::getline(words, word, ',');) out.choices.push_back(word);
    out.limits.clear();
  }
  for (const CLI::Option* other : o.get_excludes()) out.excludes.push_back(other->get_name());
  std::sort(out.excludes.begin(), out.excludes.end());
  out.help = o.get_description();
  out.required = o.get_required();
  out.repeatable =
      o.get_multi_option_policy() == CLI::MultiOptionPolicy::TakeAll || o.get_items_expected_max() > 1;
  return out;
}

CommandText text_of(const CLI::App& app) {
  CommandText out{app.get_name(), app.get_description(), app.get_footer(), {}, {}};
  for (const CLI::Option* o : app.get_options({})) out.options.push_back(text_of(*o));
  for (const CLI::App* sub : app.get_subcommands({})) out.commands.push_back(text_of(*sub));
  return out;
}

class CommandLine {
 public:
  CommandLine() : app_("A generative process planner for CNC machining.", "capstan") {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", std::string("capstan ") + CAPSTAN_VERSION);
    app_.fallthrough();
    app_.add_option("--diagnostics", raw_.diagnostics, "how diagnostics are printed: text or json")
        ->check(CLI::IsMember(std::vector<std::string>{"text", "json"}));
    app_.add_option("--threads", out_.threads, "worker threads; results do not depend on it")
        ->check(CLI::Range(1U, 256U));
    plan();
    bind();
    check();
    show();
    shop();
    cases();
  }

  [[nodiscard]] CommandText text() const { return text_of(app_); }

  Parsed parse(int argc, const char* const* argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      std::ostringstream text;
      const int code = app_.exit(e, text, text);
      return {std::nullopt, {code == 0 ? static_cast<int>(kDone) : static_cast<int>(kUsage), text.str()}};
    }
    const std::string wrong = understand();
    if (!wrong.empty()) return {std::nullopt, {kUsage, wrong + "\nRun with --help for more information.\n"}};
    return {std::move(out_), {}};
  }

 private:
  CLI::App* command(CLI::App& in, const std::string& name, const std::string& help, Command c) {
    CLI::App* sub = in.add_subcommand(name, help);
    sub->callback([this, c] { out_.command = c; });
    return sub;
  }

  void file(CLI::App* sub, const std::string& name, const std::string& help) {
    sub->add_option(name, raw_.file, help)->required();
  }
  void files(CLI::App* sub, const std::string& name, const std::string& help, int least, int most) {
    sub->add_option(name, out_.files, help)->required()->expected(least, most);
  }
  void outputs(CLI::App* sub, bool required) {
    auto* o =
        sub->add_option("-o,--output", out_.outputs,
                        "a file to write, its kind told by its ending: ISO 14649 .p21 .stp, AP238 .stpnc "
                        ".238, plan .json, program .ngc, tool table .tbl; or - for JSON on standard output; "
                        "may be repeated");
    // One value each, so that a positional may follow.
    o->expected(1)->take_all();
    if (required) o->required();
    force(sub);
  }
  void force(CLI::App* sub) {
    sub->add_flag("--force", out_.force, "let an output replace a file that this call reads");
  }
  void inputs(CLI::App* sub, const char* tools = "tool library: a file, or `generic` (the default)") {
    sub->add_option("--machine", raw_.machine, "machine: a file, or the id of a built-in one");
    sub->add_option("--tools", raw_.tools, tools);
    sub->add_option("--material", raw_.material,
                    "work material, instead of the part's: a name, like:NAME, or a file of one");
    sub->add_option("--stock", raw_.stock,
                    "raw piece: block:+2 (the part and 2 mm all round) or box:x0,y0,z0,x1,y1,z1");
    sub->add_option("--objective", raw_.objective,
                    "what is made least or most: time, cost, or profit per time (needs --revenue)")
        ->check(CLI::IsMember(names(kObjective)));
    sub->add_option("--margin", raw_.margin,
                    "how far the loads that limits are held against stand above the expected ones: careful "
                    "(19 of 20 cuts stay below), usual (5 of 6; the default), bold (7 of 10)")
        ->check(CLI::IsMember(mechanics::margin_names()));
    sub->add_option("--revenue", raw_.revenue,
                    "what a piece brings less its material, in the currency of the machine's cost per hour");
    sub->add_option(
           "--feeds", raw_.feeds,
           "scheduled: along the path, as each cross section bears (the default); constant: one feed, "
           "the largest that all of them bear")
        ->check(CLI::IsMember(std::vector<std::string>{"constant", "scheduled"}));
    sub->add_option("--rules", raw_.rules, "a folder of rule tables to add to the built-in ones");
    sub->add_option("--cases", raw_.cases, "a case base to begin from");
    sub->add_option("--solver", raw_.solver, "nlopt or ipopt")->check(CLI::IsMember(names(kSolver)));
    sub->add_option(
        "--workholding", raw_.workholding,
        "how the piece is held: an id or file of fixtures, auto (the first of the shop's that does), "
        "or none");
    sub->add_option("--general-tolerance", raw_.general_tolerance,
                    "for sizes without one: \"ISO 2768-m\", \"ISO 22081 0.2\" or \"+-0.1\"");
    sub->add_option("--batch", out_.inputs.batch, "pieces to be made")->check(CLI::Range(1, 1000000));
    sub->add_option("--edges", raw_.edges, "chamfer edges that the part leaves sharp, mm");
  }

  void plan() {
    auto* sub = command(app_, "plan", "plan a part: operations, tools, paths, feeds", Command::kPlan);
    file(sub, "part", "ISO 14649 or AP238 file (.p21 .stp .stpnc .238), plan JSON, or STL mesh");
    inputs(sub);
    sub->add_option("--bind", raw_.bind, "how far decisions are closed: none, strategy, tools or all")
        ->check(CLI::IsMember(names(kBind)));
    sub->add_option("--reopen", raw_.reopen, "what to plan anew although the file has it")
        ->check(CLI::IsMember(names(kReopen)));
    findings(sub);
    outputs(sub, true);
  }
  /// What is written in spite of findings: by default all but a program that the check condemns.
  void findings(CLI::App* sub) {
    auto* strict = sub->add_flag("--strict", out_.strict, "write nothing when there are findings");
    sub->add_flag("--allow-findings", out_.allow_findings,
                  "write the program (.ngc, .tbl) although the check condemns it: its header and markers say "
                  "why, and it stops (M0) before each condemned step")
        ->excludes(strict);
  }
  void bind() {
    auto* sub = command(app_, "bind", "close at the machine what a plan left open", Command::kBind);
    file(sub, "plan", "plan with open decisions");
    inputs(
        sub,
        "the tools that are loaded: a tool table or library; without it the plan's own count as loaded, in "
        "its tool numbers");
    sub->add_option("--deadline", raw_.deadline, "e.g. 200ms or 2s; a plan that comes later ends with 5");
    findings(sub);
    outputs(sub, true);
  }
  void check() {
    auto* sub =
        command(app_, "check", "prove a plan or a program safe, or list what is wrong", Command::kCheck);
    files(sub, "files", "plans, programs (.ngc) and the programs' tool table (.tbl)", 1, 1000);
    sub->add_option("--machine", raw_.machine, "machine that programs run on");
    sub->add_option("--tools", raw_.tools, "tool library with the programs' tools");
    sub->add_flag("--schema", out_.schema, "what does not follow the schema is a finding, too");
    sub->add_flag("--json", out_.json, "findings as JSON on standard output");
  }
  void show() {
    auto* explain = command(app_, "explain", "say why each value of a plan is what it is", Command::kExplain);
    file(explain, "plan", "plan");
    explain->add_option("workingstep", out_.step, "id or number of a step");
    explain->add_option("attribute", out_.attribute, "one value of that step");
    auto* inspect =
        command(app_, "inspect", "show what a file holds, or one value by path", Command::kInspect);
    file(inspect, "file", "part or plan");
    inspect->add_option("path", out_.step,
                        "e.g. /project/its_workpieces[0]/its_material, #12, /ROUND_HOLE[*]#size, "
                        "//round_hole[diameter.theoretical_size > 10]/its_id");
    inspect->footer(kQueries);
    auto* diff = command(app_, "diff", "say what changed between two plans", Command::kDiff);
    files(diff, "plans", "two plans", 2, 2);
    auto* convert = command(app_, "convert", "write a part or plan in another format", Command::kConvert);
    file(convert, "file", "part or plan");
    outputs(convert, true);
  }
  void shop() {
    auto* tools = app_.add_subcommand("tools", "the tool library");
    tools->require_subcommand(1);
    auto* list = command(*tools, "list", "a line per cutter", Command::kToolsList);
    list->add_option("--tools", raw_.tools, "tool library: a file, or `generic`");
    list->add_option("filter", out_.words, "only cutters whose id or class contains this");
    auto* one = command(*tools, "show", "all that is known of a cutter, with sources", Command::kToolsShow);
    one->add_option("--tools", raw_.tools, "tool library: a file, or `generic`");
    one->add_option("id", out_.words, "the cutter's id")->required();
    tool_files(*tools);
    for (const auto& [name, help, c] :
         {std::tuple("materials", "the work materials that are known", Command::kMaterialsList),
          std::tuple("machines", "the built-in machines", Command::kMachinesList),
          std::tuple("fixtures", "the built-in fixtures and clamps", Command::kFixturesList)}) {
      auto* known = app_.add_subcommand(name, help);
      known->require_subcommand(1);
      auto* all = command(*known, "list", "a line each", c);
      all->add_option("filter", out_.words, "only those whose line contains this");
      if (c == Command::kMaterialsList) {
        auto* page =
            command(*known, "show", "all that is known of a material, with sources", Command::kMaterialsShow);
        page->add_option("name", out_.words, "its id or a name, or a file of --material")->required();
      }
    }
    auto* rules = app_.add_subcommand("rules", "the rule tables");
    rules->require_subcommand(1);
    for (auto* sub :
         {command(*rules, "check", "find gaps, contradictions and dead rows", Command::kRulesCheck),
          command(*rules, "list", "a line per row", Command::kRulesList)}) {
      sub->add_option("--rules", raw_.rules, "a folder of rule tables to add to the built-in ones");
    }
  }

  void tool_files(CLI::App& tools) {
    auto* import = command(tools, "import",
                           "read a library of any known format, say what was read, derived "
                           "and dropped, and write it",
                           Command::kToolsImport);
    file(import, "library", "a file or folder; its format is told by its content");
    auto* convert = command(tools, "convert", "write a library in another format", Command::kToolsConvert);
    file(convert, "library", "a file or folder");
    auto* out = command(tools, "export", "write the library that planning uses", Command::kToolsExport);
    out->add_option("--tools", raw_.tools, "tool library: a file, a folder, or `generic`");
    for (auto* sub : {import, convert, out}) {
      auto* o = sub->add_option("-o,--output", out_.outputs,
                                "a file to write, its format told by its ending; may be repeated");
      o->expected(1)->take_all();
      if (sub != import) o->required();
      force(sub);
      sub->add_option("--format", out_.tools.format, "the output's format by name");
      sub->add_option("--column-map", out_.tools.column_map, "what the columns of a table hold: a saved map");
      sub->add_option("--unit", out_.tools.unit, "mm or inch, where a file does not say")
          ->check(CLI::IsMember(std::vector<std::string>{"mm", "inch"}));
      sub->add_flag("--report", out_.tools.report, "every value that is derived or dropped");
      sub->add_flag("--json", out_.json, "the report as JSON on standard output");
      if (sub != out)
        sub->add_option("--save-map", out_.tools.save_map,
                        "write the map of the table's columns, to be edited");
    }
  }

  void cases() {
    auto* cases = app_.add_subcommand("cases", "what was cut once");
    cases->require_subcommand(1);
    auto* add =
        command(*cases, "add", "keep cases: of a CSV file, or the steps of a plan", Command::kCasesAdd);
    add->add_option("base", raw_.cases, "case base; made where there is none")->required();
    files(add, "files", "CSV files or plans", 1, 1000);
    auto* near =
        command(*cases, "nearest", "the nearest cases, and the precedent they make", Command::kCasesNearest);
    near->add_option("base", raw_.cases, "case base")->required();
    auto& q = out_.question;
    near->add_option("--operation", q.operation, "keyword of the operation, e.g. DRILLING")->required();
    near->add_option("--material", q.material, "work material by any of its names")->required();
    near->add_option("--tool", q.tool_class, "substrate and class, e.g. carbide/twist_drill")->required();
    near->add_option("--machine", raw_.machine, "the machine's id");
    near->add_option("--diameter", q.diameter_mm, "mm");
    near->add_option("--depth", q.depth_mm, "mm");
    near->add_option("--width", q.width_mm, "mm");
    near->add_option("--tolerance", q.tolerance_mm, "width of the tolerance zone, mm");
    near->add_option("-k", q.count, "how many")->check(CLI::Range(1U, 1000U));
  }

  template <class T>
  static void pick(const std::map<std::string, T>& of, const std::string& text, T& into) {
    if (const auto at = of.find(text); at != of.end()) into = at->second;
  }
  /// An option or file whose value was given, and is empty: not the same as left out.
  [[nodiscard]] static std::string empty_value(const CLI::App& of) {
    for (const CLI::Option* o : of.get_options()) {
      if (o->count() == 0) continue;
      const auto& values = o->results();
      if (std::any_of(values.begin(), values.end(), [](const std::string& v) {
            return v.find_first_not_of(" \t\n\r") == std::string::npos;  // blanks name nothing
          }))
        return o->get_name() + ": the value is empty; leave the option out instead";
    }
    for (const CLI::App* sub : of.get_subcommands()) {
      if (std::string wrong = empty_value(*sub); !wrong.empty()) return wrong;
    }
    return {};
  }
  /// What is wrong with --general-tolerance, or nothing.
  [[nodiscard]] std::string general_tolerance_wrong() const {
    if (raw_.general_tolerance.empty()) return {};
    if (raw_.general_tolerance.find(',') != std::string::npos)
      return "--general-tolerance: '" + raw_.general_tolerance +
             "' has a comma; decimals are written with a point";
    const auto read = model::parse_general(raw_.general_tolerance);
    return read ? "" : "--general-tolerance: " + read.error().message + "; expected " + read.error().expected;
  }
  [[nodiscard]] std::string rules_wrong() const {
    std::error_code error;
    if (raw_.rules.empty() || std::filesystem::is_directory(raw_.rules, error)) return {};
    return "--rules: '" + raw_.rules + "' is no folder";
  }
  /// What is wrong with --edges, or nothing. How wide an edge the tables break is theirs to say.
  std::string edges() {
    if (raw_.edges.empty()) return {};
    const auto v = parse_double(raw_.edges);
    if (!v || !std::isfinite(*v) || *v < 0.0)
      return "--edges: '" + raw_.edges + "' is no width of 0 or more in mm, e.g. 0.3";
    out_.inputs.edge_break_mm = *v;
    return {};
  }
  /// What is wrong with --revenue, or nothing: profit cannot do without it, nothing else needs it.
  std::string revenue() {
    const bool profit = raw_.objective == "profit";
    if (raw_.revenue.empty()) {
      return profit ? "--objective profit: needs --revenue, what a piece brings less its material, in the "
                      "currency of the machine's cost per hour"
                    : "";
    }
    const auto v = parse_double(raw_.revenue);
    if (!v || !std::isfinite(*v) || !(*v > 0.0))
      return "--revenue: '" + raw_.revenue + "' is no amount above 0, e.g. 12.5";
    if (!profit) return "--revenue: only --objective profit asks what a piece brings";
    out_.inputs.revenue = *v;
    return {};
  }
  static std::optional<std::string> given(std::string text) {
    return text.empty() ? std::nullopt : std::optional(std::move(text));
  }

  /// What is wrong, or nothing.
  std::string understand() {
    if (!raw_.file.empty()) out_.files = {raw_.file};
    if (std::string wrong = empty_value(app_); !wrong.empty()) return wrong;
    if (std::string wrong = edges(); !wrong.empty()) return wrong;
    if (std::string wrong = revenue(); !wrong.empty()) return wrong;
    if (std::string wrong = general_tolerance_wrong(); !wrong.empty()) return wrong;
    if (std::string wrong = rules_wrong(); !wrong.empty()) return wrong;
    auto& in = out_.inputs;
    in.machine = given(raw_.machine);
    in.tools = given(raw_.tools);
    in.material = given(raw_.material);
    in.rules = given(raw_.rules);
    in.cases = given(raw_.cases);
    in.workholding = given(raw_.workholding);
    in.feeds = given(raw_.feeds);
    in.margin = given(raw_.margin);
    in.general_tolerance = given(raw_.general_tolerance);
    if (const auto at = kObjective.find(raw_.objective); at != kObjective.end()) in.objective = at->second;
    if (const auto at = kSolver.find(raw_.solver); at != kSolver.end()) in.solver = at->second;
    pick(kReopen, raw_.reopen, out_.reopen);
    pick(kBind, raw_.bind, out_.bind);
    out_.json_diagnostics = raw_.diagnostics == "json";
    if (!raw_.stock.empty()) {
      if (std::string wrong = parse_stock(raw_.stock, in); !wrong.empty()) return "--stock: " + wrong;
    }
    if (!raw_.deadline.empty()) {
      out_.deadline = parse_duration(raw_.deadline);
      if (!out_.deadline) return "--deadline: '" + raw_.deadline + "' is no time above 0, e.g. 200ms or 2s";
    }
    return {};
  }

  CLI::App app_;
  Raw raw_;
  Options out_;
};

}  // namespace

std::optional<std::chrono::milliseconds> parse_duration(const std::string& text) {
  std::string number = text;
  double factor = 1.0;
  if (number.ends_with("ms")) {
    number.resize(number.size() - 2);
  } else if (number.ends_with("s")) {
    number.pop_back();
    factor = 1000.0;
  }
  const auto v = parse_double(number);
  constexpr double kLongest = 1e9;  // ms, above eleven days
  if (!v || !(*v * factor >= 1.0) || *v * factor > kLongest) return std::nullopt;
  return std::chrono::milliseconds(static_cast<long>(*v * factor));
}

std::string parse_stock(const std::string& text, InputOptions& into) {
  into.stock_text = text;
  if (text.starts_with("block:")) {
    const std::string rest = text.substr(text.find(':') + 1);
    const auto v = parse_double(rest.starts_with("+") ? rest.substr(1) : rest);
    if (!v || *v < 0.0) return "'" + rest + "' is no allowance in mm, e.g. block:+2";
    into.stock_allowance_mm = *v;
    return {};
  }
  if (!text.starts_with("box:")) return "'" + text + "' is neither block:+2 nor box:x0,y0,z0,x1,y1,z1";
  std::vector<double> v;
  std::istringstream numbers(text.substr(4));
  for (std::string one; std::getline(numbers, one, ',');) {
    const auto d = parse_double(one);
    if (!d) return "'" + one + "' is not a number";
    v.push_back(*d);
  }
  if (v.size() != 6) return "a box needs six numbers, " + std::to_string(v.size()) + " are given";
  for (std::size_t i = 0; i < 3; ++i) {
    if (!(v[i] < v[i + 3]))
      return "the box is empty: each of its first three numbers must be below its partner";
  }
  into.stock = geometry::Box3{{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
  return {};
}

CommandText command_reference() { return CommandLine().text(); }

Parsed parse_command_line(int argc, const char* const* argv) { return CommandLine().parse(argc, argv); }

}  // namespace capstan::app
