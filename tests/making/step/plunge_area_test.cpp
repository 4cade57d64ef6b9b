// What lies below the end of a cutter that goes straight down, from what its steps remove.

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "planner/making/step/cut_samples.h"

namespace capstan::step {
namespace {

using std::numbers::pi;

/// The only sample of a step of 0.5 mm straight down, with this depth of contact and this volume removed.
optimise::CutSample sample(double nose_mm, double ap_mm, double removed_mm3) {
  constexpr double kStep = 0.5;
  model::Cutter c;
  c.cutter_class = nose_mm > 0.0 ? model::CutterClass::kBallEndmill : model::CutterClass::kEndmill;
  c.cutting_diameter_mm = 10.0;
  c.corner_radius_mm = nose_mm;
  c.teeth = 2;
  model::CutterPath p;
  p.start({0, 0, 0});
  p.line({0, 0, -kStep}, model::MoveRole::kPlunge);
  engagement::Measurement m;
  m.engagement = {{.ap_mm = ap_mm,
                   .ae_mm = 10.0,
                   .exit_rad = 2.0 * pi,
                   .csa_mm2 = removed_mm3 / kStep,
                   .removed_mm3 = removed_mm3,
                   .step_mm = kStep,
                   .plunge = true}};
  m.sections.move = {1};
  for (auto* v : {&m.sections.at_mm, &m.sections.ad_max_mm, &m.sections.rd_max_mm, &m.sections.x_max_ofs_mm,
                  &m.sections.y_max_ofs_mm, &m.sections.csa_mm2, &m.sections.x_cg_ofs_mm,
                  &m.sections.y_cg_ofs_mm, &m.sections.removed_mm3})
    *v = {0.0};
  const auto all = samples_of(m, p, c);
  return all.size() == 1 ? all.front() : optimise::CutSample{};
}

// The last 0.2 mm of the step meet material: of 25 pi mm2 they remove 5 pi mm3.
TEST(PlungeArea, OfAFlatEndIsWhatItRemovesOverTheLengthInContact) {
  EXPECT_NEAR(sample(0.0, 0.2, 5.0 * pi).end_mm2, 25.0 * pi, 1e-9);
  EXPECT_NEAR(sample(0.0, 0.5, 12.5 * pi).end_mm2, 25.0 * pi, 1e-9);
}

// By hand: a cap of the depth h has pi h^2 (r - h / 3) of volume and pi (2 r h - h^2) of area.
TEST(PlungeArea, OfABallIsThatOfTheEndOfTheStepAndLittleMore) {
  const auto volume = [](double h) { return pi * h * h * (5.0 - h / 3.0); };
  for (const double h : {0.2, 0.5, 1.0, 2.5, 5.0}) {
    const double area = pi * (10.0 * h - h * h);
    const double found = sample(5.0, h, volume(h) - (h > 0.5 ? volume(h - 0.5) : 0.0)).end_mm2;
    EXPECT_GE(found, area) << h;
    EXPECT_LE(found, 1.1 * area) << h;
  }
}

// A cell of 0.1 mm that a micrometre meets: of 3 mm deep and 0.02 wide contact no more than a cell more each
// way.
TEST(ShortMove, HasNoLargerAreaThanItsContact) {
  model::Cutter c;
  c.cutter_class = model::CutterClass::kEndmill;
  c.cutting_diameter_mm = 10.0;
  c.teeth = 2;
  model::CutterPath p;
  p.start({0, 0, 0});
  p.line({0.001, 0, 0}, model::MoveRole::kCut);
  engagement::Measurement m;
  m.engagement = {
      {.ap_mm = 3.0, .ae_mm = 0.02, .exit_rad = 1.0, .csa_mm2 = 30.0, .removed_mm3 = 0.03, .step_mm = 0.001}};
  m.sections.move = {1};
  for (auto* v : {&m.sections.at_mm, &m.sections.ad_max_mm, &m.sections.rd_max_mm, &m.sections.x_max_ofs_mm,
                  &m.sections.y_max_ofs_mm, &m.sections.csa_mm2, &m.sections.x_cg_ofs_mm,
                  &m.sections.y_cg_ofs_mm, &m.sections.removed_mm3})
    *v = {0.0};
  for (const auto& [cell, most] : {std::pair{0.1, 3.1 * 0.12}, {0.0005, 30.0}}) {
    m.known_to_mm = cell;
    double area = 0.0;
    for (const auto& s : samples_of(m, p, c)) area = std::max(area, s.csa_mm2);
    EXPECT_NEAR(area, most, 1e-9) << cell;
  }
}

}  // namespace
}  // namespace capstan::step
