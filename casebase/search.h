#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <vector>

#include "casebase/record/case.h"
#include "casebase/store/log.h"

namespace capstan::casebase {

struct Found {
  std::uint32_t entry = 0;  ///< of the log
  double distance2 = 0.0;
};

/// Neighbours of a question among the entries of a log: nearest first, equal distances by id.
///
/// Cases of equal categories that know the same numbers stand in one bucket. A bucket has an index, which is
/// made when it is asked first, and a tail of cases that came since, which is looked at one by one: adding
/// makes no index. When the tail has grown to a share of the bucket, the index is made again at the next
/// question.
///
/// Threads   the const members may be called from many threads, `update` from one, without readers at that
/// time.
class Search {
 public:
  explicit Search(const Log& log);
  Search(Search&&) noexcept;
  Search& operator=(Search&&) noexcept;
  ~Search();

  /// What each dimension counts from now on.
  void weigh(const Metric& metric);
  [[nodiscard]] const Metric& metric() const;
  /// Takes in what the log took in since.
  void update();
  /// Whether any case could be compared with the question.
  [[nodiscard]] bool any(const Question& q) const;
  /// Both need a question without fault.
  [[nodiscard]] std::vector<Found> nearest(const Question& q, std::size_t k) const;
  [[nodiscard]] std::vector<Found> within(const Question& q, double limit2) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace capstan::casebase
