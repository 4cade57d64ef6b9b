#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <stop_token>
#include <utility>

#include "capstan/capstan.h"
#include "planner/door/facade/messages.h"
#include "planner/door/facade/options.h"
#include "planner/door/service/check.h"
#include "planner/door/service/explain/explain.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/planning.h"
#include "planner/door/service/reading.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/physics/motion/time.h"

namespace capstan {
namespace {

PlanMessage message_of(const model::Plan& plan, const model::Condemnation& c) {
  return {to_text(Severity::kError), c.code, model::text_of(plan, c)};
}

PlanMessage message(const service::FileFinding& t, bool named) {
  const model::Finding& f = t.finding;
  const std::string of = named ? t.file + ": " : t.program ? std::string("program: ") : std::string();
  const std::string step = f.step.empty() ? std::string() : "step '" + f.step + "': ";
  return {to_text(f.severity), f.code, of + step + f.message};
}

/// A job that the caller's options give threads, progress and a stop.
class Work {
 public:
  explicit Work(const PlanOptions& o) : stop_(o.stop, [this] { job.request_stop(); }) {
    job.threads = o.threads == 0 ? 1 : o.threads;
    if (o.progress) job.set_progress(o.progress);
  }
  Job job;
  void tell(std::vector<PlanMessage>& diagnostics) const { facade::tell(job, diagnostics); }

 private:
  std::stop_callback<std::function<void()>> stop_;
};

/// The forms of the plan; one that cannot be made is an error among the diagnostics. A tool table goes with
/// its program. `timed`: the call has a deadline.
std::vector<service::Output> forms_of(const service::Planned& planned, const service::Writing& how,
                                      bool timed, Job& job) {
  const model::Plan& plan = planned.plan;
  const bool runs = !plan.steps.empty() && !planned.open;  // what is left open has no program yet
  std::vector<service::Output> out;
  std::set<const controls::Dialect*> without;
  for (const service::Format& f : service::formats()) {
    if (f.write == nullptr) continue;
    if (f.printed) continue;  // a library starts no browser; the report is there to print
    if (f.holds == service::Holds::kPicture && timed) continue;  // a control that waits looks at none
    // Only the machine's own control runs a program of the plan.
    if (f.of_program() && (!runs || !f.is_read_by(plan.machine.control.dialect))) continue;
    if (without.count(f.control) != 0) continue;
    // Of a report that the check has a say in, `judge` makes the only one.
    auto written = f.holds == service::Holds::kReport && !planned.open ? service::Written{}
                                                                       : service::write(plan, f, job, how);
    if (written) {
      out.push_back({f.holds == service::Holds::kProgram ? "program" : std::string(f.name), &f,
                     std::move(written->bytes), written->losses});
    } else {
      job.report(written.error());
      if (f.of_program()) without.insert(f.control);
    }
  }
  return out;
}

void take(std::vector<service::Output> made, PlanOutput& out) {
  for (service::Output& o : made) {
    if (o.format->holds == service::Holds::kToolTable) out.tool_table = o.bytes;
    out.forms[std::string(o.format->name)] = std::move(o.bytes);
  }
  const auto form = [&](const char* name) {
    const auto at = out.forms.find(name);
    return at == out.forms.end() ? std::string() : at->second;
  };
  out.json = form("json");
  out.iso14649 = form("iso14649");
  out.ap238 = form("ap238");
  out.linuxcnc = form("linuxcnc");
}

/// Makes the forms and checks the program, with what is known of the plan. A condemned program is taken back,
/// or written again with its stops.
void finish(const service::Request& request, const service::Planned& planned, PlanOutput& out, Job& job) {
  const model::Plan& plan = planned.plan;
  out.planned = true;
  out.late = planned.late;
  out.steps = plan.steps.size();
  out.unplanned = plan.unplanned.size();
  auto made = forms_of(planned, service::writing_of(request), request.deadline.has_value(), job);
  service::Verdict verdict;
  if (!planned.open) {
    if (auto judged = service::judge(request, planned, made, job)) {
      verdict = *std::move(judged);
    } else {
      job.report(judged.error());
      verdict.written = false;
      std::erase_if(made, [](const auto& o) { return o.format->holds == service::Holds::kReport; });
    }
  }
  for (const service::FileFinding& t : verdict.findings) out.findings.push_back(message(t, false));
  for (const auto& c : verdict.condemned) out.condemned.push_back(message_of(plan, c));
  if (job.stop_requested()) {
    out.planned = false;
    return;
  }
  if (!verdict.written) std::erase_if(made, service::of_program);
  const bool clean = verdict.count == 0 && plan.unplanned.empty() && verdict.condemned.empty() &&
                     model::unreadable(plan).empty();
  if (request.strict && !clean) made.clear();
  take(std::move(made), out);
  if (const auto t = motion::time_of(plan)) out.time_s = t->total_s();
}

PlanOutput done(service::Source source, const PlanOptions& options, bool late) {
  const auto began = std::chrono::steady_clock::now();
  PlanOutput out;
  Work work(options);
  const auto request = facade::request_of(options);
  if (!request) {
    work.job.report(request.error());
  } else if (const auto planned = late ? service::bind(*request, std::move(source), began, work.job)
                                       : service::plan(*request, std::move(source), work.job)) {
    stoppable(
        work.job, [&] { finish(*request, *planned, out, work.job); },
        [&] {
          out = {};
          work.job.report(service::stopped_call({}));
        });
    // Making and checking the forms takes its time, too.
    if (late && request->deadline && work.job.now() - began > *request->deadline) out.late = true;
  } else {
    work.job.report(planned.error().what);
  }
  work.tell(out.diagnostics);
  return out;
}

CheckOutput checked(std::vector<service::Source> sources, const PlanOptions& options) {
  CheckOutput out;
  Work work(options);
  const auto request = facade::request_of(options);
  if (!request) {
    work.job.report(request.error());
  } else if (const auto result = service::check(*request, std::move(sources), {}, work.job)) {
    out.checked = true;
    out.clean = result->clean();
    for (const service::FileFinding& t : result->findings) out.findings.push_back(message(t, true));
  } else {
    work.job.report(result.error().what);
  }
  work.tell(out.diagnostics);
  return out;
}

}  // namespace

PlanOutput plan_bytes(std::string part, const std::string& name, const PlanOptions& options) {
  return done({name, std::move(part)}, options, false);
}
PlanOutput plan_file(const std::string& path, const PlanOptions& options) {
  return done({path}, options, false);
}
PlanOutput bind_bytes(std::string plan, const std::string& name, const PlanOptions& options) {
  return done({name, std::move(plan)}, options, true);
}
PlanOutput bind_file(const std::string& path, const PlanOptions& options) {
  return done({path}, options, true);
}

CheckOutput check_bytes(std::vector<CheckInput> files, const PlanOptions& options) {
  std::vector<service::Source> sources;
  for (CheckInput& f : files) sources.push_back({std::move(f.name), std::move(f.bytes)});
  return checked(std::move(sources), options);
}
CheckOutput check_files(const std::vector<std::string>& paths, const PlanOptions& options) {
  std::vector<service::Source> sources;
  for (const std::string& path : paths) sources.push_back({path});
  return checked(std::move(sources), options);
}

ExplainOutput explain_bytes(std::string plan, const std::string& name, const std::string& step,
                            const std::string& attribute) {
  ExplainOutput out;
  Job job;
  const auto read = service::read_plan(std::move(plan), name, job);
  Result<std::string> text = std::string();
  if (!read)
    text = tl::unexpected(read.error());
  else if (step.empty())
    text = service::explain(*read);
  else
    text = attribute.empty() ? service::explain(*read, step) : service::explain(*read, step, attribute);
  out.explained = text.has_value();
  if (text) out.text = *std::move(text);
  facade::tell(job, out.diagnostics);
  if (!text) out.diagnostics.push_back(facade::message(text.error()));
  return out;
}

std::vector<std::string> option_names() { return facade::option_names(); }

}  // namespace capstan
