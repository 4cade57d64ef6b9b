#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/ground/base/number.h"
#include "planner/physics/engagement/engagement.h"
#include "planner/physics/engagement/planar/planar.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

using geometry::Box3;
using geometry::Vec2;
using geometry::Vec3;
using model::CutterClass;
using model::CutterPath;
using model::MoveRole;

constexpr double kPi = std::numbers::pi;
constexpr double kSkew = 27.0 * kPi / 180.0;  // no axis, no diagonal, no simple ratio
constexpr double kDiameter_mm = 10.0, kDepth_mm = 3.0, kWidth_mm = 2.0;
const Box3 kBlock{{0.0, 0.0, -20.0}, {80.0, 60.0, 0.0}};

Vec3 skewed(double s, double left, double z) {
  const Vec2 p = Vec2{15.13, 12.07} + s * Vec2{std::cos(kSkew), std::sin(kSkew)} +
                 left * Vec2{-std::sin(kSkew), std::cos(kSkew)};
  return {p.x, p.y, z};
}

CutterPath pass(double left, double z) {
  CutterPath p;
  p.start(skewed(0.0, left, 10.0));
  p.rapid(skewed(0.0, left, 5.0));
  p.line(skewed(0.0, left, z), MoveRole::kPlunge);
  p.line(skewed(40.0, left, z), MoveRole::kCut);
  return p;
}

model::Cutter cutter(bool ball) {
  model::Cutter c;
  c.id = "t";
  c.cutter_class = ball ? CutterClass::kBallEndmill : CutterClass::kEndmill;
  c.cutting_diameter_mm = kDiameter_mm;
  c.corner_radius_mm = ball ? 0.5 * kDiameter_mm : 0.0;
  c.maximum_depth_of_cut_mm = 30.0;
  return c;
}

/// Largest amount by which the area of a sample of the last move differs from the closed form, mm2.
double worst(const engagement::Measurement& m, double expected) {
  double out = 0.0;
  for (std::size_t i = 0; i < m.sections.size(); ++i) {
    if (m.sections.move[i] != 3 || m.sections.at_mm[i] < 10.0 || m.sections.at_mm[i] > 34.0) continue;
    out = std::max(out, std::abs(m.sections.csa_mm2[i] - expected));
  }
  return out;
}

struct Cut {
  const char* name;
  bool ball;
  double width_mm;  ///< 0: into the solid
  double area_mm2;
};

std::vector<Cut> cuts() {
  const double half = std::acos(1.0 - kDepth_mm / (0.5 * kDiameter_mm));
  return {{"slot", false, 0.0, kDiameter_mm * kDepth_mm},
          {"shoulder, 2 mm wide", false, kWidth_mm, kWidth_mm * kDepth_mm},
          {"ball in the solid", true, 0.0, 25.0 * (half - std::sin(half) * std::cos(half))}};
}

template <class Stock>
double worst_of(const Cut& cut, Stock stock) {
  const model::Cutter c = cutter(cut.ball);
  if (cut.width_mm > 0.0 && !engagement::measure(pass(0.0, -kDepth_mm), c, stock)) return std::nan("");
  const auto m = engagement::measure(pass(-cut.width_mm, -kDepth_mm), c, stock);
  return m ? worst(*m, cut.area_mm2) : std::nan("");
}

}  // namespace

Comparison sections() {
  Comparison out{.name = "sections"};
  const double whole = kDiameter_mm * kDepth_mm;  // ap D
  Table rows{{"cells", "slot", "shoulder, 2 mm wide", "ball in the solid"}, {}};
  Table data{{"cells_per_diameter", "slot", "shoulder", "ball"}, {}};
  double at_100 = 0.0;
  for (const int n : {25, 50, 100, 200}) {
    std::vector<std::string> row{"D/" + std::to_string(n)}, plain{std::to_string(n)};
    for (const Cut& c : cuts()) {
      const double share = worst_of(c, stock::from_box(kBlock, kDiameter_mm / n)) / whole;
      if (n == 100) at_100 = std::max(at_100, share);
      row.push_back(fixed(100.0 * share, 3) + " %");
      plain.push_back(fixed(100.0 * share, 5));
    }
    rows.rows.push_back(row);
    data.rows.push_back(plain);
  }
  std::vector<std::string> exact{"by geometry, no cells"};
  for (const Cut& c : cuts()) {
    const double share = c.ball ? std::nan("") : worst_of(c, stock::PlanarStock::from_box(kBlock)) / whole;
    exact.push_back(std::isnan(share) ? "not a flat cutter"
                    : share < 1e-6    ? "< 0.0001 %"
                                      : fixed(100.0 * share, 4) + " %");
  }
  rows.rows.push_back(exact);
  std::vector<std::string> asked{"asked at D/100: max(1 % of the area, 0.5 % of ap D)"};
  for (const Cut& c : cuts())
    asked.push_back(fixed(100.0 * std::max(0.01 * c.area_mm2 / whole, 0.005), 3) + " %");
  rows.rows.push_back(asked);
  out.headline = "largest error at cells of D/100: " + fixed(100.0 * at_100, 3) + " % of depth × diameter";
  out.text =
      "Largest error of CSA in per cent of ap·D, over all samples of a straight pass at 27° to the "
      "cells.\n\n" +
      markdown(rows);
  out.data.emplace_back("sections.dat", columns(data));
  return out;
}

}  // namespace capstan::validation
