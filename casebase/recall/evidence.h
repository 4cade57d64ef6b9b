#pragma once

#include <string>
#include <vector>

#include "casebase/record/case.h"

namespace capstan::casebase {

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
  std::string run;  ///< what was cut when: cases that share it are one cut recorded twice
  /// What was observed, word for word: likewise; empty: nothing was. Of fewer than three figures part and
  /// time are in it.
  std::string told;
  Origin origin = Origin::kEntered;
  Verdict verdict = Verdict::kUnknown;
  Blame blame;  ///< of a bad one
  double distance = 0.0;
  Values cut;
  /// Whether a success of it may raise values, or lift what failures lower: not while cases are lost that may
  /// have spoken against it.
  bool raises = true;
  bool lost = false;  ///< a failure of which its head alone is left: nothing of `cut` is known
};

/// A case as evidence for a question at that distance. Its feed is taken as it is for a cutter that is at
/// least as large, and in proportion to the diameter for a smaller one. Worn edges are laid on the speed,
/// broken ones on feed and depth, chatter on the depth; a failure without a name on speed and feed.
[[nodiscard]] Evidence evidence_of(const Case& c, double distance, double cutter_diameter_mm);

}  // namespace capstan::casebase
