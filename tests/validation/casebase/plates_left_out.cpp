#include "tests/validation/casebase/plates_left_out.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <set>

#include "casebase/tune/from_case.h"
#include "tests/validation/nist/bore_model.h"
#include "tests/validation/nist/plate_time.h"

namespace capstan::validation {
namespace {

using casebase::Case;
namespace tune = casebase::tune;

/// Tools that mill bores, and their nominal size.
const std::map<int, double> kBores = {{5, 4.0}, {1, 3.0}};

ToolOfPart of_row(const nist::Row& r) { return {std::to_string(r.time->part), r.time->tool}; }

Result<PlateModels> calibrated(const nist::Plate& plate, std::map<ToolOfPart, double> uncalibrated_s) {
  const auto study = nist::study_times(plate);
  if (!study) return tl::unexpected(study.error());
  PlateModels out{.uncalibrated_s = std::move(uncalibrated_s), .calibrated_s = {}, .bending_mm = {}};
  for (const nist::Row& r : study->rows) {
    out.calibrated_s[of_row(r)] = r.predicted_s;
    if (const auto bore = kBores.find(r.time->tool); bore != kBores.end())
      out.bending_mm[of_row(r)] =
          nist::bore_of(plate, study->fit, r, bore->second).predicted.bore_by_bending_mm;
  }
  return out;
}

std::vector<Case> of_others(const std::vector<Case>& cases, const Case& left,
                            const std::function<bool(const Case&)>& wanted) {
  std::vector<Case> out;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(out),
               [&](const Case& c) { return c.from.part != left.from.part && wanted(c); });
  return out;
}

/// `c` as the cases correct the time that was predicted for it.
PlatePrediction tuned_time(const Case& c, const std::vector<Case>& others) {
  PlatePrediction out{.value = std::log(c.predicted.time_s)};
  const auto samples = tune::times_of(others);
  const auto correction = tune::correct_time(samples, false);
  if (!correction) return out;
  std::set<std::size_t> parts;
  for (const tune::TimeSample& s : samples) parts.insert(s.group);
  const double block_s = c.predicted.time_s / c.bound.path_blocks;
  out.value += std::log(correction->factor(block_s));
  out.std_dev = correction->ln_std_dev(block_s);
  out.half_90 = tune::deviations_90(static_cast<double>(parts.size()) - 1.0) * out.std_dev;
  return out;
}

std::vector<Case> with_times(std::vector<Case> cases, const std::map<ToolOfPart, double>& times_s) {
  for (Case& c : cases) c.predicted.time_s = times_s.at({c.from.part, plate_tool_of(c)});
  return cases;
}

}  // namespace

bool LeftOutCase::within(std::size_t predictor) const {
  return std::abs(error(predictor)) <= by[predictor].half_90;
}

int plate_tool_of(const Case& c) {
  static const std::map<std::string, int> kTools = {{"FACE", 15},     {"SPOT", 7},       {"PROFILE", 3},
                                                    {"POCKETS", 4},   {"BORES 4 mm", 5}, {"BORES 3 mm", 1},
                                                    {"ENGRAVING", 23}};
  return kTools.at(c.from.workingstep);
}

Result<std::map<std::string, PlateModels>> models_without(const nist::Plate& plate) {
  const auto machine = nist::uncalibrated_machine(plate);
  if (!machine) return tl::unexpected(machine.error());
  const auto rows = nist::times_on(plate, *machine);
  if (!rows) return tl::unexpected(rows.error());
  std::map<ToolOfPart, double> uncalibrated_s;
  for (const nist::Row& r : *rows) uncalibrated_s[of_row(r)] = r.predicted_s;
  const auto whole = calibrated(plate, uncalibrated_s);
  if (!whole) return tl::unexpected(whole.error());
  std::map<std::string, PlateModels> out;
  for (std::size_t i = 0; i < plate.parts.size(); ++i) {
    const std::string part = std::to_string(plate.parts[i].part);
    if (!plate.parts[i].calibrates) {
      out.emplace(part, *whole);
      continue;
    }
    nist::Plate others = plate;
    others.parts[i].calibrates = false;
    auto without = calibrated(others, uncalibrated_s);
    if (!without) return tl::unexpected(without.error());
    out.emplace(part, *std::move(without));
  }
  return out;
}

std::vector<LeftOutCase> times_left_out(const std::vector<Case>& cases,
                                        const std::map<std::string, PlateModels>& models) {
  std::vector<LeftOutCase> out;
  std::map<std::string, std::pair<std::vector<Case>, std::vector<Case>>> based;
  for (const auto& [part, m] : models)
    based.emplace(part, std::pair(with_times(cases, m.uncalibrated_s), with_times(cases, m.calibrated_s)));
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const auto& [motion, calibrated] = based.at(c.from.part);
    const auto all = [](const Case&) { return true; };
    const auto alike = [&](const Case& o) {
      return o.asked.operation == c.asked.operation && o.asked.tool_class == c.asked.tool_class;
    };
    LeftOutCase l{.c = &c, .observed = std::log(c.observed.time_s->value), .by = {}};
    l.by.resize(kTimePredictors);
    l.by[kByPath].value = std::log(c.predicted.time_s);
    l.by[kByMotion].value = std::log(motion[i].predicted.time_s);
    l.by[kByCalibrated].value = std::log(calibrated[i].predicted.time_s);
    l.by[kTuned] = tuned_time(motion[i], of_others(motion, c, all));
    l.by[kTunedAlike] = tuned_time(motion[i], of_others(motion, c, alike));
    l.by[kTunedCalibrated] = tuned_time(calibrated[i], of_others(calibrated, c, all));
    l.by[kTunedCalibratedAlike] = tuned_time(calibrated[i], of_others(calibrated, c, alike));
    out.push_back(std::move(l));
  }
  return out;
}

std::vector<LeftOutCase> bores_left_out(const std::vector<Case>& cases,
                                        const std::map<std::string, PlateModels>& models) {
  std::vector<LeftOutCase> out;
  for (const Case& c : cases) {
    const auto sample = tune::bores_of(std::vector<Case>{c});
    if (sample.empty()) continue;
    const tune::BoreSample& bore = sample.front();
    LeftOutCase l{.c = &c, .observed = bore.deviation_mm, .by = {}};
    l.by.resize(kBorePredictors);
    l.by[kByBending].value = models.at(c.from.part).bending_mm.at({c.from.part, plate_tool_of(c)});
    const auto same_cutter = [&](const Case& o) {
      return tune::same_cutter(o.asked, c.asked) && o.asked.tool_class == c.asked.tool_class;
    };
    const auto law = tune::correct_bores(tune::bores_of(of_others(cases, c, same_cutter)), false);
    if (!law) continue;
    l.by[kTunedBores] = {.value = law->deviation_mm(bore.feed_per_turn_mm, bore.stick_out_ratio),
                         .std_dev = law->std_dev_mm(bore.feed_per_turn_mm, bore.stick_out_ratio),
                         .half_90 = law->half_90_mm(bore.feed_per_turn_mm, bore.stick_out_ratio)};
    out.push_back(std::move(l));
  }
  return out;
}

}  // namespace capstan::validation
