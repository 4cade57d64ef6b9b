#include "planner/files/exchange/records/exact_paths.h"

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "planner/files/exchange/records/records.h"
#include "planner/files/exchange/toolpaths/trajectories.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange {

using model::AnyRef;
using model::CutterPath;
using p21::Kind;
using p21::Value;

namespace {

constexpr std::string_view kPath = "!CAPSTAN_PATH", kSchedule = "!CAPSTAN_SCHEDULE",
                           kSections = "!CAPSTAN_SECTIONS", kStepPath = "!CAPSTAN_STEP_PATH",
                           kToolpath = "!CAPSTAN_TOOLPATH";

constexpr std::array<std::vector<double> CutterPath::*, 5> kPathColumns = {
    &CutterPath::x, &CutterPath::y, &CutterPath::z, &CutterPath::cx, &CutterPath::cy};
constexpr std::array<std::vector<double> model::FeedSchedule::*, 3> kScheduleColumns = {
    &model::FeedSchedule::feed_mm_min, &model::FeedSchedule::spindle_rpm, &model::FeedSchedule::dwell_s};
constexpr std::array<std::vector<double> model::SectionSeries::*, 9> kSectionColumns = {
    &model::SectionSeries::at_mm,        &model::SectionSeries::ad_max_mm,
    &model::SectionSeries::rd_max_mm,    &model::SectionSeries::x_max_ofs_mm,
    &model::SectionSeries::y_max_ofs_mm, &model::SectionSeries::csa_mm2,
    &model::SectionSeries::x_cg_ofs_mm,  &model::SectionSeries::y_cg_ofs_mm,
    &model::SectionSeries::removed_mm3};

// --- writing ---

/// Each once, numbered from 1 as met.
template <class T>
class Shared {
 public:
  std::size_t number(const std::shared_ptr<const T>& p) {
    if (!p) return 0;
    const auto [it, fresh] = number_.emplace(p.get(), items.size() + 1);
    if (fresh) items.push_back(p.get());
    return it->second;
  }
  std::vector<const T*> items;

 private:
  std::map<const T*, std::size_t> number_;
};

using p21::quoted;

std::string column(const std::vector<double>& v) {
  std::string out = "(";
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (i != 0) out += ',';
    const bool same = i != 0 && std::bit_cast<std::uint64_t>(v[i]) == std::bit_cast<std::uint64_t>(v[i - 1]);
    out += same ? std::string("$") : part21_real(v[i]);
  }
  return out + ")";
}

template <class T, std::size_t N>
std::string columns(const T& x, const std::array<std::vector<double> T::*, N>& which) {
  std::string out;
  for (const auto c : which) out += "," + column(x.*c);
  return out;
}

// A digit each.
template <class E>
std::string digits(const std::vector<E>& codes) {
  std::string out;
  for (const E c : codes) out += static_cast<char>('0' + static_cast<int>(c));
  return "'" + out + "'";
}

std::string moves(const model::SectionSeries& s) {
  std::string out = "(";
  for (std::size_t i = 0; i < s.move.size(); ++i) out += (i == 0 ? "" : ",") + std::to_string(s.move[i]);
  return out + ")";
}

/// Whether a toolpath says nothing that TOOLPATH does not keep.
bool is_plain(const model::Model& m, AnyRef at) {
  static constexpr std::array<std::string_view, 6> kKept = {"its_id",         "its_priority", "its_type",
                                                            "its_technology", "its_speed",    "path"};
  if (at.type != model::TypeId::kCutterLocationTrajectory) return false;
  const auto& t = m.at<model::CutterLocationTrajectory>(at);
  if (t.its_speed.ref.set() || t.its_speed.real || !t.its_speed.type.empty()) return false;
  for (const model::Attribute& a : model::noun_type(at.type).attributes) {
    const bool kept = std::find(kKept.begin(), kKept.end(), a.name) != kKept.end();
    if (!kept && model::has_value(a, m.object(at))) return false;
  }
  return true;
}

/// How a type of toolpath is spelled, by the descriptor's enumerators.
const model::Attribute& type_attribute() {
  return *model::find_attribute(model::TypeId::kCutterLocationTrajectory, "its_type");
}

std::size_t leading_dwells(const CutterPath& p) {
  std::size_t i = 1;
  while (i < p.size() && p.kind[i] == model::MoveKind::kDwell) ++i;
  return i - 1;
}

/// The list of a step before and after its paths became curves.
class Spans {
 public:
  Spans(const model::Model& before, const std::vector<AnyRef>& from, const std::vector<AnyRef>& to)
      : m_(before), from_(from), to_(to) {}

  /// For each path of the list as it was, where its toolpaths begin and how many they are; nothing when the
  /// lists do not go together.
  struct Span {
    AnyRef trajectory;
    std::size_t first = 0, count = 0;
  };
  std::optional<std::vector<Span>> run() const {
    std::vector<Span> out;
    std::size_t k = 0;
    for (std::size_t i = 0; i < from_.size(); ++i) {
      if (!has_bare_path(m_, from_[i])) {
        if (k >= to_.size() || to_[k] != from_[i]) return std::nullopt;
        ++k;
        continue;
      }
      const std::size_t end = i + 1 < from_.size() ? begin_of(from_[i + 1], k) : to_.size();
      if (end <= k || end > to_.size() ||
          std::find(to_.begin() + static_cast<std::ptrdiff_t>(k),
                    to_.begin() + static_cast<std::ptrdiff_t>(end),
                    from_[i]) == to_.begin() + static_cast<std::ptrdiff_t>(end))
        return std::nullopt;
      out.push_back({from_[i], k, end - k});
      k = end;
    }
    if (k != to_.size()) return std::nullopt;
    return out;
  }

 private:
  [[nodiscard]] std::size_t begin_of(AnyRef next, std::size_t k) const {
    const auto at = std::find(to_.begin() + static_cast<std::ptrdiff_t>(k), to_.end(), next);
    const auto n = static_cast<std::size_t>(at - to_.begin());
    if (!has_bare_path(m_, next)) return n;
    const std::size_t dwells = leading_dwells(*m_.at<model::Trajectory>(next).path);
    return n < dwells ? to_.size() + 1 : n - dwells;
  }

  const model::Model& m_;
  const std::vector<AnyRef>&from_, &to_;
};

class Writing {
 public:
  Writing(const model::Plan& plan, const model::Model& written, const FileName& name_of)
      : plan_(plan), written_(written), name_of_(name_of) {}

  std::string run() {
    std::string uses;
    for (const auto& s : plan_.steps) uses += step(s);
    for (const AnyRef at : plan_.model.all_below(model::TypeId::kWorkingstep)) uses += toolpaths(at);
    std::string out;
    for (std::size_t i = 0; i < paths_.items.size(); ++i) {
      const CutterPath& p = *paths_.items[i];
      out += entity(kPath, std::to_string(i + 1) + columns(p, kPathColumns) + "," + digits(p.kind) + "," +
                               digits(p.role));
    }
    for (std::size_t i = 0; i < schedules_.items.size(); ++i)
      out += entity(kSchedule, std::to_string(i + 1) + columns(*schedules_.items[i], kScheduleColumns));
    for (std::size_t i = 0; i < sections_.items.size(); ++i) {
      const auto& s = *sections_.items[i];
      out += entity(kSections, std::to_string(i + 1) + "," + moves(s) + columns(s, kSectionColumns));
    }
    return out + uses;
  }

 private:
  static std::string entity(std::string_view keyword, const std::string& parameters) {
    return std::string(keyword) + "(" + parameters + ");\n";
  }
  /// Empty: the file does not hold it.
  [[nodiscard]] std::string name(AnyRef at) const {
    std::string n = at.set() ? name_of_(at) : "";
    return n.starts_with('#') ? n : "";
  }

  std::string step(const model::StepResult& s) {
    const std::string n = name(s.step);
    if (n.empty() || (!s.path && !s.schedule && !s.sections)) return {};
    const auto path = paths_.number(s.path), schedule = schedules_.number(s.schedule),
               sections = sections_.number(s.sections);
    return entity(kStepPath, quoted(n) + "," + std::to_string(path) + "," + std::to_string(schedule) + "," +
                                 std::to_string(sections));
  }

  std::string toolpaths(AnyRef step) {
    const std::string n = name(step);
    const AnyRef list = toolpath_list_of(plan_.model, step);
    const auto* before = plan_.model.get<model::ToolpathList>(list);
    const auto* after = written_.get<model::ToolpathList>(toolpath_list_of(written_, step));
    if (n.empty() || before == nullptr || after == nullptr || told_[list]) return {};
    const std::vector<AnyRef> from(before->its_list.items.begin(), before->its_list.items.end()),
        to(after->its_list.items.begin(), after->its_list.items.end());
    const auto spans = Spans(plan_.model, from, to).run();
    if (!spans) return {};
    told_[list] = true;
    std::string out;
    // From the last: what one replaces does not move those before it.
    for (auto it = spans->rbegin(); it != spans->rend(); ++it) {
      if (!is_plain(plan_.model, it->trajectory)) continue;
      const auto& t = plan_.model.at<model::CutterLocationTrajectory>(it->trajectory);
      const std::string technology = name(t.its_technology);
      if (t.its_technology && technology.empty()) continue;
      out += entity(kToolpath,
                    quoted(n) + "," + std::to_string(it->first) + "," + std::to_string(it->count) + "," +
                        std::to_string(paths_.number(t.path)) + "," + (t.its_id ? quoted(*t.its_id) : "$") +
                        "," + (t.its_priority ? (*t.its_priority ? ".T." : ".F.") : "$") + "," +
                        (t.its_type.set()
                             ? quoted(type_attribute().enumerators[static_cast<std::size_t>(t.its_type.code)])
                             : "$") +
                        "," + quoted(technology) + "," + quoted(t.its_speed.text));
    }
    return out;
  }

  const model::Plan& plan_;
  const model::Model& written_;
  const FileName& name_of_;
  Shared<CutterPath> paths_;
  Shared<model::FeedSchedule> schedules_;
  Shared<model::SectionSeries> sections_;
  std::map<AnyRef, bool> told_;
};

// --- reading ---

std::vector<double> column_of(const Value& v) {
  if (!v.is(Kind::kList)) throw MalformedRecord{};
  std::vector<double> out;
  out.reserve(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
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

class Restoring {
 public:
  Restoring(const p21::File& file, model::Plan& plan) : file_(file), plan_(plan) {}

  void run() {
    each(kPath, [&](const Value& p) { path(p); });
    each(kSchedule, [&](const Value& p) { schedule(p); });
    each(kSections, [&](const Value& p) { sections(p); });
    each(kStepPath, [&](const Value& p) { step_path(p); });
    each(kToolpath, [&](const Value& p) { toolpath(p); });
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
    const auto s = std::find_if(plan_.steps.begin(), plan_.steps.end(), [&](const model::StepResult& r) {
      return AnyRef(r.step) == at && !r.path && !r.schedule && !r.sections;
    });
    if (s == plan_.steps.end()) throw MalformedRecord{};
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
    const std::size_t first = count_of(p[1]), count = count_of(p[2]);
    if (list == nullptr || count == 0 || first > list->its_list.items.size() ||
        count > list->its_list.items.size() - first)
      throw MalformedRecord{};
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
    const AnyRef fresh = plan_.model.add(std::move(t));
    auto& items = plan_.model.at<model::ToolpathList>(at).its_list.items;
    const auto begin = items.begin() + static_cast<std::ptrdiff_t>(first);
    plan_.model.set_origin(fresh, plan_.model.origin(*begin));
    *begin = model::Ref<model::Toolpath>(fresh);
    items.erase(begin + 1, begin + static_cast<std::ptrdiff_t>(count));
  }

  const p21::File& file_;
  model::Plan& plan_;
  std::vector<std::shared_ptr<const CutterPath>> paths_;
  std::vector<std::shared_ptr<const model::FeedSchedule>> schedules_;
  std::vector<std::shared_ptr<const model::SectionSeries>> sections_;
  std::map<model::TypeId, std::map<std::uint64_t, AnyRef>> numbers_;
};

}  // namespace

std::string exact_paths(const model::Plan& plan, const model::Model& written, const FileName& name_of) {
  return Writing(plan, written, name_of).run();
}

void restore_paths(const p21::File& file, model::Plan& plan, Reporter& reporter) {
  model::Plan whole = plan;
  try {
    Restoring(file, whole).run();
    plan = std::move(whole);
  } catch (const MalformedRecord&) {
    reporter.report({.code = "EXC-RECORD",
                     .severity = Severity::kWarning,
                     .message = "the header's paths are malformed; the toolpaths are taken"});
  }
}

bool is_of_paths(std::string_view keyword) {
  static constexpr std::array<std::string_view, 5> kAll = {kPath, kSchedule, kSections, kStepPath, kToolpath};
  return std::find(kAll.begin(), kAll.end(), keyword) != kAll.end();
}

}  // namespace capstan::exchange
