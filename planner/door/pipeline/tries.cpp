#include "planner/door/pipeline/tries.h"

#include <algorithm>

namespace capstan::pipeline {

std::string Tries::key_of(const std::vector<model::ProposedStep>& chain) {
  if (chain.empty()) return {};
  return chain.front().why.id + "#" + std::to_string(chain.front().priority);
}

void Tries::ban_chain(const Member& m, const std::string& chain, const std::string& why) {
  chains_.emplace(std::pair(m, chain), why);
}

void Tries::ban_cutter(const Member& m, const std::string& chain, std::size_t step, const std::string& cutter,
                       const std::string& why) {
  cutters_.emplace(std::tuple(m, chain, step, cutter), why);
}

void Tries::cut_thinner(const Member& m, const std::string& chain, std::size_t step, const std::string& why) {
  Thinner& t = thinner_[std::tuple(m, chain, step)];
  ++t.times;
  t.why = why;
}

void Tries::cut_nothing(const Member& m, const std::string& chain, std::size_t step, const std::string& why) {
  nothing_.emplace(std::tuple(m, chain, step), why);
}

void Tries::leave_out(model::AnyRef feature, const std::string& why) {
  auto& reasons = left_out_[feature].reasons;
  if (std::find(reasons.begin(), reasons.end(), why) == reasons.end()) reasons.push_back(why);
}

void Tries::rests(model::AnyRef feature, model::AnyRef on, const std::string& why) {
  LeftOut& out = left_out_[feature];
  if (out.why_rests.empty()) out.why_rests = why;
  auto& all = out.rests_on;
  if (std::find(all.begin(), all.end(), on) == all.end()) all.push_back(on);
}

const std::string* Tries::chain_banned(const Member& m, const std::string& chain) const {
  const auto at = chains_.find(std::pair(m, chain));
  return at == chains_.end() ? nullptr : &at->second;
}

const std::string* Tries::cutter_banned(const Member& m, const std::string& chain, std::size_t step,
                                        const std::string& cutter) const {
  const auto at = cutters_.find(std::tuple(m, chain, step, cutter));
  return at == cutters_.end() ? nullptr : &at->second;
}

const Thinner* Tries::thinner(const Member& m, const std::string& chain, std::size_t step) const {
  const auto at = thinner_.find(std::tuple(m, chain, step));
  return at == thinner_.end() ? nullptr : &at->second;
}

const std::string* Tries::cuts_nothing(const Member& m, const std::string& chain, std::size_t step) const {
  const auto at = nothing_.find(std::tuple(m, chain, step));
  return at == nothing_.end() ? nullptr : &at->second;
}

const LeftOut* Tries::left_out(model::AnyRef feature) const {
  const auto at = left_out_.find(feature);
  return at == left_out_.end() ? nullptr : &at->second;
}

}  // namespace capstan::pipeline
