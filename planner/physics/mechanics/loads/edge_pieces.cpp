// The pieces of edge in a section: a corner at Gauss points along its arc, the flank as one piece at its mean
// radius, each with the part of the section's arc that its own radius reaches. Derived; see section.h.
#include "planner/physics/mechanics/loads/edge_pieces.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "planner/physics/mechanics/constants.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;

double largest_sine(double from, double to) {
  if (from <= 0.5 * kPi && to >= 0.5 * kPi) return 1.0;
  return std::max(std::sin(from), std::sin(to));
}

/// An end of an arc at the full radius, as a piece of that radius reaches the same line along the feed.
double at_radius(double angle, double radius, double full_radius) {
  if (!(radius < full_radius)) return angle;
  return std::acos(std::clamp(full_radius / radius * std::cos(angle), -1.0, 1.0));
}

/// The part of an arc, or of a band, that a piece of that radius reaches.
ImmersionArc own_arc(double radius, const ImmersionArc& arc, double band, double full_radius) {
  if (!(band > 0.0)) {
    return {at_radius(arc.entry_rad, radius, full_radius), at_radius(arc.exit_rad, radius, full_radius)};
  }
  const bool left = arc.entry_rad + arc.exit_rad < kPi;
  const double wide = 2.0 * radius;
  return immersion_arc(std::min(band, wide), wide, left ? CutDirection::kUp : CutDirection::kDown);
}

double area_of(const Piece& p, double cos_from, double cos_to) {
  return p.depth * p.radius * (cos_from - cos_to);
}

void add(Pieces& all, Piece p, const ImmersionArc& arc, double band, double full_radius) {
  const ImmersionArc own = own_arc(p.radius, arc, band, full_radius);
  p.from = own.entry_rad;
  p.to = own.exit_rad;
  if (!(p.to > p.from)) return;
  all.area += area_of(p, std::cos(p.from), std::cos(p.to));
  all.edge_arc += p.edge * (p.to - p.from);
  const double front = largest_sine(p.from, p.to);
  all.front_sin = std::max(all.front_sin, front);
  all.max_chip = std::max(all.max_chip, front * p.sin_kappa);
  all.item[all.count++] = p;
}

/// Gauss-Legendre on -1 .. 1.
constexpr std::array<double, kCornerPieces> kNode = {-0.8611363115940526, -0.3399810435848563,
                                                     0.3399810435848563, 0.8611363115940526};
constexpr std::array<double, kCornerPieces> kWeight = {0.3478548451374538, 0.6521451548625461,
                                                       0.6521451548625461, 0.3478548451374538};

/// The pieces of edge from the section's lower end up to a depth, wherever the material is: without arcs.
Pieces edge_of(const Section& s, double ap, const Tooth& tooth) {
  Pieces out;
  const auto keep = [&](const Piece& p) {
    if (p.depth > 0.0 && p.radius > 0.0) out.item[out.count++] = p;
  };
  const double full = 0.5 * tooth.cutting_diameter_mm;
  const double corner = std::min(tooth.corner_radius_mm, full);
  const double lag_per_mm = helix_lag_rad(1.0, tooth.cutting_diameter_mm, tooth.helix_rad);
  const double low = s.from_tip_mm;
  const double high = low + ap;
  if (low < corner) {
    const double from = immersion_angle_rad(low, 2.0 * corner);
    const double to = immersion_angle_rad(std::min(high, corner), 2.0 * corner);
    double z = low;
    for (std::size_t i = 0; i < kCornerPieces; ++i) {
      const double psi = 0.5 * (from + to) + 0.5 * (to - from) * kNode[i];
      const double d = 0.5 * (to - from) * kWeight[i];
      Piece p;
      p.sin_kappa = std::sin(psi);
      p.cos_kappa = std::cos(psi);
      p.edge = corner * d;
      p.depth = p.edge * p.sin_kappa;
      p.radius = full - corner + corner * p.sin_kappa;
      p.lag_low = lag_per_mm * (z - low);
      z += p.depth;
      p.lag_high = lag_per_mm * (z - low);
      keep(p);
    }
  }
  const double flank_low = std::max(low, corner);
  if (high > flank_low) {
    const double lean = tooth.lead_angle_rad + tooth.taper_angle_rad;
    Piece p;
    p.depth = high - flank_low;
    p.sin_kappa = std::cos(lean);
    p.cos_kappa = std::sin(lean);
    p.edge = p.depth / p.sin_kappa;
    p.radius = full + (0.5 * (flank_low + high) - corner) * std::tan(lean);
    p.lag_low = lag_per_mm * (flank_low - low);
    p.lag_high = lag_per_mm * (high - low);
    keep(p);
  }
  return out;
}

/// Those of them that meet the arc, or the band.
Pieces pieces_in(const Pieces& edge, const ImmersionArc& arc, double band, double full_radius) {
  Pieces out;
  for (std::size_t i = 0; i < edge.count; ++i) add(out, edge.item[i], arc, band, full_radius);
  return out;
}

/// The area of `pieces_in` alone. `left`, `right`: the ends of the strip across the feed, which are the
/// cosines of its arc times the full radius; a band has none.
double area_in(const Pieces& edge, double left, double right, const ImmersionArc& arc, double band,
               double full_radius) {
  double out = 0.0;
  for (std::size_t i = 0; i < edge.count; ++i) {
    const Piece& p = edge.item[i];
    if (band > 0.0) {
      const ImmersionArc own = own_arc(p.radius, arc, band, full_radius);
      if (own.exit_rad > own.entry_rad) out += area_of(p, std::cos(own.entry_rad), std::cos(own.exit_rad));
      continue;
    }
    const double radius = std::min(p.radius, full_radius);
    const double from = std::min(left / radius, 1.0), to = std::max(right / radius, -1.0);
    if (from > to) out += area_of(p, from, to);
  }
  return out;
}

}  // namespace

Contact contact_of(const Section& s, double d) {
  Contact c{s.ap_mm, s.arc};
  const double turns = std::floor((c.arc.entry_rad + 0.5 * kPi) / (2.0 * kPi));
  c.arc.entry_rad = std::clamp(c.arc.entry_rad - turns * 2.0 * kPi, 0.0, kPi);
  c.arc.exit_rad = std::clamp(c.arc.exit_rad - turns * 2.0 * kPi, 0.0, kPi);
  if (!(s.csa_mm2 > 0.0)) return c;
  const bool no_arc = !(c.arc.exit_rad > c.arc.entry_rad);
  if (!(c.ap > 0.0)) {
    const double width = no_arc ? d : 0.5 * d * (std::cos(c.arc.entry_rad) - std::cos(c.arc.exit_rad));
    c.ap = std::min(s.csa_mm2 / width, d);
  }
  if (no_arc) {
    const double half = std::asin(std::min(1.0, s.csa_mm2 / (c.ap * d)));
    c.arc = {0.5 * kPi - half, 0.5 * kPi + half};
  }
  return c;
}

Pieces met_by(const Section& s, const Contact& c, const Tooth& tooth) {
  const Pieces edge = edge_of(s, c.ap, tooth);
  const double full = 0.5 * tooth.cutting_diameter_mm;
  Pieces all = pieces_in(edge, c.arc, s.band_mm, full);
  const double corner = std::min(tooth.corner_radius_mm, full);
  if (!(corner > 0.0)) return all;
  const double strip = full * (std::cos(c.arc.entry_rad) - std::cos(c.arc.exit_rad));
  const double wanted = s.csa_mm2 > 0.0 ? s.csa_mm2 : (all.area > 0.0 ? 0.0 : c.ap * strip);
  constexpr double kRounding = 1e-9;
  if (all.area >= wanted * (1.0 - kRounding)) return all;
  const double top = s.from_tip_mm + c.ap;
  const double reach = std::min(full, 0.5 * effective_diameter_mm(top, tooth.cutting_diameter_mm, corner));
  // Ends of the strip across the feed, positive to the left.
  double left = std::clamp(full * std::cos(c.arc.entry_rad), -reach, reach);
  double right = std::clamp(full * std::cos(c.arc.exit_rad), -reach, reach);
  double band = s.band_mm;
  const auto between = [&] {
    return band > 0.0
               ? c.arc
               : ImmersionArc{std::acos(std::min(left / full, 1.0)), std::acos(std::max(right / full, -1.0))};
  };
  const auto move = [&](double& end, double most) {
    const double from = end;
    end = most;
    all = pieces_in(edge, between(), band, full);
    if (all.area < wanted) return false;
    double enough = 1.0;
    double less = 0.0;
    constexpr int kHalvings = 24;
    for (int i = 0; i < kHalvings; ++i) {
      const double t = 0.5 * (less + enough);
      end = from + t * (most - from);
      (area_in(edge, left, right, c.arc, band, full) >= wanted ? enough : less) = t;
    }
    end = from + enough * (most - from);
    if (enough < 1.0) all = pieces_in(edge, between(), band, full);
    return true;
  };
  if (band > 0.0) {
    move(band, 2.0 * reach);
    return all;
  }
  const bool leans_left = left + right >= 0.0;
  if (!move(leans_left ? right : left, leans_left ? -reach : reach))
    move(leans_left ? left : right, leans_left ? reach : -reach);
  return all;
}

}  // namespace capstan::mechanics
