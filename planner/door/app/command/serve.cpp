#include <sys/signalfd.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>

#include "planner/door/app/command/session.h"
#include "planner/door/transport/serve/server.h"

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

}  // namespace

int run_serve(Session& s) {
  const ServeOptions& o = s.options.serve;
  if (!o.tcp.empty())
    return s.end(
        {.code = "SERVE-TCP",
         .message = "TCP is served only with TLS on both sides, and this build has no TLS",
         .expected = "--socket alone",
         .hint = "on another machine, reach the socket through a proxy that asks for certificates, or "
                 "`ssh -L`"},
        kUsage);
  const int stop = stop_signals();
  transport::ServeSettings settings{o.socket, o.users, o.session, {}};
  settings.limits.workers = o.workers;
  settings.limits.queue = o.queue;
  const auto ready = [&] { std::fprintf(stderr, "capstan: serving on %s\n", o.socket.c_str()); };
  const auto served = transport::serve(settings, stop, ready);
  ::close(stop);
  if (!served) return s.end(served.error(), kUsage);
  s.summary = "stopped serving on " + o.socket;
  return kDone;
}

}  // namespace capstan::app
