#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "planner/model/plan/proposal.h"

namespace capstan::draft {

/// The cutters that could do a step, best first. Copies share them, and so do lists that a CandidatePool made
/// of equal cutters: a part of thousands of steps asks for the same few.
class Candidates {
 public:
  using Shared = std::shared_ptr<const model::Candidate>;

  /// Walks over the candidates themselves.
  class Iterator {
   public:
    explicit Iterator(std::vector<Shared>::const_iterator at) : at_(at) {}
    const model::Candidate& operator*() const { return **at_; }
    Iterator& operator++() {
      ++at_;
      return *this;
    }
    friend bool operator==(const Iterator&, const Iterator&) = default;

   private:
    std::vector<Shared>::const_iterator at_;
  };

  [[nodiscard]] bool empty() const { return all_.empty(); }
  [[nodiscard]] std::size_t size() const { return all_.size(); }
  [[nodiscard]] const model::Candidate& operator[](std::size_t i) const { return *all_[i]; }
  [[nodiscard]] const model::Candidate& front() const { return *all_.front(); }
  [[nodiscard]] Iterator begin() const { return Iterator(all_.begin()); }
  [[nodiscard]] Iterator end() const { return Iterator(all_.end()); }

  void add(Shared candidate) { all_.push_back(std::move(candidate)); }
  /// Puts one in front of those that stand before it.
  void prefer(std::size_t i);
  /// The same ones, those of `first` in front and in that order. Needs distinct numbers.
  void prefer(const std::vector<std::size_t>& first);
  /// Puts what `by` gives in the place of each; null: it stays.
  void replace(const std::function<Shared(const Shared&)>& by);
  /// Drops those for which `out` holds; gives what was dropped.
  std::vector<Shared> drop_if(const std::function<bool(const model::Candidate&)>& out);

 private:
  std::vector<Shared> all_;
};

/// Keeps each candidate once.
class CandidatePool {
 public:
  [[nodiscard]] Candidates list(const std::vector<model::Candidate>& ranked);

 private:
  std::map<std::string, std::vector<Candidates::Shared>, std::less<>> of_id_;  ///< by the cutter's id
};

}  // namespace capstan::draft
