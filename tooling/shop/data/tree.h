#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/ground/base/tables/data_tree.h"

namespace capstan::tooling {

inline constexpr std::size_t kDataFileCap = std::size_t{64} << 20;  ///< bytes of one data file
inline constexpr int kDataDepthCap = 64;                            ///< nesting

using Node = DataNode;

/// One document.
/// Fails  DATA-FOREIGN for a drawing, a picture, a program or the like; DATA-SYNTAX (also aliases, tags
/// aside, and nesting past kDataDepthCap), DATA-DUPLICATE for a key
///        given twice, FILE-TOO-LARGE; each with file and line.
[[nodiscard]] Result<Node> parse_tree(std::string_view text, const std::string& file);

/// All documents of a file; fails as `parse_tree`.
[[nodiscard]] Result<std::vector<Node>> parse_documents(std::string_view text, const std::string& file);

/// Reads the fields of one mapping and collects the faults, so that all are reported, not only the first.
///
/// A `source` entry speaks for all values of its mapping and below; a number may also be written
/// `{value: 457, source: "..."}`.
class Fields {
 public:
  /// `faults` is shared by all levels of one file.
  Fields(const Node& node, std::string file, std::string path, std::string source,
         std::vector<Diagnostic>& faults);

  [[nodiscard]] double number(std::string_view key);  ///< required
  [[nodiscard]] double number_or(std::string_view key, double other);
  [[nodiscard]] std::optional<double> optional_number(std::string_view key);
  [[nodiscard]] std::optional<long> optional_integer(std::string_view key);
  [[nodiscard]] std::string text(std::string_view key);  ///< required
  [[nodiscard]] std::string text_or(std::string_view key, std::string other);
  [[nodiscard]] bool flag_or(std::string_view key, bool other);
  [[nodiscard]] bool has(std::string_view key) const { return node_.find(key) != nullptr; }
  /// A child to be read by the caller; null (and a fault when required) when absent.
  [[nodiscard]] const Node* child(std::string_view key, bool required);
  [[nodiscard]] Fields below(std::string_view key, const Node& child);
  /// How many faults were found so far, here and elsewhere in the file: a value that could not be read need
  /// not be judged, too.
  [[nodiscard]] std::size_t fault_count() const { return faults_.size(); }
  /// Reports each entry that nothing asked for.
  void finish();

  void fault(std::string code, std::string message, std::string_view key, std::uint64_t line,
             std::string expected = {});
  [[nodiscard]] std::string path_of(std::string_view key) const;
  [[nodiscard]] const std::string& source() const { return source_; }
  [[nodiscard]] std::uint64_t line() const { return node_.line; }
  [[nodiscard]] std::uint64_t line_of(std::string_view key) const;
  /// (path, source) of every value read so far here; "" if none was stated.
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& sources() const { return sources_; }

 private:
  [[nodiscard]] const Node* scalar(std::string_view key, bool required);
  const Node& node_;
  std::string file_, path_, source_;
  std::vector<Diagnostic>& faults_;
  std::vector<std::string> asked_;
  std::vector<std::pair<std::string, std::string>> sources_;
};

/// Reports all faults to the job and returns the last as the result's error; nothing if there is none.
[[nodiscard]] std::optional<Diagnostic> tell(std::vector<Diagnostic> faults, Job& job);

}  // namespace capstan::tooling
