#include "planner/files/json/objects.h"

#include <algorithm>
#include <nlohmann/json.hpp>

#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/arena/stand_in.h"

namespace capstan::json {
namespace {

using Tree = nlohmann::json;
using Values = ValueReader<Tree>;
using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;

class Objects {
 public:
  Objects(model::Model& model, Values& values) : model_(model), values_(values) {}

  void fill(const Tree& objects, const Place& at) {
    for (const auto& kind : objects.items()) {
      const Place here{&at, kind.key()};
      const TypeId type = *kind_from_name(kind.key());
      for (std::uint32_t i = 0; i < kind.value().size(); ++i) {
        tick(4);
        object({type, i}, kind.value()[i], {&here, {}, i});
      }
    }
  }

 private:
  void target(const Tree& t, AnyRef& x, const Attribute& a, const Place& at) const {
    values_.reference(t, x, at);
    if (!x.set() || a.targets.empty() || x.type == TypeId::kKeptInstance) return;
    if (model::may_stand_in(a, x.type)) return;
    const bool fits =
        std::any_of(a.targets.begin(), a.targets.end(), [&](TypeId k) { return model::is_a(x.type, k); });
    if (!fits) fault(at, "the id of a " + kind_name(a.targets.front()));
  }

  void object(AnyRef r, const Tree& t, const Place& at) {
    need_object(t, at);
    if (string_of(child(t, "@id", at), {&at, "@id"}) != object_id(r)) fault({&at, "@id"}, object_id(r));
    model::Origin origin;
    if (const auto it = t.find("@instance"); it != t.end())
      Values::integer(*it, origin.instance, {&at, "@instance"});
    if (const auto it = t.find("@line"); it != t.end()) Values::integer(*it, origin.line, {&at, "@line"});
    model_.set_origin(r, origin);
    if (auto* kept = model_.get<model::KeptInstance>(r)) return pieces(*kept, t, at);
    void* data = model_.object(r);
    for (const auto& item : t.items()) {
      if (item.key().front() == '@') {
        if (item.key() != "@id" && item.key() != "@instance" && item.key() != "@line") {
          fault({&at, item.key()}, "no field of that name");
        }
        continue;
      }
      const Place here{&at, item.key()};
      const Attribute* a = model::find_attribute(r.type, item.key());
      if (a == nullptr) fault(here, "no field of that name");
      attribute(*a, item.value(), data, here);
    }
  }

  void pieces(model::KeptInstance& kept, const Tree& t, const Place& at) {
    only(t, {"@id", "@instance", "@line", "keyword", "schema", "section", "pieces"}, at);
    values_.get(child(t, "keyword", at), kept.keyword, {&at, "keyword"});
    if (const auto it = t.find("schema"); it != t.end()) {
      const Place here{&at, "schema"};
      if (string_of(*it, here) != "AP238") fault(here, "AP238, or nothing for ISO 14649");
      kept.schema = model::KeptSchema::kAp238;
    }
    if (const auto it = t.find("section"); it != t.end()) {
      const Place here{&at, "section"};
      const auto& name = string_of(*it, here);
      if (name != "ANCHOR" && name != "REFERENCE") fault(here, "ANCHOR or REFERENCE");
      kept.section = name == "ANCHOR" ? model::KeptSection::kAnchor : model::KeptSection::kReference;
    }
    const Tree& list = child(t, "pieces", at);
    const Place here{&at, "pieces"};
    need_array(list, here);
    for (std::size_t i = 0; i < list.size(); ++i) {
      const Place item{&here, {}, i};
      if (list[i].is_string()) {
        kept.pieces.emplace_back(unquoted_bytes(string_of(list[i], item)));
      } else {
        need_object(list[i], item);
        only(list[i], {"ref"}, item);
        AnyRef r;
        values_.reference(child(list[i], "ref", item), r, item);
        kept.pieces.emplace_back(r);
      }
    }
  }

  template <class T, class F>
  void list(const Tree& t, std::vector<T>& out, const Place& at, F&& each) {
    need_array(t, at);
    out.resize(t.size());
    for (std::size_t i = 0; i < t.size(); ++i) each(t[i], out[i], Place{&at, {}, i});
  }

  void select(const Tree& t, model::SelectValue& v, const Attribute& a, const Place& at) {
    need_object(t, at);
    only(t, {"ref", "type", "real", "text"}, at);
    if (const auto it = t.find("ref"); it != t.end()) target(*it, v.ref, a, {&at, "ref"});
    if (const auto it = t.find("type"); it != t.end()) values_.get(*it, v.type, {&at, "type"});
    if (const auto it = t.find("real"); it != t.end()) values_.get(*it, v.real, {&at, "real"});
    if (const auto it = t.find("text"); it != t.end()) values_.get(*it, v.text, {&at, "text"});
  }

  template <class T>
  static T& storage(const Attribute& a, void* object) {
    return *static_cast<T*>(a.at(object));
  }

  // The storage's type is the one that the descriptor names.
  template <class List>
  void values(const Attribute& a, const Tree& t, void* object, const Place& at) {
    auto& l = storage<List>(a, object);
    l.given = true;
    values_.get(t, l.items, at);
  }

  void attribute(const Attribute& a, const Tree& t, void* object, const Place& at) {
    using namespace model;
    const auto a_ref = [&](const Tree& item, AnyRef& r, const Place& where) { target(item, r, a, where); };
    switch (a.storage) {
      case Storage::kReal:
        return values_.get(t, storage<Real>(a, object), at);
      case Storage::kInteger:
        return values_.get(t, storage<Integer>(a, object), at);
      case Storage::kBoolean:
        return values_.get(t, storage<Boolean>(a, object), at);
      case Storage::kText:
        return values_.get(t, storage<Text>(a, object), at);
      case Storage::kEnum:
        storage<AnyEnum>(a, object).code =
            static_cast<std::int8_t>(Values::spelled(string_of(t, at), a.enumerators, at));
        return;
      case Storage::kRef:
        return target(t, storage<AnyRef>(a, object), a, at);
      case Storage::kRefList:
        storage<AnyRefList>(a, object).given = true;
        return list(t, storage<AnyRefList>(a, object).items, at, a_ref);
      case Storage::kRefTable:
        storage<RefTable>(a, object).given = true;
        return list(t, storage<RefTable>(a, object).items, at,
                    [&](const Tree& row, std::vector<AnyRef>& out, const Place& where) {
                      list(row, out, where, a_ref);
                    });
      case Storage::kSelect:
        return select(t, storage<SelectValue>(a, object), a, at);
      case Storage::kSelectList:
        storage<SelectList>(a, object).given = true;
        return list(t, storage<SelectList>(a, object).items, at,
                    [&](const Tree& item, SelectValue& v, const Place& where) { select(item, v, a, where); });
      case Storage::kRealList:
        return values<RealList>(a, t, object, at);
      case Storage::kIntegerList:
        return values<IntegerList>(a, t, object, at);
      case Storage::kTextList:
        return values<TextList>(a, t, object, at);
      case Storage::kRealTable:
        return values<RealTable>(a, t, object, at);
      case Storage::kPath:
        return values_.shared(t, storage<PathHandle>(a, object), at);
    }
  }

  model::Model& model_;
  Values& values_;
};

}  // namespace

template <class T>
void make_objects(const T& objects, const Place& at, model::Model& model) {
  need_object(objects, at);
  for (const auto& kind : objects.items()) {
    const Place here{&at, kind.key()};
    const auto type = kind_from_name(kind.key());
    if (!type || model::noun_type(*type).abstract) fault(here, "the name of a kind of object");
    need_array(kind.value(), here);
    for (std::size_t i = 0; i < kind.value().size(); ++i) {
      tick();
      model.add_object(*type);
    }
  }
}

template <class T>
void fill_objects(const T& objects, const Place& at, model::Model& model, ValueReader<T>& values) {
  Objects(model, values).fill(objects, at);
}

template void make_objects(const Tree&, const Place&, model::Model&);
template void fill_objects(const Tree&, const Place&, model::Model&, Values&);

}  // namespace capstan::json
