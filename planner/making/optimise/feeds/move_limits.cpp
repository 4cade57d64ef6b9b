#include "planner/making/optimise/feeds/move_limits.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "planner/model/plan/cutter/ramp.h"

namespace capstan::optimise::feed {
namespace {

using model::MoveKind;
using model::MoveRole;

constexpr double kAnyFeed = std::numeric_limits<double>::infinity();

/// The combined limits of the samples of one move.
struct OnMove {
  bool cuts = false;  ///< sideways somewhere
  bool plunges = false;
  double plunged_mm2 = 0.0;  ///< most that a plunge cuts; 0: one of them is not known
  bool known = true;  ///< all of its sections lie within the formulas' range
  Column at_limit{};
  std::array<double, kLimits> more{};
};

OnMove on_move(const FeedQuestion& q, CutClasses& classes, std::size_t move, std::size_t& next) {
  OnMove out;
  out.at_limit.fill(kAnyFeed);
  out.more.fill(kAnyFeed);
  const double n = rpm_on(q, move);
  for (; next < q.samples.size() && q.samples[next].move <= move; ++next) {
    const CutSample& s = q.samples[next];
    if (s.move != move || !(s.ap_mm > 0.0)) continue;
    if (s.plunge) {
      const double area = plunged_mm2(s);
      const bool solid = !(area > 0.0) || (out.plunges && !(out.plunged_mm2 > 0.0));
      out.plunged_mm2 = solid ? 0.0 : std::max(out.plunged_mm2, area);
      out.plunges = true;
      continue;
    }
    out.cuts = true;
    const SampleFeed b = sample_feed(classes, s, q.cut, n);
    out.known = out.known && b.known;
    for (std::size_t k = 0; k < kLimits; ++k) {
      out.at_limit[k] = std::min(out.at_limit[k], b.at_limit[k]);
      double with_more = b.at_more[k];
      for (std::size_t j = 0; j < kLimits; ++j) {
        if (j != k) with_more = std::min(with_more, b.at_limit[j]);
      }
      out.more[k] = std::min(out.more[k], with_more);
    }
  }
  return out;
}

void bound(Cap& cap, double feed, FeedBound by) {
  for (double& m : cap.more) m = std::min(m, feed);
  if (feed >= cap.feed_mm_min) return;
  cap.feed_mm_min = feed;
  cap.by = by;
}

/// The planned feed or the bound of thinning, as the path asks for it.
Cap open_cap(double feed) {
  Cap cap;
  cap.feed_mm_min = feed;
  cap.more.fill(feed);
  cap.more[static_cast<std::size_t>(FeedBound::kStepFeed)] = kMoreOfALimit * feed;
  return cap;
}

/// A share of a feed; infinite if the feed is not bounded.
double part(double share, double feed) { return std::isfinite(feed) ? share * feed : feed; }

void bound_by_sections(Cap& cap, const OnMove& m, const CutLoads& loads, double share) {
  const double ceiling = cap.feed_mm_min;
  for (std::size_t k = 0; k < kLimits; ++k) {
    const double feed = std::max(part(share, m.at_limit[k]), std::min(loads.floor_mm_min(), ceiling));
    if (feed < cap.feed_mm_min) {
      cap.feed_mm_min = feed;
      // If no load can be computed, every limit counts as reached, also those that are not stated.
      cap.by = stated(loads.limits()[k]) && m.known ? static_cast<FeedBound>(k) : FeedBound::kUnknown;
    }
  }
  const auto step = static_cast<std::size_t>(FeedBound::kStepFeed);
  for (std::size_t k = 0; k < kLimits; ++k)
    cap.more[k] = std::clamp(part(share, m.more[k]), cap.feed_mm_min, std::max(ceiling, cap.feed_mm_min));
  double of_sections = kAnyFeed;
  for (const double f : m.at_limit) of_sections = std::min(of_sections, part(share, f));
  cap.more[step] = std::max(cap.feed_mm_min, std::min(cap.more[step], of_sections));
}

bool in_air_by_role(MoveRole r) { return r == MoveRole::kApproach || r == MoveRole::kLink; }

double air_feed(const FeedQuestion& q) {
  const auto& axes = q.cut.machine.axes;
  const double most = std::min({axes[0].feed_max_mm_min, axes[1].feed_max_mm_min, axes[2].feed_max_mm_min});
  return std::min(most, kAirFeedMmMin);
}

/// Straight down, where no sample could say so.
bool unmeasured_plunge(const FeedQuestion& q, const model::CutterPath& p, std::size_t i) {
  return q.samples.empty() && !in_air_by_role(p.role[i]) && p.kind[i] == MoveKind::kLine &&
         p.x[i] == p.x[i - 1] && p.y[i] == p.y[i - 1] && p.z[i] < p.z[i - 1];
}

/// Sine of the slope on which a move goes down; 0: it does not.
double fall_of(const model::CutterPath& p, std::size_t i) {
  const double length = model::move_length(p, i);
  return length > 0.0 ? std::clamp((p.z[i - 1] - p.z[i]) / length, 0.0, 1.0) : 0.0;
}

/// A move of a milling step whose feed is free.
Cap milled(const FeedQuestion& q, CutClasses& classes, const model::CutterPath& path, std::size_t i,
           double given, const OnMove& m) {
  const MoveRole role = path.role[i];
  const CutLoads& loads = classes.loads(rpm_on(q, i));
  // Without any section nothing is known of the cut: then never faster than planned.
  const bool measured = !q.samples.empty() && !m.plunges;
  Cap cap = open_cap(given * (measured ? loads.ceiling_mm_min() : q.feed_mm_min));
  if (m.cuts) bound_by_sections(cap, m, loads, std::min(1.0, given));
  // Take the direction from the samples if there are any: a given trajectory may call a plunge a cut.
  if (role == MoveRole::kPlunge || m.plunges || unmeasured_plunge(q, path, i)) {
    bound(cap, kPlungeFraction * given * q.feed_mm_min, FeedBound::kEndCut);
    bound(cap, classes.plunge(m.plunged_mm2, rpm_on(q, i)).feed_mm_min, FeedBound::kEndCut);
  } else if (role == MoveRole::kRamp) {
    const double meant = given * q.feed_mm_min;
    const double share = model::ramp_of(q.cut.cutter, q.cut.material).feed_share;
    double most = share * given * loads.whole_chip_mm_min();
    if (const double fall = fall_of(path, i); fall > 0.0)
      most = std::min(most, kPlungeFraction * meant / fall);
    // A part of a feed that is near the thinnest chip would rub all the way down.
    bound(cap, std::max(most, std::min(meant, loads.floor_mm_min())), FeedBound::kEndCut);
  } else if (in_air_by_role(role) && !m.cuts && !m.plunges) {
    const double feed = std::max(given * q.feed_mm_min, air_feed(q));
    cap = open_cap(feed);
    cap.more.fill(feed);
    cap.by = FeedBound::kAir;
  }
  return cap;
}

}  // namespace

double rpm_on(const FeedQuestion& q, std::size_t move) {
  return std::abs(move < q.speed_factor.size() ? q.n_rpm * q.speed_factor[move] : q.n_rpm);
}

SampleFeed sample_feed(CutClasses& classes, const CutSample& sample, const CutQuestion& question,
                       double n_rpm) {
  SampleFeed out;
  out.feed_mm_min = kAnyFeed;
  out.at_limit.fill(kAnyFeed);
  out.at_more.fill(kAnyFeed);
  const Cuts cuts = cuts_of(sample, question);
  for (std::size_t c = 0; c < cuts.n; ++c) {
    const CutClass& kind = classes.class_of(cuts.cut[c], n_rpm);
    const double per_gain = 1.0 / cuts.cut[c].gain;
    out.known = out.known && kind.known;
    out.feed_mm_min = std::min(out.feed_mm_min, kind.feed_mm_min * per_gain);
    for (std::size_t k = 0; k < kLimits; ++k) {
      out.at_limit[k] = std::min(out.at_limit[k], kind.at_limit[k] * per_gain);
      out.at_more[k] = std::min(out.at_more[k], kind.at_more[k] * per_gain);
    }
  }
  return out;
}

std::vector<Cap> caps_of(const FeedQuestion& q, const model::CutterPath& path, CutClasses& classes) {
  std::vector<Cap> out(path.size());
  const bool sideways = is_milling(q.cut.kind);
  std::size_t next = 0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    const double given = i < q.feed_factor.size() ? q.feed_factor[i] : 1.0;
    OnMove m;
    if (sideways && q.adapt) {
      m = on_move(q, classes, i, next);
    } else {
      for (; next < q.samples.size() && q.samples[next].move <= i; ++next)
        m.cuts = m.cuts || (q.samples[next].move == i && q.samples[next].ap_mm > 0.0);
    }
    if (i == 0 || path.kind[i] == MoveKind::kRapid || path.kind[i] == MoveKind::kDwell) continue;
    if (sideways && q.adapt) {
      out[i] = milled(q, classes, path, i, given, m);
      continue;
    }
    // A path may ask for less of a given feed, never for more: that is the file's to say.
    const double share = sideways && !q.adapt ? std::min(given, 1.0) : given;
    out[i] = open_cap(share * q.feed_mm_min);
    if (q.adapt && in_air_by_role(path.role[i]) && !m.cuts && air_feed(q) > out[i].feed_mm_min) {
      out[i] = open_cap(air_feed(q));
      out[i].by = FeedBound::kAir;
    }
  }
  return out;
}

}  // namespace capstan::optimise::feed
