#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "casebase/retain/join/import.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tests/validation/casebase/plates_left_out.h"
#include "tests/validation/studies.h"

// The plates of the NIST test bed as cases, imported as `capstan cases import` does, and each plate predicted
// from the others (plates_left_out.h).

namespace capstan::validation {
namespace {

using casebase::Case;
namespace retain = casebase::retain;

const std::set<std::string> kTraced = {"2", "5", "9", "12", "16", "18"};
const std::set<std::string> kInterrupted = {"1", "10", "11", "19"};
constexpr const char* kDoubtful = "7";  // its feeds are not known (section 1)

Result<std::vector<Case>> import_plates(const std::string& folder, Job& job) {
  const auto sheet = read_file(testing::source_dir() + "/tests/validation/nist/plate_sheet.csv");
  if (!sheet) return tl::unexpected(sheet.error());
  const auto steps = retain::read_sheet(*sheet, "plate_sheet.csv");
  if (!steps) return tl::unexpected(steps.error());
  const auto measured = read_file(folder + "/cmm_values.csv");
  if (!measured) return tl::unexpected(measured.error());
  auto inspection = retain::read_inspection(*measured, "cmm_values.csv", 1.0, job);
  if (!inspection) return tl::unexpected(inspection.error());
  const retain::ImportOptions options{.inspection = *std::move(inspection)};
  std::vector<Case> out;
  const auto take = [&](const std::string& file, retain::LogFormat format,
                        const std::string& part) -> Status {
    std::ifstream in(folder + "/" + file, std::ios::binary);
    auto cases = retain::import_log(in, format, *steps, {.part = part, .machine = "Hurco04", .file = file},
                                    options, job);
    if (!cases) return tl::unexpected(cases.error());
    out.insert(out.end(), cases->begin(), cases->end());
    return {};
  };
  for (const std::string& part : kTraced) {
    const std::string two = (part.size() < 2 ? "0" : "") + part;
    if (auto ok = take("traces/Plate-Hurco04-" + two + "of20.txt", retain::LogFormat::kTrace, part); !ok)
      return tl::unexpected(ok.error());
  }
  for (const char* part : {"1", "4", "7", "10", "11", "14", "19", "20"}) {
    if (auto ok = take("times_per_tool.csv", retain::LogFormat::kTimes, part); !ok)
      return tl::unexpected(ok.error());
  }
  return out;
}

/// How a predictor does over some cases.
struct PredictorFigures {
  std::size_t n = 0, within = 0;
  double error = 0.0, stated = 0.0;    // rms
  double observed = 0.0, value = 0.0;  // means
};
using Wanted = std::function<bool(const LeftOutCase&)>;
PredictorFigures figures_of(const std::vector<LeftOutCase>& all, std::size_t by, const Wanted& of) {
  PredictorFigures f;
  for (const LeftOutCase& l : all) {
    if (!of(l)) continue;
    ++f.n;
    f.within += l.within(by) ? 1 : 0;
    f.error += l.error(by) * l.error(by);
    f.stated += l.by[by].std_dev * l.by[by].std_dev;
    f.observed += l.observed;
    f.value += l.by[by].value;
  }
  const double n = f.n > 0 ? static_cast<double>(f.n) : 1.0;
  f.error = std::sqrt(f.error / n);
  f.stated = std::sqrt(f.stated / n);
  f.observed /= n;
  f.value /= n;
  return f;
}

std::string within_text(const PredictorFigures& f) {
  return std::to_string(f.within) + " of " + std::to_string(f.n);
}

bool has_trace(const LeftOutCase& l) { return kTraced.contains(l.c->from.part); }
bool counted_plate(const LeftOutCase& l) {
  return !kInterrupted.contains(l.c->from.part) && l.c->from.part != kDoubtful;
}
bool anything(const LeftOutCase&) { return true; }

std::string signed_mm(double v) { return (v < 0.0 ? "" : "+") + fixed(v, 3); }

/// Those with a time that is the plate's own.
std::vector<Case> timed(const std::vector<Case>& cases) {
  std::vector<Case> out;
  std::copy_if(cases.begin(), cases.end(), std::back_inserter(out), [](const Case& c) {
    // The engraver's time in the table holds a later run of another program (section 1).
    return c.observed.time_s && c.predicted.time_s > 0.0 &&
           (c.from.workingstep != "ENGRAVING" || kTraced.contains(c.from.part));
  });
  return out;
}

constexpr const char* kTimeNames[kTimePredictors] = {"path ÷ feed",
                                                     "motion model, not calibrated",
                                                     "motion model, calibrated",
                                                     "not calibrated, tuned by all tools",
                                                     "not calibrated, tuned by tools alike",
                                                     "calibrated, tuned by all tools",
                                                     "calibrated, tuned by tools alike"};

void tell_times(const std::vector<LeftOutCase>& times, Comparison& out) {
  Table table{{"rms of ln(time of a tool), predicted over measured", "n"}, {}};
  table.head.insert(table.head.end(), std::begin(kTimeNames), std::end(kTimeNames));
  const auto add = [&](const std::string& name, const Wanted& of) {
    std::vector<std::string> row = {name, std::to_string(figures_of(times, 0, of).n)};
    for (std::size_t by = 0; by < kTimePredictors; ++by)
      row.push_back(fixed(figures_of(times, by, of).error, 3));
    table.rows.push_back(std::move(row));
  };
  add("all", anything);
  add("plates not interrupted, feeds known", counted_plate);
  add("of them with a trace", [](const LeftOutCase& l) { return counted_plate(l) && has_trace(l); });
  std::set<std::string> steps;
  for (const LeftOutCase& l : times) steps.insert(l.c->from.workingstep);
  for (const std::string& step : steps) {
    add("of them " + step,
        [&](const LeftOutCase& l) { return counted_plate(l) && l.c->from.workingstep == step; });
  }
  Table stated{{"plates not interrupted, feeds known", "rms", "stated, rms", "within the interval of 90 %"},
               {}};
  for (std::size_t by = kTuned; by < kTimePredictors; ++by) {
    const PredictorFigures f = figures_of(times, by, counted_plate);
    stated.rows.push_back({kTimeNames[by], fixed(f.error, 3), fixed(f.stated, 3), within_text(f)});
  }
  out.text += markdown(table) + "\n" + markdown(stated);
  Table data{{"part", "tool", "measured", "path", "motion", "calibrated", "tuned", "low", "high"}, {}};
  for (const LeftOutCase& l : times) {
    const PlatePrediction& tuned = l.by[kTunedAlike];
    data.rows.push_back({l.c->from.part, std::to_string(plate_tool_of(*l.c)), fixed(std::exp(l.observed), 3),
                         fixed(std::exp(l.by[kByPath].value), 3), fixed(std::exp(l.by[kByMotion].value), 3),
                         fixed(std::exp(l.by[kByCalibrated].value), 3), fixed(std::exp(tuned.value), 3),
                         fixed(std::exp(tuned.value - tuned.half_90), 3),
                         fixed(std::exp(tuned.value + tuned.half_90), 3)});
  }
  out.data.emplace_back("plates_times.dat", columns(data));
}

bool of_4_mm(const LeftOutCase& l) { return l.c->asked.diameter_mm > 3.5; }

void tell_bores(const std::vector<LeftOutCase>& bores, Comparison& out) {
  Table table{
      {"deviation of a bore from what is programmed, mm", "n", "measured, mean", "static bending, mean",
       "static bending, rms error", "tuned, rms error", "stated, rms", "within the interval of 90 %"},
      {}};
  Table each{{"part", "bores", "stick-out, mm", "feed per turn, mm", "measured, mm",
              "static bending says, mm", "left out, mm", "interval of 90 %, mm", "within"},
             {}};
  Table data{{"part", "measured", "predicted", "low", "high", "bending"}, {}};
  const auto add = [&](const std::string& name, const Wanted& of) {
    const PredictorFigures bending = figures_of(bores, kByBending, of),
                           tuned = figures_of(bores, kTunedBores, of);
    table.rows.push_back({name, std::to_string(tuned.n), signed_mm(tuned.observed), signed_mm(bending.value),
                          fixed(bending.error, 3), fixed(tuned.error, 3), fixed(tuned.stated, 3),
                          within_text(tuned)});
  };
  std::set<std::string> steps;
  for (const LeftOutCase& l : bores) steps.insert(l.c->from.workingstep);
  for (const std::string& step : steps) {
    std::set<double> stick_outs;
    for (const LeftOutCase& l : bores) stick_outs.insert(l.c->asked.stick_out_mm);
    add(step, [&](const LeftOutCase& l) { return l.c->from.workingstep == step; });
    for (const double stick_out : stick_outs) {
      add("of them by a stick-out of " + fixed(stick_out, 1) + " mm", [&](const LeftOutCase& l) {
        return l.c->from.workingstep == step && l.c->asked.stick_out_mm == stick_out;
      });
    }
  }
  std::vector<LeftOutCase> sorted = bores;
  std::stable_sort(sorted.begin(), sorted.end(), [](const LeftOutCase& a, const LeftOutCase& b) {
    const auto key = [](const LeftOutCase& l) { return std::pair(l.c->from.part.size(), l.c->from.part); };
    return a.c->from.workingstep != b.c->from.workingstep ? a.c->from.workingstep > b.c->from.workingstep
                                                          : key(a) < key(b);
  });
  for (const LeftOutCase& l : sorted) {
    const PlatePrediction& tuned = l.by[kTunedBores];
    const double bending = l.by[kByBending].value, low = tuned.value - tuned.half_90,
                 high = tuned.value + tuned.half_90;
    each.rows.push_back({l.c->from.part, l.c->from.workingstep, fixed(l.c->asked.stick_out_mm, 1),
                         fixed(l.c->bound.fz_mm * l.c->asked.teeth, 3), signed_mm(l.observed),
                         signed_mm(bending), signed_mm(tuned.value),
                         signed_mm(low) + " to " + signed_mm(high), l.within(kTunedBores) ? "yes" : "no"});
    if (of_4_mm(l)) {
      data.rows.push_back({l.c->from.part, fixed(l.observed, 4), fixed(tuned.value, 4), fixed(low, 4),
                           fixed(high, 4), fixed(bending, 4)});
    }
  }
  out.text += "\n" + markdown(table) + "\n<details><summary>bores of every plate</summary>\n\n" +
              markdown(each) + "\n</details>\n";
  out.data.emplace_back("plates_bores.dat", columns(data));
}

/// The times of the traces against those that the test bed counted in the same runs, tool by tool. The
/// engraver is left out: its row of the table holds a later run of another program, too (section 1).
Result<std::string> counted_against_table(const std::vector<Case>& cases, const std::string& folder,
                                          Job& job) {
  const auto table = read_file(folder + "/times_per_tool.csv");
  if (!table) return tl::unexpected(table.error());
  const auto timed = retain::read_times(*table, "times_per_tool.csv", job);
  if (!timed) return tl::unexpected(timed.error());
  constexpr double kAsked = 0.02;
  std::size_t n = 0, within = 0;
  double worst = 0.0;
  for (const Case& c : cases) {
    if (!kTraced.contains(c.from.part) || c.from.workingstep == "ENGRAVING" || !c.observed.time_s) continue;
    for (const retain::Timed& t : *timed) {
      if (t.part != c.from.part || t.tool != plate_tool_of(c)) continue;
      const double off = std::abs(c.observed.time_s->value / t.moving_s - 1.0);
      worst = std::max(worst, off);
      within += off <= kAsked ? 1 : 0;
      ++n;
    }
  }
  return std::to_string(within) + " of " + std::to_string(n) +
         " times of tools that were read off the traces lie within 2 % of the test bed's own count "
         "(`times_per_tool.csv`), the worst " +
         fixed(100.0 * worst, 2) + " % off.\n\n";
}

}  // namespace

Comparison plates(const std::string& corpus) {
  Comparison out{.name = "plates"};
  if (corpus.empty()) {
    out.skipped = "the corpus is absent";
    return out;
  }
  Job job;
  const auto cases = import_plates(corpus + "/measured/nist_plate", job);
  if (!cases) {
    out.skipped = cases.error().message;
    return out;
  }
  std::set<std::string> parts;
  for (const Case& c : *cases) parts.insert(c.from.part);
  out.text = std::to_string(cases->size()) + " cases of " + std::to_string(parts.size()) + " plates.\n\n";
  if (const auto counted = counted_against_table(*cases, corpus + "/measured/nist_plate", job))
    out.text += *counted;
  const auto plate = nist::read_plate(corpus + "/measured/nist_plate",
                                      testing::source_dir() + "/tests/validation/nist_plate.yaml");
  const auto models = plate ? models_without(*plate) : tl::unexpected(plate.error());
  if (!models) {
    out.skipped = models.error().message;
    return out;
  }
  const std::vector<Case> with_time = timed(*cases);
  const auto times = times_left_out(with_time, *models), bores = bores_left_out(*cases, *models);
  tell_times(times, out);
  tell_bores(bores, out);
  const auto time = [&](std::size_t by) { return figures_of(times, by, counted_plate); };
  const PredictorFigures tuned = time(kTunedAlike), bore = figures_of(bores, kTunedBores, of_4_mm);
  out.headline = "a plate left out: rms of ln(time of a tool) " + fixed(time(kByMotion).error, 2) +
                 " by the motion model, " + fixed(time(kTuned).error, 2) + " tuned by all tools, " +
                 fixed(tuned.error, 3) + " by tools alike (" + within_text(tuned) +
                 " within the interval of 90 %), " + fixed(time(kByCalibrated).error, 3) +
                 " by the calibrated model; 4 mm bores " + fixed(bore.error, 3) + " mm (" +
                 within_text(bore) + "), by static bending " +
                 fixed(figures_of(bores, kByBending, of_4_mm).error, 3) + " mm with the wrong sign";
  return out;
}

}  // namespace capstan::validation
