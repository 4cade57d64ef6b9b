#pragma once

#include <array>
#include <map>
#include <tuple>
#include <vector>

#include "planner/making/optimise/feeds/judge.h"

/// Sections on a grid: each is judged once, however many samples share it.
namespace capstan::optimise::feed {

/// What a class of sections bears, at the edge's feed (gain 1). Infinite: no feed up to the ceiling and a
/// tenth more reaches a limit.
struct Page {
  Cut cut;                      ///< the heaviest of the class
  double feed_mm_min = 0.0;     ///< the largest within every limit; 0: not even the least feed
  Column at_limit{};            ///< largest feed of each limit alone
  Column at_more{};             ///< the same with 10 % more of that limit
  double gain = 1.0;            ///< of the class: feeds of the edge are judged up to this times the centre's
  bool known = true;            ///< false: outside the formulas' range
  double most_scheduled = 0.0;  ///< largest edge feed scheduled so far; for the peak loads
};

/// By how much more of one limit the saving is told.
inline constexpr double kMoreOfALimit = 1.1;

class Book {
 public:
  explicit Book(const FeedQuestion& q) : q_(q) {}

  [[nodiscard]] const Judge& judge(double n_rpm);
  /// The class of a cut, rounded to the heavier side: depth and area by 0.25 %, arc by 1 to 2 %.
  [[nodiscard]] Page& page(const Cut& cut, double n_rpm);
  [[nodiscard]] const Page& plunge(double n_rpm);

  /// Each page once, in a fixed order.
  template <class F>
  void each(F&& f) {
    for (auto& [key, page] : pages_) f(judge(std::get<0>(key)), page);
  }
  [[nodiscard]] std::size_t pages() const { return pages_.size(); }

 private:
  // speed, depth, sweep, entry, area, gain, band
  using Key = std::tuple<double, long, long, long, long, long, long, long>;
  /// Judges the page's cut at feeds of the edge up to those of the ceiling with its gain.
  void fill(Page& page, const Judge& judge) const;

  const FeedQuestion& q_;
  std::map<double, Judge> judges_;
  std::map<Key, Page> pages_;
  std::map<double, Page> plunges_;
  Key last_key_{-1.0, 0, 0, 0, 0, 0, 0, 0};
  Page* last_ = nullptr;
};

}  // namespace capstan::optimise::feed
