#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "casebase/casebase.h"

namespace capstan::casebase {

class Store;

/// A case base that something is added to and that is not read for that: of 100,000 rows, those that the
/// store's index of ids names for these cases and the last one, and the totals.
///
/// What it reads is verified as `CaseBase` does. What it does not read may be altered; opening finds that as
/// before, for the totals go on speaking of all rows. A case whose id the index lost is stored a second time,
/// and opening reads it once.
class Intake {
 public:
  /// Fails as `CaseBase::open_or_create` does, but for what reading the rows finds.
  [[nodiscard]] static Result<Intake> open_or_create(const std::string& uri, Job& job);
  Intake(Intake&&) noexcept;
  Intake& operator=(Intake&&) noexcept;
  ~Intake();

  struct Added {
    std::size_t added = 0;  ///< the others were there, or stand in `cases` twice
    std::size_t held = 0;   ///< cases of the base then
  };
  /// As `CaseBase::add`. Nothing: nothing was added, and it needs the base read: a file or a server of an
  /// earlier version, a server that is away, a row or totals that are not what was stored, a case that is
  /// there or was and states a verdict, which may be another one. Nothing for no case, too, which is no
  /// reason to write.
  [[nodiscard]] Result<std::optional<Added>> add(std::span<const Case> cases);
  /// The base, read. Fails as `CaseBase::open_or_create` does. Nothing else may be called then.
  [[nodiscard]] Result<CaseBase> read(Job& job);

  /// What happened since this was asked last that is no fault of a call (`CaseBase::take_faults`).
  [[nodiscard]] std::vector<Diagnostic> take_faults();

 private:
  explicit Intake(std::unique_ptr<Store> store);
  std::unique_ptr<Store> store_;
};

}  // namespace capstan::casebase
