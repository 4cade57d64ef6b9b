#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/record/held.h"

namespace capstan::casebase::tune {

/// The loads of a cut that are watched, each against its own limit.
enum class Watched : unsigned char { kForce, kPower, kSize, kFinish, kWear };
inline constexpr std::size_t kWatchedCount = static_cast<std::size_t>(Watched::kWear) + 1;
inline constexpr std::array<std::string_view, kWatchedCount> kWatchedNames = {
    "peak force", "spindle power", "size", "surface", "wear of the edge"};

/// Cutting speed and feed per tooth as logarithms of their ratios to the handbook's values.
struct Setting {
  double ln_vc = 0.0, ln_fz = 0.0;
  friend bool operator==(const Setting&, const Setting&) = default;
};

/// One cut that was made, as tuning sees it.
struct Evidence {
  std::string id;                ///< of the case
  std::vector<double> question;  ///< where it lies from what is asked, by the scales of normalisation.h
  Setting at;
  double worn = 0.0;              ///< wear of the edge at the end of the cut over what is allowed; not known: 0
  std::optional<double> ln_time;  ///< time over the one that is planned at the handbook's values
  std::array<std::optional<double>, kWatchedCount> ln_load = {};  ///< observed over limit
  bool failed = false;                                            ///< chatter, breakage, or a bad verdict
  bool judged = true;    ///< somebody or some instrument said whether it went well
  bool measured = true;  ///< neither simulated nor entered by hand
  std::string source;    ///< rows of one source are one observation; in one line, for messages
  std::string machine;
  std::string edge;         ///< the tool instance; empty: not known, and all of those are taken as one edge
  std::optional<long> day;  ///< days since 1970-01-01; not known: no day of its own
};

struct Refused {
  std::size_t index = 0;  ///< of the evidence
  std::string why;
};

/// Evidence that may be heard, and what is not, each with its reason: values that are no numbers, a speed or
/// feed more than `kMostMultiplier` from the handbook, another machine, a source that has been heard already.
/// The day of a cut that lies after `today` is taken as not known; the cut itself counts.
struct Heard {
  std::vector<Evidence> evidence;
  std::vector<Refused> refused;
  std::size_t days_in_future = 0;
};
[[nodiscard]] Heard heard(std::span<const Evidence> evidence, std::string_view machine,
                          std::optional<long> today);

/// Whether two settings are one for counting repeats: within 2 %, what an override's step makes of it.
/// Default, unsourced.
[[nodiscard]] bool same_setting(const Setting& a, const Setting& b);

/// How often a setting was cut with success by measured cases, and on how many edges and days.
struct Repeats {
  std::size_t good = 0, failed = 0, edges = 0, days = 0;
};
[[nodiscard]] Repeats repeats_at(std::span<const Evidence> evidence, const Setting& at);

}  // namespace capstan::casebase::tune
