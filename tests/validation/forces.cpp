#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/kienzle.h"
#include "planner/physics/mechanics/loads/section.h"
#include "tests/support/kienzle_fit.h"
#include "tests/support/mechanics/section_loads.h"
#include "tests/validation/studies.h"
#include "tooling/shop/material/material.h"

namespace capstan::validation {
namespace {

using mechanics::CuttingCoefficients;
using mechanics::ImmersionArc;

constexpr double kPi = std::numbers::pi;
constexpr int kTeeth = 4;
constexpr double kDiameter_mm = 12.0;

struct Set {
  const char* name;
  CuttingCoefficients k;
};

// Chin. J. Mech. Eng. 2021, doi 10.1186/s10033-021-00536-9 (CC BY), table 5, with that table's reference
// numbers. Where it states no axial coefficients they are zero here.
constexpr Set kSets[] = {
    {"Al6061-T6 [160]", {243.77, 7.53, 113.5, 7.83, 0.0, 0.0}},
    {"Al6082-T6 [189]", {631.0, 13.0, 99.0, 10.0, 273.0, 2.8}},
    {"Al7075-T6 [160]", {600.46, 17.9, 180.96, 20.42, 0.0, 0.0}},
    {"Al7075-T6 [190]", {767.01, 27.7, 168.8, 26.6, 222.0, 0.7}},
    {"Al7075 HSS [156]", {951.365, 11.115, 262.597, 11.314, 323.33, 1.105}},
    {"Al7075 [47]", {1319.41, 19.65, 788.83, 26.77, 48.75, 2.05}},
};
constexpr CuttingCoefficients kReference = kSets[3].k;

struct Case {
  const char* name;
  double ap_mm, fz_mm;
  ImmersionArc arc;
  double fx, fy, fz, peak, peak_helix;  ///< peak 0: not tabulated
};

// Means in closed form (Altintas, Manufacturing Automation, equation 2.83) and peaks by dense sampling, both
// computed outside of this tree for set [190].
std::vector<Case> cases() {
  const ImmersionArc slot{0.0, kPi};
  const auto quarter = [](mechanics::CutDirection d) {
    return mechanics::immersion_arc(0.25 * kDiameter_mm, kDiameter_mm, d);
  };
  return {{"slot, 2 mm deep, 0.1 mm per tooth", 2.0, 0.10, slot, -101.496, 223.939, 59.332, 0.0, 0.0},
          {"slot, 4 mm deep, 0.08 mm per tooth", 4.0, 0.08, slot, -189.489, 386.518, 96.051, 468.6, 467.2},
          {"quarter immersion down, 4 mm, 0.08 mm", 4.0, 0.08, quarter(mechanics::CutDirection::kDown),
           75.254, 154.810, 24.479, 357.8, 327.7},
          {"quarter immersion up, 4 mm, 0.08 mm", 4.0, 0.08, quarter(mechanics::CutDirection::kUp), -164.111,
           11.696, 24.479, 357.6, 326.9}};
}

/// What planning asks for: the section's loads.
mechanics::SectionLoads loads(const CuttingCoefficients& k, const Case& c, double helix) {
  const mechanics::Section section{.ap_mm = c.ap_mm, .arc = c.arc};
  const mechanics::Tooth tooth{.cutting_diameter_mm = kDiameter_mm, .helix_rad = helix, .teeth = kTeeth};
  // Kienzle's law is not used where coefficients were measured.
  const mechanics::ForceLaw law{.kienzle = {800.0, 0.2}, .mechanistic = k};
  return mechanics::section_loads(section, tooth, law, c.fz_mm, 5000.0).value();
}

double peak(const CuttingCoefficients& k, const Case& c, double helix) {
  return loads(k, c, helix).peak_force_n;
}

struct Milled {
  const char* name;
  double kc[5];
};

// Mitsubishi Materials, technical information, "Cutting power for face milling": kc in N/mm2 at feeds of 0.1,
// 0.2, 0.3, 0.4 and 0.6 mm per tooth.
constexpr double kFeeds[] = {0.1, 0.2, 0.3, 0.4, 0.6};
constexpr Milled kMilled[] = {
    {"mild steel, 520 N/mm²", {2200, 1950, 1820, 1700, 1580}},
    {"medium steel, 620 N/mm²", {1980, 1800, 1730, 1600, 1570}},
    {"hard steel, 720 N/mm²", {2520, 2200, 2040, 1850, 1740}},
    {"CrMo steel, 730 N/mm²", {2540, 2250, 2140, 2000, 1800}},
    {"CrMo steel, 600 N/mm²", {2180, 2000, 1860, 1800, 1670}},
    {"NiCrMo steel, 940 N/mm²", {2000, 1800, 1680, 1600, 1500}},
    {"austenitic steel, 155 HB", {2030, 1970, 1900, 1770, 1710}},
    {"hard cast iron, 46 HRC", {3000, 2700, 2500, 2400, 2200}},
    {"grey cast iron, 200 HB", {1750, 1400, 1240, 1050, 970}},
    {"brass", {1150, 950, 800, 700, 630}},
    {"AlMg", {580, 480, 400, 350, 320}},
    {"AlSi", {700, 600, 490, 450, 390}},
    {"AlZnMgCu", {880, 840, 840, 810, 720}},
};

}  // namespace

Comparison forces() {
  Comparison out{.name = "forces"};
  constexpr double kHelix = kPi / 6.0;
  double largest = 0.0;
  Table means{{"cut", "mean Fx, N", "Fy, N", "Fz, N", "peak, straight, N", "peak, helix 30°, N",
               "largest difference"},
              {}};
  for (const Case& c : cases()) {
    const auto f = loads(kReference, c, kHelix).mean;
    double worst = std::max(
        {std::abs(f.fx_n / c.fx - 1.0), std::abs(f.fy_n / c.fy - 1.0), std::abs(f.fz_n / c.fz - 1.0)});
    const double straight = peak(kReference, c, 0.0);
    const double helical = peak(kReference, c, kHelix);
    if (c.peak > 0.0) {
      worst = std::max({worst, std::abs(straight / c.peak - 1.0), std::abs(helical / c.peak_helix - 1.0)});
    }
    largest = std::max(largest, worst);
    const auto cell = [&](double v, double tabled, int decimals) {
      return fixed(v, decimals) + (tabled != 0.0 ? " (" + fixed(tabled, decimals) + ")" : "");
    };
    means.rows.push_back({c.name, cell(f.fx_n, c.fx, 3), cell(f.fy_n, c.fy, 3), cell(f.fz_n, c.fz, 3),
                          cell(straight, c.peak, 1), cell(helical, c.peak_helix, 1),
                          fixed(100.0 * worst, 3) + " %"});
  }
  const Case slot = cases()[1];
  const double middle = peak(kReference, slot, kHelix);
  Table spread{{"coefficients", "Ktc, N/mm²", "peak in the slot, N", "against [190]", "within the margin"},
               {}};
  Table data{{"index", "name", "ktc", "peak"}, {}};
  int n = 0;
  for (const Set& s : kSets) {
    const double p = peak(s.k, slot, kHelix);
    const double ratio = p / middle;
    const bool within =
        ratio <= mechanics::kForceUncertaintyFactor && ratio >= 1.0 / mechanics::kForceUncertaintyFactor;
    spread.rows.push_back(
        {s.name, fixed(s.k.ktc_n_mm2, 0), fixed(p, 0), percent(ratio - 1.0, 0), within ? "yes" : "no"});
    data.rows.push_back({std::to_string(n++), s.name, fixed(s.k.ktc_n_mm2, 1), fixed(p, 2)});
  }
  out.headline =
      "within " + fixed(100.0 * largest, 2) +
      " % of the tabulated means and peaks; published coefficients themselves span a factor of two";
  out.text = "In brackets the tabulated value.\n\n" + markdown(means) + "\n" + markdown(spread) +
             "\nMargin: a factor of " + shortest(mechanics::kForceUncertaintyFactor) + " up and down.\n";
  out.data.emplace_back("forces.dat", columns(data));
  out.data.emplace_back("forces_margin.dat",
                        fixed(middle, 2) + " " + fixed(middle * mechanics::kForceUncertaintyFactor, 2) + " " +
                            fixed(middle / mechanics::kForceUncertaintyFactor, 2) + "\n");
  return out;
}

namespace {

/// A shipped material beside the row of the maker's tables that is nearest in strength.
struct Beside {
  const char* material;
  const char* row;
  double milled_0_1, milled_0_6;  ///< N/mm2 at 0.1 and 0.6 mm per tooth
  double turned_0_1, turned_0_6;  ///< at 0.1 and 0.6 mm per turn; 0: not tabulated
};

// Mitsubishi Materials, technical information: cutting power for face milling, and in turning.
constexpr Beside kBeside[] = {
    {"C45", "medium steel, 620 N/mm²", 1980, 1570, 3080, 2300},
    {"42CrMo4", "CrMo steel, 600 N/mm²", 2180, 1670, 3610, 2500},
    {"42CrMo4+QT", "CrMo steel, 730 N/mm²", 2540, 1800, 4500, 2850},
    {"1.2311", "tool steel, 770 N/mm²", 2030, 1580, 3150, 2340},
    {"AISI 304", "austenitic steel, 155 HB", 2030, 1710, 0, 0},
    {"GG25", "grey cast iron, 200 HB", 1750, 970, 2110, 1330},
    {"CW614N", "brass", 1150, 630, 0, 0},
    {"EN AW-7075", "AlZnMgCu", 880, 720, 0, 0},
};
/// Mean chip over the feed of a face mill in the middle of a cut of 0.7 of its diameter: 1.4 / (2 asin 0.7).
const double kMeanChip = 1.4 / (2.0 * std::asin(0.7));

Table beside() {
  Table out{{"material", "row of the table", "milling, 0.1 mm", "milling, 0.6 mm", "turning, 0.1 mm",
             "turning, 0.6 mm"},
            {}};
  const auto materials = tooling::shipped_materials();
  if (!materials) return out;
  for (const Beside& b : kBeside) {
    Job job;
    const auto m = tooling::find_material(b.material, *materials, job);
    if (!m) continue;
    const auto ratio = [&](double h, double tabled) {
      if (tabled == 0.0) return std::string("-");
      return fixed(mechanics::specific_force_n_mm2({m->kc11_n_mm2, m->mc}, h) / tabled, 2);
    };
    out.rows.push_back({b.material, b.row, ratio(0.1 * kMeanChip, b.milled_0_1),
                        ratio(0.6 * kMeanChip, b.milled_0_6), ratio(0.1, b.turned_0_1),
                        ratio(0.6, b.turned_0_6)});
  }
  return out;
}

}  // namespace

Comparison kienzle() {
  Comparison out{.name = "kienzle"};
  Table rows{{"material", "kc1.1, N/mm²", "exponent", "largest difference to the table"}, {}};
  Table data{
      {"index", "name", "kc11", "mc", "kc_0.1", "kc_0.2", "kc_0.3", "kc_0.4", "kc_0.6", "error_percent"}, {}};
  int n = 0;
  double worst = 0.0;
  for (const Milled& m : kMilled) {
    std::vector<testing::SpecificForcePoint> points;
    for (int i = 0; i < 5; ++i) points.push_back({kFeeds[i], m.kc[i]});
    const auto fit = testing::fit_kienzle(points);
    if (!fit) continue;
    worst = std::max(worst, fit->max_relative_error);
    rows.rows.push_back({m.name, fixed(fit->work.kc11_n_mm2, 0), fixed(fit->work.mc, 3),
                         fixed(100.0 * fit->max_relative_error, 1) + " %"});
    std::vector<std::string> row{std::to_string(n++), m.name, fixed(fit->work.kc11_n_mm2, 2),
                                 fixed(fit->work.mc, 4)};
    for (const double kc : m.kc) row.push_back(fixed(kc, 0));
    row.push_back(fixed(100.0 * fit->max_relative_error, 2));
    data.rows.push_back(row);
  }
  out.headline = "13 materials, largest difference to a table value " + fixed(100.0 * worst, 1) + " %";
  out.text = markdown(rows) + "\nSpecific force of shipped materials over the tables' values:\n\n" +
             markdown(beside());
  out.data.emplace_back("kienzle.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
