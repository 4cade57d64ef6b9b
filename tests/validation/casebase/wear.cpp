#include <cmath>
#include <map>
#include <utility>
#include <vector>

#include "casebase/record/failing.h"
#include "casebase/tune/corrections.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

constexpr double kWorn_mm = casebase::kWornMm;
constexpr double kFeed0_mm = 0.5;   // the feed and
constexpr double kDepth0_mm = 1.5;  // depth that the law is centred on
constexpr std::size_t kTerms = 4;   // life, feed, depth, steel

struct Case {
  int number = 0;
  double depth_mm = 0.0, feed_mm = 0.0;
  double life_min = 0.0;     ///< by the curve; 0: never worn
  double between_min = 0.0;  ///< between the two readings around the limit
  bool steel = false;
};

namespace tune = casebase::tune;

std::vector<double> terms(const Case& c) {
  return {1.0, std::log(c.feed_mm / kFeed0_mm), std::log(c.depth_mm / kDepth0_mm), c.steel ? 1.0 : 0.0};
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> out(1);
  for (const char c : line) {
    if (c == ',') {
      out.emplace_back();
    } else if (c != '\r') {
      out.back() += c;
    }
  }
  return out;
}

// The life of each edge: read off the curve through its wear, and, to compare, between the two readings
// around the limit.
std::vector<Case> read_cases(const std::string& text) {
  std::map<int, Case> cases;
  std::map<int, std::vector<tune::WearReading>> readings;
  std::string line;
  for (const char ch : text + "\n") {
    if (ch != '\n') {
      line += ch;
      continue;
    }
    const auto c = cells_of(std::exchange(line, {}));
    const auto number = c.size() < 8 ? std::nullopt : parse_double(c[0]);
    if (!number) continue;
    Case& k = cases[static_cast<int>(*number)];
    k.number = static_cast<int>(*number);
    k.depth_mm = parse_double(c[4]).value_or(0.0);
    k.feed_mm = parse_double(c[5]).value_or(0.0);
    k.steel = c[7] == "steel";
    const auto worn = parse_double(c[2]);
    if (!worn) continue;
    const tune::WearReading now{parse_double(c[3]).value_or(0.0), *worn};
    auto& of_case = readings[k.number];
    if (now.wear_mm >= kWorn_mm && k.between_min == 0.0) {
      const tune::WearReading last = of_case.empty() ? tune::WearReading{} : of_case.back();
      k.between_min = last.time_min + (kWorn_mm - last.wear_mm) / (now.wear_mm - last.wear_mm) *
                                          (now.time_min - last.time_min);
    }
    of_case.push_back(now);
  }
  std::vector<Case> out;
  for (auto& [number, c] : cases) {
    c.life_min = tune::life_of(readings[number], kWorn_mm).value_or(0.0);
    if (c.life_min > 0.0) out.push_back(c);
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
  const auto text = read_file(corpus + "/measured/nasa_milling/process_info.csv");
  if (!text) {
    out.skipped = text.error().message;
    return out;
  }
  const std::vector<Case> cases = read_cases(*text);
  std::vector<tune::Row> observed;
  for (const Case& c : cases)
    observed.push_back({terms(c), std::log(c.life_min), 1.0, static_cast<std::size_t>(c.number)});
  // Three of four numbers are free: the noise is what the rows say, nothing is expected beforehand.
  const tune::RegressionOptions options{.noise = 0.2, .noise_rows = 0.0};
  const tune::Regression law_of_all = tune::regress(observed, kTerms, options);
  const std::vector<double>& b = law_of_all.coefficient;
  const std::vector<tune::LeftOut> left_out = tune::leave_groups_out(observed, kTerms, options);
  double square = 0.0;
  std::vector<double> ahead, ahead_of_readings;
  Table rows{{"case", "material", "depth, mm", "feed, mm", "measured, min", "fitted, min", "left out, min",
              "error when left out", "stated std dev of ln T"},
             {}};
  Table data{{"measured", "fitted", "left_out", "steel"}, {}};
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Case& c = cases[i];
    const double fitted = std::exp(law_of_all.at(observed[i].x));
    const double predicted = std::exp(left_out[i].predicted);
    square += std::pow(std::log(fitted / c.life_min), 2.0);
    ahead.push_back(std::log(predicted / c.life_min));
    if (c.between_min > 0.0) ahead_of_readings.push_back(std::log(predicted / c.between_min));
    rows.rows.push_back({std::to_string(c.number), c.steel ? "steel" : "cast iron", shortest(c.depth_mm),
                         shortest(c.feed_mm), fixed(c.life_min, 1), fixed(fitted, 1), fixed(predicted, 1),
                         percent(predicted / c.life_min - 1.0, 0), fixed(left_out[i].std_dev, 2)});
    data.rows.push_back({fixed(c.life_min, 3), fixed(fitted, 3), fixed(predicted, 3), c.steel ? "1" : "0"});
  }
  const Spread s = spread_of(ahead, std::log(1.5));
  const Table law{{"figure", "fitted here"},
                  {{"life at 0.5 mm feed and 1.5 mm depth, cast iron", fixed(std::exp(b[0]), 1) + " min"},
                   {"exponent of the feed", fixed(b[1], 2)},
                   {"exponent of the depth", fixed(b[2], 2)},
                   {"steel against cast iron", "× " + fixed(std::exp(b[3]), 2)},
                   {"rms of ln(fitted/measured), " + std::to_string(cases.size()) + " cases",
                    fixed(std::sqrt(square / static_cast<double>(cases.size())), 2)},
                   {"rms of ln(predicted/measured), each case left out in turn", fixed(s.rms, 3)},
                   {"the same against lives between the two readings around the limit",
                    fixed(spread_of(ahead_of_readings, std::log(1.5)).rms, 3)},
                   {"within the stated interval of 90 %, when left out",
                    fixed(100.0 * tune::coverage_90(left_out), 0) + " %"},
                   {"predicted within a factor of 1.5 when left out",
                    std::to_string(s.within) + " of " + std::to_string(s.n)}}};
  out.headline = "rms of ln(predicted/measured) " + fixed(s.rms, 2) + ", each case left out in turn; " +
                 std::to_string(s.within) + " of " + std::to_string(s.n) + " within a factor of 1.5";
  out.text = markdown(law) + "\n" + markdown(rows);
  out.data.emplace_back("wear.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
