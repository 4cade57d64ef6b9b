#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "casebase/casebase.h"

namespace capstan::casebase {

/// Where a case comes from, best first; what came of it. The words of `Case::provenance` and `Case::verdict`.
enum class Origin : std::uint8_t { kMeasured, kEntered, kSimulated };
enum class Verdict : std::uint8_t { kUnknown, kGood, kBad };
[[nodiscard]] std::string_view to_text(Origin o);
[[nodiscard]] std::string_view to_text(Verdict v);

/// The values of a cut that a case can speak about. Zero: open.
struct Values {
  double vc_m_min = 0.0, fz_mm = 0.0, ap_mm = 0.0, ae_mm = 0.0;
  bool operator==(const Values&) const = default;
};

/// Which values a failure is laid on: those that are lowered for its sake.
struct Blame {
  bool speed = false, feed = false, depth = false;
  bool operator==(const Blame&) const = default;
};

/// What one near case says of a cut.
struct Evidence {
  std::string id;
  std::string run;   ///< what was cut when: cases that share it are one cut told twice
  std::string told;  ///< what was observed, word for word: likewise; empty: nothing was
  Origin origin = Origin::kEntered;
  Verdict verdict = Verdict::kUnknown;
  Blame blame;  ///< of a bad one
  double distance = 0.0;
  Values cut;
};

/// A case as evidence for a cut at that distance with a cutter of that diameter; 0: not known. Its feed is taken
/// as it is for a cutter that is at least as large, and in proportion to the diameter for a smaller one. A worn
/// edge is laid on the speed, a failure without a name on speed and feed.
[[nodiscard]] Evidence evidence_of(const Case& c, double distance, double cutter_diameter_mm);

}  // namespace capstan::casebase
