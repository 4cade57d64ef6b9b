#include <sstream>

#include "planner/door/transport/serve/endpoints.h"
#include "planner/door/transport/serve/replies.h"
#include "planner/door/transport/serve/wire/json_request.h"

// The questions about broadcasts: what the control tells, who replies, and the stream.

namespace capstan::transport {

using service::Code;

namespace {

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

}  // namespace

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
      if (caller.peer != own_peer_)
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
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
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
  if (const auto at = read->objects.find("measured"); at != read->objects.end()) {
    for (const auto& [name, json] : at->second)
      if (auto ok = service::take_measured(name, json, event); !ok) return refused(400, ok.error());
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
  std::string lines;
  for (const service::BroadcastLine& line : told->lines) lines += (lines.empty() ? "" : ",") + line.json;
  return of_call(code, message, {{"lines", "[" + lines + "]"}});
}

HttpReply Endpoints::reply(const HttpRequest& request, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
  if (!s) return no_session();
  const auto read = read_json_request(request.body, {{Member::Kind::kWhole, "reply_to"}}, limits_.json_bytes);
  if (!read) return refused(400, read.error());
  const auto at = read->wholes.find("reply_to");
  if (at == read->wholes.end() || !s->broadcasts.reply(at->second))
    return refused(409, "BROADCAST-REPLY", "no broadcast of that number waits for a reply");
  return of_call(Code::kDone, "");
}

HttpReply Endpoints::stream(const HttpRequest&, const Words& words, const Caller& caller) {
  const auto s = sessions_.find(words.front(), caller.peer, Clock::now());
  if (!s) return no_session();
  if (!s->broadcasts.open_stream())
    return refused(409, "SERVE-BUSY", "another reader has the broadcasts of this session");
  return {.status = 200, .media = "application/x-ndjson", .body = {}};
}

std::optional<std::string> Endpoints::next_lines(const Found& found, const Caller& caller) {
  const auto s = ended_ ? nullptr : sessions_.find(found.words.front(), caller.peer, Clock::now());
  if (!s) return std::nullopt;
  return s->broadcasts.take(std::chrono::milliseconds(100));
}

void Endpoints::end_stream(const Found& found, const Caller& caller) {
  if (const auto s = sessions_.find(found.words.front(), caller.peer, Clock::now()))
    s->broadcasts.close_stream();
}

}  // namespace capstan::transport
