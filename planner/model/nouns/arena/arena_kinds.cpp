#include "planner/model/nouns/arena/arena_kinds.h"

#include <cstddef>
#include <new>

#include "planner/model/nouns/all.h"

// The one place that makes code for every kind of object; compiled for size, see CMakeLists.txt.

namespace capstan::model::detail {
namespace {

template <class T>
ObjectKind kind_of() {
  static_assert(alignof(T) <= alignof(std::max_align_t));
  return {sizeof(T), [](void* at) { new (at) T(); },
          [](void* at, const void* from) { new (at) T(*static_cast<const T*>(from)); },
          [](void* at) { static_cast<T*>(at)->~T(); }};
}

}  // namespace

ObjectKind object_kind(TypeId type) {
  switch (type) {
#define CAPSTAN_NOUN(T) \
  case TypeId::k##T:    \
    return kind_of<T>();
#include "planner/ground/vocabulary/noun_kinds.inc"
#undef CAPSTAN_NOUN
    case TypeId::kKeptInstance:
      return kind_of<KeptInstance>();
    case TypeId::kNone:
    case TypeId::kCount:
      break;
  }
  throw std::logic_error("there is no such kind of object");
}

}  // namespace capstan::model::detail
