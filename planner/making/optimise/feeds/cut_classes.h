#pragma once

#include <array>
#include <map>
#include <memory>
#include <tuple>
#include <utility>
#include <vector>

#include "planner/making/optimise/feeds/cut_loads.h"

/// Cuts that are nearly alike are one class. The feeds that a class allows are computed once, however many
/// samples of a path belong to it.
namespace capstan::optimise::feed {

/// The feeds that a class of cuts allows, at the edge (gain 1). Infinite: no feed up to 1.1 times the ceiling
/// reaches the limit.
struct CutClass {
  Cut cut;                                ///< the heaviest of the class
  std::shared_ptr<const ReadyCut> ready;  ///< the same; null: not kept, or outside the formulas' range
  double feed_mm_min = 0.0;               ///< the largest within every limit; 0: not even the least feed
  Column at_limit{};                      ///< largest feed of each limit alone
  Column at_more{};                       ///< the same with 10 % more of that limit
  double gain = 1.0;  ///< of the class: feeds of the edge are computed up to this times the centre's
  bool known = true;  ///< false: outside the formulas' range
  double most_scheduled = 0.0;  ///< largest edge feed scheduled so far; for the peak loads
};

/// Factor by which one limit is eased to find the time that this would save, for `explain`.
inline constexpr double kMoreOfALimit = 1.1;

class CutClasses {
 public:
  /// `known` may be null.
  CutClasses(const FeedQuestion& q, KnownFeeds* known)
      : q_(q), known_(known != nullptr ? &known->of(q.cut, q.feed_mm_min) : nullptr) {}

  [[nodiscard]] const CutLoads& loads(double n_rpm);
  /// The class of a cut, rounded to the heavier side: depth and area by 0.25 %, arc by 1 to 2 %.
  [[nodiscard]] CutClass& class_of(const Cut& cut, double n_rpm);
  /// The class of a plunge into this area, rounded up by 0.25 % at most; 0: into the solid.
  [[nodiscard]] const CutClass& plunge(double area_mm2, double n_rpm);

  /// Each class once, in a fixed order.
  template <class F>
  void each(F&& f) {
    for (auto& [key, kind] : classes_) f(loads(std::get<0>(key)), kind);
  }

 private:
  // speed, depth, sweep, entry, area, gain, band
  using Key = std::tuple<double, long, long, long, long, long, long, long>;
  /// Finds the feeds at which the class reaches its limits: feeds of the edge, up to the ceiling times its
  /// gain.
  void fill(CutClass& kind, const CutLoads& loads) const;

  const FeedQuestion& q_;
  KnownFeeds::Classes* known_;
  std::map<double, CutLoads> loads_;
  std::map<Key, CutClass> classes_;
  std::map<std::pair<double, long>, CutClass> plunges_;  ///< by speed and area
  std::size_t ready_ = 0;  ///< classes whose cut was kept ready
  Key last_key_{-1.0, 0, 0, 0, 0, 0, 0, 0};
  CutClass* last_ = nullptr;
};

}  // namespace capstan::optimise::feed
