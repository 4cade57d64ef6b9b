#pragma once

#include <memory>
#include <random>
#include <string>

#include "planner/files/json/fields.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::json {

/// Fills every field of a plan and every attribute of its objects with seeded noise. `likely` is the chance
/// of an optional one having a value.
class Filler {
 public:
  Filler(unsigned seed, double likely) : random_(seed), likely_(likely) {}

  model::Plan plan(unsigned objects_per_kind) {
    using model::TypeId;
    for (int i = 0; i < 3; ++i) {
      auto path = std::make_shared<model::CutterPath>();
      path->start({number(), number(), number()});
      path->line({number(), number(), number()}, model::MoveRole::kPlunge);
      path->arc({number(), number(), number()}, {number(), number()}, i == 0, model::MoveRole::kCut);
      path->rapid({number(), number(), number()});
      path->dwell();
      paths_.push_back(path);
      auto sections = std::make_shared<model::SectionSeries>();
      (*this)("", *sections);
      sections_.push_back(sections);
      auto schedule = std::make_shared<model::FeedSchedule>();
      (*this)("", *schedule);
      schedules_.push_back(schedule);
    }
    for (std::size_t t = 1; t < model::kTypeCount; ++t) {
      if (model::noun_type(static_cast<TypeId>(t)).abstract) continue;
      for (unsigned i = 0; i < objects_per_kind; ++i) {
        const model::AnyRef r = plan_.model.add_object(static_cast<TypeId>(t));
        if (some()) plan_.model.set_origin(r, {random_() % 100000, random_() % 100000});
        all_.push_back(r);
      }
    }
    for (const model::AnyRef r : all_) object(r);
    fields(*this, plan_);
    for (int i = 0; i < 5; ++i) {
      model::Reason reason;
      (*this)("", reason);
      plan_.ledger.reason(reason);
    }
    for (int i = 0; i < 20; ++i) {
      model::DecisionKey key;
      model::Decision d;
      (*this)("", key);
      (*this)("", d);
      d.reason = static_cast<model::ReasonId>(random_() % plan_.ledger.reasons().size());
      plan_.ledger.set(key, d);
    }
    auto mesh = std::make_shared<geometry::Mesh>();
    (*this)("", *mesh);
    plan_.target_mesh = mesh;
    return plan_;
  }

  template <class T>
  void operator()(const char*, T& x) {
    if constexpr (std::is_same_v<T, bool>) {
      x = random_() % 2 == 0;
    } else if constexpr (std::is_same_v<T, std::uint64_t>) {
      x = (std::uint64_t{random_()} << 32U) + random_();
    } else if constexpr (std::is_integral_v<T>) {
      x = static_cast<T>(random_() % 1000);
    } else if constexpr (std::is_floating_point_v<T>) {
      x = number();
    } else if constexpr (IsText<T>) {
      x = text();
    } else if constexpr (std::is_enum_v<T>) {
      x = static_cast<T>(random_() % spellings<T>().size());
    } else if constexpr (std::is_same_v<T, model::AnyRef>) {
      x = all_[random_() % all_.size()];
    } else if constexpr (std::is_base_of_v<model::AnyRef, T>) {
      x = T(below(std::vector<model::TypeId>{target_of(x)}));
    } else if constexpr (kIsOptional<T>) {
      if (some()) (*this)("", x.emplace());
    } else if constexpr (kIsShared<T>) {
      if (some()) pick(x);
    } else if constexpr (std::is_same_v<T, std::vector<model::MoveKind>> ||
                         std::is_same_v<T, std::vector<model::MoveRole>>) {
    } else if constexpr (kIsArray<T>) {
      for (auto& item : x) (*this)("", item);
    } else if constexpr (kIsVector<T>) {
      x.resize(1 + random_() % 3);
      for (auto& item : x) (*this)("", item);
    } else {
      fields(*this, x);
    }
  }

 private:
  bool some() { return std::uniform_real_distribution<double>(0.0, 1.0)(random_) < likely_; }
  double number() {
    const int digits = static_cast<int>(random_() % 5);
    const double v = std::uniform_real_distribution<double>(-1000.0, 1000.0)(random_);
    return digits == 0 ? v * 1e-9 : digits == 1 ? v * 1e30 : digits == 2 ? std::round(v) : v;
  }
  // Quotes, controls, UTF-8, bytes that are none, and the characters that stand for such bytes.
  std::string text() {
    static const std::vector<std::string> kPieces = {
        "a",     "Bohrung \xC3\xBC", "\"",           "\\", "\n",  std::string(1, '\0'), "\xFF",
        "\xC3(", "\xF4\x8F\xBF\xBF", "\xED\xA0\x80", "/",  "\x7F"};
    std::string out;
    for (auto n = random_() % 5; n > 0; --n) out += kPieces[random_() % kPieces.size()];
    return out;
  }
  template <class T>
  static model::TypeId target_of(const model::Ref<T>&) {
    return T::kType;
  }
  template <class Targets>
  model::AnyRef below(const Targets& targets) {
    std::vector<model::AnyRef> fitting;
    for (const model::AnyRef r : all_) {
      bool fits = targets.size() == 0 || r.type == model::TypeId::kKeptInstance;
      for (const model::TypeId t : targets) fits = fits || model::is_a(r.type, t);
      if (fits) fitting.push_back(r);
    }
    return fitting.empty() ? model::AnyRef{} : fitting[random_() % fitting.size()];
  }
  void pick(std::shared_ptr<const model::CutterPath>& p) { p = paths_[random_() % paths_.size()]; }
  void pick(std::shared_ptr<const model::SectionSeries>& p) { p = sections_[random_() % sections_.size()]; }
  void pick(std::shared_ptr<const model::FeedSchedule>& p) { p = schedules_[random_() % schedules_.size()]; }

  template <class T>
  static T& storage(const model::Attribute& a, void* object) {
    return *static_cast<T*>(a.at(object));
  }
  template <class List>
  void values(const model::Attribute& a, void* object) {
    storage<List>(a, object).given = true;
    (*this)("", storage<List>(a, object).items);
  }
  model::SelectValue select(const model::Attribute& a) {
    model::SelectValue v;
    switch (random_() % 3) {
      case 0:
        v.ref = below(a.targets);
        break;
      case 1:
        v.type = "PARAMETER_VALUE";
        v.real = number();
        break;
      default:
        v.text = "RAPID";
    }
    return v;
  }

  void object(model::AnyRef r) {
    using namespace model;
    if (auto* kept = plan_.model.get<KeptInstance>(r)) {
      kept->keyword = text();
      kept->pieces = {text(), all_[random_() % all_.size()], AnyRef{}, text()};
      return;
    }
    void* data = plan_.model.object(r);
    for (const Attribute& a : noun_type(r.type).attributes) {
      if (some()) attribute(a, data);
    }
  }
  void attribute(const model::Attribute& a, void* object) {
    using namespace model;
    switch (a.storage) {
      case Storage::kReal:
        return void(storage<Real>(a, object) = number());
      case Storage::kInteger:
        return void(storage<Integer>(a, object) =
                        -(std::int64_t{1} << 60) + static_cast<std::int64_t>(random_()));
      case Storage::kBoolean:
        return void(storage<Boolean>(a, object) = random_() % 2 == 0);
      case Storage::kText:
        return void(storage<Text>(a, object) = text());
      case Storage::kEnum:
        return void(storage<AnyEnum>(a, object).code =
                        static_cast<std::int8_t>(random_() % a.enumerators.size()));
      case Storage::kRef:
        return void(storage<AnyRef>(a, object) = below(a.targets));
      case Storage::kRefList:
        storage<AnyRefList>(a, object).given = true;
        if (some()) storage<AnyRefList>(a, object).items = {below(a.targets), AnyRef{}, below(a.targets)};
        return;
      case Storage::kRefTable:
        storage<RefTable>(a, object).given = true;
        storage<RefTable>(a, object).items = {{below(a.targets), below(a.targets)}, {}};
        return;
      case Storage::kSelect:
        return void(storage<SelectValue>(a, object) = select(a));
      case Storage::kSelectList:
        storage<SelectList>(a, object).given = true;
        storage<SelectList>(a, object).items = {select(a), select(a)};
        return;
      case Storage::kRealList:
        return values<RealList>(a, object);
      case Storage::kIntegerList:
        return values<IntegerList>(a, object);
      case Storage::kTextList:
        return values<TextList>(a, object);
      case Storage::kRealTable:
        return values<RealTable>(a, object);
      case Storage::kPath:
        return pick(storage<PathHandle>(a, object));
    }
  }

  std::mt19937 random_;
  double likely_;
  model::Plan plan_;
  std::vector<model::AnyRef> all_;
  std::vector<std::shared_ptr<const model::CutterPath>> paths_;
  std::vector<std::shared_ptr<const model::SectionSeries>> sections_;
  std::vector<std::shared_ptr<const model::FeedSchedule>> schedules_;
};

}  // namespace capstan::json
