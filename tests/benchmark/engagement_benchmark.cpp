#include <benchmark/benchmark.h>

#include <cmath>
#include <numbers>

#include "planner/physics/engagement/engagement.h"

namespace {

using namespace capstan;  // a program of its own

constexpr double kPi = std::numbers::pi;
constexpr double kSkew = 27.0 * kPi / 180.0;
constexpr double kDepth = 2.0;

model::Cutter cutter(model::CutterClass kind, double diameter, double corner = 0.0) {
  model::Cutter c;
  c.cutter_class = kind;
  c.cutting_diameter_mm = diameter;
  c.corner_radius_mm = corner;
  c.maximum_depth_of_cut_mm = 20.0;
  return c;
}

/// Zigzag passes 0.4 D apart at 27 degrees to the grid, 2 mm deep; the first is a slot.
model::CutterPath zigzag(double d) {
  const auto at = [&](double s, double left, double z) {
    return geometry::Vec3{2.0 * d + s * std::cos(kSkew) - left * std::sin(kSkew),
                          0.8 * d + s * std::sin(kSkew) + left * std::cos(kSkew), z};
  };
  model::CutterPath p;
  p.start(at(0.0, 0.0, 5.0));
  p.line(at(0.0, 0.0, -kDepth), model::MoveRole::kPlunge);
  for (int k = 0; k < 8; ++k) {
    p.line(at(k % 2 == 0 ? 6.0 * d : 0.0, 0.4 * d * k, -kDepth), model::MoveRole::kCut);
    p.line(at(k % 2 == 0 ? 6.0 * d : 0.0, 0.4 * d * (k + 1), -kDepth), model::MoveRole::kLink);
  }
  return p;
}

/// Twelve holes into the solid.
model::CutterPath holes() {
  model::CutterPath p;
  p.start({10.03, 10.07, 5.0});
  for (int k = 0; k < 12; ++k) {
    const double x = 10.03 + 15.0 * (k % 6), y = 10.07 + 20.0 * (k / 6);
    p.rapid({x, y, 5.0});
    p.line({x, y, -9.0}, model::MoveRole::kDrill);
    p.line({x, y, 5.0}, model::MoveRole::kRetract);
  }
  return p;
}

/// Down into the solid in a slot and back, 2 mm over four diameters, twice.
model::CutterPath ramps(double d) {
  const auto at = [&](double s, double z) {
    return geometry::Vec3{2.0 * d + s * std::cos(kSkew), 2.0 * d + s * std::sin(kSkew), z};
  };
  model::CutterPath p;
  p.start(at(0.0, 0.0));
  for (int k = 0; k < 4; ++k)
    p.line(at(k % 2 == 0 ? 4.0 * d : 0.0, -0.5 * kDepth * (k + 1)), model::MoveRole::kRamp);
  return p;
}

/// Four half turns of 0.8 D, 1 mm down in each.
model::CutterPath helix(double d) {
  model::CutterPath p;
  const geometry::Vec2 centre{4.03 * d, 4.07 * d};
  p.start({centre.x + 0.4 * d, centre.y, 0.0});
  for (int k = 0; k < 4; ++k) {
    p.arc({centre.x + (k % 2 == 0 ? -0.4 : 0.4) * d, centre.y, -0.5 * kDepth * (k + 1)}, centre, false,
          model::MoveRole::kRamp);
  }
  return p;
}

/// Steps of a fortieth of the diameter. `csa`: of the steady cut of move `move`, known in closed form: the
/// sample before that move's last must have it within 1 %. 0: where it is steady nowhere; what was taken is
/// then what the piece has lost.
void measure(benchmark::State& state, const model::Cutter& c, const model::CutterPath& path, double scale,
             std::uint32_t move, double csa) {
  const double cell = scale * 0.01 * static_cast<double>(state.range(0));
  const auto block =
      stock::from_box({{0, 0, -10}, {10.0 * c.cutting_diameter_mm, 8.0 * c.cutting_diameter_mm, 0}}, cell);
  std::size_t samples = 0;
  double removed = 0.0, found = 0.0, lost = 0.0;
  for (auto _ : state) {
    state.PauseTiming();
    auto map = block;
    state.ResumeTiming();
    const auto m = engagement::measure(path, c, map, {.step_mm = c.cutting_diameter_mm / 40.0});
    state.PauseTiming();
    samples += m->sections.size();
    removed = m->removed_mm3;
    lost = stock::volume(block) - stock::volume(map);
    for (std::size_t i = 0; i + 3 < m->sections.size(); ++i) {
      if (m->sections.move[i] == move && m->sections.csa_mm2[i + 2] > 0.0) found = m->sections.csa_mm2[i];
    }
    state.ResumeTiming();
  }
  if (!(removed > 0.0) || std::abs(lost - removed) > 1e-4 * removed)
    state.SkipWithError("the volume is wrong");
  if (csa > 0.0 && std::abs(found - csa) > 0.01 * csa) state.SkipWithError("the section is wrong");
  state.counters["us_per_point"] = benchmark::Counter(
      static_cast<double>(samples) * 1e-6, benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
  state.counters["points"] = static_cast<double>(samples) / static_cast<double>(state.iterations());
  state.counters["removed_mm3"] = removed;
}

void flat(benchmark::State& s) {
  measure(s, cutter(model::CutterClass::kEndmill, 10.0), zigzag(10.0), 1.0, 2, 10.0 * kDepth);
}
void ball(benchmark::State& s) {
  const double half = std::acos(1.0 - kDepth / 5.0);
  measure(s, cutter(model::CutterClass::kBallEndmill, 10.0, 5.0), zigzag(10.0), 1.0, 2,
          25.0 * (half - std::sin(half) * std::cos(half)));
}
void bull(benchmark::State& s) {
  measure(s, cutter(model::CutterClass::kBullnoseEndmill, 10.0, 1.0), zigzag(10.0), 1.0, 2,
          10.0 * kDepth - 2.0 * (1.0 - kPi / 4.0));
}
void drill(benchmark::State& s) {
  model::Cutter c = cutter(model::CutterClass::kTwistDrill, 10.0);
  c.point_angle_rad = 118.0 * kPi / 180.0;
  measure(s, c, holes(), 1.0, 2, 25.0 * kPi);
}
void face_mill(benchmark::State& s) {
  model::Cutter c = cutter(model::CutterClass::kFacemill, 50.0);
  c.lead_angle_rad = 45.0 * kPi / 180.0;
  c.maximum_depth_of_cut_mm = 4.0;
  measure(s, c, zigzag(50.0), 5.0, 2, kDepth * (50.0 + kDepth));
}
/// On a track that falls everything under the cutter is lowered at every step. `way`: ramps or a helix.
void falling(benchmark::State& s, model::CutterClass kind, double corner, model::CutterPath (*way)(double)) {
  model::Cutter c = cutter(kind, 10.0, corner);
  if (kind == model::CutterClass::kTwistDrill) c.point_angle_rad = 118.0 * kPi / 180.0;
  measure(s, c, way(10.0), 1.0, 0, 0.0);
}
using model::CutterClass;
BENCHMARK_CAPTURE(falling, ramp_flat, CutterClass::kEndmill, 0.0, ramps)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(falling, ramp_ball, CutterClass::kBallEndmill, 5.0, ramps)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(falling, ramp_bull, CutterClass::kBullnoseEndmill, 1.0, ramps)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(falling, ramp_cone, CutterClass::kTwistDrill, 0.0, ramps)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(falling, helix_flat, CutterClass::kEndmill, 0.0, helix)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(falling, helix_ball, CutterClass::kBallEndmill, 5.0, helix)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(falling, helix_bull, CutterClass::kBullnoseEndmill, 1.0, helix)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond);
// Cells of D/100 and of D/40.
BENCHMARK(flat)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(ball)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(bull)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(drill)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);
BENCHMARK(face_mill)->Arg(10)->Arg(25)->Unit(benchmark::kMillisecond);

}  // namespace
