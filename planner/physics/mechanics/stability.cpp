#include "planner/physics/mechanics/stability.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numbers>
#include <utility>

#include "planner/model/plan/cutter/ramp.h"
#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"
#include "planner/physics/mechanics/force/force_law.h"

namespace capstan::mechanics {
namespace {

using Complex = std::complex<double>;
constexpr double kPi = std::numbers::pi;
constexpr double kLeastHz = 1.0;
constexpr double kMostHz = 1e5;
constexpr double kNone = std::numeric_limits<double>::infinity();

/// Mean directional coefficients, per unit of N Kt / (2 pi).
struct Directional {
  double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;
};

Directional directional(const ImmersionArc& arc, double kr) {
  const auto primitive = [&](double p) {
    const double s = std::sin(2.0 * p) / 4.0;
    const double c = std::cos(2.0 * p) / 4.0;
    return Directional{c - kr * (0.5 * p - s), -(0.5 * p + s) + kr * c, 0.5 * p - s + kr * c,
                       -c - kr * (0.5 * p + s)};
  };
  const Directional a = primitive(arc.entry_rad);
  const Directional b = primitive(arc.exit_rad);
  return {b.xx - a.xx, b.xy - a.xy, b.yx - a.yx, b.yy - a.yy};
}

using Modes = std::vector<model::ToolPointMode>;

Complex response(const Modes& modes, std::string_view direction, double f) {
  Complex sum{};
  for (const auto& m : modes) {
    if (m.direction != direction) continue;
    const double r = f / m.frequency_hz;
    const double re = 1.0 - r * r;
    const double im = 2.0 * m.damping_ratio * r;
    sum += Complex(re, -im) / (m.stiffness_n_mm * (re * re + im * im));
  }
  return sum;
}

/// 1 / z; the library's division also looks after infinities.
Complex inverse(Complex z) {
  const double n = std::norm(z);
  return {z.real() / n, -z.imag() / n};
}

/// The two eigenvalues of A0 G, the feed turned from the machine's x by an angle of this sine and cosine.
std::array<Complex, 2> eigenvalues(Complex gx, Complex gy, const Directional& a, double s, double c) {
  const Complex xx = c * c * gx + s * s * gy;
  const Complex yy = s * s * gx + c * c * gy;
  const Complex xy = c * s * (gy - gx);
  const Complex m11 = a.xx * xx + a.xy * xy;
  const Complex m12 = a.xx * xy + a.xy * yy;
  const Complex m21 = a.yx * xx + a.yy * xy;
  const Complex m22 = a.yx * xy + a.yy * yy;
  const Complex half = 0.5 * (m11 + m22);
  // The product of complex numbers by hand, too.
  const auto times = [](Complex p, Complex q) {
    return Complex(p.real() * q.real() - p.imag() * q.imag(), p.real() * q.imag() + p.imag() * q.real());
  };
  const Complex root = std::sqrt(times(half, half) - (times(m11, m22) - times(m12, m21)));
  return {half + root, half - root};
}

/// Frequencies that see every mode: coarse over the whole range, fine about each.
std::vector<double> grid(const Modes& modes) {
  double low = modes.front().frequency_hz;
  double high = low;
  for (const auto& m : modes) {
    low = std::min(low, m.frequency_hz);
    high = std::max(high, m.frequency_hz);
  }
  std::vector<double> out;
  constexpr double kCoarse = 1.008;
  for (double f = 0.3 * low; f < 4.0 * high; f *= kCoarse) out.push_back(f);
  constexpr int kFine = 200;
  for (const auto& m : modes) {
    const double width = 20.0 * m.damping_ratio * m.frequency_hz;
    for (int i = -kFine; i <= kFine; ++i) {
      const double f = m.frequency_hz + width * i / kFine;
      if (f > 0.0) out.push_back(f);
    }
  }
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

Status check(const Modes& modes, const ChatterCut& cut) {
  if (modes.empty()) return fail("MECH-MODES", "there is no mode of the tool point");
  for (const auto& m : modes) {
    const bool good = (m.direction == "x" || m.direction == "y") && m.frequency_hz >= kLeastHz &&
                      m.frequency_hz <= kMostHz && m.damping_ratio > 0.0 && m.damping_ratio < 1.0 &&
                      m.stiffness_n_mm > 0.0 && std::isfinite(m.stiffness_n_mm);
    if (!good) return fail("MECH-MODES", "a mode of the tool point is out of range");
  }
  if (auto ok = check_positive({{"teeth", static_cast<double>(cut.teeth)}, {"ktc_n_mm2", cut.ktc_n_mm2}});
      !ok)
    return ok;
  if (auto ok = check_range({"teeth", static_cast<double>(cut.teeth)}, 1.0, 1000.0); !ok) return ok;
  if (auto ok = check_range({"krc_n_mm2", cut.krc_n_mm2}, 0.0, 1e9); !ok) return ok;
  if (auto ok = check_range({"entry_rad", cut.arc.entry_rad}, 0.0, kPi); !ok) return ok;
  return check_range({"exit_rad", cut.arc.exit_rad}, cut.arc.entry_rad, kPi);
}

}  // namespace

Result<StabilityLobes> StabilityLobes::make(const std::vector<model::ToolPointMode>& given,
                                            const ChatterCut& cut) {
  if (auto ok = check(given, cut); !ok) return fail(ok.error());
  Modes modes = given;
  for (const auto& [there, missing] : {std::pair{"x", "y"}, std::pair{"y", "x"}}) {
    if (std::any_of(given.begin(), given.end(),
                    [&, other = missing](const auto& m) { return m.direction == other; }))
      continue;
    for (model::ToolPointMode m : given) {
      if (m.direction != there) continue;
      m.direction = missing;
      modes.push_back(m);
    }
  }
  std::vector<double> directions;
  if (cut.feed_direction_rad) {
    directions.push_back(*cut.feed_direction_rad);
  } else {
    constexpr int kDirections = 12;  // of half a turn: the other half is the same
    for (int i = 0; i < kDirections; ++i) directions.push_back(kPi * i / kDirections);
  }
  StabilityLobes out;
  out.teeth_ = cut.teeth;
  out.absolute_mm_ = kNone;
  const Directional a = directional(cut.arc, cut.krc_n_mm2 / cut.ktc_n_mm2);
  const double unit = 2.0 * kPi / (cut.teeth * cut.ktc_n_mm2);
  const std::vector<double> frequencies = grid(modes);
  std::vector<std::pair<Complex, Complex>> responses;
  responses.reserve(frequencies.size());
  for (const double f : frequencies) responses.emplace_back(response(modes, "x", f), response(modes, "y", f));
  for (const double beta : directions) {
    const double sine = std::sin(beta);
    const double cosine = std::cos(beta);
    std::array<std::vector<Point>, 2> branch;
    for (auto& b : branch) b.reserve(frequencies.size());
    std::array<Complex, 2> last{};
    for (std::size_t i = 0; i < frequencies.size(); ++i) {
      std::array<Complex, 2> e = eigenvalues(responses[i].first, responses[i].second, a, sine, cosine);
      if (i > 0 && std::norm(e[0] - last[0]) + std::norm(e[1] - last[1]) >
                       std::norm(e[1] - last[0]) + std::norm(e[0] - last[1]))
        std::swap(e[0], e[1]);
      last = e;
      for (std::size_t k = 0; k < 2; ++k) {
        Point p{.frequency_hz = frequencies[i], .depth_mm = -1.0};
        if (std::norm(e[k]) > 0.0) {
          const Complex w = unit * inverse(e[k]);
          if (w.real() > 0.0) {
            const double kappa = w.imag() / w.real();
            p.depth_mm = 0.5 * w.real() * (1.0 + kappa * kappa);
            p.phase = std::atan2(1.0, kappa) / kPi;
            out.absolute_mm_ = std::min(out.absolute_mm_, p.depth_mm);
          }
        }
        branch.at(k).push_back(p);
      }
    }
    for (auto& b : branch) out.branches_.push_back(std::move(b));
  }
  return out;
}

double StabilityLobes::at(double n_rpm) const {
  const double period = 60.0 / (teeth_ * n_rpm);
  double least = kNone;
  for (const auto& branch : branches_) {
    for (std::size_t i = 1; i < branch.size(); ++i) {
      const Point& p = branch[i - 1];
      const Point& q = branch[i];
      if (p.depth_mm < 0.0 || q.depth_mm < 0.0) continue;
      if (p.depth_mm >= least && q.depth_mm >= least) continue;
      // Waves between two teeth less the phase: a lobe passes where this is a whole number.
      const double from = p.frequency_hz * period - p.phase;
      const double to = q.frequency_hz * period - q.phase;
      const double low = std::min(from, to);
      const double high = std::max(from, to);
      const double k = std::max(0.0, std::ceil(low));
      if (k > high) continue;
      if (high - low > 2.0) {  // lobes closer than the grid
        least = std::min({least, p.depth_mm, q.depth_mm});
        continue;
      }
      for (double lobe = k; lobe <= high; lobe += 1.0) {
        const double t = to == from ? 0.0 : (lobe - from) / (to - from);
        least = std::min(least, p.depth_mm + t * (q.depth_mm - p.depth_mm));
      }
    }
  }
  return least;
}

double StabilityLobes::limit_mm(double n_rpm, double speed_band) const {
  if (!(n_rpm > 0.0) || !std::isfinite(n_rpm)) return absolute_mm_;
  if (!(speed_band > 0.0)) return at(n_rpm);
  constexpr int kSteps = 4;
  double least = kNone;
  for (int i = -kSteps; i <= kSteps; ++i)
    least = std::min(least, at(n_rpm * (1.0 + speed_band * i / kSteps)));
  return least;
}

std::vector<model::ToolPointMode> modes_for(const model::Machine& machine, const std::string& cutter_id) {
  for (const std::string& wanted : {cutter_id, std::string()}) {
    Modes out;
    std::copy_if(machine.modes.begin(), machine.modes.end(), std::back_inserter(out),
                 [&](const auto& m) { return m.cutter_id == wanted; });
    if (!out.empty()) return out;
  }
  return {};
}

double slender_depth_mm(double diameter_mm, double stick_out_mm) {
  if (!(diameter_mm > 0.0) || !(stick_out_mm > 0.0)) return 0.0;
  const double ratio = std::min(1.0, kSlenderRatio * diameter_mm / stick_out_mm);
  return model::kDeepestSlotRatio * diameter_mm * ratio * ratio * ratio;
}

}  // namespace capstan::mechanics
