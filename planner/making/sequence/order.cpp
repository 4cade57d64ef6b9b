#include "planner/making/sequence/order.h"

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include "planner/making/sequence/precedence.h"

// Steps are ordered by a list schedule. A step is ready when all that precede it are done; ready steps wait
// in one pool for each side and tool. Of the sides with a ready step, one that waits for no other comes
// first, then those that were asked for, then the one with most steps left. On a side the tool in the spindle
// goes on as long as it has a ready step; then comes a tool that is not needed again, then the one with most
// to do in one go. Where a wish between sides makes a side come twice, the schedule is made again without
// such wishes. The order is good and not proven the best: the least number of tool changes under precedences
// is a hard problem.

namespace capstan::sequence {
namespace {

Status validate(const std::vector<model::FeatureShape>& shapes, const std::vector<Item>& items,
                const Options& options) {
  for (const Item& item : items) {
    if (item.feature >= shapes.size())
      return fail("SEQ-INDEX", "step '" + item.name + "' names a feature that is not there");
  }
  for (const auto& [a, b] : options.given) {
    if (a >= items.size() || b >= items.size())
      return fail("SEQ-INDEX", "a given precedence names a step that is not there");
  }
  for (const Wish& w : options.wishes) {
    if (w.before >= shapes.size() || w.after >= shapes.size())
      return fail("SEQ-INDEX", "a wish names a feature that is not there");
  }
  return {};
}

/// Steps by what they are cut with: one pool per side and tool.
using Ready = std::set<std::tuple<std::size_t, int, std::size_t>>;  // feature, in_chain, item
struct Pool {
  Ready ready;
  std::size_t waiting = 0;  // not yet done, ready ones included
};

class Scheduler {
 public:
  Scheduler(const std::vector<Item>& items, const Access& access, const std::vector<Precedence>& precedences,
            std::size_t wanted)
      : items_(items),
        access_(access),
        next_(items.size()),
        blocked_(items.size()),
        done_(items.size()),
        wanted_(wanted) {
    pools_.resize(access.directions.size());
    for (const Precedence& p : precedences) {
      next_[p.before].push_back(p.after);
      ++blocked_[p.after];
      if (side_of(p.before) != side_of(p.after)) across_.emplace_back(p.before, p.after);
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
      ++pool(i).waiting;
      ++remaining_;
    }
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (blocked_[i] == 0) make_ready(i);
    }
  }

  /// Fills the set-ups; false when steps are left that wait for each other.
  bool run(Order& out) {
    while (remaining_ > 0) {
      const std::size_t side = pick_side();
      if (side == kNone) return false;
      out.setups.push_back({access_.directions[side], {}});
      while (!pools_[side].empty()) {
        const auto it = pick_pool(side);
        if (it == pools_[side].end()) break;
        if (tool_ != it->first) {
          tool_ = it->first;
          ++out.tool_changes;
        }
        while (!it->second.ready.empty()) out.setups.back().steps.push_back(take(it->second));
      }
    }
    return true;
  }

  /// Steps that wait for each other, each before the next. Needs that `run` gave false.
  [[nodiscard]] std::vector<std::size_t> cycle(const std::vector<Precedence>& precedences) const {
    // Every step left has a predecessor left: walking back must come round.
    std::vector<std::size_t> previous(items_.size(), kNone);
    for (const Precedence& p : precedences) {
      if (!done_[p.before] && !done_[p.after] && previous[p.after] == kNone) previous[p.after] = p.before;
    }
    std::size_t at = 0;
    while (done_[at]) ++at;
    std::vector<bool> visited(items_.size());
    while (!visited[at]) {
      visited[at] = true;
      at = previous[at];
    }
    std::vector<std::size_t> out{at};
    for (std::size_t k = previous[at]; k != at; k = previous[k]) out.push_back(k);
    std::reverse(out.begin(), out.end());
    return out;
  }

 private:
  static constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  using Pools = std::map<std::string, Pool>;

  [[nodiscard]] std::string tool_of(std::size_t i) const {
    if (!items_[i].cutter_id.empty()) return items_[i].cutter_id;
    return "open " +
           std::to_string(static_cast<int>(items_[i].operation));  // no cutter yet: by kind of operation
  }
  Pool& pool(std::size_t i) { return pools_[access_.of_feature[items_[i].feature]][tool_of(i)]; }
  void make_ready(std::size_t i) { pool(i).ready.emplace(items_[i].feature, items_[i].in_chain, i); }

  std::size_t take(Pool& p) {
    const std::size_t i = std::get<2>(*p.ready.begin());
    p.ready.erase(p.ready.begin());
    --p.waiting;
    --remaining_;
    done_[i] = true;
    for (const std::size_t k : next_[i]) {
      if (--blocked_[k] == 0) make_ready(k);
    }
    return i;
  }

  [[nodiscard]] std::size_t side_of(std::size_t i) const { return access_.of_feature[items_[i].feature]; }

  /// Whether a side would have to be visited again, for some of its steps wait for other sides.
  [[nodiscard]] bool waits(std::size_t side) const {
    return std::any_of(across_.begin(), across_.end(), [&](const auto& p) {
      return !done_[p.first] && !done_[p.second] && side_of(p.second) == side;
    });
  }

  // Of the sides with something ready: one that waits for no other, then wanted ones in their order, then the
  // one with most steps left.
  [[nodiscard]] std::size_t pick_side() const {
    std::size_t best = kNone;
    std::tuple<bool, std::size_t, std::size_t> best_key;
    for (std::size_t side = 0; side < pools_.size(); ++side) {
      std::size_t ready = 0, waiting = 0;
      for (const auto& [tool, p] : pools_[side]) {
        ready += p.ready.size();
        waiting += p.waiting;
      }
      if (ready == 0) continue;
      const std::tuple key{waits(side), side < wanted_ ? side : wanted_,
                           std::numeric_limits<std::size_t>::max() - waiting};
      if (best == kNone || key < best_key) {
        best = side;
        best_key = key;
      }
    }
    return best;
  }

  /// How many steps a tool could make in one go, its own steps setting each other free.
  [[nodiscard]] std::size_t in_one_go(const Pool& p, std::size_t side, const std::string& tool) const {
    std::map<std::size_t, std::size_t> freed;  // waiting step -> how many of its predecessors would be done
    std::vector<std::size_t> reached;
    for (const auto& key : p.ready) reached.push_back(std::get<2>(key));
    for (std::size_t at = 0; at < reached.size() && reached.size() < p.waiting; ++at) {
      for (const std::size_t k : next_[reached[at]]) {
        if (access_.of_feature[items_[k].feature] != side || tool_of(k) != tool) continue;
        if (++freed[k] == blocked_[k]) reached.push_back(k);
      }
    }
    return reached.size();
  }

  // The tool in the spindle when it has something to do; else one that will not be needed again; else the one
  // with most to do in one go; ties by the lowest feature.
  Pools::iterator pick_pool(std::size_t side) {
    auto& pools = pools_[side];
    const auto current = pools.find(tool_);
    if (current != pools.end() && !current->second.ready.empty()) return current;
    auto best = pools.end();
    std::tuple<bool, std::size_t, std::tuple<std::size_t, int, std::size_t>> best_key;
    for (auto it = pools.begin(); it != pools.end(); ++it) {
      const Pool& p = it->second;
      if (p.ready.empty()) continue;
      const std::size_t steps = in_one_go(p, side, it->first);
      const std::tuple key{steps < p.waiting, std::numeric_limits<std::size_t>::max() - steps,
                           *p.ready.begin()};
      if (best == pools.end() || key < best_key) {
        best = it;
        best_key = key;
      }
    }
    return best;
  }

  const std::vector<Item>& items_;
  const Access& access_;
  std::vector<std::vector<std::size_t>> next_;
  std::vector<std::size_t> blocked_;
  std::vector<bool> done_;
  std::vector<std::pair<std::size_t, std::size_t>> across_;  // precedences between sides
  std::vector<Pools> pools_;
  std::size_t remaining_ = 0;
  std::string tool_;
  std::size_t wanted_ = 0;  // number of directions requested, in their order
};

std::string describe(const std::vector<std::size_t>& cycle, const std::vector<Item>& items,
                     const std::vector<Precedence>& precedences) {
  std::string out = "these steps wait for each other: ";
  for (std::size_t i = 0; i < cycle.size(); ++i) {
    const std::size_t a = cycle[i];
    const std::size_t b = cycle[(i + 1) % cycle.size()];
    const auto it = std::find_if(precedences.begin(), precedences.end(),
                                 [&](const Precedence& p) { return p.before == a && p.after == b; });
    out += (i == 0 ? "" : "; ") + std::string("'") + items[a].name + "' before '" + items[b].name + "'";
    if (it != precedences.end()) out += " (" + it->text + ")";
  }
  return out;
}

/// Moves the wishes between sides to those dropped when some side is visited twice; whether any was moved.
bool keep_sides_whole(const std::vector<Item>& items, const Access& access, Order& out) {
  std::vector<geometry::Vec3> seen;
  bool twice = false;
  for (const SetupOrder& s : out.setups) {
    twice = twice || std::find(seen.begin(), seen.end(), s.direction) != seen.end();
    seen.push_back(s.direction);
  }
  if (!twice) return false;
  const auto side = [&](std::size_t i) { return access.of_feature[items[i].feature]; };
  const auto moved = std::stable_partition(
      out.precedences.begin(), out.precedences.end(),
      [&](const Precedence& p) { return p.cause != Cause::kDatum || side(p.before) == side(p.after); });
  const bool any = moved != out.precedences.end();
  out.dropped.insert(out.dropped.end(), moved, out.precedences.end());
  out.precedences.erase(moved, out.precedences.end());
  return any;
}

}  // namespace

Result<Order> order(const std::vector<model::FeatureShape>& shapes, const std::vector<Item>& items,
                    const Options& options, Job& job) {
  if (auto ok = validate(shapes, items, options); !ok) return fail(ok.error());
  Order out;
  const Access access = access_of(shapes, options);
  out.precedences = all_precedences(shapes, items, options, access, out.dropped);
  Scheduler scheduler(items, access, out.precedences, options.directions.size());
  bool done = scheduler.run(out);
  if (done && out.setups.size() > 1 && keep_sides_whole(items, access, out)) {
    // A wish between sides is not worth another clamping.
    out.setups.clear();
    out.tool_changes = 0;
    Scheduler again(items, access, out.precedences, options.directions.size());
    done = again.run(out);
  }
  for (const Precedence& p : out.dropped)
    job.note("SEQ-GIVEN", "order not kept, it contradicts one that must hold: " + p.text);
  if (!done) {
    out.cycle = scheduler.cycle(out.precedences);
    out.cannot = describe(out.cycle, items, out.precedences);
    out.setups.clear();
    out.tool_changes = 0;
  }
  return out;
}

}  // namespace capstan::sequence
