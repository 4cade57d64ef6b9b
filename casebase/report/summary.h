#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/record/case.h"

/// What cases show together: figures by workingstep, tool or feature, and where prediction and observation
/// part. Simulated figures are no observation.
namespace capstan::casebase::report {

/// An observed quantity over some cases.
struct Spread {
  std::size_t count = 0;  ///< 0: nobody observed it
  double mean = 0.0;
  double std_dev = 0.0;  ///< of one value; 0 of a single one
  double low = 0.0, high = 0.0;
};

enum class By : std::uint8_t { kWorkingstep, kTool, kFeature };

/// Cases of one workingstep, one tool (class, diameter, very tool) or one kind and size of feature.
struct Group {
  std::string name;
  std::vector<const Case*> cases;
  std::size_t good = 0, bad = 0;
  Spread time_s, lag_mm, load_percent, size_mm;
};
/// The groups in order of their names. They point into `cases`.
[[nodiscard]] std::vector<Group> grouped(std::span<const Case> cases, By by);

/// A quantity that is predicted and observed, and the model that predicts it.
struct Quantity {
  std::string_view name, model;
  double (*predicted)(const Case&);  ///< 0: it was not
  const std::optional<Figure>& (*observed)(const Observed&);
};
[[nodiscard]] std::span<const Quantity> quantities();

/// Observed over predicted of one case: above 0, or 0 where one of both is not known.
[[nodiscard]] double ratio_of(const Quantity& q, const Case& c);

/// How prediction and observation of one quantity compare over some cases.
struct Parting {
  const Quantity* quantity = nullptr;
  std::size_t count = 0;
  double ratio = 0.0;       ///< geometric mean of observed over predicted
  double ln_std_dev = 0.0;  ///< of its logarithm, from case to case
  /// The mean is off by more than twice its standard error and more than a twentieth (default, unsourced):
  /// the model is to blame, and not chance.
  bool apart = false;
};
/// Quantities that any of the cases knows both ways.
[[nodiscard]] std::vector<Parting> partings_of(std::span<const Case* const> cases);

}  // namespace capstan::casebase::report
