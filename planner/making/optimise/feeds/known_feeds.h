#pragma once

#include <array>
#include <cstdint>
#include <map>

#include "planner/making/optimise/feeds/cut_classes.h"

namespace capstan::optimise {

/// Classes of cuts with the feeds that they allow, for one question. A class that is found has the very cut
/// of the one that is looked for, to the last bit.
class KnownFeeds::Classes {
 public:
  /// Null where there is none. `most_scheduled` of what is found is 0.
  [[nodiscard]] const feed::CutClass* find(const feed::CutClass& like, double n_rpm) const;
  void keep(const feed::CutClass& filled, double n_rpm);
  /// Lets go of what made the classes' cuts ready.
  void forget_ready();

 private:
  using Exactly = std::array<std::uint64_t, 9>;  ///< bits of the numbers, so that also what is none is itself
  static Exactly key_of(const feed::CutClass& c, double n_rpm);
  std::map<Exactly, feed::CutClass> classes_;
};

}  // namespace capstan::optimise
