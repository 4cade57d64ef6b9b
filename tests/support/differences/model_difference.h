#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/plan.h"

namespace capstan::testing {

struct DifferenceOptions {
  double tolerance = 1e-9;            ///< of real numbers, relative above 1
  bool item_names = true;             ///< names of geometry (AP238 fixes some of them by role)
  std::vector<std::string> left_out;  ///< "KEYWORD.attribute" that are not compared
};

/// Compares what two plans' projects and features lead to, attribute by attribute; objects correspond when
/// they stand in the same place. Each difference is a path with both values; empty when the models are equal.
class ModelDifference {
 public:
  ModelDifference(const model::Plan& a, const model::Plan& b, DifferenceOptions options = {})
      : a_(a.model), b_(b.model), options_(std::move(options)) {
    refer(a.project, b.project, "/project");
    drain();
    features(a, b);
    drain();
  }
  [[nodiscard]] const std::vector<std::string>& found() const { return found_; }
  /// What stands in the other model in the place of an object; unset: nothing, or nothing leads to it.
  [[nodiscard]] model::AnyRef corresponding(model::AnyRef a) const {
    const auto it = seen_.find(a);
    return it == seen_.end() ? model::AnyRef{} : it->second;
  }
  [[nodiscard]] model::AnyRef corresponding_back(model::AnyRef b) const {
    const auto it = std::find_if(seen_.begin(), seen_.end(), [&](const auto& p) { return p.second == b; });
    return it == seen_.end() ? model::AnyRef{} : it->first;
  }
  [[nodiscard]] bool corresponds(model::AnyRef a, model::AnyRef b) const {
    return !a.set() ? !b.set() : corresponding(a) == b;
  }
  [[nodiscard]] std::string text() const {
    std::string out;
    for (std::size_t i = 0; i < found_.size() && i < 20; ++i) out += found_[i] + "\n";
    if (found_.size() > 20) out += "and " + std::to_string(found_.size() - 20) + " more\n";
    return out;
  }

 private:
  struct Pair {
    model::AnyRef a, b;
    std::string path;
  };

  void features(const model::Plan& a, const model::Plan& b) {
    std::map<std::string, std::vector<model::AnyRef>> left, right;
    const auto collect = [](const model::Model& m, auto& out) {
      for (const auto f : m.all_below(model::TypeId::kManufacturingFeature)) {
        out[m.at<model::ManufacturingFeature>(f).its_id.value_or("")].push_back(f);
      }
    };
    collect(a.model, left);
    collect(b.model, right);
    for (const auto& [id, l] : left) {
      const auto& r = right[id];
      if (l.size() != r.size()) {
        found_.push_back("features '" + id + "': " + std::to_string(l.size()) + " and " +
                         std::to_string(r.size()));
      }
      if (l.size() == 1 && r.size() == 1) refer(l.front(), r.front(), "feature '" + id + "'");
    }
  }

  void refer(model::AnyRef a, model::AnyRef b, const std::string& path) {
    if (!a.set() && !b.set()) return;
    if (a.set() != b.set()) {
      found_.push_back(path + ": " + (a.set() ? "set" : "unset") + " and " + (b.set() ? "set" : "unset"));
      return;
    }
    const auto [it, added] = seen_.emplace(a, b);
    if (added) pending_.push_back({a, b, path});
  }

  void drain() {
    while (!pending_.empty()) {
      const Pair p = pending_.back();
      pending_.pop_back();
      compare(p);
    }
  }

  void compare(const Pair& p) {
    if (p.a.type != p.b.type) {
      found_.push_back(p.path + ": " + std::string(model::noun_type(p.a.type).keyword) + " and " +
                       std::string(model::noun_type(p.b.type).keyword));
      return;
    }
    if (const auto* l = a_.get<model::KeptInstance>(p.a))
      return kept(*l, b_.at<model::KeptInstance>(p.b), p.path);
    for (const model::Attribute& x : model::noun_type(p.a.type).attributes) {
      const std::string name = std::string(model::noun_type(p.a.type).keyword) + "." + std::string(x.name);
      if (std::find(options_.left_out.begin(), options_.left_out.end(), name) != options_.left_out.end())
        continue;
      if (!options_.item_names && x.name == "name" &&
          model::is_a(p.a.type, model::TypeId::kRepresentationItem))
        continue;
      attribute(x, a_.object(p.a), b_.object(p.b), p.path + "." + std::string(x.name));
    }
  }

  void kept(const model::KeptInstance& l, const model::KeptInstance& r, const std::string& path) {
    if (l.keyword != r.keyword || l.pieces.size() != r.pieces.size()) {
      found_.push_back(path + ": kept " + l.keyword + " and " + r.keyword);
      return;
    }
    for (std::size_t i = 0; i < l.pieces.size(); ++i) {
      const auto* x = std::get_if<model::AnyRef>(&l.pieces[i]);
      const auto* y = std::get_if<model::AnyRef>(&r.pieces[i]);
      if ((x == nullptr) != (y == nullptr)) {
        found_.push_back(path + ": kept " + l.keyword + " refers in one only");
      } else if (x != nullptr) {
        refer(*x, *y, path + ">" + l.keyword);
      } else if (l.pieces[i] != r.pieces[i]) {
        found_.push_back(path + ": kept " + std::get<std::string>(l.pieces[i]) + " and " +
                         std::get<std::string>(r.pieces[i]));
      }
    }
  }

  [[nodiscard]] bool near(double x, double y) const {
    return std::abs(x - y) <= options_.tolerance * std::max(1.0, std::max(std::abs(x), std::abs(y)));
  }

  void select(const model::SelectValue& x, const model::SelectValue& y, const std::string& path) {
    if (x.real.has_value() != y.real.has_value() || (x.real && !near(*x.real, *y.real)) || x.text != y.text) {
      found_.push_back(path + ": '" + x.text + (x.real ? std::to_string(*x.real) : "") + "' and '" + y.text +
                       (y.real ? std::to_string(*y.real) : "") + "'");
    }
    refer(x.ref, y.ref, path);
  }

  void attribute(const model::Attribute& x, const void* l, const void* r, const std::string& path) {
    using model::Storage;
    if (x.storage == Storage::kText) {  // an absent text and an empty one: AP238 has none that are absent
      const std::string u = model::value_of<model::Text>(x, l).value_or(""),
                        v = model::value_of<model::Text>(x, r).value_or("");
      if (u != v) found_.push_back(path + ": '" + u + "' and '" + v + "'");
      return;
    }
    const bool has_l = model::has_value(x, l), has_r = model::has_value(x, r);
    if (has_l != has_r) {
      // An empty list and none are the same where a list may be empty.
      if (x.storage == Storage::kRefList && model::value_of<model::AnyRefList>(x, l).items.empty() &&
          model::value_of<model::AnyRefList>(x, r).items.empty()) {
        return;
      }
      if (x.storage == Storage::kTextList && model::value_of<model::TextList>(x, l).items.empty() &&
          model::value_of<model::TextList>(x, r).items.empty()) {
        return;
      }
      // AP238 writes '' where a text must stand and there is none.
      if (x.storage == Storage::kText && model::value_of<model::Text>(x, l).value_or("").empty() &&
          model::value_of<model::Text>(x, r).value_or("").empty()) {
        return;
      }
      found_.push_back(path + ": " + (has_l ? "a value" : "none") + " and " + (has_r ? "a value" : "none"));
      return;
    }
    if (!has_l) return;
    const auto differ = [&](bool same) {
      if (!same) found_.push_back(path + ": differs");
    };
    const auto lists = [&](const auto& one, const auto& two, const auto& each) {
      if (one.size() != two.size()) {
        found_.push_back(path + ": " + std::to_string(one.size()) + " and " + std::to_string(two.size()) +
                         " elements");
        return;
      }
      for (std::size_t i = 0; i < one.size(); ++i) each(one[i], two[i], path + "[" + std::to_string(i) + "]");
    };
    switch (x.storage) {
      case Storage::kReal: {
        const double u = *model::value_of<model::Real>(x, l), v = *model::value_of<model::Real>(x, r);
        if (!near(u, v)) found_.push_back(path + ": " + std::to_string(u) + " and " + std::to_string(v));
        break;
      }
      case Storage::kInteger:
        differ(model::value_of<model::Integer>(x, l) == model::value_of<model::Integer>(x, r));
        break;
      case Storage::kBoolean:
        differ(model::value_of<model::Boolean>(x, l) == model::value_of<model::Boolean>(x, r));
        break;
      case Storage::kText:
        break;
      case Storage::kEnum:
        differ(model::value_of<model::AnyEnum>(x, l) == model::value_of<model::AnyEnum>(x, r));
        break;
      case Storage::kRef:
        refer(model::value_of<model::AnyRef>(x, l), model::value_of<model::AnyRef>(x, r), path);
        break;
      case Storage::kSelect:
        select(model::value_of<model::SelectValue>(x, l), model::value_of<model::SelectValue>(x, r), path);
        break;
      case Storage::kRefList:
        lists(model::value_of<model::AnyRefList>(x, l).items, model::value_of<model::AnyRefList>(x, r).items,
              [&](auto u, auto v, const auto& p) { refer(u, v, p); });
        break;
      case Storage::kSelectList:
        lists(model::value_of<model::SelectList>(x, l).items, model::value_of<model::SelectList>(x, r).items,
              [&](const auto& u, const auto& v, const auto& p) { select(u, v, p); });
        break;
      case Storage::kRealList:
        lists(model::value_of<model::RealList>(x, l).items, model::value_of<model::RealList>(x, r).items,
              [&](double u, double v, const auto& p) {
                if (!near(u, v)) found_.push_back(p + ": " + std::to_string(u) + " and " + std::to_string(v));
              });
        break;
      case Storage::kIntegerList:
        differ(model::value_of<model::IntegerList>(x, l) == model::value_of<model::IntegerList>(x, r));
        break;
      case Storage::kTextList:
        differ(model::value_of<model::TextList>(x, l) == model::value_of<model::TextList>(x, r));
        break;
      case Storage::kRefTable:
        lists(model::value_of<model::RefTable>(x, l).items, model::value_of<model::RefTable>(x, r).items,
              [&](const auto& u, const auto& v, const std::string& p) {
                if (u.size() != v.size()) found_.push_back(p + ": another number of elements");
                for (std::size_t i = 0; i < u.size() && i < v.size(); ++i) refer(u[i], v[i], p);
              });
        break;
      case Storage::kRealTable:
        differ(model::value_of<model::RealTable>(x, l) == model::value_of<model::RealTable>(x, r));
        break;
      case Storage::kPath:
        break;
    }
  }

  const model::Model &a_, &b_;
  DifferenceOptions options_;
  std::map<model::AnyRef, model::AnyRef> seen_;
  std::vector<Pair> pending_;
  std::vector<std::string> found_;
};

}  // namespace capstan::testing
