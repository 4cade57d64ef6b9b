#include "planner/door/transport/serve/endpoints.h"

#include <algorithm>
#include <array>
#include <exception>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <system_error>

#include "planner/door/service/formats.h"
#include "planner/door/transport/serve/wire/json_request.h"

namespace capstan::transport {

using Json = nlohmann::ordered_json;
using service::Code;

namespace {

constexpr std::string_view kText = "text/plain; charset=utf-8";

struct Said {
  Code code;
  std::string_view status;  ///< as capstan_late.h has it, without CAPSTAN_LATE_
  unsigned http;
};
constexpr std::array kSaid{
    Said{Code::kDone, "OK", 200},
    Said{Code::kUsage, "USAGE", 400},
    Said{Code::kUnreadable, "UNREADABLE", 422},
    Said{Code::kImpossible, "IMPOSSIBLE", 409},
    Said{Code::kLate, "LATE", 504},
    Said{Code::kFault, "FAULT", 500},
};
const Said& said(Code code) {
  const auto* at = std::find_if(kSaid.begin(), kSaid.end(), [&](const Said& s) { return s.code == code; });
  return at == kSaid.end() ? kSaid.back() : *at;
}

HttpReply json_reply(unsigned status, const Json& json) {
  // Bytes of a caller that are no UTF-8 come back as U+FFFD.
  return {.status = status, .body = json.dump(-1, ' ', false, Json::error_handler_t::replace) + "\n"};
}

Json of_call(Code code, const std::string& message) {
  return {{"code", static_cast<int>(code)}, {"status", said(code).status}, {"message", message}};
}

HttpReply of_code(Code code, const std::string& message) {
  return json_reply(said(code).http, of_call(code, message));
}

HttpReply refused(unsigned status, const Diagnostic& d) {
  return json_reply(status, of_call(Code::kUsage, to_text(d) + "\n"));
}
HttpReply refused(unsigned status, std::string code, std::string message, std::string hint = {}) {
  return refused(status, {.code = std::move(code), .message = std::move(message), .hint = std::move(hint)});
}

HttpReply no_session() { return refused(404, "SERVE-SESSION", "this user has no session of that name"); }

/// "a, b": the words between commas.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream in(text);
  for (std::string word; std::getline(in, word, ',');) {
    const auto begin = word.find_first_not_of(' ');
    if (begin != std::string::npos) out.push_back(word.substr(begin, word.find_last_not_of(' ') - begin + 1));
  }
  return out;
}

/// Options of a session whose value may be a file.
constexpr std::array<std::string_view, 7> kFileOptions = {"machine", "tools", "material", "workholding",
                                                          "rules",   "cases", "cache"};

/// Another user's process must not have the server read or write files that are not its own.
bool names_file(const std::string& option, const std::string& value) {
  if (std::find(kFileOptions.begin(), kFileOptions.end(), option) == kFileOptions.end()) return false;
  std::error_code ignored;
  return option == "rules" || option == "cases" || option == "cache" ||
         value.find('/') != std::string::npos || std::filesystem::exists(value, ignored);
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
                     std::vector<std::pair<std::string, std::string>> defaults, std::uint32_t own_user,
                     Metrics& metrics, Gauges gauges)
    : limits_(limits),
      defaults_(std::move(defaults)),
      own_user_(own_user),
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
    return {nullptr, {}, refused(405, "SERVE-METHOD", "this path is asked otherwise", "use " + methods)};
  return {nullptr, {}, refused(404, "SERVE-PATH", "there is no such path", "docs/serve.md has all")};
}

HttpReply Endpoints::answer(const Found& found, const HttpRequest& request, const Caller& caller) {
  HttpReply reply;
  try {
    reply = ended_ ? refused(503, "SERVE-ENDS", "the server is stopping")
                   : (this->*found.endpoint->answer)(request, found.words, caller);
  } catch (const std::exception& e) {
    reply = of_code(Code::kFault, std::string("error: a fault of the server itself: ") + e.what() + "\n");
  }
  metrics_.answered(found.endpoint->name, reply.status,
                    std::chrono::duration<double>(Clock::now() - caller.arrived).count());
  return reply;
}

void Endpoints::gone(const Found& found, const Caller& caller) {
  if (found.endpoint->name != "bind") return;
  if (const auto s = sessions_.find(found.words.front(), caller.user, Clock::now())) s->session.stop();
}

void Endpoints::end() {
  ended_ = true;
  sessions_.stop_all();
}

HttpReply Endpoints::in_session(const Words& words, const Caller& caller,
                                const std::function<HttpReply(ServedSession&)>& body) {
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  const std::unique_lock lock(s->in_use, std::try_to_lock);
  if (!lock)
    return refused(409, "SERVE-BUSY", "another call is in this session", "wait for it, or cancel it");
  return body(*s);
}

HttpReply Endpoints::health(const HttpRequest&, const Words&, const Caller&) {
  return json_reply(200, {{"status", "ok"}, {"sessions", sessions_.count()}});
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
    if (caller.user != own_user_ && names_file(name, value))
      return refused(403, "SERVE-FILE", "option '" + name + "' names a file of the server's",
                     "send the tool table as `tool_table`; only the server's own user may name files");
  }
  if (const auto at = read->texts.find("tool_table"); at != read->texts.end()) {
    const std::string file = s.folder + "/tool.tbl";
    std::ofstream out(file, std::ios::binary | std::ios::trunc);
    out << at->second;
    out.close();
    if (!out) return of_code(Code::kFault, "error: the tool table cannot be kept\n");
    options.emplace_back("tools", file);
  }
  Code code = Code::kDone;
  for (const auto& [name, value] : options) {
    code = s.session.set(name, value);
    if (code != Code::kDone) break;
  }
  if (code == Code::kDone) code = s.session.open();
  keep_ending(s);
  Json reply = of_call(code, s.session.message());
  reply["session"] = s.id;
  return json_reply(code == Code::kDone ? done : said(code).http, reply);
}

Status Endpoints::take_broadcast(ServedSession& s, const std::map<std::string, std::string>& members,
                                 const Caller& caller) {
  service::DefaultContent otherwise{.start = false, .end = false, .measured = {}};
  std::string file;
  bool any = false;
  for (const auto& [name, value] : members) {
    const bool yes = value == "yes";
    const auto is_flag = [&] { return yes || value == "no"; };
    if (name == "at") {
      for (const std::string& word : words_of(value)) {
        if (word != "start" && word != "end")
          return fail({.code = "SERVE-JSON", .message = "`at` has '" + word + "'", .expected = "start, end"});
        (word == "start" ? otherwise.start : otherwise.end) = true;
        any = true;
      }
    } else if (name == "measured") {
      otherwise.measured = words_of(value);
    } else if (name == "only_if_changed" && is_flag()) {
      otherwise.only_if_changed = yes;
    } else if (name == "wait_for_reply" && is_flag()) {
      otherwise.wait_for_reply = yes;
    } else if (name == "file") {
      if (caller.user != own_user_)
        return fail({.code = "SERVE-FILE", .message = "only the server's own user may name files"});
      file = value;
    } else {
      return fail({.code = "SERVE-JSON",
                   .message = "`broadcast` has '" + name + "': '" + value + "'",
                   .expected =
                       "at: start,end; measured: names; only_if_changed, wait_for_reply: yes or no; file: "
                       "a path"});
    }
  }
  s.broadcasts.set(any ? std::optional(otherwise) : std::nullopt, file);
  return {};
}

HttpReply Endpoints::tell(const HttpRequest& request, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  const auto read = read_json_request(request.body,
                                      {{Member::Kind::kText, "event"},
                                       {Member::Kind::kText, "workingstep"},
                                       {Member::Kind::kText, "time"},
                                       {Member::Kind::kWhole, "elapsed_ms"},
                                       {Member::Kind::kValues, "measured"}},
                                      limits_.json_bytes);
  if (!read) return refused(400, read.error());
  const auto text = [&](const char* name) {
    const auto at = read->texts.find(name);
    return at == read->texts.end() ? std::string() : at->second;
  };
  using Kind = service::ControlEvent::Kind;
  const std::string what = text("event");
  service::ControlEvent event;
  event.kind = what == "start" ? Kind::kStart : what == "end" ? Kind::kEnd : Kind::kAt;
  const bool over = what == "finish";
  if (event.kind == Kind::kAt && what != "at" && !over)
    return refused(400, {.code = "SERVE-JSON",
                         .message = "`event` is '" + what + "'",
                         .expected = "start, at, end or finish"});
  event.workingstep = text("workingstep");
  event.time = text("time");
  if (const auto at = read->wholes.find("elapsed_ms"); at != read->wholes.end())
    event.elapsed_s = static_cast<double>(at->second) / 1000.0;
  if (const auto at = read->objects.find("measured"); at != read->objects.end()) event.measured = at->second;
  if (const auto at = event.measured.find("location"); at != event.measured.end()) {
    const Json xyz = Json::parse(at->second);
    if (!xyz.is_array() || xyz.size() != 3 ||
        !std::all_of(xyz.begin(), xyz.end(), [](const Json& v) { return v.is_number(); }))
      return refused(
          400, {.code = "SERVE-JSON", .message = "`location` is no place", .expected = "[x, y, z] in mm"});
    event.location_mm = {xyz[0].get<double>(), xyz[1].get<double>(), xyz[2].get<double>()};
  }
  const auto make =
      [&](const std::optional<service::DefaultContent>& otherwise) -> std::optional<service::Broadcasts> {
    const std::unique_lock lock(s->in_use, std::try_to_lock);
    return lock ? s->session.broadcasts(otherwise) : std::nullopt;
  };
  const auto told = s->broadcasts.tell(event, over, limits_.broadcast_lines, limits_.write, make);
  if (!told) return refused(409, told.error());
  metrics_.broadcast(told->lines.size());
  Code code = Code::kDone;
  std::string message = told->warning;
  if (!s->broadcasts.replied(told->lines, Clock::now() + limits_.reply)) {
    code = Code::kLate;
    message +=
        "error: nobody replied to the broadcast in time: the control goes on when it may "
        "[BROADCAST-REPLY]\n";
  }
  Json reply = of_call(code, message);
  reply["lines"] = Json::array();
  for (const service::BroadcastLine& line : told->lines) reply["lines"].push_back(Json::parse(line.json));
  return json_reply(said(code).http, reply);
}

HttpReply Endpoints::reply(const HttpRequest& request, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  const auto read = read_json_request(request.body, {{Member::Kind::kWhole, "reply_to"}}, limits_.json_bytes);
  if (!read) return refused(400, read.error());
  const auto at = read->wholes.find("reply_to");
  if (at == read->wholes.end() || !s->broadcasts.reply(at->second))
    return refused(409, "BROADCAST-REPLY", "no broadcast of that number waits for a reply");
  return of_code(Code::kDone, "");
}

HttpReply Endpoints::stream(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  if (!s->broadcasts.open_stream())
    return refused(409, "SERVE-BUSY", "another reader has the broadcasts of this session");
  return {.status = 200, .media = "application/x-ndjson", .body = {}};
}

std::optional<std::string> Endpoints::next_lines(const Found& found, const Caller& caller) {
  const auto s = ended_ ? nullptr : sessions_.find(found.words.front(), caller.user, Clock::now());
  if (!s) return std::nullopt;
  return s->broadcasts.take(std::chrono::milliseconds(100));
}

void Endpoints::end_stream(const Found& found, const Caller& caller) {
  if (const auto s = sessions_.find(found.words.front(), caller.user, Clock::now()))
    s->broadcasts.close_stream();
}

HttpReply Endpoints::open_session(const HttpRequest& request, const Words&, const Caller& caller) {
  auto opened = sessions_.open(caller.user, Clock::now());
  if (!opened) {
    HttpReply reply = refused(opened.error().code == "SERVE-SESSIONS" ? 429 : 500, opened.error());
    metrics_.refused("sessions");
    return reply;
  }
  const auto s = *opened;
  const std::lock_guard lock(s->in_use);
  HttpReply reply;
  for (const auto& [name, value] : defaults_) {
    if (s->session.set(name, value) != Code::kDone) reply = of_code(s->session.code(), s->session.message());
  }
  if (reply.body.empty()) reply = take_state(*s, request, caller, 201);
  if (reply.status != 201) sessions_.close(*s);  // nobody would know of it
  return reply;
}

HttpReply Endpoints::list_sessions(const HttpRequest&, const Words&, const Caller& caller) {
  return json_reply(200, {{"sessions", sessions_.ids_of(caller.user)}});
}

HttpReply Endpoints::put_state(const HttpRequest& request, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) { return take_state(s, request, caller, 200); });
}

HttpReply Endpoints::put_plan(const HttpRequest& request, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    const Code code = s.session.bring(request.body);
    s.plan = code == Code::kDone ? request.body : std::string();
    s.broadcasts.plan_changed(false);
    keep_ending(s);
    return of_code(code, s.session.message());
  });
}

HttpReply Endpoints::left_open(const HttpRequest&, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    if (s.plan.empty()) return refused(409, "SERVE-PLAN", "no plan was brought", "PUT one to .../plan");
    return json_reply(200, {{"open", s.session.left_open()}});
  });
}

HttpReply Endpoints::bind(const HttpRequest& request, const Words& words, const Caller& caller) {
  return in_session(words, caller, [&](ServedSession& s) {
    const auto read =
        read_json_request(request.body, {{Member::Kind::kWhole, "deadline_ms"}}, limits_.json_bytes);
    if (!read) return refused(400, read.error());
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
    const Code code = s.session.bind(s.plan, left);
    metrics_.bound(said(code).status);
    s.broadcasts.plan_changed(true);
    keep_ending(s);
    Json reply = of_call(code, s.session.message());
    reply["machining_s"] = s.session.machining_s();
    if (const std::string* changes = s.session.changes()) reply["changes"] = *changes;
    return json_reply(said(code).http, reply);
  });
}

HttpReply Endpoints::result(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  const bool free = s->in_use.try_lock();
  if (free) s->in_use.unlock();
  const std::lock_guard lock(s->ended);
  Json reply = of_call(s->ending.code, s->ending.message);
  reply["busy"] = !free;
  reply["bound"] = s->ending.bound;
  reply["machining_s"] = s->ending.machining_s;
  return json_reply(200, reply);
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
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  s->session.stop();
  return of_code(Code::kDone, "");
}

HttpReply Endpoints::close_session(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.user, Clock::now());
  if (!s) return no_session();
  sessions_.close(*s);
  return of_code(Code::kDone, "");
}

}  // namespace capstan::transport
