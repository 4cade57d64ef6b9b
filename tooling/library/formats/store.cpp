#include "tooling/library/store/store.h"
#include "tooling/library/formats/format.h"

// The store among the formats: what `tools import` writes and `--tools` reads.

namespace capstan::tooling {
namespace {

bool recognises(std::string_view bytes, std::string_view) { return looks_like_store(bytes); }

Result<Imported> read(std::string_view bytes, const std::string& file, const FormatOptions&, Job&) {
  const auto store = ToolStore::from_bytes(std::string(bytes), file);
  if (!store) return fail(store.error());
  // Check the cutters with the records, so that a damaged row is reported now and not when it is needed.
  if (const auto cutters = store->all_cutters(); !cutters) return fail(cutters.error());
  auto library = store->library();
  if (!library) return fail(library.error());
  Imported out;
  out.library = *std::move(library);
  out.report.tools = out.library.items.size();
  return out;
}

Result<Exported> write(const ToolLibrary& library, const FormatOptions&, Job& job) {
  Exported out;
  // Items that planning cannot use stay in the records; the report says which.
  auto cutters = cutters_of(library, out.report, job);
  if (!cutters) return fail(cutters.error());
  auto bytes = store_of(library, *cutters);
  if (!bytes) return fail(bytes.error());
  out.bytes = *std::move(bytes);
  out.report.tools = library.items.size();
  return out;
}

}  // namespace

const Format& store_format() {
  static const Format kFormat = [] {
    Format f;
    f.name = "store";
    f.title = "Capstan tool store (SQLite)";
    f.endings = {".sqlite", ".db"};
    f.recognises = recognises;
    f.read = read;
    f.write = write;
    return f;
  }();
  return kFormat;
}

}  // namespace capstan::tooling
