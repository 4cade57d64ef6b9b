#include "planner/door/transport/serve/endpoints.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <system_error>

#include "planner/door/service/formats.h"
#include "planner/door/transport/serve/replies.h"
#include "planner/door/transport/serve/wire/json_request.h"

namespace capstan::transport {

using service::Code;

namespace {

constexpr std::string_view kText = "text/plain; charset=utf-8";

/// Options of a session whose value may be a file.
constexpr std::array<std::string_view, 11> kFileOptions = {"machine", "tools",      "material", "workholding",
                                                           "rules",   "cases",      "cache",    "shop",
                                                           "edits",   "tool-state", "profile"};

/// Another user's process must not have the server read or write files that are not its own.
bool names_file(const std::string& option, const std::string& value) {
  if (std::find(kFileOptions.begin(), kFileOptions.end(), option) == kFileOptions.end()) return false;
  std::error_code ignored;
  return option == "rules" || option == "cases" || option == "cache" || option == "edits" ||
         option == "tool-state" || value.find('/') != std::string::npos ||
         std::filesystem::exists(value, ignored);
}

std::vector<std::string> split(const std::string& path) {
  std::vector<std::string> out(1);
  for (const char c : path) {
    if (c == '/') {
      out.emplace_back();
    } else {
      out.back().push_back(c);
    }
  }
  return out;
}

void keep_ending(ServedSession& s) {
  const std::lock_guard lock(s.ended);
  s.ending = {s.session.code(), s.session.message(), s.session.machining_s(), s.session.changes() != nullptr};
}

}  // namespace

struct Rows {
  static constexpr std::array kAll{
      Endpoint{"health", "GET", "/health", false, false, &Endpoints::health},
      Endpoint{"metrics", "GET", "/metrics", false, false, &Endpoints::metrics},
      Endpoint{"open", "POST", "/v1/sessions", true, false, &Endpoints::open_session},
      Endpoint{"list", "GET", "/v1/sessions", false, false, &Endpoints::list_sessions},
      Endpoint{"state", "PUT", "/v1/sessions/*/state", true, false, &Endpoints::put_state},
      Endpoint{"plan", "PUT", "/v1/sessions/*/plan", true, false, &Endpoints::put_plan},
      Endpoint{"left_open", "GET", "/v1/sessions/*/open", true, false, &Endpoints::left_open},
      Endpoint{"no_longer_valid", "GET", "/v1/sessions/*/no-longer-valid", true, false,
               &Endpoints::no_longer_valid},
      Endpoint{"unsuited", "GET", "/v1/sessions/*/unsuited", true, false, &Endpoints::unsuited},
      Endpoint{"bind", "POST", "/v1/sessions/*/bind", true, false, &Endpoints::bind},
      Endpoint{"result", "GET", "/v1/sessions/*/result", false, false, &Endpoints::result},
      Endpoint{"output", "GET", "/v1/sessions/*/output/*", true, false, &Endpoints::output},
      Endpoint{"changes", "GET", "/v1/sessions/*/changes", false, false, &Endpoints::changes},
      Endpoint{"measured", "POST", "/v1/sessions/*/measured", false, false, &Endpoints::tell},
      Endpoint{"reply", "POST", "/v1/sessions/*/reply", false, false, &Endpoints::reply},
      Endpoint{"broadcast", "GET", "/v1/sessions/*/broadcast", false, true, &Endpoints::stream},
      Endpoint{"cancel", "POST", "/v1/sessions/*/cancel", false, false, &Endpoints::cancel},
      Endpoint{"close", "DELETE", "/v1/sessions/*", false, false, &Endpoints::close_session},
  };
};

std::span<const Endpoint> Endpoints::all() { return Rows::kAll; }

Endpoints::Endpoints(const Limits& limits, std::string folder,
                     std::vector<std::pair<std::string, std::string>> defaults, std::string own_peer,
                     Metrics& metrics, Gauges gauges)
    : limits_(limits),
      defaults_(std::move(defaults)),
      own_peer_(std::move(own_peer)),
      metrics_(metrics),
      gauges_(std::move(gauges)),
      sessions_(limits, std::move(folder)) {}

Endpoints::Found Endpoints::find(const HttpRequest& request) {
  const std::vector<std::string> asked = split(request.path);
  std::string methods;
  for (const Endpoint& e : all()) {
    const std::vector<std::string> wanted = split(std::string(e.path));
    if (wanted.size() != asked.size()) continue;
    Found found{&e, {}, {}};
    bool same = true;
    for (std::size_t i = 0; same && i < asked.size(); ++i) {
      if (wanted[i] == "*" && !asked[i].empty()) {
        found.words.push_back(asked[i]);
      } else {
        same = wanted[i] == asked[i];
      }
    }
    if (!same) continue;
    if (e.method == request.method) return found;
    methods += (methods.empty() ? "" : ", ") + std::string(e.method);
  }
  if (!methods.empty())
    return {
        nullptr, {}, refused(405, "SERVE-METHOD", "this path does not answer this method", "use " + methods)};
  return {nullptr, {}, refused(404, "SERVE-PATH", "there is no such path", "docs/serve.md has all")};
}

HttpReply Endpoints::answer(const Found& found, const HttpRequest& request, const Caller& caller) {
  HttpReply reply;
  try {
    reply = ended_ ? refused(503, "SERVE-ENDS", "the server is stopping")
                   : (this->*found.endpoint->answer)(request, found.words, caller);
  } catch (const std::exception& e) {
    reply = of_call(Code::kFault, std::string("error: a fault of the server itself: ") + e.what() + "\n");
  }
  metrics_.answered(found.endpoint->name, reply.status,
                    std::chrono::duration<double>(Clock::now() - caller.arrived).count());
  return reply;
}

void Endpoints::gone(const Found& found, const Caller& caller) {
  if (found.endpoint->name != "bind") return;
  if (const auto s = sessions_.find(found.words.front(), caller.peer, Clock::now())) s->session.stop();
}

void Endpoints::end() {
  ended_ = true;
  sessions_.stop_all();
}

HttpReply Endpoints::in_session(const Words& words, const Caller& caller,
                                const std::function<HttpReply(ServedSession&)>& body) {
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
  if (!s) return no_session();
  const std::unique_lock lock(s->in_use, std::try_to_lock);
  if (!lock)
    return refused(409, "SERVE-BUSY", "another call is in this session", "wait for it, or cancel it");
  return body(*s);
}

HttpReply Endpoints::health(const HttpRequest&, const Words&, const Caller&) {
  return object_reply(200, {{"status", "\"ok\""}, {"sessions", std::to_string(sessions_.count())}});
}

HttpReply Endpoints::metrics(const HttpRequest&, const Words&, const Caller&) {
  auto gauges = gauges_();
  gauges.push_back({"capstan_sessions", "Sessions that are open.", sessions_.count()});
  return {.status = 200, .media = "text/plain; version=0.0.4", .body = metrics_.text(gauges)};
}

HttpReply Endpoints::take_state(ServedSession& s, const HttpRequest& request, const Caller& caller,
                                unsigned done) {
  const auto read = read_json_request(request.body,
                                      {{Member::Kind::kTexts, "options"},
                                       {Member::Kind::kText, "tool_table"},
                                       {Member::Kind::kText, "tool_state"},
                                       {Member::Kind::kTexts, "broadcast"}},
                                      limits_.json_bytes);
  if (!read) return refused(400, read.error());
  if (const auto at = read->objects.find("broadcast"); at != read->objects.end()) {
    if (auto ok = take_broadcast(s, at->second, caller); !ok)
      return refused(ok.error().code == "SERVE-FILE" ? 403 : 400, ok.error());
  }
  std::vector<std::pair<std::string, std::string>> options;
  if (const auto at = read->objects.find("options"); at != read->objects.end())
    options.assign(at->second.begin(), at->second.end());
  for (const auto& [name, value] : options) {
    if (caller.peer != own_peer_ && names_file(name, value))
      return refused(403, "SERVE-FILE", "option '" + name + "' names a file of the server's",
                     "send the tool table as `tool_table`; only the server's own user may name files");
  }
  if (const auto at = read->texts.find("tool_table"); at != read->texts.end()) {
    const std::string file = s.folder + "/tool.tbl";
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out << at->second;
    out.close();
    if (!out) return of_call(Code::kFault, "error: the tool table cannot be kept\n");
    options.emplace_back("tools", file);
  }
  Code code = Code::kDone;
  for (const auto& [name, value] : options) {
    code = s.session.set(name, value);
    if (code != Code::kDone) break;
  }
  // Last, for it drops what was bound.
  if (const auto at = read->texts.find("tool_state"); code == Code::kDone && at != read->texts.end())
    code = s.session.tell_tools(at->second);
  if (code == Code::kDone) code = s.session.open();
  keep_ending(s);
  return of_call(code, s.session.message(), {{"session", json_of(s.id)}}, code == Code::kDone ? done : 0);
}

HttpReply Endpoints::open_session(const HttpRequest& request, const Words&, const Caller& caller) {
  auto opened = sessions_.open(caller.peer, Clock::now());
  if (!opened) {
    HttpReply reply = refused(opened.error().code == "SERVE-SESSIONS" ? 429 : 500, opened.error());
    metrics_.refused("sessions");
    return reply;
  }
  const auto s = *opened;
  const std::lock_guard lock(s->in_use);
  HttpReply reply;
  for (const auto& [name, value] : defaults_) {
    if (s->session.set(name, value) != Code::kDone) reply = of_call(s->session.code(), s->session.message());
  }
  if (reply.body.empty()) reply = take_state(*s, request, caller, 201);
  if (reply.status != 201) sessions_.close(*s);  // nobody would know of it
  return reply;
}

HttpReply Endpoints::list_sessions(const HttpRequest&, const Words&, const Caller& caller) {
  return object_reply(200, {{"sessions", json_of(sessions_.ids_of(caller.peer))}});
}

HttpReply Endpoints::put_state(const HttpRequest& request, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) { return take_state(s, request, caller, 200); });
}

HttpReply Endpoints::put_plan(const HttpRequest& request, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    const Code code = s.session.take(request.body);
    s.plan = code == Code::kDone ? request.body : std::string();
    s.broadcasts.plan_changed(false);
    keep_ending(s);
    return of_call(code, s.session.message());
  });
}

HttpReply Endpoints::left_open(const HttpRequest&, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    if (s.plan.empty()) return refused(409, "SERVE-PLAN", "no plan was brought", "PUT one to .../plan");
    return object_reply(200, {{"open", json_of(s.session.left_open())}});
  });
}

HttpReply Endpoints::asked(const Words& words, const Caller& caller, const char* name,
                           Code (service::Session::*ask)(std::vector<std::string>&)) {
  return in_session(words, caller, [&](ServedSession& s) {
    if (s.plan.empty()) return refused(409, "SERVE-PLAN", "no plan was brought", "PUT one to .../plan");
    std::vector<std::string> out;
    const Code code = (s.session.*ask)(out);
    return of_call(code, s.session.message(), {{name, json_of(out)}});
  });
}

HttpReply Endpoints::no_longer_valid(const HttpRequest&, const Words& words, const Caller& caller) {
  return asked(words, caller, "no_longer_valid", &service::Session::no_longer_valid);
}

HttpReply Endpoints::unsuited(const HttpRequest&, const Words& words, const Caller& caller) {
  return asked(words, caller, "unsuited", &service::Session::unsuited);
}

HttpReply Endpoints::bind(const HttpRequest& request, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    const auto read = read_json_request(request.body,
                                        {{Member::Kind::kWhole, "deadline_ms"},
                                         {Member::Kind::kWhole, "next"},
                                         {Member::Kind::kWhole, "from"}},
                                        limits_.json_bytes);
    if (!read) return refused(400, read.error());
    const auto whole = [&](const char* name) {
      const auto at = read->wholes.find(name);
      return at == read->wholes.end() ? std::size_t{0} : static_cast<std::size_t>(at->second);
    };
    const auto asked = read->wholes.find("deadline_ms");
    const auto most = static_cast<std::uint64_t>(limits_.deadline.count());
    if (asked == read->wholes.end() || asked->second > most)
      return refused(400, {.code = "SERVE-DEADLINE",
                           .message = "`deadline_ms` is missing, or too much",
                           .expected = "0 to " + std::to_string(most)});
    if (s.plan.empty()) return refused(409, "SERVE-PLAN", "no plan was brought", "PUT one to .../plan");
    // The caller has waited in the queue, too.
    const auto gone = std::chrono::ceil<std::chrono::milliseconds>(Clock::now() - caller.arrived);
    const auto left = std::max(std::chrono::milliseconds(asked->second) - gone, std::chrono::milliseconds(0));
    // Steps are bound further in the plan that the session has: the one that was brought, or bound so far.
    const Code code = whole("next") > 0 || whole("from") > 0
                          ? s.session.bind_next({}, whole("from"), whole("next"), left)
                          : s.session.bind(s.plan, left);
    metrics_.bound(status_of(code));
    s.broadcasts.plan_changed(true);
    keep_ending(s);
    Members more = {{"machining_s", json_of(s.session.machining_s())},
                    {"steps", std::to_string(s.session.steps())}};
    if (const std::string* changes = s.session.changes()) more.emplace_back("changes", json_of(*changes));
    return of_call(code, s.session.message(), more);
  });
}

HttpReply Endpoints::result(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
  if (!s) return no_session();
  const bool free = s->in_use.try_lock();
  if (free) s->in_use.unlock();
  const std::lock_guard lock(s->ended);
  return of_call(s->ending.code, s->ending.message,
                 {{"busy", free ? "false" : "true"},
                  {"bound", s->ending.bound ? "true" : "false"},
                  {"machining_s", json_of(s->ending.machining_s)}},
                 200);
}

HttpReply Endpoints::output(const HttpRequest&, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    const service::Format* format = service::find_format(words.back());
    if (format == nullptr || format->write == nullptr) {
      std::string names;
      for (const service::Format& f : service::formats())
        if (f.write != nullptr) names += (names.empty() ? "" : ", ") + std::string(f.name);
      return refused(404,
                     {.code = "SERVE-FORMAT", .message = "no such format is written", .expected = names});
    }
    const std::string* text = s.session.output(words.back());
    if (text == nullptr) return refused(409, "SERVE-RESULT", "there is no bound plan in this format");
    return HttpReply{.status = 200,
                     .media = format->media.empty() ? std::string(kText) : std::string(format->media),
                     .body = *text};
  });
}

HttpReply Endpoints::changes(const HttpRequest&, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    const std::string* text = s.session.changes();
    if (text == nullptr) return refused(409, "SERVE-RESULT", "there is no bound plan");
    return HttpReply{.status = 200, .media = std::string(kText), .body = *text};
  });
}

HttpReply Endpoints::cancel(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
  if (!s) return no_session();
  s->session.stop();
  return of_call(Code::kDone, {});
}

HttpReply Endpoints::close_session(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
  if (!s) return no_session();
  sessions_.close(*s);
  return of_call(Code::kDone, {});
}

}  // namespace capstan::transport
