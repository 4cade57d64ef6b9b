#include "casebase/tune/evidence.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace capstan::casebase::tune {
namespace {

constexpr double kSameSetting = 0.02;
constexpr double kMostLoad = 4.6;  // ln 100: a load a hundred times its limit is an error of a unit

bool finite(const Evidence& e) {
  if (!std::isfinite(e.at.ln_vc) || !std::isfinite(e.at.ln_fz) || !std::isfinite(e.worn)) return false;
  if (e.ln_time && !std::isfinite(*e.ln_time)) return false;
  return std::all_of(e.ln_load.begin(), e.ln_load.end(),
                     [](const auto& l) { return !l || (std::isfinite(*l) && std::abs(*l) <= kMostLoad); }) &&
         std::all_of(e.question.begin(), e.question.end(), [](double q) { return std::isfinite(q); });
}

std::string fault_of(const Evidence& e, std::string_view machine, std::size_t dimensions) {
  if (!finite(e)) return "a value is no number, or more than a hundred times its limit";
  if (e.question.size() != dimensions) return "its question has other sizes than those of the first case";
  if (e.machine != machine) return "it was cut on " + e.machine + ", not on " + std::string(machine);
  const double most = std::log(kMostMultiplier) + 1e-9;
  for (const auto& [name, ln] : {std::pair{"cutting speed", e.at.ln_vc}, {"feed per tooth", e.at.ln_fz}}) {
    if (std::abs(ln) > most) {
      return fmt::format("its {} is {:.3g} times the handbook's; within a factor of {:.3g} is heard", name,
                         std::exp(ln), kMostMultiplier);
    }
  }
  return {};
}

}  // namespace

Heard heard(std::span<const Evidence> evidence, std::string_view machine, std::optional<long> today) {
  Heard out;
  std::map<std::string, std::size_t> sources;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    Evidence e = evidence[i];
    if (std::string why = fault_of(e, machine, evidence.front().question.size()); !why.empty()) {
      out.refused.push_back({i, std::move(why)});
      continue;
    }
    const auto [first, fresh] = sources.emplace(e.source, i);
    if (!fresh) {
      out.refused.push_back({i, "its source (" + e.source + ") was heard already"});
      continue;
    }
    e.worn = std::clamp(e.worn, 0.0, 1.5);
    if (today && e.day && *e.day > *today) {
      e.day.reset();
      ++out.days_in_future;
    }
    if (e.edge.empty()) e.edge = "unknown edge";
    out.evidence.push_back(std::move(e));
  }
  return out;
}

bool same_setting(const Setting& a, const Setting& b) {
  return std::abs(a.ln_vc - b.ln_vc) <= kSameSetting && std::abs(a.ln_fz - b.ln_fz) <= kSameSetting;
}

Repeats repeats_at(std::span<const Evidence> evidence, const Setting& at) {
  Repeats out;
  std::set<std::string> edges;
  std::set<long> days;
  for (const Evidence& e : evidence) {
    if (!e.measured || !e.judged || !same_setting(e.at, at)) continue;
    if (e.failed) {
      ++out.failed;
      continue;
    }
    ++out.good;
    edges.insert(e.edge);
    if (e.day) days.insert(*e.day);
  }
  out.edges = edges.size();
  out.days = days.size();
  return out;
}

}  // namespace capstan::casebase::tune
