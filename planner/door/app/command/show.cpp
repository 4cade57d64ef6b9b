#include "planner/door/app/command/session.h"
#include "planner/door/app/diff/diff.h"
#include "planner/door/app/show/inspect.h"
#include "planner/door/app/show/inspect_shapes.h"
#include "planner/door/service/explain/explain.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/reading.h"
#include "planner/files/exchange/brep/read_brep.h"
#include "planner/ground/base/file.h"

// Commands that read, and say or write what they read.

namespace capstan::app {

using service::explain;

namespace {

/// The requested text is on standard output; notes about the file would only disturb.
void drop_notes(Job& job) {
  for (Diagnostic& d : job.take_diagnostics()) {
    if (d.severity == Severity::kError) job.report(std::move(d));
  }
}

int said(Session& s, const Result<std::string>& text) {
  if (!text) return s.end(text.error(), kUsage);
  return print(*text) ? kDone
                      : s.end({.code = "FILE-WRITE", .message = "standard output is closed"}, kImpossible);
}

int inspect_cad_model(Session& s, std::string bytes) {
  const std::string& file = s.options.files[0];
  if (!s.options.step.empty())
    return s.end({.code = "INS-PATH",
                  .message = "a CAD model has no attributes to walk",
                  .file = file,
                  .hint = "capstan inspect " + file},
                 kUsage);
  const auto shapes = exchange::read_brep_bytes(std::move(bytes), file, {}, s.job);
  if (!shapes) return s.end(shapes.error(), kUnreadable);
  const auto told = s.job.take_diagnostics();
  return said(s, inspect(*shapes, told));
}

}  // namespace

int run_explain(Session& s) {
  const auto plan = service::load_plan(s.options.files[0], s.job);
  if (!plan) return s.end(plan.error(), kUnreadable);
  drop_notes(s.job);
  if (s.options.step.empty()) return said(s, explain(*plan));
  if (s.options.attribute.empty()) return said(s, explain(*plan, s.options.step));
  return said(s, explain(*plan, s.options.step, s.options.attribute));
}

int run_inspect(Session& s) {
  auto bytes = read_file(s.options.files[0]);
  if (!bytes) return s.end(bytes.error(), kUnreadable);
  if (service::is_cad_model(*bytes)) return inspect_cad_model(s, *std::move(bytes));
  const auto plan = service::read_plan(*std::move(bytes), s.options.files[0], s.job);
  if (!plan) return s.end(plan.error(), kUnreadable);
  if (!s.options.step.empty()) {
    drop_notes(s.job);
    return said(s, inspect(*plan, s.options.step));
  }
  // The summary shows what reading said.
  const auto told = s.job.take_diagnostics();
  return said(s, inspect(*plan, told));
}

int run_diff(Session& s) {
  const auto before = service::load_plan(s.options.files[0], s.job);
  if (!before) return s.end(before.error(), kUnreadable);
  const auto after = service::load_plan(s.options.files[1], s.job);
  if (!after) return s.end(after.error(), kUnreadable);
  drop_notes(s.job);
  const Difference d = diff(*before, *after);
  const int code = said(s, d.text);
  return code == kDone && !d.same ? kFindings : code;
}

int run_convert(Session& s) {
  auto outputs = service::outputs_of(s.options.outputs);
  if (!outputs) return s.end(outputs.error(), kUsage);
  for (const service::Output& o : *outputs) {
    if (o.format->of_program())
      return s.end({.code = "OUT-KIND",
                    .message = "a program is planned, not converted",
                    .file = o.path,
                    .hint = "capstan plan PART -o " + o.path},
                   kUsage);
  }
  const auto plan = service::load_plan(s.options.files[0], s.job, false,
                                       service::mesh_unit(s.options.inputs.mesh_unit, "--mesh-unit"));
  if (!plan) return s.end(plan.error(), plan.error().code == "EXC-UNSUPPORTED" ? kUsage : kUnreadable);
  if (auto ok = service::make(*plan, *outputs, s.job, nullptr, service::Reports::kUnjudged,
                              service::writing_of(s.options.inputs));
      !ok)
    return s.end(ok.error(), kImpossible);
  if (auto ok = service::write_all(*outputs, s.job); !ok) return s.end(ok.error(), kImpossible);
  s.summary = "converted " + s.options.files[0];
  for (const service::Output& o : *outputs) {
    if (o.path != "-")
      s.summary += (&o == outputs->data() ? " to " : ", ") + o.path + service::losses_text(o);
  }
  return kDone;
}

}  // namespace capstan::app
