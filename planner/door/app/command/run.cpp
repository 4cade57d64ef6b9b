#include "planner/door/app/command/run.h"

#include <algorithm>
#include <atomic>
#include <csignal>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <new>
#include <system_error>
#include <utility>

#include "planner/door/app/command/finish.h"
#include "planner/door/app/command/options.h"
#include "planner/door/app/command/session.h"
#include "planner/door/app/command/usage/mistyped.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/shop_file/shop_file.h"

namespace capstan::app {
namespace {

int dispatch(Session& s) {
  switch (s.options.command) {
    case Command::kPlan:
      return run_plan(s);
    case Command::kBind:
      return run_bind(s);
    case Command::kCheck:
      return run_check(s);
    case Command::kExplain:
      return run_explain(s);
    case Command::kInspect:
      return run_inspect(s);
    case Command::kDiff:
      return run_diff(s);
    case Command::kConvert:
      return run_convert(s);
    case Command::kToolsList:
    case Command::kToolsShow:
      return run_tools(s);
    case Command::kToolsImport:
    case Command::kToolsExport:
    case Command::kToolsConvert:
      return run_tools_convert(s);
    case Command::kMaterialsShow:
      return run_material(s);
    case Command::kMaterialsList:
      return run_materials(s);
    case Command::kMachinesList:
    case Command::kFixturesList:
    case Command::kControlsList:
      return run_known(s);
    case Command::kMachinesShow:
    case Command::kFixturesShow:
    case Command::kControlsShow:
      return run_shown(s);
    case Command::kShopInit:
      return run_shop_init(s);
    case Command::kShopShow:
      return run_shop_show(s);
    case Command::kRulesCheck:
    case Command::kRulesList:
      return run_rules(s);
    case Command::kCasesAdd:
      return run_cases_add(s);
    case Command::kCasesList:
      return run_cases_list(s);
    case Command::kCasesShow:
      return run_cases_show(s);
    case Command::kCasesJudge:
      return run_cases_judge(s);
    case Command::kCasesRemove:
      return run_cases_remove(s);
    case Command::kCasesExport:
      return run_cases_export(s);
    case Command::kCasesMetric:
      return run_cases_metric(s);
    case Command::kCasesNearest:
      return run_cases_nearest(s);
    case Command::kCasesTune:
      return run_cases_tune(s);
    case Command::kCasesImport:
      return run_cases_import(s);
    case Command::kCasesTrace:
      return run_cases_trace(s);
    case Command::kCasesReport:
      return run_cases_report(s);
    case Command::kServe:
      return run_serve(s);
  }
  return kUsage;
}

/// A file, or of a folder the files in it and below.
void add_files(const std::string& path, std::vector<std::string>& out) {
  out.push_back(path);
  constexpr std::size_t kMost = 10'000;  // of a folder; default, unsourced: more are no rules and no tools
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) return;
  std::size_t n = 0;
  for (auto at = std::filesystem::recursive_directory_iterator(path, error);
       !error && at != std::filesystem::recursive_directory_iterator() && n < kMost; at.increment(error), ++n)
    out.push_back(at->path().string());
}

/// Files that a call reads, those among them that the shop's settings name: an output of the same name would
/// overwrite them.
std::vector<std::string> read_by(const Options& o) {
  std::vector<std::string> out = o.files;
  const service::Request& in = o.inputs;
  for (const auto& path : {in.machine, in.tools, in.material, in.rules, in.cases, in.workholding,
                           in.edits_file, in.shop, in.profile}) {
    if (path) add_files(*path, out);
  }
  for (const auto* files : {&in.materials, &in.fixtures}) {
    for (const std::string& path : *files) add_files(path, out);
  }
  for (const std::string& path : {o.tools.column_map, o.log.plan, o.log.program, o.log.inspection}) {
    if (!path.empty()) out.push_back(path);
  }
  return out;
}

/// Takes the shop's settings, from the file that is named or found, where the command asks anything of a
/// shop.
int in_shop(Session& s) {
  service::Request& in = s.options.inputs;
  switch (s.options.command) {
    case Command::kPlan:
    case Command::kBind:
    case Command::kCheck:
    case Command::kToolsList:
    case Command::kToolsShow:
    case Command::kToolsExport:
    case Command::kFixturesList:
    case Command::kFixturesShow:
    case Command::kShopShow:
    case Command::kServe:
      break;
    default:
      return kDone;
  }
  if (!in.shop) {
    auto found = service::found_shop();
    if (!found) return s.end(found.error(), kUsage);
    in.shop = *std::move(found);
    // Each session of a server reads it for itself.
    if (in.shop && s.options.command == Command::kServe)
      s.options.serve.session.emplace_back("shop", *in.shop);
  }
  if (s.options.command == Command::kShopShow) return kDone;  // says all of it
  auto with = service::with_shop(in, s.job);
  if (!with) return s.end(with.error(), kUsage);
  in = *std::move(with);
  std::string entries;
  const auto add = [&](const std::string& name) { entries += (entries.empty() ? "" : ", ") + name; };
  for (const auto& [name, file] : in.from_shop) add(name);
  if (!in.materials.empty()) add("materials");
  if (!in.fixtures.empty()) add("fixtures");
  if (!in.holders.all.empty()) add("holders");
  if (!in.texts.empty()) add("texts");
  if (entries.empty()) return kDone;
  s.job.note("SHOP", "settings of " + *in.shop + ": " + entries + "; --shop none leaves them out");
  return kDone;
}

/// A fault of the outputs' paths ends the call before any work.
int begun(Session& s) {
  if (const int code = in_shop(s); code != kDone) return code;
  std::vector<std::string> outputs = s.options.outputs;
  if (!s.options.tools.save_map.empty()) outputs.push_back(s.options.tools.save_map);
  // A case base on a server is no file.
  if (s.options.command == Command::kCasesTrace)
    std::erase_if(outputs, [](const std::string& name) { return name.find("://") != std::string::npos; });
  if (auto ok = service::can_be_written(outputs, read_by(s.options), s.options.force); !ok)
    return s.end(ok.error(), kUsage);
  return dispatch(s);
}

/// Whose work a signal ends; nothing: none that can be.
std::atomic<Job*> stopped_by_signal{nullptr};
static_assert(std::atomic<Job*>::is_always_lock_free);

extern "C" {
static void stop_by_signal(int signal) {
  Job* job = stopped_by_signal.exchange(nullptr);
  if (job != nullptr) return job->request_stop();
  ::signal(signal, SIG_DFL);
  ::raise(signal);
}
}

/// While it lives, Ctrl-C and a plain `kill` end plan, bind and check as a stop does: with a message, and
/// nothing half written. The second one ends the process at once. The other commands end at the first.
class StopsBySignal {
 public:
  explicit StopsBySignal(Session& s) {
    const Command c = s.options.command;
    if (c != Command::kPlan && c != Command::kBind && c != Command::kCheck) return;
    stopped_by_signal = &s.job;
    for (const int signal : {SIGINT, SIGTERM}) {
      struct sigaction now = {}, stop = {};
      // What a caller has ignored (nohup, a job in the background) stays so.
      if (::sigaction(signal, nullptr, &now) != 0 || now.sa_handler == SIG_IGN) continue;
      stop.sa_handler = stop_by_signal;
      ::sigaction(signal, &stop, nullptr);
    }
  }
  ~StopsBySignal() { stopped_by_signal = nullptr; }
  StopsBySignal(const StopsBySignal&) = delete;
  StopsBySignal& operator=(const StopsBySignal&) = delete;
};

/// The only place that catches exceptions: all functions below return their outcome by value.
int guarded(Session& s) {
  try {
    return begun(s);
  } catch (const std::bad_alloc&) {
    return s.end({.code = "APP-MEMORY", .message = "the memory does not suffice"}, kOurFault);
  } catch (const std::exception& e) {
    return s.end({.code = "APP-FAULT",
                  .message = std::string("a fault of the program itself: ") + e.what(),
                  .hint = "please report it, with the input"},
                 kOurFault);
  }
}

/// Whoever plans again and gets nothing must not find a program from before under the name that was promised.
void leave_nothing_stale(Session& s, int code) {
  const bool plans = s.options.command == Command::kPlan || s.options.command == Command::kBind;
  if (!plans || code <= kFindings || code == kLate) return;
  for (const Diagnostic& d : s.job.diagnostics()) {
    // Names that are wrong promise nothing; what was put in place is of this call.
    if (d.code == "OUT-INPUT" || d.code == "OUT-TWICE" || d.code == "FILE-PARTLY") return;
  }
  for (const std::string& path : s.options.outputs) {
    // One name that is wrong does not make the others' programs true.
    if (auto one = service::output_of(path)) put_programs_aside({*std::move(one)}, s.job);
  }
}

}  // namespace

int run(int argc, const char* const* argv) {
  // A reader that closes its end early is no reason to be killed silently.
  std::signal(SIGPIPE, SIG_IGN);
  Parsed parsed = parse_command_line(argc, argv);
  if (!parsed.options) {
    const bool wrong = parsed.ending.code != kDone;
    const bool json = wrong && wants_json({argv + std::min(argc, 1), argv + argc});
    const std::string text = json ? diagnostic_json(parsed.ending.fault) + "\n" : parsed.ending.text;
    std::fputs(text.c_str(), wrong ? stderr : stdout);
    return parsed.ending.code;
  }
  Session session(*std::move(parsed.options));
  const StopsBySignal stops(session);
  const int code = guarded(session);
  leave_nothing_stale(session, code);
  print_diagnostics(session, code);
  return code;
}

}  // namespace capstan::app
