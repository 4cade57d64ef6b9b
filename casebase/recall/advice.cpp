#include "casebase/recall/advice.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>

#include "planner/ground/base/number.h"

// Verdicts of near cases are taken together, not one by one: one case in ten may be wrong (mistyped, another
// cut, a verdict by mistake), and neither a wrong "good" nor a wrong "bad" may decide alone.
//
// Weight      a Gaussian kernel of the distance (Nadaraya 1964, Watson 1964), shared among cases that tell of
//             one cut.
// Start       the weighted median of the logarithms of good settings: up to half of the weight may be
// anything
//             (breakdown point 1/2; P. J. Huber, Robust Statistics, 1981).
// Success     beta-binomial with a monotone likelihood: at values x, a good cut counts in full where it was
// as
//             hard as x in each value or harder, a bad one where it was as hard or less; beyond that each
//             fades by exp(-d / band), d the largest difference of the logarithms. The mean of the posterior,
//             (a + S) / (a + b + S + F), so falls where any value rises.
// Lowering    the largest share of the asked values whose success is likely enough, by bisection, for success
//             is monotone.

namespace capstan::casebase {
namespace {

constexpr double kBandwidth = 0.25;  // of the kernel: half of the distance within which cases count
constexpr double kFade = 0.1;        // ln: a tenth harder. Default, unsourced
constexpr double kPrior = 2.0;       // cuts that the trust in the table is worth. Default, unsourced
constexpr double kLeastShare =
    0.25;                         // of the asked values, below which nothing is lowered. Default, unsourced
constexpr double kSpeaks = 0.05;  // of the weight of failures: less blames nothing. Default, unsourced
constexpr int kBisections = 40;

/// What a failed cut of this origin counts; of a good one, that a simulation went well proves nothing.
/// Defaults, unsourced.
double trust_bad(Origin o) { return o == Origin::kMeasured ? 1.0 : o == Origin::kEntered ? 0.5 : 0.25; }
double trust_good(Origin o) { return o == Origin::kMeasured ? 1.0 : o == Origin::kEntered ? 0.5 : 0.0; }

/// Evidence with the weight that it counts with, and the cut that it tells of.
struct Weighted {
  const Evidence* of = nullptr;
  double weight = 0.0;
  std::size_t cut = 0;
};

/// The kernel's weights, those of one cut sharing the largest of them. Nearest first, then by id.
std::vector<Weighted> weighed(const std::vector<Evidence>& near) {
  std::vector<Weighted> out;
  out.reserve(near.size());
  for (const Evidence& e : near) {
    const double d = e.distance / kBandwidth;
    out.push_back({&e, std::exp(-0.5 * d * d), 0});
  }
  std::sort(out.begin(), out.end(), [](const Weighted& a, const Weighted& b) {
    return std::tie(a.of->distance, a.of->id) < std::tie(b.of->distance, b.of->id);
  });
  // Union of what shares a run or an observation.
  std::vector<std::size_t> parent(out.size());
  std::iota(parent.begin(), parent.end(), std::size_t{0});
  const auto root = [&](std::size_t i) {
    while (parent[i] != i) i = parent[i] = parent[parent[i]];
    return i;
  };
  std::map<std::string, std::size_t> first;
  const auto join = [&](const std::string& key, std::size_t i) {
    const auto [at, is_new] = first.try_emplace(key, i);
    if (is_new) return;
    const std::size_t a = root(at->second), b = root(i);
    parent[std::max(a, b)] = std::min(a, b);
  };
  for (std::size_t i = 0; i < out.size(); ++i) {
    join("run " + out[i].of->run, i);
    if (!out[i].of->told.empty()) join("told " + out[i].of->told, i);
  }
  std::vector<double> sum(out.size(), 0.0), most(out.size(), 0.0);
  for (std::size_t i = 0; i < out.size(); ++i) {
    out[i].cut = root(i);
    sum[out[i].cut] += out[i].weight;
    most[out[i].cut] = std::max(most[out[i].cut], out[i].weight);
  }
  for (Weighted& w : out) w.weight *= most[w.cut] / sum[w.cut];
  return out;
}

constexpr std::array<double Values::*, 4> kAll = {&Values::vc_m_min, &Values::fz_mm, &Values::ap_mm,
                                                  &Values::ae_mm};

/// By how much the first is harder than the second in the value in which it is most so, as a logarithm. What
/// one of them does not know is passed over.
double harder(const Values& a, const Values& b) {
  std::optional<double> out;
  for (const auto v : kAll) {
    if (!(a.*v > 0.0) || !(b.*v > 0.0)) continue;
    const double d = std::log(a.*v / (b.*v));
    out = out ? std::max(*out, d) : d;
  }
  return out.value_or(0.0);
}

double fade(double by) { return by <= 0.0 ? 1.0 : std::exp(-by / kFade); }

/// What a failure counts against values: in full where it was cut no harder.
double against(const Weighted& w, const Values& x) {
  return w.of->verdict != Verdict::kBad ? 0.0
                                        : trust_bad(w.of->origin) * w.weight * fade(harder(w.of->cut, x));
}

double success(const std::vector<Weighted>& near, const Values& x) {
  double good = kPrior * kTrustInTable, all = kPrior;
  for (const Weighted& w : near) {
    if (w.of->verdict == Verdict::kGood && w.of->raises) {
      const double s = trust_good(w.of->origin) * w.weight * fade(harder(x, w.of->cut));
      good += s;
      all += s;
    }
    all += against(w, x);
  }
  return good / all;
}

/// Whether speed or feed are too many times those that are asked.
bool beyond_belief(const Values& cut, const Values& asked) {
  return (asked.vc_m_min > 0.0 && cut.vc_m_min > kBelieved * asked.vc_m_min) ||
         (asked.fz_mm > 0.0 && cut.fz_mm > kBelieved * asked.fz_mm);
}

/// The least value at which half of the weight is reached: of two in the middle the gentler one.
double weighted_median(std::vector<std::pair<double, double>> values) {
  std::sort(values.begin(), values.end());
  double all = 0.0;
  for (const auto& [v, w] : values) all += w;
  double so_far = 0.0;
  for (const auto& [v, w] : values) {
    so_far += w;
    if (so_far >= 0.5 * all * (1.0 - 1e-12)) return v;
  }
  return values.empty() ? 0.0 : values.back().first;
}

/// What is known of it, in the middle; 0: nothing.
double middle_of(const std::vector<Weighted>& group, double Values::*which) {
  std::vector<std::pair<double, double>> values;
  for (const Weighted& w : group) {
    if (w.of->cut.*which > 0.0) values.emplace_back(w.of->cut.*which, w.weight);
  }
  return weighted_median(std::move(values));
}

/// The cuts that may lead, of the most trusted origin that has any.
std::vector<Weighted> leading(const std::vector<Weighted>& near, bool open) {
  for (const Origin origin : {Origin::kMeasured, Origin::kEntered, Origin::kSimulated}) {
    std::vector<Weighted> out;
    for (const Weighted& w : near) {
      if (w.of->origin != origin) continue;
      const bool computed = origin == Origin::kSimulated && w.of->verdict == Verdict::kUnknown && open;
      if (w.of->verdict == Verdict::kGood || computed) out.push_back(w);
    }
    if (!out.empty()) return out;
  }
  return {};
}

/// Cuts with that verdict, each once.
int cuts(const std::vector<Weighted>& near, Verdict verdict, bool simulated_too = true) {
  std::vector<std::size_t> seen;
  for (const Weighted& w : near) {
    if (w.of->verdict == verdict && (simulated_too || w.of->origin != Origin::kSimulated))
      seen.push_back(w.cut);
  }
  std::sort(seen.begin(), seen.end());
  return static_cast<int>(std::unique(seen.begin(), seen.end()) - seen.begin());
}

Blame blamed(const std::vector<Weighted>& near, const Values& x) {
  double all = 0.0;
  for (const Weighted& w : near) all += against(w, x);
  Blame out;
  double speed = 0.0, feed = 0.0, depth = 0.0;
  for (const Weighted& w : near) {
    const double by = against(w, x);
    speed += w.of->blame.speed ? by : 0.0;
    feed += w.of->blame.feed ? by : 0.0;
    depth += w.of->blame.depth ? by : 0.0;
  }
  out.speed = speed > kSpeaks * all;
  out.feed = feed > kSpeaks * all;
  out.depth = depth > kSpeaks * all;
  return out;
}

/// Lowers what failures are laid on until success is likely enough.
void lower(const std::vector<Weighted>& near, Advice& out) {
  Values from = out.start;
  if (success(near, from) >= kLeastSuccess) return;
  const Blame blame = blamed(near, from);
  if (blame.depth && !(from.ap_mm > 0.0)) {
    // Depth is open: at most as deep as the deepest that failed, and from there on less.
    for (const Weighted& w : near) {
      if (w.of->verdict == Verdict::kBad) from.ap_mm = std::max(from.ap_mm, w.of->cut.ap_mm);
    }
  }
  const bool deep = blame.depth && from.ap_mm > 0.0;
  const bool plain = !blame.speed && !blame.feed && !deep;  // laid on a depth that nobody knows
  const auto at = [&](double share) {
    Values x = from;
    if (blame.speed || plain) x.vc_m_min *= share;
    if (blame.feed || plain) x.fz_mm *= share;
    if (deep) x.ap_mm *= share;
    return x;
  };
  out.lowered = true;
  double low = std::log(kLeastShare), high = 0.0;
  if (success(near, at(kLeastShare)) < kLeastSuccess) {
    out.at_bottom = true;
    out.start = at(kLeastShare);
    return;
  }
  for (int i = 0; i < kBisections; ++i) {
    const double mid = 0.5 * (low + high);
    (success(near, at(std::exp(mid))) >= kLeastSuccess ? low : high) = mid;
  }
  // Down to whole thousandths, so that the last bits of an exponential decide nothing.
  constexpr double kThousandths = 1000.0;
  out.start = at(std::max(kLeastShare, std::floor(kThousandths * std::exp(low)) / kThousandths));
}

std::string counts(const Advice& a) {
  std::string out;
  for (const auto& [n, what] : {std::pair(a.good, " good"), std::pair(a.bad, " failed"),
                                std::pair(a.unjudged, " without a verdict")}) {
    if (n > 0) out += (out.empty() ? "" : ", ") + std::to_string(n) + what;
  }
  return out;
}

}  // namespace

std::size_t cuts_told(const std::vector<Evidence>& near) {
  std::set<std::size_t> cuts;
  for (const Weighted& w : weighed(near)) cuts.insert(w.cut);
  return cuts.size();
}

double success_of(const std::vector<Evidence>& near, const Values& values) {
  return success(weighed(near), values);
}

Advice advise(std::vector<Evidence> near, const Values& asked, double least_fz_mm) {
  Advice out;
  out.start = asked;
  if (near.empty()) {
    out.why = "no case is near enough";
    return out;
  }
  std::set<const Evidence*> doubted;
  for (Evidence& e : near) {
    out.careful = out.careful || !e.raises;
    if (e.lost) e.cut = asked;
    if (e.verdict != Verdict::kGood || !beyond_belief(e.cut, asked)) continue;
    e.verdict = Verdict::kUnknown;
    if (!e.told.empty()) e.told += "/doubted";
    doubted.insert(&e);
  }
  const std::vector<Weighted> all = weighed(near);
  std::set<std::size_t> doubted_cuts;
  for (const Weighted& w : all) {
    if (doubted.contains(w.of)) doubted_cuts.insert(w.cut);
  }
  out.doubted = static_cast<int>(doubted_cuts.size());
  out.nearest = all.front().of->distance;
  out.good = cuts(all, Verdict::kGood);
  out.bad = cuts(all, Verdict::kBad);
  out.unjudged = cuts(all, Verdict::kUnknown);
  out.cut_good = cuts(all, Verdict::kGood, false);
  const bool open = !(asked.vc_m_min > 0.0) || !(asked.fz_mm > 0.0);
  if (const std::vector<Weighted> group = leading(all, open); !group.empty()) {
    out.leads = true;
    out.origin = group.front().of->origin;
    for (const auto v : kAll) out.centre.*v = middle_of(group, v);
    const bool repeated =
        !out.careful && out.origin != Origin::kSimulated && cuts(group, Verdict::kGood) >= kRepeats;
    const double reach = repeated ? kCaseReach : 1.0;
    for (const auto v : {&Values::vc_m_min, &Values::fz_mm}) {
      const double most = asked.*v > 0.0 ? reach * (asked.*v) : out.centre.*v;
      out.held_back = out.held_back || out.centre.*v > most;
      out.start.*v = std::min(out.centre.*v, most);
    }
    out.start.fz_mm = std::max(out.start.fz_mm, least_fz_mm);
  }
  Values start = out.start;
  out.success_asked = success(all, open ? start : asked);
  if (start.vc_m_min > 0.0 && start.fz_mm > 0.0) lower(all, out);
  out.success = success(all, out.start);
  // The heaviest first, good and bad as they come.
  std::vector<Weighted> heaviest = all;
  std::stable_sort(heaviest.begin(), heaviest.end(),
                   [](const Weighted& a, const Weighted& b) { return a.weight > b.weight; });
  std::set<std::pair<std::size_t, Verdict>> named;
  for (const Weighted& w : heaviest) {
    if (out.cases.size() == kLeanedShown) break;
    if (!named.emplace(w.cut, w.of->verdict).second) continue;
    out.cases.push_back({w.of->id, w.of->distance, w.of->origin, w.of->verdict, w.weight, w.of->cut});
  }
  const int n = out.good + out.bad + out.unjudged;
  out.why =
      fmt::format("{} near ({}), the nearest {} away", n == 1 ? "one cut is" : fmt::format("{} cuts are", n),
                  counts(out), trimmed(out.nearest, 3));
  if (out.doubted > 0)
    out.why += fmt::format("; {} said to be good not believed: more than {} times the table's values",
                           out.doubted == 1 ? "one" : std::to_string(out.doubted), trimmed(kBelieved, 1));
  if (out.careful) out.why += "; cases of the base are lost, so that those that went well raise nothing";
  if (!out.leads) out.why += "; none that went well";
  return out;
}

std::string words_of(const Values& v) {
  std::string out = trimmed(v.vc_m_min, 1) + " m/min and " + trimmed(v.fz_mm, 4) + " mm per tooth";
  if (v.ap_mm > 0.0) out += ", at most " + trimmed(v.ap_mm, 2) + " mm deep";
  return out;
}

std::string words_of(const std::vector<Leaned>& cases, std::size_t most, std::size_t cuts) {
  std::string out;
  for (std::size_t i = 0; i < std::min(most, cases.size()); ++i) {
    const Leaned& c = cases[i];
    out += fmt::format("{}{} ({}, {}, {} away)", i == 0 ? "" : ", ", c.id.substr(0, 12), to_text(c.origin),
                       to_text(c.verdict), trimmed(c.distance, 3));
  }
  const std::size_t named = std::min(most, cases.size());
  if (cuts > named) out += fmt::format(" and {} more", cuts - named);
  return out;
}

}  // namespace capstan::casebase
