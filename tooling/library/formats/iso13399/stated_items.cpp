#include "tooling/library/formats/iso13399/stated_items.h"

#include <map>
#include <set>
#include <utility>

#include "tooling/library/formats/item/item.h"

namespace capstan::tooling::iso13399 {
namespace {

using p21::Instance;
using p21::Kind;
using p21::Value;

std::string plain(const Value& v) {
  if (v.is(Kind::kString)) return v.as_text();
  if (v.is_number() || v.is(Kind::kEnumeration)) return std::string(v.lexeme());
  return {};
}

class Reader {
 public:
  Reader(const p21::File& f, const std::string& file, LossReport& report)
      : f_(f), file_(file), report_(report) {}

  Result<std::vector<Item>> read() {
    if (Status s = collect(); !s) return fail(s.error());
    if (Status s = associate(); !s) return fail(s.error());
    std::vector<Item> out;
    for (const std::uint64_t id : order_) out.push_back(std::move(items_.at(id)));
    return out;
  }

 private:
  tl::unexpected<Diagnostic> form(const Instance& i, std::string what, std::string expected) {
    return fail({.code = "ISO13399-FORM",
                 .message = std::string(i.keyword()) + ": " + std::move(what),
                 .file = file_,
                 .line = i.line(),
                 .instance = i.id(),
                 .expected = std::move(expected)});
  }

  /// The instance a parameter refers to. Nothing for $, * and other kinds.
  Result<std::optional<Instance>> target(const Instance& from, const Value& v) {
    if (!v.is(Kind::kReference)) return std::optional<Instance>();
    auto found = f_.find(v.reference());
    if (!found)
      return fail({.code = "ISO13399-DANGLING",
                   .message = std::string(from.keyword()) + " refers to #" + std::to_string(v.reference()) +
                              ", which the file does not hold",
                   .file = file_,
                   .line = from.line(),
                   .instance = from.id(),
                   .expected = "the instance"});
    return found;
  }

  /// The text of a string, or of MULTI_LANGUAGE_STRING and STRING_WITH_LANGUAGE below it.
  Result<std::string> text_of(const Instance& from, const Value& v) {
    Value at = v;
    Instance owner = from;
    for (int depth = 0; depth < 4; ++depth) {
      if (!at.is(Kind::kReference)) return plain(at);
      auto t = target(owner, at);
      if (!t) return fail(t.error());
      const Value p = (**t).parameters();
      if ((**t).keyword() == "MULTI_LANGUAGE_STRING" && p.size() > 1) {
        at = p[1];
      } else if ((**t).keyword() == "STRING_WITH_LANGUAGE" && !p.empty()) {
        at = p[0];
      } else {
        return std::string();
      }
      owner = **t;
    }
    return std::string();
  }

  Status collect() {
    for (const Instance& i : f_) {
      if (i.is_complex()) continue;
      const std::string_view k = i.keyword();
      const Value p = i.parameters();
      if (k == "ITEM") {
        if (Status s = item(i, p); !s) return s;
      } else if (k == "ITEM_VERSION") {
        if (Status s = link(i, p, "ITEM"); !s) return s;
      } else if (k == "ITEM_DEFINITION") {
        if (Status s = link(i, p, "ITEM_VERSION"); !s) return s;
      } else if (k == "NUMERICAL_VALUE" || k == "STRING_VALUE") {
        if (Status s = value(i, p); !s) return s;
      }
    }
    for (const Instance& i : f_) {
      const std::string_view k = i.keyword();
      if (k == "SPECIFIC_ITEM_CLASSIFICATION") {
        if (Status s = role(i); !s) return s;
      } else if (k == "CLASSIFICATION_ASSOCIATION") {
        if (Status s = classification(i); !s) return s;
      } else if (k == "PERSON_ORGANIZATION_ASSIGNMENT") {
        if (Status s = maker(i); !s) return s;
      }
    }
    return only_maker();
  }

  Status item(const Instance& i, const Value& p) {
    if (p.size() != 3) return form(i, std::to_string(p.size()) + " parameters", "description, id, name");
    Item out;
    out.id = i.id();
    out.line = i.line();
    auto description = text_of(i, p[0]), name = text_of(i, p[2]);
    if (!description) return fail(description.error());
    if (!name) return fail(name.error());
    if (!p[1].is(Kind::kString)) return form(i, "its id is no string", "'order number'");
    out.number = p[1].as_text();
    out.description = *description;
    out.name = *name;
    order_.push_back(i.id());
    items_.emplace(i.id(), std::move(out));
    return {};
  }

  /// ITEM_VERSION(item, ..), ITEM_DEFINITION(version, ..): keeps the link; its owner is looked up later.
  Status link(const Instance& i, const Value& p, std::string_view wanted) {
    if (p.empty() || !p[0].is(Kind::kReference))
      return form(i, "its first parameter is no reference", "a " + std::string(wanted));
    auto t = target(i, p[0]);
    if (!t) return fail(t.error());
    if ((**t).keyword() != wanted)
      return form(i, "it refers to a " + std::string((**t).keyword()), "a " + std::string(wanted));
    parent_[i.id()] = (**t).id();
    return {};
  }

  Status value(const Instance& i, const Value& p) {
    const bool number = i.keyword() == "NUMERICAL_VALUE";
    const std::size_t n = number ? 4 : 2;
    if (p.size() < n)
      return form(i, std::to_string(p.size()) + " parameters",
                  number ? "name, significant digits, unit, value" : "name, text");
    Stated out;
    out.id = i.id();
    out.line = i.line();
    out.name = plain(p[0]);
    const Value& v = p[n - 1];
    if (number && !v.is(Kind::kString) && !v.is_number() && !v.is(Kind::kOmitted))
      return form(i, std::string("its value is a ") + p21::to_text(v.kind()), "a number, quoted or not");
    auto text = text_of(i, v);
    if (!text) return fail(text.error());
    out.text = *std::move(text);
    if (number) {
      auto unit = target(i, p[2]);
      if (!unit) return fail(unit.error());
      if (*unit) {
        if ((**unit).keyword() != "UNIT" || (**unit).parameters().empty())
          return form(i, "its unit is a " + std::string((**unit).keyword()), "a UNIT('mm')");
        out.unit = plain((**unit).parameters()[0]);
      }
    }
    values_.emplace(i.id(), std::move(out));
    return {};
  }

  std::optional<std::uint64_t> item_of(std::uint64_t id) const {
    for (int depth = 0; depth < 4; ++depth) {
      if (items_.contains(id)) return id;
      const auto up = parent_.find(id);
      if (up == parent_.end()) return std::nullopt;
      id = up->second;
    }
    return std::nullopt;
  }

  Status role(const Instance& i) {
    const Value p = i.parameters();
    if (p.size() < 2 || !p[0].is(Kind::kList) || !p[1].is(Kind::kString))
      return form(i, "not a list of items and a role", "(#items), 'tool item'");
    const std::string name = p[1].as_text();
    if (name != "tool item" && name != "adaptive item" && name != "cutting item" && name != "assembly item")
      return {};
    for (std::size_t n = 0; n < p[0].size(); ++n) {
      auto t = target(i, p[0][n]);
      if (!t) return fail(t.error());
      if (!*t || !items_.contains((**t).id()))
        return form(i, "one of its items is none", "references to ITEM");
      items_.at((**t).id()).role = name;
    }
    return {};
  }

  /// GENERAL_CLASSIFICATION(source, description, id, ..) of an item; its id is the class in some system.
  Status classification(const Instance& i) {
    const Value p = i.parameters();
    if (p.size() < 2) return {};
    auto general = target(i, p[0]), element = target(i, p[1]);
    if (!general) return fail(general.error());
    if (!element) return fail(element.error());
    if (!*general || !*element || (**general).keyword() != "GENERAL_CLASSIFICATION") return {};
    const auto owner = item_of((**element).id());
    const Value g = (**general).parameters();
    if (!owner || g.size() < 3) return {};
    auto about = text_of(**general, g[1]), id = text_of(**general, g[2]);
    if (!about) return fail(about.error());
    if (!id) return fail(id.error());
    Item& item = items_.at(*owner);
    if (*about == "ISO 14649-111 tool body") {
      item.cutter_class = model::cutter_class_from_text(*id);
    } else if (*about == kNotPlanned) {
      item.left_out = *id;
    } else if (!id->empty()) {
      item.kind = *id;
    }
    return {};
  }

  /// ORGANIZATION(address, id, name, ..)
  Result<std::string> organization(const Instance& i) {
    const Value p = i.parameters();
    if (p.size() < 3) return std::string();
    std::string name = plain(p[2]);
    return name.empty() ? plain(p[1]) : name;
  }

  Status maker(const Instance& i) {
    const Value p = i.parameters();
    if (p.size() < 3 || !p[2].is(Kind::kList)) return {};
    auto who = target(i, p[0]);
    if (!who) return fail(who.error());
    if (!*who || (**who).keyword() != "ORGANIZATION") return {};
    auto name = organization(**who);
    for (std::size_t n = 0; n < p[2].size(); ++n) {
      auto t = target(i, p[2][n]);
      if (!t) return fail(t.error());
      if (const auto owner = *t ? item_of((**t).id()) : std::nullopt) items_.at(*owner).maker = *name;
    }
    return {};
  }

  Status only_maker() {
    std::optional<Instance> one;
    for (const Instance& i : f_) {
      if (i.keyword() != "ORGANIZATION") continue;
      if (one) return {};
      one = i;
    }
    if (!one) return {};
    auto name = organization(*one);
    for (auto& [id, item] : items_) {
      if (!item.maker.empty() || name->empty()) continue;
      item.maker = *name;
      report_.derived.push_back({item.number, "manufacturer", "the only organization of the file"});
    }
    return {};
  }

  /// PROPERTY_VALUE_ASSOCIATION(.., element, representation, ..): the first reference to an item or its
  /// definition and the first to a representation, wherever a maker's file has them.
  Status associate() {
    std::set<std::uint64_t> tied;
    for (const Instance& i : f_) {
      if (i.keyword() != "PROPERTY_VALUE_ASSOCIATION") continue;
      const Value p = i.parameters();
      std::optional<std::uint64_t> owner;
      std::optional<Instance> representation;
      for (std::size_t n = 0; n < p.size(); ++n) {
        auto t = target(i, p[n]);
        if (!t) return fail(t.error());
        if (!*t) continue;
        if (!owner) owner = item_of((**t).id());
        if (!representation && (**t).keyword() == "PROPERTY_VALUE_REPRESENTATION") representation = **t;
      }
      if (!representation) return form(i, "no value", "a PROPERTY_VALUE_REPRESENTATION");
      auto v = represented(*representation);
      if (!v) return fail(v.error());
      if (*v) tied.insert((**v).id);
      if (!owner) return form(i, "no item", "an ITEM_DEFINITION");
      if (*v) items_.at(*owner).values.push_back(**std::move(v));
    }
    untied(tied);
    return {};
  }

  void untied(const std::set<std::uint64_t>& tied) {
    std::size_t left = 0;
    for (const auto& [id, v] : values_) {
      if (tied.contains(id)) continue;
      if (items_.size() == 1) {
        items_.begin()->second.values.push_back(v);
      } else {
        report_.dropped.push_back({"", v.name, "nothing ties #" + std::to_string(id) + " to an item"});
      }
      ++left;
    }
    if (left > 0 && items_.size() == 1)
      report_.derived.push_back(
          {items_.begin()->second.number, "",
           std::to_string(left) + " values that nothing ties to an item are those of the file's only one"});
  }

  /// PROPERTY_VALUE_REPRESENTATION(property, .., value, ..)
  Result<std::optional<Stated>> represented(const Instance& i) {
    const Value p = i.parameters();
    std::optional<Stated> out;
    std::optional<Instance> property;
    for (std::size_t n = 0; n < p.size(); ++n) {
      auto t = target(i, p[n]);
      if (!t) return fail(t.error());
      if (!*t) continue;
      if (const auto v = values_.find((**t).id()); v != values_.end() && !out) out = v->second;
      if ((**t).keyword() == "PROPERTY") property = **t;
    }
    if (!out) {
      report_.dropped.push_back({"", "", "#" + std::to_string(i.id()) + ": neither number nor text"});
      return out;
    }
    if (property) {
      if (Status s = describe(*property, *out); !s) return fail(s.error());
    }
    return out;
  }

  /// PROPERTY(unit, description, id, source, ..)
  Status describe(const Instance& property, Stated& v) {
    const Value p = property.parameters();
    for (std::size_t n = 0; n < p.size(); ++n) {
      auto t = target(property, p[n]);
      if (!t) return fail(t.error());
      if (!*t) continue;
      const Value source = (**t).parameters();
      if ((**t).keyword() == "PLIB_PROPERTY_REFERENCE" && !source.empty()) v.bsu = plain(source[0]);
    }
    if (p.size() > 2) {
      auto about = text_of(property, p[1]);
      if (!about) return fail(about.error());
      v.property = plain(p[2]);
      for (const ValueState s : {ValueState::kDerived, ValueState::kDefault}) {
        const std::string word(to_text(s));
        if (!about->starts_with(word)) continue;
        v.state = s;
        v.why = about->size() > word.size() + 2 ? about->substr(word.size() + 2) : std::string();
      }
    }
    return {};
  }

  const p21::File& f_;
  const std::string& file_;
  LossReport& report_;
  std::map<std::uint64_t, Item> items_;
  std::vector<std::uint64_t> order_;
  std::map<std::uint64_t, std::uint64_t> parent_;
  std::map<std::uint64_t, Stated> values_;
};

}  // namespace

Result<std::vector<Item>> stated_items(const p21::File& f, const std::string& file, LossReport& report) {
  return Reader(f, file, report).read();
}

}  // namespace capstan::tooling::iso13399
