#include "planner/files/exchange/conformance/rules.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "planner/files/exchange/conformance/links.h"

namespace capstan::exchange::conformance {
namespace {

using express::EntityId;
using express::kNoEntity;
using p21::Kind;
using p21::Value;

bool among(const Names& names, const std::optional<std::string>& text) {
  return text && std::find(names.begin(), names.end(), *text) != names.end();
}

std::string quoted(const Names& names) {
  std::string out;
  for (const auto& n : names) out += (out.empty() ? "'" : " or '") + n + "'";
  return out;
}

// How often the rules may look at an element of a list, per instance of the file: real files need about 2.
// Default, unsourced.
constexpr std::size_t kVisitsPerInstance = 100;
constexpr std::size_t kSmallFile = 10000;

std::string times(std::size_t n) { return n == 1 ? "once" : n == 2 ? "twice" : std::to_string(n) + " times"; }

std::string counted(const Rule& r) {
  if (r.least == r.most) return std::to_string(r.least);
  if (r.most == std::numeric_limits<std::size_t>::max()) return "at least " + std::to_string(r.least);
  return std::to_string(r.least) + " to " + std::to_string(r.most);
}

// The dimension of a unit, as far as its parts are known.
class Units {
 public:
  Units(const Links& links, const express::Dictionary& d)
      : links_(links),
        derived_(d.find("derived_unit")),
        kinds_{{{d.find("length_unit"), {1.0, 0.0, false, false}},
                {d.find("time_unit"), {0.0, 1.0, false, false}},
                {d.find("plane_angle_unit"), {0.0, 0.0, true, false}},
                {d.find("ratio_unit"), {0.0, 0.0, false, true}},
                {d.find("frequency_unit"), {0.0, -1.0, false, false}},
                {d.find("velocity_unit"), {1.0, -1.0, false, false}}}} {}

  [[nodiscard]] std::optional<Dimension> of(std::size_t unit) const {
    for (const auto& [entity, dimension] : kinds_) {
      if (entity != kNoEntity && links_.is_a(unit, entity)) return dimension;
    }
    if (!links_.is_a(unit, derived_)) return std::nullopt;
    Dimension sum;
    for (const std::size_t element : links_.targets(unit, "derived_unit.elements")) {
      const auto base = links_.target(element, "derived_unit_element.unit");
      const auto exponent = links_.value(element, "derived_unit_element.exponent");
      // An element is a named unit, never a derived one: no recursion.
      if (!base || !exponent || !exponent->is_number() || links_.is_a(*base, derived_)) return std::nullopt;
      const auto d = of(*base);
      if (!d) return std::nullopt;
      sum.length += d->length * exponent->as_real();
      sum.time += d->time * exponent->as_real();
    }
    return sum;
  }

  /// False only where the unit is known to be of another dimension.
  [[nodiscard]] bool fits(std::size_t measure, const std::string& wanted) const {
    const auto unit = links_.target(measure, "measure_with_unit.unit_component");
    if (!unit) return true;
    const auto d = of(*unit);
    if (!d) return true;
    if (wanted == "angle") return d->angle;
    if (wanted == "ratio") return d->length == 0.0 && d->time == 0.0;
    const double length = wanted.rfind("length", 0) == 0 ? 1.0 : 0.0;
    const double time = wanted == "time" ? 1.0 : wanted.ends_with("/time") ? -1.0 : 0.0;
    return d->length == length && d->time == time;
  }

 private:
  const Links& links_;
  EntityId derived_;
  std::array<std::pair<EntityId, Dimension>, 6> kinds_;
};

class RuleCheck {
 public:
  RuleCheck(const Population& population, std::span<const Rule> rules, Faults& faults)
      : p_(population), faults_(faults), links_(population), units_(links_, population.dictionary()) {
    const auto& d = population.dictionary();
    parameters_ = d.find("shape_representation_with_parameters");
    descriptive_ = d.find("descriptive_representation_item");
    measure_ = d.find("measure_representation_item");
    body_ = d.find("machining_tool_body_representation");
    shape_ = d.find("product_definition_shape");
    for (const Layout& layout : population.layouts()) {
      auto& mine = rules_of_.emplace_back();
      for (const Rule& r : rules) {
        if (population.is_a(layout, r.entity)) mine.push_back(&r);
      }
    }
  }

  void run() {
    // Items may be shared by any number of representations and these by any number of properties.
    const std::size_t budget = kVisitsPerInstance * (p_.file().size() + kSmallFile);
    for (std::size_t i = 0; i < p_.file().size(); ++i) {
      const std::uint32_t layout = p_.layout_number(i);
      if (layout == Population::kNone) continue;
      if (links_.visits() > budget) {
        faults_.add(p_.file().instance(i),
                    {"SCH-LIMIT",
                     "the rules of this and the following instances were not checked: too much is shared"});
        return;
      }
      for (const Rule* r : rules_of_[layout]) {
        if (applies(*r, i)) check(*r, i);
      }
    }
  }

 private:
  // An attribute of the instance as the rule's entity sees it ("kind" is the name of a resource's type).
  std::optional<std::string> own(const Rule& r, std::size_t i, const std::string& attribute) const {
    if (attribute == "kind") {
      const auto kind = links_.target(i, "action_resource.kind");
      return kind ? links_.text(*kind, "action_resource_type.name") : std::nullopt;
    }
    const auto& d = p_.dictionary();
    return links_.text(i, std::string(d.keyword(r.entity)) + "." + attribute);
  }

  bool applies(const Rule& r, std::size_t i) const {
    for (const EntityId e : r.unless) {
      if (links_.is_a(i, e)) return false;
    }
    return std::all_of(r.guards.begin(), r.guards.end(),
                       [&](const Guard& g) { return among(g.values, own(r, i, g.attribute)); });
  }

  void fault(const Rule& r, std::size_t i, const std::string& what, const std::string& expected,
             const char* code = "SCH-RULE") {
    std::string where;
    for (const Guard& g : r.guards) {
      const auto value = own(r, i, g.attribute);
      where += " '" + value.value_or("") + "'";
    }
    faults_.add(p_.file().instance(i),
                {code, std::string(p_.dictionary().keyword(r.entity)) + where + " " + what, {}, expected});
  }

  // "has the property 'coolant' twice; expected 1"
  void count(const Rule& r, std::size_t i, std::size_t found, const std::string& thing) {
    if (found >= r.least && found <= r.most) return;
    // A tool, a technology, an allowance, a length of a tool: values that an incomplete plan leaves open.
    const bool open = found == 0 && (r.subject == Subject::kProperty || r.subject == Subject::kResource ||
                                     r.subject == Subject::kTool || r.subject == Subject::kTools ||
                                     r.subject == Subject::kMethod);
    fault(r, i, found == 0 ? "has no " + thing : "has the " + thing + " " + times(found), counted(r),
          open ? kOpenCode : "SCH-RULE");
  }

  bool is_all(std::size_t item, const std::vector<EntityId>& entities) const {
    return std::all_of(entities.begin(), entities.end(), [&](EntityId e) { return links_.is_a(item, e); });
  }

  // Whether an item of a representation has the form.
  bool item_fits(const Form& f, std::size_t item) const {
    if (!is_all(item, f.item)) return false;
    if (f.value == Form::Value::kText) {
      if (!links_.is_a(item, descriptive_)) return false;
      if (!f.texts.empty() &&
          !among(f.texts, links_.text(item, "descriptive_representation_item.description")))
        return false;
    }
    if (f.value == Form::Value::kCount || f.value == Form::Value::kNumber) {
      const auto v = links_.value(item, "measure_with_unit.value_component");
      const char* wanted = f.value == Form::Value::kCount ? "COUNT_MEASURE" : "NUMERIC_MEASURE";
      if (!links_.is_a(item, measure_) || !v || !v->is(Kind::kTyped) || v->keyword() != wanted) return false;
    }
    return f.unit.empty() || units_.fits(item, f.unit);
  }

  static bool about_items(const Form& f) {
    return !f.item.empty() || f.value != Form::Value::kAny || !f.unit.empty();
  }

  bool representation_fits(const Form& f, std::size_t representation) const {
    if (!is_all(representation, f.representation)) return false;
    if (!f.named.empty() && !among(f.named, links_.text(representation, "representation.name"))) return false;
    if (!about_items(f)) return true;
    const auto items = links_.targets(representation, "representation.items");
    return std::any_of(items.begin(), items.end(), [&](std::size_t item) { return item_fits(f, item); });
  }

  // Action or resource properties of the name, and the form of each.
  void properties(const Rule& r, std::size_t i, Link of, Link shown, const std::string& entity) {
    std::size_t found = 0;
    for (const std::size_t property : links_.to(of, i)) {
      if (!among(r.names, links_.text(property, entity + ".name"))) continue;
      ++found;
      if (r.form.text.empty()) continue;
      const auto representations = links_.to(shown, property);
      const bool fits = std::any_of(representations.begin(), representations.end(), [&](std::size_t link) {
        const auto representation = links_.target(link, entity + "_representation.representation");
        return !representation || representation_fits(r.form, *representation);
      });
      if (!fits)
        fault(r, i, "has a property " + quoted(r.names) + " (#" + id(property) + ") of another form",
              r.form.text);
    }
    count(r, i, found, "property " + quoted(r.names));
  }

  std::string id(std::size_t i) const { return std::to_string(p_.file().instance(i).id()); }

  // Items of the name, and the form of each.
  void items(const Rule& r, std::size_t i, const std::vector<std::size_t>& all, const std::string& what) {
    std::size_t found = 0;
    for (const std::size_t item : all) {
      if (!among(r.names, links_.text(item, "representation_item.name"))) continue;
      ++found;
      if (!r.form.text.empty() && !item_fits(r.form, item))
        fault(r, i, "has " + what + " " + quoted(r.names) + " (#" + id(item) + ") of another form",
              r.form.text);
    }
    count(r, i, found, what + " " + quoted(r.names));
  }

  std::vector<std::size_t> tool_items(std::size_t tool) const {
    std::vector<std::size_t> out;
    for (const std::size_t property : links_.to(Link::kResourcePropertyOf, tool)) {
      if (links_.text(property, "resource_property.name") != "tool body") continue;
      for (const std::size_t link : links_.to(Link::kResourcePropertyShown, property)) {
        const auto representation = links_.target(link, "resource_property_representation.representation");
        if (!representation || !links_.is_a(*representation, body_)) continue;
        const auto more = links_.targets(*representation, "representation.items");
        out.insert(out.end(), more.begin(), more.end());
      }
    }
    return out;
  }

  // Representations of this kind that the instance's property definitions have.
  std::vector<std::size_t> shapes(std::size_t i, EntityId kind) const {
    std::vector<std::size_t> out;
    for (const std::size_t definition : links_.to(Link::kPropertyOf, i)) {
      for (const std::size_t link : links_.to(Link::kPropertyShown, definition)) {
        const auto representation =
            links_.target(link, "property_definition_representation.used_representation");
        if (representation && links_.is_a(*representation, kind)) out.push_back(*representation);
      }
    }
    return out;
  }

  void parameter(const Rule& r, std::size_t i) {
    for (const std::size_t representation : shapes(i, parameters_)) {
      std::size_t found = 0;
      for (const std::size_t item : links_.targets(representation, "representation.items")) {
        if (among(r.names, links_.text(item, "representation_item.name")) && item_fits(r.form, item)) ++found;
      }
      count(r, i, found, "parameter " + quoted(r.names) + (r.form.text.empty() ? "" : " as " + r.form.text));
    }
  }

  void parameters(const Rule& r, std::size_t i) {
    for (const std::size_t representation : shapes(i, parameters_)) {
      const auto all = links_.targets(representation, "representation.items");
      if (r.names.empty()) {
        if (all.size() < r.least || all.size() > r.most)
          fault(r, i, "has " + std::to_string(all.size()) + (all.size() == 1 ? " parameter" : " parameters"),
                counted(r));
        continue;
      }
      for (const std::size_t item : all) {
        const auto name = links_.text(item, "representation_item.name");
        if (name && !among(r.names, name))
          fault(r, i, "has a parameter '" + *name + "' (#" + id(item) + ")", quoted(r.names));
      }
    }
  }

  void shape(const Rule& r, std::size_t i) {
    if (links_.to(Link::kPropertyOf, i).empty()) return;
    std::size_t found = 0;
    for (const std::size_t representation : shapes(i, r.type)) {
      if (r.names.empty() || among(r.names, links_.text(representation, "representation.name"))) ++found;
    }
    count(r, i, found, keyword(r.type) + (r.names.empty() ? "" : " " + quoted(r.names)));
  }

  std::string keyword(EntityId e) const { return std::string(p_.dictionary().keyword(e)); }
  std::string keywords(const std::vector<EntityId>& entities) const {
    std::string out;
    for (const EntityId e : entities) out += (out.empty() ? "" : " or ") + keyword(e);
    return out;
  }
  // True for one of these entities, or for any if none is named.
  bool is_one(std::size_t instance, const std::vector<EntityId>& entities) const {
    return entities.empty() || std::any_of(entities.begin(), entities.end(),
                                           [&](EntityId e) { return links_.is_a(instance, e); });
  }

  void method(const Rule& r, std::size_t i) {
    std::size_t found = 0;
    for (const std::size_t link : links_.to(Link::kRelationshipFromMethod, i)) {
      if (!links_.is_a(link, r.type)) continue;
      if (!r.names.empty() && !among(r.names, links_.text(link, "action_method_relationship.name"))) continue;
      ++found;
      const auto to = links_.target(link, "action_method_relationship.related_method");
      if (to && !is_one(*to, r.form.to))
        fault(r, i, "leads by #" + id(link) + " (" + keyword(r.type) + ") to #" + id(*to),
              keywords(r.form.to));
    }
    count(r, i, found, keyword(r.type) + (r.names.empty() ? "" : " " + quoted(r.names)));
  }

  void tools(const Rule& r, std::size_t i) {
    std::size_t found = 0;
    for (const std::size_t tool : links_.to(Link::kResourceFor, i))
      found += links_.is_a(tool, r.type) ? 1 : 0;
    count(r, i, found, "tool (a " + keyword(r.type) + " whose usage names it)");
  }

  void action(const Rule& r, std::size_t i) {
    std::size_t found = 0;
    for (const std::size_t action : links_.to(Link::kActionChoosing, i)) {
      if (!among(r.names, links_.text(action, "action.name"))) continue;
      ++found;
      if (!is_one(action, r.form.to)) fault(r, i, "is chosen by #" + id(action), keywords(r.form.to));
    }
    count(r, i, found, "action " + quoted(r.names));
  }

  // Whether one relationship leads from such a component to the shape aspect.
  bool component(const Rule& r, std::size_t aspect) const {
    std::size_t found = 0;
    for (const std::size_t link : links_.to(Link::kRelationshipToAspect, aspect)) {
      if (!links_.is_a(link, r.type)) continue;
      if (!among(r.by, links_.text(link, "shape_aspect_relationship.description"))) continue;
      if (!r.as_name.empty() && !among(r.as_name, links_.text(link, "shape_aspect_relationship.name")))
        continue;
      const auto from = links_.target(link, "shape_aspect_relationship.relating_shape_aspect");
      if (!from) continue;
      const bool kind =
          std::any_of(r.from.begin(), r.from.end(), [&](EntityId e) { return links_.is_a(*from, e); });
      if (!kind) continue;
      if (!r.component_description.empty() &&
          !among(r.component_description, links_.text(*from, "shape_aspect.description")))
        continue;
      ++found;
    }
    return found == 1;
  }

  void aspect(const Rule& r, std::size_t i) {
    for (const std::size_t definition : links_.to(Link::kPropertyOf, i)) {
      if (!links_.is_a(definition, shape_)) continue;
      std::size_t found = 0;
      for (const std::size_t occurrence : links_.to(Link::kAspectOf, definition)) {
        if (among(r.names, links_.text(occurrence, "shape_aspect.description")) && component(r, occurrence))
          ++found;
      }
      std::string from;
      for (const EntityId e : r.from) from += (from.empty() ? "" : " or ") + keyword(e);
      if (!r.component_description.empty()) from += " " + quoted(r.component_description);
      count(r, i, found,
            "shape aspect " + quoted(r.names) + " with a " + keyword(r.type) + " " + quoted(r.by) +
                (r.as_name.empty() ? "" : " named " + quoted(r.as_name)) + " from a " + from);
    }
  }

  void of(const Rule& r, std::size_t i) {
    auto at = links_.target(i, "shape_aspect.of_shape");
    if (at && r.subject == Subject::kOf) at = links_.target(*at, "property_definition.definition");
    if (at && !links_.is_a(*at, r.type)) fault(r, i, "is of #" + id(*at), keyword(r.type));
  }

  void check(const Rule& r, std::size_t i) {
    switch (r.subject) {
      case Subject::kOwn: {
        const auto value = own(r, i, r.attribute);
        if (value && !among(r.names, value))
          fault(r, i, "has the " + r.attribute + " '" + *value + "'", quoted(r.names));
        return;
      }
      case Subject::kProperty:
        return properties(r, i, Link::kActionPropertyOf, Link::kActionPropertyShown, "action_property");
      case Subject::kResource:
        return properties(r, i, Link::kResourcePropertyOf, Link::kResourcePropertyShown, "resource_property");
      case Subject::kTool:
        return items(r, i, tool_items(i), "tool body item");
      case Subject::kItem:
        return items(r, i, links_.targets(i, "representation.items"), "item");
      case Subject::kParameter:
        return parameter(r, i);
      case Subject::kParameters:
        return parameters(r, i);
      case Subject::kShape:
        return shape(r, i);
      case Subject::kMethod:
        return method(r, i);
      case Subject::kTools:
        return tools(r, i);
      case Subject::kAction:
        return action(r, i);
      case Subject::kAspect:
        return aspect(r, i);
      case Subject::kOf:
      case Subject::kOfShape:
        return of(r, i);
      case Subject::kUnit:
        if (!units_.fits(i, r.form.unit)) fault(r, i, "has a unit of another kind", r.form.unit);
        return;
    }
  }

  const Population& p_;
  Faults& faults_;
  Links links_;
  Units units_;
  EntityId parameters_, descriptive_, measure_, body_, shape_;
  std::vector<std::vector<const Rule*>> rules_of_;
};

}  // namespace

void check_rules(const Population& population, std::span<const Rule> rules, Faults& faults) {
  RuleCheck(population, rules, faults).run();
}

}  // namespace capstan::exchange::conformance
