#include "tooling/library/formats/format.h"

#include <algorithm>
#include <filesystem>

#include "planner/ground/base/file.h"
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

Result<Imported> import_folder(const std::string& folder, const FormatOptions& options, Job& job) {
  const auto files = files_below(folder);
  if (!files) return fail(files.error());
  Imported out;
  bool any = false;
  std::size_t total = 0;
  for (const std::string& file : *files) {
    auto bytes = read_file(file, kLibraryBytesCap);
    if (!bytes) return fail(bytes.error());
    total += bytes->size();
    if (total > kLibraryBytesCap)
      return fail(
          {.code = "FILE-TOO-LARGE",
           .message = "the folder's files are larger than " + std::to_string(kLibraryBytesCap) + " bytes",
           .file = folder,
           .hint = "name the library's own folder"});
    const Format* format = format_of(*bytes, file);
    // A column of words in some file of a folder is no library: tables are named one by one.
    if (format == nullptr || format->read == nullptr || format->name == "csv") {
      out.report.dropped.push_back({"", "", file + ": not a tool library of a known format"});
      continue;
    }
    auto one = format->read(*bytes, file, options, job);
    if (!one) return fail(one.error());
    merge(out, *std::move(one), file);
    any = true;
  }
  if (!any) return fail(unknown_kind(folder, "there is no tool library in this folder"));
  out.library.name = fs::path(folder).filename().string();
  out.library.source = folder;
  out.report.tools = out.library.items.size();
  return out;
}

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
  if (format == nullptr) return fail(unknown_kind(file, "this is no tool library that can be read"));
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
    auto out = import_folder(path, options, job);
    if (!out) return fail(out.error());
    if (auto d = tell(check_library(out->library, path), job)) return fail(*std::move(d));
    return out;
  }
  const auto bytes = read_file(path, kLibraryBytesCap);
  if (!bytes) return fail(bytes.error());
  return import_bytes(*bytes, path, options, job);
}

}  // namespace capstan::tooling
