#include "planner/pipeline/paths/sections.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <tuple>

#include "planner/base/number.h"

namespace capstan::pipeline {
namespace {

using optimise::CutSample;

constexpr double kWhole = 0.95;  // share of depth times width from which a section is a rectangle

void add(CutSample s, std::vector<CutSample>& out) {
  const double ap = s.ap_mm, ae = s.ae_mm;
  const bool whole = s.plunge || !(ap > 0.0 && ae > 0.0) || s.csa_mm2 >= kWhole * ap * ae;
  // On an arc about a corner the edge goes farther than the centre, and removes more than depth times width.
  const double swept = ap > 0.0 ? s.csa_mm2 / ap : ae;
  if (!s.plunge) s.ae_mm = whole ? std::max(ae, swept) : swept;
  out.push_back(s);
  if (whole) return;
  s.ap_mm = s.csa_mm2 / ae;
  s.ae_mm = ae;
  out.push_back(s);
}

bool straight_along_axis(const model::CutterPath& p, std::size_t i) {
  return i > 0 && i < p.size() && p.kind[i] == model::MoveKind::kLine && p.x[i] == p.x[i - 1] &&
         p.y[i] == p.y[i - 1];
}

auto place(const CutSample& s) { return std::pair(s.move, s.at_mm); }

/// The largest area that a series has between two places of a move.
double most_near(const std::vector<CutSample>& s, std::uint32_t move, double from_mm, double to_mm) {
  double out = 0.0;
  const auto first = std::lower_bound(s.begin(), s.end(), move,
                                      [](const CutSample& a, std::uint32_t m) { return a.move < m; });
  for (auto it = first; it != s.end() && it->move == move; ++it) {
    if (it->at_mm >= from_mm && it->at_mm - it->step_mm <= to_mm) out = std::max(out, it->csa_mm2);
  }
  return out;
}

/// The area at the end of a move: where two moves meet, one point stands for both.
double last_of(const std::vector<CutSample>& s, std::uint32_t move) {
  const auto behind = std::upper_bound(s.begin(), s.end(), move,
                                       [](std::uint32_t m, const CutSample& a) { return m < a.move; });
  return behind != s.begin() && std::prev(behind)->move == move ? std::prev(behind)->csa_mm2 : 0.0;
}

double tolerance(const CutSample& s, double other_mm2, double d_mm) {
  return std::max(kSectionsTolerance * std::max(s.csa_mm2, other_mm2), kSectionsFloor * s.ap_mm * d_mm);
}

}  // namespace

std::vector<CutSample> samples_of(const engagement::Measurement& m) {
  std::vector<CutSample> out;
  const auto& s = m.sections;
  out.reserve(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    const engagement::Engagement& e = m.engagement[i];
    add({.move = s.move[i],
         .ap_mm = e.ap_mm,
         .ae_mm = e.ae_mm,
         .plunge = e.plunge,
         .at_mm = s.at_mm[i],
         .step_mm = e.step_mm,
         .entry_rad = e.entry_rad,
         .exit_rad = e.exit_rad,
         .csa_mm2 = e.csa_mm2},
        out);
  }
  return out;
}

std::vector<CutSample> samples_of(const model::SectionSeries& s, const model::CutterPath& path,
                                  double cutting_diameter_mm) {
  std::vector<CutSample> out;
  const double r = 0.5 * cutting_diameter_mm;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const bool same = i > 0 && s.move[i - 1] == s.move[i] && s.at_mm[i - 1] <= s.at_mm[i];
    const bool joins = i > 0 && s.move[i - 1] + 1 == s.move[i] && s.at_mm[i] > 0.0 &&
                       s.at_mm[i - 1] >= model::move_length(path, s.move[i - 1]) - 1e-6;
    const bool again = same || joins;
    const std::size_t k = again && s.csa_mm2[i - 1] > s.csa_mm2[i] ? i - 1 : i;  // the larger section
    CutSample c{.move = s.move[i]};
    c.at_mm = s.at_mm[i];
    c.step_mm = s.at_mm[i] - (same ? s.at_mm[i - 1] : 0.0);
    c.plunge = straight_along_axis(path, s.move[i]);
    c.csa_mm2 = std::max(0.0, s.csa_mm2[k]);
    c.ap_mm = std::max(0.0, again ? std::max(s.ad_max_mm[i], s.ad_max_mm[i - 1]) : s.ad_max_mm[i]);
    c.ae_mm = std::max(0.0, again ? std::max(s.rd_max_mm[i], s.rd_max_mm[i - 1]) : s.rd_max_mm[i]);
    if (c.plunge) {
      c.exit_rad = 2.0 * std::numbers::pi;
    } else if (c.ae_mm > 0.0 && r > 0.0) {
      const double x = s.x_max_ofs_mm[k];
      c.entry_rad = std::acos(std::clamp(-(x - 0.5 * c.ae_mm) / r, -1.0, 1.0));
      c.exit_rad = std::acos(std::clamp(-(x + 0.5 * c.ae_mm) / r, -1.0, 1.0));
    }
    add(c, out);
  }
  return out;
}

SectionsCompared compared(const std::vector<CutSample>& stated, const std::vector<CutSample>& measured,
                          double d_mm) {
  SectionsCompared out;
  out.samples = stated;
  double worst = 0.0;
  const auto tell = [&](const CutSample& at, double said, double found) {
    ++out.contradictions;
    if (std::abs(said - found) <= worst) return;
    worst = std::abs(said - found);
    out.worst_move = at.move;
    out.worst = "move " + std::to_string(at.move) + ", " + trimmed(at.at_mm, 2) +
                " mm along it: " + trimmed(said, 3) + " mm2 stated, " + trimmed(found, 3) + " mm2 measured";
  };
  // Where a cut begins and ends is known to a step of either series.
  const double reach = 0.1 * d_mm;
  for (std::size_t i = 0; i < measured.size(); ++i) {
    const CutSample& m = measured[i];
    const double said = most_near(stated, m.move, m.at_mm - m.step_mm - reach, m.at_mm + reach);
    if (m.csa_mm2 <= said + tolerance(m, said, d_mm)) continue;
    const bool second = i > 0 && place(measured[i - 1]) == place(m);  // the same place, as wide as deep
    if (!second) tell(m, said, m.csa_mm2);
    out.samples.push_back(m);
  }
  for (std::size_t i = 0; i < stated.size(); ++i) {
    const CutSample& s = stated[i];
    if (i > 0 && place(stated[i - 1]) == place(s)) continue;
    double found = most_near(measured, s.move, s.at_mm - s.step_mm - reach, s.at_mm + reach);
    if (s.at_mm - s.step_mm <= reach && s.move > 0) found = std::max(found, last_of(measured, s.move - 1));
    if (s.csa_mm2 > found + tolerance(s, found, d_mm)) tell(s, s.csa_mm2, found);
  }
  std::stable_sort(out.samples.begin(), out.samples.end(),
                   [](const CutSample& a, const CutSample& b) { return place(a) < place(b); });
  return out;
}

}  // namespace capstan::pipeline
