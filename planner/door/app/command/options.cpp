#include "planner/door/app/command/options.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <map>
#include <span>
#include <sstream>
#include <tuple>

#include "planner/door/app/command/raw_options.h"
#include "planner/door/app/command/reference.h"
#include "planner/door/app/command/run.h"
#include "planner/door/app/command/usage/examples.h"
#include "planner/door/app/command/usage/mistyped.h"
#include "planner/door/service/formats.h"
#include "planner/door/service/options.h"

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

constexpr std::string_view kCases = "cases";  // the option that names a case base

constexpr std::array kTerminal = {
    TerminalOption{"output", "a library gives texts and writes no file"},
    TerminalOption{"force", "a library writes no file"},
    TerminalOption{"diagnostics", "a library gives diagnostics as values"},
    TerminalOption{"json", "a library gives findings as values"},
    TerminalOption{"quiet", "a library prints nothing"},
    TerminalOption{"verbose", "a library gives all diagnostics"},
    TerminalOption{"progress", "a library calls the caller's function"},
    TerminalOption{"help", "a header says what there is"},
    TerminalOption{"version", "a function of the library gives it"},
};

OptionText text_of(const CLI::Option& o) {
  OptionText out;
  out.positional = o.get_positional();
  for (const std::string& name : o.get_snames()) out.names.push_back("-" + name);
  for (const std::string& name : o.get_lnames()) out.names.push_back("--" + name);
  if (out.positional) out.names = {o.get_name(true)};
  // "TYPE", "TYPE:{choice,choice}", "TYPE:{choice,choice} or another" or "TYPE:limits"; a flag takes no item.
  const std::string type = o.get_items_expected_max() == 0 ? "" : o.get_type_name();
  out.value = type.substr(0, type.find(':'));
  if (out.value.size() < type.size()) out.limits = type.substr(out.value.size() + 1);
  if (const std::size_t end = out.limits.find('}'); out.limits.starts_with("{") && end != std::string::npos) {
    std::istringstream words(out.limits.substr(1, end - 1));
    out.open = end + 1 < out.limits.size();
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

/// Names the words of an option that takes others, too: --help and completion list them, `set` judges.
CLI::Validator named(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "{" : ",") + word;
  return CLI::Validator([](std::string&) { return std::string(); }, list + "} or another");
}

class CommandLine {
 public:
  CommandLine() : app_("A generative process planner for CNC machining.", "capstan") {
    app_.require_subcommand(1);
    app_.set_version_flag("--version", std::string("capstan ") + CAPSTAN_VERSION);
    app_.fallthrough();
    app_.add_option("--diagnostics", raw_.diagnostics, "how diagnostics are printed: text or json")
        ->check(CLI::IsMember(std::vector<std::string>{"text", "json"}));
    auto* quiet =
        app_.add_flag("-q,--quiet", out_.quiet, "print errors only, and the last line where not all is well");
    app_.add_flag("-v,--verbose", out_.verbose, "print each diagnostic, where many say the same, too")
        ->excludes(quiet);
    app_.add_option(
            "--progress", raw_.progress,
            "how progress is shown: auto (a bar on a terminal), json (a line every half second) or none")
        ->check(CLI::IsMember(std::vector<std::string>{"auto", "json", "none"}));
    for (const service::Option& o : service::options()) {
      if (o.of_all_commands) option(&app_, o, service::Verb::kPlan);
    }
    plan();
    bind();
    serve();
    check();
    show();
    shop();
    cases();
    examples(app_, "capstan");
  }

  [[nodiscard]] CommandText text() const { return text_of(app_); }

  Parsed parse(int argc, const char* const* argv) {
    try {
      app_.parse(argc, argv);
    } catch (const CLI::ParseError& e) {
      std::ostringstream text;
      const int code = app_.exit(e, text, text);
      if (code != 0) return wrong_usage(e.what(), argc, argv);
      // Help of a command that is none would be that of another.
      if (auto d = mistyped(command_reference(), behind_name(argc, argv))) return refused(*std::move(d));
      return {std::nullopt, {kDone, text.str(), {}}};
    }
    std::string wrong = empty_value(app_);
    if (wrong.empty()) wrong = understand(raw_, out_);
    if (!wrong.empty()) return refused({.code = "USAGE", .message = wrong, .hint = see_help()});
    return {std::move(out_), {}};
  }

 private:
  /// Adds its examples to the help of a command and of those below it.
  static void examples(CLI::App& app, const std::string& called) {
    const std::string notes = app.get_footer();
    std::string shown = "Examples:\n";
    std::istringstream lines{std::string(examples_of(called))};
    for (std::string line; std::getline(lines, line);) shown += "  " + line + "\n";
    shown.pop_back();
    app.footer(notes.empty() ? shown : notes + "\n\n" + shown);
    for (CLI::App* sub : app.get_subcommands({})) examples(*sub, called + " " + sub->get_name());
  }
  static Parsed refused(Diagnostic d) {
    std::string text = "capstan: " + to_text(d) + "\n";
    return {std::nullopt, {kUsage, std::move(text), std::move(d)}};
  }
  /// "`capstan plan --help` shows how", of the command that was named.
  [[nodiscard]] std::string see_help() const {
    std::string called = "capstan";
    for (const CLI::App* at = &app_; !at->get_subcommands().empty();) {
      at = at->get_subcommands().front();
      called += " " + at->get_name();
    }
    return "`" + called + " --help` shows how";
  }
  static std::span<const char* const> behind_name(int argc, const char* const* argv) {
    return {argv + std::min(argc, 1), argv + argc};
  }
  Parsed wrong_usage(std::string said, int argc, const char* const* argv) {
    if (auto d = mistyped(command_reference(), behind_name(argc, argv))) return refused(*std::move(d));
    if (const auto end = said.find('\n'); end != std::string::npos) said.resize(end);
    return refused({.code = "USAGE", .message = std::move(said), .hint = see_help()});
  }

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
    auto* o = sub->add_option("-o,--output", out_.outputs,
                              "a file to write, its ending says which kind: " + service::written_text() +
                                  "; or - for JSON on standard output; may be repeated");
    // One value each, so that a positional may follow.
    o->expected(1)->take_all();
    if (required) o->required();
    force(sub);
  }
  void force(CLI::App* sub) {
    sub->add_flag("--force", out_.force, "let an output replace a file that this call reads");
  }
  /// One option of the service's table.
  void option(CLI::App* sub, const service::Option& o, service::Verb verb) {
    const std::string name = "--" + std::string(o.name);
    CLI::Option* added = nullptr;
    if (o.value == service::Value::kFlag) {
      added = sub->add_flag(name, raw_.flags[o.name], std::string(o.help_of(verb)));
    } else if (o.repeatable) {
      added = sub->add_option(name, raw_.lists[o.name], std::string(o.help_of(verb)) + "; may be repeated");
      added->expected(1)->take_all();  // one value each, so that a positional may follow
    } else {
      added = sub->add_option(name, raw_.of[o.name], std::string(o.help_of(verb)));
    }
    if (o.value == service::Value::kWord) added->check(CLI::IsMember(o.words));
    if (o.value == service::Value::kText && !o.words.empty()) added->check(named(o.words));
    if (o.value == service::Value::kWhole) added->type_name("UINT")->check(CLI::Range(o.least, o.most));
    if (!o.excludes.empty()) added->excludes(sub->get_option("--" + std::string(o.excludes)));
  }
  void options(CLI::App* sub, service::Verb verb) {
    for (const service::Option& o : service::options()) {
      if (!o.of_all_commands && o.help_of(verb) != nullptr) option(sub, o, verb);
    }
  }
  /// Adds an option of the service to a command that is no verb of the service.
  void option(CLI::App* sub, std::string_view name, const char* help) {
    const service::Option& o = *service::find_option(name);
    const std::string flag = "--" + std::string(name);
    if (o.repeatable) {
      sub->add_option(flag, raw_.lists[o.name], std::string(help) + "; may be repeated")
          ->expected(1)
          ->take_all();
    } else {
      sub->add_option(flag, raw_.of[o.name], help);
    }
  }

  void plan() {
    auto* sub = command(app_, "plan", "plan a part: operations, tools, paths, feeds", Command::kPlan);
    file(sub, "part", service::read_text());
    options(sub, service::Verb::kPlan);
    outputs(sub, true);
  }
  void bind() {
    auto* sub = command(app_, "bind", "close at the machine what a plan left open", Command::kBind);
    file(sub, "plan", "plan with open decisions");
    options(sub, service::Verb::kBind);
    outputs(sub, true);
  }
  void serve() {
    auto* sub =
        command(app_, "serve", "bind for other programs, over a UNIX socket or TCP with TLS (HTTP and JSON)",
                Command::kServe);
    ServeOptions& s = out_.serve;
    sub->add_option("--socket", s.socket, "path of the socket");
    sub->add_option("--allow-user", s.users, "a user id that may connect, too")->expected(1)->take_all();
    sub->add_option("--workers", s.workers, "requests worked on at once")->check(CLI::Range(1U, 64U));
    sub->add_option("--queue", s.queue, "requests that may wait, else 503")->check(CLI::Range(1U, 1000U));
    sub->add_option("--tcp", s.tcp, "ADDRESS:PORT in numbers, with TLS on both sides: needs the next three");
    sub->add_option("--cert", s.certificate, "of TCP: the server's certificate, PEM");
    sub->add_option("--key", s.key, "of TCP: its key, PEM, which no other user may read");
    sub->add_option("--client-ca", s.client_ca, "of TCP: who signs the certificates of clients, PEM");
    options(sub, service::Verb::kBind);
  }
  void check() {
    auto* sub =
        command(app_, "check", "prove a plan or a program safe, or list what is wrong", Command::kCheck);
    files(sub, "files",
          "plans, programs (" + service::endings_of(service::Holds::kProgram) +
              ") and the programs' tool table (" + service::endings_of(service::Holds::kToolTable) + ")",
          1, 1000);
    options(sub, service::Verb::kCheck);
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
    option(convert, "without", "sections: a plan without the cross sections along its paths");
    option(convert, "draw",
           "of pictures: the steps whose paths are drawn, by number or by a pattern, instead of all");
    option(convert, "mesh-unit", "what the numbers of an STL mesh are, which does not say: mm or inch");
    outputs(convert, true);
  }
  void shop() {
    auto* tools = app_.add_subcommand("tools", "the tool library");
    tools->require_subcommand(1);
    auto* list = command(*tools, "list", "a line per cutter", Command::kToolsList);
    option(list, "tools", "tool library: a file, `generic`, or `generic-inch`");
    option(list, "shop", "the shop's settings: a file, or none");
    list->add_option("filter", out_.words, "only cutters whose id or class contains this");
    auto* one = command(*tools, "show", "all that is known of a cutter, with sources", Command::kToolsShow);
    option(one, "tools", "tool library: a file, `generic`, or `generic-inch`");
    option(one, "shop", "the shop's settings: a file, or none");
    one->add_option("id", out_.words, "the cutter's id")->required();
    tool_files(*tools);
    known("materials", "the work materials that are known", Command::kMaterialsList, Command::kMaterialsShow,
          "its id or a name, or a file of --material");
    known("machines", "the built-in machines", Command::kMachinesList, Command::kMachinesShow, "its id");
    for (auto* sub : known("fixtures", "the built-in fixtures and clamps, and the shop's own",
                           Command::kFixturesList, Command::kFixturesShow, "its id"))
      option(sub, "shop", "the shop's settings: a file, or none");
    known("controls", "the controls that programs are written for", Command::kControlsList,
          Command::kControlsShow, "its id");
    auto* own = app_.add_subcommand("shop", "the shop's own settings");
    own->require_subcommand(1);
    auto* init =
        command(*own, "init", "write a file of settings to fill in, with what each is", Command::kShopInit);
    init->add_option("-o,--output", out_.outputs, "the file; shop.yaml without it")->expected(1);
    init->add_option("entries", out_.words, "entries that hold, as NAME=VALUE: machine=mill.yaml");
    option(command(*own, "show", "the settings that hold here", Command::kShopShow), "shop",
           "the shop's settings: a file, or none");
    auto* rules = app_.add_subcommand("rules", "the rule tables");
    rules->require_subcommand(1);
    for (auto* sub :
         {command(*rules, "check", "find gaps, contradictions and dead rows", Command::kRulesCheck),
          command(*rules, "list", "a line per row", Command::kRulesList)}) {
      option(sub, "rules", "a folder of rule tables to add to the built-in ones");
    }
  }

  /// A list of what comes with the planner, and all of one.
  /// A group of commands that list what is known of a kind, and show one.
  std::array<CLI::App*, 2> known(const std::string& name, const std::string& help, Command list, Command show,
                                 const std::string& called) {
    auto* of = app_.add_subcommand(name, help);
    of->require_subcommand(1);
    auto* lists = command(*of, "list", "a line each", list);
    lists->add_option("filter", out_.words, "only those whose line contains this");
    auto* shows = command(*of, "show", "all that is known of one, with sources", show);
    shows->add_option("name", out_.words, called)->required();
    return {lists, shows};
  }

  void tool_files(CLI::App& tools) {
    auto* import = command(tools, "import",
                           "read a library of any known format, say what was read, derived "
                           "and dropped, and write it",
                           Command::kToolsImport);
    file(import, "library", "a file or folder; its content decides the format");
    auto* convert = command(tools, "convert", "write a library in another format", Command::kToolsConvert);
    file(convert, "library", "a file or folder");
    auto* out = command(tools, "export", "write the library that planning uses", Command::kToolsExport);
    option(out, "tools", "tool library: a file, a folder, `generic`, or `generic-inch`");
    option(out, "shop", "the shop's settings: a file, or none");
    for (auto* sub : {import, convert, out}) {
      auto* o = sub->add_option("-o,--output", out_.outputs,
                                "a file to write, its ending says which format; may be repeated");
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

  CLI::App* on_base(CLI::App& cases, const std::string& name, const std::string& help, Command c) {
    auto* sub = command(cases, name, help, c);
    sub->add_option("base", raw_.of[kCases], "case base")->required();
    return sub;
  }

  void case_verbs(CLI::App& cases) {
    auto* list =
        on_base(cases, "list", "the cases, or those that hold all of some words", Command::kCasesList);
    list->add_option("words", out_.words, "an origin, a verdict, a part of a category or of a source");
    auto* show = on_base(cases, "show", "all that is known of a case", Command::kCasesShow);
    auto* judge =
        on_base(cases, "judge", "give cases a verdict, which supersedes the last", Command::kCasesJudge);
    auto* remove = on_base(cases, "remove", "let cases count no more; adding them again changes nothing",
                           Command::kCasesRemove);
    auto* out = on_base(cases, "export", "all cases as CSV on standard output", Command::kCasesExport);
    on_base(cases, "metric", "what each number of a question counts in a distance", Command::kCasesMetric)
        ->add_flag("--learn", out_.learn, "learn it from the cases that went well, and store it");
    auto& j = out_.judgement;
    for (CLI::App* sub : {show, judge, remove})
      sub->add_option("ids", out_.words, "first digits of the cases' ids")->required();
    judge->add_option("--verdict", j.verdict, "good, bad or unknown")
        ->required()
        ->check(CLI::IsMember(std::vector<std::string>{"good", "bad", "unknown"}));
    for (CLI::App* sub : {judge, remove}) {
      sub->add_option("--by", j.by, "who says so")->required();
      sub->add_option("--reason", j.reason, "why")->required();
      sub->add_option("--time", j.time_utc, "when, e.g. 2016-06-28T17:32:31Z");
    }
    for (CLI::App* sub : {list, show, out}) sub->add_flag("--json", out_.json, "JSON on standard output");
  }

  void case_tuning(CLI::App& cases) {
    auto* tune = on_base(cases, "tune", "what cases would change of speeds, feeds and models, and why",
                         Command::kCasesTune);
    tune->add_option("plan", out_.files, "a plan, whose steps are tuned; without it the models alone")
        ->expected(0, 1);
    tune->add_flag("--json", out_.json, "JSON on standard output");
    tune->add_option("-o,--output", out_.outputs, "picture (SVG) of each step that has cases")->expected(1);
    tune->add_option("--today", out_.today,
                     "date, e.g. 2016-06-28: later days of cases do not count as days");
  }

  void case_logs(CLI::App& cases) {
    auto* in = on_base(cases, "import", "keep what logs of machines show of a plan's workingsteps as cases",
                       Command::kCasesImport);
    service::LogImport& l = out_.log;
    in->add_option("format", l.format, "trace (MTConnect), csv, linuxcnc, times or wear (tables)")
        ->required();
    files(in, "files", "logs", 1, 1000);
    in->add_option("--plan", l.plan, "the plan that was cut, or a sheet (CSV) that describes a program")
        ->required();
    in->add_option("--program", l.program, "the plan's program: its markers tell a line's workingstep");
    in->add_option("--inspection", l.inspection, "what was measured of the parts (CSV)");
    in->add_option("--part", l.parts, "number of the part: once per file, in their order")
        ->expected(1)
        ->take_all();
    in->add_option("--serial", l.machine, "serial number of the machine");
    in->add_option("--unit", l.unit, "mm or inch, where a log does not say")
        ->check(CLI::IsMember(std::vector<std::string>{"mm", "inch"}));
    in->add_option("--trigger", l.triggers,
                   "what makes a step a bad case, e.g. 'lag_mm>0.05' or 'load_percent>90:0.5' (for 0.5 s)")
        ->expected(1)
        ->take_all();
    in->add_option("--column", l.columns, "name of a column, in order, of a table that does not say")
        ->expected(1)
        ->take_all();
    in->add_option("--period", l.period_s, "of LinuxCNC's servo thread, s")
        ->check(CLI::Range(service::kLeastPeriodS, service::kMostPeriodS));
    auto* trace = on_base(cases, "trace",
                          "which part, step, tool edge, program line and measured value belong together",
                          Command::kCasesTrace);
    file(trace, "plan", "the plan, or the sheet");
    trace->add_option("words", out_.words, "a verdict, a part of a workingstep, of a tool or of a source");
    trace->add_option("--program", l.program, "the plan's program, whose lines are named");
    trace->add_option("--part", l.parts, "of these parts alone")->expected(1)->take_all();
    auto* report = on_base(cases, "report", "times, lags, loads and sizes by workingstep, tool and feature",
                           Command::kCasesReport);
    report->add_option("words", out_.words, "an origin, a verdict, a part of a category or of a source");
    report
        ->add_option("-o,--output", out_.outputs, "picture (SVG): what was observed over what was predicted")
        ->expected(1)
        ->take_all();
    trace->add_option("-o,--output", out_.outputs, "a file (.jsonl, .csv), case base (.db, postgresql://...)")
        ->expected(1)
        ->take_all();
    for (CLI::App* sub : {trace, report}) {
      force(sub);
      sub->add_flag("--json", out_.json, "JSON on standard output");
    }
  }

  void cases() {
    auto* cases = app_.add_subcommand("cases", "what was cut once");
    cases->require_subcommand(1);
    auto* add =
        command(*cases, "add", "keep cases: of a CSV file, or the steps of a plan", Command::kCasesAdd);
    add->add_option("base", raw_.of[kCases], "case base; made where there is none")->required();
    files(add, "files", "CSV files or plans", 1, 1000);
    case_verbs(*cases);
    case_tuning(*cases);
    case_logs(*cases);
    auto* near =
        command(*cases, "nearest", "the nearest cases, and the precedent they make", Command::kCasesNearest);
    near->add_option("base", raw_.of[kCases], "case base")->required();
    auto& q = out_.question;
    near->add_option("--operation", q.operation, "keyword of the operation, e.g. DRILLING")->required();
    near->add_option("--material", q.material, "work material by any of its names")->required();
    near->add_option("--tool", q.tool_class, "substrate and class, e.g. carbide/twist_drill")->required();
    option(near, "machine", "the machine's id");
    near->add_option("--diameter", q.diameter_mm, "mm");
    near->add_option("--depth", q.depth_mm, "mm");
    near->add_option("--width", q.width_mm, "mm");
    near->add_option("--tolerance", q.tolerance_mm, "width of the tolerance zone, mm");
    near->add_option("--cutter-diameter", q.cutter_diameter_mm, "mm");
    near->add_option("--teeth", q.teeth, "of the cutter")->check(CLI::Range(0U, 200U));
    near->add_option("--stick-out", q.stick_out_mm, "of the cutter from its holder, mm");
    near->add_option("--hardness", q.hardness_hb, "of the work, HB");
    near->add_option("--coolant", q.coolant, "dry, mist, flood or through")
        ->check(CLI::IsMember(std::vector<std::string>{"dry", "mist", "flood", "through"}));
    near->add_option("-k", q.count, "how many")->check(CLI::Range(1U, 1000U));
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
  CLI::App app_;
  RawOptions raw_;
  Options out_;
};

}  // namespace

std::span<const TerminalOption> terminal_options() { return kTerminal; }

CommandText command_reference() { return CommandLine().text(); }

Parsed parse_command_line(int argc, const char* const* argv) {
  // `capstan help plan` is `capstan plan --help`.
  std::vector<const char*> words(argv, argv + argc);
  if (argc > 1 && std::string_view(words[1]) == "help") {
    while (words.size() > 1 && std::string_view(words[1]) == "help") words.erase(words.begin() + 1);
    words.push_back("--help");
  }
  return CommandLine().parse(static_cast<int>(words.size()), words.data());
}

}  // namespace capstan::app
