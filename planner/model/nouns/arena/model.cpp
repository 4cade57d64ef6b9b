#include "planner/model/nouns/arena/model.h"

#include "planner/model/nouns/arena/arena_kinds.h"

namespace capstan::model {
namespace detail {

Arena::Arena(const Arena& other) : origins(other.origins), kind_(other.kind_) {
  blocks_.reserve(other.blocks_.size());
  while (size_ < other.size_) {
    kind_.copy(room(), other.at(size_));
    ++size_;
  }
}

Arena::~Arena() {
  for (std::uint32_t i = 0; i < size_; ++i) kind_.end(at(i));
}

void Arena::append() {
  origins.emplace_back();
  kind_.make(room());
  ++size_;
}

void* Arena::room() {
  if (size_ == blocks_.size() * kBlock) blocks_.push_back(std::make_unique<std::byte[]>(kind_.size * kBlock));
  return at(size_);
}

}  // namespace detail

Model::Model() = default;

Model::Model(const Model& other) { *this = other; }

Model& Model::operator=(const Model& other) {
  if (this == &other) return *this;
  for (std::size_t i = 0; i < kTypeCount; ++i) {
    arenas_[i] = other.arenas_[i] ? std::make_unique<detail::Arena>(*other.arenas_[i]) : nullptr;
  }
  return *this;
}

AnyRef Model::add_object(TypeId type) {
  if (noun_type(type).abstract) throw std::logic_error("an abstract kind of object cannot be made");
  auto& slot = arenas_[static_cast<std::size_t>(type)];
  if (!slot) slot = std::make_unique<detail::Arena>(detail::object_kind(type));
  slot->append();
  return {type, slot->size() - 1};
}

detail::Arena& Model::arena(TypeId t) const {
  const auto& slot = arenas_.at(static_cast<std::size_t>(t));
  if (!slot) throw std::logic_error("a handle points to a kind of object that the model has none of");
  return *slot;
}

const void* Model::object(AnyRef r) const {
  const auto& a = arena(r.type);
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
