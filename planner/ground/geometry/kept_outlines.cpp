#include "planner/ground/geometry/kept_outlines.h"

#include <utility>

namespace capstan::geometry {
namespace {

thread_local KeptOutlines* innermost_of_thread = nullptr;

}  // namespace

bool KeptOutlines::find(std::string_view question, std::string& result) const {
  const std::lock_guard lock(mutex_);
  const auto at = known_.find(question);
  if (at == known_.end()) return false;
  ++counts_.found;
  result = at->second;
  return true;
}

void KeptOutlines::keep(std::string question, std::string result) {
  const std::lock_guard lock(mutex_);
  ++counts_.made;
  const std::size_t bytes = question.size() + result.size();
  if (bytes > most_bytes_) return;
  if (bytes_ + bytes > most_bytes_) {
    known_.clear();
    bytes_ = 0;
  }
  if (known_.try_emplace(std::move(question), std::move(result)).second) bytes_ += bytes;
}

KeptOutlines::Counts KeptOutlines::counts() const {
  const std::lock_guard lock(mutex_);
  return counts_;
}

KeptOutlinesScope::KeptOutlinesScope(KeptOutlines* kept) : outer_(std::exchange(innermost_of_thread, kept)) {}
KeptOutlinesScope::~KeptOutlinesScope() { innermost_of_thread = outer_; }
KeptOutlines* KeptOutlinesScope::innermost() { return innermost_of_thread; }

}  // namespace capstan::geometry
