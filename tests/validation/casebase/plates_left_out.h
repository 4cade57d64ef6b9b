#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include "casebase/record/case.h"
#include "planner/ground/base/result.h"
#include "tests/validation/nist/plate_data.h"

/// Each plate of the NIST test bed predicted without its own cases: by the planner's models, and by what the
/// cases of the other plates correct of them, as `capstan plan --cases` does (casebase/tune/corrections.h).
namespace capstan::validation {

/// One prediction. A model states no interval.
struct PlatePrediction {
  double value = 0.0;
  double std_dev = 0.0, half_90 = 0.0;  ///< of one further plate; half the interval of 90 %
};

/// One case of the plate that is left out, and what each predictor makes of it, in the order of its names.
struct LeftOutCase {
  const casebase::Case* c = nullptr;
  double observed = 0.0;
  std::vector<PlatePrediction> by;
  [[nodiscard]] double error(std::size_t predictor) const { return by[predictor].value - observed; }
  [[nodiscard]] bool within(std::size_t predictor) const;
};

/// What is predicted of every tool of every plate by models to which nothing of one plate was fitted.
using ToolOfPart = std::pair<std::string, int>;  ///< part, tool
struct PlateModels {
  std::map<ToolOfPart, double> uncalibrated_s;  ///< moving, on a machine that nobody calibrated
  std::map<ToolOfPart, double> calibrated_s;  ///< calibrated on the plates that section 1 names, but this one
  std::map<ToolOfPart, double> bending_mm;    ///< of the bores that the tool mills, as section 2 says
};
/// By the part that is left out.
[[nodiscard]] Result<std::map<std::string, PlateModels>> models_without(const nist::Plate& plate);

/// Number of the tool that a workingstep of the sheet uses.
[[nodiscard]] int plate_tool_of(const casebase::Case& c);

/// Predictors of ln(time of a tool / s).
enum TimeBy : std::size_t {
  kByPath,           ///< length of the path over its feed
  kByMotion,         ///< the motion model on a machine that nobody calibrated
  kByCalibrated,     ///< the same, calibrated
  kTuned,            ///< kByMotion, corrected by the cases of all tools
  kTunedAlike,       ///< by those of the same operation and tool class
  kTunedCalibrated,  ///< kByCalibrated, corrected by the cases of all tools
  kTunedCalibratedAlike,
  kTimePredictors
};
/// `cases`: with a time, and none of a tool whose time is another run's.
[[nodiscard]] std::vector<LeftOutCase> times_left_out(const std::vector<casebase::Case>& cases,
                                                      const std::map<std::string, PlateModels>& models);

/// Predictors of the deviation of bores from what their path aims at, mm.
enum BoreBy : std::size_t { kByBending, kTunedBores, kBorePredictors };
[[nodiscard]] std::vector<LeftOutCase> bores_left_out(const std::vector<casebase::Case>& cases,
                                                      const std::map<std::string, PlateModels>& models);

}  // namespace capstan::validation
