#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "casebase/casebase.h"
#include "casebase/store/checksum.h"
#include "casebase/store/local.h"
#include "planner/ground/base/file.h"

namespace capstan::casebase {
namespace {

/// Parameters of a URI that say where the server is; none of them is a secret.
constexpr std::string_view kShown[] = {"host", "hostaddr", "port", "dbname", "user", "service"};

/// Those parameters of a URI, in their order.
std::string shown_of(std::string_view query) {
  std::string out;
  while (!query.empty()) {
    const std::string_view one = query.substr(0, query.find('&'));
    query.remove_prefix(std::min(query.size(), one.size() + 1));
    for (const std::string_view key : kShown) {
      if (one.substr(0, one.find('=')) == key) out.append(out.empty() ? "?" : "&").append(one);
    }
  }
  return out;
}

std::string data_home() {
  if (const char* own = std::getenv("CAPSTAN_CASES"); own != nullptr && *own != '\0') return own;
  if (const char* xdg = std::getenv("XDG_DATA_HOME"); xdg != nullptr && *xdg != '\0')
    return std::string(xdg) + "/capstan/cases";
  if (const char* home = std::getenv("HOME"); home != nullptr && *home != '\0')
    return std::string(home) + "/.local/share/capstan/cases";
  return {};
}

}  // namespace

// What libpq takes for the password depends on which signs are percent-encoded; a password that is not may
// reach into host, port or path. So only what cannot be a part of one is kept: before the last '@' the user
// up to the first ':'; behind the host a port of digits; nothing of the parameters once one holds an '@'.
std::string name_of(const std::string& uri) {
  const std::size_t scheme = uri.find("://");
  if (scheme == std::string::npos) {
    return uri.starts_with("postgres") && uri.find('@') != std::string::npos ? uri.substr(0, uri.find(':'))
                                                                             : uri;
  }
  std::string out = uri.substr(0, scheme + 3);
  std::string_view rest = std::string_view(uri).substr(scheme + 3);
  const std::string_view query =
      rest.find('?') == std::string_view::npos ? "" : rest.substr(rest.find('?') + 1);
  if (query.find('@') != std::string_view::npos) return out + "...";
  rest = rest.substr(0, rest.find('?'));
  if (const std::size_t at = rest.rfind('@'); at != std::string_view::npos) {
    const std::string_view user = rest.substr(0, at);
    out.append(user.substr(0, user.find_first_of(":/@"))).append("@");
    rest.remove_prefix(at + 1);
  }
  const std::string_view host = rest.substr(0, rest.find('/'));
  rest.remove_prefix(host.size());
  const std::size_t colon = host.starts_with('[') ? host.find(':', host.find(']')) : host.find(':');
  out.append(host.substr(0, colon));
  if (colon != std::string_view::npos) {
    const std::string_view port = host.substr(colon + 1);
    out.append(":").append(port.find_first_not_of("0123456789") == std::string_view::npos ? port : "...");
  }
  return out.append(rest.substr(0, rest.find(':'))) + shown_of(query);
}

Result<LocalFiles> local_files(const std::string& name) {
  const std::string folder = data_home();
  std::error_code wrong;
  if (!folder.empty()) std::filesystem::create_directories(folder, wrong);
  if (folder.empty() || wrong) {
    return fail(Diagnostic{
        .code = "CASE-STORE",
        .message = folder.empty()
                       ? "there is no folder for local copies of case bases"
                       : "the folder for local copies of case bases cannot be made: " + wrong.message(),
        .file = folder,
        .hint = "set CAPSTAN_CASES to a folder that may be written"});
  }
  const std::string stem = folder + "/" + hex64(sum_of(name).high);
  return LocalFiles{stem + ".copy.db", stem + ".outbox.db", stem + ".lock"};
}

Result<FileLock> FileLock::take(const std::string& path) {
  constexpr int kTurnMs = 5;
  FileLock lock(::open(path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  for (int waited = 0; lock.fd_ >= 0; waited += kTurnMs) {
    if (::flock(lock.fd_, LOCK_EX | LOCK_NB) == 0) return lock;
    if (waited >= kBusyMs) break;
    std::this_thread::sleep_for(std::chrono::milliseconds(kTurnMs));
  }
  return fail(Diagnostic{.code = "CASE-BUSY",
                         .message = "the lock of the local copy cannot be taken",
                         .file = path,
                         .hint = "another program is writing to it; try again"});
}

FileLock::~FileLock() {
  if (fd_ >= 0) ::close(fd_);
}

Result<FileRows> rows_of(Store& file) {
  FileRows out;
  Result<std::string> stated = file.read(0, [&](std::int64_t number, std::string_view head) -> Status {
    out.totals.count(head);
    out.rows.push_back({number, std::string(head), {}});
    return {};
  });
  if (!stated) return fail(stated.error());
  out.stated = *std::move(stated);
  out.whole = totals_of(out.stated) == std::optional(out.totals);
  return out;
}

}  // namespace capstan::casebase
