#include "planner/making/draft/bans.h"

#include <algorithm>

namespace capstan::draft {
namespace {

/// Whether `other` reaches no place that `mill` does not.
bool reaches_no_more(const Mill& mill, const Mill& other) {
  constexpr double kSameMm = 1e-6;  // of two sizes, written in one list in mm and in another in inches
  if (other.diameter_mm > mill.diameter_mm + kSameMm) return true;
  return other.diameter_mm > mill.diameter_mm - kSameMm &&
         other.corner_radius_mm > mill.corner_radius_mm - kSameMm;
}

}  // namespace

void Bans::ban_chain(const Member& m, const std::string& chain, const std::string& why) {
  chains_.emplace(std::pair(m, chain), why);
}

void Bans::ban_cutter(const Member& m, const std::string& chain, std::size_t step, const std::string& cutter,
                      const std::string& why) {
  cutters_.emplace(std::tuple(m, chain, step, cutter), why);
}

void Bans::ask_narrower(const Member& m, const std::string& chain, std::size_t step, const Mill& than,
                        const std::string& why) {
  const auto [at, first] = narrower_.emplace(std::tuple(m, chain, step), std::pair(than, why));
  if (!first && !reaches_no_more(at->second.first, than)) at->second = {than, why};
}

void Bans::cut_thinner(const Member& m, const std::string& chain, std::size_t step, const std::string& why) {
  Thinner& t = thinner_[std::tuple(m, chain, step)];
  ++t.times;
  t.why = why;
}

void Bans::cut_nothing(const Member& m, const std::string& chain, std::size_t step, const std::string& why) {
  nothing_.emplace(std::tuple(m, chain, step), why);
}

void Bans::leave_out(AnyRef feature, const std::string& why) {
  auto& reasons = left_out_[feature].reasons;
  if (std::find(reasons.begin(), reasons.end(), why) == reasons.end()) reasons.push_back(why);
}

void Bans::rests(AnyRef feature, AnyRef on, const std::string& why) {
  LeftOut& out = left_out_[feature];
  if (out.why_rests.empty()) out.why_rests = why;
  auto& all = out.rests_on;
  if (std::find(all.begin(), all.end(), on) == all.end()) all.push_back(on);
}

const std::string* Bans::chain_banned(const Member& m, const std::string& chain) const {
  const auto at = chains_.find(std::pair(m, chain));
  return at == chains_.end() ? nullptr : &at->second;
}

const std::string* Bans::cutter_banned(const Member& m, const std::string& chain, std::size_t step,
                                       const model::Cutter& cutter) const {
  const auto at = cutters_.find(std::tuple(m, chain, step, cutter.id));
  if (at != cutters_.end()) return &at->second;
  const auto wide = narrower_.find(std::tuple(m, chain, step));
  if (wide == narrower_.end()) return nullptr;
  const Mill mill{cutter.cutting_diameter_mm, cutter.corner_radius_mm};
  return reaches_no_more(wide->second.first, mill) ? &wide->second.second : nullptr;
}

const Thinner* Bans::thinner(const Member& m, const std::string& chain, std::size_t step) const {
  const auto at = thinner_.find(std::tuple(m, chain, step));
  return at == thinner_.end() ? nullptr : &at->second;
}

const std::string* Bans::cuts_nothing(const Member& m, const std::string& chain, std::size_t step) const {
  const auto at = nothing_.find(std::tuple(m, chain, step));
  return at == nothing_.end() ? nullptr : &at->second;
}

const LeftOut* Bans::left_out(AnyRef feature) const {
  const auto at = left_out_.find(feature);
  return at == left_out_.end() ? nullptr : &at->second;
}

}  // namespace capstan::draft
