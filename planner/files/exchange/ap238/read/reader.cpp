#include "planner/files/exchange/ap238/read/reader.h"

#include "planner/files/exchange/ap238/paths/paths.h"
#include "planner/files/exchange/ap238/placement/placement.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

#include "planner/ground/base/stopping.h"
#include "planner/model/nouns/all.h"
#include "planner/model/nouns/arena/walk.h"

namespace capstan::exchange::ap238 {

using model::AnyRef;
using model::Attribute;
using model::TypeId;
using p21::Kind;
using p21::Value;

namespace {

bool same_letters(std::string_view a, std::string_view b) {
  const auto lower = [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c + 32) : c; };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [&](char x, char y) { return lower(x) == lower(y); });
}

// Whether a parameter is what a constraint spells: 'text', .ENUM., a number.
bool spelled(const Value& v, const std::string& text) {
  if (v.is(Kind::kString)) {
    return text.size() >= 2 && text.front() == '\'' &&
           same_letters(v.as_text(), text.substr(1, text.size() - 2));
  }
  if (v.is(Kind::kEnumeration)) {
    return text.size() >= 2 && text.front() == '.' && v.enumeration() == text.substr(1, text.size() - 2);
  }
  if (v.is_number()) return std::abs(v.as_real() - std::strtod(text.c_str(), nullptr)) < 1e-12;
  return v.is(Kind::kOmitted) && (text == "$" || text == "''");
}

}  // namespace

Reader::Reader(const Graph& graph, const Mapping& mapping, model::Plan& plan, bool strict, Reporter& reporter)
    : g_(graph),
      map_(mapping),
      plan_(plan),
      reporter_(reporter),
      units_(graph),
      strict_(strict),
      owner_(graph.size()),
      claimed_(graph.size(), false),
      object_(graph.size(), false),
      kept_(graph.size()),
      geometry_(graph.size()) {}

void Reader::about(Node n, Diagnostic d) const {
  const auto i = g_.instance(n);
  d.instance = i.id();
  d.line = i.line();
  reporter_.report(std::move(d));
}

Node Reader::root_of(AnyRef at) const {
  const auto it = root_.find(at);
  return it == root_.end() ? kNoNode : it->second;
}

AnyRef Reader::noun_at(Node n, TypeId kind) const {
  const auto [first, last] = nouns_.equal_range(n);
  const auto it = std::find_if(first, last, [&](const auto& e) { return model::is_a(e.second.type, kind); });
  return it == last ? AnyRef{} : it->second;
}

// --- paths ---

bool Reader::holds(Node n, const Step& s, std::uint32_t* ordinal, double* order) const {
  if (claimed_[n]) return false;
  if (!g_.is_all(n, s.entities) &&
      std::none_of(s.also.begin(), s.also.end(), [&](EntityId e) { return g_.is(n, e); })) {
    return false;
  }
  if (s.exact && g_.entity(n) != s.entities.front()) return false;
  for (const Constraint& c : s.constraints) {
    if (!c.demanded) continue;
    const Value v = g_.get(n, c.attribute);
    if (c.kind == Constraint::Kind::kOrdinal) {
      if (!v.is_number()) continue;
      *order = v.as_real();
      *ordinal = static_cast<std::uint32_t>(std::clamp(std::lround(*order), 0L, 1L << 30));
      continue;
    }
    if (c.kind == Constraint::Kind::kShared) {
      const SharedRow* shared = map_.shared(c.texts.front());
      const Node to = v.is(Kind::kReference) ? g_.find(v.reference()) : kNoNode;
      std::uint32_t k = 0;
      double o = 0.0;
      if ((shared == nullptr || to == kNoNode || !holds(to, shared->root, &k, &o)) != c.negated) return false;
      continue;
    }
    if (c.kind != Constraint::Kind::kPlain) continue;
    const bool so = std::any_of(c.texts.begin(), c.texts.end(), [&](const auto& t) { return spelled(v, t); });
    if (so == c.negated) return false;
  }
  return true;
}

std::vector<Terminal> Reader::follow(const std::vector<Step>& steps, const std::string& value_of,
                                     Node root) const {
  std::vector<Terminal> level(1);
  level.front().node = root;
  level.front().scale = default_scale_;
  if (const Value own = g_.get(root, "context_of_items"); own.is(Kind::kReference)) {
    level.front().scale = const_cast<Units&>(units_).scale(g_.find(own.reference()), default_scale_);
  }
  std::vector<Node> candidates;
  std::vector<Meeting> meetings;
  std::uint32_t elements = 0;
  for (const Step& s : steps) {
    std::vector<Terminal> next;
    // A way that meets another one goes no further: a thousand representations that share a thousand items
    // are two thousand steps and not a million.
    std::set<std::tuple<Node, std::uint32_t, double, std::uint32_t, double, double>> met;
    for (const Terminal& from : level) {
      candidates.clear();
      if (s.inverse) {
        const auto users = g_.users(from.node);
        if (!visit(users.size(), root)) return {};
        for (const Node u : users) {
          if (g_.is(u, s.owner) && g_.refers(g_.get(u, s.attribute), from.node)) candidates.push_back(u);
        }
      } else {
        g_.references(g_.get(from.node, s.attribute), candidates);
        if (s.index != 0) {
          candidates =
              s.index <= candidates.size() ? std::vector<Node>{candidates[s.index - 1]} : std::vector<Node>{};
        }
        if (!visit(candidates.size(), root)) return {};
      }
      std::uint32_t k = 0;
      bool merged = false;
      for (const Node n : candidates) {
        std::uint32_t ordinal = s.fan ? k + 1 : from.ordinal;
        double order = s.fan ? static_cast<double>(k + 1) : from.order;
        if (!holds(n, s, &ordinal, &order)) continue;
        ++k;
        Scale scale = from.scale;
        const Value context = g_.get(n, "context_of_items");
        if (context.is(Kind::kReference)) {
          scale = const_cast<Units&>(units_).scale(g_.find(context.reference()), default_scale_);
        }
        const std::uint32_t element = s.fan ? ++elements : from.fan;
        if (level.size() > 1 && !met.emplace(n, ordinal, order, element, scale.length, scale.angle).second) {
          if (!merged) meetings.push_back({from.trail, n, ordinal});
          merged = true;
          continue;
        }
        Terminal t = from;
        t.node = n;
        t.ordinal = ordinal;
        t.order = order;
        t.fan = element;
        t.scale = scale;
        t.trail.push_back({n, s.prefix, ordinal});
        next.push_back(std::move(t));
      }
    }
    level = std::move(next);
  }
  if (!value_of.empty()) {
    for (Terminal& t : level) t.text = g_.get(t.node, value_of);
  }
  std::stable_sort(level.begin(), level.end(),
                   [](const auto& a, const auto& b) { return a.order < b.order; });
  for (const Terminal& t : level) consume(steps, value_of, root, t);
  if (!level.empty() && !meetings.empty()) {
    // The ways that ended where another one had been are explained by it.
    std::set<std::pair<Node, std::uint32_t>> on;
    for (const Terminal& t : level) {
      for (const auto& m : t.trail) on.emplace(m.node, m.ordinal);
    }
    for (auto m = meetings.rbegin(); m != meetings.rend(); ++m) {
      if (!on.contains({m->node, m->ordinal})) continue;
      for (const auto& mark : m->way) {
        if (on.emplace(mark.node, mark.ordinal).second) level.front().also.push_back(mark);
      }
      Terminal way;
      way.trail = std::move(m->way);
      consume(steps, "", root, way);
    }
  }
  return level;
}

// Files where every path branches at every step are refused before they take hours.
bool Reader::visit(std::size_t candidates, Node root) const {
  // Default, unsourced.
  const std::uint64_t most = 4'000'000 + 400ULL * g_.size();
  const bool before = visits_ > most;
  visits_ += candidates;
  if (visits_ <= most) return true;
  if (!before) {
    about(root, {.code = "EXC-TANGLED",
                 .severity = Severity::kError,
                 .message = "too many ways lead through the instances of this file; given up here",
                 .expected = "at most " + std::to_string(most) + " steps for a file of this size"});
  }
  return false;
}

void Reader::mark(const Terminal& t, AnyRef owner) {
  for (const auto* marks : {&t.trail, &t.also}) {
    for (const auto& m : *marks) {
      if (!object_[m.node] && !owner_[m.node].set() && !kept_[m.node].set()) {
        owner_[m.node] = {owner, m.prefix, m.ordinal};
      }
    }
  }
}

// --- objects ---

const ObjectRow* Reader::object_row(Node n, std::span<const TypeId> targets) const {
  const auto fits = [&](TypeId t) {
    return targets.empty() ||
           std::any_of(targets.begin(), targets.end(), [&](TypeId want) { return model::is_a(t, want); });
  };
  const auto try_all = [&](std::span<const std::uint32_t> rows) -> const ObjectRow* {
    for (const std::uint32_t r : rows) {
      const ObjectRow& row = map_.objects()[r];
      std::uint32_t ordinal = 0;
      double order = 0.0;
      if (!fits(row.noun) || !holds(n, row.root, &ordinal, &order)) continue;
      if (!row.guard.empty() && follow(row.guard, "", n).empty()) continue;
      return &row;
    }
    return nullptr;
  };
  if (g_.entity(n) != express::kNoEntity) return try_all(map_.objects_at(g_.entity(n)));
  const auto i = g_.instance(n);
  if (!i.is_complex()) return nullptr;
  std::vector<std::uint32_t> rows;
  for (std::size_t k = 0; k < i.part_count(); ++k) {
    const EntityId e = g_.schema().find(i.part(k).keyword);
    if (e == express::kNoEntity) continue;
    const auto at = map_.objects_at(e);
    rows.insert(rows.end(), at.begin(), at.end());
  }
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return try_all(rows);
}

namespace {

bool fits_any(TypeId t, std::span<const TypeId> targets) {
  return targets.empty() ||
         std::any_of(targets.begin(), targets.end(), [&](TypeId want) { return model::is_a(t, want); });
}

// Makes the objects inside that have no instance of their own.
void make_inner(model::Model& m, AnyRef at, const ObjectRow& row) {
  for (const auto& [path, type] : row.with) {
    AnyRef holder = at;
    for (std::size_t i = 0; i + 1 < path.size() && holder.set(); ++i) {
      const Attribute* a = model::find_attribute(holder.type, path[i]);
      holder = a == nullptr ? AnyRef{} : *static_cast<AnyRef*>(a->at(m.object(holder)));
    }
    const Attribute* a = holder.set() ? model::find_attribute(holder.type, path.back()) : nullptr;
    if (a == nullptr) throw std::logic_error(row.place + ": no such attribute " + path.back());
    const AnyRef inner = m.add_object(type);
    *static_cast<AnyRef*>(a->at(m.object(holder))) = inner;
  }
}

}  // namespace

AnyRef Reader::object_at(Node n, std::span<const TypeId> targets, const Scale& scale) {
  if (object_[n]) {
    const auto [first, last] = nouns_.equal_range(n);
    for (auto it = first; it != last; ++it) {
      if (fits_any(it->second.type, targets)) return it->second;
    }
  }
  if (const ObjectRow* row = object_row(n, targets)) {
    const AnyRef at = plan_.model.add_object(row->noun);
    const auto i = g_.instance(n);
    plan_.model.set_origin(at, {i.id(), i.line()});
    nouns_.emplace(n, at);
    root_.emplace(at, n);
    object_[n] = true;
    consume_constraints(n, row->root.constraints);
    make_inner(plan_.model, at, *row);
    Terminal guard;
    for (const Terminal& t : row->guard.empty() ? std::vector<Terminal>{} : follow(row->guard, "", n))
      mark(t, at);
    pending_.push_back({at, n, kNoScale});
    return at;
  }
  if (const auto type = geometry_type(n, scale.ours); type && fits_any(*type, targets))
    return geometry_at(n, *type, scale);
  return kept_at(n);
}

void Reader::drain() {
  while (!pending_.empty()) {
    tick();
    const Pending p = pending_.front();
    pending_.pop_front();
    if (p.scale != kNoScale) {
      fill_geometry(p.at, p.node, Scale(pending_scales_[p.scale]));  // more may come meanwhile
    } else {
      fill(p.at, p.node);
    }
  }
}

// Before frames are worked out from what was read, whatever of it is at fault: what is needed must be right.
void Reader::settle() {
  if (doubts_.empty() || !plan_.project) return;
  Marks reached(plan_.model);
  reached.set_from(plan_.model, plan_.project);
  std::vector<Doubt> needed;
  const auto rest = std::stable_partition(doubts_.begin(), doubts_.end(),
                                          [&](const Doubt& d) { return reached.has(d.object); });
  needed.assign(std::make_move_iterator(doubts_.begin()), std::make_move_iterator(rest));
  doubts_.erase(doubts_.begin(), rest);
  settle_doubts(plan_, needed, reached, strict_, reporter_);
}

void Reader::fill(AnyRef at, Node n) {
  for (const Row* row : map_.rows_of(at.type)) read_row(*row, at, n);
  // AP238 writes a list without elements by leaving it out.
  for (const Row* row : map_.rows_of(at.type)) {
    const Attribute* a =
        row->attribute.size() == 1 ? model::find_attribute(at.type, row->attribute.front()) : nullptr;
    if (a == nullptr || !a->required) continue;
    void* slot = a->at(plan_.model.object(at));
    if (a->storage == model::Storage::kRefList) static_cast<model::AnyRefList*>(slot)->given = true;
    if (a->storage == model::Storage::kTextList) static_cast<model::TextList*>(slot)->given = true;
  }
}

bool Reader::read_row(const Row& row, AnyRef at, Node n) {
  if (row.attribute.empty()) {
    for (const Terminal& t : follow(row.steps, row.value_of, n)) {
      if (geometry_type(t.node)) object_at(t.node, {}, t.scale);  // so that its parts are explained, too
      mark(t, at);
    }
    return true;
  }
  AnyRef holder = at;
  const Attribute* a = nullptr;
  for (std::size_t i = 0; i < row.attribute.size(); ++i) {
    a = holder.set() ? model::find_attribute(holder.type, row.attribute[i]) : nullptr;
    if (a == nullptr) return false;
    if (i + 1 == row.attribute.size()) break;
    AnyRef next = *static_cast<AnyRef*>(a->at(plan_.model.object(holder)));
    if (row.only[i] != TypeId::kNone && !(next.set() && model::is_a(next.type, row.only[i]))) return false;
    if (!next.set() && row.made[i] != TypeId::kNone) {
      if (follow(row.steps, row.value_of, n).empty()) return false;
      next = plan_.model.add_object(row.made[i]);
      *static_cast<AnyRef*>(a->at(plan_.model.object(holder))) = next;
    }
    holder = next;
  }
  if (model::has_value(*a, plan_.model.object(holder))) return true;  // an earlier row had it
  auto found = follow(row.steps, row.value_of, n);
  if (found.empty()) return false;
  return assign(row, holder, *a, found);
}

void Reader::run() {
  const auto& schema = g_.schema();
  // The units of a representation that states none: those stated elsewhere in the file.
  const EntityId context = schema.find("GLOBAL_UNIT_ASSIGNED_CONTEXT");
  for (Node n = 0; n < g_.size() && !default_scale_.stated; ++n) {
    if (g_.is(n, context)) default_scale_ = units_.scale(n, Scale{});
  }
  const EntityId point = schema.find("CARTESIAN_POINT");
  for (Node n = 0; n < g_.size() && !default_scale_.stated; ++n) {
    if (!g_.is(n, point)) continue;
    about(n, {.code = "EXC-UNIT",
              .severity = Severity::kWarning,
              .message = "the file states no unit of length for its geometry; millimetres are taken"});
    break;
  }
  default_scale_.stated = false;
  default_scale_.ours = false;
  static constexpr TypeId kProject[] = {TypeId::kProject};
  for (Node n = 0; n < g_.size(); ++n) {
    const ObjectRow* row = object_row(n, kProject);
    if (row == nullptr) continue;
    const AnyRef at = object_at(n, kProject, default_scale_);
    if (!plan_.project) {
      plan_.project = model::Ref<model::Project>(at);
    } else {
      about(n, {.code = "EXC-PROJECTS",
                .severity = Severity::kWarning,
                .message = "a second PROJECT; kept, and not planned"});
      plan_.kept.push_back(at);
    }
  }
  drain();
  // Application objects that the project does not lead to.
  for (Node n = 0; n < g_.size(); ++n) {
    if (used(n) || kept_[n].set()) continue;
    const ObjectRow* row = object_row(n, {});
    if (row == nullptr) continue;
    plan_.kept.push_back(object_at(n, {}, default_scale_));
    drain();
  }
  settle();
  adopt_frames(plan_);
  to_model(*this);
  drain();
  keep_the_rest();
  note_unread();
}

}  // namespace capstan::exchange::ap238
