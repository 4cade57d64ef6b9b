#include "planner/model/model.h"

#include "planner/model/nouns/all.h"

namespace capstan::model {
namespace {

template <class T>
std::unique_ptr<detail::Arena> arena_of() {
  return std::make_unique<detail::TypedArena<T>>();
}

std::unique_ptr<detail::Arena> make_arena(TypeId t) {
  switch (t) {
#define CAPSTAN_NOUN(T) \
  case TypeId::k##T:    \
    return arena_of<T>();
#include "planner/model/nouns/list.inc"
#undef CAPSTAN_NOUN
    case TypeId::kKeptInstance:
      return arena_of<KeptInstance>();
    case TypeId::kNone:
    case TypeId::kCount:
      break;
  }
  return nullptr;
}

}  // namespace

Model::Model() = default;

Model::Model(const Model& other) { *this = other; }

Model& Model::operator=(const Model& other) {
  if (this == &other) return *this;
  for (std::size_t i = 0; i < kTypeCount; ++i) {
    arenas_[i] = other.arenas_[i] ? other.arenas_[i]->clone() : nullptr;
  }
  return *this;
}

AnyRef Model::add_object(TypeId type) {
  if (noun_type(type).abstract) throw std::logic_error("an abstract kind of object cannot be made");
  auto& slot = arenas_[static_cast<std::size_t>(type)];
  if (!slot) slot = make_arena(type);
  slot->append();
  return {type, slot->size() - 1};
}

detail::Arena& Model::arena(TypeId t) const {
  const auto& slot = arenas_.at(static_cast<std::size_t>(t));
  if (!slot) throw std::logic_error("a handle points to a kind of object that the model has none of");
  return *slot;
}

const void* Model::object(AnyRef r) const {
  auto& a = arena(r.type);
  if (r.index >= a.size()) throw std::logic_error("a handle points past the model's objects");
  return a.at(r.index);
}

void* Model::object(AnyRef r) { return const_cast<void*>(std::as_const(*this).object(r)); }

std::uint32_t Model::count(TypeId type) const {
  const auto& slot = arenas_[static_cast<std::size_t>(type)];
  return slot ? slot->size() : 0;
}

std::vector<AnyRef> Model::all(TypeId type) const {
  std::vector<AnyRef> out;
  for (std::uint32_t i = 0; i < count(type); ++i) out.push_back({type, i});
  return out;
}

std::vector<AnyRef> Model::all_below(TypeId type) const {
  std::vector<AnyRef> out;
  for (std::size_t i = 1; i < kTypeCount; ++i) {
    const auto t = static_cast<TypeId>(i);
    if (count(t) == 0 || !is_a(t, type)) continue;
    for (const AnyRef r : all(t)) out.push_back(r);
  }
  return out;
}

const Origin& Model::origin(AnyRef r) const { return arena(r.type).origins.at(r.index); }

void Model::set_origin(AnyRef r, Origin o) { arena(r.type).origins.at(r.index) = o; }

}  // namespace capstan::model
