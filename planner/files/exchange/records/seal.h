#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <span>
#include <string>
#include <string_view>

#include "planner/files/exchange/common/report.h"
#include "planner/files/p21/file.h"
#include "planner/ground/base/result.h"
#include "planner/model/plan/decision/contradicted.h"

namespace capstan::exchange {

/// A whole Part 21 file with its seal, the last entities of its header: what it says, kind by kind of entity,
/// as hashes:
///
///     !CAPSTAN_SEAL('MILLING_TECHNOLOGY',5,'hash')    all entities of a keyword, in the header or the data
///     !CAPSTAN_SEAL('capstan step',5,'hash')          all records of a kind that AP238 holds as properties
///
/// By it a reader knows what was edited since, also where no record speaks of it. Numbers count by value;
/// spacing, comments and the order of entities do not. Words for people (reasons, provenance, the standard's
/// own header) are not sealed. Fails  P21-... when the file cannot be read.
[[nodiscard]] Result<std::string> with_seal(std::string file);

/// Counts and hashes by keyword.
class Seals {
 public:
  struct Seal {
    std::size_t count = 0;
    std::uint64_t sum = 0;  ///< of the entities' hashes: their order does not count
  };
  using ByKeyword = std::map<std::string, Seal, std::less<>>;
  Seals() = default;
  Seals(Seals&&) = default;
  Seals(const Seals&) = delete;
  Seals& operator=(const Seals&) = delete;
  void add(std::string_view keyword, std::uint64_t hash);
  void add(const Seals& others);
  /// A text that is to be hashed.
  struct Text {
    std::string_view keyword, text;
    std::uint64_t hash;  ///< of what comes before the text
  };
  /// Adds the hashes of some texts, in less time than one by one. Their `hash` is then that of all.
  void add(std::span<Text> texts);
  [[nodiscard]] const ByKeyword& by_keyword() const { return seals_; }

 private:
  ByKeyword seals_;
  ByKeyword::value_type* last_ = nullptr;  ///< most are of the keyword of the one before
};
/// An instance, and a header entity, as `spelled` spells it: for those who print just so, and need not be
/// parsed. `number` is "#12", `text` begins with the keyword.
[[nodiscard]] Seals::Text text_of_instance(std::string_view number, std::string_view keyword,
                                           std::string_view text);
[[nodiscard]] Seals::Text text_of_header(std::string_view keyword, std::string_view text);
/// The header entities that seal a file: of what `rest` holds (a file), and of what was sealed already.
[[nodiscard]] Result<std::string> seal_text(std::string rest, const Seals& sealed_already);
/// Result of comparing a file with its seal.
struct SealState {
  bool holds = false;       ///< there is one, and nothing was edited
  bool paths_hold = false;  ///< there is one, and nothing was edited but lists of the plan in the header
  std::set<model::Listed> edited;  ///< these lists
};
/// Where the seal does not hold, warns EXC-EDITED, naming the kinds whose entities were edited since.
[[nodiscard]] SealState seal_of(const p21::File& file, Reporter& reporter);
[[nodiscard]] bool is_seal(std::string_view keyword);

}  // namespace capstan::exchange
