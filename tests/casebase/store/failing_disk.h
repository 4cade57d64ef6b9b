#pragma once

#include <sqlite3.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <new>
#include <optional>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace capstan::casebase {

inline std::string bytes_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void write_file(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

/// What happens at an operation of the disk.
enum class DiskFault {
  kFails,        ///< that one; of a write half is done
  kFailsOn,      ///< that one and all behind it, as a full disk does
  kDies,         ///< the program ends before it
  kDiesHalfway,  ///< the program ends in it: half of a write is done
  kNoPower,      ///< the machine stops before it: of what was not synchronised nothing is there
  kSomePower,    ///< the same, but each write that was not synchronised may have been done or not
};

/// The disk as SQLite sees it, while one of these is there: a shim over the system's. Counts what changes
/// files (writes, synchronisations, truncations, deletions) and openings, or else reads alone, and does at
/// one of them what it was told; nothing before `plan` is called. It synchronises nothing: it keeps what is
/// synchronised itself.
class FailingDisk {
 public:
  static constexpr int kDied = 77;  ///< the exit code of a program that ended by a fault

  explicit FailingDisk(bool of_reads = false) : of_reads_(of_reads), real_(sqlite3_vfs_find(nullptr)) {
    the() = this;
    vfs_ = *real_;
    vfs_.iVersion = 1;
    vfs_.zName = "failing";
    vfs_.szOsFile = static_cast<int>(sizeof(File)) + real_->szOsFile;
    vfs_.xOpen = [](sqlite3_vfs*, const char* path, sqlite3_file* f, int flags, int* out) {
      return the()->open(path, f, flags, out);
    };
    vfs_.xDelete = [](sqlite3_vfs*, const char* path, int lasting) {
      return the()->remove(path, lasting != 0);
    };
    sqlite3_vfs_register(&vfs_, 1);
  }
  ~FailingDisk() {
    sqlite3_vfs_unregister(&vfs_);
    sqlite3_vfs_register(real_, 1);
    the() = nullptr;
  }
  FailingDisk(const FailingDisk&) = delete;
  FailingDisk& operator=(const FailingDisk&) = delete;

  /// From now on, the n-th operation from here, from 1.
  void plan(DiskFault fault, int nth) {
    fault_ = fault;
    nth_ = nth;
    count_ = 0;
    random_.seed(static_cast<unsigned>(nth));
    kept_.clear();
    unsynchronised_.clear();
  }
  void mend() { nth_ = 0; }
  [[nodiscard]] int count() const { return count_; }
  /// The machine stops now.
  [[noreturn]] void stop() {
    for (const auto& [path, kept] : kept_) {
      std::string bytes = kept.value_or(std::string());
      bool there = kept.has_value();
      for (const Write& w : unsynchronised_[path]) {
        if (fault_ != DiskFault::kSomePower || random_() % 2 == 0) continue;
        if (bytes.size() < w.at + w.bytes.size()) bytes.resize(w.at + w.bytes.size());
        bytes.replace(w.at, w.bytes.size(), w.bytes);
        there = true;
      }
      if (there) write_file(path, bytes);
      if (!there) std::filesystem::remove(path);
    }
    _exit(kDied);
  }

 private:
  struct File {
    sqlite3_file base;
    const std::string* path;
    sqlite3_file* real() { return reinterpret_cast<sqlite3_file*>(this + 1); }
  };
  struct Write {
    std::size_t at = 0;
    std::string bytes;
  };
  static FailingDisk*& the() {
    static FailingDisk* one = nullptr;
    return one;
  }
  static File& of(sqlite3_file* f) { return *reinterpret_cast<File*>(f); }

  /// Whether this operation is to fail; does not return where the program ends.
  bool fails(bool reading = false) {
    if (reading != of_reads_) return false;
    ++count_;
    if (nth_ == 0 || count_ < nth_) return false;
    if (fault_ == DiskFault::kFailsOn) return true;
    if (count_ > nth_) return false;
    if (fault_ == DiskFault::kDies) _exit(kDied);
    if (fault_ == DiskFault::kNoPower || fault_ == DiskFault::kSomePower) stop();
    return true;
  }
  /// What a failing operation says, once what of it was done is done.
  [[nodiscard]] int failed(int code) const {
    if (fault_ == DiskFault::kDiesHalfway) _exit(kDied);
    return code;
  }

  /// A file as it is before anything is written to it stays so without power.
  void keep(const std::string& path) {
    if (kept_.contains(path)) return;
    kept_[path] = std::filesystem::exists(path) ? std::optional(bytes_of_file(path)) : std::nullopt;
  }
  int open(const char* path, sqlite3_file* f, int flags, int* out) {
    of(f).base.pMethods = nullptr;
    if (fails()) return failed(SQLITE_CANTOPEN);
    if (path != nullptr) keep(path);
    const int code = real_->xOpen(real_, path, of(f).real(), flags, out);
    if (code != SQLITE_OK) return code;
    of(f).path = path == nullptr ? nullptr : &*paths_.insert(path).first;
    of(f).base.pMethods = &methods();
    return code;
  }
  int remove(const char* path, bool lasting) {
    if (fails()) return failed(SQLITE_IOERR_DELETE);
    const int code = real_->xDelete(real_, path, 0);
    if (!lasting || code != SQLITE_OK) return code;
    if (fails()) return failed(SQLITE_IOERR_DIR_FSYNC);  // it is gone, and may come back
    kept_[path] = std::nullopt;
    unsynchronised_[path].clear();
    return code;
  }
  int write(File& f, const char* bytes, int n, sqlite3_int64 at) {
    const bool failing = fails();
    if (f.path != nullptr) {
      unsynchronised_[*f.path].push_back(
          {static_cast<std::size_t>(at), {bytes, static_cast<std::size_t>(failing ? n / 2 : n)}});
    }
    const int code = f.real()->pMethods->xWrite(f.real(), bytes, failing ? n / 2 : n, at);
    return failing ? failed(fault_ == DiskFault::kFailsOn ? SQLITE_FULL : SQLITE_IOERR_WRITE) : code;
  }
  int synchronise(File& f) {
    if (fails()) return failed(SQLITE_IOERR_FSYNC);
    if (f.path != nullptr) {
      kept_[*f.path] = bytes_of_file(*f.path);
      unsynchronised_[*f.path].clear();
    }
    return SQLITE_OK;
  }

  static const sqlite3_io_methods& methods() {
    static const sqlite3_io_methods kMethods = [] {
      sqlite3_io_methods m{};
      m.iVersion = 1;
      m.xClose = [](sqlite3_file* f) { return of(f).real()->pMethods->xClose(of(f).real()); };
      m.xRead = [](sqlite3_file* f, void* to, int n, sqlite3_int64 at) {
        if (the()->fails(true)) return the()->failed(SQLITE_IOERR_READ);
        return of(f).real()->pMethods->xRead(of(f).real(), to, n, at);
      };
      m.xWrite = [](sqlite3_file* f, const void* bytes, int n, sqlite3_int64 at) {
        return the()->write(of(f), static_cast<const char*>(bytes), n, at);
      };
      m.xTruncate = [](sqlite3_file* f, sqlite3_int64 size) {
        if (the()->fails()) return the()->failed(SQLITE_IOERR_TRUNCATE);
        return of(f).real()->pMethods->xTruncate(of(f).real(), size);
      };
      m.xSync = [](sqlite3_file* f, int) { return the()->synchronise(of(f)); };
      m.xFileSize = [](sqlite3_file* f, sqlite3_int64* size) {
        return of(f).real()->pMethods->xFileSize(of(f).real(), size);
      };
      m.xLock = [](sqlite3_file* f, int how) { return of(f).real()->pMethods->xLock(of(f).real(), how); };
      m.xUnlock = [](sqlite3_file* f, int how) { return of(f).real()->pMethods->xUnlock(of(f).real(), how); };
      m.xCheckReservedLock = [](sqlite3_file* f, int* out) {
        return of(f).real()->pMethods->xCheckReservedLock(of(f).real(), out);
      };
      m.xFileControl = [](sqlite3_file* f, int what, void* with) {
        return of(f).real()->pMethods->xFileControl(of(f).real(), what, with);
      };
      m.xSectorSize = [](sqlite3_file* f) { return of(f).real()->pMethods->xSectorSize(of(f).real()); };
      m.xDeviceCharacteristics = [](sqlite3_file*) {
        return 0;
      };  // a write that is cut off leaves half of it
      return m;
    }();
    return kMethods;
  }

  const bool of_reads_;
  sqlite3_vfs* real_;
  sqlite3_vfs vfs_{};
  DiskFault fault_ = DiskFault::kFails;
  int nth_ = 0, count_ = 0;
  std::mt19937 random_;
  std::set<std::string> paths_;
  std::map<std::string, std::optional<std::string>> kept_;  // what is there without power
  std::map<std::string, std::vector<Write>> unsynchronised_;
};

}  // namespace capstan::casebase
