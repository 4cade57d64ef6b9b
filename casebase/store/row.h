#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "casebase/key/normalisation.h"
#include "casebase/record/case.h"
#include "casebase/store/checksum.h"

namespace capstan::casebase {

/// How many rows that cannot be used are named one by one; the rest are counted.
inline constexpr std::size_t kReportedRows = 20;

/// A row says that something was cut, or what became of a case since. Nothing that is stored is ever altered.
enum class RowKind : std::uint8_t {
  kCase,       ///< body: `encoded`
  kJudgement,  ///< a verdict that supersedes the case's, and any before; body: who, when, why
  kRemoval,    ///< the case counts no more; body: who, when, why
  kMetric,     ///< the metric of searches from now on (key/metric.h); body: `bytes_of` it
};

/// An id as 128 bits; its hexadecimal digits.
using Id = Sum;
[[nodiscard]] std::optional<Id> id_of_digits(std::string_view digits);
[[nodiscard]] std::string digits_of(const Id& id);

/// What is read of a row when a base is opened.
struct Head {
  RowKind kind = RowKind::kCase;
  Id id;     ///< of the case that the row is, or is about
  Sum body;  ///< of the body's bytes
  Verdict verdict = Verdict::kUnknown;
  // Of a case alone:
  Origin origin = Origin::kEntered;
  std::string_view categories;  ///< `categories_of`
  Key key;
};

/// A head's bytes for the row of this number, with a checksum of both at the end.
[[nodiscard]] std::string bytes_of(const Head& head, std::int64_t number);
/// Reads them back; nothing when they are not what `bytes_of` gave for this number. `categories` points into
/// `bytes`.
[[nodiscard]] std::optional<Head> head_of(std::string_view bytes, std::int64_t number);

/// The bytes of the id in the head of a case, which an index of a store is made of; nothing in other rows'
/// heads. They stand behind the version and the kind.
inline constexpr std::size_t kIdAt = 2, kIdBytes = 16;
[[nodiscard]] std::optional<std::string_view> case_id_in(std::string_view head);
/// The same bytes of an id.
[[nodiscard]] std::string id_bytes_of(const Id& id);

/// The body of a judgement or a removal.
[[nodiscard]] std::string bytes_of(const Remark& remark);
[[nodiscard]] std::optional<Remark> remark_of(std::string_view bytes);

/// How many rows there are, and a sum over all of their heads in order: rows that are gone, exchanged or came
/// back are noticed.
struct Totals {
  std::int64_t rows = 0;
  Sum chain;
  bool operator==(const Totals&) const = default;
  void count(std::string_view head);
};
/// The totals as a store keeps them. `held`: the cases that are not removed; nothing where who wrote them did
/// not know. It proves nothing, and is right as long as nothing was altered.
struct Stated {
  Totals totals;
  std::optional<std::int64_t> held;
};
[[nodiscard]] std::string bytes_of(const Totals& totals, std::optional<std::int64_t> held = std::nullopt);
[[nodiscard]] std::optional<Stated> stated_of(std::string_view bytes);
[[nodiscard]] std::optional<Totals> totals_of(std::string_view bytes);

}  // namespace capstan::casebase
