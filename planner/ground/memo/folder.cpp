#include "planner/ground/memo/folder.h"

#include <elf.h>
#include <fcntl.h>
#include <gnu/libc-version.h>
#include <link.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <system_error>
#include <utility>
#include <vector>

#define XXH_INLINE_ALL
#include <xxhash.h>

#include "planner/ground/base/file.h"

// A file is a head (mark, key, length, checksum) and the content. Its name is its key in hex, in a folder of
// its build, in one of 256 folders named by the key's first two digits. The checksum is XXH3 over build, key
// and content.
//
// The bound is kept after each tenth of it that was written, and at the end: files by the time they were last
// used (their time of change is set when they are read), oldest first, are removed until nine tenths of the
// bound are left.

namespace capstan::memo {
namespace {

namespace fs = std::filesystem;

constexpr std::array<char, 8> kMark{'C', 'A', 'P', 'M', 'E', 'M', '0', '1'};
constexpr double kKept = 0.9;  // of the bound, after making room; default, unsourced

struct Head {
  std::array<char, 8> mark = kMark;
  Key key;
  std::uint64_t size = 0, checksum = 0;
};

struct Search {
  std::uintptr_t address = 0;
  std::string found;
};

/// The build id among the notes of a loaded module that holds the address.
int look_at_module(dl_phdr_info* module, std::size_t, void* data) {
  auto& search = *static_cast<Search*>(data);
  const auto at = [&](const ElfW(Phdr) & p) { return module->dlpi_addr + p.p_vaddr; };
  const ElfW(Phdr)* first = module->dlpi_phdr;
  const ElfW(Phdr)* last = first + module->dlpi_phnum;
  const bool here = std::any_of(first, last, [&](const ElfW(Phdr) & p) {
    return p.p_type == PT_LOAD && search.address >= at(p) && search.address < at(p) + p.p_memsz;
  });
  if (!here) return 0;
  for (const ElfW(Phdr)* p = first; p != last; ++p) {
    if (p->p_type != PT_NOTE) continue;
    std::size_t offset = 0;
    while (offset + sizeof(ElfW(Nhdr)) <= p->p_memsz) {
      const auto* note = reinterpret_cast<const ElfW(Nhdr)*>(at(*p) + offset);
      const std::size_t name = (note->n_namesz + 3U) & ~std::size_t{3};
      const auto* text = reinterpret_cast<const char*>(note + 1);
      if (note->n_type == NT_GNU_BUILD_ID && note->n_namesz == 4 && std::memcmp(text, "GNU", 4) == 0) {
        const auto* id = reinterpret_cast<const unsigned char*>(text + name);
        constexpr std::string_view kDigits = "0123456789abcdef";
        for (std::size_t i = 0; i < note->n_descsz; ++i) {
          search.found += kDigits[id[i] >> 4U];
          search.found += kDigits[id[i] & 15U];
        }
        return 1;
      }
      offset += sizeof(ElfW(Nhdr)) + name + ((note->n_descsz + 3U) & ~std::size_t{3});
    }
  }
  return 1;
}

}  // namespace

std::string build_identity() {
  Search search;
  search.address = reinterpret_cast<std::uintptr_t>(&build_identity);
  dl_iterate_phdr(look_at_module, &search);
  return search.found;
}

std::string identity_of_results() {
  std::string out = build_identity();
  if (out.empty()) return out;
  out += std::string(" ") + gnu_get_libc_version();
  std::ifstream processor("/proc/cpuinfo");
  for (std::string line; std::getline(processor, line);) {
    if (line.starts_with("flags") || line.starts_with("Features")) return out + " " + hex64(fnv1a(line));
  }
  return out;
}

namespace {

/// Makes a folder where it is missing. Why it may not be used, or nothing: who can write a result can make a
/// plan of it. A link is followed to the folder that the user names, and to no other.
std::string not_our_own(const std::string& path, bool by_link) {
  if (::mkdir(path.c_str(), 0700) != 0 && errno != EEXIST) return std::strerror(errno);
  struct stat info {};
  if ((by_link ? ::stat(path.c_str(), &info) : ::lstat(path.c_str(), &info)) != 0)
    return std::strerror(errno);
  if (!S_ISDIR(info.st_mode)) return "it is no folder";
  if (info.st_uid != ::geteuid()) return "it belongs to another user";
  if ((info.st_mode & (S_IWGRP | S_IWOTH)) != 0) return "others may write it";
  return {};
}

}  // namespace

std::string Folder::of_build() const { return path_ + "/" + hex64(fnv1a(build_)); }

Folder::Folder(std::string path, std::string build, std::size_t most_bytes)
    : path_(std::move(path)), build_(std::move(build)), most_bytes_(most_bytes) {}

Folder::Folder(Folder&& other) noexcept
    : path_(std::exchange(other.path_, {})),
      build_(std::exchange(other.build_, {})),
      most_bytes_(other.most_bytes_),
      written_(other.written_.exchange(0)) {}

Folder::~Folder() {
  if (written_ == 0) return;
  try {
    make_room();
  } catch (...) {  // what stays too much goes at the next end
  }
}

Result<Folder> Folder::open(const std::string& path, std::size_t most_bytes) {
  const std::string build = identity_of_results();
  if (build.empty()) {
    return fail({.code = "MEM-BUILD",
                 .message = "results are not kept between calls: this program carries no build identity",
                 .file = path,
                 .hint = "leave the option out; or link the program with --build-id"});
  }
  const auto wrong = [&](const std::string& what) {
    return fail({.code = "MEM-FOLDER",
                 .message = "results cannot be kept in this folder: " + what,
                 .file = path,
                 .expected = "a folder of the caller's own that others may not write",
                 .hint = "name another one"});
  };
  std::error_code error;
  fs::create_directories(fs::path(path).parent_path(), error);
  if (const std::string fault = not_our_own(path, true); !fault.empty()) return wrong(fault);
  Folder out(path, build, most_bytes);
  if (const std::string fault = not_our_own(out.of_build(), false); !fault.empty())
    return wrong(fs::path(out.of_build()).filename().string() + " in it: " + fault);
  return out;
}

std::string Folder::file_of(const Key& key) const {
  const std::string name = hex64(key.high) + hex64(key.low);
  return of_build() + "/" + name.substr(0, 2) + "/" + name.substr(2);
}

std::uint64_t Folder::checksum(const Key& key, std::string_view bytes) const {
  const std::uint64_t named = XXH3_64bits_withSeed(build_.data(), build_.size(), key.high ^ (key.low * 3));
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), named);
}

std::optional<std::string> Folder::find(const Key& key) const {
  const std::string name = file_of(key);
  std::error_code error;
  if (!fs::is_regular_file(name, error)) return std::nullopt;
  auto all = read_file(name, kMostInMemory);
  Head head;
  if (!all || all->size() < sizeof head) return std::nullopt;
  std::memcpy(&head, all->data(), sizeof head);
  if (head.mark != kMark || head.key != key || head.size != all->size() - sizeof head) return std::nullopt;
  all->erase(0, sizeof head);
  if (head.checksum != checksum(key, *all)) return std::nullopt;
  fs::last_write_time(name, fs::file_time_type::clock::now(), error);
  return *std::move(all);
}

void Folder::keep(const Key& key, std::string_view bytes) {
  Head head;
  head.key = key;
  head.size = bytes.size();
  head.checksum = checksum(key, bytes);
  std::string all(sizeof head, '\0');
  std::memcpy(all.data(), &head, sizeof head);
  all += bytes;
  const std::string name = file_of(key);
  for (const std::string& folder : {of_build(), fs::path(name).parent_path().string()}) {
    if (!not_our_own(folder, false).empty()) return;
  }
  // Not brought to disk before it gets its name: a file that a power cut leaves short is found by its
  // checksum.
  const std::string unnamed =
      name + "." + std::to_string(::getpid()) + "." + std::to_string(count_++) + ".tmp";
  const int fd = ::open(unnamed.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
  if (fd < 0) return;
  bool whole = true;
  for (std::size_t at = 0; whole && at < all.size();) {
    const ssize_t n = ::write(fd, all.data() + at, all.size() - at);
    whole = n > 0 || (n < 0 && errno == EINTR);
    if (n > 0) at += static_cast<std::size_t>(n);
  }
  whole = ::close(fd) == 0 && whole;
  if (!whole || ::rename(unnamed.c_str(), name.c_str()) != 0) {
    ::unlink(unnamed.c_str());
    return;
  }
  constexpr std::size_t kTenth = 10;
  if ((written_ += all.size()) > most_bytes_ / kTenth) {
    written_ = 0;
    make_room();
  }
}

namespace {

/// The entries of a folder whose names are so many hexadecimal digits, and for files perhaps an ending; of
/// one that cannot be read there are none.
std::vector<fs::path> named(const fs::path& folder, std::size_t digits, bool files) {
  std::vector<fs::path> out;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (name.size() < digits || name.find_first_not_of("0123456789abcdef") < digits) continue;
    const bool whole = name.size() == digits || (files && name[digits] == '.' && name.ends_with(".tmp"));
    std::error_code gone;  // another process may remove it meanwhile
    const auto status = at->symlink_status(gone);
    if (whole && (files ? fs::is_regular_file(status) : fs::is_directory(status))) out.push_back(at->path());
  }
  return out;
}

}  // namespace

void Folder::make_room() const {
  struct File {
    fs::file_time_type used;
    std::string path;
    std::uintmax_t size = 0;
  };
  constexpr std::size_t kBuild = 16, kSub = 2, kFile = 30;  // digits, as in `file_of`
  std::vector<File> files;
  std::uintmax_t sum = 0;
  for (const fs::path& build : named(path_, kBuild, false)) {
    for (const fs::path& sub : named(build, kSub, false)) {
      for (const fs::path& file : named(sub, kFile, true)) {
        std::error_code gone;
        File f{fs::last_write_time(file, gone), file.string(), 0};
        f.size = fs::file_size(file, gone);
        if (gone) continue;
        sum += f.size;
        files.push_back(std::move(f));
      }
    }
  }
  if (sum <= most_bytes_) return;
  std::sort(files.begin(), files.end(), [](const File& a, const File& b) {
    return a.used != b.used ? a.used < b.used : a.path < b.path;
  });
  const double kept = kKept * static_cast<double>(most_bytes_);
  std::error_code error;
  for (const File& f : files) {
    if (static_cast<double>(sum) <= kept) break;
    if (fs::remove(f.path, error)) sum -= f.size;
  }
}

}  // namespace capstan::memo
