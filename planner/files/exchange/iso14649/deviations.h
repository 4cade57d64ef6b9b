#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "planner/model/plan/plan.h"

namespace capstan::exchange {

struct Reading;

/// Finds where a file deviates from what ISO 14649 says of its numbers, and says so:
///
///   revolutions per minute for per second, m/min for m/s     EXC-UNIT-SPINDLE, EXC-UNIT-CUTSPEED
///   radians for degrees                                      EXC-UNIT-ANGLE
///   ratios in percent                                        EXC-RATIO
///   the complement of a drill's tool tip half angle          EXC-TIP-ANGLE
///   cutspeed and spindle that do not agree                   EXC-SPEED-CONFLICT
///   a spindle that turns against the cutter's hand           EXC-SPINDLE-DIRECTION
///   feeds and lengths of 0, feeds no cutter can take         EXC-ZERO, EXC-FEED
///
/// Decidable cases are repaired: the model holds the new value, the ledger the old lexeme under the reason
/// "given.repaired". Others are kept as given under "given.suspicious". Each is one warning.
/// An operation's feed or spindle speed of 0 is taken as open.
void find_deviations(Reading& reading);

/// A value that is not quite what the file says, or may not be what it means.
struct Suspicion {
  model::AnyRef object;
  std::string attribute;
  bool repaired = false;  ///< the model holds another value than the file
  std::string lexeme;     ///< as the file had it
  std::string why;
};

/// All of them, in the ledger's order; also of a plan that was written and read again.
[[nodiscard]] std::vector<Suspicion> suspicions(const model::Plan& plan);

}  // namespace capstan::exchange
