#include <cmath>
#include <numbers>
#include <vector>

#include "planner/ground/base/number.h"
#include "planner/physics/mechanics/stability.h"
#include "tests/validation/studies.h"

namespace capstan::validation {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kTeeth = 4;

// A tool point as a tap test might give it; the coefficients of Al 7075-T6, set [190] of doi
// 10.1186/s10033-021-00536-9, table 5. The modes are chosen here: what is compared is two ways to judge them.
const model::ToolPointMode kModeX{.cutter_id = {},
                                  .direction = "x",
                                  .frequency_hz = 850.0,
                                  .damping_ratio = 0.03,
                                  .stiffness_n_mm = 6000.0};
const model::ToolPointMode kModeY{.cutter_id = {},
                                  .direction = "y",
                                  .frequency_hz = 920.0,
                                  .damping_ratio = 0.025,
                                  .stiffness_n_mm = 7000.0};
constexpr double kKtc_n_mm2 = 767.01, kKrc_n_mm2 = 168.8;

// One mode driven by a force held over a step: the exact solution of the damped oscillator.
class Oscillator {
 public:
  Oscillator(const model::ToolPointMode& m, double step_s) : k_(m.stiffness_n_mm) {
    const double w = 2.0 * kPi * m.frequency_hz;
    const double d = m.damping_ratio * w;
    const double wd = w * std::sqrt(1.0 - m.damping_ratio * m.damping_ratio);
    const double e = std::exp(-d * step_s);
    const double c = std::cos(wd * step_s), s = std::sin(wd * step_s);
    xx_ = e * (c + d / wd * s);
    xv_ = e * s / wd;
    vx_ = -e * w * w / wd * s;
    vv_ = e * (c - d / wd * s);
  }
  void step(double force_n) {
    const double rest = force_n / k_;
    const double x = x_ - rest;
    const double next = rest + xx_ * x + xv_ * v_;
    v_ = vx_ * x + vv_ * v_;
    x_ = next;
  }
  void kick(double x) { x_ = x; }
  [[nodiscard]] double x() const { return x_; }

 private:
  double k_, xx_ = 0.0, xv_ = 0.0, vx_ = 0.0, vv_ = 0.0, x_ = 0.0, v_ = 0.0;
};

/// Does a small disturbance grow? Straight teeth; each cuts what it and the tooth before it leave between
/// them.
bool grows(double depth_mm, double n_rpm, const mechanics::ImmersionArc& arc) {
  constexpr int kStepsPerTooth = 160;
  constexpr int kTurns = 100;
  const double step_s = 60.0 / (n_rpm * kTeeth * kStepsPerTooth);
  Oscillator x(kModeX, step_s), y(kModeY, step_s);
  x.kick(1e-3);
  y.kick(-1e-3);
  std::vector<double> was_x(kStepsPerTooth, 0.0), was_y(kStepsPerTooth, 0.0);
  double early = 0.0, late = 0.0;
  const int steps = kTurns * kTeeth * kStepsPerTooth;
  for (int i = 0; i < steps; ++i) {
    const auto slot = static_cast<std::size_t>(i % kStepsPerTooth);
    const double dx = x.x() - was_x[slot], dy = y.x() - was_y[slot];
    double fx = 0.0, fy = 0.0;
    for (int j = 0; j < kTeeth; ++j) {
      // The middle of the step, so that a tooth enters and leaves without a bias.
      double a = 2.0 * kPi * ((i + 0.5) / (kTeeth * kStepsPerTooth) + static_cast<double>(j) / kTeeth);
      a -= 2.0 * kPi * std::floor(a / (2.0 * kPi));
      if (a < arc.entry_rad || a > arc.exit_rad) continue;
      const double h = dx * std::sin(a) + dy * std::cos(a);
      const double ft = kKtc_n_mm2 * depth_mm * h, fr = kKrc_n_mm2 * depth_mm * h;
      fx += -ft * std::cos(a) - fr * std::sin(a);
      fy += ft * std::sin(a) - fr * std::cos(a);
    }
    was_x[slot] = x.x();
    was_y[slot] = y.x();
    x.step(fx);
    y.step(fy);
    const double size = std::hypot(x.x(), y.x());
    if (!(size < 1e6)) return true;
    if (i >= steps / 4 && i < steps / 2) early = std::max(early, size);
    if (i >= 3 * (steps / 4)) late = std::max(late, size);
  }
  return late > early;
}

double simulated_limit_mm(double n_rpm, const mechanics::ImmersionArc& arc, double guess_mm) {
  double low = 0.1 * guess_mm, high = 40.0 * guess_mm;
  for (int i = 0; i < 13; ++i) {
    const double middle = std::sqrt(low * high);
    (grows(middle, n_rpm, arc) ? high : low) = middle;
  }
  return std::sqrt(low * high);
}

}  // namespace

Comparison lobes() {
  Comparison out{.name = "lobes"};
  Table rows{{"cut", "speeds", "median difference", "largest difference",
              "lobes above simulation by more than 10 %"},
             {}};
  const struct {
    const char* name;
    const char* file;
    mechanics::ImmersionArc arc;
  } cuts[] = {{"slot", "lobes_slot", {0.0, kPi}}, {"half immersion, down", "lobes_half", {0.5 * kPi, kPi}}};
  for (const auto& cut : cuts) {
    const auto lobes = mechanics::StabilityLobes::make({kModeX, kModeY}, {.arc = cut.arc,
                                                                          .teeth = kTeeth,
                                                                          .ktc_n_mm2 = kKtc_n_mm2,
                                                                          .krc_n_mm2 = kKrc_n_mm2,
                                                                          .feed_direction_rad = 0.0});
    if (!lobes) {
      out.skipped = lobes.error().message;
      return out;
    }
    Table curve{{"rpm", "limit"}, {}};
    for (int n = 4000; n <= 16000; n += 25) {
      curve.rows.push_back({std::to_string(n), fixed(lobes->limit_mm(n, 0.0), 4)});
    }
    Table points{{"rpm", "simulated", "lobes"}, {}};
    std::vector<double> errors;
    int above = 0;
    for (int n = 4000; n <= 16000; n += 500) {
      const double theirs = simulated_limit_mm(n, cut.arc, lobes->absolute_limit_mm());
      const double ours = lobes->limit_mm(n, 0.0);
      errors.push_back(ours / theirs - 1.0);
      if (errors.back() > 0.1) ++above;
      points.rows.push_back({std::to_string(n), fixed(theirs, 4), fixed(ours, 4)});
    }
    const Spread s = spread_of(errors, 0.1);
    out.headline += std::string(out.headline.empty() ? "" : "; ") + cut.name +
                    ": median difference to the simulation " + fixed(100.0 * s.median, 1) + " %, largest " +
                    percent(s.worst);
    rows.rows.push_back({cut.name, std::to_string(s.n), fixed(100.0 * s.median, 1) + " %", percent(s.worst),
                         std::to_string(above)});
    out.data.emplace_back(std::string(cut.file) + ".dat", columns(curve));
    out.data.emplace_back(std::string(cut.file) + "_points.dat", columns(points));
  }
  out.text = markdown(rows);
  return out;
}

}  // namespace capstan::validation
