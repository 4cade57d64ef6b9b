#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"
#include "planner/ground/memo/memo.h"

// Results in a folder; only this room includes this.

namespace capstan::memo {

/// Identity of the program that runs, in hex: the linker's build id of the module that this code is in. Empty
/// where the linker left none. Results of another build never count, for the formulas may have changed.
[[nodiscard]] std::string build_identity();
/// That, and what else decides the last bits of a result: the C library's version, and what the processor
/// can, by which its mathematical functions are chosen.
[[nodiscard]] std::string identity_of_results();

class Folder {
 public:
  /// Fails  as Memo::in_folder.
  [[nodiscard]] static Result<Folder> open(const std::string& path, std::size_t most_bytes);
  Folder(Folder&& other) noexcept;
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  Folder& operator=(Folder&&) = delete;
  ~Folder();  ///< keeps to its bound, as `keep` does after each tenth of it that was written

  /// The content kept under a key; nothing where it is missing, damaged, or of another build.
  [[nodiscard]] std::optional<std::string> find(const Key& key) const;
  /// Writes it whole or not at all, and says nothing where it cannot.
  void keep(const Key& key, std::string_view bytes);

 private:
  Folder(std::string path, std::string build, std::size_t most_bytes);
  [[nodiscard]] std::string file_of(const Key& key) const;
  [[nodiscard]] std::string of_build() const;
  [[nodiscard]] std::uint64_t checksum(const Key& key, std::string_view bytes) const;
  /// Removes the files of this room that were not used for longest, down to the bound. Files of others stay.
  void make_room() const;

  std::string path_, build_;
  std::size_t most_bytes_;
  std::atomic<std::size_t> count_{0};    ///< of files written, for names of unfinished ones
  std::atomic<std::size_t> written_{0};  ///< since room was made last
};

}  // namespace capstan::memo
