#include <array>
#include <chrono>
#include <exception>
#include <new>
#include <optional>
#include <string>

#include "capstan/capstan_late.h"
#include "planner/door/late/late.h"
#include "planner/door/pipeline/given/shop.h"

/// A session behind the C interface.
struct capstan_late {
  std::optional<capstan::pipeline::Inputs> inputs;
  std::optional<capstan::late::LateOutcome> outcome;
  std::array<std::string, 5> outputs;
  std::string message;
  capstan_late_code code = CAPSTAN_LATE_OK;
};

namespace {

using capstan::Job;

void say(capstan_late& s, Job& job) {
  for (const auto& d : job.take_diagnostics()) s.message += capstan::to_text(d) + "\n";
}

capstan_late_code end(capstan_late& s, capstan_late_code code, const std::string& line = {}) {
  if (!line.empty()) s.message += line + "\n";
  s.code = code;
  return code;
}

/// Runs what may throw; no exception leaves the library.
template <class Body>
capstan_late_code guarded(capstan_late& s, Body body) {
  try {
    return body();
  } catch (const std::exception& e) {
    return end(s, CAPSTAN_LATE_FAULT, std::string("error: a fault of the library itself: ") + e.what());
  } catch (...) {
    return end(s, CAPSTAN_LATE_FAULT, "error: a fault of the library itself");
  }
}

bool is_unreadable(const std::string& code) {
  return code.starts_with("P21-") || code.starts_with("EXC-") || code.starts_with("FILE-") ||
         code.starts_with("JSON-");
}

}  // namespace

capstan_late* capstan_late_open(const char* machine, const char* tools) {
  auto* s = new (std::nothrow) capstan_late;
  if (s == nullptr) return nullptr;
  guarded(*s, [&] {
    if (machine == nullptr || tools == nullptr)
      return end(*s, CAPSTAN_LATE_USAGE, "error: machine and tools must be named");
    Job job;
    auto inputs =
        capstan::pipeline::load_shop({.machine = machine, .tools = tools, .rules = {}, .material = {}}, job);
    say(*s, job);
    if (!inputs) return end(*s, CAPSTAN_LATE_UNREADABLE, capstan::to_text(inputs.error()));
    s->inputs = *std::move(inputs);
    return end(*s, CAPSTAN_LATE_OK);
  });
  return s;
}

capstan_late_code capstan_late_bind(capstan_late* s, const char* plan, size_t size, unsigned deadline_ms) {
  if (s == nullptr) return CAPSTAN_LATE_USAGE;
  const auto began = std::chrono::steady_clock::now();
  return guarded(*s, [&] {
    s->outcome.reset();
    s->outputs = {};
    s->message.clear();
    if (plan == nullptr || size == 0 || !s->inputs) {
      return end(*s, CAPSTAN_LATE_USAGE, "error: there is no plan, or the session did not open");
    }
    Job job;
    auto read = capstan::pipeline::read_plan(std::string(plan, size), "plan", job);
    if (!read) {
      say(*s, job);
      return end(*s, CAPSTAN_LATE_UNREADABLE, capstan::to_text(read.error()));
    }
    capstan::late::LatePolicy policy;
    policy.deadline = std::chrono::milliseconds(deadline_ms);
    policy.began = began;
    auto bound = capstan::late::bind(*std::move(read), *s->inputs, policy, job);
    say(*s, job);
    if (!bound) {
      return end(*s, is_unreadable(bound.error().code) ? CAPSTAN_LATE_UNREADABLE : CAPSTAN_LATE_IMPOSSIBLE,
                 capstan::to_text(bound.error()));
    }
    for (const auto& line : bound->reopened) s->message += "note: " + line + "\n";
    const bool late = bound->late;
    s->outcome = *std::move(bound);
    return end(*s, late ? CAPSTAN_LATE_LATE : CAPSTAN_LATE_OK);
  });
}

const char* capstan_late_output(capstan_late* s, capstan_late_format format, size_t* size) {
  if (size != nullptr) *size = 0;
  if (s == nullptr || !s->outcome) return nullptr;
  const auto index = static_cast<std::size_t>(format);
  if (index >= s->outputs.size()) return nullptr;
  std::string& text = s->outputs[index];
  if (text.empty()) {
    constexpr std::array kFormats = {capstan::pipeline::Format::kIso14649, capstan::pipeline::Format::kJson,
                                     capstan::pipeline::Format::kLinuxCnc,
                                     capstan::pipeline::Format::kToolTable,
                                     capstan::pipeline::Format::kAp238};
    guarded(*s, [&] {
      Job job;
      auto written = capstan::pipeline::write_plan(s->outcome->plan, kFormats[index], job);
      if (!written) return end(*s, CAPSTAN_LATE_IMPOSSIBLE, capstan::to_text(written.error()));
      text = *std::move(written);
      return s->code;
    });
  }
  if (text.empty()) return nullptr;
  if (size != nullptr) *size = text.size();
  return text.c_str();
}

capstan_late_code capstan_late_status(const capstan_late* s) {
  return s == nullptr ? CAPSTAN_LATE_USAGE : s->code;
}
const char* capstan_late_message(const capstan_late* s) { return s == nullptr ? "" : s->message.c_str(); }
double capstan_late_machining_seconds(const capstan_late* s) {
  return s == nullptr || !s->outcome ? 0.0 : s->outcome->machining_s;
}
void capstan_late_close(capstan_late* s) { delete s; }
