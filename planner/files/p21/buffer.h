#pragma once

#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>
#include <utility>

#include "planner/ground/base/memory/large_pages.h"

namespace capstan::p21::detail {

/// A vector of plain values for arenas of many megabytes: what it reserves and does not use costs nothing,
/// and large ones ask the system for large pages, because touching new pages took a third of all reading.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  Buffer(const Buffer&) = delete;
  Buffer& operator=(const Buffer&) = delete;
  ~Buffer() { std::free(data_); }

  [[nodiscard]] const T* data() const { return data_; }
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] T& operator[](std::size_t i) { return data_[i]; }
  [[nodiscard]] const T& operator[](std::size_t i) const { return data_[i]; }

  void reserve(std::size_t n) {
    if (n <= capacity_) return;
    T* const grown = allocate(n);
    if (size_ != 0) std::memcpy(static_cast<void*>(grown), data_, size_ * sizeof(T));
    std::free(std::exchange(data_, grown));
    capacity_ = n;
  }
  void push_back(const T& value) {
    if (size_ == capacity_) reserve(2 * size_ + 16);
    data_[size_++] = value;
  }
  void append(const T* from, std::size_t n) {
    if (size_ + n > capacity_) reserve(2 * (size_ + n));
    for (std::size_t i = 0; i < n; ++i) data_[size_ + i] = from[i];
    size_ += n;
  }
  void assign(std::size_t n, const T& value) {
    reserve(n);
    for (std::size_t i = 0; i < n; ++i) data_[i] = value;
    size_ = n;
  }

 private:
  static T* allocate(std::size_t n) {
    std::size_t bytes = n * sizeof(T);
    void* memory = nullptr;
    if (bytes < 2 * kLargePage) {
      memory = std::malloc(bytes);
    } else {
      bytes = (bytes + kLargePage - 1) / kLargePage * kLargePage;
      memory = std::aligned_alloc(kLargePage, bytes);
      ask_for_large_pages(memory, bytes);
    }
    if (memory == nullptr) throw std::bad_alloc();
    return static_cast<T*>(memory);
  }

  T* data_ = nullptr;
  std::size_t size_ = 0;
  std::size_t capacity_ = 0;
};

}  // namespace capstan::p21::detail
