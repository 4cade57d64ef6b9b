#include "planner/door/app/show/paths.h"

#include <algorithm>
#include <deque>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::app {

using model::AnyRef;
using model::Attribute;
using model::Storage;

namespace {

std::string index(std::size_t i) { return "[" + std::to_string(i) + "]"; }

// Calls with each reference of an object and the step that leads to it.
template <class Visit>
void for_each_step(const model::Model& m, AnyRef at, const Visit& visit) {
  const void* data = m.object(at);
  for (const Attribute& a : model::noun_type(at.type).attributes) {
    const std::string name = "/" + std::string(a.name);
    if (a.storage == Storage::kRef) visit(model::value_of<AnyRef>(a, data), name);
    if (a.storage == Storage::kSelect) visit(model::value_of<model::SelectValue>(a, data).ref, name);
    if (a.storage == Storage::kRefList) {
      const auto& items = model::value_of<model::AnyRefList>(a, data).items;
      for (std::size_t i = 0; i < items.size(); ++i) visit(items[i], name + index(i));
    }
    if (a.storage == Storage::kSelectList) {
      const auto& items = model::value_of<model::SelectList>(a, data).items;
      for (std::size_t i = 0; i < items.size(); ++i) visit(items[i].ref, name + index(i));
    }
    if (a.storage == Storage::kRefTable) {
      const auto& rows = model::value_of<model::RefTable>(a, data).items;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        for (std::size_t k = 0; k < rows[i].size(); ++k) visit(rows[i][k], name + index(i) + index(k));
      }
    }
  }
}

}  // namespace

const Paths::From& Paths::from(AnyRef at) const { return from_[static_cast<std::size_t>(at.type)][at.index]; }

Paths::Paths(const model::Plan& plan) : plan_(plan) {
  const model::Model& m = plan.model;
  for (std::size_t t = 1; t < model::kTypeCount; ++t) from_[t].resize(m.count(static_cast<model::TypeId>(t)));
  if (!plan.project.set()) return;
  from_[static_cast<std::size_t>(plan.project.type)][plan.project.index].step = "/project";
  std::deque<AnyRef> pending = {plan.project};
  while (!pending.empty()) {
    const AnyRef at = pending.front();
    pending.pop_front();
    for_each_step(m, at, [&](AnyRef to, const std::string& step) {
      if (!to.set() || !from(to).step.empty()) return;
      from_[static_cast<std::size_t>(to.type)][to.index] = {at, step};
      pending.push_back(to);
    });
  }
}

std::string Paths::of(AnyRef at) const {
  if (!at.set()) return {};
  if (from(at).step.empty()) {
    if (at.type == model::TypeId::kKeptInstance) return "/unhandled" + index(at.index);
    const auto all = plan_.model.all_below(at.type);
    const auto i = static_cast<std::size_t>(std::find(all.begin(), all.end(), at) - all.begin());
    return "/" + std::string(model::noun_type(at.type).keyword) + index(i);
  }
  std::vector<std::string_view> steps;
  for (AnyRef place = at; place.set(); place = from(place).object) steps.push_back(from(place).step);
  std::string out;
  for (auto step = steps.rbegin(); step != steps.rend(); ++step) out += *step;
  return out;
}

}  // namespace capstan::app
