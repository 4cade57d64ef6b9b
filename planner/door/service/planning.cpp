#include "planner/door/service/planning.h"

#include <algorithm>
#include <iterator>
#include <optional>
#include <set>
#include <utility>

#include "casebase/record/sha256.h"
#include "planner/controls/suitability.h"
#include "planner/door/late/late.h"
#include "planner/door/late/measured_names.h"
#include "planner/door/pipeline/cases/corrected_card.h"
#include "planner/door/report/print.h"
#include "planner/door/service/ending/reporting.h"
#include "planner/door/service/reading.h"
#include "planner/door/service/shop.h"
#include "planner/door/service/state/at_machine.h"
#include "planner/door/service/state/axis_limits.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/edits/operator_edits.h"
#include "planner/model/nouns/executable.h"
#include "planner/model/plan/edit/deciding.h"
#include "planner/model/plan/edit/held.h"
#include "planner/model/plan/edit/provenance.h"
#include "planner/proof/verify/program/program_checks.h"
#include "planner/proof/verify/verify.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::service {
namespace {

/// The row of provenance by which a plan says what a control may decide of it.
constexpr std::string_view kMay = "may";

Result<std::string> bytes_of(Source source) {
  return source.bytes ? Result<std::string>(*std::move(source.bytes)) : read_file(source.name);
}

/// Findings of each program among the outputs. One that was checked with its plan, and is the same to the
/// byte, is not checked once more. With another tool table, or none, its text is: what it removes is the
/// same, and nothing was found in that.
std::vector<FileFinding> of_programs(const Planned& planned, const std::vector<Output>& outputs, Job& job) {
  const model::Plan& plan = planned.part ? *planned.part : planned.plan;
  const pipeline::CheckedProgram& known = planned.program;
  std::vector<FileFinding> out;
  for (const Output& o : outputs) {
    if (!is_program(o)) continue;
    std::string table;
    for (const Output& t : outputs) {
      if (t.format->holds == Holds::kToolTable && t.format->control == o.format->control) table = t.bytes;
    }
    const bool checked = !known.text.empty() && o.bytes == known.text;
    if (checked && table == known.tool_table) {
      for (const model::Finding& f : known.findings) out.push_back({o.path, f, true});
      continue;
    }
    if (checked && known.findings.empty()) {
      for (auto& f : verify::check_program_text({o.path, o.bytes, table}, &plan, plan.machine, plan.cutters))
        out.push_back({o.path, std::move(f), true});
      continue;
    }
    const model::CutBefore cut{planned.plan, planned.cut_before};
    for (auto& f : verify::check_program({o.path, o.bytes, table}, &plan, plan.machine, plan.cutters, job,
                                         nullptr, planned.part ? &cut : nullptr))
      out.push_back({o.path, std::move(f), true});
    if (planned.shape == nullptr) continue;
    for (auto& f : verify::check_shape({o.path, o.bytes, table}, plan, *planned.shape))
      out.push_back({o.path, std::move(f), true});
  }
  return out;
}

}  // namespace

std::size_t unplanned_features(const model::Plan& plan) {
  std::set<model::AnyRef> out;
  for (const model::Unplanned& u : plan.unplanned) out.insert(u.feature);
  return out.size();
}

std::size_t features_of(const model::Plan& plan) {
  std::set<model::AnyRef> out;
  for (const model::Unplanned& u : plan.unplanned) out.insert(u.feature);
  for (const model::StepResult& s : plan.steps) {
    const auto* ws = plan.model.get<model::MachiningWorkingstep>(s.step);
    if (ws != nullptr && ws->its_feature.set()) out.insert(ws->its_feature);
  }
  return out.size();
}

Code code_of(const Diagnostic& fault, Code otherwise) {
  const bool usage = fault.code == kUnknownName || fault.code == "MACHINE-GEAR" ||
                     fault.code == "FILE-WRITE" || fault.code.starts_with("MEM-") ||
                     fault.code == "APP-EDGES" || fault.code.starts_with("EDIT-") ||
                     fault.code.starts_with("OPTION-");
  // Wherever the stop came: in reading, planning or writing.
  const bool stopped = fault.code.ends_with("-STOPPED");
  return usage ? Code::kUsage : stopped ? Code::kImpossible : otherwise;
}

namespace {

/// The larger machine for a raw piece that is too large for the usual one as it is drawn. One that is too
/// large for that, too, is told by the check.
std::optional<Request::Suited> machine_for(const PartRead& part) {
  if (part.shape == nullptr) return std::nullopt;
  constexpr double kBesideMm = 25.0;  // a cutter leaves the piece on both sides; default, unsourced
  const auto holds = [&](const model::Machine& m) {
    const auto room = [&](std::size_t i) { return m.axes[i].travel_max_mm - m.axes[i].travel_min_mm; };
    const geometry::Vec3& size = part.raw_mm;
    return size.x + 2.0 * kBesideMm <= room(0) && size.y + 2.0 * kBesideMm <= room(1) && size.z <= room(2);
  };
  Job aside;
  const auto usual = tooling::load_machine(std::string(tooling::kDefaultMachine), aside);
  if (!usual || holds(*usual)) return std::nullopt;
  const auto large = tooling::load_machine(std::string(tooling::kLargeMachine), aside);
  if (!large) return std::nullopt;
  return Request::Suited{large->id, "the raw piece is too large for '" + usual->id + "'"};
}

/// Inch sizes for a part that is drawn in inches.
std::optional<Request::Suited> tools_for(const PartRead& part) {
  if (part.unit != "inch" && part.unit != "inches" && part.unit != "in") return std::nullopt;
  return Request::Suited{std::string(tooling::kGenericInch), "the part is drawn in inches"};
}

/// What `body` gives, an error if the job was stopped before its end.
template <class Body>
Outcome<Planned> to_its_end(const std::string& file, Job& job, Body body) {
  return stoppable(job, body,
                   [&]() -> Outcome<Planned> { return failed(stopped_call(file), Code::kImpossible); });
}

}  // namespace

Outcome<Planned> plan(const Request& request, Source part, Job& job) {
  const std::string name = part.name;
  return to_its_end(name, job, [&]() -> Outcome<Planned> {
    auto bytes = bytes_of(std::move(part));
    if (!bytes) return failed(bytes.error(), code_of(bytes.error(), Code::kUnreadable));
    const std::string hash = casebase::sha256(*bytes);
    const from_cad::Stated stated{
        {request.stock, request.stock_allowance_mm.value_or(0.0)}, request.tapped, request.sign + "tapped"};
    const auto unit = mesh_unit(request.mesh_unit, request.sign + "mesh-unit");
    auto read_part =
        service::read_part(*std::move(bytes), name, stated, job, request.strict, unit, request.body);
    if (!read_part) return failed(read_part.error(), code_of(read_part.error(), Code::kUnreadable));
    if (request.features_only && read_part->shape == nullptr) {
      return failed(
          {.code = "READ-FEATURES",
           .message = request.sign + "features-only is for CAD parts, and the file is none",
           .file = name,
           .expected = "a CAD part in STEP (AP203, AP214 or AP242)",
           .hint = "its features are in the file; " + request.sign + "bind none binds no decision of it"},
          Code::kUsage);
    }
    Request asked = request;
    asked.machine_of_part = machine_for(*read_part);
    asked.tools_of_part = tools_for(*read_part);
    auto inputs = gather(asked, read_part->plan, job);
    if (!inputs) return failed(inputs.error(), code_of(inputs.error(), Code::kUnreadable));
    // The raw piece of a CAD part was made with the allowance; its features begin there.
    if (read_part->shape != nullptr) inputs->stock_allowance_mm.reset();
    for (const from_cad::StatedThread& t : request.tapped)
      inputs->provenance.push_back({"thread", t.text, request.sign + "tapped"});
    if (request.may) {
      std::erase_if(inputs->provenance, [](const auto& p) { return p.what == kMay; });
      inputs->provenance.push_back({std::string(kMay), *request.may, request.sign + std::string(kMay)});
    }
    pipeline::Policy policy;
    policy.reopen = request.reopen;
    policy.bind = request.features_only ? pipeline::Bind::kNone : request.bind;
    auto bound = pipeline::bind_checked(read_part->plan, *inputs, policy, job);
    if (!bound) return failed(bound.error(), code_of(bound.error(), Code::kImpossible));
    pipeline::tell_without_cases(bound->plan, read_part->plan, *inputs, policy, job);
    // What its control is unable to do of the plan as a whole, which concerns no single step.
    for (model::Finding& f : controls::suitability(bound->plan)) {
      if (f.step.empty()) bound->findings.push_back(std::move(f));
    }
    const bool open = policy.bind != pipeline::Bind::kAll;
    if (read_part->shape != nullptr && !open) {
      auto of_shape = verify::check_shape({}, bound->plan, *read_part->shape);
      std::move(of_shape.begin(), of_shape.end(), std::back_inserter(bound->findings));
    }
    Planned out{std::move(bound->plan), std::move(bound->findings), open};
    out.shape = std::move(read_part->shape);
    out.brought_sha256 = hash;
    return out;
  });
}

namespace {

/// What both the plan and the caller allow.
Status decisions_of(const Request& request, const model::Plan& plan, late::Decisions& out) {
  if (request.may) {
    auto asked = late::Decisions::parse(*request.may);
    if (!asked) return tl::unexpected(asked.error());
    out = *asked;
  }
  for (const model::Provenance& p : plan.provenance) {
    if (p.what != kMay) continue;
    auto of_plan = late::Decisions::parse(p.value);
    if (!of_plan) return tl::unexpected(of_plan.error());
    out = out.within(*of_plan);
  }
  return {};
}

/// Why single workingsteps cannot be bound with these edits: values are set into a whole plan. Those that the
/// plan was made with stand in it.
std::optional<Diagnostic> sets_more(const model::Plan& plan, const std::vector<model::Edit>& edits,
                                    bool all) {
  const std::vector<model::Edit> before = model::edits_of(plan);
  const auto without = [](const std::vector<model::Edit>& of, const std::vector<model::Edit>& in) {
    return std::find_if(of.begin(), of.end(), [&](const model::Edit& e) {
      const bool sets = e.kind == model::EditKind::kSet || e.kind == model::EditKind::kPin;
      return sets &&
             std::none_of(in.begin(), in.end(), [&](const auto& x) { return model::says_the_same(x, e); });
    });
  };
  const auto fault = [&](const std::string& what) {
    return Diagnostic{
        .code = "EDIT-NEXT",
        .message = what + "; values change in a whole plan, not while single workingsteps are bound",
        .file = plan.file_name,
        .hint = "bind all of the plan with these edits first, then its workingsteps one by one"};
  };
  if (const auto more = without(edits, before); more != edits.end())
    return fault(model::words_of(*more) + " is not in the plan");
  if (!all) return std::nullopt;
  if (const auto less = without(before, edits); less != before.end())
    return fault(model::words_of(*less) + " is in the plan, and the file of edits takes it back");
  return std::nullopt;
}

/// Sets the operator's edits into a plan before it is bound, and opens what they do not allow: into
/// `edited`, which is left empty where there is nothing to set.
Status edit(const Request& request, const model::Plan& plan, pipeline::Inputs& inputs,
            std::optional<model::Plan>& edited, Job& job) {
  const bool all = model::edits_are_all(inputs.provenance);
  if (inputs.edits.empty() && !all) return {};
  if (request.next || request.from) {
    if (auto wrong = sets_more(plan, inputs.edits, all)) return fail(*std::move(wrong));
    return {};  // limits and prohibitions hold for those that are bound
  }
  edited = plan;
  auto taken = given::take_edits(*edited, inputs.edits, inputs.library, inputs.machine, all, job);
  if (!taken) return tl::unexpected(taken.error());
  inputs.edits = std::move(taken->edits);
  std::erase_if(edited->provenance, model::is_edit);
  for (const model::Edit& e : inputs.edits) edited->provenance.push_back(model::provenance_of(e));
  return given::open_beyond_edits(*edited, inputs.edits, inputs.library, 0, job);
}

/// Closes a plan that was read, in a shop whose choices are taken.
Outcome<Planned> bound(const Request& request, const model::Plan& brought, pipeline::Inputs inputs,
                       std::chrono::steady_clock::time_point began, Job& job) {
  std::optional<controls::Conformance> control;
  if (request.profile) {  // known before anything is planned
    auto named = control_of(request, inputs.machine, job);
    if (!named) return failed(named.error(), code_of(named.error(), Code::kUnreadable));
    control = *std::move(named);
  }
  if (!request.tools) take_tools_of_plan(request, brought, inputs, job);
  // A catalogue says nothing of what is loaded.
  const bool any = std::any_of(inputs.library.begin(), inputs.library.end(),
                               [](const model::Cutter& c) { return c.loaded; });
  if (!any) {
    return failed(
        {.code = "APP-MAGAZINE",
         .message = "no cutter of the library is in the magazine",
         .expected = request.sign + "tools with the machine's tool table (.tbl), or a list that gives tool "
                                    "numbers; or a plan that holds its cutters"},
        Code::kUsage);
  }
  std::optional<model::Plan> edited;
  if (auto ok = edit(request, brought, inputs, edited, job); !ok)
    return failed(ok.error(), code_of(ok.error(), Code::kImpossible));
  const model::Plan& plan = edited ? *edited : brought;
  if (!request.state.tools.empty() && !request.tools)
    return failed(
        {.code = "APP-TOOL-STATE",
         .message = request.sign + "tool-state tells what became of loaded tools, and no tool table "
                                   "says which these are",
         .expected = request.sign + "tools with the machine's tool table"},
        Code::kUsage);
  late::LatePolicy policy;
  policy.tools = request.state.tools;
  policy.tools_told_at = request.state.tools_told_at;
  if (auto ok = decisions_of(request, plan, policy.may); !ok) return failed(ok.error(), Code::kUsage);
  policy.time = request.time;
  policy.deadline = request.deadline;
  policy.began = began;
  policy.allow_findings = request.allow_findings;
  policy.stop_at_deadline = request.stop_at_deadline;
  if (request.measured) {
    auto measured = late::parse_measured(*request.measured);
    if (!measured) return failed(measured.error(), Code::kUsage);
    if (auto ok = late::only_read(plan, *measured); !ok) return failed(ok.error(), Code::kUsage);
    policy.measured = *std::move(measured);
  }
  if (request.next || request.from) policy.next = late::Next{request.next.value_or(1), request.from};
  auto outcome = late::bind(plan, std::move(inputs), policy, job);
  if (!outcome) return failed(outcome.error(), code_of(outcome.error(), Code::kImpossible));
  if (auto left = leaves_limits(request.state, outcome->part ? *outcome->part : outcome->plan,
                                outcome->program.text, outcome->program.tool_table))
    return failed(*std::move(left), Code::kImpossible);
  if (control) {
    const model::Plan& made = outcome->part ? *outcome->part : outcome->plan;
    for (model::Finding& f : unsuited(*control, made, outcome->part.has_value())) {
      if (f.severity == Severity::kError && !request.allow_findings)
        return failed({.code = "LATE-UNSUITED",
                       .message = "the plan does not suit the control '" + *request.profile +
                                  "': " + f.message + " [" + f.code + "]",
                       .file = plan.file_name,
                       .path = f.step,
                       .hint = "retract and stop; plan it for this control, or correct its profile"},
                      Code::kImpossible);
      outcome->of_plan.push_back(std::move(f));
    }
  }
  late::tell_late(*outcome, policy, began, job);
  for (const std::string& what : outcome->reopened) job.note("LATE-REOPENED", what, "");
  return Planned{std::move(outcome->plan),
                 std::move(outcome->of_plan),
                 false,
                 std::move(outcome->program),
                 std::move(outcome->part),
                 outcome->first > 0 ? outcome->first - 1 : 0,
                 outcome->late,
                 std::move(outcome->words)};
}

}  // namespace

Outcome<Planned> bind(const Request& request, Source source, std::chrono::steady_clock::time_point began,
                      Job& job) {
  const std::string name = source.name;
  return to_its_end(name, job, [&]() -> Outcome<Planned> {
    auto bytes = bytes_of(std::move(source));
    if (!bytes) return failed(bytes.error(), code_of(bytes.error(), Code::kUnreadable));
    const std::string hash = casebase::sha256(*bytes);
    auto read_part = read_plan(*std::move(bytes), name, job, request.strict);
    if (!read_part) return failed(read_part.error(), code_of(read_part.error(), Code::kUnreadable));
    auto inputs = gather(request, *read_part, job);
    if (!inputs) return failed(inputs.error(), code_of(inputs.error(), Code::kUnreadable));
    auto out = bound(request, *read_part, *std::move(inputs), began, job);
    if (out) out->brought_sha256 = hash;
    return out;
  });
}

Outcome<Planned> bind_in(const pipeline::Inputs& shop, const Request& request, const model::Plan& plan,
                         std::chrono::steady_clock::time_point began, Job& job) {
  const auto all = [&]() -> Outcome<Planned> {
    poll();
    pipeline::Inputs inputs = shop;
    poll();
    if (auto ok = take_choices(request, plan, inputs, job); !ok)
      return failed(ok.error(), code_of(ok.error(), Code::kUnreadable));
    poll();
    return bound(request, plan, std::move(inputs), began, job);
  };
  return stoppable(job, all, [&]() -> Outcome<Planned> {
    return failed(stopped_bind(request, began, plan.file_name, job), Code::kImpossible);
  });
}

Diagnostic stopped_bind(const Request& request, std::chrono::steady_clock::time_point began,
                        const std::string& file, const Job& job) {
  return late::none_in_time(request.stop_at_deadline, request.deadline, began, file, job)
      .value_or(stopped_call(file));
}

namespace {

/// `judge`, left by a stop.
Result<Verdict> judged(const Request& request, const Planned& planned, std::vector<Output>& outputs,
                       Job& job) {
  const model::Plan& made = planned.part ? *planned.part : planned.plan;
  const auto other = std::find_if(outputs.begin(), outputs.end(), [&](const Output& o) {
    return is_program(o) && !request.state.axis_limits.empty() && is_of_other_control(*o.format, made);
  });
  if (other != outputs.end()) return fail(not_held(*other->format, made));
  Verdict v;
  for (const auto& f : planned.findings) v.findings.push_back({made.file_name, f, false});
  const auto held = model::held_steps(made);
  auto of_text = of_programs(planned, outputs, job);
  for (FileFinding& f : of_text) model::name_edits(held, f.finding);
  std::vector<model::Finding> all = planned.findings;
  for (const FileFinding& f : of_text) all.push_back(f.finding);
  v.condemned = model::condemned(made, all);
  v.written = v.condemned.empty() || (request.allow_findings && !model::never_written(v.condemned));
  if (!v.condemned.empty() && v.written && std::any_of(outputs.begin(), outputs.end(), is_program)) {
    Job silent;  // the writer's warnings were reported when it wrote the first time
    for (Output& o : outputs) {
      if (!is_program(o)) continue;
      auto text = write(made, *o.format, silent, {.condemned = v.condemned});
      if (!text) return tl::unexpected(text.error());
      o.bytes = std::move(text->bytes);
    }
    of_text = of_programs(planned, outputs, job);
    for (FileFinding& f : of_text) model::name_edits(held, f.finding);
  }
  std::move(of_text.begin(), of_text.end(), std::back_inserter(v.findings));
  for (const FileFinding& f : v.findings) {
    if (f.finding.severity != Severity::kNote) ++v.count;
  }
  for (Output& o : outputs) {
    if (o.format->holds != Holds::kReport) continue;
    o.bytes = report_of(request, planned, v, outputs, job);
    if (!o.format->printed) continue;
    auto pdf = report::printed(o.bytes, job);
    if (!pdf) {
      pdf.error().file = o.path;
      return tl::unexpected(pdf.error());
    }
    o.bytes = *std::move(pdf);
  }
  poll();  // what a stopped check did not find is not allowed by --allow-findings
  return v;
}

}  // namespace

Result<Verdict> judge(const Request& request, const Planned& planned, std::vector<Output>& outputs,
                      Job& job) {
  return stoppable(
      job, [&] { return judged(request, planned, outputs, job); },
      [&]() -> Result<Verdict> { return tl::unexpected(stopped_call(planned.plan.file_name)); });
}

}  // namespace capstan::service
