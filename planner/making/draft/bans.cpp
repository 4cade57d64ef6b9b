#include "planner/making/draft/bans.h"

#include <algorithm>

namespace capstan::draft {

void Bans::ban_chain(const Member& m, const std::string& chain, const std::string& why) {
  chains_.emplace(std::pair(m, chain), why);
}

void Bans::ban_cutter(const Member& m, const std::string& chain, std::size_t step, const std::string& cutter,
                      const std::string& why) {
  cutters_.emplace(std::tuple(m, chain, step, cutter), why);
}

void Bans::ask_narrower(const Member& m, const std::string& chain, std::size_t step, double diameter_mm,
                        const std::string& why) {
  const auto [at, first] = narrower_.emplace(std::tuple(m, chain, step), std::pair(diameter_mm, why));
  if (!first && diameter_mm < at->second.first) at->second = {diameter_mm, why};
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
  constexpr double kSameMm = 1e-6;  // of two diameters, written in one list in mm and in another in inches
  const auto wide = narrower_.find(std::tuple(m, chain, step));
  const bool too_wide = wide != narrower_.end() && cutter.cutting_diameter_mm > wide->second.first - kSameMm;
  return too_wide ? &wide->second.second : nullptr;
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
