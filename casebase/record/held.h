#pragma once

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <utility>

namespace capstan::casebase {

/// The most that a case may differ from the handbook to be heard, and the most that is ever proposed, in either way.
/// Default, unsourced: makers' ranges around a start value are narrower.
inline constexpr double kMostMultiplier = 2.0;

/// Of values that each held for a time, the one that held longest: of a log, and in the same way of a
/// schedule that a log is held against. Values within 0.5 % are one.
class Held {
 public:
  /// Needs  value > 0.
  void add(double value, double seconds) {
    auto& bin = bins_[static_cast<int>(std::lround(std::log(value) / kBin))];
    bin.first += seconds;
    bin.second += value * seconds;
  }
  struct Longest {
    double value = 0.0, seconds = 0.0;
  };
  /// Zeros where nothing was added.
  [[nodiscard]] Longest longest() const {
    Longest out;
    // A value that lies at the edge of two bins fills both: neighbours count together.
    for (auto at = bins_.begin(); at != bins_.end(); ++at) {
      double seconds = at->second.first, sum = at->second.second;
      if (const auto next = std::next(at); next != bins_.end() && next->first == at->first + 1) {
        seconds += next->second.first;
        sum += next->second.second;
      }
      if (seconds > out.seconds) out = {sum / seconds, seconds};
    }
    return out;
  }

 private:
  static constexpr double kBin = 0.005;
  std::map<int, std::pair<double, double>> bins_;  // seconds, weighted sum
};

/// The feed per tooth of the feed and the speed that were held longest, mm; 0 for what nobody mills with.
inline double held_fz_mm(double feed_mm_min, double rpm, int teeth) {
  const double fz = rpm > 0.0 ? feed_mm_min / rpm / std::max(1, teeth) : 0.0;
  return fz >= 1e-5 && fz <= 10.0 ? fz : 0.0;
}

}  // namespace capstan::casebase
