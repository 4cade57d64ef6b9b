#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <vector>

#include "planner/files/exchange/records/exact_paths.h"
#include "planner/files/exchange/records/path_columns.h"
#include "planner/files/exchange/records/records.h"
#include "planner/files/exchange/toolpaths/trajectories.h"
#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"

namespace capstan::exchange {

using model::AnyRef;
using model::CutterPath;
using p21::Kind;
using p21::Value;

namespace {

using namespace path_columns;

std::vector<double> column_of(const Value& v) {
  if (!v.is(Kind::kList)) throw MalformedRecord{};
  std::vector<double> out;
  out.reserve(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    tick();
    if (v[i].is(Kind::kOmitted)) {
      if (i == 0) throw MalformedRecord{};
      out.push_back(out.back());
      continue;
    }
    if (!v[i].is_number() || !std::isfinite(v[i].as_real())) throw MalformedRecord{};
    out.push_back(v[i].as_real());
  }
  return out;
}

template <class T, std::size_t N>
void columns_of(const Value& p, std::size_t first, const std::array<std::vector<double> T::*, N>& which,
                T& x) {
  if (p.size() < first + N) throw MalformedRecord{};
  for (std::size_t i = 0; i < N; ++i) x.*which[i] = column_of(p[first + i]);
}

std::string text_of(const Value& v) {
  if (!v.is(Kind::kString)) throw MalformedRecord{};
  return v.as_text();
}

std::size_t count_of(const Value& v) {
  constexpr std::int64_t kMost = std::int64_t{1} << 40;
  if (!v.is(Kind::kInteger) || v.as_integer() < 0 || v.as_integer() > kMost) throw MalformedRecord{};
  return static_cast<std::size_t>(v.as_integer());
}

template <class E>
std::vector<E> codes_of(const Value& v, E last) {
  std::vector<E> out;
  for (const char c : text_of(v)) {
    const int code = c - '0';
    if (code < 0 || code > static_cast<int>(last)) throw MalformedRecord{};
    out.push_back(static_cast<E>(code));
  }
  return out;
}

/// Reads all before it changes the plan: what is malformed leaves it as it was.
class Restoring {
 public:
  Restoring(const p21::File& file, model::Plan& plan) : file_(file), plan_(plan), steps_(plan.steps) {}

  void run() {
    each(kPath, [&](const Value& p) { path(p); });
    each(kSchedule, [&](const Value& p) { schedule(p); });
    each(kSections, [&](const Value& p) { sections(p); });
    each(kStepPath, [&](const Value& p) { step_path(p); });
    each(kToolpath, [&](const Value& p) { toolpath(p); });
    plan_.steps = std::move(steps_);
    for (Whole& w : whole_) {
      const AnyRef at = plan_.model.add(std::move(w.trajectory));
      plan_.model.set_origin(at, w.origin);
    }
    for (auto& [at, items] : lists_)
      plan_.model.at<model::ToolpathList>(at).its_list.items = std::move(items);
  }

 private:
  template <class Do>
  void each(std::string_view keyword, const Do& act) {
    for (std::size_t i = 0; i < file_.header_count(); ++i) {
      const p21::Instance e = file_.header(i);
      if (e.keyword() == keyword) act(e.parameters());
    }
  }

  template <class T>
  static void need_number(const Value& p, std::size_t size, const std::vector<T>& known) {
    if (p.size() != size || count_of(p[0]) != known.size() + 1) throw MalformedRecord{};
  }
  template <class T>
  static std::shared_ptr<const T> shared(const Value& v, const std::vector<std::shared_ptr<const T>>& known) {
    const std::size_t n = count_of(v);
    if (n > known.size()) throw MalformedRecord{};
    return n == 0 ? nullptr : known[n - 1];
  }

  void path(const Value& p) {
    need_number(p, 3 + kPathColumns.size(), paths_);
    CutterPath out;
    columns_of(p, 1, kPathColumns, out);
    out.kind = codes_of(p[1 + kPathColumns.size()], model::MoveKind::kDwell);
    out.role = codes_of(p[2 + kPathColumns.size()], model::MoveRole::kTap);
    for (const auto c : kPathColumns) {
      if ((out.*c).size() != out.kind.size()) throw MalformedRecord{};
    }
    if (out.role.size() != out.kind.size()) throw MalformedRecord{};
    paths_.push_back(std::make_shared<const CutterPath>(std::move(out)));
  }
  void schedule(const Value& p) {
    need_number(p, 1 + kScheduleColumns.size(), schedules_);
    model::FeedSchedule out;
    columns_of(p, 1, kScheduleColumns, out);
    schedules_.push_back(std::make_shared<const model::FeedSchedule>(std::move(out)));
  }
  void sections(const Value& p) {
    need_number(p, 2 + kSectionColumns.size(), sections_);
    model::SectionSeries out;
    if (!p[1].is(Kind::kList)) throw MalformedRecord{};
    for (std::size_t i = 0; i < p[1].size(); ++i) {
      const std::size_t n = count_of(p[1][i]);
      if (n > UINT32_MAX) throw MalformedRecord{};
      out.move.push_back(static_cast<std::uint32_t>(n));
    }
    columns_of(p, 2, kSectionColumns, out);
    for (const auto c : kSectionColumns) {
      if ((out.*c).size() != out.move.size()) throw MalformedRecord{};
    }
    sections_.push_back(std::make_shared<const model::SectionSeries>(std::move(out)));
  }

  /// The object of that kind that the file has under a number.
  AnyRef find(const std::string& name, model::TypeId kind) {
    std::uint64_t n = 0;
    const auto [end, ec] =
        std::from_chars(name.data() + (name.empty() ? 0 : 1), name.data() + name.size(), n);
    if (name.size() < 2 || name.front() != '#' || ec != std::errc() || end != name.data() + name.size())
      throw MalformedRecord{};
    auto& numbers = numbers_[kind];
    if (numbers.empty()) {
      for (const AnyRef at : plan_.model.all_below(kind))
        numbers.emplace(plan_.model.origin(at).instance, at);
    }
    const auto it = numbers.find(n);
    if (n == 0 || it == numbers.end()) throw MalformedRecord{};
    return it->second;
  }

  void step_path(const Value& p) {
    if (p.size() != 4) throw MalformedRecord{};
    const AnyRef at = find(text_of(p[0]), model::TypeId::kExecutable);
    const auto s = std::find_if(steps_.begin(), steps_.end(), [&](const model::StepResult& r) {
      return AnyRef(r.step) == at && !r.path && !r.schedule && !r.sections;
    });
    if (s == steps_.end()) throw MalformedRecord{};
    const auto path = shared(p[1], paths_);
    const auto schedule = shared(p[2], schedules_);
    const auto sections = shared(p[3], sections_);
    const std::size_t moves = path ? path->size() : 0;
    const auto fits = [&](const std::vector<double>& c) { return c.empty() || c.size() == moves; };
    if (schedule && path && !(fits(schedule->feed_mm_min) && fits(schedule->spindle_rpm)))
      throw MalformedRecord{};
    if (sections && path &&
        std::any_of(sections->move.begin(), sections->move.end(), [&](auto m) { return m >= moves; }))
      throw MalformedRecord{};
    s->path = path;
    s->schedule = schedule;
    s->sections = sections;
  }

  void toolpath(const Value& p) {
    if (p.size() != 9) throw MalformedRecord{};
    const AnyRef step = find(text_of(p[0]), model::TypeId::kExecutable);
    const AnyRef at = toolpath_list_of(plan_.model, step);
    const auto* list = plan_.model.get<model::ToolpathList>(at);
    if (list == nullptr) throw MalformedRecord{};
    auto& items = lists_.try_emplace(at, list->its_list.items).first->second;
    const std::size_t first = count_of(p[1]), count = count_of(p[2]);
    if (count == 0 || first > items.size() || count > items.size() - first) throw MalformedRecord{};
    model::CutterLocationTrajectory t;
    t.path = shared(p[3], paths_);
    if (!t.path) throw MalformedRecord{};
    if (!p[4].is(Kind::kOmitted)) t.its_id = text_of(p[4]);
    if (p[5].is(Kind::kEnumeration)) t.its_priority = p[5].enumeration() == "T";
    if (!p[6].is(Kind::kOmitted)) {
      const auto& names = type_attribute().enumerators;
      const auto name = std::find(names.begin(), names.end(), text_of(p[6]));
      if (name == names.end()) throw MalformedRecord{};
      t.its_type.code = static_cast<std::int8_t>(name - names.begin());
    }
    if (const std::string technology = text_of(p[7]); !technology.empty())
      t.its_technology = model::Ref<model::Technology>(find(technology, model::TypeId::kTechnology));
    t.its_speed.text = text_of(p[8]);
    const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
    const AnyRef fresh = {model::TypeId::kCutterLocationTrajectory,
                          plan_.model.count(model::TypeId::kCutterLocationTrajectory) +
                              static_cast<std::uint32_t>(whole_.size())};
    whole_.push_back({std::move(t), origin_of(*begin)});
    *begin = fresh;
    items.erase(begin + 1, begin + static_cast<std::ptrdiff_t>(count));
  }

  /// Of a toolpath of the plan, or of one that is to be added.
  [[nodiscard]] model::Origin origin_of(AnyRef at) const {
    const std::uint32_t known = plan_.model.count(model::TypeId::kCutterLocationTrajectory);
    if (at.type != model::TypeId::kCutterLocationTrajectory || at.index < known)
      return plan_.model.origin(at);
    return whole_[at.index - known].origin;
  }

  /// A path as one trajectory, to be added.
  struct Whole {
    model::CutterLocationTrajectory trajectory;
    model::Origin origin;
  };

  const p21::File& file_;
  model::Plan& plan_;
  std::vector<model::StepResult> steps_;  ///< the plan's, with their paths
  std::vector<Whole> whole_;
  std::map<AnyRef, std::vector<AnyRef>> lists_;  ///< the items of toolpath lists, as they will be
  std::vector<std::shared_ptr<const CutterPath>> paths_;
  std::vector<std::shared_ptr<const model::FeedSchedule>> schedules_;
  std::vector<std::shared_ptr<const model::SectionSeries>> sections_;
  std::map<model::TypeId, std::map<std::uint64_t, AnyRef>> numbers_;
};

}  // namespace

void restore_paths(const p21::File& file, model::Plan& plan, Reporter& reporter) {
  try {
    Restoring(file, plan).run();
  } catch (const MalformedRecord&) {
    reporter.report({.code = "EXC-RECORD",
                     .severity = Severity::kWarning,
                     .message = "the header's paths are malformed; the toolpaths are taken"});
  }
}

}  // namespace capstan::exchange
