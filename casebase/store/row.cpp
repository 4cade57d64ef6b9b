#include "casebase/store/row.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <variant>

#include "casebase/record/bytes.h"
#include "casebase/record/fields.h"
#include "planner/ground/base/file.h"

namespace capstan::casebase {
namespace {

constexpr std::uint8_t kRowVersion = 2;
constexpr std::uint8_t kStatedVersion = 3;  // of totals that state how many cases are held
constexpr std::size_t kSumBytes = 8;
constexpr std::uint64_t kTotalsSeed = 0x746f74616c73;  // "totals"

void put_sum(std::string& to, const Sum& s) {
  put(to, s.high);
  put(to, s.low);
}
Sum get_sum(Bytes& from) {
  const auto high = from.integer<std::uint64_t>();
  return {high, from.integer<std::uint64_t>()};
}

/// What `put_sealed` sealed; nothing when the seal does not fit.
std::optional<std::string_view> opened(std::string_view bytes, std::uint64_t seed) {
  if (bytes.size() < kSumBytes) return std::nullopt;
  const std::string_view text = bytes.substr(0, bytes.size() - kSumBytes);
  Bytes seal(bytes.substr(text.size()));
  if (seal.integer<std::uint64_t>() != sum_of(text, seed).low) return std::nullopt;
  return text;
}
/// Whether a question without fault may have this key: each known number is finite, above zero and within the
/// limits of its field, teeth and coolant are whole. The dimensions stand in the order of the question's
/// numbers, from the diameter on; coolant is the last.
bool can_be(const Key& key) {
  struct Limit {
    double most = 0.0;
    bool whole = false;
  };
  static const std::array<Limit, kDimensions> kLimits = [] {
    const auto fields = question_fields();
    const auto first =
        std::find_if(fields.begin(), fields.end(), [](const Field& f) { return f.name == "diameter_mm"; });
    std::array<Limit, kDimensions> out;
    for (std::size_t i = 0; i < kDimensions; ++i) {
      const Field& field = *(first + static_cast<std::ptrdiff_t>(i));
      const bool word = i + 1 == kDimensions;
      out[i] = {word ? static_cast<double>(Coolant::kThrough) : field.high,
                word || std::holds_alternative<CountAt>(field.at)};
    }
    return out;
  }();
  for (std::size_t i = 0; i < kDimensions; ++i) {
    if ((key.known >> i & 1U) == 0) continue;
    const double v = key.raw[i];
    if (!(v > 0.0 && v <= kLimits[i].most)) return false;
    if (kLimits[i].whole && v != std::floor(v)) return false;
  }
  return true;
}
std::string sealed(std::string text, std::uint64_t seed) {
  put(text, sum_of(text, seed).low);
  return text;
}

}  // namespace

std::optional<Id> id_of_digits(std::string_view digits) {
  if (digits.size() != 32) return std::nullopt;
  Id id;
  for (auto [half, to] : {std::pair{digits.substr(0, 16), &id.high}, {digits.substr(16), &id.low}}) {
    const auto [end, error] = std::from_chars(half.data(), half.data() + half.size(), *to, 16);
    if (error != std::errc() || end != half.data() + half.size()) return std::nullopt;
  }
  return id;
}

std::string digits_of(const Id& id) { return hex64(id.high) + hex64(id.low); }

std::string bytes_of(const Head& head, std::int64_t number) {
  std::string out;
  put(out, kRowVersion);
  put(out, static_cast<std::uint8_t>(head.kind));
  put_sum(out, head.id);
  put_sum(out, head.body);
  put(out, static_cast<std::uint8_t>(head.verdict));
  if (head.kind == RowKind::kCase) {
    put(out, static_cast<std::uint8_t>(head.origin));
    put(out, head.categories);
    put(out, head.key.known);
    for (std::size_t i = 0; i < kDimensions; ++i) {
      if ((head.key.known >> i & 1U) != 0) put(out, head.key.raw[i]);
    }
  }
  return sealed(std::move(out), static_cast<std::uint64_t>(number));
}

std::optional<Head> head_of(std::string_view bytes, std::int64_t number) {
  const auto text = opened(bytes, static_cast<std::uint64_t>(number));
  if (!text) return std::nullopt;
  Bytes from(*text);
  Head head;
  if (from.integer<std::uint8_t>() != kRowVersion) return std::nullopt;
  const auto kind = from.integer<std::uint8_t>();
  head.id = get_sum(from);
  head.body = get_sum(from);
  const auto verdict = from.integer<std::uint8_t>();
  if (kind > static_cast<std::uint8_t>(RowKind::kMetric) ||
      verdict > static_cast<std::uint8_t>(Verdict::kBad))
    return std::nullopt;
  head.kind = static_cast<RowKind>(kind);
  head.verdict = static_cast<Verdict>(verdict);
  if (head.kind == RowKind::kCase) {
    const auto origin = from.integer<std::uint8_t>();
    if (origin > static_cast<std::uint8_t>(Origin::kSimulated)) return std::nullopt;
    head.origin = static_cast<Origin>(origin);
    head.categories = from.text();
    head.key.known = from.integer<std::uint16_t>();
    if (head.key.known >> kDimensions != 0) return std::nullopt;
    for (std::size_t i = 0; i < kDimensions; ++i) {
      if ((head.key.known >> i & 1U) != 0) head.key.raw[i] = from.number();
    }
    if (!can_be(head.key)) return std::nullopt;
  }
  if (!from.good() || !from.at_end()) return std::nullopt;
  return head;
}

std::optional<std::string_view> case_id_in(std::string_view head) {
  const bool is_case =
      head.size() >= kIdAt + kIdBytes && head[kIdAt - 1] == static_cast<char>(RowKind::kCase);
  return is_case ? std::optional(head.substr(kIdAt, kIdBytes)) : std::nullopt;
}

std::string id_bytes_of(const Id& id) {
  std::string out;
  put_sum(out, id);
  return out;
}

std::string bytes_of(const Remark& remark) {
  std::string out;
  put(out, kRowVersion);
  for (const std::string* text : {&remark.by, &remark.time_utc, &remark.reason})
    put(out, std::string_view(*text));
  return out;
}

std::optional<Remark> remark_of(std::string_view bytes) {
  Bytes from(bytes);
  Remark r;
  if (from.integer<std::uint8_t>() != kRowVersion) return std::nullopt;
  for (std::string* text : {&r.by, &r.time_utc, &r.reason}) *text = from.text();
  if (!from.good() || !from.at_end()) return std::nullopt;
  return r;
}

void Totals::count(std::string_view head) {
  ++rows;
  // The head's own seal stands for its bytes: it was looked at before.
  std::array<char, 2 * sizeof(std::uint64_t) + kSumBytes> link;
  char* end = link.data();
  for (const std::uint64_t half : {chain.high, chain.low}) {
    const auto bytes = bytes_of(half);
    end = std::copy(bytes.begin(), bytes.end(), end);
  }
  const std::string_view seal = head.substr(head.size() - std::min(head.size(), kSumBytes));
  end = std::copy(seal.begin(), seal.end(), end);
  chain = sum_of({link.data(), static_cast<std::size_t>(end - link.data())});
}

std::string bytes_of(const Totals& totals, std::optional<std::int64_t> held) {
  std::string out;
  put(out, held ? kStatedVersion : kRowVersion);
  put(out, static_cast<std::uint64_t>(totals.rows));
  put_sum(out, totals.chain);
  if (held) put(out, static_cast<std::uint64_t>(*held));
  return sealed(std::move(out), kTotalsSeed);
}

std::optional<Stated> stated_of(std::string_view bytes) {
  const auto text = opened(bytes, kTotalsSeed);
  if (!text) return std::nullopt;
  Bytes from(*text);
  const auto version = from.integer<std::uint8_t>();
  if (version != kRowVersion && version != kStatedVersion) return std::nullopt;
  Stated s;
  s.totals.rows = static_cast<std::int64_t>(from.integer<std::uint64_t>());
  s.totals.chain = get_sum(from);
  if (version == kStatedVersion) s.held = static_cast<std::int64_t>(from.integer<std::uint64_t>());
  if (!from.good() || !from.at_end()) return std::nullopt;
  return s;
}

std::optional<Totals> totals_of(std::string_view bytes) {
  const auto stated = stated_of(bytes);
  return stated ? std::optional(stated->totals) : std::nullopt;
}

}  // namespace capstan::casebase
