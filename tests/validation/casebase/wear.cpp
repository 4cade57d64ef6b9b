#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "casebase/record/failing.h"
#include "casebase/retain/join/import.h"
#include "casebase/tune/corrections.h"
#include "casebase/tune/from_case.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/support/corpus.h"
#include "tests/validation/studies.h"

// NASA's table of wear as cases, imported as `capstan cases import BASE wear` does, and the life of each edge
// predicted from those of the others by the correction that `capstan cases tune` makes.

namespace capstan::validation {
namespace {

using casebase::Case;
namespace retain = casebase::retain;
namespace tune = casebase::tune;

constexpr double kFeed0_mm = 0.5;   // per turn: the feed and
constexpr double kDepth0_mm = 1.5;  // depth that the law is centred on
// What a maker's catalogue would say of the speed that was cut with (default, unsourced). Its spread is
// `tune::kLifeSpread`; half and twice of it are told beside.
constexpr double kCatalogueLifeMin = 15.0;
constexpr double kTaylorN = 0.25;  // not seen: one speed. Kalpakjian & Schmid: 0.2 to 0.5 of carbide

enum class Read { kByCurve, kBetweenReadings };

/// Between the two readings around the limit: what counted as the life before a curve was put through all.
double between_min(const std::vector<tune::WearReading>& readings) {
  tune::WearReading last;
  for (const tune::WearReading& now : readings) {
    if (now.wear_mm >= casebase::kWornMm)
      return last.time_min + (casebase::kWornMm - last.wear_mm) / (now.wear_mm - last.wear_mm) *
                                 (now.time_min - last.time_min);
    last = now;
  }
  return 0.0;
}

double life_min(const Case& c, Read how) {
  const auto readings = tune::readings_of(c.observed.wear_series_mm);
  return how == Read::kByCurve ? tune::life_of(readings, casebase::kWornMm).value_or(0.0)
                               : between_min(readings);
}

bool is_steel(const Case& c) { return c.asked.material_group.starts_with("P/"); }
double feed_mm(const Case& c) { return c.bound.fz_mm * c.asked.teeth; }

/// The cases whose life is known, in the order of the table.
Result<std::vector<Case>> import_wear(const std::string& corpus, Job& job) {
  const auto sheet = read_file(testing::source_dir() + "/tests/validation/casebase/wear_sheet.csv");
  if (!sheet) return tl::unexpected(sheet.error());
  const auto steps = retain::read_sheet(*sheet, "wear_sheet.csv");
  if (!steps) return tl::unexpected(steps.error());
  std::ifstream in(corpus + "/measured/nasa_milling/process_info.csv", std::ios::binary);
  auto cases =
      retain::import_log(in, retain::LogFormat::kWear, *steps, {.file = "process_info.csv"}, {}, job);
  if (cases) std::erase_if(*cases, [](const Case& c) { return life_min(c, Read::kByCurve) <= 0.0; });
  return cases;
}

/// One edge, and its life as all edges say and as the others do.
struct Edge {
  const Case* c = nullptr;
  double fitted_min = 0.0;
  tune::LeftOut left_out;
};
struct Study {
  std::vector<Edge> edges;                 ///< in the order of the cases
  std::vector<tune::LifeCorrection> laws;  ///< of cast iron, of steel
  [[nodiscard]] double rms_of_fit() const {
    double square = 0.0;
    for (const Edge& e : edges) square += std::pow(std::log(e.fitted_min) - e.left_out.observed, 2.0);
    return std::sqrt(square / static_cast<double>(edges.size()));
  }
  /// rms of ln(predicted / measured) against lives that are read so.
  [[nodiscard]] double rms(Read how) const {
    std::vector<double> off;
    for (const Edge& e : edges) off.push_back(e.left_out.predicted - std::log(life_min(*e.c, how)));
    return spread_of(off, 0.0).rms;
  }
  [[nodiscard]] double within_90() const {
    const auto n =
        std::count_if(edges.begin(), edges.end(), [](const Edge& e) { return e.left_out.within_90(); });
    return static_cast<double>(n) / static_cast<double>(edges.size());
  }
};

/// Each material corrected by its own cases, `shared`: with those of the other for the exponents.
Study study(const std::vector<Case>& cases, Read how, bool shared, double catalogue_min = kCatalogueLifeMin) {
  Study out;
  out.edges.resize(cases.size());
  for (const bool steel : {false, true}) {
    const int teeth = cases.front().asked.teeth;
    const model::ToolLifeLaw catalogue{.substrate = "carbide",
                                       .v0_m_min = cases.front().bound.vc_m_min,
                                       .life_min = catalogue_min,
                                       .h0_mm = kFeed0_mm / teeth,
                                       .a0_mm = kDepth0_mm,
                                       .n = kTaylorN,
                                       .source = {}};
    std::vector<tune::LifeSample> samples;
    std::vector<std::size_t> own;
    for (std::size_t i = 0; i < cases.size(); ++i) {
      const Case& c = cases[i];
      if (is_steel(c) == steel) own.push_back(i);
      if (is_steel(c) == steel || shared)
        samples.push_back({c.bound.vc_m_min, c.bound.fz_mm, c.bound.ap_mm, life_min(c, how), i,
                           is_steel(c) == steel ? 0U : 1U});
    }
    auto law = tune::correct_life(samples, catalogue);
    for (std::size_t k = 0; k < own.size(); ++k) {
      const Case& c = cases[own[k]];
      std::vector<double> x(law->how.fit.coefficient.size(), 0.0);
      x[0] = 1.0;
      x[2] = std::log(feed_mm(c) / kFeed0_mm);
      x[3] = std::log(c.bound.ap_mm / kDepth0_mm);
      out.edges[own[k]] = {&c, std::exp(law->how.fit.at(x)), law->how.left_out->each[k]};
    }
    out.laws.push_back(*std::move(law));
  }
  return out;
}

}  // namespace

Comparison wear(const std::string& corpus) {
  Comparison out{.name = "wear"};
  if (corpus.empty()) {
    out.skipped = "the corpus is absent";
    return out;
  }
  Job job;
  const auto read = import_wear(corpus, job);
  if (!read) {
    out.skipped = read.error().message;
    return out;
  }
  const std::vector<Case>& cases = *read;
  const Study shared = study(cases, Read::kByCurve, true), alone = study(cases, Read::kByCurve, false);
  const Study shared_between = study(cases, Read::kBetweenReadings, true),
              alone_between = study(cases, Read::kBetweenReadings, false);

  std::vector<double> ahead;
  Table rows{{"case", "material", "depth, mm", "feed, mm", "measured, min", "fitted, min", "left out, min",
              "error when left out", "stated std dev of ln T"},
             {}};
  Table data{{"measured", "fitted", "left_out", "steel"}, {}};
  for (const Edge& e : shared.edges) {
    const double life = life_min(*e.c, Read::kByCurve), predicted = std::exp(e.left_out.predicted);
    ahead.push_back(std::log(predicted / life));
    rows.rows.push_back({e.c->from.part, is_steel(*e.c) ? "steel" : "cast iron", shortest(e.c->bound.ap_mm),
                         trimmed(feed_mm(*e.c), 3), fixed(life, 1), fixed(e.fitted_min, 1),
                         fixed(predicted, 1), percent(predicted / life - 1.0, 0),
                         fixed(e.left_out.std_dev, 2)});
    data.rows.push_back(
        {fixed(life, 3), fixed(e.fitted_min, 3), fixed(predicted, 3), is_steel(*e.c) ? "1" : "0"});
  }
  const Spread s = spread_of(ahead, std::log(1.5));
  const std::vector<double>&iron = shared.laws[0].how.fit.coefficient,
        &steel = shared.laws[1].how.fit.coefficient;
  const Table law{{"figure", "cast iron", "steel"},
                  {{"life at 0.5 mm feed and 1.5 mm depth, min", fixed(std::exp(iron[0]), 1),
                    fixed(std::exp(steel[0]), 1)},
                   {"exponent of the feed", fixed(iron[2], 2), fixed(steel[2], 2)},
                   {"exponent of the depth", fixed(iron[3], 2), fixed(steel[3], 2)}}};
  // How the life is read off: for the fit, and for what it is held against.
  const auto figures = [](const char* what, const Study& by_curve, const Study& between) {
    return std::vector<std::string>{what,
                                    fixed(by_curve.rms_of_fit(), 3),
                                    fixed(by_curve.rms(Read::kByCurve), 3),
                                    fixed(by_curve.rms(Read::kBetweenReadings), 3),
                                    fixed(between.rms(Read::kBetweenReadings), 3),
                                    fixed(100.0 * by_curve.within_90(), 0) + " %"};
  };
  Table kinds{{"rms of ln(predicted/measured)", "fitted to all", "left out in turn: lives by the curve",
               "fitted by the curve, held against lives between two readings", "both between two readings",
               "within the stated 90 %"},
              {figures("materials share the exponents", shared, shared_between),
               figures("each material alone", alone, alone_between)}};
  for (const double factor : {0.5, 2.0}) {
    const double life = factor * kCatalogueLifeMin;
    kinds.rows.push_back(figures(("shared, a catalogue's life of " + shortest(life) + " min").c_str(),
                                 study(cases, Read::kByCurve, true, life),
                                 study(cases, Read::kBetweenReadings, true, life)));
  }
  out.headline = "rms of ln(predicted/measured) " + fixed(s.rms, 3) + ", each case left out in turn (" +
                 fixed(shared_between.rms(Read::kBetweenReadings), 3) +
                 " of lives between two readings; each material alone " +
                 fixed(alone.rms(Read::kByCurve), 3) + "); " + std::to_string(s.within) + " of " +
                 std::to_string(s.n) + " within a factor of 1.5";
  out.text = markdown(law) + "\n" + markdown(kinds) + "\n" + markdown(rows);
  out.data.emplace_back("wear.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
