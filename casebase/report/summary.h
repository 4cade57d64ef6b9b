#pragma once

#include <array>
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

/// An observed figure that is told of each group.
struct Column {
  std::string_view name, unit;  ///< for people
  std::string_view key;         ///< in JSON
  std::optional<Figure> Observed::*figure;
  int decimals;
  bool always;  ///< a column of its own where nobody measured it, too
};
inline constexpr std::array kColumns = {
    Column{"time", "s", "time_s", &Observed::time_s, 2, true},
    Column{"lag", "mm", "lag_mm", &Observed::lag_mm, 4, true},
    Column{"load", "%", "load_percent", &Observed::spindle_load_percent, 1, true},
    Column{"size off", "mm", "size_deviation_mm", &Observed::size_deviation_mm, 4, true},
    Column{"Ra", "um", "surface_ra_um", &Observed::surface_ra_um, 2, false},
    Column{"force", "N", "peak_force_n", &Observed::peak_force_n, 0, false},
    Column{"power", "W", "power_w", &Observed::power_w, 0, false},
    Column{"wear", "mm", "wear_mm", &Observed::wear_mm, 3, false},
};

enum class By : std::uint8_t { kWorkingstep, kTool, kFeature };

/// Cases of one workingstep, one tool (class, diameter, very tool) or one kind and size of feature.
struct Group {
  std::string name;
  std::vector<const Case*> cases;
  std::size_t good = 0, bad = 0;
  std::array<Spread, kColumns.size()> figures = {};  ///< as kColumns
};
/// The groups in order of their names. They point into `cases`.
[[nodiscard]] std::vector<Group> grouped(std::span<const Case> cases, By by);

/// A quantity that is predicted and observed, and the model that predicts it.
struct Quantity {
  std::string_view name, model;
  double (*predicted)(const Case&);                ///< 0: it was not
  std::optional<Figure> (*observed)(const Case&);  ///< what the prediction speaks of
  bool at_most = false;  ///< the prediction is the largest amount expected: less is as predicted
};
[[nodiscard]] std::span<const Quantity> quantities();

/// Observed over predicted of one case: at least kLeastRatio, or 0 where one of both is not known, or is 0
/// where the prediction is no largest amount. Of a size what is off the size that the path aims at: a bore in
/// the middle of its zone is not bent. A path that does not state its aim tells nothing.
inline constexpr double kLeastRatio = 0.01;  ///< what is less, down to 0, counts as that; end of the plots
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
