#pragma once

#include <cstdint>
#include <random>

namespace capstan::testing {

/// Random numbers that are the same with every standard library.
class Draw {
 public:
  explicit Draw(std::uint64_t seed) : engine_(seed) {}
  [[nodiscard]] double uniform(double low, double high);
  [[nodiscard]] double normal(double mean, double std_dev);

 private:
  std::mt19937_64 engine_;
};

/// What the shop is asked to cut: a shoulder along a wall, by one end mill. mm, rad.
struct ShopJob {
  double diameter_mm = 10.0, helix_rad = 0.52, ap_mm = 6.0, ae_mm = 2.0;
  int teeth = 4;
  double length_mm = 2500.0;  ///< of the path, in all
  double other_s = 20.0;      ///< what is not cutting
  int parts_per_edge = 4;     ///< then a new edge is put in, worn or not
  // The limits, as somebody who could measure everything would judge them.
  double force_n = 0.0, power_w = 0.0, size_mm = 0.0, ra_um = 0.0, wear_mm = 0.3;
};

/// What the planner's tables expect of this material, about which the truth is drawn.
struct ShopTables {
  double kc11_n_mm2 = 1800.0, mc = 0.2;
  double life_min = 15.0, vc_m_min = 120.0, fz_mm = 0.06;
};

/// One edge in the spindle.
struct ShopEdge {
  int number = 0, parts = 0;
  double wear_mm = 0.0, life_factor = 1.0;
  double runout_mm = 0.0, runout_angle_rad = 0.0;
};

/// What truly happened, and what the shop's instruments say of it.
struct Loads {
  double force_n = 0.0, power_w = 0.0, size_mm = 0.0, ra_um = 0.0, wear_mm = 0.0;
};
struct CutPart {
  Loads truth, seen;
  double time_s = 0.0;  ///< of the whole part, with its share of changing edges
  bool chatter = false, chatter_seen = false;
};

/// A shop whose physics is hidden from the tuner, and not the planner's.
///
/// The cutter is a mass on a spring, moved through the material in steps of time. Each tooth has its own
/// radius (runout); its chip is what the last teeth, as they vibrated, have left. The force is no power law:
/// a pressure that rises exponentially in thin chips, and an edge force that saturates, both growing with
/// wear. Wear runs in fast and then goes on by a law of its own exponents, by an edge-to-edge factor with a
/// spread of at least 30 %. The machine accelerates block by block. Size moves with the day's temperature.
/// Chatter is what the simulation in time shows, no formula.
class HiddenShop {
 public:
  HiddenShop(std::uint64_t seed, const ShopTables& tables);

  [[nodiscard]] ShopEdge new_edge();
  /// A new day: the machine has another temperature.
  void new_day();
  [[nodiscard]] CutPart cut(const ShopJob& job, double vc_m_min, double fz_mm, ShopEdge& edge);

 private:
  struct Vibration {
    double force_n = 0.0, power_w = 0.0, size_mm = 0.0;
    bool chatter = false;
  };
  [[nodiscard]] Vibration simulated(const ShopJob& job, double rpm, double fz_mm, double wear_mm,
                                    const ShopEdge& edge, double vc_m_min) const;
  [[nodiscard]] double cutting_s(const ShopJob& job, double feed_mm_min) const;

  Draw draw_;
  ShopTables tables_;
  int edges_ = 0;
  double day_mm_ = 0.0;
  // The hidden truth.
  double pressure_n_mm2_, thin_gain_, thin_mm_, edge_n_mm_, edge_mm_, radial_, wear_gain_, softening_;
  double stiffness_n_mm_, frequency_hz_, damping_;
  double life_min_, life_by_vc_, life_by_fz_, run_in_mm_, edge_spread_;
  double acceleration_mm_s2_, block_s_, block_mm_, efficiency_, idle_w_;
  double ra_floor_um_, ra_share_;
};

}  // namespace capstan::testing
