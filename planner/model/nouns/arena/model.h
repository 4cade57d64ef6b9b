#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "planner/model/nouns/arena/attribute.h"
#include "planner/model/nouns/arena/kept.h"

namespace capstan::model {

/// Where an object stood in the file it came from; zeros for one that the planner made.
struct Origin {
  std::uint64_t instance = 0;
  std::uint64_t line = 0;
  friend bool operator==(const Origin&, const Origin&) = default;
};

namespace detail {

/// How objects of one kind are made, copied and ended: all that an arena needs to know of them.
struct ObjectKind {
  std::size_t size = 0;
  void (*make)(void* at) = nullptr;
  void (*copy)(void* at, const void* from) = nullptr;
  void (*end)(void* at) = nullptr;
};

/// One kind's objects, in the order they were made; addresses stay put. Copied with the model.
class Arena {
 public:
  explicit Arena(const ObjectKind& kind) : kind_(kind) {}
  Arena(const Arena& other);
  Arena& operator=(const Arena&) = delete;
  ~Arena();
  void append();
  [[nodiscard]] void* at(std::uint32_t i) const {
    return blocks_[i / kBlock].get() + kind_.size * (i % kBlock);
  }
  [[nodiscard]] std::uint32_t size() const { return size_; }
  std::vector<Origin> origins;

 private:
  static constexpr std::uint32_t kBlock = 32;  ///< objects that are allocated at once
  [[nodiscard]] void* room();                  ///< for one more object
  ObjectKind kind_;
  std::vector<std::unique_ptr<std::byte[]>> blocks_;
  std::uint32_t size_ = 0;
};

}  // namespace detail

/// Every application object of a plan, in one arena per kind. A value: copying it copies the plan.
///
/// Handles stay valid as objects are added; objects are never removed (what nothing reaches from the
/// project is simply not written).
class Model {
 public:
  Model();
  Model(const Model& other);
  Model(Model&&) noexcept = default;
  Model& operator=(const Model& other);
  Model& operator=(Model&&) noexcept = default;
  ~Model() = default;

  /// Makes a T and gives its handle.
  template <class T>
  Ref<T> add(T value = {}) {
    const AnyRef r = add_object(T::kType);
    *static_cast<T*>(object(r)) = std::move(value);
    return Ref<T>(r);
  }

  /// Makes an object of a concrete kind, by type. Throws std::logic_error for an abstract one.
  AnyRef add_object(TypeId type);

  /// The object seen as a T; null when unset, of another kind, or kept verbatim.
  template <class T>
  [[nodiscard]] const T* get(AnyRef r) const {
    return holds<T>(r) ? static_cast<const T*>(object(r)) : nullptr;
  }
  template <class T>
  [[nodiscard]] T* get(AnyRef r) {
    return holds<T>(r) ? static_cast<T*>(object(r)) : nullptr;
  }
  /// As `get`, for a handle whose object must be there. Throws std::logic_error otherwise.
  template <class T>
  [[nodiscard]] const T& at(AnyRef r) const {
    const T* p = get<T>(r);
    if (p == nullptr) throw std::logic_error("the handle does not hold the expected kind of object");
    return *p;
  }
  template <class T>
  [[nodiscard]] T& at(AnyRef r) {
    T* p = get<T>(r);
    if (p == nullptr) throw std::logic_error("the handle does not hold the expected kind of object");
    return *p;
  }
  template <class T>
  [[nodiscard]] bool holds(AnyRef r) const {
    if constexpr (std::is_same_v<T, Noun>) {
      return r.set();
    } else {
      return r.set() && is_a(r.type, T::kType);
    }
  }

  /// The untyped object behind a handle, for walkers over the descriptor table.
  [[nodiscard]] const void* object(AnyRef r) const;
  [[nodiscard]] void* object(AnyRef r);

  [[nodiscard]] std::uint32_t count(TypeId type) const;
  /// All objects of exactly that kind, in the order they were made.
  [[nodiscard]] std::vector<AnyRef> all(TypeId type) const;
  /// All objects of that kind or below it.
  [[nodiscard]] std::vector<AnyRef> all_below(TypeId type) const;

  [[nodiscard]] const Origin& origin(AnyRef r) const;
  void set_origin(AnyRef r, Origin o);

 private:
  [[nodiscard]] detail::Arena& arena(TypeId t) const;
  std::array<std::unique_ptr<detail::Arena>, kTypeCount> arenas_;
};

}  // namespace capstan::model
