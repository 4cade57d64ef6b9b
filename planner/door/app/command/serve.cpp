#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <optional>
#include <string>
#include <utility>

#include "planner/door/app/command/session.h"
#include "planner/door/transport/serve/peer_log.h"
#include "planner/door/transport/serve/server.h"
#include "planner/door/transport/serve/wire/tls.h"

// `capstan serve`: sessions of late binding for other programs, until SIGTERM or Ctrl-C.

namespace capstan::app {
namespace {

/// A file descriptor that can be read when the process is to end. The signals stay blocked, in all threads
/// that begin later, too.
int stop_signals() {
  sigset_t ends;
  ::sigemptyset(&ends);
  ::sigaddset(&ends, SIGTERM);
  ::sigaddset(&ends, SIGINT);
  ::pthread_sigmask(SIG_BLOCK, &ends, nullptr);
  return ::signalfd(-1, &ends, SFD_CLOEXEC);
}

/// Why a server cannot answer where it is told to; nothing where it can.
std::optional<Diagnostic> places_wrong(const ServeOptions& o) {
  if (o.socket.empty() && o.tcp.empty())
    return Diagnostic{.code = "SERVE-WHERE",
                      .message = "nothing says where to serve",
                      .expected = "--socket PATH, or --tcp ADDRESS:PORT with --cert, --key and --client-ca"};
  std::string missing, given;
  for (const auto& [name, value] :
       {std::pair{"--cert", &o.certificate}, {"--key", &o.key}, {"--client-ca", &o.client_ca}}) {
    std::string& list = value->empty() ? missing : given;
    list += (list.empty() ? "" : ", ") + std::string(name);
  }
  if (!o.tcp.empty() && !missing.empty())
    return Diagnostic{.code = "SERVE-TCP",
                      .message = "TCP is served only with TLS on both sides; missing: " + missing,
                      .expected = "--tcp ADDRESS:PORT --cert FILE --key FILE --client-ca FILE",
                      .hint = "docs/serve.md says how to make them; within one machine --socket needs none"};
  if (o.tcp.empty() && !given.empty())
    return Diagnostic{.code = "SERVE-TCP",
                      .message = given + ": of TCP, and no --tcp is given",
                      .expected = "--tcp ADDRESS:PORT --cert FILE --key FILE --client-ca FILE"};
  if (!o.tcp.empty() && !transport::tls_is_built())
    return Diagnostic{.code = "SERVE-TCP",
                      .message =
                          "TCP is served only with TLS on both sides, and this build has no TLS: it was "
                          "configured without OpenSSL",
                      .expected = "--socket alone",
                      .hint = "install libssl-dev and configure again; or reach the socket by `ssh -L`"};
  return std::nullopt;
}

}  // namespace

int run_serve(Session& s) {
  const ServeOptions& o = s.options.serve;
  if (auto wrong = places_wrong(o)) return s.end(*std::move(wrong), kUsage);
  const int stop = stop_signals();
  transport::ServeSettings settings{
      o.socket,
      o.tcp,
      {o.certificate, o.key, o.client_ca},
      o.users,
      o.session,
      {},
      [](const std::string& line) { return transport::write_line(STDERR_FILENO, "capstan: tcp: " + line); }};
  settings.limits.workers = o.workers;
  settings.limits.queue = o.queue;
  std::string places;
  const auto ready = [&](const transport::Serving& at) {
    places = at.socket + (at.socket.empty() || at.tcp.empty() ? "" : " and ") +
             (at.tcp.empty() ? "" : at.tcp + " (TLS)");
    std::fprintf(stderr, "capstan: serving on %s\n", places.c_str());
  };
  const auto served = transport::serve(settings, stop, ready);
  ::close(stop);
  if (!served) return s.end(served.error(), kUsage);
  s.summary = "stopped serving on " + places;
  return kDone;
}

}  // namespace capstan::app
