#include <algorithm>
#include <cmath>
#include <fstream>
#include <functional>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "casebase/retain/join/import.h"
#include "casebase/tune/corrections.h"
#include "casebase/tune/regression.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tests/validation/studies.h"

// The plates of the NIST test bed as cases, imported as `capstan cases import` does, and each plate predicted
// from the others: ln(time of a tool) by ln(path / feed), and the deviation of its bores by feed per turn
// times the slenderness cubed (the flexibility of a cantilever, Timoshenko, Strength of Materials, part I),
// each by `tune::regress` with a constant of the tool.

namespace capstan::validation {
namespace {

using casebase::Case;
namespace retain = casebase::retain;
namespace tune = casebase::tune;

const std::set<std::string> kTraced = {"2", "5", "9", "12", "16", "18"};
const std::set<std::string> kInterrupted = {"1", "10", "11", "19"};
constexpr const char* kDoubtful = "7";  // its feeds are not known (section 1)
constexpr double kSlender = 10.0;       // stick-out over diameter that the term is 1 at, times mm per turn

/// One prediction without the plate.
struct Left {
  const Case* c = nullptr;
  double observed = 0.0, untuned = 0.0, predicted = 0.0, std_dev = 0.0;
  double half_90 = 0.0;  ///< of the interval of 90 %
  [[nodiscard]] bool within() const { return std::abs(observed - predicted) <= half_90; }
};

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

/// Each case of `of` predicted from those of the same workingstep of other plates.
std::vector<Left> leave_plates_out(const std::vector<Case>& cases,
                                   const std::function<bool(const Case&)>& usable,
                                   const std::function<Left(const Case&)>& observed,
                                   const std::function<std::vector<double>(const Case&)>& terms,
                                   const std::function<std::size_t(const Case&)>& kind,
                                   const tune::RegressionOptions& options) {
  std::map<std::string, std::vector<const Case*>> steps;
  for (const Case& c : cases) {
    if (usable(c)) steps[c.from.workingstep].push_back(&c);
  }
  std::vector<Left> out;
  for (const auto& [step, of] : steps) {
    std::vector<tune::Row> rows;
    std::map<std::string, std::size_t> plates;
    for (const Case* c : of)
      rows.push_back({terms(*c), observed(*c).observed, 1.0,
                      plates.emplace(c->from.part, plates.size()).first->second, kind(*c)});
    const auto left = tune::leave_groups_out(rows, rows.front().x.size(), options);
    for (std::size_t i = 0; i < of.size(); ++i) {
      Left l = observed(*of[i]);
      l.c = of[i];
      l.predicted = left[i].predicted;
      l.std_dev = left[i].std_dev;
      l.half_90 = tune::deviations_90(left[i].freedom) * l.std_dev;
      out.push_back(l);
    }
  }
  return out;
}

struct Figures {
  std::size_t n = 0, within = 0;
  double untuned = 0.0, predicted = 0.0, stated = 0.0;  // rms
};
Figures figures_of(const std::vector<Left>& all, const std::function<bool(const Left&)>& of) {
  Figures f;
  for (const Left& l : all) {
    if (!of(l)) continue;
    ++f.n;
    f.within += l.within() ? 1 : 0;
    f.untuned += (l.observed - l.untuned) * (l.observed - l.untuned);
    f.predicted += (l.observed - l.predicted) * (l.observed - l.predicted);
    f.stated += l.std_dev * l.std_dev;
  }
  const double n = f.n > 0 ? static_cast<double>(f.n) : 1.0;
  f.untuned = std::sqrt(f.untuned / n);
  f.predicted = std::sqrt(f.predicted / n);
  f.stated = std::sqrt(f.stated / n);
  return f;
}

std::vector<std::string> row_of(const std::string& name, const Figures& f) {
  return {name,
          std::to_string(f.n),
          fixed(f.untuned, 3),
          fixed(f.predicted, 3),
          fixed(f.stated, 3),
          std::to_string(f.within) + " of " + std::to_string(f.n)};
}

std::vector<std::string> head_of(const std::string& first, const std::string& unit) {
  return {first,
          "n",
          "untuned, rms" + unit,
          "plate left out, rms" + unit,
          "stated, rms" + unit,
          "within the interval of 90 %"};
}

bool has_trace(const Left& l) { return kTraced.contains(l.c->from.part); }
bool counted_plate(const Left& l) {
  return !kInterrupted.contains(l.c->from.part) && l.c->from.part != kDoubtful;
}

std::vector<Left> times_of(const std::vector<Case>& cases) {
  return leave_plates_out(
      cases,
      [](const Case& c) {
        // The engraver's time in the table holds a later run of another program (section 1).
        return c.observed.time_s && c.predicted.time_s > 0.0 &&
               (c.from.workingstep != "ENGRAVING" || kTraced.contains(c.from.part));
      },
      [](const Case& c) {
        return Left{.observed = std::log(c.observed.time_s->value), .untuned = std::log(c.predicted.time_s)};
      },
      [](const Case& c) {
        return std::vector<double>{1.0, std::log(c.predicted.time_s)};
      },
      [](const Case&) { return std::size_t{0}; },
      // Nothing is held of the constant; time goes at most with path over feed, and not at all where a tool
      // never reaches its feed. Noise: as `tune::correct_time`, of its expectation alone.
      {.prior = {{}, {0.5, 0.5}}, .noise = 0.05, .between = 0.025});
}

std::vector<Left> bores_of(const std::vector<Case>& cases) {
  return leave_plates_out(
      cases, [](const Case& c) { return c.observed.size_deviation_mm.has_value(); },
      [](const Case& c) {
        return Left{.observed = c.observed.size_deviation_mm->value, .untuned = c.predicted.deflection_mm};
      },
      [](const Case& c) {
        const double slender = c.asked.stick_out_mm / c.asked.cutter_diameter_mm / kSlender;
        return std::vector<double>{1.0, c.bound.fz_mm * c.asked.teeth * slender * slender * slender};
      },
      [](const Case& c) { return tune::slenderness_of(c.asked.stick_out_mm / c.asked.cutter_diameter_mm); },
      {.noise = 0.02, .between = 0.01});
}

void tell_times(const std::vector<Left>& times, Comparison& out) {
  Table table{head_of("ln(time of a tool)", ""), {}};
  const auto add = [&](const std::string& name, const std::function<bool(const Left&)>& of) {
    table.rows.push_back(row_of(name, figures_of(times, of)));
  };
  add("all", [](const Left&) { return true; });
  add("plates not interrupted, feeds known", counted_plate);
  add("of them with a trace", [](const Left& l) { return counted_plate(l) && has_trace(l); });
  std::set<std::string> steps;
  for (const Left& l : times) steps.insert(l.c->from.workingstep);
  for (const std::string& step : steps) {
    add("of them " + step, [&](const Left& l) { return counted_plate(l) && l.c->from.workingstep == step; });
  }
  out.text += markdown(table);
  Table data{{"part", "untuned", "predicted", "low", "high", "measured"}, {}};
  for (const Left& l : times) {
    data.rows.push_back({l.c->from.part, fixed(std::exp(l.untuned), 3), fixed(std::exp(l.predicted), 3),
                         fixed(std::exp(l.predicted - l.half_90), 3),
                         fixed(std::exp(l.predicted + l.half_90), 3), fixed(std::exp(l.observed), 3)});
  }
  out.data.emplace_back("plates_times.dat", columns(data));
}

void tell_bores(const std::vector<Left>& bores, Comparison& out) {
  Table table{head_of("deviation of a bore", ", mm"), {}};
  Table each{{"part", "bores", "stick-out, mm", "feed per turn, mm", "measured, mm", "left out, mm",
              "interval of 90 %, mm", "within"},
             {}};
  Table data{{"part", "measured", "predicted", "low", "high"}, {}};
  std::set<std::string> steps;
  for (const Left& l : bores) steps.insert(l.c->from.workingstep);
  for (const std::string& step : steps)
    table.rows.push_back(
        row_of(step, figures_of(bores, [&](const Left& l) { return l.c->from.workingstep == step; })));
  std::vector<Left> sorted = bores;
  std::stable_sort(sorted.begin(), sorted.end(), [](const Left& a, const Left& b) {
    const auto key = [](const Left& l) { return std::pair(l.c->from.part.size(), l.c->from.part); };
    return a.c->from.workingstep != b.c->from.workingstep ? a.c->from.workingstep > b.c->from.workingstep
                                                          : key(a) < key(b);
  });
  for (const Left& l : sorted) {
    const double low = l.predicted - l.half_90, high = l.predicted + l.half_90;
    each.rows.push_back({l.c->from.part, l.c->from.workingstep, fixed(l.c->asked.stick_out_mm, 1),
                         fixed(l.c->bound.fz_mm * l.c->asked.teeth, 3), fixed(l.observed, 3),
                         fixed(l.predicted, 3), fixed(low, 3) + " to " + fixed(high, 3),
                         l.within() ? "yes" : "no"});
    if (l.c->asked.diameter_mm > 3.5) {
      data.rows.push_back(
          {l.c->from.part, fixed(l.observed, 4), fixed(l.predicted, 4), fixed(low, 4), fixed(high, 4)});
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
  const std::map<std::string, int> tools = {{"FACE", 15},   {"SPOT", 7},       {"PROFILE", 3},
                                            {"POCKETS", 4}, {"BORES 4 mm", 5}, {"BORES 3 mm", 1}};
  constexpr double kAsked = 0.02;
  std::size_t n = 0, within = 0;
  double worst = 0.0;
  for (const Case& c : cases) {
    const auto tool = tools.find(c.from.workingstep);
    if (!kTraced.contains(c.from.part) || tool == tools.end() || !c.observed.time_s) continue;
    for (const retain::Timed& t : *timed) {
      if (t.part != c.from.part || t.tool != tool->second) continue;
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
  const auto times = times_of(*cases), bores = bores_of(*cases);
  tell_times(times, out);
  tell_bores(bores, out);
  const Figures t = figures_of(times, counted_plate),
                b = figures_of(bores, [](const Left&l) { return l.c->asked.diameter_mm > 3.5; });
  out.headline = "a plate left out: rms of ln(time of a tool) " + fixed(t.predicted, 3) + " (untuned " +
                 fixed(t.untuned, 2) + "), " + std::to_string(t.within) + " of " + std::to_string(t.n) +
                 " within the interval of 90 %; 4 mm bores " + fixed(b.predicted, 3) + " mm (untuned " +
                 fixed(b.untuned, 3) + "), " + std::to_string(b.within) + " of " + std::to_string(b.n);
  return out;
}

}  // namespace capstan::validation
