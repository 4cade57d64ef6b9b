#include <array>
#include <chrono>
#include <new>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "capstan/capstan_late.h"
#include "planner/door/service/session.h"

// Late binding for C: each function is one call of the session.

/// A session behind the C interface.
struct capstan_late {
  capstan::service::Session session;
  std::string left_open, no_longer_valid, unsuited, broadcasts;  ///< as they were told last
};

namespace {

using capstan::service::Code;

constexpr capstan_late_code code_of(Code c) { return static_cast<capstan_late_code>(c); }
static_assert(code_of(Code::kDone) == CAPSTAN_LATE_OK && code_of(Code::kUsage) == CAPSTAN_LATE_USAGE &&
              code_of(Code::kUnreadable) == CAPSTAN_LATE_UNREADABLE &&
              code_of(Code::kImpossible) == CAPSTAN_LATE_IMPOSSIBLE &&
              code_of(Code::kLate) == CAPSTAN_LATE_LATE && code_of(Code::kFault) == CAPSTAN_LATE_FAULT);

// capstan_late_format by number; formats that came later go by their name.
constexpr std::array kNumbered = {"iso14649", "json", "linuxcnc", "linuxcnc_tools", "ap238"};

const char* text_of(const std::string* text, size_t* size) {
  if (text == nullptr || text->empty()) return nullptr;
  if (size != nullptr) *size = text->size();
  return text->c_str();
}

/// What a call of the session says, a line each, kept with it; null where the call fails.
template <class Ask>
const char* lines_of(capstan_late& s, std::string capstan_late::*kept, Ask ask) {
  try {
    std::vector<std::string> out;
    if (ask(out) != Code::kDone) return nullptr;
    std::string text;
    for (const std::string& one : out) text += one + "\n";
    return (s.*kept = std::move(text)).c_str();
  } catch (...) {
    s.session.fault();
    return nullptr;
  }
}

}  // namespace

unsigned capstan_late_interface(void) { return CAPSTAN_LATE_INTERFACE; }

capstan_late* capstan_late_create(void) {
  try {
    return new (std::nothrow) capstan_late;
  } catch (...) {
    return nullptr;  // std::mutex, std::string: no memory
  }
}

capstan_late* capstan_late_open(const char* machine, const char* tools) {
  capstan_late* s = capstan_late_create();
  if (s == nullptr) return nullptr;
  if (machine == nullptr || tools == nullptr) {
    s->session.wrong("error: machine and tools must be named");
    return s;
  }
  if (capstan_late_set(s, "machine", machine) == CAPSTAN_LATE_OK &&
      capstan_late_set(s, "tools", tools) == CAPSTAN_LATE_OK)
    s->session.open();
  return s;
}

capstan_late_code capstan_late_set(capstan_late* s, const char* option, const char* value) {
  if (s == nullptr) return CAPSTAN_LATE_USAGE;
  if (option == nullptr || value == nullptr)
    return code_of(s->session.wrong("error: option and value must be given"));
  return code_of(s->session.set(option, value));
}

capstan_late_code capstan_late_tool_state(capstan_late* s, const char* states, size_t size) {
  if (s == nullptr) return CAPSTAN_LATE_USAGE;
  return code_of(s->session.tell_tools(states == nullptr ? std::string() : std::string(states, size)));
}

capstan_late_code capstan_late_prepare(capstan_late* s) {
  return s == nullptr ? CAPSTAN_LATE_USAGE : code_of(s->session.open());
}

capstan_late_code capstan_late_bind(capstan_late* s, const char* plan, size_t size, unsigned deadline_ms) {
  if (s == nullptr) return CAPSTAN_LATE_USAGE;
  return code_of(s->session.bind(plan == nullptr ? std::string() : std::string(plan, size),
                                 std::chrono::milliseconds(deadline_ms)));
}

capstan_late_code capstan_late_take(capstan_late* s, const char* plan, size_t size) {
  if (s == nullptr) return CAPSTAN_LATE_USAGE;
  return code_of(s->session.take(plan == nullptr ? std::string() : std::string(plan, size)));
}

capstan_late_code capstan_late_bind_next(capstan_late* s, const char* plan, size_t size, unsigned from,
                                         unsigned count, unsigned deadline_ms) {
  if (s == nullptr) return CAPSTAN_LATE_USAGE;
  return code_of(s->session.bind_next(plan == nullptr ? std::string() : std::string(plan, size), from, count,
                                      std::chrono::milliseconds(deadline_ms)));
}

const char* capstan_late_left_open(capstan_late* s) {
  if (s == nullptr || !s->session.has_plan()) return nullptr;
  try {
    std::string text;
    for (const std::string& one : s->session.left_open()) text += one + "\n";
    s->left_open = std::move(text);
    return s->left_open.c_str();
  } catch (...) {
    return nullptr;
  }
}

const char* capstan_late_no_longer_valid(capstan_late* s) {
  return s == nullptr ? nullptr : lines_of(*s, &capstan_late::no_longer_valid, [&](auto& out) {
    return s->session.no_longer_valid(out);
  });
}

const char* capstan_late_unsuited(capstan_late* s) {
  return s == nullptr
             ? nullptr
             : lines_of(*s, &capstan_late::unsuited, [&](auto& out) { return s->session.unsuited(out); });
}

const char* capstan_late_measured(capstan_late* s, const char* event, const char* workingstep,
                                  const char* time, double elapsed_s, const char* const* names,
                                  const char* const* values, size_t count) {
  if (s == nullptr) return nullptr;
  return lines_of(*s, &capstan_late::broadcasts, [&](std::vector<std::string>& out) {
    using capstan::service::ControlEvent;
    const std::string what = event == nullptr ? "" : event;
    ControlEvent told;
    told.kind = what == "start" ? ControlEvent::Kind::kStart
                : what == "end" ? ControlEvent::Kind::kEnd
                                : ControlEvent::Kind::kAt;
    const bool over = what == "finish";
    if (told.kind == ControlEvent::Kind::kAt && what != "at" && !over)
      return s->session.wrong("error: the event is '" + what + "'; expected start, at, end or finish");
    if (count > 0 && (names == nullptr || values == nullptr))
      return s->session.wrong("error: names and values must be given");
    if (workingstep != nullptr) told.workingstep = workingstep;
    if (time != nullptr) told.time = time;
    if (elapsed_s >= 0.0) told.elapsed_s = elapsed_s;
    for (size_t i = 0; i < count; ++i) {
      if (names[i] == nullptr || values[i] == nullptr)
        return s->session.wrong("error: name or value " + std::to_string(i) + " is null");
      if (auto ok = capstan::service::take_measured(names[i], values[i], told); !ok)
        return s->session.wrong(capstan::to_text(ok.error()));
    }
    std::vector<capstan::service::BroadcastLine> due;
    const auto code = s->session.tell(told, over, due);
    for (auto& line : due) out.push_back(std::move(line.json));
    return code;
  });
}

void capstan_late_on_progress(capstan_late* s, capstan_late_progress progress, void* user) {
  if (s == nullptr) return;
  if (progress == nullptr) return s->session.set_progress({});
  s->session.set_progress([progress, user](std::string_view stage, double fraction) {
    progress(std::string(stage).c_str(), fraction, user);
  });
}

void capstan_late_stop(capstan_late* s) {
  if (s != nullptr) s->session.stop();
}

const char* capstan_late_output_as(capstan_late* s, const char* format, size_t* size) {
  if (size != nullptr) *size = 0;
  if (s == nullptr || format == nullptr) return nullptr;
  return text_of(s->session.output(format), size);
}

const char* capstan_late_output(capstan_late* s, capstan_late_format format, size_t* size) {
  const auto index = static_cast<std::size_t>(format);
  return capstan_late_output_as(s, index < kNumbered.size() ? kNumbered[index] : nullptr, size);
}

capstan_late_code capstan_late_status(const capstan_late* s) {
  return s == nullptr ? CAPSTAN_LATE_USAGE : code_of(s->session.code());
}
const char* capstan_late_message(const capstan_late* s) {
  return s == nullptr ? "" : s->session.message().c_str();
}
const char* capstan_late_changes(const capstan_late* s) {
  const std::string* text = s == nullptr ? nullptr : s->session.changes();
  return text == nullptr ? nullptr : text->c_str();
}
unsigned capstan_late_steps(const capstan_late* s) {
  return s == nullptr ? 0U : static_cast<unsigned>(s->session.steps());
}
double capstan_late_machining_seconds(const capstan_late* s) {
  return s == nullptr ? 0.0 : s->session.machining_s();
}
void capstan_late_close(capstan_late* s) { delete s; }
