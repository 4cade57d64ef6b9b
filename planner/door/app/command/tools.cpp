#include <cstdio>
#include <filesystem>

#include "planner/door/app/command/session.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "planner/ground/vocabulary/unit_factors.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/format.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/item/losses.h"
#include "tooling/library/formats/json.h"
#include "tooling/library/library.h"

// Tool libraries from one format to another, with what is lost on the way.

namespace capstan::app {
namespace {

namespace fs = std::filesystem;
using tooling::Format;
using tooling::FormatOptions;
using tooling::json_quoted;
using tooling::LossReport;

std::string lines_json(const std::vector<LossReport::Line>& lines) {
  std::string out = "[";
  for (const auto& l : lines) {
    out += (out.size() > 1 ? ",\n    " : "\n    ") + std::string("{\"tool\": ") + json_quoted(l.tool) +
           ", \"field\": " + json_quoted(l.field) + ", \"what\": " + json_quoted(l.what) + "}";
  }
  return out + (lines.empty() ? "]" : "\n  ]");
}

std::string report_json(const LossReport& r) {
  return "{\n  \"tools\": " + std::to_string(r.tools) + ",\n  \"derived\": " + lines_json(r.derived) +
         ",\n  \"dropped\": " + lines_json(r.dropped) + "\n}";
}

class Tools {
 public:
  explicit Tools(Session& s) : s_(s) {}

  int run() {
    const auto& o = s_.options;
    if (const int code = options(); code != kDone) return code;
    auto in = read();
    if (!in) return s_.end(in.error(), kUnreadable);
    told("read", from_, in->report);
    if (in->report.tools == 0 && in->library.entries.empty())
      return s_.end({.code = "LIBRARY-EMPTY",
                     .message = "there is no tool in it",
                     .file = from_,
                     .expected = "a library of one tool or more",
                     .hint = "export it again with its tools"},
                    kUnreadable);
    s_.summary =
        "read " + counted(in->report.tools, "tool", "tools") + " from " + from_ + ": " + sums(in->report);
    if (!o.tools.save_map.empty()) {
      if (const int code = save_map(in->library); code != kDone) return code;
    }
    std::string json = "{\"read\": " + report_json(in->report);
    if (o.outputs.empty()) {
      if (const int code = usable(in->library); code != kDone) return code;
    }
    json += ", \"written\": [";
    for (const std::string& path : o.outputs) {
      LossReport report;
      if (const int code = write(in->library, path, report); code != kDone) return code;
      json += (json.ends_with('[') ? "" : ", ") + std::string("{\"file\": ") + json_quoted(path) +
              ", \"report\": " + report_json(report) + "}";
    }
    for (StagedFile& f : staged_) {
      if (auto ok = f.put(); !ok) return s_.end(ok.error(), kImpossible);
    }
    json += "]}\n";
    if (o.json && !print(json)) return kImpossible;
    return kDone;
  }

 private:
  static std::string sums(const LossReport& r) {
    return counted(r.derived.size(), "value", "values") + " derived, " + std::to_string(r.dropped.size()) +
           " dropped";
  }

  int options() {
    const auto& t = s_.options.tools;
    if (t.unit == "mm") formats_.mm_per_unit = 1.0;
    if (t.unit == "inch") formats_.mm_per_unit = kMmPerInch;
    if (t.column_map.empty()) return kDone;
    auto text = read_file(t.column_map, std::size_t{16} << 20);
    if (!text) return s_.end(text.error(), kUnreadable);
    formats_.column_map = *std::move(text);
    return kDone;
  }

  Result<tooling::Imported> read() {
    const auto& o = s_.options;
    FormatOptions how = formats_;
    if (o.command == Command::kToolsExport) {
      from_ = o.inputs.tools.value_or(std::string(tooling::kGeneric));
      how.column_map.clear();  // it is for what is written
    } else {
      from_ = o.files.front();
    }
    if (from_ != tooling::kGeneric && from_ != tooling::kGenericInch)
      return tooling::import_library(from_, how, s_.job);
    const auto cutters = tooling::load_library(from_, s_.job);
    if (!cutters) return fail(cutters.error());
    tooling::Imported out;
    out.library = tooling::library_of(*cutters, from_);
    out.report.tools = cutters->size();
    return out;
  }

  /// The lines of a report on standard error: all with --report, else what is dropped, alike ones together.
  void told(const char* what, const std::string& file, const LossReport& r) {
    const auto note = [&](const char* code, const std::string& text) {
      s_.job.report({.code = code, .severity = Severity::kNote, .message = text, .file = file});
    };
    if (s_.options.tools.report) {
      for (const auto& l : r.derived)
        note("TOOLS-DERIVED", std::string(what) + ", derived: " + tooling::line_text(l));
      for (const auto& l : r.dropped)
        note("TOOLS-DROPPED", std::string(what) + ", dropped: " + tooling::line_text(l));
      return;
    }
    const auto lines = tooling::lines_together(r.dropped);
    for (std::size_t k = 0; k < lines.size() && k < tooling::kEntriesShown; ++k)
      note("TOOLS-DROPPED", std::string(what) + ", dropped: " + lines[k]);
    if (lines.size() > tooling::kEntriesShown)
      note("TOOLS-DROPPED",
           std::to_string(lines.size() - tooling::kEntriesShown) + " more; --report shows all");
  }

  /// Reports the cutters that planning could use from the library.
  int usable(const tooling::ToolLibrary& library) {
    LossReport report;
    const auto cutters = tooling::cutters_of(library, report, s_.job);
    if (!cutters) return s_.end(cutters.error(), kUnreadable);
    if (s_.options.tools.report) told("for planning", from_, report);
    s_.summary += "; planning can use " + std::to_string(cutters->size());
    return kDone;
  }

  int save_map(const tooling::ToolLibrary& library) {
    const std::string& path = s_.options.tools.save_map;
    for (const auto& [key, text] : library.kept) {
      if (key != "csv:map") continue;
      return stage(path, text);
    }
    return s_.end({.code = "APP-USAGE",
                   .message = "only tables have columns; " + from_ + " is none",
                   .hint = "leave --save-map out"},
                  kUsage);
  }

  /// All files of a call are put in place together at its end.
  int stage(const std::string& path, const std::string& bytes) {
    auto file = StagedFile::make(path, bytes);
    if (!file) return s_.end(file.error(), kImpossible);
    staged_.push_back(*std::move(file));
    return kDone;
  }

  /// Files that nobody named are written over none that is there and says something else.
  int stage_beside(const std::string& path, const tooling::Exported& out) {
    for (const auto& [name, bytes] : out.beside) {
      const std::string file = (fs::path(path).parent_path() / name).lexically_normal().string();
      const auto there = read_file(file);
      if (there && *there != bytes && !s_.options.force)
        return s_.end({.code = "OUT-THERE",
                       .message = "this file of " + path + " is there already and holds something else",
                       .file = file,
                       .hint = "write into an empty folder, or --force to replace it"},
                      kUsage);
      if (there && *there == bytes) continue;
      if (const int code = stage(file, bytes); code != kDone) return code;
    }
    return kDone;
  }

  int write(const tooling::ToolLibrary& library, const std::string& path, LossReport& report) {
    const std::string& wanted = s_.options.tools.format;
    const Format* format = wanted.empty() ? tooling::format_of_ending(path) : tooling::find_format(wanted);
    if (format == nullptr || format->write == nullptr) {
      std::string known;
      for (const Format& f : tooling::formats()) {
        if (f.write == nullptr) continue;
        known +=
            (known.empty() ? "" : ", ") + std::string(f.name) + " (" + std::string(f.endings.front()) + ")";
      }
      return s_.end({.code = "APP-FORMAT",
                     .message = wanted.empty() ? "no format of tool libraries has this ending"
                                               : "'" + wanted + "' is no format that can be written",
                     .file = path,
                     .expected = known},
                    kUsage);
    }
    FormatOptions how = formats_;
    if (s_.options.command != Command::kToolsExport) how.column_map.clear();
    how.to = path;
    auto out = format->write(library, how, s_.job);
    // One tool for a file of one is asked by the name that was given.
    if (!out) return s_.end(out.error(), out.error().code == "FREECAD-ONE" ? kUsage : kImpossible);
    if (const int code = stage(path, out->bytes); code != kDone) return code;
    if (const int code = stage_beside(path, *out); code != kDone) return code;
    told("written", path, out->report);
    s_.summary += "; wrote " + path;
    if (!out->beside.empty()) {
      const fs::path first = fs::path(path).parent_path() / out->beside.front().first;
      const std::string folder = first.lexically_normal().parent_path().string();
      s_.summary += " and " + counted(out->beside.size(), "file", "files") +
                    (fs::path(folder) == fs::path(path).parent_path() ? " beside it" : " in " + folder);
    }
    s_.summary += ": " + sums(out->report);
    report = std::move(out->report);
    return kDone;
  }

  Session& s_;
  FormatOptions formats_;
  std::string from_;
  std::vector<StagedFile> staged_;
};

}  // namespace

int run_tools_convert(Session& s) { return Tools(s).run(); }

}  // namespace capstan::app
