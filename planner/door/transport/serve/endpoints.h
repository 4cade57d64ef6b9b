#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/door/transport/serve/limits.h"
#include "planner/door/transport/serve/metrics.h"
#include "planner/door/transport/serve/sessions.h"
#include "planner/door/transport/serve/wire/http.h"

namespace capstan::transport {

/// Who asks, and since when.
struct Caller {
  std::string peer;           ///< who it is: `peer_of_user`, or who a certificate says (TlsStream::identity)
  Clock::time_point arrived;  ///< of the request's last byte; deadlines count from here
};

class Endpoints;

/// One question that a server answers: a row of the table.
struct Endpoint {
  std::string_view name, method;
  std::string_view path;  ///< "*" stands for a word of it
  bool works = false;     ///< a worker answers; else whoever read the request, at once
  bool streams = false;   ///< after a reply of 200 the lines of `next_lines` follow
  HttpReply (Endpoints::*answer)(const HttpRequest&, const std::vector<std::string>& words, const Caller&);
};

/// What `capstan serve` answers, without sockets: the questions of the C interface, each as one endpoint.
/// docs/serve.md says what goes in and comes out, docs/serve.schema.json has the bodies.
///
/// Errors  the code of the call and its diagnostics, as the C interface has them, with an HTTP status from
///         400 on for every code but OK: a client that looks at nothing else stops.
/// Thread safety  any thread; a session serves one call at a time (409), but for `cancel`.
class Endpoints {
 public:
  using Gauges = std::function<std::vector<Metrics::Gauge>()>;
  /// `folder`: of the sessions (Sessions). `defaults`: options that each session begins with. `own_peer`:
  /// whose files may be named.
  Endpoints(const Limits& limits, std::string folder,
            std::vector<std::pair<std::string, std::string>> defaults, std::string own_peer, Metrics& metrics,
            Gauges gauges);

  [[nodiscard]] static std::span<const Endpoint> all();

  /// The endpoint of a request, and the words of its path; else why there is none (404, 405).
  struct Found {
    const Endpoint* endpoint = nullptr;
    std::vector<std::string> words;
    HttpReply refusal;
  };
  [[nodiscard]] static Found find(const HttpRequest& request);

  [[nodiscard]] HttpReply answer(const Found& found, const HttpRequest& request, const Caller& caller);
  /// Of a stream that was begun: the lines that came since, waiting a moment for the first; nothing: it is
  /// over.
  [[nodiscard]] std::optional<std::string> next_lines(const Found& found, const Caller& caller);
  /// The reader of a stream is gone.
  void end_stream(const Found& found, const Caller& caller);
  /// Who asked is gone: ends what was asked for.
  void gone(const Found& found, const Caller& caller);
  /// Ends what runs, and refuses what comes (503).
  void end();

 private:
  friend struct Rows;
  using Words = std::vector<std::string>;
  HttpReply health(const HttpRequest&, const Words&, const Caller&);
  HttpReply metrics(const HttpRequest&, const Words&, const Caller&);
  HttpReply open_session(const HttpRequest&, const Words&, const Caller&);
  HttpReply list_sessions(const HttpRequest&, const Words&, const Caller&);
  HttpReply put_state(const HttpRequest&, const Words&, const Caller&);
  HttpReply put_plan(const HttpRequest&, const Words&, const Caller&);
  HttpReply left_open(const HttpRequest&, const Words&, const Caller&);
  HttpReply no_longer_valid(const HttpRequest&, const Words&, const Caller&);
  HttpReply unsuited(const HttpRequest&, const Words&, const Caller&);
  HttpReply asked(const Words& words, const Caller& caller, const char* name,
                  service::Code (service::Session::*ask)(std::vector<std::string>&));
  HttpReply bind(const HttpRequest&, const Words&, const Caller&);
  HttpReply result(const HttpRequest&, const Words&, const Caller&);
  HttpReply output(const HttpRequest&, const Words&, const Caller&);
  HttpReply changes(const HttpRequest&, const Words&, const Caller&);
  HttpReply tell(const HttpRequest&, const Words&, const Caller&);
  HttpReply reply(const HttpRequest&, const Words&, const Caller&);
  HttpReply stream(const HttpRequest&, const Words&, const Caller&);
  HttpReply cancel(const HttpRequest&, const Words&, const Caller&);
  HttpReply close_session(const HttpRequest&, const Words&, const Caller&);

  /// Runs `body` on the session that the path names, when no other call is in it.
  HttpReply in_session(const Words& words, const Caller& caller,
                       const std::function<HttpReply(ServedSession&)>& body);
  /// What the state says of broadcasts.
  Status take_broadcast(ServedSession& s, const std::map<std::string, std::string>& members,
                        const Caller& caller);
  HttpReply take_state(ServedSession& s, const HttpRequest& request, const Caller& caller, unsigned done);

  Limits limits_;
  std::vector<std::pair<std::string, std::string>> defaults_;
  std::string own_peer_;
  Metrics& metrics_;
  Gauges gauges_;
  Sessions sessions_;
  std::atomic<bool> ended_{false};
};

}  // namespace capstan::transport
