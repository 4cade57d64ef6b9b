#include "planner/door/service/outputs.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <set>
#include <system_error>
#include <utility>

#include "planner/ground/base/file.h"

namespace capstan::service {
namespace {

namespace fs = std::filesystem;

std::string supported() { return written_endings() + ", or - for JSON on standard output"; }

/// Adds the file's name to a writer's diagnostics that name none.
void name_file(Job& job, const std::string& path) {
  for (Diagnostic& d : job.take_diagnostics()) {
    if (d.file.empty() && d.code == "EXC-LOSS") d.file = path;
    job.report(std::move(d));
  }
}

}  // namespace

Result<Output> output_of(const std::string& path) {
  if (path == "-") return Output{path, find_format("json"), {}, 0};
  const std::string ending = fs::path(path).extension().string();
  const Format* format = format_of_ending(ending);
  if (format != nullptr && format->write != nullptr) return Output{path, format, {}, 0};
  if (format != nullptr && !format->reads)
    return fail(
        {.code = "OUT-KIND",
         .message = "writing " + std::string(format->words) + " (" + ending + ") is not supported yet",
         .file = path,
         .expected = supported()});
  return fail({.code = "OUT-KIND",
               .message = ending.empty() ? "the name has no ending, which says what to write"
                                         : "the ending '" + ending + "' names no format",
               .file = path,
               .expected = supported()});
}

Result<std::vector<Output>> outputs_of(const std::vector<std::string>& paths) {
  std::vector<Output> out;
  for (const std::string& path : paths) {
    auto one = output_of(path);
    if (!one) return tl::unexpected(one.error());
    out.push_back(*std::move(one));
  }
  return out;
}

Status make(const model::Plan& plan, std::vector<Output>& outputs, Job& job) {
  for (Output& o : outputs) {
    auto written = write(plan, *o.format, job);
    if (!written) return tl::unexpected(written.error());
    name_file(job, o.path);
    o.bytes = std::move(written->bytes);
    o.losses = written->losses;
  }
  return {};
}

std::string losses_text(const Output& o) {
  if (o.losses == 0) return {};
  return " (without " + std::to_string(o.losses) + (o.losses == 1 ? " thing" : " things") +
         ", see the notes)";
}

Aside left_there(const std::string& path) {
  std::error_code ignored;
  return {fs::exists(path, ignored) ? Aside::kStays : Aside::kNothingThere, {}};
}

Aside set_aside(const std::string& path) {
  if (left_there(path).outcome == Aside::kNothingThere) return {};
  std::error_code ec;
  // An earlier copy stays: it may be the last good program. Of a link its target is renamed, because that is
  // the program that runs.
  const std::string file = fs::is_symlink(fs::symlink_status(path, ec)) ? resolved(path) : path;
  std::string to = file + ".before";
  for (int n = 2; fs::exists(to, ec) && n < 1000; ++n) to = file + ".before." + std::to_string(n);
  if (fs::exists(to, ec)) return {Aside::kStays, {}};
  // Only a file goes: another thing of that name (a device, a pipe) is not ours.
  if (!fs::is_regular_file(file, ec)) return {Aside::kStays, {}};
  fs::rename(file, to, ec);
  return ec ? Aside{Aside::kStays, {}} : Aside{Aside::kRenamed, to};
}

Status can_be_written(const std::vector<std::string>& outputs, const std::vector<std::string>& inputs,
                      bool force) {
  std::set<std::string> seen;
  for (const std::string& path : outputs) {
    const std::string target = path == "-" ? path : resolved(path);
    if (!seen.insert(target).second)
      return fail({.code = "OUT-TWICE", .message = "this output is named twice", .file = path});
    if (path == "-") continue;
    for (const std::string& in : inputs) {
      std::error_code ec;
      if (force || (resolved(in) != target && !fs::equivalent(in, target, ec))) continue;
      return fail({.code = "OUT-INPUT",
                   .message = "this output is also read by the call (as " + in + ") and would be lost",
                   .file = path,
                   .hint = "name another file, or --force to replace it"});
    }
    if (auto ok = writable(path); !ok) return ok;
  }
  return {};
}

Status write_all(const std::vector<Output>& outputs) {
  std::vector<StagedFile> files;
  for (const Output& o : outputs) {
    if (o.path == "-") continue;
    auto staged = StagedFile::make(o.path, o.bytes);
    if (!staged) return tl::unexpected(staged.error());
    files.push_back(*std::move(staged));
  }
  std::string done;
  for (StagedFile& f : files) {
    if (auto ok = f.put(); !ok) {
      if (!done.empty()) {
        ok.error().code = "FILE-PARTLY";
        ok.error().message += "; already in place: " + done;
      }
      return ok;
    }
    done += (done.empty() ? "" : ", ") + f.path();
  }
  for (const Output& o : outputs) {
    if (o.path != "-") continue;
    const bool put = std::fwrite(o.bytes.data(), 1, o.bytes.size(), stdout) == o.bytes.size();
    if (!put || std::fflush(stdout) != 0)
      return fail({.code = "FILE-WRITE", .message = "standard output cannot be written", .file = "-"});
  }
  return {};
}

}  // namespace capstan::service
