#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "casebase/casebase.h"

namespace capstan::casebase {

/// Cases in one SQLite file. Each row holds its case's hash as its id, which is computed again on reading
/// together with the physical limits; a total of count and ids tells when rows are gone or came back.
/// The schema has to be ours to the letter: no other table, index, trigger or view.
class Store {
 public:
  enum class Missing { kRefuse, kCreate };
  static constexpr int kBusyMs = 5000;
  static constexpr std::size_t kMaxCases = 1'000'000;

  /// Opens and reads everything, in one transaction. What `CaseBase::open` says.
  [[nodiscard]] static Result<Store> open(const std::string& path, Missing missing, Job& job,
                                          int busy_ms = kBusyMs);
  Store(Store&&) noexcept;
  Store& operator=(Store&&) noexcept;
  ~Store();

  /// What was read, by id. To be taken once.
  [[nodiscard]] std::vector<Case> take_cases();
  /// Stores those that are not there yet. Needs cases without fault, with their ids set.
  [[nodiscard]] Status add(std::span<const Case> cases);

 private:
  struct Impl;
  explicit Store(std::unique_ptr<Impl> impl);
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::casebase
