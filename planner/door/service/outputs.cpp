#include "planner/door/service/outputs.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <set>
#include <system_error>
#include <utility>

#include "planner/door/report/print.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/stopping.h"

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
  if (format != nullptr && format->write != nullptr) {
    if (format->printed) {
      if (auto browser = report::find_browser(); !browser) {
        browser.error().file = path;
        return tl::unexpected(browser.error());
      }
    }
    return Output{path, format, {}, 0};
  }
  if (format != nullptr)
    return fail({.code = "OUT-KIND",
                 .message = std::string(format->words) + " (" + ending + ") is read and not written",
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

Diagnostic stopped_call(const std::string& file) {
  return {.code = "APP-STOPPED", .message = "stopped before its end; nothing is given", .file = file};
}

Status make(const model::Plan& plan, std::vector<Output>& outputs, Job& job, const model::Plan* of_program,
            Reports reports, const Writing& how) {
  const auto all = [&]() -> Status {
    // Each writes into a job of its own; the diagnostics are reported in the order of the outputs.
    std::vector<Job> jobs(outputs.size());
    std::vector<std::optional<Result<Written>>> made(outputs.size());
    parallel_for(job, outputs.size(), [&](std::size_t i) {
      const Format& format = *outputs[i].format;
      if (format.holds == Holds::kReport && reports == Reports::kLeftToJudge) {
        made[i] = Written{};
        return;
      }
      made[i] =
          write(of_program != nullptr && format.of_program() ? *of_program : plan, format, jobs[i], how);
    });
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      Output& o = outputs[i];
      for (Diagnostic& d : jobs[i].take_diagnostics()) job.report(std::move(d));
      Result<Written>& written = *made[i];
      if (!written) return tl::unexpected(written.error());
      name_file(job, o.path);
      o.bytes = std::move(written->bytes);
      o.losses = written->losses;
    }
    poll();
    return {};
  };
  return stoppable(job, all, [&]() -> Status { return tl::unexpected(stopped_call(plan.file_name)); });
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

Status write_all(const std::vector<Output>& outputs, const Job& job) {
  std::vector<StagedFile> files;
  for (const Output& o : outputs) {
    if (o.path == "-") continue;
    if (job.stop_requested()) return fail(stopped_call(o.path));
    auto staged = StagedFile::make(o.path, o.bytes);
    if (!staged) return tl::unexpected(staged.error());
    files.push_back(*std::move(staged));
  }
  // From here on all are put in place: a rename takes no time, and half of them would be worse.
  if (job.stop_requested()) return fail(stopped_call({}));
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
    // Who reads may have enough before the end: `| head`.
    if ((!put || std::fflush(stdout) != 0) && errno != EPIPE)
      return fail({.code = "FILE-WRITE", .message = "standard output cannot be written", .file = "-"});
  }
  return {};
}

}  // namespace capstan::service
