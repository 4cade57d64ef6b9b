#include "planner/making/draft/candidates.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <utility>

namespace capstan::draft {

void Candidates::prefer(std::size_t i) {
  const auto one = all_.begin() + static_cast<std::ptrdiff_t>(i);
  std::rotate(all_.begin(), one, one + 1);
}

void Candidates::prefer(const std::vector<std::size_t>& first) {
  std::vector<Shared> out;
  out.reserve(all_.size());
  for (const std::size_t i : first) out.push_back(std::move(all_[i]));
  std::copy_if(std::make_move_iterator(all_.begin()), std::make_move_iterator(all_.end()),
               std::back_inserter(out), [](const Shared& s) { return s != nullptr; });
  all_ = std::move(out);
}

void Candidates::replace(const std::function<Shared(const Shared&)>& by) {
  for (Shared& s : all_) {
    if (Shared other = by(s)) s = std::move(other);
  }
}

std::vector<Candidates::Shared> Candidates::drop_if(const std::function<bool(const model::Candidate&)>& out) {
  const auto rest =
      std::stable_partition(all_.begin(), all_.end(), [&](const Shared& s) { return !out(*s); });
  std::vector<Shared> dropped(rest, all_.end());
  all_.erase(rest, all_.end());
  return dropped;
}

Candidates CandidatePool::list(const std::vector<model::Candidate>& ranked) {
  Candidates out;
  for (const model::Candidate& c : ranked) {
    std::vector<Candidates::Shared>& alike = of_id_[c.cutter.id];
    auto it = std::find_if(alike.begin(), alike.end(), [&](const auto& other) { return *other == c; });
    if (it == alike.end()) it = alike.insert(it, std::make_shared<const model::Candidate>(c));
    out.add(*it);
  }
  return out;
}

}  // namespace capstan::draft
