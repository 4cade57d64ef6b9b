#include "tooling/library/formats/zip.h"

#include <zip.h>

#include <memory>

// The one file that knows libzip.

namespace capstan::tooling {
namespace {

struct Closer {
  void operator()(zip_t* z) const { zip_discard(z); }
  void operator()(zip_file_t* f) const { zip_fclose(f); }
  void operator()(zip_source_t* s) const { zip_source_free(s); }
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

Result<std::string> unpack(zip_t* z, zip_uint64_t index, const zip_stat_t& stat, const std::string& file) {
  const File f(zip_fopen_index(z, index, 0));
  if (!f) return fail(fault(file, "ZIP-SYNTAX", "an entry cannot be opened", stat.name));
  std::string bytes(stat.size, '\0');
  std::size_t have = 0;
  while (have < bytes.size()) {
    const auto n = zip_fread(f.get(), bytes.data() + have, bytes.size() - have);
    if (n <= 0) return fail(fault(file, "ZIP-SYNTAX", "an entry is broken", stat.name));
    have += static_cast<std::size_t>(n);
  }
  char more = 0;
  if (zip_fread(f.get(), &more, 1) != 0)  // also checks the sum
    return fail(fault(file, "ZIP-SYNTAX", "an entry is broken or longer than it says", stat.name));
  return bytes;
}

}  // namespace

bool is_zip(std::string_view bytes) {
  return bytes.starts_with(std::string_view("PK\x03\x04", 4)) ||
         bytes.starts_with(std::string_view("PK\x05\x06", 4));
}

Result<std::vector<ZipEntry>> read_zip(std::string_view bytes, const std::string& file,
                                       bool (*wanted)(std::string_view name), const ZipCaps& caps) {
  Source source(zip_source_buffer_create(bytes.data(), bytes.size(), 0, nullptr));
  if (!source) return fail(fault(file, "ZIP-SYNTAX", "the archive cannot be read"));
  const Archive z(zip_open_from_source(source.get(), ZIP_RDONLY | ZIP_CHECKCONS, nullptr));
  if (!z) return fail(fault(file, "ZIP-SYNTAX", "this is no whole zip archive"));
  (void)source.release();  // the archive's now
  const auto count = static_cast<zip_uint64_t>(zip_get_num_entries(z.get(), 0));
  if (count > caps.entries)
    return fail(fault(
        file, "ZIP-CAP",
        "the archive has " + std::to_string(count) + " entries, more than " + std::to_string(caps.entries)));
  std::vector<ZipEntry> out;
  std::size_t total = 0;
  for (zip_uint64_t i = 0; i < count; ++i) {
    zip_stat_t stat;
    zip_stat_init(&stat);
    if (zip_stat_index(z.get(), i, 0, &stat) != 0 || (stat.valid & ZIP_STAT_NAME) == 0 ||
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
    auto one = unpack(z.get(), i, stat, file);
    if (!one) return fail(one.error());
    out.push_back({std::string(name), *std::move(one)});
  }
  return out;
}

Result<std::string> write_zip(const std::vector<ZipEntry>& entries) {
  const auto broken = [] { return fail("ZIP-WRITE", "the archive cannot be written"); };
  Source target(zip_source_buffer_create(nullptr, 0, 0, nullptr));
  if (!target) return broken();
  zip_source_keep(target.get());  // one for the archive, one for us
  Archive z(zip_open_from_source(target.get(), ZIP_CREATE | ZIP_TRUNCATE, nullptr));
  if (!z) {
    zip_source_free(target.get());
    return broken();
  }
  constexpr zip_uint16_t kDate = (0 << 9) | (1 << 5) | 1;  // 1980-01-01: the first a zip can hold
  for (const ZipEntry& e : entries) {
    zip_source_t* s = zip_source_buffer(z.get(), e.bytes.data(), e.bytes.size(), 0);
    if (s == nullptr) return broken();
    const auto i = zip_file_add(z.get(), e.name.c_str(), s, ZIP_FL_ENC_UTF_8);
    if (i < 0) {
      zip_source_free(s);
      return broken();
    }
    zip_file_set_dostime(z.get(), static_cast<zip_uint64_t>(i), 0, kDate, 0);
    zip_set_file_compression(z.get(), static_cast<zip_uint64_t>(i), ZIP_CM_DEFLATE, 9);
  }
  if (zip_close(z.get()) != 0) return broken();
  (void)z.release();
  if (zip_source_open(target.get()) != 0) return broken();
  zip_source_seek(target.get(), 0, SEEK_END);
  const auto size = zip_source_tell(target.get());
  zip_source_seek(target.get(), 0, SEEK_SET);
  std::string out(size > 0 ? static_cast<std::size_t>(size) : 0, '\0');
  const auto got = zip_source_read(target.get(), out.data(), out.size());
  zip_source_close(target.get());
  if (got < 0 || static_cast<std::size_t>(got) != out.size()) return broken();
  return out;
}

}  // namespace capstan::tooling
