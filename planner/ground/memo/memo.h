#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include "planner/ground/base/result.h"

namespace capstan::memo {

/// The stages whose results are kept.
enum class Stage : std::uint8_t { kPath, kSections, kFeeds, kSweep, kPart };
inline constexpr std::size_t kStages = 5;

/// 128 bits of XXH3 over a stage and everything its result was made from. Two different questions meet in one
/// key with a chance of 2^-128. XXH3 does not resist somebody who looks for such two: whatever comes of a
/// memo is judged by the check like any other plan.
struct Key {
  std::uint64_t high = 0, low = 0;
  friend auto operator<=>(const Key&, const Key&) = default;
};
[[nodiscard]] Key key_of_bytes(Stage stage, std::string_view bytes);

struct Counts {
  std::size_t found = 0, made = 0;
};

class Folder;

/// What a memo holds at most, in bytes, in memory and in a folder. Default, unsourced: some thousand steps.
inline constexpr std::size_t kMostInMemory = std::size_t{64} << 20;
inline constexpr std::size_t kMostInFolder = std::size_t{512} << 20;

/// Results of stages by what they were made from, within this process and, where a folder is given, beyond
/// it.
///
/// A result that is found is the one that would be made: its key holds the whole question and, in a folder,
/// the build of the program and what else decides the last bits (folder.h). When the memo is full, the
/// results that were not used for longest go first.
///
/// In a folder each result is a file of its own, named by its key, with a checksum over key and content. It
/// is written whole under another name and then put in place, so that processes share a folder. A file that
/// is damaged, short or of another key counts as not there, and is written anew. Where a folder cannot be
/// written, results stay in memory. Files of others in the folder are not touched.
///
/// Thread safety  all calls.
class Memo {
 public:
  explicit Memo(std::size_t most_bytes = kMostInMemory);
  /// Beside memory, in a folder, which is made where it is missing.
  /// Fails  MEM-FOLDER where it cannot be made or read, or where others may write it; MEM-BUILD where the
  /// program carries no build identity.
  [[nodiscard]] static Result<std::shared_ptr<Memo>> in_folder(const std::string& folder,
                                                               std::size_t most_bytes = kMostInMemory,
                                                               std::size_t most_in_folder = kMostInFolder);
  ~Memo();
  Memo(const Memo&) = delete;
  Memo& operator=(const Memo&) = delete;

  /// The bytes kept under a key; null where there are none.
  [[nodiscard]] std::shared_ptr<const std::string> find(Stage stage, const Key& key);
  void keep(Stage stage, const Key& key, std::string bytes);
  /// Says that what was found did not read as a value: it is made instead.
  void reject(Stage stage);

  /// How many questions of a stage were answered from the memo, and how many results were made and kept.
  [[nodiscard]] Counts counts(Stage stage) const;
  [[nodiscard]] std::size_t bytes() const;

 private:
  struct Entry {
    std::shared_ptr<const std::string> bytes;
    std::list<Key>::iterator used;
  };
  void put(const Key& key, std::shared_ptr<const std::string> bytes);

  mutable std::mutex mutex_;  ///< never held while a file is read or written
  std::map<Key, Entry> entries_;
  std::list<Key> used_;  ///< longest unused first
  std::size_t bytes_ = 0, most_bytes_;
  std::array<Counts, kStages> counts_{};
  std::unique_ptr<Folder> folder_;  ///< null: in memory only
};

}  // namespace capstan::memo
