#include <array>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

constexpr double kWorn_mm = 0.3;    // flank wear at which an edge is worn out
constexpr double kFeed0_mm = 0.5;   // the feed and
constexpr double kDepth0_mm = 1.5;  // depth that the law is centred on
constexpr std::size_t kTerms = 4;   // life, feed, depth, steel

struct Case {
  int number = 0;
  double depth_mm = 0.0, feed_mm = 0.0, life_min = 0.0;  ///< life 0: never worn
  bool steel = false;
};

using Coefficients = std::array<double, kTerms>;

Coefficients terms(const Case& c) {
  return {1.0, std::log(c.feed_mm / kFeed0_mm), std::log(c.depth_mm / kDepth0_mm), c.steel ? 1.0 : 0.0};
}

double log_life(const Coefficients& b, const Case& c) {
  const Coefficients x = terms(c);
  double out = 0.0;
  for (std::size_t i = 0; i < kTerms; ++i) out += b[i] * x[i];
  return out;
}

// Least squares of ln T by the normal equations, without the case `left_out` (-1: with all).
Coefficients fit(const std::vector<Case>& cases, int left_out) {
  std::array<std::array<double, kTerms + 1>, kTerms> m{};
  for (const Case& c : cases) {
    if (c.number == left_out) continue;
    const Coefficients x = terms(c);
    for (std::size_t i = 0; i < kTerms; ++i) {
      for (std::size_t j = 0; j < kTerms; ++j) m[i][j] += x[i] * x[j];
      m[i][kTerms] += x[i] * std::log(c.life_min);
    }
  }
  for (std::size_t i = 0; i < kTerms; ++i) {  // positive definite: no pivoting needed
    for (std::size_t k = 0; k < kTerms; ++k) {
      if (k == i) continue;
      const double f = m[k][i] / m[i][i];
      for (std::size_t j = i; j <= kTerms; ++j) m[k][j] -= f * m[i][j];
    }
  }
  Coefficients out{};
  for (std::size_t i = 0; i < kTerms; ++i) out[i] = m[i][kTerms] / m[i][i];
  return out;
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

// The time at which the wear crosses its limit, between the measurements around it.
std::vector<Case> read_cases(const std::string& text) {
  std::map<int, Case> cases;
  std::map<int, std::pair<double, double>> before;  // time, wear
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
    const double at = parse_double(c[3]).value_or(0.0);
    if (!worn || k.life_min > 0.0) continue;
    auto& [t, v] = before[k.number];
    if (*worn >= kWorn_mm) k.life_min = t + (kWorn_mm - v) / (*worn - v) * (at - t);
    t = at;
    v = *worn;
  }
  std::vector<Case> out;
  for (const auto& [number, c] : cases) {
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
  const Coefficients b = fit(cases, -1);
  double square = 0.0;
  std::vector<double> ahead;
  Table rows{{"case", "material", "depth, mm", "feed, mm", "measured, min", "fitted, min", "left out, min",
              "error when left out"},
             {}};
  Table data{{"measured", "fitted", "left_out", "steel"}, {}};
  for (const Case& c : cases) {
    const double fitted = std::exp(log_life(b, c));
    const double predicted = std::exp(log_life(fit(cases, c.number), c));
    square += std::pow(std::log(fitted / c.life_min), 2.0);
    ahead.push_back(std::log(predicted / c.life_min));
    rows.rows.push_back({std::to_string(c.number), c.steel ? "steel" : "cast iron", shortest(c.depth_mm),
                         shortest(c.feed_mm), fixed(c.life_min, 1), fixed(fitted, 1), fixed(predicted, 1),
                         percent(predicted / c.life_min - 1.0, 0)});
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
                   {"rms of ln(predicted/measured), each case left out in turn", fixed(s.rms, 2)},
                   {"predicted within a factor of 1.5 when left out",
                    std::to_string(s.within) + " of " + std::to_string(s.n)}}};
  out.headline = "rms of ln(predicted/measured) " + fixed(s.rms, 2) + ", each case left out in turn; " +
                 std::to_string(s.within) + " of " + std::to_string(s.n) + " within a factor of 1.5";
  out.text = markdown(law) + "\n" + markdown(rows);
  out.data.emplace_back("wear.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
