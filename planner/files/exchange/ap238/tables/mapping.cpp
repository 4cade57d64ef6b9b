#include "planner/files/exchange/ap238/tables/mapping.h"

#include <algorithm>

#include "planner/files/exchange/common/embedded.h"

// The mapping from AP238's application objects to the instances of its schema, as rows of data that reader
// and writer interpret alike. The tables are parsed once (mapping_parser.cpp) and indexed twice: by the
// entity that may be an object's root, subtypes included (`objects_at`), and by noun (`objects_of`;
// `rows_of`, with the rows of the nouns that it is derived from).
//
// Reading: an instance is the object of the first row whose root, constraints and guard hold. Each row of
// that noun is a path of steps, followed forwards along attributes or backwards along references, over sets
// of instances; the value at its end goes into the attribute. Instances that no row explains are kept
// verbatim.
//
// Writing: the same path is followed from the object's root, and a step without an instance makes one. Rows
// that begin with the same steps share the instances of these steps (Step::prefix), unless a step has `!`.
// Source  ISO 10303-238, clause 5.1 (mapping) and its EXPRESS schema; the language: mapping/README.md.

namespace capstan::exchange::ap238 {

using model::TypeId;

void Mapping::index() {
  const auto& schema = express::Dictionary::ap238();
  at_.resize(schema.size());
  of_.resize(model::kTypeCount);
  rows_of_.resize(model::kTypeCount);
  std::vector<std::vector<std::uint32_t>> rooted(schema.size());
  for (std::uint32_t i = 0; i < objects_.size(); ++i) {
    rooted[static_cast<std::size_t>(objects_[i].root.entities.front())].push_back(i);
    if (objects_[i].written) of_[static_cast<std::size_t>(objects_[i].noun)].push_back(i);
  }
  for (std::size_t e = 0; e < at_.size(); ++e) {
    const EntityId leaf = static_cast<EntityId>(e);
    for (const EntityId a : schema.closure({&leaf, 1})) {
      const auto& there = rooted[static_cast<std::size_t>(a)];
      at_[e].insert(at_[e].end(), there.begin(), there.end());
    }
    std::sort(at_[e].begin(), at_[e].end());
  }
  std::vector<std::vector<const Row*>> own(model::kTypeCount);
  for (const Row& r : rows_) own[static_cast<std::size_t>(r.noun)].push_back(&r);
  for (std::size_t t = 1; t < model::kTypeCount; ++t) {
    auto& all = rows_of_[t];
    for (TypeId at = static_cast<TypeId>(t); at != TypeId::kNone; at = model::noun_type(at).parent) {
      const auto& here = own[static_cast<std::size_t>(at)];
      all.insert(all.end(), here.begin(), here.end());
    }
    std::sort(all.begin(), all.end());  // they stand in one list, in order
  }
}

const Mapping& Mapping::instance() {
  static const Mapping kMapping = [] {
    std::vector<std::pair<std::string, std::string>> tables;
    for (const auto name : embedded_names()) {
      if (name.ends_with(".map")) tables.emplace_back(name, embedded_file(name));
    }
    // By the file's name alone, whatever its folder: "0_macros.map" comes first.
    const auto name = [](const auto& t) { return std::string_view(t.first).substr(t.first.rfind('/') + 1); };
    std::sort(tables.begin(), tables.end(), [&](const auto& a, const auto& b) { return name(a) < name(b); });
    return Mapping(tables);
  }();
  return kMapping;
}

std::span<const std::uint32_t> Mapping::objects_at(EntityId e) const {
  return at_[static_cast<std::size_t>(e)];
}
std::span<const std::uint32_t> Mapping::objects_of(TypeId t) const {
  return of_[static_cast<std::size_t>(t)];
}
std::span<const Row* const> Mapping::rows_of(TypeId t) const { return rows_of_[static_cast<std::size_t>(t)]; }

const SharedRow* Mapping::shared(std::string_view name) const {
  for (const SharedRow& s : shared_) {
    if (s.name == name) return &s;
  }
  return nullptr;
}

}  // namespace capstan::exchange::ap238
