#pragma once

#include <cmath>

/// Taylor's tool life and the speeds that follow from it.
///
/// Needs     positive finite arguments, 0 < n < 1. The constants come with the tool or the case base; none
///           is given here, for they hold for one pair of tool and work only.
/// Uncertainty  lives of equal edges scatter by 20 to 30 % (standard deviation of ln T), see life.h.
/// Source    F. W. Taylor 1907 in its extended form; speeds: Ghosh & Mallik, Manufacturing Science,
///           section 4 (derivative of cost and of time per piece set to zero).
namespace capstan::mechanics {

/// v T^n f^p a^q = C, v in m/min, T in min, f and a in mm.
struct TaylorLife {
  double c = 0.0;
  double n = 0.0;
  double p = 0.0;
  double q = 0.0;
};

/// T = (C / (v f^p a^q))^(1 / n), min.
template <class T>
[[nodiscard]] T tool_life_min(const TaylorLife& life, const T& speed_m_min, const T& feed_mm,
                              const T& depth_mm) {
  using std::pow;
  return pow(life.c / (speed_m_min * pow(feed_mm, life.p) * pow(depth_mm, life.q)), 1.0 / life.n);
}

/// C f^-p a^-q: the speed for a life of one minute.
[[nodiscard]] inline double one_minute_speed_m_min(const TaylorLife& life, double feed_mm, double depth_mm) {
  return life.c * std::pow(feed_mm, -life.p) * std::pow(depth_mm, -life.q);
}

/// The speed for a wanted life.
[[nodiscard]] inline double speed_for_life_m_min(const TaylorLife& life, double life_min, double feed_mm,
                                                 double depth_mm) {
  return one_minute_speed_m_min(life, feed_mm, depth_mm) * std::pow(life_min, -life.n);
}

/// What a worn edge costs.
struct EdgeCost {
  double machine_per_min = 0.0;  ///< machine and labour
  double change_min = 0.0;       ///< time to change the edge
  double edge = 0.0;             ///< one edge, regrinding included; the currency of machine_per_min
};

/// The speed of least cost: C f^-p a^-q [ n / (1 - n) r / (r t + c) ]^n.
[[nodiscard]] inline double min_cost_speed_m_min(const TaylorLife& life, const EdgeCost& cost,
                                                 double feed_mm = 1.0, double depth_mm = 1.0) {
  const double per_edge = cost.machine_per_min * cost.change_min + cost.edge;
  return one_minute_speed_m_min(life, feed_mm, depth_mm) *
         std::pow(life.n / (1.0 - life.n) * cost.machine_per_min / per_edge, life.n);
}

/// The speed of most pieces per time: C f^-p a^-q [ n / ((1 - n) t) ]^n.
[[nodiscard]] inline double max_production_speed_m_min(const TaylorLife& life, double change_min,
                                                       double feed_mm = 1.0, double depth_mm = 1.0) {
  return one_minute_speed_m_min(life, feed_mm, depth_mm) *
         std::pow(life.n / ((1.0 - life.n) * change_min), life.n);
}

}  // namespace capstan::mechanics
