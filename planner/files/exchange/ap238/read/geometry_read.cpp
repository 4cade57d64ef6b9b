#include <algorithm>
#include <cmath>
#include <numbers>

#include "planner/files/exchange/ap238/read/reader.h"
#include "planner/files/exchange/common/text.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

// Geometry has the same entities in both standards (ISO 10303-42): attributes go by name, numbers by the
// units of the representation.

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::Storage;
using model::TypeId;
using p21::Kind;
using p21::Value;

std::optional<TypeId> Reader::geometry_type(Node n, bool solids) const {
  const auto i = g_.instance(n);
  if (i.is_complex()) return std::nullopt;
  const EntityId entity = g_.entity(n);
  if (entity == express::kNoEntity) return geometry_type(i.keyword(), solids);
  if (entity != type_before_.entity || solids != type_before_.solids)
    type_before_ = {entity, solids, geometry_type(i.keyword(), solids)};
  return type_before_.type;
}

std::optional<TypeId> Reader::geometry_type(std::string_view keyword, bool solids) {
  const auto t = model::find_noun(keyword);
  if (!t || model::noun_type(*t).abstract) return std::nullopt;
  const bool item = model::is_a(*t, TypeId::kRepresentationItem) || *t == TypeId::kCompositeCurveSegment;
  const bool solid = item && (model::is_a(*t, TypeId::kTopologicalRepresentationItem) ||
                              model::is_a(*t, TypeId::kSolidModel));
  if (!item || (solid && !solids)) {
    return std::nullopt;
  }
  return t;
}

AnyRef Reader::geometry_met(Node n, std::size_t scale) const {
  const Placed& first = geometry_[n];
  if (!first.at.set() || first.scale == scale) return first.at;
  const auto it = geometry_again_.find(key_of(n, scale));
  return it == geometry_again_.end() ? AnyRef{} : it->second;
}

AnyRef Reader::geometry_at(Node n, TypeId type, const Scale& stated) {
  Scale scale = stated;
  // Nothing of these is an angle: the same in a context with degrees as in one with radians.
  for (const TypeId t : {TypeId::kPlacement, TypeId::kPoint, TypeId::kDirection, TypeId::kVector}) {
    if (model::is_a(type, t)) scale.angle = 1.0;
  }
  const auto at_scale = std::find_if(scales_.begin(), scales_.end(), [&](const Scale& s) {
    return s.length == scale.length && s.angle == scale.angle && s.coordinates == scale.coordinates;
  });
  const auto in = static_cast<std::size_t>(at_scale - scales_.begin());
  if (at_scale == scales_.end()) scales_.push_back(scale);
  if (const AnyRef met = geometry_met(n, in); met.set()) return met;
  const AnyRef at = plan_.model.add_object(type);
  const auto i = g_.instance(n);
  plan_.model.set_origin(at, {i.id(), i.line()});
  if (geometry_[n].at.set()) {
    geometry_again_.emplace(key_of(n, in), at);
  } else {
    geometry_[n] = {at, static_cast<std::uint32_t>(in)};
  }
  if (type == TypeId::kPolyline && scale.uncertainty_mm > 0.0) uncertainty_mm_[at] = scale.uncertainty_mm;
  if (scale.unclear && !model::is_a(type, TypeId::kDirection)) {
    doubts_.push_back({at,
                       {.code = "EXC-UNIT",
                        .message = "the context of " + std::string(model::noun_type(type).keyword) +
                                   " does not say in which unit lengths are, or says two",
                        .hint = "give its GLOBAL_UNIT_ASSIGNED_CONTEXT one length unit"}});
  }
  object_[n] = true;
  if (scale_before_ >= pending_scales_.size() || !(pending_scales_[scale_before_] == scale)) {
    const auto known = std::find(pending_scales_.begin(), pending_scales_.end(), scale);
    scale_before_ = static_cast<std::uint32_t>(known - pending_scales_.begin());
    if (known == pending_scales_.end()) pending_scales_.push_back(scale);
  }
  pending_.push_back({at, n, scale_before_});
  return at;
}

// Parameters of circles and ellipses are angles in the context's unit; the model has them in degrees, as ISO
// 14649.
double Reader::parameter_factor(Node n, const Scale& scale) const {
  const Value basis = g_.get(n, "basis_curve");
  const Node curve = basis.is(Kind::kReference) ? g_.find(basis.reference()) : kNoNode;
  const auto is = [&](const char* entity) {
    return curve != kNoNode && g_.is(curve, g_.schema().find(entity));
  };
  return is("CIRCLE") || is("ELLIPSE") ? scale.angle * 180.0 / std::numbers::pi : 1.0;
}

void Reader::fill_geometry(AnyRef at, Node n, const Scale& scale) {
  const auto factor = [&](const Attribute& a) {
    return a.unit == model::Unit::kLength ? scale.length : a.unit == model::Unit::kAngle ? scale.angle : 1.0;
  };
  const auto coordinate = [&](const Attribute& a, std::size_t i) {
    if (a.unit != model::Unit::kLength || scale.coordinates == Coordinates::kLengths) return factor(a);
    if (scale.coordinates == Coordinates::kNumbers) return 1.0;
    return i == 4 ? scale.length * scale.length : scale.length;
  };
  const auto reference = [&](const Value& v, const Attribute& a) {
    const Node to = v.is(Kind::kReference) ? g_.find(v.reference()) : kNoNode;
    return to == kNoNode ? AnyRef{} : object_at(to, a.targets, scale);
  };
  const auto number = [](const Value& v) { return v.is(Kind::kTyped) ? v[0] : v; };
  for (const Attribute& a : model::noun_type(at.type).attributes) {
    const Value v = g_.get(n, a.name);
    if (v.is(Kind::kOmitted) || v.is(Kind::kDerived)) continue;
    const auto slot = [&]<class T>(T value) {
      *static_cast<T*>(a.at(plan_.model.object(at))) = std::move(value);
    };
    // How much it matters is known when everything is read.
    const auto wrong = [&](const char* expected) {
      doubts_.push_back({at,
                         {.code = "EXC-VALUE",
                          .message = attribute_name(at, a.name) + " cannot be " + spelling(v).substr(0, 60),
                          .expected = expected},
                         std::string(a.name)});
    };
    // A list with a fault is left out whole: one element less would move those behind it.
    const auto faulty = [&, before = doubts_.size()] { return doubts_.size() != before; };
    const auto scaled = [&](const Value& e, double by) -> std::optional<double> {
      if (!number(e).is_number()) {
        wrong("a number");
        return std::nullopt;
      }
      const double x = number(e).as_real() * by;
      if (std::isfinite(x)) return x;
      wrong("a number that is finite in millimetres and radians");
      return std::nullopt;
    };
    const auto each = [&](const auto& take) {
      if (!v.is(Kind::kList)) return wrong("a list");
      for (std::size_t i = 0; i < v.size(); ++i) take(v[i]);
    };
    switch (a.storage) {
      case Storage::kReal:
        if (const auto x = scaled(v, factor(a))) slot(model::Real(*x));
        break;
      case Storage::kInteger:
        if (v.is(Kind::kInteger)) {
          slot(model::Integer(v.as_integer()));
        } else {
          wrong("an integer");
        }
        break;
      case Storage::kBoolean:
        if (v.is(Kind::kEnumeration)) slot(model::Boolean(v.enumeration() == "T"));
        break;
      case Storage::kText:
        if (v.is(Kind::kString)) slot(model::Text(v.as_text()));
        break;
      case Storage::kEnum: {
        const auto e = v.is(Kind::kEnumeration)
                           ? std::find(a.enumerators.begin(), a.enumerators.end(), v.enumeration())
                           : a.enumerators.end();
        if (e == a.enumerators.end()) {
          wrong("another enumerator");
        } else {
          slot(model::AnyEnum{static_cast<std::int8_t>(e - a.enumerators.begin())});
        }
        break;
      }
      case Storage::kRef:
        slot(reference(v, a));
        break;
      case Storage::kRefList: {
        model::AnyRefList out;
        out.given = true;
        out.items.reserve(v.size());
        each([&](const Value& e) {
          if (const AnyRef r = reference(e, a); r.set()) out.items.push_back(r);
        });
        slot(std::move(out));
        break;
      }
      case Storage::kRefTable: {
        model::RefTable out;
        out.given = true;
        each([&](const Value& row) {
          out.items.emplace_back();
          for (std::size_t k = 0; row.is(Kind::kList) && k < row.size(); ++k) {
            out.items.back().push_back(reference(row[k], a));
          }
        });
        slot(std::move(out));
        break;
      }
      case Storage::kRealList: {
        model::RealList out;
        out.given = true;
        out.items.reserve(v.size());
        each([&](const Value& e) {
          if (const auto x = scaled(e, coordinate(a, out.items.size()))) out.items.push_back(*x);
        });
        if (faulty()) out.items.clear();
        slot(std::move(out));
        break;
      }
      case Storage::kIntegerList: {
        model::IntegerList out;
        out.given = true;
        each([&](const Value& e) {
          if (!e.is(Kind::kInteger)) return wrong("integers");
          out.items.push_back(e.as_integer());
        });
        if (faulty()) out.items.clear();
        slot(std::move(out));
        break;
      }
      case Storage::kRealTable: {
        model::RealTable out;
        out.given = true;
        each([&](const Value& row) {
          out.items.emplace_back();
          if (!row.is(Kind::kList)) return wrong("lists of numbers");
          for (std::size_t k = 0; k < row.size(); ++k) {
            if (const auto x = scaled(row[k], 1.0)) out.items.back().push_back(*x);
          }
        });
        if (faulty()) out.items.clear();
        slot(std::move(out));
        break;
      }
      case Storage::kSelectList: {  // trimming_select: a parameter or a point
        model::SelectList out;
        out.given = true;
        each([&](const Value& e) {
          model::SelectValue s;
          if (e.is(Kind::kReference)) {
            s.ref = reference(e, a);
          } else if (number(e).is_number()) {
            s.real = number(e).as_real() * parameter_factor(n, scale);
            if (e.is(Kind::kTyped)) s.type = e.keyword();
          }
          if (s.set()) out.items.push_back(std::move(s));
        });
        slot(std::move(out));
        break;
      }
      case Storage::kSelect:
      case Storage::kTextList:
      case Storage::kPath:
        break;
    }
  }
}

}  // namespace capstan::exchange::ap238
