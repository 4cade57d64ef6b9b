#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace capstan::transport {

/// A few threads that do what waits in a bounded queue, in the order of coming.
class Workers {
 public:
  Workers(unsigned threads, std::size_t queue);
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  /// Waits for what is queued.
  ~Workers();

  /// False: the queue is full. The task must not throw.
  [[nodiscard]] bool submit(std::function<void()> task);
  [[nodiscard]] std::size_t waiting() const;

 private:
  void work();

  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::function<void()>> queue_;
  std::size_t most_;
  bool ended_ = false;
  std::vector<std::thread> threads_;
};

}  // namespace capstan::transport
