#include "tests/simulated_shop/shop.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace capstan::testing {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr int kRevolutions = 16, kJudged = 8;  // simulated; the last of them are looked at
constexpr int kSlices = 3;
constexpr double kChatterMm = 0.003;  // scatter of the cutter's place from one revolution to the next

/// A tooth's force per mm of width, tangential.
double tangential(double h, double pressure, double gain, double thin_mm, double edge_n_mm, double edge_mm) {
  return pressure * h * (1.0 + gain * std::exp(-h / thin_mm)) + edge_n_mm * (1.0 - std::exp(-h / edge_mm));
}

}  // namespace

double Draw::uniform(double low, double high) {
  return low + (high - low) * (static_cast<double>(engine_() >> 11) * 0x1p-53);
}

double Draw::normal(double mean, double std_dev) {
  const double a = 1.0 - uniform(0.0, 1.0), b = uniform(0.0, 1.0);
  return mean + std_dev * std::sqrt(-2.0 * std::log(a)) * std::cos(2.0 * kPi * b);
}

HiddenShop::HiddenShop(std::uint64_t seed, const ShopTables& tables) : draw_(seed), tables_(tables) {
  // At h = 0.04 mm the force is the table's, times a factor with a spread of 30 %.
  const double h = 0.04;
  const double table = tables.kc11_n_mm2 * std::pow(h, 1.0 - tables.mc);
  const double truth = table * std::exp(draw_.normal(0.0, 0.3));
  thin_gain_ = draw_.uniform(0.3, 1.2);
  thin_mm_ = draw_.uniform(0.02, 0.05);
  edge_mm_ = draw_.uniform(0.003, 0.008);
  const double edge_share = draw_.uniform(0.1, 0.3);
  edge_n_mm_ = edge_share * truth;
  pressure_n_mm2_ = (1.0 - edge_share) * truth / (h * (1.0 + thin_gain_ * std::exp(-h / thin_mm_)));
  radial_ = draw_.uniform(0.25, 0.55);
  wear_gain_ = draw_.uniform(0.15, 0.5);
  softening_ = draw_.uniform(0.0, 0.2);
  stiffness_n_mm_ = 25000.0 * std::exp(draw_.normal(0.0, 0.25));
  frequency_hz_ = draw_.uniform(900.0, 2200.0);
  damping_ = draw_.uniform(0.04, 0.09);
  life_min_ = tables.life_min * std::exp(draw_.normal(0.0, 0.4));
  life_by_vc_ = draw_.uniform(2.5, 4.5);
  life_by_fz_ = draw_.uniform(0.2, 1.2);
  run_in_mm_ = draw_.uniform(0.02, 0.05);
  edge_spread_ = draw_.uniform(0.30, 0.40);
  acceleration_mm_s2_ = draw_.uniform(800.0, 4000.0);
  block_s_ = draw_.uniform(0.001, 0.006);
  block_mm_ = draw_.uniform(1.5, 20.0);
  efficiency_ = draw_.uniform(0.75, 0.9);
  idle_w_ = draw_.uniform(50.0, 200.0);
  ra_floor_um_ = draw_.uniform(0.1, 0.4);
  ra_share_ = draw_.uniform(0.6, 1.6);
}

ShopEdge HiddenShop::new_edge() {
  ShopEdge e;
  e.number = ++edges_;
  e.life_factor = std::exp(draw_.normal(0.0, edge_spread_));
  e.runout_mm = draw_.uniform(0.002, 0.012);
  e.runout_angle_rad = draw_.uniform(0.0, 2.0 * kPi);
  return e;
}

void HiddenShop::new_day() { day_mm_ = draw_.normal(0.0, 0.002); }

/// Semi-implicit Euler over the normal to the wall (y, away from it), kRevolutions turns.
HiddenShop::Vibration HiddenShop::simulated(const ShopJob& job, double rpm, double fz_mm, double wear_mm,
                                            const ShopEdge& edge, double vc_m_min) const {
  const double turn_s = 60.0 / rpm;
  const int z = job.teeth;
  int steps = static_cast<int>(std::max(240.0, 24.0 * frequency_hz_ * turn_s));
  steps += (z - steps % z) % z;  // a tooth's period is a whole number of steps
  const int tooth_steps = steps / z;
  const double dt = turn_s / steps;
  const double mass = stiffness_n_mm_ / std::pow(2.0 * kPi * frequency_hz_, 2.0);
  const double damping = 2.0 * damping_ * std::sqrt(stiffness_n_mm_ * mass);
  // Down milling along a wall at y = 0: a tooth at angle phi from the wall's normal cuts from where it enters
  // (cos phi = 1 - 2 ae / D) to phi = 0, where it leaves the wall's surface.
  const double entry = std::acos(std::clamp(1.0 - 2.0 * job.ae_mm / job.diameter_mm, -1.0, 1.0));
  const double worn = 1.0 + wear_gain_ * wear_mm / job.wear_mm;
  const double soft = std::pow(vc_m_min / tables_.vc_m_min, -softening_);
  const double slice_mm = job.ap_mm / kSlices;
  std::vector<double> runout(static_cast<std::size_t>(z));
  for (int j = 0; j < z; ++j) {
    runout[static_cast<std::size_t>(j)] =
        0.5 * edge.runout_mm * std::cos(2.0 * kPi * j / z + edge.runout_angle_rad);
  }
  const int all = steps * kRevolutions;
  std::vector<double> y(static_cast<std::size_t>(all) + 1, 0.0);
  double speed = 0.0;
  Vibration out;
  double work = 0.0, leaves = 0.0;
  int left = 0;
  for (int s = 0; s < all; ++s) {
    double fy = 0.0, fx = 0.0, ft_sum = 0.0;
    for (int j = 0; j < z; ++j) {
      for (int k = 0; k < kSlices; ++k) {
        const double lag = (k + 0.5) * slice_mm * std::tan(job.helix_rad) / (0.5 * job.diameter_mm);
        double phi = 2.0 * kPi * (static_cast<double>(s) / steps + static_cast<double>(j) / z) - lag;
        phi = entry - (phi - 2.0 * kPi * std::floor(phi / (2.0 * kPi)));  // falls through the cut
        if (phi < 0.0) continue;
        const double sine = std::sin(phi), cosine = std::cos(phi);
        double h = 1e9;
        // Tooth j at step s follows tooth j + m of m tooth periods before.
        for (int m = 1; m <= z; ++m) {
          const int before = s - m * tooth_steps;
          const double was = before >= 0 ? y[static_cast<std::size_t>(before)] : 0.0;
          h = std::min(h, m * fz_mm * sine + runout[static_cast<std::size_t>(j)] -
                              runout[static_cast<std::size_t>((j + m) % z)] -
                              (y[static_cast<std::size_t>(s)] - was) * cosine);
        }
        if (h <= 0.0) continue;
        const double ft = slice_mm * worn * soft *
                          tangential(h, pressure_n_mm2_, thin_gain_, thin_mm_, edge_n_mm_, edge_mm_);
        const double fr = radial_ * ft;
        ft_sum += ft;
        fy += fr * cosine + ft * sine;  // in down milling both push off the wall
        fx += ft * cosine - fr * sine;
      }
    }
    const double a = (fy - damping * speed - stiffness_n_mm_ * y[static_cast<std::size_t>(s)]) / mass;
    speed += a * dt;
    y[static_cast<std::size_t>(s) + 1] = y[static_cast<std::size_t>(s)] + speed * dt;
    if (s < all - kJudged * steps) continue;
    out.force_n = std::max(out.force_n, std::hypot(fx, fy));
    work += ft_sum;
    if ((s + 1) % tooth_steps == static_cast<int>(entry / (2.0 * kPi) * steps) % tooth_steps) {
      leaves += y[static_cast<std::size_t>(s) + 1];
      ++left;
    }
  }
  const double torque_nm = work / (kJudged * steps) * 0.5 * job.diameter_mm / 1000.0;
  out.power_w = idle_w_ + torque_nm * 2.0 * kPi * rpm / 60.0 / efficiency_;
  out.size_mm = left > 0 ? leaves / left : 0.0;
  double worst = 0.0;
  for (int p = 0; p < 8; ++p) {  // once per revolution, at eight angles
    double sum = 0.0, squares = 0.0;
    for (int r = 0; r < kJudged; ++r) {
      const double v = y[static_cast<std::size_t>(all - r * steps - p * steps / 8)];
      sum += v;
      squares += v * v;
    }
    worst = std::max(worst, squares / kJudged - std::pow(sum / kJudged, 2.0));
  }
  out.chatter = std::sqrt(std::max(0.0, worst)) > kChatterMm;
  return out;
}

double HiddenShop::cutting_s(const ShopJob& job, double feed_mm_min) const {
  const double v = feed_mm_min / 60.0;
  // Each block begins and ends at a third of the feed, as corners of 30 to 90 degrees do it.
  const double low = v / 3.0;
  const double ramp_mm = (v * v - low * low) / (2.0 * acceleration_mm_s2_);
  double block_s = 0.0;
  if (2.0 * ramp_mm <= block_mm_) {
    block_s = 2.0 * (v - low) / acceleration_mm_s2_ + (block_mm_ - 2.0 * ramp_mm) / v;
  } else {
    const double top = std::sqrt(low * low + acceleration_mm_s2_ * block_mm_);
    block_s = 2.0 * (top - low) / acceleration_mm_s2_;
  }
  return job.length_mm / block_mm_ * std::max(block_s, block_s_);
}

CutPart HiddenShop::cut(const ShopJob& job, double vc_m_min, double fz_mm, ShopEdge& edge) {
  const double rpm = 1000.0 * vc_m_min / (kPi * job.diameter_mm);
  const double cut_s = cutting_s(job, rpm * job.teeth * fz_mm);
  // Wear: it runs in during the first minute, then goes on evenly.
  const double life = life_min_ * edge.life_factor * std::pow(vc_m_min / tables_.vc_m_min, -life_by_vc_) *
                      std::pow(fz_mm / tables_.fz_mm, -life_by_fz_);
  const double rate = (job.wear_mm - run_in_mm_) / life * std::exp(draw_.normal(0.0, 0.1));
  const double before = edge.wear_mm;
  edge.wear_mm += rate * cut_s / 60.0 + (edge.parts == 0 ? run_in_mm_ : 0.0);
  ++edge.parts;

  const Vibration v = simulated(job, rpm, fz_mm, 0.5 * (before + edge.wear_mm), edge, vc_m_min);
  CutPart out;
  out.truth.force_n = v.force_n;
  out.truth.power_w = v.power_w;
  out.truth.size_mm = std::abs(v.size_mm + day_mm_);
  // Feed marks of the tooth that stands out most, a floor, and what the edge's wear tears.
  const double marks = 1000.0 * std::pow(fz_mm + edge.runout_mm, 2.0) / (8.0 * 0.5 * job.diameter_mm) * 0.26;
  out.truth.ra_um = (ra_floor_um_ + ra_share_ * marks) * (1.0 + 0.4 * edge.wear_mm / job.wear_mm);
  if (v.chatter) out.truth.ra_um *= 3.0;
  out.truth.wear_mm = edge.wear_mm;
  out.chatter = v.chatter;
  out.time_s = job.other_s + cut_s + 60.0 / job.parts_per_edge;

  out.seen = out.truth;
  out.seen.force_n *= std::exp(draw_.normal(0.0, 0.05));
  out.seen.power_w *= std::exp(draw_.normal(0.0, 0.03));
  out.seen.size_mm = std::abs(v.size_mm + day_mm_ + draw_.normal(0.0, 0.001));
  out.seen.ra_um *= std::exp(draw_.normal(0.0, 0.08));
  out.seen.wear_mm = std::max(0.001, out.seen.wear_mm + draw_.normal(0.0, 0.005));
  out.chatter_seen = v.chatter ? draw_.uniform(0.0, 1.0) < 0.95 : draw_.uniform(0.0, 1.0) < 0.01;
  return out;
}

}  // namespace capstan::testing
