#include "tooling/library/formats/format.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <set>

#include "planner/ground/base/file.h"
#include "planner/ground/base/foreign/foreign_file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/base/text.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/byte_cap.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/values.h"
#include "tooling/library/records/check.h"
#include "tooling/shop/data/tree.h"

namespace capstan::tooling {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kFolderFilesCap = 20'000;
constexpr int kFolderDepthCap = 8;

Diagnostic unknown_kind(const std::string& file, std::string message) {
  std::string names;
  for (const Format& f : formats()) {
    if (f.read == nullptr) continue;
    names += (names.empty() ? "" : ", ") + std::string(f.title);
  }
  return {.code = "LIBRARY-KIND",
          .message = std::move(message),
          .file = file,
          .expected = names,
          .hint = "export the library in one of these formats"};
}

/// Of a file that no format recognises: what it is, where that is known.
Diagnostic no_library(std::string_view bytes, const std::string& file) {
  const auto foreign = foreign_file(bytes);
  return unknown_kind(file, foreign ? "this is " + std::string(foreign->what) + ", which is no tool library"
                                    : "this is no tool library that can be read");
}

const Format* format_of(std::string_view bytes, const std::string& file) {
  for (const Format& f : formats())
    if (f.recognises != nullptr && f.recognises(bytes, file)) return &f;
  return nullptr;
}

/// The library's files, in the order of their paths; whole paths.
Result<std::vector<std::string>> files_below(const std::string& folder) {
  std::vector<std::string> out;
  std::error_code error;
  fs::recursive_directory_iterator at(folder, fs::directory_options::none, error), end;
  for (; !error && at != end; at.increment(error)) {
    if (at.depth() >= kFolderDepthCap) at.disable_recursion_pending();
    std::error_code ignored;
    if (!at->is_regular_file(ignored)) continue;
    out.push_back(at->path().string());
    if (out.size() > kFolderFilesCap)
      return fail({.code = "FILE-TOO-LARGE",
                   .message = "more than " + std::to_string(kFolderFilesCap) + " files in a folder",
                   .file = folder,
                   .hint = "name the library's own folder"});
  }
  if (error)
    return fail({.code = "FILE-READ", .message = error.message(), .file = folder, .hint = "is it there?"});
  std::sort(out.begin(), out.end());
  return out;
}

/// Adds what is not there yet; of equal id and content is the same record, met again.
template <class T>
void add(std::vector<T>& into, std::vector<T> from, const std::string& file, LossReport& report) {
  for (T& r : from) {
    const auto same = std::find_if(into.begin(), into.end(), [&r](const T& o) { return o.id == r.id; });
    if (same == into.end())
      into.push_back(std::move(r));
    else if (!(*same == r))
      report.dropped.push_back({r.id, "", "given otherwise in an earlier file than " + file});
  }
}

void merge(Imported& into, Imported from, const std::string& file) {
  LossReport& report = into.report;
  add(into.library.items, std::move(from.library.items), file, report);
  add(into.library.instances, std::move(from.library.instances), file, report);
  add(into.library.holders, std::move(from.library.holders), file, report);
  add(into.library.assemblies, std::move(from.library.assemblies), file, report);
  for (MachineEntry& e : from.library.entries) {
    auto& there = into.library.entries;
    if (std::find(there.begin(), there.end(), e) == there.end()) there.push_back(std::move(e));
  }
  for (auto& [path, text] : from.library.kept) {
    std::pair<std::string, std::string> one(fs::path(file).filename().string() + ":" + path, std::move(text));
    auto& kept = into.library.kept;
    if (std::find(kept.begin(), kept.end(), one) == kept.end()) kept.push_back(std::move(one));
  }
  const auto lines = [](auto& to, auto& add_these) {
    for (auto& line : add_these)
      if (std::find(to.begin(), to.end(), line) == to.end()) to.push_back(std::move(line));
  };
  lines(report.derived, from.report.derived);
  lines(report.dropped, from.report.dropped);
}

/// Endings that only tool libraries have: such a file that is none is damaged.
constexpr std::array<std::string_view, 4> kOwnEndings = {".tools", ".fctl", ".fctb", ".tbl"};

bool has_own_ending(const std::string& file) {
  const std::string name = lower_text(file);
  return std::ranges::any_of(kOwnEndings, [&](std::string_view ending) { return name.ends_with(ending); });
}

/// Reads the libraries of a folder, file by file: one with a fault is left out and told, once.
class FolderReader {
 public:
  FolderReader(const std::string& folder, const FormatOptions& options, Job& job)
      : folder_(folder), options_(options), job_(job) {}

  Result<Imported> read() {
    const auto files = files_below(folder_);
    if (!files) return fail(files.error());
    for (const std::string& file : *files) {
      if (Status s = read_one(file); !s) return fail(s.error());
    }
    if (libraries_ == 0) {
      if (auto d = tell(std::move(faults_), job_)) return fail(*std::move(d));
      return fail(unknown_kind(folder_, "there is no tool library in this folder"));
    }
    for (Diagnostic& d : faults_) {
      out_.report.dropped.push_back({"", "", d.file + ": " + d.message});
      d.severity = Severity::kWarning;
      d.message += "; the file is left out";
      job_.report(std::move(d));
    }
    out_.library.name = fs::path(folder_).filename().string();
    out_.library.source = folder_;
    out_.report.tools = out_.library.items.size();
    return std::move(out_);
  }

 private:
  /// Fails  only where the folder as a whole cannot be read.
  Status read_one(const std::string& file) {
    const auto bytes = read_file(file, kLibraryBytesCap);
    if (!bytes) {
      leave_out(file, {bytes.error()});
      return {};
    }
    total_ += bytes->size();
    if (total_ > kLibraryBytesCap)
      return fail(
          {.code = "FILE-TOO-LARGE",
           .message = "the folder's files are larger than " + std::to_string(kLibraryBytesCap) + " bytes",
           .file = folder_,
           .hint = "name the library's own folder"});
    const Format* format = format_of(*bytes, file);
    // A column of words in some file of a folder is no library: tables are named one by one.
    if (format == nullptr || format->read == nullptr || format->name == "csv") {
      if (has_own_ending(file))
        leave_out(file, {no_library(*bytes, file)});
      else
        out_.report.dropped.push_back({"", "", file + ": not a tool library of a known format"});
      return {};
    }
    Job of_file;
    auto one = format->read(*bytes, file, options_, of_file);
    std::vector<Diagnostic> faults;
    for (Diagnostic& d : of_file.take_diagnostics()) {
      if (d.severity == Severity::kError) {
        faults.push_back(std::move(d));
        continue;
      }
      // What a list says of a bit beside it, and what that bit's own reading says.
      const bool of_other = !d.file.empty() && d.file != file;
      if (one && (!of_other || told_.insert(d.file).second)) job_.report(std::move(d));
    }
    if (!one && std::ranges::find(faults, one.error()) == faults.end()) faults.push_back(one.error());
    if (one) faults = check_library(one->library, file);
    if (!faults.empty()) {
      leave_out(file, std::move(faults));
      return {};
    }
    merge(out_, *std::move(one), file);
    ++libraries_;
    return {};
  }

  /// The first fault stands for the file; who imports the file alone sees all.
  void leave_out(const std::string& file, std::vector<Diagnostic> faults) {
    if (!told_.insert(file).second) return;
    Diagnostic d = std::move(faults.front());
    d.file = file;
    if (faults.size() > 1)
      d.message += ", and " + counted(faults.size() - 1, "more fault", "more faults") + " of this file";
    faults_.push_back(std::move(d));
  }

  const std::string& folder_;
  const FormatOptions& options_;
  Job& job_;
  Imported out_;
  std::size_t libraries_ = 0, total_ = 0;
  std::vector<Diagnostic> faults_;  ///< of files that are left out
  std::set<std::string> told_;      ///< those files
};

}  // namespace

const std::vector<Format>& formats() {
  static const std::vector<Format> kFormats = {
      // Archives and marked files first; tables, which have few marks, last.
      store_format(),  fusion_format(),    fusion_json_format(), own_format(),       freecad_format(),
      gtc_format(),    iso13399_format(),  din4000_format(),     hypermill_format(), solidcam_format(),
      family_format(), mtconnect_format(), linuxcnc_format(),    csv_format(),
  };
  return kFormats;
}

const Format* find_format(std::string_view name) {
  for (const Format& f : formats())
    if (f.name == name) return &f;
  return nullptr;
}

const Format* format_of_ending(std::string_view path) {
  const std::string name = lower_text(path);
  for (const Format& f : formats()) {
    if (f.write == nullptr) continue;
    for (const auto ending : f.endings)
      if (name.ends_with(ending)) return &f;
  }
  return nullptr;
}

Result<Imported> import_bytes(std::string_view bytes, const std::string& file, const FormatOptions& options,
                              Job& job) {
  // Who gives a column map says that it is a table.
  const Format* format = options.column_map.empty() ? format_of(bytes, file) : &csv_format();
  if (format == nullptr) return fail(no_library(bytes, file));
  if (format->read == nullptr)
    return fail(unknown_kind(file, std::string(format->title) + " can be written, not read"));
  auto out = format->read(bytes, file, options, job);
  if (!out) return fail(out.error());
  if (auto d = tell(check_library(out->library, file), job)) return fail(*std::move(d));
  return out;
}

Result<Imported> import_library(const std::string& path, const FormatOptions& options, Job& job) {
  std::error_code error;
  if (fs::is_directory(path, error)) {
    auto out = FolderReader(path, options, job).read();
    if (!out) return fail(out.error());
    if (auto d = tell(check_library(out->library, path), job)) return fail(*std::move(d));
    return out;
  }
  const auto bytes = read_file(path, kLibraryBytesCap);
  if (!bytes) return fail(bytes.error());
  return import_bytes(*bytes, path, options, job);
}

}  // namespace capstan::tooling
