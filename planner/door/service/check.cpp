#include "planner/door/service/check.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "planner/controls/controls.h"
#include "planner/controls/profile/profile.h"
#include "planner/controls/specification.h"
#include "planner/controls/suitability.h"
#include "planner/door/late/unbound.h"
#include "planner/door/pipeline/pipeline.h"
#include "planner/door/service/ending/last_line.h"
#include "planner/door/service/formats.h"
#include "planner/door/service/outputs.h"
#include "planner/door/service/reading.h"
#include "planner/door/service/shop.h"
#include "planner/door/service/shop_tools/program_machine.h"
#include "planner/door/service/shop_tools/tool_materials.h"
#include "planner/files/exchange/conformance/check.h"
#include "planner/files/exchange/toolpaths/curves.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/foreign/foreign_file.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/plan/decision/condemned.h"
#include "planner/model/plan/decision/contradicted.h"
#include "planner/model/plan/decision/edited.h"
#include "planner/model/plan/decision/unreadable.h"
#include "planner/proof/verify/program_signs.h"
#include "planner/proof/verify/verify.h"
#include "tooling/library/library.h"
#include "tooling/shop/machine/machine.h"

namespace capstan::service {
namespace {

struct Input {
  std::string path, bytes;
  Content content = Content::kProgram;
};

/// Machine, tools and tool table that programs are checked against.
struct Shop {
  model::Machine machine;
  std::vector<model::Cutter> cutters;
  std::string tool_table;
};

class Check {
 public:
  Check(const Request& request, std::vector<Source> sources,
        const std::function<void(const FileFinding&)>& tell, Job& job)
      : request_(request), sources_(std::move(sources)), tell_(tell), job_(job) {}

  Outcome<CheckResult> run() {
    auto fault = read();
    if (!fault) {
      parts_.emplace_back();
      fault = shop();
      parts_.back().said = job_.take_diagnostics();
    }
    if (!fault) add_programs();
    check_parts();
    tell_parts();
    if (fault) return failed(*fault, code_of(*fault, Code::kUnreadable));
    if (out_.checked == 0)
      return failed(
          {.code = "APP-NOTHING", .message = "there is neither a plan nor a program among the files"},
          Code::kUsage);
    return std::move(out_);
  }

 private:
  /// What is said of one file, in this order; the parts in the order of the files.
  struct Part {
    std::vector<Diagnostic> said;         ///< by reading it
    std::vector<FileFinding> found;       ///< by reading it, too, which told them as diagnostics
    std::vector<model::Finding> brought;  ///< of the plan before what is open in it is closed
    std::string file;                     ///< of what is to be checked; empty: nothing is
    std::optional<std::size_t> plan;      ///< of `plans_`
    const Input* program = nullptr;       ///< of `inputs_`
    std::vector<model::Finding> findings;
    bool done = false;  ///< checked, to its end or to a stop
  };

  void add_programs() {
    for (const Input& in : inputs_) {
      if (in.content != Content::kProgram) continue;
      ++out_.checked;
      parts_.emplace_back();
      parts_.back().file = in.path;
      parts_.back().program = &in;
    }
  }

  /// A plan and its programs are checked at once where there are threads for it: no check knows of another.
  void check_parts() {
    std::vector<Part*> checked;
    for (Part& p : parts_) {
      if (!p.file.empty()) checked.push_back(&p);
    }
    const auto all = [&] {
      parallel_for(job_, checked.size(), [&](std::size_t i) {
        Part& p = *checked[i];
        Job silent;  // one of them tells how far it is; a stop of `job_` ends all
        check(p, i == 0 ? job_ : silent);
        p.done = true;
      });
    };
    // After a stop the findings so far are reported; of each part not looked at, that nothing is proven.
    stoppable(job_, all, [&] {
      for (Part* p : checked) {
        if (!p->done) p->findings.push_back(verify::not_begun());
      }
    });
  }

  void check(Part& p, Job& job) const {
    if (p.plan) {
      const model::Plan& plan = plans_[*p.plan];
      const auto open = late::unbound_steps(plan);
      const model::CutBefore none{plan, 0};  // the rest is to come
      p.findings = verify::check_plan(plan, job, nullptr, open.empty() ? nullptr : &none);
      if (!open.empty()) p.findings.push_back(late::not_bound(plan, open));
      auto more = beside_the_check(plan);
      auto other = other_tool_materials(plan, loaded_);
      if (control_) {
        auto unsuited = controls::suitability(plan, *control_);
        std::move(unsuited.begin(), unsuited.end(), std::back_inserter(more));
      }
      std::move(other.begin(), other.end(), std::back_inserter(more));
      std::move(more.begin(), more.end(), std::back_inserter(p.findings));
    } else {
      check_program(p, job);
    }
  }

  /// A program of a plan that is bound in part has some of its bound steps: it is held against these.
  void check_program(Part& p, Job& job) const {
    const verify::ProgramText text{p.program->path, p.program->bytes, shop_.tool_table};
    const model::Plan* plan = plans_.empty() ? nullptr : &plans_.front();
    std::optional<late::PartOfPlan> part;
    if (plan != nullptr && !late::unbound_steps(*plan).empty())
      part = late::part_of(*plan, verify::steps_of_program(text.text, shop_.machine));
    if (!part) {
      p.findings = verify::check_program(text, plan, shop_.machine, shop_.cutters, job);
      return;
    }
    const model::CutBefore before{*plan, part->before};
    p.findings =
        verify::check_program(text, &part->plan, shop_.machine, shop_.cutters, job, nullptr, &before);
    if (part->before > 0) p.findings.push_back(late::taken_as_cut(*part));
  }

  void tell_parts() {
    auto last = job_.take_diagnostics();
    for (Part& p : parts_) {
      for (Diagnostic& d : p.said) job_.report(std::move(d));
      for (FileFinding& f : p.found) out_.findings.push_back(std::move(f));
      add(p.brought, p.file, false);
      add(p.findings, p.file, p.program != nullptr);
    }
    for (Diagnostic& d : last) job_.report(std::move(d));
  }

  /// Whether there is something to check at all: planned steps with their paths.
  static bool has_paths(const model::Plan& plan) {
    bool any = false;
    for (const auto& step : plan.steps) {
      if (step.path == nullptr) return false;
      any = true;
    }
    return any;
  }

  using Stated = std::map<model::AnyRef, exchange::StepPath>;

  static Stated stated_paths(const model::Plan& plan) {
    Stated out;
    Job quiet;  // executing says again what is wrong with a path
    for (const auto step : plan.model.all_below(model::TypeId::kMachiningWorkingstep)) {
      auto path = exchange::path_of_step(plan, model::Ref<model::Executable>(step), {}, quiet, &plan.steps);
      if (path && path->path.size() > 0) out.emplace(step, *std::move(path));
    }
    return out;
  }

  /// Reports steps whose path was computed anew; they are not judged by the file's data. True if the file
  /// states every path, and none was computed anew.
  bool tell_recomputed(const Stated& stated, const model::Plan& bound) {
    bool all_stated = true;
    for (const auto& step : bound.steps) {
      const auto it = stated.find(step.step);
      if (it == stated.end() || step.path == nullptr) {
        all_stated = false;
        continue;
      }
      const auto& said = it->second.schedule.feed_mm_min;
      bool same = it->second.path == *step.path;
      for (std::size_t i = 0; same && step.schedule && i < said.size(); ++i)
        same = !(said[i] > 0.0) || said[i] == step.schedule->feed_mm_min[i];
      if (same) continue;
      all_stated = false;
      job_.warn("APP-RECOMPUTED", "step '" + model::step_id(bound, step) +
                                      "': its path or feeds were computed anew and are not those of the "
                                      "file; the findings are about the new ones");
    }
    return all_stated;
  }

  /// Completes a file that states its steps but not all their values: open decisions are bound as `plan`
  /// would, stated values are executed as given, because the ledger prevents computing them again.
  Result<model::Plan> executed(model::Plan plan) {
    Request own = request_;
    if (has_data(plan.machine)) {
      own.machine = of_call("machine", own.machine);
      own.control = of_call("control", own.control);
    }
    const auto inputs = gather(own, plan, job_);
    if (!inputs) return tl::unexpected(inputs.error());
    const auto unreadable = model::unreadable(plan);
    const auto contradictions = model::contradictions(plan);
    plan.ledger = model::Ledger{};
    for (const auto& c : contradictions) model::set_contradicted(plan, c.key.object, c.key.attribute, c.why);
    for (const auto& u : unreadable) model::set_unreadable(plan, u.key.object, u.key.attribute, u.why);
    const auto stated = stated_paths(plan);
    auto bound = pipeline::bind(std::move(plan), *inputs, pipeline::Policy{}, job_);
    if (!bound) return bound;
    out_.unplanned += unplanned_features(*bound);
    if (!tell_recomputed(stated, *bound)) ++out_.planned_anew;
    return bound;
  }

  /// An AP238 file with --schema: compared with the EXPRESS dictionary instance by instance, not executed.
  std::optional<Diagnostic> compare_with_schema(Input& in) {
    const auto file = p21::parse(std::move(in.bytes), in.path, {}, job_);
    if (!file) return file.error();
    const std::size_t before = job_.diagnostics().size();
    out_.schema += exchange::check_schema(*file, job_);
    ++out_.checked;
    ++out_.compared;
    const auto& all = job_.diagnostics();
    for (std::size_t i = before; i < all.size(); ++i) {
      const std::string instance = all[i].instance == 0 ? "" : "#" + std::to_string(all[i].instance) + " ";
      const std::string path = all[i].path.empty() ? "" : all[i].path + ": ";
      const std::string expected = all[i].expected.empty() ? "" : "; expected " + all[i].expected;
      model::Finding f;
      f.code = all[i].code;
      f.severity = all[i].severity;
      f.message = instance + path + all[i].message + expected;
      parts_.back().found.push_back({.file = in.path, .finding = std::move(f), .schema = true});
    }
    return std::nullopt;
  }

  /// A drawing or the like, which is read as a program else.
  static std::optional<Diagnostic> neither_plan_nor_program(const Input& in) {
    const auto foreign = in.content == Content::kProgram ? foreign_file(in.bytes) : std::nullopt;
    if (!foreign || foreign->program) return std::nullopt;
    return Diagnostic{
        .code = "READ-FOREIGN",
        .message = "this is " + std::string(foreign->what) + ", which is no plan and no program",
        .file = in.path,
        .expected =
            "a plan, the program of a control (" + endings_of(Holds::kProgram) + "), or its tool table",
        .hint = "name the plan or program that was written for the part"};
  }

  /// Content of no other kind is a program. A file whose ending belongs to another kind is no program.
  static std::optional<Diagnostic> not_what_it_is_called(const Input& in) {
    const Format* format = format_of_ending(std::filesystem::path(in.path).extension().string());
    if (in.content != Content::kProgram || format == nullptr || format->holds == Holds::kProgram)
      return std::nullopt;
    const bool empty = in.bytes.find_first_not_of(" \t\r\n") == std::string::npos;
    return Diagnostic{
        .code = "APP-CONTENT",
        .message = empty ? "the file is empty" : "its content is not what its name says",
        .file = in.path,
        .expected = std::string(format->words) + ", as the ending says",
        .hint = "write it again; a program has an ending of its own (" + endings_of(Holds::kProgram) + ")"};
  }

  std::optional<Diagnostic> read() {
    for (Source& source : sources_) {
      Result<std::string> bytes =
          source.bytes ? Result<std::string>(*std::move(source.bytes)) : read_file(source.name);
      if (!bytes) return bytes.error();
      const Content content = content_of(*bytes);
      inputs_.push_back({source.name, *std::move(bytes), content});
      if (const auto d = neither_plan_nor_program(inputs_.back())) return d;
      if (const auto d = not_what_it_is_called(inputs_.back())) return d;
      if (content == Content::kToolTable) shop_.tool_table = inputs_.back().bytes;
    }
    for (Input& in : inputs_) {
      if (in.content != Content::kPlanJson && in.content != Content::kPart) continue;
      // What was said before belongs to the file before.
      if (!parts_.empty()) parts_.back().said = job_.take_diagnostics();
      parts_.emplace_back();
      if (request_.schema && exchange::declares_ap238(in.bytes)) {
        if (const auto d = compare_with_schema(in)) return d;
        continue;
      }
      const std::size_t before = job_.diagnostics().size();
      auto plan = read_plan(std::move(in.bytes), in.path, job_);
      if (!plan) return plan.error();
      if (request_.schema) out_.schema += job_.diagnostics().size() - before;
      out_.errors += reading_errors(job_.diagnostics(), before);
      const bool values_edited = take_edits(before, in.path);
      if (const auto d = hold_against_control(*plan)) return d;
      ++out_.checked;
      // Results computed before a value was edited do not describe the plan as it is now.
      if (!has_paths(*plan) || values_edited) {
        const std::size_t said = job_.diagnostics().size();
        plan = executed(*std::move(plan));
        if (!plan) return plan.error();
        out_.errors += reading_errors(job_.diagnostics(), said);
      }
      out_.left_out += unplanned_features(*plan);
      out_.features += features_of(*plan);
      // A plan made for one machine may be checked for another.
      if (const auto named = of_call("machine", request_.machine)) {
        auto machine = tooling::load_machine(*named, job_);
        if (!machine) return machine.error();
        plan->machine = *std::move(machine);
      }
      parts_.back().file = in.path;
      parts_.back().plan = plans_.size();
      plans_.push_back(*std::move(plan));
    }
    if (!parts_.empty()) parts_.back().said = job_.take_diagnostics();
    return std::nullopt;
  }

  /// With --profile: what the control must be told that the plan does not say, or says twice. What the
  /// planner would close is open still.
  std::optional<Diagnostic> hold_against_control(const model::Plan& plan) {
    if (!request_.profile) return std::nullopt;
    if (!control_) {
      auto read = controls::load_profile(*request_.profile, job_);
      if (!read) return read.error();
      control_ = std::move(read->can);
    }
    parts_.back().brought = controls::specification(plan, *control_);
    return std::nullopt;
  }

  /// Finds a file that was edited after it was written, for it contains results of the old values. Its reader
  /// has reported this already; two different statements of one value are an error here. True if edited
  /// values determine others.
  bool take_edits(std::size_t before, const std::string& file) {
    bool values = false;
    auto all = job_.take_diagnostics();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const model::ReportedEdit told =
          i < before ? model::ReportedEdit::kNothing : model::reported_edit_of(all[i]);
      values = values || told == model::ReportedEdit::kValue;
      if (told == model::ReportedEdit::kDisagrees) all[i].severity = Severity::kError;
      if (told == model::ReportedEdit::kPart || told == model::ReportedEdit::kDisagrees) {
        model::Finding f;
        f.code = all[i].code;
        f.severity = all[i].severity;
        f.message = all[i].message;
        ++out_.count;
        parts_.back().found.push_back({file, std::move(f)});
      }
      job_.report(std::move(all[i]));
    }
    return values;
  }

  /// Reasons in the plan's own record that condemn it, as findings.
  static std::vector<model::Finding> beside_the_check(const model::Plan& plan) {
    std::vector<model::Finding> out;
    for (auto& c : model::condemned(plan, {})) {
      model::Finding f;
      f.code = std::move(c.code);
      f.step = std::move(c.step);
      f.message = std::move(c.text);
      out.push_back(std::move(f));
    }
    return out;
  }

  /// A value that the call itself gives, and not the shop's settings.
  [[nodiscard]] std::optional<std::string> of_call(const std::string& name,
                                                   const std::optional<std::string>& value) const {
    return request_.from_shop.contains(name) ? std::nullopt : value;
  }
  /// The same beside a plan, whose own machine, control and tools hold before those of the shop's settings.
  [[nodiscard]] std::optional<std::string> asked(const std::string& name,
                                                 const std::optional<std::string>& value) const {
    return plans_.empty() ? value : of_call(name, value);
  }

  std::optional<Diagnostic> shop() {
    const bool has_plan = !plans_.empty();
    const auto named = asked("machine", request_.machine), tools = asked("tools", request_.tools);
    const auto control = asked("control", request_.control);
    if (has_plan) {
      shop_.machine = plans_.front().machine;
      shop_.cutters = plans_.front().cutters;
    }
    if (named || !has_data(shop_.machine)) {
      const bool stated = of_call("machine", request_.machine).has_value();
      auto machine = tooling::load_machine(
          machine_for_programs(named ? named : request_.machine, stated, programs(), job_), job_);
      if (!machine) return machine.error();
      shop_.machine = *std::move(machine);
    }
    if (control) shop_.machine = controls::with_control(std::move(shop_.machine), *control);
    if (const auto d = take_control_of_programs(has_plan)) return d;
    const tooling::LibraryOptions counts{
        .mm_per_unit = {}, .offsets_against_reference = shop_.machine.control.offsets_against_reference};
    if (tools) {
      auto library = tooling::load_library(*tools, job_, counts);
      if (!library) return library.error();
      shop_.cutters = *std::move(library);
      if (has_plan) loaded_ = shop_.cutters;
    } else if (!has_plan && !shop_.tool_table.empty()) {
      auto table = tooling::read_tool_table(shop_.tool_table, "tool table", job_, counts);
      if (!table) return table.error();
      shop_.cutters = *std::move(table);
    } else if (has_plan && !shop_.tool_table.empty()) {
      // What cannot be read of it the check of the table says.
      Job quiet;
      if (auto table = tooling::read_tool_table(shop_.tool_table, "tool table", quiet, counts))
        loaded_ = *std::move(table);
    }
    return std::nullopt;
  }

  /// Where no control is named, a program that only another control reads is checked for that one; beside a
  /// plan or a named machine, which say otherwise, it is refused.
  std::optional<Diagnostic> take_control_of_programs(bool has_plan) {
    if (asked("control", request_.control)) return std::nullopt;
    const bool free = !has_plan && !request_.machine;
    std::string told_by;
    for (const Input& in : inputs_) {
      if (in.content != Content::kProgram) continue;
      const auto sign = verify::dialect_sign(in.bytes);
      const std::string& dialect = shop_.machine.control.dialect;
      if (!sign || std::find(sign->dialects.begin(), sign->dialects.end(), dialect) != sign->dialects.end())
        continue;
      const std::string other(sign->dialects.front());
      if (!free || !told_by.empty())
        return Diagnostic{.code = "OPTION-CONTROL",
                          .message = "the program is written for " + name_of_control(other) + " (" +
                                     sign->text + "), and " +
                                     (told_by.empty() ? has_plan ? "the plan" : "the machine" : told_by) +
                                     " for " + name_of_control(dialect),
                          .file = in.path,
                          .line = static_cast<std::uint64_t>(sign->line),
                          .hint = "name its control (" + request_.sign + "control " + other + ")" +
                                  (told_by.empty() ? "" : ", or check the programs one by one")};
      shop_.machine = controls::with_control(std::move(shop_.machine), other);
      told_by = in.path;
      job_.note("APP-CONTROL", in.path + " is read as a program of " + name_of_control(other) + ", for " +
                                   sign->text + " is in line " + std::to_string(sign->line) + "; " +
                                   request_.sign + "control names another");
    }
    return std::nullopt;
  }

  static std::string name_of_control(const std::string& dialect) {
    const controls::Dialect* d = controls::find_dialect(dialect);
    return d == nullptr ? dialect : std::string(d->name);
  }

  [[nodiscard]] std::vector<NamedProgram> programs() const {
    std::vector<NamedProgram> out;
    for (const Input& in : inputs_) {
      if (in.content == Content::kProgram) out.push_back({in.path, in.bytes});
    }
    return out;
  }

  void add(const std::vector<model::Finding>& findings, const std::string& file, bool program) {
    for (const auto& f : findings) {
      if (f.severity != Severity::kNote) ++out_.count;
      out_.findings.push_back({file, f, program});
      if (tell_) tell_(out_.findings.back());
    }
  }

  const Request& request_;
  std::vector<Source> sources_;
  const std::function<void(const FileFinding&)>& tell_;
  Job& job_;
  std::vector<Input> inputs_;
  std::vector<model::Plan> plans_;
  std::vector<Part> parts_;
  Shop shop_;
  std::vector<model::Cutter> loaded_;  ///< what a library or tool table beside a plan says of its tools
  std::optional<controls::Conformance> control_;  ///< that the request names
  CheckResult out_;
};

}  // namespace

Outcome<CheckResult> check(const Request& request, std::vector<Source> sources,
                           const std::function<void(const FileFinding&)>& tell, Job& job) {
  const std::string first = sources.empty() ? std::string() : sources.front().name;
  return stoppable(
      job, [&] { return Check(request, std::move(sources), tell, job).run(); },
      [&]() -> Outcome<CheckResult> { return failed(stopped_call(first), Code::kImpossible); });
}

}  // namespace capstan::service
