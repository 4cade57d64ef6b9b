#include "planner/door/pipeline/tries.h"

#include <algorithm>
#include <utility>

namespace capstan::pipeline {

void Tries::need(const std::vector<model::NeededTool>& tools) {
  std::erase_if(needed, [&](const model::NeededTool& n) {
    return std::any_of(tools.begin(), tools.end(), [&](const auto& t) { return t.feature == n.feature; });
  });
  needed.insert(needed.end(), tools.begin(), tools.end());
}

bool Tries::learn(Learned learned) {
  for (const draft::GivenUp& g : learned.given_up) bans.ban_chain(g);
  for (const auto& [feature, why] : learned.left_out) bans.leave_out(feature, why);
  for (const Learned::Rests& r : learned.rests) bans.rests(r.feature, r.on, r.why);
  for (std::string& s : learned.said) said.push_back(std::move(s));
  if (learned.thrift) thrift = *learned.thrift;
  if (learned.smallest) smallest = *std::move(learned.smallest);
  return learned.again;
}

}  // namespace capstan::pipeline
