#include "planner/model/plan/range/positions.h"

#include <cmath>

#include "planner/model/nouns/arena/walk.h"
#include "planner/model/plan/order/step_ids.h"
#include "planner/model/plan/range/ranges.h"

namespace capstan::model {
namespace {

/// Its square must be finite: directions have a length.
constexpr Range kNumber{-1e100, 1e100};

class Look {
 public:
  void number(double v, const Range& range, const std::string& where) {
    if (!range.holds(v) && text.empty())
      text = where + " is " + value_text(v) + "; it can be " + to_text(range);
  }
  void position(double v, const std::string& where) { number(v, range::kPositionMm, where); }
  void point(const geometry::Vec3& p, const std::string& where) {
    for (const double v : {p.x, p.y, p.z}) position(v, where);
  }
  void column(const std::vector<double>& values, const std::string& where) {
    for (const double v : values) position(v, where);
  }
  void path(const CutterPath& p, const std::string& where) {
    for (const auto* c : {&p.x, &p.y, &p.z, &p.cx, &p.cy}) column(*c, where);
  }
  /// Its sign is its sense; one that hardly turns makes a time or a chip without end.
  template <class Where>
  void speed(double v, const Range& range, const Where& where) {
    if (range.holds(std::abs(v))) return;
    number(v, range, where());
    text += ", either way";
  }
  void object(const Model& m, AnyRef at) {
    const void* data = m.object(at);
    for (const Attribute& a : noun_type(at.type).attributes) {
      const Range& range = a.unit == Unit::kLength ? range::kPositionMm : kNumber;
      const auto where = [&] {
        const std::uint64_t n = m.origin(at).instance;
        return (n == 0 ? "" : "#" + std::to_string(n) + " ") + std::string(noun_type(at.type).keyword) + "." +
               std::string(a.name);
      };
      if (a.storage == Storage::kReal) {
        const auto& v = value_of<Real>(a, data);
        if (v && (a.unit == Unit::kSpeed || a.unit == Unit::kRotSpeed)) {
          speed(*v, a.unit == Unit::kSpeed ? range::kSpeed : range::kTurningRpm, where);
        } else if (v && !range.holds(*v)) {
          number(*v, range, where());
        }
      } else if (a.storage == Storage::kRealList) {
        // Coordinates are of one kind, whatever their unit is called.
        for (const double v : value_of<RealList>(a, data).items) {
          if (!range.holds(v)) number(v, range, where());
        }
      }
      if (!text.empty()) return;
    }
  }
  std::string text;
};

}  // namespace

std::string beyond_range(const Plan& plan) {
  Look look;
  for (std::size_t t = 1; t < kTypeCount; ++t) {
    const auto type = static_cast<TypeId>(t);
    if (type == TypeId::kKeptInstance) continue;
    for (std::uint32_t i = 0; i < plan.model.count(type) && look.text.empty(); ++i)
      look.object(plan.model, {type, i});
  }
  if (!plan.stock.box.empty()) {
    look.point(plan.stock.box.lo, "the raw piece");
    look.point(plan.stock.box.hi, "the raw piece");
  }
  for (const SetupResult& s : plan.setups) {
    look.position(s.security_z_mm, "a security plane");
    look.point(s.holding.pickup, "a datum");
    for (const FixtureSolid& f : s.holding.solids) {
      for (const geometry::Vec2& p : f.outline) look.point({p.x, p.y, f.bottom_mm}, "'" + f.id + "'");
      look.position(f.top_mm, "'" + f.id + "'");
    }
  }
  if (plan.target_mesh) {
    for (const geometry::Vec3& v : plan.target_mesh->vertices) {
      if (look.text.empty()) look.point(v, "a vertex of the target mesh");
    }
  }
  const std::vector<std::string> ids = step_ids(plan);
  for (std::size_t i = 0; i < plan.steps.size(); ++i) {
    const StepResult& s = plan.steps[i];
    if (s.path && look.text.empty()) look.path(*s.path, "the path of step '" + ids[i] + "'");
  }
  return look.text;
}

}  // namespace capstan::model
