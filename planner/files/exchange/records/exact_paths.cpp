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

#include "planner/files/exchange/records/path_columns.h"
#include "planner/files/exchange/toolpaths/trajectories.h"
#include "planner/files/p21/print.h"
#include "planner/ground/base/append_number.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange {

using model::AnyRef;
using model::CutterPath;

namespace {

using namespace path_columns;

/// Each once, numbered from 1 as met.
template <class T>
class NumberedColumns {
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

void column(const std::vector<double>& v, std::string& out) {
  std::array<char, 4096> buffer;
  char* to = buffer.data();
  const auto append = [&] {
    out.append(buffer.data(), static_cast<std::size_t>(to - buffer.data()));
    to = buffer.data();
  };
  out += ",(";
  for (std::size_t i = 0; i < v.size(); ++i) {
    if (i != 0) *to++ = ',';
    const bool same = i != 0 && std::bit_cast<std::uint64_t>(v[i]) == std::bit_cast<std::uint64_t>(v[i - 1]);
    if (same) {
      *to++ = '$';
    } else {
      to = print_part21_real(to, v[i]);
    }
    if (static_cast<std::size_t>(to - buffer.data()) > buffer.size() - 2 * kNumberRoom) append();
  }
  append();
  out += ')';
}

template <class T, std::size_t N>
void columns(const T& x, const std::array<std::vector<double> T::*, N>& which, std::string& out) {
  for (const auto c : which) column(x.*c, out);
}

// A digit each.
template <class E>
void digits(const std::vector<E>& codes, std::string& out) {
  out += ",'";
  for (const E c : codes) out += static_cast<char>('0' + static_cast<int>(c));
  out += '\'';
}

void moves(const model::SectionSeries& s, std::string& out) {
  out += ",(";
  for (std::size_t i = 0; i < s.move.size(); ++i) {
    std::array<char, 16> text;
    if (i != 0) out += ',';
    const char* const end = std::to_chars(text.data(), text.data() + text.size(), s.move[i]).ptr;
    out.append(text.data(), static_cast<std::size_t>(end - text.data()));
  }
  out += ')';
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

  /// Also gives where each entity ends.
  std::vector<std::size_t> run(std::string& out) {
    std::vector<std::size_t> ends;
    std::string uses;
    for (const auto& s : plan_.steps) uses += step(s);
    for (const AnyRef at : plan_.model.all_below(model::TypeId::kWorkingstep)) uses += toolpaths(at);
    const auto numbered = [&](std::string_view keyword, std::size_t i, const auto& parameters) {
      out.append(keyword).append("(").append(std::to_string(i + 1));
      parameters();
      out += ");\n";
      ends.push_back(out.size());
    };
    for (std::size_t i = 0; i < paths_.items.size(); ++i) {
      const CutterPath& p = *paths_.items[i];
      numbered(kPath, i, [&] {
        columns(p, kPathColumns, out);
        digits(p.kind, out);
        digits(p.role, out);
      });
    }
    for (std::size_t i = 0; i < schedules_.items.size(); ++i)
      numbered(kSchedule, i, [&] { columns(*schedules_.items[i], kScheduleColumns, out); });
    for (std::size_t i = 0; i < sections_.items.size(); ++i) {
      const auto& s = *sections_.items[i];
      numbered(kSections, i, [&] {
        moves(s, out);
        columns(s, kSectionColumns, out);
      });
    }
    // An entity a line: texts hold no line feed.
    for (std::size_t i = 0; i < uses.size(); ++i) {
      if (uses[i] == '\n') ends.push_back(out.size() + i + 1);
    }
    out += uses;
    return ends;
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
  NumberedColumns<CutterPath> paths_;
  NumberedColumns<model::FeedSchedule> schedules_;
  NumberedColumns<model::SectionSeries> sections_;
  std::map<AnyRef, bool> told_;
};

}  // namespace

void append_exact_paths(std::string& out, const model::Plan& plan, const model::Model& written,
                        const FileName& name_of, Seals* sealed) {
  std::size_t begin = out.size();
  const std::vector<std::size_t> ends = Writing(plan, written, name_of).run(out);
  if (sealed == nullptr) return;
  std::vector<Seals::Text> texts;
  for (const std::size_t end : ends) {
    constexpr std::size_t kEnd = 2;  // ";\n"
    const auto entity = std::string_view(out).substr(begin, end - begin - kEnd);
    texts.push_back(text_of_header(entity.substr(0, entity.find('(')), entity));
    begin = end;
  }
  sealed->add(texts);
}

std::size_t bytes_of_exact_paths(const model::Plan& plan) {
  constexpr std::size_t kInNumber = 10;  // 2 of one as the one before, at most 25 of another
  std::size_t numbers = 0;
  for (const auto& s : plan.steps) {
    numbers += (s.path ? s.path->size() * kPathColumns.size() : 0) +
               (s.schedule ? s.schedule->feed_mm_min.size() * kScheduleColumns.size() : 0) +
               (s.sections ? s.sections->size() * kSectionColumns.size() : 0);
  }
  return numbers * kInNumber;
}

bool is_of_paths(std::string_view keyword) {
  static constexpr std::array<std::string_view, 5> kAll = {kPath, kSchedule, kSections, kStepPath, kToolpath};
  return std::find(kAll.begin(), kAll.end(), keyword) != kAll.end();
}

}  // namespace capstan::exchange
