#pragma once

#include <cstddef>
#include <map>
#include <mutex>
#include <string>
#include <string_view>

namespace capstan::geometry {

/// Offset and combined outlines by what they were made from, on Clipper's grid and without their place: what
/// comes again, wherever it lies, is not made again. It changes how long that takes and nothing else.
///
/// Thread safety  all calls.
class KeptOutlines {
 public:
  /// When it holds more, all of it goes. Default, unsourced: some ten thousand outlines.
  explicit KeptOutlines(std::size_t most_bytes = std::size_t{16} << 20) : most_bytes_(most_bytes) {}
  KeptOutlines(const KeptOutlines&) = delete;
  KeptOutlines& operator=(const KeptOutlines&) = delete;

  /// The result of a question, both as bytes; false where it is not known.
  [[nodiscard]] bool find(std::string_view question, std::string& result) const;
  void keep(std::string question, std::string result);

  struct Counts {
    std::size_t found = 0, made = 0;
  };
  [[nodiscard]] Counts counts() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::string, std::string, std::less<>> known_;
  std::size_t bytes_ = 0, most_bytes_;
  mutable Counts counts_;
};

/// While one lives, the functions of region.h ask these on this thread. Null: they ask none.
class KeptOutlinesScope {
 public:
  explicit KeptOutlinesScope(KeptOutlines* kept);
  ~KeptOutlinesScope();
  KeptOutlinesScope(const KeptOutlinesScope&) = delete;
  KeptOutlinesScope& operator=(const KeptOutlinesScope&) = delete;

  [[nodiscard]] static KeptOutlines* innermost();

 private:
  KeptOutlines* outer_;
};

}  // namespace capstan::geometry
