// A page becomes paper as the reader's own browser would print it: the sheets are laid out by the style of
// the page, once, and nothing here knows what stands on them.
#include "planner/door/report/print.h"

#include <stdlib.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <thread>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/loading/process.h"

namespace capstan::report {
namespace {

namespace fs = std::filesystem;

constexpr std::array<std::string_view, 4> kBrowsers = {"chromium", "chromium-browser", "google-chrome",
                                                       "google-chrome-stable"};
/// Default, unsourced: a report of a large part takes a tenth of it.
constexpr std::chrono::seconds kMostTime{120};

/// A folder under a name of its own, gone with this object.
class OwnFolder {
 public:
  OwnFolder() {
    std::error_code ec;
    std::string name = (fs::temp_directory_path(ec) / "capstan-print-XXXXXX").string();
    if (!ec && ::mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~OwnFolder() {
    // Helpers of a browser that was ended live a moment longer, and write into its folder.
    std::error_code failed;
    for (int tries = 0; tries < 40 && !path_.empty(); ++tries) {
      fs::remove_all(path_, failed);
      if (!fs::exists(path_, failed)) return;
      std::this_thread::sleep_for(std::chrono::milliseconds{50});
    }
  }
  OwnFolder(const OwnFolder&) = delete;
  OwnFolder& operator=(const OwnFolder&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
};

/// Drawn by the processor, so that every machine draws alike; nothing is fetched, looked up or kept.
std::vector<std::string> arguments(const std::string& folder) {
  std::vector<std::string> out = {"--headless",
                                  "--disable-gpu",
                                  "--use-gl=angle",
                                  "--use-angle=swiftshader",
                                  "--enable-unsafe-swiftshader",
                                  "--disable-dev-shm-usage",
                                  "--no-first-run",
                                  "--no-default-browser-check",
                                  "--disable-background-networking",
                                  "--disable-component-update",
                                  "--disable-default-apps",
                                  "--disable-extensions",
                                  "--disable-sync",
                                  "--disable-breakpad",
                                  "--host-resolver-rules=MAP * ~NOTFOUND",
                                  "--user-data-dir=" + folder + "/profile",
                                  "--no-pdf-header-footer",
                                  "--print-to-pdf-no-header",  // the same, of older ones
                                  "--print-to-pdf=" + folder + "/page.pdf"};
  // The browser refuses to run as root with its own fence; the page is ours.
  if (::geteuid() == 0) out.emplace_back("--no-sandbox");
  out.push_back("file://" + folder + "/page.html");
  return out;
}

/// How the browser ended, where that is no PDF.
Diagnostic fault_of(const std::string& browser, const ProcessEnd& end) {
  if (end.kind == ProcessEnd::Kind::kStopped)
    return {.code = "APP-STOPPED", .message = "stopped before its end; nothing is given"};
  Diagnostic d{.code = "OUT-PRINT",
               .message = {},
               .hint = "write the report as .html, open it in a browser and print it"};
  if (end.kind == ProcessEnd::Kind::kWall) {
    d.message = browser + " did not print the report within " + std::to_string(kMostTime.count()) + " s";
    return d;
  }
  d.message = browser + " ended without a PDF (" +
              (end.kind == ProcessEnd::Kind::kExited ? "status " : "signal ") + std::to_string(end.status) +
              ")";
  if (const std::string first = end.error.substr(0, end.error.find('\n')); !first.empty())
    d.message += ": " + first;
  return d;
}

}  // namespace

Result<std::string> find_browser() {
  const char* path = std::getenv("PATH");
  const std::string_view folders = path == nullptr ? std::string_view() : std::string_view(path);
  for (const std::string_view name : kBrowsers) {
    for (std::size_t at = 0; at <= folders.size();) {
      const std::size_t end = std::min(folders.find(':', at), folders.size());
      const fs::path file = fs::path(folders.substr(at, end - at)) / name;
      std::error_code ignored;
      if (end > at && fs::is_regular_file(file, ignored) && ::access(file.c_str(), X_OK) == 0)
        return file.string();
      at = end + 1;
    }
  }
  std::string all;
  for (const std::string_view name : kBrowsers) all += (all.empty() ? "" : ", ") + std::string(name);
  return fail({.code = "OUT-BROWSER",
               .message = "a PDF is printed by a browser, and PATH has none of " + all,
               .hint = "install one (Debian: apt install chromium), or write the report as .html"});
}

Result<std::string> printed(const std::string& page, const Job& job) {
  const auto browser = find_browser();
  if (!browser) return browser;
  const OwnFolder folder;
  if (folder.path().empty())
    return fail({.code = "FILE-WRITE",
                 .message = "no folder can be made where temporary files go",
                 .hint = "set TMPDIR to a folder that can be written"});
  if (auto ok = write_file(folder.path() + "/page.html", page); !ok) return tl::unexpected(ok.error());
  const auto end = run_process(*browser, arguments(folder.path()), {}, {.wall = kMostTime}, job);
  if (!end) return tl::unexpected(end.error());
  std::error_code ignored;
  const std::string out = folder.path() + "/page.pdf";
  const bool ended = end->kind == ProcessEnd::Kind::kExited && end->status == 0;
  if (!ended || !fs::exists(out, ignored)) return fail(fault_of(*browser, *end));
  auto bytes = read_file(out);
  if (!bytes) return bytes;
  if (!bytes->starts_with("%PDF-")) return fail(fault_of(*browser, *end));
  return timeless(*std::move(bytes));
}

std::string timeless(std::string pdf) {
  // Entries of the document's information, `/CreationDate (D:20260101120000+00'00')`: blanks may stand there.
  for (const std::string_view name : {"/CreationDate (D:", "/ModDate (D:"}) {
    const std::size_t at = pdf.find(name);
    if (at == std::string::npos) continue;
    const std::size_t close = pdf.find(')', at);
    if (close != std::string::npos) pdf.replace(at, close + 1 - at, close + 1 - at, ' ');
  }
  return pdf;
}

}  // namespace capstan::report
