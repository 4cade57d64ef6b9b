#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>

#include "planner/files/exchange/brep/helper/read_shape.h"
#include "planner/ground/base/number.h"

// capstan-brep CHORD: a STEP file on standard input, what it holds as a message (brep/message.h) on standard
// output; CHORD in mm. A program of its own, so that what a hostile file does to OpenCASCADE it does not do
// to the planner. `read_brep` starts it, within limits.

namespace {

bool read_all(int fd, std::string& out) {
  char buffer[1 << 16];
  for (;;) {
    const auto n = ::read(fd, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return n == 0;
    out.append(buffer, static_cast<std::size_t>(n));
  }
}

bool write_all(int fd, std::string_view bytes) {
  while (!bytes.empty()) {
    const auto n = ::write(fd, bytes.data(), bytes.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return false;
    bytes.remove_prefix(static_cast<std::size_t>(n));
  }
  return true;
}

}  // namespace

int main(int argc, char** argv) {
  const auto chord = argc == 2 ? capstan::parse_double(argv[1]) : std::nullopt;
  if (!chord || !(*chord > 0.0)) {
    std::fputs(
        "usage: capstan-brep CHORD < part.step > message\n"
        "The helper of capstan that reads the shapes of STEP files; CHORD in mm.\n",
        stderr);
    return 2;
  }
  // OpenCASCADE says things on standard output.
  const int out = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
  if (out < 0 || nowhere < 0 || ::dup2(nowhere, STDOUT_FILENO) < 0) return 1;
  std::string step;
  if (!read_all(STDIN_FILENO, step)) return 1;
  const auto message = capstan::exchange::read_shape(step, *chord);
  if (!write_all(out, capstan::exchange::encoded(message))) return 1;
  ::_exit(0);  // without the destructors of a library that has done its work
}
