#include "tooling/library/formats/zip.h"

#include <zip.h>

#include <map>
#include <memory>
#include <mutex>

#include "planner/ground/base/loading/library.h"

// The one file that knows libzip. The library is opened with the first archive: with libcrypto, which it
// needs itself, it would take a tenth of the start of every command.

namespace capstan::tooling {
namespace {

/// Its functions, of the types that its header declares.
struct Zip {
#define CAPSTAN_ZIP_FUNCTIONS(row)                                                                       \
  row(close) row(discard) row(fclose) row(file_add) row(file_set_dostime) row(fopen_index) row(fread)    \
      row(get_num_entries) row(open_from_source) row(set_file_compression) row(source_buffer)            \
          row(source_buffer_create) row(source_close) row(source_free) row(source_keep) row(source_open) \
              row(source_read) row(source_seek) row(source_tell) row(stat_index) row(stat_init)
#define CAPSTAN_ZIP_ROW(name) decltype(&zip_##name) name = nullptr;
  CAPSTAN_ZIP_FUNCTIONS(CAPSTAN_ZIP_ROW)
#undef CAPSTAN_ZIP_ROW
};

Result<Zip> opened(const std::string& name) {
  const auto library = Library::open(name);
  if (!library) return tl::unexpected(library.error());
  Zip f;
#define CAPSTAN_ZIP_ROW(name) \
  if (auto taken = library->take("zip_" #name, f.name); !taken) return tl::unexpected(taken.error());
  CAPSTAN_ZIP_FUNCTIONS(CAPSTAN_ZIP_ROW)
#undef CAPSTAN_ZIP_ROW
  return f;
}

/// By the library's name; null: as this was built. Fails  ZIP-LIBRARY: it is not there.
Result<const Zip*> zip(const char* library) {
  static std::mutex one_at_a_time;
  static std::map<std::string, Result<Zip>> known;
  const std::string name = library != nullptr ? library : CAPSTAN_ZIP_LIBRARY;
  const std::lock_guard lock(one_at_a_time);
  auto at = known.find(name);
  if (at == known.end()) at = known.emplace(name, opened(name)).first;
  if (at->second) return &*at->second;
  return fail(Diagnostic{.code = "ZIP-LIBRARY",
                         .message = at->second.error().message,
                         .hint = "install libzip (Debian: libzip4); a server that runs (capstan serve) looks "
                                 "for it once: start it again"});
}

struct Closer {
  const Zip* of = nullptr;
  void operator()(zip_t* z) const { of->discard(z); }
  void operator()(zip_file_t* f) const { of->fclose(f); }
  void operator()(zip_source_t* s) const { of->source_free(s); }
};
using Archive = std::unique_ptr<zip_t, Closer>;
using File = std::unique_ptr<zip_file_t, Closer>;
using Source = std::unique_ptr<zip_source_t, Closer>;

Diagnostic fault(const std::string& file, const char* code, std::string message, std::string path = {}) {
  return {.code = code,
          .message = std::move(message),
          .file = file,
          .path = std::move(path),
          .expected = "a zip archive of ordinary size",
          .hint = "export it again, or unpack it and give the file within"};
}

Result<std::string> unpack(const Zip& with, zip_t* z, zip_uint64_t index, const zip_stat_t& stat,
                           const std::string& file) {
  const File f(with.fopen_index(z, index, 0), {&with});
  if (!f) return fail(fault(file, "ZIP-SYNTAX", "an entry cannot be opened", stat.name));
  std::string bytes(stat.size, '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const auto n = with.fread(f.get(), bytes.data() + have, bytes.size() - have);
    if (n <= 0) return fail(fault(file, "ZIP-SYNTAX", "an entry is broken", stat.name));
    have += static_cast<std::size_t>(n);
  }
  char more = 0;
  if (with.fread(f.get(), &more, 1) != 0)  // also checks the sum
    return fail(fault(file, "ZIP-SYNTAX", "an entry is broken or longer than it says", stat.name));
  return bytes;
}

}  // namespace

bool is_zip(std::string_view bytes) {
  return bytes.starts_with(std::string_view("PK\x03\x04", 4)) ||
         bytes.starts_with(std::string_view("PK\x05\x06", 4));
}

Result<std::vector<ZipEntry>> read_zip(std::string_view bytes, const std::string& file,
                                       bool (*wanted)(std::string_view name), const ZipCaps& caps,
                                       const char* library) {
  const auto opened_zip = zip(library);
  if (!opened_zip) {
    Diagnostic none = opened_zip.error();
    none.file = file;
    return fail(std::move(none));
  }
  const Zip* const with = *opened_zip;
  Source source(with->source_buffer_create(bytes.data(), bytes.size(), 0, nullptr), {with});
  if (!source) return fail(fault(file, "ZIP-SYNTAX", "the archive cannot be read"));
  const Archive z(with->open_from_source(source.get(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr), {with});
  if (!z) return fail(fault(file, "ZIP-SYNTAX", "this is no whole zip archive"));
  (void)source.release();  // the archive's now
  const auto count = static_cast<zip_uint64_t>(with->get_num_entries(z.get(), 0));
  if (count > caps.entries)
    return fail(fault(
        file, "ZIP-CAP",
        "the archive has " + std::to_string(count) + " entries, more than " + std::to_string(caps.entries)));
  std::vector<ZipEntry> out;
  std::size_t total = 0;
  for (zip_uint64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    with->stat_init(&stat);
    if (with->stat_index(z.get(), i, 0, &stat) != 0 || (stat.valid & ZIP_STAT_NAME) == 0 ||
        (stat.valid & ZIP_STAT_SIZE) == 0)
      return fail(fault(file, "ZIP-SYNTAX", "an entry has no name or size"));
    const std::string_view name = stat.name;
    if (name.ends_with('/') || (wanted != nullptr && !wanted(name))) continue;
    if ((stat.valid & ZIP_STAT_ENCRYPTION_METHOD) != 0 && stat.encryption_method != ZIP_EM_NONE)
      return fail(fault(file, "ZIP-CRYPT", "an entry is encrypted", stat.name));
    total += stat.size;
    if (stat.size > caps.entry_bytes || total > caps.total_bytes)
      return fail(fault(file, "ZIP-CAP",
                        "unpacked, an entry or the whole would be larger than " +
                            std::to_string(caps.entry_bytes) + " or " + std::to_string(caps.total_bytes) +
                            " bytes",
                        stat.name));
    if ((stat.valid & ZIP_STAT_COMP_SIZE) != 0 && stat.size / caps.ratio > stat.comp_size)
      return fail(
          fault(file, "ZIP-CAP",
                std::to_string(stat.comp_size) + " bytes claim to unpack to " + std::to_string(stat.size),
                stat.name));
    auto one = unpack(*with, z.get(), i, stat, file);
    if (!one) return fail(one.error());
    out.push_back({std::string(name), *std::move(one)});
  }
  return out;
}

Result<std::string> write_zip(const std::vector<ZipEntry>& entries, const char* library) {
  const auto broken = [] { return fail("ZIP-WRITE", "the archive cannot be written"); };
  const auto opened_zip = zip(library);
  if (!opened_zip) return fail(opened_zip.error());
  const Zip* const with = *opened_zip;
  Source target(with->source_buffer_create(nullptr, 0, 0, nullptr), {with});
  if (!target) return broken();
  with->source_keep(target.get());  // one for the archive, one for us
  Archive z(with->open_from_source(target.get(), ZIP_CREATE | ZIP_TRUNCATE, nullptr), {with});
  if (!z) {
    with->source_free(target.get());
    return broken();
  }
  constexpr zip_uint16_t kDate = (0 << 9) | (1 << 5) | 1;  // 1980-01-01: the first a zip can hold
  for (const ZipEntry& e : entries) {
    zip_source_t* s = with->source_buffer(z.get(), e.bytes.data(), e.bytes.size(), 0);
    if (s == nullptr) return broken();
    const auto i = with->file_add(z.get(), e.name.c_str(), s, ZIP_FL_ENC_UTF_8);
    if (i < 0) {
      with->source_free(s);
      return broken();
    }
    with->file_set_dostime(z.get(), static_cast<zip_uint64_t>(i), 0, kDate, 0);
    with->set_file_compression(z.get(), static_cast<zip_uint64_t>(i), ZIP_CM_DEFLATE, 9);
  }
  if (with->close(z.get()) != 0) return broken();
  (void)z.release();
  if (with->source_open(target.get()) != 0) return broken();
  with->source_seek(target.get(), 0, SEEK_END);
  const auto size = with->source_tell(target.get());
  with->source_seek(target.get(), 0, SEEK_SET);
  std::string out(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  const auto got = with->source_read(target.get(), out.data(), out.size());
  with->source_close(target.get());
  if (got < 0 || static_cast<std::size_t>(got) != out.size()) return broken();
  return out;
}

}  // namespace capstan::tooling
