#include "tooling/library/library.h"

#include <filesystem>

#include "planner/ground/base/file.h"
#include "planner/ground/base/nearest_names.h"
#include "tooling/library/cutters/generic.h"
#include "tooling/library/formats/all.h"
#include "tooling/library/formats/byte_cap.h"
#include "tooling/library/formats/import.h"
#include "tooling/library/formats/own/own_list.h"
#include "tooling/library/store/store.h"

namespace capstan::tooling {

using model::Cutter;

Result<std::vector<Cutter>> read_library(std::string_view text, const std::string& file, Job& job,
                                         const LibraryOptions& options) {
  // Our own list names every field of a cutter: no way round by the records.
  if (own_format().recognises(text, file)) return read_own_list(text, file, job);
  if (looks_like_store(text)) {
    const auto store = ToolStore::from_bytes(std::string(text), file);
    if (!store) return fail(store.error());
    return store->all_cutters();
  }
  FormatOptions o;
  o.mm_per_unit = options.mm_per_unit;
  const auto imported = import_bytes(text, file, o, job);
  if (!imported) return fail(imported.error());
  LossReport report;
  return cutters_of(imported->library, report, job, options.offsets_against_reference);
}

Result<std::vector<Cutter>> read_tool_table(std::string_view text, const std::string& file, Job& job,
                                            const LibraryOptions& options) {
  FormatOptions o;
  o.mm_per_unit = options.mm_per_unit;
  const auto read = linuxcnc_format().read(text, file, o, job);
  if (!read) return fail(read.error());
  LossReport report;
  return cutters_of(read->library, report, job, options.offsets_against_reference);
}

Result<std::vector<Cutter>> load_library(const std::string& path, Job& job, const LibraryOptions& options) {
  if (path == kGeneric) return generic_library();
  if (path == kGenericInch) return generic_library(Sizes::kMetricAndInch);
  std::error_code error;
  if (!std::filesystem::is_directory(path, error)) {
    const auto text = read_file(path, kLibraryBytesCap);
    if (!text && only_a_name(path)) {
      Diagnostic d = unknown_name("tool library", path, {std::string(kGeneric), std::string(kGenericInch)},
                                  "capstan tools list");
      d.hint =
          "a file or folder of tools, or 'generic', which `capstan tools list` shows, or 'generic-inch', "
          "which has inch sizes, too";
      return fail(std::move(d));
    }
    if (!text) return fail(text.error());
    return read_library(*text, path, job, options);
  }
  FormatOptions o;
  o.mm_per_unit = options.mm_per_unit;
  const auto imported = import_library(path, o, job);
  if (!imported) return fail(imported.error());
  LossReport report;
  return cutters_of(imported->library, report, job, options.offsets_against_reference);
}

}  // namespace capstan::tooling
