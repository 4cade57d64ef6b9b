#include "casebase/tune/advise.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

/// Safe tuning.
///
/// Each load is a process of its own over where the case lies, ln vc, ln fz and wear: what the planner's
/// models expect, with the handbook's spread, is its linear prior. A setting is safe when the probability
/// that the next part on a new, worn edge exceeds any limit, the sum over the limits, is at most the one
/// allowed; among the safe settings of the trust region the fastest is tried. That
/// is the idea of SafeOpt (Sui, Gotovos, Burdick, Krause, "Safe exploration for optimization with Gaussian
/// processes", ICML 2015) with several constraints (Berkenkamp, Krause, Schoellig, "Bayesian optimization
/// with safety constraints", Machine Learning 112, 2023), without its search for expanders: time falls
/// towards the border of the safe set, so that the fastest safe setting is at that border and widens it. The
/// trust region is centred at the fastest setting that repeats on several edges or days have proven.
namespace capstan::casebase::tune {
namespace {

// Lengths and sizes of what departs from the lines. Default, unsourced; learnt where there are enough cases.
constexpr double kQuestionLength = 1.0, kSettingLength = 0.4, kWearLength = 1.0;
constexpr double kLoadField = 0.05;
constexpr double kTimeField = 0.02, kTimeNoise = 0.03, kTimeEdges = 0.01;
constexpr double kTimeSlope = 0.3;  // std dev of ln time, and of its exponents. Default, unsourced
// A question at a distance of 1 (a size twice as large) has ln loads this different, its limits known.
// Default, unsourced.
constexpr double kQuestionSlope = 0.3;
// Failures come in bands of speed (lobes), and more of them at a harder cut. In ln vc, and in z of the normal
// distribution. Default, unsourced.
constexpr double kLobeLength = 0.15, kFailureField = 0.5;
constexpr double kZ95 = 1.6449;  // of the normal distribution
// A gentler setting that would fail as often as not mends nothing: another depth or tool is needed (derived).
constexpr double kWorthLowering = 0.5;
constexpr double kFailureSlope = 1.0, kFailureSlopeSpread = 1.0;  // of z by ln vc, ln fz. Default, unsourced

std::vector<double> place(const std::vector<double>& question, const Setting& at, double worn) {
  std::vector<double> x = question;
  x.insert(x.end(), {at.ln_vc, at.ln_fz, worn});
  return x;
}

/// Everything that was learnt.
class Learnt {
 public:
  Learnt(const std::vector<Evidence>& evidence, const Handbook& handbook, const TuneOptions& options)
      : evidence_(evidence),
        handbook_(handbook),
        here_(evidence.empty() ? 0 : evidence.front().question.size(), 0.0),
        time_(time_of(options)),
        failure_(failure_of(options)) {
    for (std::size_t i = 0; i < kWatchedCount; ++i) {
      if (handbook.loads[i].watched) loads_[i].emplace(load_of(i, options));
    }
  }

  [[nodiscard]] SettingView at(const Setting& s) const {
    SettingView v{.at = s};
    const Belief t = time_.at(place(here_, s, 0.5));
    v.time = std::exp(t.mean);
    v.time_std_dev = t.std_dev;
    const double worn = worn_at(s);
    for (std::size_t i = 0; i < kWatchedCount; ++i) {
      if (!loads_[i]) continue;
      const bool wear = static_cast<Watched>(i) == Watched::kWear;
      const Belief p = loads_[i]->at(place(here_, s, wear ? 0.0 : worn));
      v.limits.push_back({std::string(kWatchedNames[i]), std::exp(p.mean),
                          std::exp(p.mean + kZ95 * p.next_std_dev),
                          normal_probability(p.mean / p.next_std_dev)});
    }
    const double failing = failure_.at(place(here_, s, worn));
    v.limits.push_back({"chatter or breakage", 0.0, 0.0, failing});
    for (const LimitView& l : v.limits) v.probability += l.probability;
    if (handbook_.hard) v.hard = handbook_.hard(s);
    v.repeats = repeats_at(evidence_, s);
    return v;
  }

  [[nodiscard]] const std::optional<Process>& load(std::size_t i) const { return loads_[i]; }

 private:
  /// How worn an edge is expected to be when it is changed; fully where nothing tells.
  [[nodiscard]] double worn_at(const Setting& s) const {
    const auto& wear = loads_[static_cast<std::size_t>(Watched::kWear)];
    if (!wear) return 1.0;
    return std::min(1.0, std::exp(wear->at(place(here_, s, 0.0)).mean));
  }

  [[nodiscard]] std::vector<Row> rows(const std::function<std::optional<double>(const Evidence&)>& of,
                                      bool of_wear) const {
    std::map<std::string, std::size_t> edges;
    std::vector<Row> out;
    for (const Evidence& e : evidence_) {
      const auto y = of(e);
      if (!y) continue;
      const std::size_t edge = edges.emplace(e.edge, edges.size()).first->second;
      out.push_back({place(e.question, e.at, of_wear ? 0.0 : e.worn), *y, 1.0, edge});
    }
    return out;
  }

  [[nodiscard]] ProcessSpreads spreads(double field, double group, double noise, double speed_length,
                                       const TuneOptions& o) const {
    ProcessSpreads s{.field = o.learner == Learner::kProcess ? field : 0.0, .group = group, .noise = noise};
    s.lengths.assign(here_.size(), kQuestionLength);
    s.lengths.insert(s.lengths.end(), {speed_length, kSettingLength, kWearLength});
    return s;
  }

  [[nodiscard]] std::vector<PriorTerm> prior(const PriorTerm& constant, double question,
                                             std::initializer_list<PriorTerm> slopes) const {
    std::vector<PriorTerm> out = {constant};
    out.insert(out.end(), here_.size(), PriorTerm{0.0, question});
    out.insert(out.end(), slopes);
    return out;
  }

  [[nodiscard]] Process load_of(std::size_t i, const TuneOptions& o) const {
    const LoadPrior& l = handbook_.loads[i];
    const bool wear = static_cast<Watched>(i) == Watched::kWear;
    return learnt(rows([&](const Evidence& e) { return e.ln_load[i]; }, wear),
                  prior(l.ln_load, kQuestionSlope, {l.by_vc, l.by_fz, l.by_wear}),
                  spreads(kLoadField, l.edges, l.noise, kSettingLength, o), {});
  }

  [[nodiscard]] Process time_of(const TuneOptions& o) const {
    const PriorTerm slope{-handbook_.cutting_share, kTimeSlope};
    return learnt(rows([](const Evidence& e) { return e.ln_time; }, true),
                  prior({0.0, kTimeSlope}, kQuestionSlope, {slope, slope, {0.0, 0.01}}),
                  spreads(kTimeField, kTimeEdges, kTimeNoise, kSettingLength, o), {.doubt_low = false});
  }

  [[nodiscard]] FailureProcess failure_of(const TuneOptions& o) const {
    const PriorTerm slope{kFailureSlope, kFailureSlopeSpread};
    const auto said = [](const Evidence& e) {
      return e.judged ? std::optional(e.failed ? 1.0 : -1.0) : std::nullopt;
    };
    return {rows(said, false), prior(handbook_.failure, kQuestionSlope, {slope, slope, {0.0, 0.3}}),
            spreads(kFailureField, 0.0, 1.0, kLobeLength, o)};
  }

  const std::vector<Evidence>& evidence_;
  const Handbook& handbook_;
  std::vector<double> here_;  ///< what is asked is the origin
  Process time_;
  FailureProcess failure_;
  std::array<std::optional<Process>, kWatchedCount> loads_;
};

/// Which settings may be cut.
class Gate {
 public:
  Gate(const Learnt& unlearnt, const Handbook& handbook, const TuneOptions& options)
      : handbook_(handbook), allowed_(options.probability), before_(unlearnt.at({})) {}

  [[nodiscard]] bool hard(const SettingView& v) const {
    const double slack = 1e-9;
    if (v.at == Setting{}) return true;  // what the planner itself starts from
    if (v.at.ln_vc > std::log(handbook_.most_vc) + slack) return false;
    if (v.at.ln_fz > std::log(handbook_.most_fz) + slack) return false;
    if (!handbook_.hard) return v.at.ln_vc <= slack && v.at.ln_fz <= slack;
    return v.hard <= 1.0 + slack;
  }

  /// Boole's inequality: a part exceeds some limit at most as often as the sum over the limits says.
  [[nodiscard]] bool soft(const SettingView& v) const {
    // The handbook's own setting is not given up before evidence makes it worse than it was thought to be.
    const double allowed = v.at == Setting{} ? std::max(allowed_, before_.probability + 1e-12) : allowed_;
    return v.probability <= allowed;
  }

  [[nodiscard]] bool open(const SettingView& v) const { return hard(v) && soft(v); }

 private:
  const Handbook& handbook_;
  double allowed_;
  SettingView before_;
};

/// The handbook without the loads that need evidence and have none.
Handbook told_by(const std::vector<Evidence>& evidence, Handbook handbook) {
  for (std::size_t i = 0; i < kWatchedCount; ++i) {
    LoadPrior& l = handbook.loads[i];
    const bool told =
        std::any_of(evidence.begin(), evidence.end(), [&](const Evidence& e) { return e.ln_load[i]; });
    l.watched = l.watched && (told || !l.needs_evidence);
  }
  return handbook;
}

std::vector<Setting> settings_of(const std::vector<Evidence>& evidence) {
  std::vector<Setting> out;
  for (const Evidence& e : evidence) {
    if (!e.measured) continue;
    const bool known =
        std::any_of(out.begin(), out.end(), [&](const Setting& s) { return same_setting(s, e.at); });
    if (!known) out.push_back(e.at);
  }
  return out;
}

bool proven_by(const Repeats& r, const TuneOptions& o) {
  return r.good >= o.repeats && std::max(r.edges, r.days) >= o.edges && r.good > 4 * r.failed;
}

void keep_nearest(std::vector<Evidence>& evidence, std::size_t most) {
  if (evidence.size() <= most) return;
  const auto distance = [](const Evidence& e) {
    double sum = 0.0;
    for (const double q : e.question) sum += q * q;
    return sum;
  };
  // Of equally near ones the later: they tell of the machine as it is now.
  std::vector<std::size_t> order(evidence.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    const double da = distance(evidence[a]), db = distance(evidence[b]);
    return da != db ? da < db : a > b;
  });
  order.resize(most);
  std::sort(order.begin(), order.end());
  std::vector<Evidence> kept;
  for (const std::size_t i : order) kept.push_back(std::move(evidence[i]));
  evidence = std::move(kept);
}

/// The settings of the trust region around one, with those already tried there. Where what is proven is too
/// much, also all that are gentler, at a wider distance.
std::vector<Setting> region_of(const Setting& around, const std::vector<Setting>& tried, const TuneOptions& o,
                               bool lowered) {
  std::vector<Setting> out;
  for (const Setting& s : tried) {
    if (std::abs(s.ln_vc - around.ln_vc) <= o.step + 1e-9 &&
        std::abs(s.ln_fz - around.ln_fz) <= o.step + 1e-9)
      out.push_back(s);
  }
  const int n = static_cast<int>(std::floor(o.step / o.grid + 1e-9));
  const double bound = std::log(kMostMultiplier);
  if (lowered) {
    for (double vc = around.ln_vc; vc >= -bound; vc -= 0.5 * o.step) {
      for (double fz = around.ln_fz; fz >= -bound; fz -= 0.5 * o.step) out.push_back({vc, fz});
    }
  }
  for (int i = -n; i <= n; ++i) {
    for (int j = -n; j <= n; ++j) {
      const Setting s{around.ln_vc + i * o.grid, around.ln_fz + j * o.grid};
      if (std::abs(s.ln_vc) <= bound && std::abs(s.ln_fz) <= bound) out.push_back(s);
    }
  }
  return out;
}

std::string percent_of(double ln) { return fmt::format("{:+.0f} %", 100.0 * (std::exp(ln) - 1.0)); }

std::string reason_of(const Advice& a, const TuneOptions& o) {
  if (a.heard == 0) return "no case is near: the handbook's values hold";
  const std::string base =
      fmt::format("{} on {} and {}", a.heard == 1 ? "1 case" : fmt::format("{} cases", a.heard),
                  a.edges == 1 ? "1 edge" : fmt::format("{} edges", a.edges),
                  a.days == 1 ? "1 day" : fmt::format("{} days", a.days));
  if (a.another_cut && a.trial.at == a.proven.at) {
    return fmt::format(
        "{}: the present values would exceed a limit ({}) too often, and no other speed or feed near "
        "mends it; take another depth, width or tool",
        base, a.binding);
  }
  if (a.another_cut) {
    return fmt::format(
        "{}: the present values would exceed a limit ({}) too often, and the gentlest near, {} speed, {} "
        "feed, "
        "in {:.0f} of 100 parts; take another depth, width or tool",
        base, a.binding, percent_of(a.trial.at.ln_vc), percent_of(a.trial.at.ln_fz),
        100.0 * std::min(1.0, a.trial.probability));
  }
  if (a.lowered) {
    return fmt::format("{}: the present values would exceed a limit ({}) too often; {} speed, {} feed", base,
                       a.binding, percent_of(a.trial.at.ln_vc), percent_of(a.trial.at.ln_fz));
  }
  if (a.trial.at == a.proven.at) {
    const std::string words =
        fmt::format("{}: nothing faster within {:.0f} % keeps its limits in {:.3g} of 100 parts{}", base,
                    100.0 * (std::exp(o.step) - 1.0), 100.0 * (1.0 - o.probability),
                    a.binding.empty() ? "" : " (" + a.binding + ")");
    // Of fewer cases than prove a value the probability says how little is known, not how often it fails.
    if (a.trial.probability <= o.probability || a.heard < o.repeats) return words;
    // The handbook's own, which no evidence made worse than they were thought to be.
    return fmt::format("{}; of the present values up to {:.0f} of 100 are expected beyond a limit", words,
                       100.0 * std::min(1.0, a.trial.probability));
  }
  return fmt::format(
      "{}: {} speed, {} feed is expected to take {:.3g} of the handbook's time; proven after {} "
      "good parts on {} edges or days",
      base, percent_of(a.trial.at.ln_vc), percent_of(a.trial.at.ln_fz), a.trial.time, o.repeats, o.edges);
}

/// The limit that a step further in speed and feed would break first; empty where none would.
std::string binding_of(const Learnt& learnt, const Gate& gate, const Setting& at, double grid) {
  const SettingView further = learnt.at({at.ln_vc + 2.0 * grid, at.ln_fz + 2.0 * grid});
  const auto worst =
      std::max_element(further.limits.begin(), further.limits.end(),
                       [](const LimitView& a, const LimitView& b) { return a.probability < b.probability; });
  if (worst != further.limits.end() && !gate.soft(further)) return worst->name;
  return gate.hard(further) ? "" : "the planner's own limits";
}

/// The handbook's setting, or a faster one that was proven; where the handbook's breaks a limit any proven
/// one.
SettingView fastest_proven(const Learnt& learnt, const Gate& gate, const std::vector<Setting>& tried,
                           const TuneOptions& options) {
  SettingView out = learnt.at({});
  for (const Setting& s : tried) {
    SettingView v = learnt.at(s);
    const bool better = v.time < out.time || !gate.open(out);
    if (better && proven_by(v.repeats, options) && gate.open(v)) out = std::move(v);
  }
  return out;
}

}  // namespace

std::optional<SettingView> proven(std::span<const Evidence> evidence, const Handbook& all,
                                  const TuneOptions& options) {
  Heard said = heard(evidence, all.machine, options.today);
  keep_nearest(said.evidence, options.most_cases);
  const std::vector<Setting> tried = settings_of(said.evidence);
  const bool any = std::any_of(tried.begin(), tried.end(), [&](const Setting& s) {
    return !same_setting(s, {}) && proven_by(repeats_at(said.evidence, s), options);
  });
  if (!any) return std::nullopt;
  const Handbook handbook = told_by(said.evidence, all);
  const std::vector<Evidence> none;
  const Learnt learnt(said.evidence, handbook, options), unlearnt(none, handbook, options);
  SettingView out = fastest_proven(learnt, Gate(unlearnt, handbook, options), tried, options);
  if (same_setting(out.at, {})) return std::nullopt;
  return out;
}

Advice advise(std::span<const Evidence> evidence, const Handbook& all, const TuneOptions& options) {
  Heard said = heard(evidence, all.machine, options.today);
  keep_nearest(said.evidence, options.most_cases);
  const Handbook handbook = told_by(said.evidence, all);
  Advice out{.heard = said.evidence.size(),
             .refused = std::move(said.refused),
             .days_in_future = said.days_in_future};
  std::set<std::string> edges;
  std::set<long> days;
  for (const Evidence& e : said.evidence) {
    edges.insert(e.edge);
    if (e.day) days.insert(*e.day);
  }
  out.edges = edges.size();
  out.days = days.size();

  const std::vector<Evidence> none;
  const Learnt learnt(said.evidence, handbook, options);
  const Learnt unlearnt(none, handbook, options);
  const Gate gate(unlearnt, handbook, options);
  for (std::size_t i = 0; i < kWatchedCount; ++i) {
    if (learnt.load(i)) out.spreads[i] = learnt.load(i)->spreads();
  }

  out.handbook = learnt.at({});
  const std::vector<Setting> tried = settings_of(said.evidence);
  out.proven = fastest_proven(learnt, gate, tried, options);
  out.lowered = !gate.open(out.proven);
  out.trial = out.proven;
  if (out.heard == 0) {
    out.why = reason_of(out, options);
    return out;
  }

  // A setting under trial is cut again until it is proven, or no longer safe or faster.
  std::optional<SettingView> best, repeated, gentlest;
  for (const Setting& s : region_of(out.proven.at, tried, options, out.lowered)) {
    SettingView v = learnt.at(s);
    if (!gate.hard(v)) continue;
    const bool was_tried = std::find(tried.begin(), tried.end(), s) != tried.end();
    if (!gentlest || v.probability < gentlest->probability) gentlest = v;
    if (!gate.soft(v)) continue;
    const bool again = was_tried && v.repeats.good > 0 && !proven_by(v.repeats, options);
    if (again && (!repeated || v.time < repeated->time)) repeated = v;
    if (!best || v.time < best->time - 1e-12) best = std::move(v);
  }
  const auto gains = [&](const std::optional<SettingView>& v) {
    return v && (out.lowered || v->time < out.proven.time * (1.0 - options.least_gain));
  };
  if (gains(repeated)) {
    out.trial = *repeated;
  } else if (gains(best)) {
    out.trial = *best;
  } else if (out.lowered && gentlest && gentlest->probability < kWorthLowering) {
    out.trial = *gentlest;
  }
  out.another_cut = out.lowered && (out.trial.at == out.proven.at || !gate.soft(out.trial));
  out.binding = binding_of(learnt, gate, out.trial.at, options.grid);
  out.why = reason_of(out, options);
  return out;
}

std::vector<LinePoint> along(std::span<const Evidence> evidence, const Handbook& all,
                             const TuneOptions& options, const Setting& through, bool of_feed) {
  Heard said = heard(evidence, all.machine, options.today);
  keep_nearest(said.evidence, options.most_cases);
  const Handbook handbook = told_by(said.evidence, all);
  const Learnt learnt(said.evidence, handbook, options);
  std::vector<LinePoint> out;
  const double low = std::log(0.6), high = std::log(1.7);  // of the plot
  const int points = 45;
  for (int i = 0; i < points; ++i) {
    const double ln = low + (high - low) * i / (points - 1);
    out.push_back(
        {std::exp(ln), learnt.at(of_feed ? Setting{through.ln_vc, ln} : Setting{ln, through.ln_fz})});
  }
  return out;
}

}  // namespace capstan::casebase::tune
