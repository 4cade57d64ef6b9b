#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <set>
#include <thread>

namespace capstan::testing {

/// A clock that notes which other threads than the caller's read it: each piece of shared work asks its job
/// whether it is to stop. Where others are `awaited`, the caller's own questions take a millisecond each
/// until the first of them is there, so that it does not do all the work before.
class Witness {
 public:
  explicit Witness(bool awaited) : awaited_(awaited) {}
  std::chrono::steady_clock::time_point read() {
    constexpr int kLongest = 20000;  // waited out only where none ever comes: the test fails then
    std::unique_lock lock(mutex_);
    if (std::this_thread::get_id() != caller_) {
      helpers_.insert(std::this_thread::get_id());
      arrived_.notify_all();
    } else if (awaited_ && helpers_.empty() && ++waited_ < kLongest) {
      arrived_.wait_for(lock, std::chrono::milliseconds(1));
    }
    return std::chrono::steady_clock::now();
  }
  [[nodiscard]] std::size_t helpers() const { return helpers_.size(); }

 private:
  bool awaited_;
  int waited_ = 0;
  std::thread::id caller_ = std::this_thread::get_id();
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::set<std::thread::id> helpers_;
};

}  // namespace capstan::testing
