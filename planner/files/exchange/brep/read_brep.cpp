#include "planner/files/exchange/brep/read_brep.h"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <utility>
#include <vector>

#include "planner/files/exchange/brep/message.h"
#include "planner/files/exchange/brep/read_pmi.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/loading/beside.h"
#include "planner/ground/base/loading/process.h"
#include "planner/ground/base/number.h"

namespace capstan::exchange {
namespace {

namespace fs = std::filesystem;

constexpr const char* kProgram = "capstan-brep";
constexpr const char* kExport = "export the part again from the CAD system";

bool executable(const std::string& path) {
  return ::access(path.c_str(), X_OK) == 0 && !fs::is_directory(path);
}

Result<std::string> find_helper(const BrepLimits& limits) {
  const char* said = std::getenv("CAPSTAN_BREP");
  const std::string named = !limits.helper.empty() ? limits.helper : said != nullptr ? said : "";
  const auto tried = named.empty() ? places_beside(kProgram) : std::vector<std::string>{named};
  const auto at = std::find_if(tried.begin(), tried.end(), executable);
  if (at != tried.end()) return *at;
  std::string list;
  for (const std::string& place : tried) list += (list.empty() ? "" : ", ") + place;
  return fail(
      {.code = "BREP-HELPER",
       .message =
           "the shapes of STEP files are read by the program capstan-brep, which is not there (" + list + ")",
       .hint = "install it: Capstan built with OpenCASCADE (Debian: libocct-data-exchange-dev); or set "
               "CAPSTAN_BREP to its path"});
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

/// What to say of a helper that did not do its work.
Diagnostic fault_of(const ProcessEnd& end, const std::string& helper, const BrepLimits& limits) {
  switch (end.kind) {
    case ProcessEnd::Kind::kStopped:
      return {.code = "BREP-STOPPED", .message = "reading the shape was stopped before its end"};
    case ProcessEnd::Kind::kProcessor:
      return {.code = "BREP-TIME",
              .message = "reading the shape takes more than " + std::to_string(limits.processor_s) +
                         " s of processor time",
              .hint = "simplify the part, or export it again from the CAD system"};
    case ProcessEnd::Kind::kWall:
      return {.code = "BREP-TIME",
              .message = "reading the shape takes more than " + std::to_string(limits.wall_s) + " s",
              .hint = "simplify the part, or export it again from the CAD system"};
    case ProcessEnd::Kind::kOutput:
      return {
          .code = "BREP-LIMIT",
          .message = "the shape is described by more than " + std::to_string(limits.message_bytes) + " bytes",
          .hint = "simplify the part"};
    case ProcessEnd::Kind::kSignal:
      return {.code = "BREP-CRASH",
              .message = "OpenCASCADE crashed on this file (capstan-brep ended by signal " +
                         std::to_string(end.status) + ")",
              .hint = kExport};
    case ProcessEnd::Kind::kExited:
      break;
  }
  // 127: the system's loader, or exec, gave up.
  if (end.status == 126 || end.status == 127)
    return {
        .code = "BREP-HELPER",
        .message = helper + " cannot be started" + (end.error.empty() ? "" : ": " + first_line(end.error)),
        .hint = "install it with its libraries (Debian: libocct-data-exchange-7.6)"};
  return {.code = "BREP-CRASH",
          .message = "capstan-brep ended with " + std::to_string(end.status) +
                     (end.error.empty() ? "" : ": " + first_line(end.error)),
          .hint = kExport};
}

constexpr std::string_view kFaceKeywords[] = {"ADVANCED_FACE", "FACE_SURFACE"};
bool is_face(const p21::Instance& i) {
  return std::any_of(std::begin(kFaceKeywords), std::end(kFaceKeywords), [&i](std::string_view keyword) {
    return i.is_complex() ? i.part(keyword).has_value() : i.keyword() == keyword;
  });
}

/// The name of an instance that is a representation item: its first parameter, or that of its part.
std::string name_of(const p21::Instance& i) {
  const auto parameters = i.is_complex() ? i.part("REPRESENTATION_ITEM") : i.parameters();
  if (!parameters || !parameters->is(p21::Kind::kList) || parameters->empty()) return {};
  const p21::Value name = (*parameters)[0];
  return name.is(p21::Kind::kString) ? name.as_text() : std::string();
}

/// Names from the file itself. Numbers that lead to no face of it are taken back.
void join(const p21::File& file, Brep& brep, Job& job) {
  std::size_t wrong = 0;
  for (Face& face : brep.faces) {
    if (face.id == 0) continue;
    const auto instance = file.find(static_cast<std::uint64_t>(face.id));
    if (instance && is_face(*instance)) {
      face.name = name_of(*instance);
    } else {
      face.id = 0;
      ++wrong;
    }
  }
  for (Body& body : brep.bodies) {
    const auto instance = file.find(static_cast<std::uint64_t>(body.id));
    if (instance) body.name = name_of(*instance);
  }
  if (wrong == 0) return;
  job.report(
      {.code = "BREP-ID",
       .severity = Severity::kWarning,
       .message = counted(wrong, "face", "faces") + " of the shape cannot be traced to the file's instances",
       .file = file.name()});
}

}  // namespace

Result<Brep> read_brep(const std::string& path, const BrepLimits& limits, Job& job) {
  auto bytes = read_file(path, limits.file.bytes);
  if (!bytes) return fail(bytes.error());
  return read_brep_bytes(std::move(*bytes), path, limits, job);
}

Result<Brep> read_brep_bytes(std::string bytes, const std::string& name, const BrepLimits& limits, Job& job) {
  const auto refused = [&name](Diagnostic d) {
    d.file = name;
    return fail(std::move(d));
  };
  const std::string step = bytes;
  const auto file = p21::parse(std::move(bytes), name, limits.file, job);
  if (!file) return fail(file.error());
  std::size_t faces = 0;
  for (const p21::Instance& i : *file) faces += is_face(i) ? 1 : 0;
  if (faces > limits.faces)
    return refused({.code = "BREP-LIMIT",
                    .message = "the file has " + std::to_string(faces) + " faces; at most " +
                               std::to_string(limits.faces) + " are read",
                    .hint = "simplify the part"});
  const auto helper = find_helper(limits);
  if (!helper) return refused(helper.error());
  const auto end = run_process(*helper, {shortest(limits.chord_mm)}, step,
                               {.processor_s = limits.processor_s,
                                .wall = std::chrono::seconds(limits.wall_s),
                                .memory_bytes = limits.memory_bytes,
                                .output_bytes = limits.message_bytes},
                               job);
  if (!end) return refused(end.error());
  if (end->kind != ProcessEnd::Kind::kExited || end->status != 0)
    return refused(fault_of(*end, *helper, limits));
  auto message = decoded(end->out);
  if (!message) return refused(message.error());
  // The last error is the answer; what else was said goes to the job.
  std::optional<Diagnostic> fault;
  for (Diagnostic& d : message->remarks) {
    d.file = name;
    if (const auto at = file->find(d.instance); d.instance != 0 && at) d.line = at->line();
    if (d.severity != Severity::kError) {
      job.report(std::move(d));
      continue;
    }
    if (fault) job.report(*std::move(fault));
    fault = std::move(d);
  }
  if (fault) return fail(*std::move(fault));
  join(*file, *message->brep, job);
  message->brep->pmi = read_pmi(*file);
  return *std::move(message->brep);
}

}  // namespace capstan::exchange
