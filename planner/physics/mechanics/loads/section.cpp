#include "planner/physics/mechanics/loads/section.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

#include "planner/physics/mechanics/constants.h"
#include "planner/physics/mechanics/force/domain.h"
#include "planner/physics/mechanics/loads/edge_pieces.h"

namespace capstan::mechanics {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr std::size_t kCells = 32;    // of the arc
constexpr int kSamples = 32;          // of a tooth pitch
constexpr double kNoLagRad = 1e-6;    // below, an edge is straight to within rounding
constexpr double kJustInside = 1e-9;  // keeps rounding from losing a tooth that is about to leave

/// Chip and edge integrals: shape times cos, times sin, and alone; the same with the shape 1.
struct Integrals {
  double c = 0.0, s = 0.0, one = 0.0;
  double ec = 0.0, es = 0.0, e1 = 0.0;
};

/// The shape of the tangential force over the arc, sin^(1 - mc), and its running integrals on a grid; linear
/// between, so that the mean over a lag goes to the value without a jump as the lag goes to nothing.
class ArcTable {
 public:
  ArcTable(double from, double to, double mc)
      : from_(from), step_((to - from) / static_cast<double>(kCells)), edges_(mc == 0.0) {
    const double turn_c = std::cos(step_);
    const double turn_s = std::sin(step_);
    double sine = std::sin(from);
    double cosine = std::cos(from);
    for (std::size_t i = 0; i <= kCells; ++i) {
      const double a = from + step_ * static_cast<double>(i);
      const double safe = std::max(sine, 0.0);
      const double shape = mc == 0.0 ? safe : (safe > 0.0 ? std::exp((1.0 - mc) * std::log(safe)) : 0.0);
      Integrals& f = value_[i];
      f = {shape * cosine, shape * safe, shape, cosine, sine, 1.0};
      Integrals& r = running_[i];
      r.c = shape * safe / (2.0 - mc);  // exact
      if (edges_) {
        r.s = 0.5 * (a - sine * cosine);
        r.one = -cosine;
        r.ec = sine;
        r.es = -cosine;
        r.e1 = a;
      } else if (i > 0) {
        r.s = running_[i - 1].s + 0.5 * step_ * (value_[i - 1].s + f.s);
        r.one = running_[i - 1].one + 0.5 * step_ * (value_[i - 1].one + f.one);
      }
      if (i > 0) {
        const Integrals& e = value_[i - 1];
        const Integrals& q = running_[i - 1];
        const double half = 0.5 * step_;
        short_[i - 1] = {r.c - q.c - half * (e.c + f.c),         r.s - q.s - half * (e.s + f.s),
                         r.one - q.one - half * (e.one + f.one), r.ec - q.ec - half * (e.ec + f.ec),
                         r.es - q.es - half * (e.es + f.es),     0.0};
      }
      const double next = sine * turn_c + cosine * turn_s;
      cosine = cosine * turn_c - sine * turn_s;
      sine = next;
    }
  }

  [[nodiscard]] Integrals upto(double a) const {
    const auto [i, t] = place(a);
    const double late = 0.5 * t * t * step_;
    const double early = t * step_ - late;
    const Integrals& f = value_[i];
    const Integrals& g = value_[i + 1];
    const Integrals& r = running_[i];
    const Integrals& k = short_[i];
    Integrals out{r.c + early * f.c + late * g.c + t * k.c, r.s + early * f.s + late * g.s + t * k.s,
                  r.one + early * f.one + late * g.one + t * k.one};
    if (edges_) {
      out.ec = r.ec + early * f.ec + late * g.ec + t * k.ec;
      out.es = r.es + early * f.es + late * g.es + t * k.es;
      out.e1 = r.e1 + early + late;
    }
    return out;
  }

  [[nodiscard]] Integrals at(double a) const {
    if (edges_) {
      const double c = std::cos(a);
      const double s = std::sin(a);
      return {s * c, s * s, s, c, s, 1.0};
    }
    const auto [i, t] = place(a);
    const Integrals& f = value_[i];
    const Integrals& g = value_[i + 1];
    return {f.c + t * (g.c - f.c), f.s + t * (g.s - f.s), f.one + t * (g.one - f.one)};
  }

 private:
  [[nodiscard]] std::pair<std::size_t, double> place(double a) const {
    const double s = std::clamp((a - from_) / step_, 0.0, static_cast<double>(kCells));
    const std::size_t i = std::min(static_cast<std::size_t>(s), kCells - 1);
    return {i, s - static_cast<double>(i)};
  }

  double from_, step_;
  bool edges_;
  std::array<Integrals, kCells + 1> value_;
  std::array<Integrals, kCells + 1> running_;
  std::array<Integrals, kCells> short_;  // what the trapezium of a cell lacks of the exact integral
};

Integrals less(const Integrals& b, const Integrals& a) {
  return {b.c - a.c, b.s - a.s, b.one - a.one, b.ec - a.ec, b.es - a.es, b.e1 - a.e1};
}

/// The running integrals at both ends of each piece's arc, where most lags are cut off.
struct Ends {
  std::array<Integrals, kCornerPieces + 1> from, to;
  Ends(const Pieces& all, const ArcTable& table) {
    for (std::size_t k = 0; k < all.count; ++k) {
      from[k] = table.upto(all.item[k].from);
      to[k] = table.upto(all.item[k].to);
    }
  }
};

struct Moment {
  ForceVector force;
  double torque_nmm = 0.0;
};

void add(Moment& m, const Piece& p, const Integrals& i, double weight) {
  const double cos_t = p.ct * i.c + p.et * i.ec;
  const double sin_t = p.ct * i.s + p.et * i.es;
  m.force.fx_n += weight * (-cos_t - p.cr * i.s - p.er * i.es);
  m.force.fy_n += weight * (sin_t - p.cr * i.c - p.er * i.ec);
  m.force.fz_n += weight * (p.ca * i.one + p.ea * i.e1);
  m.torque_nmm += weight * p.radius * (p.ct * i.one + p.et * i.e1);
}

/// What one piece of the edge of one tooth adds at an angle: its integrals over the lag.
struct Part {
  std::size_t piece = 0;
  double weight = 0.0;
  Integrals of;
};

/// What all teeth add with the tip of one at an angle.
void append_parts(std::vector<Part>& parts, const Pieces& all, const ArcTable& table, const Ends& ends,
                  double tip, double pitch) {
  for (std::size_t k = 0; k < all.count; ++k) {
    const Piece& p = all.item[k];
    const double lag = p.lag_high - p.lag_low;
    const double middle = 0.5 * (p.lag_low + p.lag_high);
    if (lag < kNoLagRad) {
      const double first = p.from + middle;
      for (double a = tip - pitch * std::floor((tip - first) / pitch) - middle; a <= p.to; a += pitch)
        parts.push_back({k, 1.0, table.at(a)});
      continue;
    }
    const double first = p.from + p.lag_low;
    for (double a = tip - pitch * std::floor((tip - first) / pitch); a <= p.to + p.lag_high; a += pitch) {
      const double from = std::max(p.from, a - p.lag_high);
      const double to = std::min(p.to, a - p.lag_low);
      if (from < to) {
        parts.push_back({k, 1.0 / lag,
                         less(to == p.to ? ends.to[k] : table.upto(to),
                              from == p.from ? ends.from[k] : table.upto(from))});
      }
    }
  }
}

void keep_larger(double& largest, double value) {
  if (std::abs(value) > std::abs(largest)) largest = value;
}

struct Peak {
  ForceVector force;
  double plane_sq = 0.0, torque_nmm = 0.0;

  void take(const Moment& m) {
    keep_larger(force.fx_n, m.force.fx_n);
    keep_larger(force.fy_n, m.force.fy_n);
    keep_larger(force.fz_n, m.force.fz_n);
    plane_sq = std::max(plane_sq, m.force.fx_n * m.force.fx_n + m.force.fy_n * m.force.fy_n);
    torque_nmm = std::max(torque_nmm, m.torque_nmm);
  }
};

/// Angles of a pitch with what all teeth add there.
struct Angles {
  std::vector<Part> parts;
  std::vector<std::size_t> ends;  ///< of each angle, in `parts`
};

Angles angles_of(const Pieces& all, const ArcTable& table, const Ends& ends, int teeth) {
  const double pitch = 2.0 * kPi / teeth;
  Angles out;
  const auto at = [&](double tip) {
    append_parts(out.parts, all, table, ends, tip, pitch);
    out.ends.push_back(out.parts.size());
  };
  out.ends.reserve(kSamples + 3 * all.count);
  out.parts.reserve((kSamples + 3 * all.count) * 2 * all.count);
  const double start = all.item[0].from;
  for (int i = 0; i < kSamples; ++i) at(start + pitch * i / kSamples);
  // Extremes also sit where a piece of edge enters or leaves.
  for (std::size_t k = 0; k < all.count; ++k) {
    const Piece& p = all.item[k];
    at(p.to + p.lag_low - kJustInside);
    if (p.lag_high - p.lag_low < kNoLagRad) continue;
    at(p.from + p.lag_high);
    at(p.to + p.lag_high - kJustInside);
  }
  return out;
}

Peak peak_of(const Pieces& all, const Angles& angles) {
  Peak peak;
  std::size_t i = 0;
  for (const std::size_t end : angles.ends) {
    Moment sum;
    for (; i < end; ++i) {
      const Part& part = angles.parts[i];
      add(sum, all.item[part.piece], part.of, part.weight);
    }
    peak.take(sum);
  }
  return peak;
}

void set_force(Pieces& all, const ForceLaw& law, double helix_rad, double fz) {
  const double chip = law.mechanistic ? fz : law.kienzle.kc11_n_mm2 * std::pow(fz, 1.0 - law.kienzle.mc);
  for (std::size_t i = 0; i < all.count; ++i) {
    Piece& p = all.item[i];
    double kt = 1.0, kr = 0.0, ka = 0.0;
    if (law.mechanistic) {
      const CuttingCoefficients& k = *law.mechanistic;
      kt = k.ktc_n_mm2;
      kr = k.krc_n_mm2;
      ka = k.kac_n_mm2;
      p.et = k.kte_n_mm * p.edge;
      p.er = (k.kre_n_mm * p.sin_kappa + k.kae_n_mm * p.cos_kappa) * p.edge;
      p.ea = (k.kae_n_mm * p.sin_kappa - k.kre_n_mm * p.cos_kappa) * p.edge;
    } else {
      kt = p.sin_kappa == 1.0 ? 1.0 : std::pow(p.sin_kappa, -law.kienzle.mc);
      kr = kRadialToTangentialRatio * kt;
      ka = kAxialToTangentialRatio * std::tan(helix_rad) * kt;
    }
    const double per = chip * p.depth;
    p.ct = kt * per;
    p.cr = (kr * p.sin_kappa + ka * p.cos_kappa) * per;
    p.ca = (ka * p.sin_kappa - kr * p.cos_kappa) * per;
  }
}

constexpr double kSteepestHelixRad = 1.3962634015954636;  // 80 degrees: tan stays moderate
constexpr double kMostTeeth = 1000.0;                     // so that no sum over teeth is endless
constexpr double kMostLagRad = 1000.0;                    // 160 turns of an edge: no cutter
constexpr double kMostInCut = 10'000.0;                   // teeth and turns of their edges: memory has an end
constexpr double kFlattestLeadRad = 1.5;                  // 86 degrees

bool is_plunge(const ImmersionArc& arc) { return arc.exit_rad - arc.entry_rad >= 2.0 * kPi - 1e-6; }

SectionLoads plunge_loads(const Section& s, const Tooth& t, const ForceLaw& law, double fz, double n) {
  SectionLoads out;
  const double d = t.cutting_diameter_mm;
  const double disc = 0.25 * kPi * d * d;
  const double area = s.csa_mm2 > 0.0 ? std::min(s.csa_mm2, disc) : disc;
  const double kc = law.mechanistic ? law.mechanistic->ktc_n_mm2 + law.mechanistic->kte_n_mm / fz
                                    : specific_force_n_mm2(law.kienzle, fz);
  out.h_max_mm = out.h_mean_mm = fz;
  out.power_w = cutting_power_w(area * fz * t.teeth * n, kc);
  out.torque_nm = spindle_torque_nm(out.power_w, n);
  out.peak_torque_nm = out.torque_nm;
  out.mean.fz_n = out.peak.fz_n = -kDrillThrustFactor * kc * fz * t.teeth * 0.5 * d;
  const double one_tooth = kc * fz * 0.5 * d;
  out.peak_force_n = one_tooth * std::hypot(1.0, kRadialToTangentialRatio);
  out.peak.fx_n = out.peak.fy_n = out.peak_force_n;
  return out;
}

/// The feed at which an even cutter has the thickest chip of one that runs out.
double widened_feed(double fz, double runout_mm, int teeth, double front_sin) {
  if (!(runout_mm > 0.0) || !(front_sin > 0.0)) return fz;
  const double shift = runout_mm * std::sin(kPi / teeth);
  return std::min(fz + shift / front_sin, fz * teeth);
}

ForceVector scaled(const ForceVector& f, double k) { return {f.fx_n * k, f.fy_n * k, f.fz_n * k}; }

Status check_feed(double fz, double n) { return check_positive({{"fz_mm", fz}, {"n_rpm", n}}); }

}  // namespace

Status check_shape(const Section& s, const Tooth& t, const ForceLaw& law) {
  constexpr double kMost = 1e9;
  if (auto ok = check_positive(
          {{"cutting_diameter_mm", t.cutting_diameter_mm}, {"teeth", static_cast<double>(t.teeth)}});
      !ok)
    return ok;
  for (const Named& v : {Named{"ap_mm", s.ap_mm}, Named{"csa_mm2", s.csa_mm2},
                         Named{"from_tip_mm", s.from_tip_mm}, Named{"band_mm", s.band_mm},
                         Named{"corner_radius_mm", t.corner_radius_mm}, Named{"runout_mm", t.runout_mm}})
    if (auto ok = check_range(v, 0.0, kMost); !ok) return ok;
  if (auto ok = check_range({"helix_rad", std::abs(t.helix_rad)}, 0.0, kSteepestHelixRad); !ok) return ok;
  if (auto ok = check_range({"lead_angle_rad", t.lead_angle_rad + t.taper_angle_rad}, 0.0, kFlattestLeadRad);
      !ok)
    return ok;
  if (auto ok = check_range({"entry_rad", s.arc.entry_rad}, -kMost, kMost); !ok) return ok;
  if (auto ok = check_range({"arc", s.arc.exit_rad - s.arc.entry_rad}, 0.0, 2.0 * kPi + 1e-9); !ok) return ok;
  if (auto ok = check_range({"teeth", static_cast<double>(t.teeth)}, 1.0, kMostTeeth); !ok) return ok;
  const double lag = helix_lag_rad(s.ap_mm, t.cutting_diameter_mm, std::abs(t.helix_rad));
  if (auto ok = check_range({"lag of the helix, rad", lag}, 0.0, kMostLagRad); !ok) return ok;
  if (auto ok = check_range({"teeth in the cut", t.teeth * (1.0 + lag / (2.0 * kPi))}, 0.0, kMostInCut); !ok)
    return ok;
  if (law.mechanistic) {
    const CuttingCoefficients& k = *law.mechanistic;
    if (auto ok = check_positive({{"ktc_n_mm2", k.ktc_n_mm2}}); !ok) return ok;
    for (const Named& v :
         {Named{"kte_n_mm", k.kte_n_mm}, Named{"krc_n_mm2", k.krc_n_mm2}, Named{"kre_n_mm", k.kre_n_mm},
          Named{"kac_n_mm2", k.kac_n_mm2}, Named{"kae_n_mm", k.kae_n_mm}})
      if (auto ok = check_range(v, 0.0, kMost); !ok) return ok;
    return {};
  }
  if (auto ok = check_positive({{"kc11_n_mm2", law.kienzle.kc11_n_mm2}}); !ok) return ok;
  return check_range({"mc", law.kienzle.mc}, 0.0, 0.999);
}

namespace {

/// The edge that is in a section.
struct EdgeIn {
  bool plunge = false;
  bool nothing = true;  ///< no engagement: no loads
  Pieces all;
  double ratio = 1.0;  ///< of the area to what the edge sweeps
};

Result<EdgeIn> edge_in(const Section& section, const Tooth& tooth, const ForceLaw& law) {
  if (auto ok = check_shape(section, tooth, law); !ok) return fail(ok.error());
  EdgeIn out;
  if (is_plunge(section.arc)) {
    out.plunge = true;
    out.nothing = !(section.ap_mm > 0.0) && !(section.csa_mm2 > 0.0);
    return out;
  }
  const Contact contact = contact_of(section, tooth.cutting_diameter_mm);
  if (!(contact.ap > 0.0) || !(contact.arc.exit_rad > contact.arc.entry_rad)) return out;
  out.all = met_by(section, contact, tooth);
  if (out.all.count == 0 || !(out.all.area > 0.0)) {
    if (!(section.csa_mm2 > 0.0)) return out;
    return fail(Diagnostic{.code = "MECH-DOMAIN",
                           .message = "an area of " + told(section.csa_mm2) + " mm2 at a depth of " +
                                      told(contact.ap) + " mm where no edge is",
                           .path = "csa_mm2",
                           .expected = "an area that the edge can sweep"});
  }
  out.nothing = false;
  out.ratio = section.csa_mm2 > 0.0 ? section.csa_mm2 / out.all.area : 1.0;
  return out;
}

/// The thickest chip of an even cutter over the feed per tooth.
double over_feed(const EdgeIn& edge) { return edge.ratio > 1.0 + kIrregular ? 1.0 : edge.all.max_chip; }

}  // namespace

Result<ThickestChip> ThickestChip::of(const Section& section, const Tooth& tooth, const ForceLaw& law) {
  const auto edge = edge_in(section, tooth, law);
  if (!edge) return fail(edge.error());
  ThickestChip out;
  out.plunge_ = edge->plunge;
  out.nothing_ = edge->nothing;
  out.runout_mm_ = tooth.runout_mm;
  out.teeth_ = tooth.teeth;
  out.front_sin_ = edge->all.front_sin;
  out.over_feed_ = over_feed(*edge);
  return out;
}

double ThickestChip::at_mm(double fz_mm) const {
  if (nothing_) return 0.0;
  return plunge_ ? fz_mm : widened_feed(fz_mm, runout_mm_, teeth_, front_sin_) * over_feed_;
}

/// What of a section is the same at every feed.
struct SectionAtFeeds::Shape {
  Section section;
  Tooth tooth;
  ForceLaw law;
  EdgeIn edge;
  double more = 1.0, less = 1.0;
  std::array<Integrals, kCornerPieces + 1> whole;  ///< of each piece over its own arc
  Angles angles;
  double mean_chip = 0.0;
};

Result<SectionAtFeeds> SectionAtFeeds::of(const Section& section, const Tooth& tooth, const ForceLaw& law) {
  auto edge = edge_in(section, tooth, law);
  if (!edge) return fail(edge.error());
  auto made = std::make_shared<Shape>();
  Shape& shape = *made;
  shape.section = section;
  shape.tooth = tooth;
  shape.law = law;
  shape.edge = *std::move(edge);
  SectionAtFeeds out;
  out.shape_ = made;
  if (shape.edge.plunge || shape.edge.nothing) return out;
  const Pieces& all = shape.edge.all;
  shape.more = std::max(shape.edge.ratio, 1.0);
  const double mc = law.mechanistic ? 0.0 : law.kienzle.mc;
  shape.less = shape.edge.ratio < 1.0 ? std::pow(shape.edge.ratio, 1.0 - mc) : shape.edge.ratio;
  double from = all.item[0].from;
  double to = all.item[0].to;
  for (std::size_t i = 1; i < all.count; ++i) {
    from = std::min(from, all.item[i].from);
    to = std::max(to, all.item[i].to);
  }
  const ArcTable table(from, to, mc);
  const Ends ends(all, table);
  for (std::size_t i = 0; i < all.count; ++i) {
    const Piece& p = all.item[i];
    shape.whole[i] = less(ends.to[i], ends.from[i]);
    shape.mean_chip += p.depth * (std::cos(p.from) - std::cos(p.to));
  }
  shape.angles = angles_of(all, table, ends, tooth.teeth);
  return out;
}

Result<SectionLoads> SectionAtFeeds::at(double fz_mm, double n_rpm) const {
  if (auto ok = check_feed(fz_mm, n_rpm); !ok) return fail(ok.error());
  const Shape& s = *shape_;
  SectionLoads out;
  if (s.edge.nothing) return out;
  if (s.edge.plunge) return plunge_loads(s.section, s.tooth, s.law, fz_mm, n_rpm);
  Pieces all = s.edge.all;
  set_force(all, s.law, s.tooth.helix_rad, fz_mm);
  const double per_turn = s.tooth.teeth / (2.0 * kPi);
  Moment mean;
  for (std::size_t i = 0; i < all.count; ++i) {
    const Piece& p = all.item[i];
    const Integrals& sum = s.whole[i];
    add(mean, p, sum, per_turn);
    out.torque_nm += 1e-3 * per_turn * p.radius * (s.less * p.ct * sum.one + s.more * p.et * sum.e1);
  }
  out.mean = scaled(mean.force, s.more);
  out.power_w = out.torque_nm * 2.0 * kPi * n_rpm / 60.0;

  const double widened = widened_feed(fz_mm, s.tooth.runout_mm, s.tooth.teeth, all.front_sin);
  if (widened != fz_mm) set_force(all, s.law, s.tooth.helix_rad, widened);
  const Peak peak = peak_of(all, s.angles);
  out.peak = scaled(peak.force, s.more);
  out.peak_force_n = s.more * std::sqrt(peak.plane_sq);
  out.peak_torque_nm = std::max(1e-3 * s.more * peak.torque_nmm, out.torque_nm);
  out.h_max_mm = widened * over_feed(s.edge);
  out.h_mean_mm = fz_mm * s.mean_chip / all.edge_arc;
  return out;
}

}  // namespace capstan::mechanics
