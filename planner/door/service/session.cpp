#include "planner/door/service/session.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <exception>
#include <utility>

#include "planner/door/service/explain/explain.h"
#include "planner/door/service/formats.h"
#include "planner/door/service/options.h"
#include "planner/door/service/reading.h"
#include "planner/door/service/shop.h"
#include "planner/door/service/shop_file/shop_file.h"
#include "planner/door/service/state/at_machine.h"
#include "planner/door/service/state/axis_limits.h"
#include "planner/ground/base/stopping.h"
#include "planner/making/given/listed_steps.h"

namespace capstan::service {
namespace {

/// Options of a binding that nothing of a shop depends on.
constexpr std::array<std::string_view, 9> kOfOneCall = {
    "deadline", "from", "measured", "may", "next", "profile", "stop-at-deadline", "threads", "time"};

/// Options that a bound program is held against before it is given.
constexpr std::array<std::string_view, 3> kHeldAgainst = {"axis-limits", "profile", "work-offset"};

constexpr const char* kNotOpen =
    "error: the session did not open: an option is wrong, as the call that opened it said; set it anew";

/// The option that tells what became of the loaded tools.
constexpr std::string_view kTools = "tool-state";

}  // namespace

Code Session::end(Code code, const std::string& line) {
  if (!line.empty()) message_ += line + "\n";
  code_ = code;
  return code;
}

Code Session::wrong(std::string line) {
  message_.clear();
  return end(Code::kUsage, line);
}

/// Runs a function that may throw; no exception leaves the session.
template <class Body>
Code Session::guarded(Body body) {
  try {
    return body();
  } catch (const std::exception& e) {
    return end(Code::kFault, std::string("error: a fault of the library itself: ") + e.what());
  } catch (...) {
    return end(Code::kFault, "error: a fault of the library itself");
  }
}

Code Session::set(std::string_view name, const std::string& text) {
  return guarded([&] {
    message_.clear();
    if (auto ok = service::set(request_, name, text); !ok) return end(Code::kUsage, to_text(ok.error()));
    if (std::find(kHeldAgainst.begin(), kHeldAgainst.end(), name) != kHeldAgainst.end()) drop_bound();
    if (name == kTools) {
      take_told();
      return end(Code::kDone);
    }
    if (std::find(kOfOneCall.begin(), kOfOneCall.end(), name) == kOfOneCall.end()) {
      if (shop_ && in_shop_ && !in_shop_->rules) shipped_rules_ = std::move(shop_->rules);
      shop_.reset();
      in_shop_.reset();
      failed_ = false;
    } else if (in_shop_) {
      if (auto ok = service::set(*in_shop_, name, text); !ok) return end(Code::kUsage, to_text(ok.error()));
    }
    return end(Code::kDone);
  });
}

Code Session::tell_tools(const std::string& states) {
  return guarded([&] {
    message_.clear();
    auto told = late::parse_tool_states(states, std::string(kTools));
    if (!told) return end(Code::kUsage, to_text(told.error()));
    request_.state.tools = *std::move(told);
    take_told();
    return end(Code::kDone);
  });
}

void Session::take_told() {
  request_.state.tools_told_at = 0;
  if (in_shop_) {
    in_shop_->state.tools = request_.state.tools;
    in_shop_->given.insert(std::string(kTools));
  }
  drop_bound();
}

void Session::drop_bound() {
  if (goes_on_from_bound()) last_ = std::move(bound_->plan);
  bound_.reset();
  outputs_.clear();
}

bool Session::goes_on_from_bound() const { return bound_ && !taken_since_ && !bound_->late; }

const model::Plan* Session::at_hand() const {
  if (bound_ && !taken_since_ && !bound_->late) return &bound_->plan;
  if (last_) return &*last_;
  return read_ ? &read_->plan : nullptr;
}

Code Session::opened(Job& job) {
  if (shop_) return Code::kDone;
  if (!in_shop_) {
    auto with = with_shop(request_, job);
    for (const auto& d : job.take_diagnostics()) message_ += to_text(d) + "\n";
    failed_ = !with;
    if (!with) return end(code_of(with.error(), Code::kUsage), to_text(with.error()));
    in_shop_ = *std::move(with);
  }
  auto shop = open_shop(*in_shop_, model::Plan{}, job, shipped_rules_ ? &*shipped_rules_ : nullptr);
  for (const auto& d : job.take_diagnostics()) message_ += to_text(d) + "\n";
  failed_ = !shop;
  if (!shop) return end(Code::kUnreadable, to_text(shop.error()));
  shop_ = *std::move(shop);
  // What one call found out, the next one need not, also with another tool table.
  if (!shop_->memo) shop_->memo = memo_;
  shop_->proofs = proofs_;
  shop_->outlines = outlines_;
  return Code::kDone;
}

Outcome<const model::Plan*> Session::read(std::string plan, Job& job) {
  if (!read_ || read_->text != plan) {
    read_.reset();
    auto made = read_plan(plan, "plan", job, request_.strict);
    if (!made) return failed(made.error(), code_of(made.error(), Code::kUnreadable));
    read_ = Read{std::move(plan), *std::move(made), job.take_diagnostics()};
  }
  for (const Diagnostic& d : read_->said) job.report(d);
  return &read_->plan;
}

Code Session::open() {
  return guarded([&] {
    message_.clear();
    Job job;
    return end(opened(job));
  });
}

Code Session::take(std::string plan) {
  return guarded([&] {
    last_.reset();
    goes_on_ = false;
    taken_since_ = true;
    run_.plan_changed(false);
    message_.clear();
    if (plan.empty()) return end(Code::kUsage, "error: there is no plan");
    Job job;
    const auto at_hand = read(std::move(plan), job);
    for (const auto& d : job.take_diagnostics()) message_ += to_text(d) + "\n";
    if (!at_hand) return end(at_hand.error().code, to_text(at_hand.error().what));
    goes_on_ = true;
    return end(Code::kDone);
  });
}

std::vector<std::string> Session::left_open() const {
  const model::Plan* plan = at_hand();
  return plan == nullptr ? std::vector<std::string>{} : open_texts(*plan);
}

template <class Ask>
Code Session::asked(Ask ask) {
  return guarded([&] {
    message_.clear();
    const model::Plan* plan = at_hand();
    if (plan == nullptr) return end(Code::kUsage, "error: there is no plan");
    if (failed_) return end(Code::kUsage, kNotOpen);
    Job job;
    if (const Code code = opened(job); code != Code::kDone) return end(code);
    const Code code = ask(*plan, job);
    for (const auto& d : job.take_diagnostics()) message_ += to_text(d) + "\n";
    return end(code);
  });
}

Code Session::no_longer_valid(std::vector<std::string>& out) {
  out.clear();
  return asked([&](const model::Plan& plan, Job& job) {
    auto said = service::no_longer_valid(*shop_, *in_shop_, plan, job);
    if (!said) return end(said.error().code, to_text(said.error().what));
    out = *std::move(said);
    return Code::kDone;
  });
}

Code Session::unsuited(std::vector<std::string>& out) {
  out.clear();
  return asked([&](const model::Plan& plan, Job& job) {
    const auto control = control_of(*in_shop_, shop_->machine, job);
    if (!control) return end(code_of(control.error(), Code::kUnreadable), to_text(control.error()));
    for (const model::Finding& f : service::unsuited(*control, plan, false))
      out.push_back(
          to_text(Diagnostic{.code = f.code,
                             .severity = f.severity,
                             .message = (f.step.empty() ? "" : "step '" + f.step + "': ") + f.message}));
    return Code::kDone;
  });
}

Code Session::tell(const ControlEvent& event, bool over, std::vector<BroadcastLine>& due) {
  due.clear();
  return guarded([&] {
    message_.clear();
    auto lines = run_.tell(event, over, [&] { return broadcasts(DefaultContent{}); });
    if (!lines) return end(Code::kUsage, to_text(lines.error()));
    due = *std::move(lines);
    return end(Code::kDone);
  });
}

Code Session::bind(std::string plan, std::optional<std::chrono::milliseconds> deadline) {
  return guarded([&] {
    last_.reset();
    goes_on_ = false;
    run_.plan_changed(false);
    Request request = request_;
    if (deadline) request.deadline = deadline;
    return bind_as(std::move(plan), std::move(request));
  });
}

Code Session::bind_next(std::string plan, std::size_t from, std::size_t count,
                        std::optional<std::chrono::milliseconds> deadline) {
  return guarded([&] {
    if (!plan.empty()) {
      last_.reset();
      goes_on_ = false;
    }
    // Behind the first, the text is that of the same plan as far as it was bound.
    run_.plan_changed(plan.empty() || from > 1);
    Request request = request_;
    if (deadline) request.deadline = deadline;
    request.next = std::max<std::size_t>(1, count);
    request.from = from == 0 ? std::nullopt : std::optional(from);
    return bind_as(std::move(plan), std::move(request));
  });
}

Code Session::bind_as(std::string plan, Request request) {
  const auto began = std::chrono::steady_clock::now();
  return guarded([&] {
    // The plan that the last bind gave is what the next one goes on with; after a late one, whose steps
    // nobody may have cut, that which it began with.
    if (plan.empty() && goes_on_from_bound()) last_ = std::move(bound_->plan);
    bound_.reset();
    outputs_.clear();
    message_.clear();
    const model::Plan* so_far = last_ ? &*last_ : goes_on_ && read_ ? &read_->plan : nullptr;
    if (plan.empty() && so_far == nullptr) return end(Code::kUsage, "error: there is no plan");
    if (failed_) return end(Code::kUsage, kNotOpen);
    Job job;
    job.threads = request_.threads;
    job.set_progress(progress_);
    if (request.stop_at_deadline && request.deadline) job.set_deadline(began + *request.deadline);
    // `stop` finds either this job or none.
    struct Running {
      Session& s;
      Running(Session& session, Job& one) : s(session) {
        const std::lock_guard lock(s.mutex_);
        s.running_ = &one;
      }
      Running(const Running&) = delete;
      Running& operator=(const Running&) = delete;
      ~Running() {
        const std::lock_guard lock(s.mutex_);
        s.running_ = nullptr;
      }
    } const running(*this, job);
    if (const Code code = opened(job); code != Code::kDone) return code;
    // What the shop's settings say beside the options of this call.
    Request asked = *in_shop_;
    asked.deadline = request.deadline;
    asked.next = request.next;
    asked.from = request.from;
    asked.state.tools_told_at = request_.state.tools_told_at;
    std::size_t heard = 0;
    const auto at_hand = [&]() -> Outcome<const model::Plan*> {
      if (plan.empty()) {
        // What reading said of it holds still, so that an edited step is not bound; the caller has heard it.
        if (read_) {
          for (const Diagnostic& d : read_->said) job.report(d);
        }
        heard = job.diagnostics().size();
        return so_far;
      }
      return stoppable(
          job, [&] { return read(std::move(plan), job); },
          [&]() -> Outcome<const model::Plan*> {
            return failed(stopped_bind(request, began, "plan", job), Code::kImpossible);
          });
    }();
    if (at_hand && request.next) goes_on_ = true;
    auto bound = at_hand ? bind_in(*shop_, asked, **at_hand, began, job)
                         : Outcome<Planned>(tl::unexpected(at_hand.error()));
    const auto said = job.take_diagnostics();
    for (std::size_t i = heard; i < said.size(); ++i) message_ += to_text(said[i]) + "\n";
    if (!bound) return end(bound.error().code, to_text(bound.error().what));
    bound_ = *std::move(bound);
    taken_since_ = false;
    // Lives were told before the first of the steps that are bound since.
    if (bound_->part && request_.state.tools_told_at == 0)
      request_.state.tools_told_at = bound_->cut_before + 1;
    return end(bound_->late ? Code::kLate : Code::kDone);
  });
}

void Session::stop() {
  const std::lock_guard lock(mutex_);
  if (running_ != nullptr) running_->request_stop();
}

const std::string* Session::output(std::string_view name) {
  const Format* format = find_format(name);
  if (!bound_ || format == nullptr) return nullptr;
  if (const auto at = outputs_.find(name); at != outputs_.end()) return &at->second;
  // What was checked is given as it was checked.
  const pipeline::CheckedProgram& checked = bound_->program;
  const bool of_machine =
      format->of_program() && format->control == controls::find_dialect(bound_->plan.machine.control.dialect);
  const std::string& text = format->holds == Holds::kProgram ? checked.text : checked.tool_table;
  if (of_machine && !checked.text.empty() && !text.empty()) return &text;
  const std::string* made = nullptr;
  guarded([&] {
    if (format->holds == Holds::kProgram && !request_.state.axis_limits.empty() &&
        is_of_other_control(*format, bound_->plan))
      return end(Code::kImpossible, to_text(not_held(*format, bound_->plan)));
    Job job;
    auto written = write(plan_for(*bound_, *format), *format, job, writing_of(request_));
    if (!written) return end(Code::kImpossible, to_text(written.error()));
    made = &outputs_.emplace(name, std::move(written->bytes)).first->second;
    return code_;
  });
  return made;
}

std::optional<Broadcasts> Session::broadcasts(const std::optional<DefaultContent>& otherwise) const {
  const model::Plan* plan = at_hand();
  return plan == nullptr ? std::nullopt : std::optional<Broadcasts>(std::in_place, *plan, otherwise);
}

std::size_t Session::steps() const { return bound_ ? given::steps_in_order(bound_->plan).size() : 0; }

double Session::machining_s() const {
  double t = 0.0;
  if (bound_) {
    for (const auto& s : (bound_->part ? *bound_->part : bound_->plan).steps) t += s.cutting_s + s.rapid_s;
  }
  return t;
}

}  // namespace capstan::service
