#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/job.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/cutter/cutter.h"
#include "planner/model/plan/proposal.h"
#include "tooling/library/records/records.h"

/// @file A tool library in one SQLite file: the four records as they were imported, and the cutters that
/// planning makes of them, findable by what a requirement asks.

namespace capstan::tooling {

/// Tools of one file at most.
inline constexpr std::size_t kMostStoredTools = 1'000'000;

/// The bytes of a store that holds a library and its cutters (`cutters_of` gives them). Same input, same
/// bytes. Fails  TOOLSTORE-LIMIT past kMostStoredTools; TOOLSTORE-WRITE as SQLite says.
[[nodiscard]] Result<std::string> store_of(const ToolLibrary& library,
                                           const std::vector<model::Cutter>& cutters);

/// True if the bytes are a SQLite file; opening it shows whether it is a store.
[[nodiscard]] bool looks_like_store(std::string_view bytes);

/// A store, open for reading. Opening reads the index only; a cutter is read, and checked, when asked for.
///
/// Checks  application and version (a newer one is refused); every table as we make it, nothing else: no
/// view,
///         no trigger; a hash per row; counts; what no cutter can be (`faults_of`) and an index that speaks
///         of another cutter.
class ToolStore {
 public:
  /// Fails  TOOLSTORE-OPEN, TOOLSTORE-SCHEMA (not a store, newer, something foreign in it),
  /// TOOLSTORE-DAMAGED.
  [[nodiscard]] static Result<ToolStore> open(const std::string& path);
  /// The same from bytes in memory, named for messages.
  [[nodiscard]] static Result<ToolStore> from_bytes(std::string bytes, const std::string& file);
  ToolStore(ToolStore&&) noexcept;
  ToolStore& operator=(ToolStore&&) noexcept;
  ~ToolStore();

  [[nodiscard]] std::size_t size() const;  ///< cutters

  /// Cutters that may meet the requirement: right in class, diameter, reach, flutes, corner radius and pitch.
  /// Each cutter that `select` accepts is among them. Rising.
  [[nodiscard]] std::vector<std::int64_t> find(const model::ToolRequirement& requirement) const;
  /// Fails  TOOLSTORE-DAMAGED naming the row.
  [[nodiscard]] Result<std::vector<model::Cutter>> cutters(const std::vector<std::int64_t>& ids) const;
  [[nodiscard]] Result<std::vector<model::Cutter>> all_cutters() const;
  /// The four records, as they were stored. Fails  TOOLSTORE-DAMAGED.
  [[nodiscard]] Result<ToolLibrary> library() const;

 private:
  struct Impl;
  explicit ToolStore(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::tooling
