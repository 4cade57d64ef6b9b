// Milling power by published tables and by our law, for one cut in each material and feed.
//
// Mitsubishi and Tungaloy tabulate the specific force kc of milling by the feed per tooth, so that Pc = ap ae
// vf kc / 60e6 kW at the tool. Machinery's Handbook has Pc = Kp C Q: Kp by the Brinell hardness, C by the
// feed, sharp edges. Ours is the mean power of SectionAtFeeds by the law that planning takes, without any
// margin; where that law is a measured set, the card's if it is larger, as in planning.

#include "tests/validation/forces/power.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "planner/ground/base/number.h"
#include "planner/physics/mechanics/force/force_law.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/loads/side_section.h"
#include "tests/support/mechanics/section_loads.h"
#include "tests/validation/studies.h"
#include "tooling/shop/material/material.h"

namespace capstan::validation {
namespace {

/// Specific force at feeds of 0.1, 0.2 and 0.3 mm per tooth, N/mm2.
struct Milled {
  const char* material;
  const char* row;
  double kc[3];
};
constexpr double kFeeds[] = {0.1, 0.2, 0.3};

// Mitsubishi Materials, technical information, cutting power for face milling.
constexpr Milled kMitsubishi[] = {{"C45", "medium steel, 620 N/mm²", {1980, 1800, 1730}},
                                  {"42CrMo4", "CrMo steel, 600 N/mm²", {2180, 2000, 1860}},
                                  {"42CrMo4+QT", "CrMo steel, 730 N/mm²", {2540, 2250, 2140}},
                                  {"34CrNiMo6+QT", "NiCrMo steel, 352 HB", {2100, 1900, 1760}},
                                  {"AISI 304", "austenitic steel, 155 HB", {2030, 1970, 1900}},
                                  {"GG25", "grey cast iron, 200 HB", {1750, 1400, 1240}},
                                  {"CW614N", "brass", {1150, 950, 800}},
                                  {"EN AW-7075", "AlZnMgCu", {880, 840, 840}}};
// Tungaloy, catalogue 2020-21, p. 1650 (docs.steelcam.org).
constexpr Milled kTungaloy[] = {{"S235JR", "SS400, 520 N/mm²", {2150, 1900, 1750}},
                                {"C60", "S55C, 770 N/mm²", {1970, 1800, 1760}},
                                {"42CrMo4+QT", "SCM435, 730 N/mm²", {2450, 2200, 1980}},
                                {"34CrNiMo6+QT", "SKT4, 352 HB", {2030, 1810, 1680}},
                                {"GG25", "FC250, 200 HB", {1660, 1320, 1150}},
                                {"CW614N", "brass, 500 N/mm²", {1090, 877, 760}}};

// Machinery's Handbook, 31st edition, p. 1147, table 1b, and 28th edition, tables 1a and 2 as
// github.com/dubstar-04/FeedsAndSpeeds has them: Kp in W s/mm3.
struct Handbook {
  const char* material;
  const char* row;
  double kp;
};
constexpr Handbook kHandbook[] = {{"C45", "carbon steel, 180 to 200 HB", 2.24},
                                  {"42CrMo4", "4140, 200 to 220 HB", 1.97},
                                  {"42CrMo4+QT", "4140, 280 to 300 HB", 2.38},
                                  {"AISI 303", "303, 200 HB", 2.07},
                                  {"AISI 304", "304, 125 HB", 2.07},
                                  {"EN AW-6061", "6061", 0.9},
                                  {"EN AW-7075", "7075, 150 HB", 0.9}};
struct FeedFactor {
  double fz_mm, c;
};
constexpr FeedFactor kFeedFactors[] = {{0.05, 1.40}, {0.1, 1.25}};

// The cut: an end mill of 20 mm with four teeth, engaged on 0.7 of its diameter, as a face mill should be.
constexpr double kDiameterMm = 20.0, kDepthMm = 5.0, kWidthMm = 14.0, kSpeedMMin = 100.0;
constexpr int kTeeth = 4;

model::Cutter mill() {
  model::Cutter c;
  c.cutter_class = model::CutterClass::kEndmill;
  c.substrate = model::Substrate::kCarbide;
  c.cutting_diameter_mm = kDiameterMm;
  c.helix_rad = std::numbers::pi / 6.0;
  c.teeth = kTeeth;
  return c;
}

double rpm() { return 1000.0 * kSpeedMMin / (std::numbers::pi * kDiameterMm); }

double removal_mm3_min(double fz_mm) { return kDepthMm * kWidthMm * fz_mm * kTeeth * rpm(); }

/// kW at the tool; 0: the material has no card.
double ours_kw(const char* material, double fz_mm, const std::vector<model::WorkMaterial>& cards) {
  Job job;
  const auto card = tooling::find_material(material, cards, job);
  if (!card) return 0.0;
  const auto tooth = mechanics::tooth_of(mill());
  const auto section = mechanics::side_section(kDepthMm, kWidthMm, tooth, mechanics::CutDirection::kDown);
  const auto loads =
      mechanics::section_loads(section, tooth, mechanics::force_law(*card, mill()), fz_mm, rpm());
  if (!loads) return 0.0;
  if (mechanics::measured_set(*card, mill().substrate) == nullptr) return loads->power_w / 1000.0;
  const double by_card = mechanics::cutting_power_w(
      removal_mm3_min(fz_mm),
      mechanics::specific_force_n_mm2(mechanics::milled_with(*card, mill()), loads->h_mean_mm));
  return std::max(loads->power_w, by_card) / 1000.0;
}

}  // namespace

std::vector<PowerRow> power_rows() {
  std::vector<PowerRow> out;
  const auto cards = tooling::shipped_materials();
  if (!cards) return out;
  const auto add = [&](const char* source, const char* material, const char* row, double fz, double kc) {
    out.push_back(
        {source, material, row, fz, removal_mm3_min(fz) * kc / 60e6, ours_kw(material, fz, *cards)});
  };
  for (const Milled& m : kMitsubishi) {
    for (std::size_t i = 0; i < std::size(kFeeds); ++i)
      add("Mitsubishi", m.material, m.row, kFeeds[i], m.kc[i]);
  }
  for (const Milled& m : kTungaloy) {
    for (std::size_t i = 0; i < std::size(kFeeds); ++i)
      add("Tungaloy", m.material, m.row, kFeeds[i], m.kc[i]);
  }
  for (const Handbook& h : kHandbook) {
    for (const FeedFactor& f : kFeedFactors)
      add("Machinery's Handbook", h.material, h.row, f.fz_mm, 1000.0 * h.kp * f.c);
  }
  return out;
}

namespace {

/// "Mitsubishi 17 of 24, ...": rows within the bound, by source.
std::string of_each_source(const std::vector<PowerRow>& rows) {
  std::string out;
  for (const char* source : {"Mitsubishi", "Tungaloy", "Machinery's Handbook"}) {
    const auto [within, all] = rows_within(rows, source);
    out += (out.empty() ? "" : ", ") + std::string(source) + " " + std::to_string(within) + " of " +
           std::to_string(all);
  }
  return out;
}

}  // namespace

std::pair<int, int> rows_within(const std::vector<PowerRow>& rows, const std::string& source) {
  int within = 0, all = 0;
  for (const PowerRow& r : rows) {
    if (r.source != source) continue;
    ++all;
    if (r.within()) ++within;
  }
  return {within, all};
}

Comparison power() {
  Comparison out{.name = "power"};
  const std::vector<PowerRow> rows = power_rows();
  Table table{
      {"source", "row of the table", "our card", "fz, mm", "vf, mm/min", "table, kW", "ours, kW", "ratio"},
      {}};
  int within = 0;
  double least = 1e300, most = 0.0;
  for (const PowerRow& r : rows) {
    if (r.within()) ++within;
    least = std::min(least, r.ratio());
    most = std::max(most, r.ratio());
    table.rows.push_back({r.source, r.row, r.material, shortest(r.fz_mm), fixed(r.fz_mm * kTeeth * rpm(), 0),
                          fixed(r.table_kw, 2), fixed(r.ours_kw, 2), fixed(r.ratio(), 2)});
  }
  out.headline = std::to_string(within) + " of " + std::to_string(rows.size()) +
                 " rows within 25 % of the table's power, " + fixed(least, 2) + " to " + fixed(most, 2) +
                 " of it";
  out.text = "The cut: an end mill of " + shortest(kDiameterMm) + " mm, four teeth, " + shortest(kDepthMm) +
             " mm deep, " + shortest(kWidthMm) + " mm wide, " + shortest(kSpeedMMin) + " m/min.\n\n" +
             markdown(table) + "\n" + out.headline + ": " + of_each_source(rows) + ".\n";
  return out;
}

}  // namespace capstan::validation
