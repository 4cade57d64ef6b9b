#include "planner/making/step/cut_samples.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <numbers>
#include <tuple>
#include <utility>

#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::step {
namespace {

using optimise::CutSample;

/// How wide a cutter sweeps with the diameter that it has at the top of its contact. It is a disc that is
/// moved: on an arc, too, its flank takes no more than that of a length of its centre's way.
double widest(const CutSample& s, const model::Cutter& cutter) {
  const double corner = mechanics::tooth_of(cutter).corner_radius_mm;
  return mechanics::effective_diameter_mm(std::max(s.ap_mm, s.top_mm), cutter.cutting_diameter_mm, corner);
}

/// How far a move goes down per length of its path.
double fall_of(const model::CutterPath& p, std::size_t i) {
  if (i == 0 || i >= p.size()) return 0.0;
  const double length = model::move_length(p, i);
  return length > 0.0 ? std::clamp((p.z[i - 1] - p.z[i]) / length, 0.0, 1.0) : 0.0;
}

void add(CutSample s, const model::CutterPath& path, const model::Cutter& cutter,
         std::vector<CutSample>& out) {
  if (s.plunge || !(s.ap_mm > 0.0) || !(cutter.cutting_diameter_mm > 0.0)) {
    out.push_back(s);
    return;
  }
  const double most = std::max(widest(s, cutter), s.ae_mm);
  if (s.csa_mm2 > most * s.ap_mm) {
    if (const double fall = fall_of(path, s.move); fall > 0.0) {
      s.end_mm2 = s.csa_mm2 - most * s.ap_mm;
      s.end_slope = fall;
    } else {
      s.ap_mm = s.csa_mm2 / most;
    }
  }
  const double ap = s.ap_mm, ae = s.ae_mm, flank = s.csa_mm2 - s.end_mm2;
  const bool whole = !(ae > 0.0) || flank >= optimise::kWholeSection * ap * ae;
  // On an arc about a corner the edge goes farther than the centre, and removes more than depth times width.
  s.ae_mm = whole ? std::max(ae, flank / ap) : flank / ap;
  out.push_back(s);
  if (whole) return;
  s.ap_mm = flank / ae;
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

/// The area of the last section of a move, mm2. Where two moves meet, one point belongs to both.
double last_of(const std::vector<CutSample>& s, std::uint32_t move) {
  const auto behind = std::upper_bound(s.begin(), s.end(), move,
                                       [](std::uint32_t m, const CutSample& a) { return m < a.move; });
  return behind != s.begin() && std::prev(behind)->move == move ? std::prev(behind)->csa_mm2 : 0.0;
}

double tolerance(const CutSample& s, double other_mm2, double d_mm) {
  // Of a ring that a plunge cuts, a map knows the rim to half a cell, which is a thirtieth of the diameter.
  const double floor = s.plunge ? kRingFloor * d_mm * d_mm : kSectionsFloor * s.ap_mm * d_mm;
  return std::max(kSectionsTolerance * std::max(s.csa_mm2, other_mm2), floor);
}

/// At most six digits, whatever a file says.
std::string six(double v) {
  if (!std::isfinite(v)) return "no finite number";
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%.6g", v);
  return text.data();
}

/// How much longer the cutter's far edge travels than its centre.
double edge_over_centre(const model::CutterPath& p, std::size_t i, double r_mm) {
  if (p.kind[i] != model::MoveKind::kArcCw && p.kind[i] != model::MoveKind::kArcCcw) return 1.0;
  const double arc = std::hypot(p.x[i] - p.cx[i], p.y[i] - p.cy[i]);
  return 1.0 + r_mm / std::max(arc, 1e-6);
}

/// Mean depth and width of what is removed; those of slivers weigh nothing.
std::pair<double, double> mean_extents(const model::SectionSeries& s) {
  double ad = 0.0, rd = 0.0, all = 0.0;
  for (std::size_t i = 0; i < s.size(); ++i) {
    ad += s.removed_mm3[i] * s.ad_max_mm[i];
    rd += s.removed_mm3[i] * s.rd_max_mm[i];
    all += s.removed_mm3[i];
  }
  return all > 0.0 ? std::pair(ad / all, rd / all) : std::pair(0.0, 0.0);
}

/// The area below the cutter's end where a step of a plunge is deepest, mm2. What a step removes of a level
/// top, it removes in the part of its length that is in contact; where the top is uneven, this is the mean
/// area over the length in contact of the highest part. A round nose's area grows from nothing, ever slower,
/// so that its mean over the last length c of a depth a is at least (1 - c / (2 a)) of the last (derived).
double below_end(const engagement::Engagement& e, const model::Cutter& cutter) {
  const double contact = std::min(e.ap_mm, e.step_mm);
  if (!(contact > 0.0)) return 0.0;
  const bool round = mechanics::tooth_of(cutter).corner_radius_mm > 0.0;
  return e.removed_mm3 / contact / (round ? 1.0 - 0.5 * contact / e.ap_mm : 1.0);
}

/// The area of a measured step. Of one shorter than a cell, what it removes is a matter of which cells'
/// middles it meets: its area is no more than that of the contact that was found, each extent known to a
/// cell.
double area_of(const engagement::Engagement& e, double known_to_mm) {
  if (e.plunge || e.step_mm >= known_to_mm) return e.csa_mm2;
  return std::min(e.csa_mm2, (e.ap_mm + known_to_mm) * (e.ae_mm + known_to_mm));
}

/// The thickest chip over the feed of a sample and of its neighbours: cells tell of what a cutter meets next
/// up to a step late.
double chip_about(const engagement::Measurement& m, std::size_t i) {
  double most = m.engagement[i].chip_over_feed;
  if (!(most > 0.0)) return 0.0;
  if (i > 0) most = std::max(most, m.engagement[i - 1].chip_over_feed);
  if (i + 1 < m.engagement.size()) most = std::max(most, m.engagement[i + 1].chip_over_feed);
  return most;
}

}  // namespace

std::optional<std::string> impossible(const model::SectionSeries& s, const model::CutterPath& path,
                                      double d_mm, double cutting_length_mm) {
  constexpr double kRounding = 1.02, kFloorMm = 0.02;  // of what is printed and measured; default, unsourced
  const double r = 0.5 * d_mm;
  for (std::size_t i = 0; i < s.size(); ++i) {
    const std::uint32_t move = s.move[i];
    const auto bad = [&](const char* name, double v, const std::string& bound) {
      return "move " + std::to_string(move) + ", " + six(s.at_mm[i]) + " mm along it: " + name + " of " +
             six(v) + ", " + bound;
    };
    const double ad = s.ad_max_mm[i], rd = s.rd_max_mm[i], csa = s.csa_mm2[i];
    const std::pair<const char*, double> sizes[] = {{"ADmax", ad}, {"RDmax", rd}, {"CSA", csa}};
    for (const auto& [name, v] : sizes) {
      if (!std::isfinite(v) || v < 0.0) return bad(name, v, "which must not be negative");
    }
    const std::pair<const char*, double> offsets[] = {{"Xmaxofs", s.x_max_ofs_mm[i]},
                                                      {"Ymaxofs", s.y_max_ofs_mm[i]},
                                                      {"XCGofs", s.x_cg_ofs_mm[i]},
                                                      {"YCGofs", s.y_cg_ofs_mm[i]}};
    for (const auto& [name, v] : offsets) {
      if (!std::isfinite(v)) return bad(name, v, "where a length is asked for");
      if (name[0] == 'X' && d_mm > 0.0 && std::abs(v) > kRounding * r + kFloorMm)
        return bad(name, v, "outside of the cutter of " + six(d_mm) + " mm");
    }
    if (!(d_mm > 0.0) || move >= path.size()) continue;
    if (rd > kRounding * d_mm + kFloorMm)
      return bad("RDmax", rd, "wider than the cutter of " + six(d_mm) + " mm");
    const bool plunge = straight_along_axis(path, move);
    if (plunge) {
      if (csa > kRounding * std::numbers::pi * r * r) return bad("CSA", csa, "more than the cutter's disc");
      continue;
    }
    const double longer = kRounding * edge_over_centre(path, move, r);
    const bool level = move > 0 && path.z[move] == path.z[move - 1];
    if (level && longer == kRounding && csa > longer * ad * rd + kFloorMm * d_mm)
      return bad("CSA", csa, "more than ADmax times RDmax");
    if (!(cutting_length_mm > 0.0)) continue;
    if (level && ad > kRounding * cutting_length_mm + kFloorMm)
      return bad("ADmax", ad, "more than the cutting length of " + six(cutting_length_mm) + " mm");
    if (level && csa > longer * d_mm * cutting_length_mm)
      return bad("CSA", csa, "more than the cutter's diameter times its cutting length");
  }
  return std::nullopt;
}

std::optional<std::string> extents_contradict(const model::SectionSeries& stated,
                                              const model::SectionSeries& measured, double d_mm) {
  const auto [ad, rd] = mean_extents(stated);
  const auto [our_ad, our_rd] = mean_extents(measured);
  if (!(ad > 0.0 && our_ad > 0.0)) return std::nullopt;  // compared by area
  const auto apart = [&](double a, double b) {
    return std::abs(a - b) > kSectionsTolerance * std::max(a, b) + kExtentsFloor * d_mm;
  };
  if (!apart(ad, our_ad) && !apart(rd, our_rd)) return std::nullopt;
  return "on the mean " + six(ad) + " mm deep and " + six(rd) + " mm wide stated, " + six(our_ad) +
         " mm deep and " + six(our_rd) + " mm wide measured";
}

std::vector<CutSample> samples_of(const engagement::Measurement& m, const model::CutterPath& path,
                                  const model::Cutter& cutter) {
  std::vector<CutSample> out;
  const auto& s = m.sections;
  out.reserve(s.size());
  for (std::size_t i = 0; i < s.size(); ++i) {
    const engagement::Engagement& e = m.engagement[i];
    double entry = e.entry_rad, exit = e.exit_rad;
    // A sample's arc is that of its step's end: within the step the arc of its beginning is met, too.
    const bool follows = i > 0 && s.move[i - 1] == s.move[i] && m.engagement[i - 1].removed_mm3 > 0.0;
    if (follows && !e.plunge && e.removed_mm3 > 0.0) {
      entry = std::min(entry, m.engagement[i - 1].entry_rad);
      exit = std::max(exit, m.engagement[i - 1].exit_rad);
    }
    add({.move = s.move[i],
         .ap_mm = e.ap_mm,
         .ae_mm = e.ae_mm,
         .plunge = e.plunge,
         .at_mm = s.at_mm[i],
         .step_mm = e.step_mm,
         .entry_rad = entry,
         .exit_rad = exit,
         .csa_mm2 = area_of(e, m.known_to_mm),
         .top_mm = s.y_max_ofs_mm[i] + 0.5 * s.ad_max_mm[i],
         .end_mm2 = e.plunge ? below_end(e, cutter) : 0.0,
         .chip_over_feed = chip_about(m, i)},
        path, cutter, out);
  }
  return out;
}

std::vector<CutSample> samples_of(const model::SectionSeries& s, const model::CutterPath& path,
                                  const model::Cutter& cutter) {
  std::vector<CutSample> out;
  const double r = 0.5 * cutter.cutting_diameter_mm;
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
    add(c, path, cutter, out);
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
    out.worst = "move " + std::to_string(at.move) + ", " + six(at.at_mm) + " mm along it: " + six(said) +
                " mm2 stated, " + six(found) + " mm2 measured";
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

}  // namespace capstan::step
