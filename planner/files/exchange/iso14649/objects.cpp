#include <cmath>
#include <limits>

#include "planner/files/exchange/common/text.h"
#include "planner/files/exchange/iso14649/beyond.h"
#include "planner/files/exchange/iso14649/convert.h"
#include "planner/files/exchange/iso14649/dialect.h"
#include "planner/files/exchange/iso14649/reading.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using model::AnyRef;
using model::TypeId;

namespace {

void place(Diagnostic& d, const p21::Instance& i) {
  d.instance = i.id();
  d.line = i.line();
}

// Kept: unknown keywords, complex instances, and kinds that only other standards instantiate.
AnyRef make_object(Reading& r, const p21::Instance& i, const std::map<std::uint64_t, TypeId>& kinds) {
  AnyRef at;
  if (!i.is_complex() && !i.user_defined()) {
    if (const auto kind = kind_of(i.keyword())) {
      if (kind->draft) r.draft.insert(std::string(i.keyword()));
      const auto said = kinds.find(i.id());
      const bool narrower = said != kinds.end() && model::is_a(said->second, kind->type);
      at = r.plan.model.add_object(narrower ? said->second : kind->type);
    }
  }
  if (!at.set()) at = r.plan.model.add_object(TypeId::kKeptInstance);
  r.plan.model.set_origin(at, {i.id(), i.line()});
  return at;
}

void fill_kept(Reading& r, const p21::Instance& i, AnyRef at) {
  auto kept = keep(i, [&](std::uint64_t id) { return r.find(id); });
  Diagnostic d{.code = "EXC-KEPT",
               .severity = Severity::kWarning,
               .message = kept.keyword + " is not understood; kept as it is and not acted on"};
  place(d, i);
  r.reporter.report(std::move(d));
  r.plan.model.at<model::KeptInstance>(at) = std::move(kept);
}

// Whether the number of parameters is one that can be read.
bool check_count(Reading& r, const p21::Instance& i, AnyRef at, std::size_t given) {
  const std::size_t want = parameter_count(at.type);
  if (given == want) return true;
  if (is_draft_count(at.type, given)) {
    r.draft.insert(std::string(i.keyword()) + " with " + std::to_string(given) + " parameters");
    if (given > want && !i.parameters()[want].is(p21::Kind::kOmitted)) {
      r.reporter.about(
          r.plan.model, at,
          {.code = "EXC-DIALECT",
           .severity = Severity::kWarning,
           .message = std::string(i.keyword()) + " has a last parameter, " + spelling(i.parameters()[want]) +
                      ", that the published level does not have; dropped"});
    }
    return true;
  }
  r.doubt(at, {.code = "EXC-PARAMETERS",
               .message = std::string(i.keyword()) + " has " + std::to_string(given) + " parameters",
               .expected = std::to_string(want)});
  return false;
}

void fill(Reading& r, const p21::Instance& i, AnyRef at) {
  const p21::Value parameters = i.parameters();
  if (!check_count(r, i, at, parameters.size())) return;
  std::size_t k = 0;
  for (const model::Attribute& a : model::noun_type(at.type).attributes) {
    if (!a.in_iso14649) continue;
    const p21::Value v = k < parameters.size() ? parameters[k] : p21::Value{};
    ++k;
    convert(r, at, a, v);
  }
}

}  // namespace

p21::Value Reading::parameter(AnyRef object, std::string_view attribute) const {
  const auto& origin = plan.model.origin(object);
  const auto instance = origin.instance == 0 ? std::nullopt : file.find(origin.instance);
  if (!instance || instance->is_complex()) return {};
  std::size_t k = 0;
  for (const model::Attribute& a : model::noun_type(object.type).attributes) {
    if (!a.in_iso14649) continue;
    if (a.name == attribute)
      return k < instance->parameters().size() ? instance->parameters()[k] : p21::Value{};
    ++k;
  }
  return {};
}

void read_objects(Reading& r) {
  r.object_of.reserve(r.file.size());
  const auto kinds = kinds_beyond(r);
  for (const p21::Instance i : r.file) r.object_of.push_back(make_object(r, i, kinds));
  for (const p21::Instance i : r.file) {
    const AnyRef at = r.object_of[i.index()];
    if (at.type == TypeId::kKeptInstance) {
      fill_kept(r, i, at);
    } else {
      fill(r, i, at);
    }
  }
  read_beyond(r);
}

}  // namespace capstan::exchange
