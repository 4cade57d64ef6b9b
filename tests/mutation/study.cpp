#include "tests/mutation/study.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "planner/proof/verify/program/program_checks.h"
#include "tests/mutation/lines.h"
#include "tests/support/rs274.h"
#include "tooling/library/library.h"

namespace capstan::mutation {
namespace {

using Findings = std::vector<model::Finding>;

bool any(const Findings& findings) {
  return std::any_of(findings.begin(), findings.end(),
                     [](const auto& f) { return f.severity != Severity::kNote; });
}

std::string first(const Findings& findings) {
  for (const auto& f : findings) {
    if (f.severity != Severity::kNote) return f.code + " line " + std::to_string(f.move) + " " + f.message;
  }
  return {};
}

/// As `capstan check PLAN PROGRAM TABLE`.
Findings with_plan(const Emitted& e, const Edit& edit, bool whole) {
  const verify::ProgramText text{e.name, edit.text, edit.table};
  auto found = verify::check_program_text(text, &e.plan, e.plan.machine, e.plan.cutters);
  if (any(found) || !whole) return found;
  Job job;
  return verify::check_program(text, &e.plan, e.plan.machine, e.plan.cutters, job);
}

/// As `capstan check PROGRAM TABLE`: the tools are those of the table. What it says first; empty: nothing.
std::string said_alone(const Emitted& e, const Edit& edit) {
  Job job;
  if (e.table.empty())  // a control that reads none: the tools are those of the header
    return first(verify::check_program_text({e.name, edit.text, ""}, nullptr, e.plan.machine, {}));
  const auto cutters = tooling::read_tool_table(edit.table, "table", job);
  if (!cutters) return to_text(cutters.error());
  return first(
      verify::check_program_text({e.name, edit.text, edit.table}, nullptr, e.plan.machine, *cutters));
}

/// One event of a run, with the state it happens in, and where it ends.
struct Event {
  std::string what;
  std::vector<double> to;
};

/// Equal within the last of the decimals that LinuxCNC prints. An arc's centre counts from half a micrometre
/// on: its ends stay, and a control that has four decimals rounds these and the centre each on its own.
bool same(const std::vector<Event>& a, const std::vector<Event>& b) {
  constexpr double kPrinted = 1.01e-4, kCentre = 5e-4;
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Event& x, const Event& y) {
    if (x.what != y.what || x.to.size() != y.to.size()) return false;
    const bool arc = x.what.starts_with("ARC_FEED");  // ends in x and y, centre in x and y, turns, height
    for (std::size_t i = 0; i < x.to.size(); ++i) {
      const bool centre = arc && (i == 2 || i == 3);
      if (std::abs(x.to[i] - y.to[i]) > (centre ? kCentre : kPrinted)) return false;
    }
    return true;
  });
}

/// The events of a run; what says nothing new is left out.
std::vector<Event> events(const testing::Rs274Run& run) {
  std::vector<Event> out;
  std::map<std::string, std::string> state;
  std::string at, selected;
  bool ended = false;
  // Of waits, stops and changes it matters what turns and flows; of rapids, where they are; of feeds, all.
  const auto put = [&](std::string what, bool feeds, std::vector<double> to = {}) {
    for (const auto& [name, value] : state) {
      const bool turns = name == "spindle" || name == "flood" || name == "mist";
      const bool of_feeds = turns || name == "feed" || name == "speed" || name == "SET_MOTION_CONTROL_MODE" ||
                            name == "SET_NAIVECAM_TOLERANCE";
      if (feeds || (to.empty() ? turns : !of_feeds)) what += "|" + name + " " + value;
    }
    out.push_back({std::move(what), std::move(to)});
  };
  for (const testing::CanonCall& c : run.calls) {
    const std::string& n = c.name;
    if (n == "SET_FEED_RATE") {
      state["feed"] = c.text;
    } else if (n == "SET_SPINDLE_SPEED") {
      state["speed"] = c.text;
    } else if (n == "START_SPINDLE_CLOCKWISE" || n == "START_SPINDLE_COUNTERCLOCKWISE" ||
               n == "STOP_SPINDLE_TURNING") {
      state["spindle"] = n;
    } else if (n == "FLOOD_ON" || n == "FLOOD_OFF") {
      state["flood"] = n;
    } else if (n == "MIST_ON" || n == "MIST_OFF") {
      state["mist"] = n;
    } else if (n == "USE_LENGTH_UNITS") {
      continue;  // what follows is printed in them
    } else if (n.rfind("SET_", 0) == 0 || n.rfind("USE_", 0) == 0 || n.rfind("SELECT_PLANE", 0) == 0 ||
               n.rfind("ENABLE_", 0) == 0 || n.rfind("DISABLE_", 0) == 0) {
      state[n] = c.text;
    } else if (n == "STRAIGHT_TRAVERSE" || n == "STRAIGHT_FEED") {
      if (c.text != at) put(n, n == "STRAIGHT_FEED", c.numbers);
      at = c.text;
    } else if (n == "ARC_FEED") {
      put(n, true, c.numbers);
      at.clear();
    } else if (n == "SELECT_TOOL") {
      selected = c.text;  // the change itself names the table's row
    } else if (n == "CHANGE_TOOL") {
      put(n + selected, false);
    } else if (n == "DWELL" || n == "RIGID_TAP" || n == "PROGRAM_STOP" || n == "OPTIONAL_PROGRAM_STOP" ||
               n == "PALLET_SHUTTLE" || n == "PROGRAM_END") {
      put(n + c.text, false);
      if (n == "RIGID_TAP") at.clear();
      ended = ended || n == "PROGRAM_END";
      if (ended) break;
    } else if (n == "START_SPEED_FEED_SYNCH" || n == "STOP_SPEED_FEED_SYNCH") {
      state["synch"] = n + c.text;
    }
  }
  if (!ended) out.push_back({"refused", {}});
  return out;
}

/// Off at the start, where nothing was said yet.
void normalise(std::vector<Event>& all) {
  for (Event& event : all) {
    std::string& e = event.what;
    for (const char* off : {"|flood FLOOD_OFF", "|mist MIST_OFF", "|spindle STOP_SPINDLE_TURNING"}) {
      const auto at = e.find(off);
      if (at != std::string::npos) e.erase(at, std::string(off).size());
    }
  }
}

/// With each length offset behind the change of its tool. Nothing moves between the two, so the order is the
/// same to a machine; LinuxCNC's stand-alone interpreter, which has none to ask where it is, forgets the
/// offset at the change.
std::string offset_behind_change(const std::string& text) {
  Lines lines = split(text);
  for (std::size_t i = 0; i + 1 < lines.size(); ++i) {
    const std::string& change = lines[i + 1];
    if (is_change(change) && lines[i] == "G43 H" + change.substr(1, change.find(' ') - 1))
      std::swap(lines[i], lines[i + 1]);
  }
  return joined(lines);
}

std::vector<Event> events_of(const Edit& edit) {
  auto out = events(testing::run_rs274(edit.table, offset_behind_change(edit.text)));
  normalise(out);
  return out;
}

/// The first line that is another one.
std::string difference(const std::string& a, const std::string& b) {
  const auto [x, y] = std::mismatch(a.begin(), a.end(), b.begin(), b.end());
  const auto line = [](const std::string& text, std::string::const_iterator at) {
    const auto i = static_cast<std::size_t>(at - text.begin());
    const std::size_t begin = i == 0 ? 0 : text.rfind('\n', i - 1) + 1;
    return text.substr(begin, text.find('\n', i) - begin);
  };
  return ": '" + line(a, x) + "' became '" + line(b, y) + "'";
}

}  // namespace

/// The words of an edit with the decimal points that a FANUC asks for, and waits in its unit: what is spoilt
/// is to be found by what it means.
std::string with_points(const std::string& text, const std::string& dialect) {
  if (dialect != "fanuc" && dialect != "haas") return text;  // they ask for no points
  Lines lines = split(text);
  for (std::string& l : lines) {
    if (!is_code(l)) continue;
    for (const char c : std::string_view("XYZIJRQFEU")) {
      const Word w = word(l, c);
      if (w.at == std::string::npos || holds(l.substr(w.at, w.length), ".")) continue;
      l.insert(w.at + w.length, ".");
    }
    const Word p = word(l, 'P');
    if (!starts(l, "G4 ") || p.at == std::string::npos || dialect != "fanuc") continue;
    constexpr double kSeconds = 100.0;  // what a class inserts is less, what a program waits in ms is more
    l.replace(p.at, p.length, trimmed(p.value < kSeconds ? 1000.0 * p.value : p.value, 0));
  }
  return joined(lines);
}

std::vector<Row> study(const Options& options) {
  std::vector<Row> rows;
  const bool own = options.dialect == "linuxcnc";
  static std::map<std::string, std::vector<Emitted>> others;
  if (!own && !others.contains(options.dialect)) others[options.dialect] = emitted_for(options.dialect);
  const auto& programs = !own ? others[options.dialect] : options.planned ? emitted_and_planned() : emitted();
  const std::vector<Class> all_classes = classes_of(options.dialect);
  const bool by_interpreter = options.by_interpreter && own;
  std::vector<std::vector<Event>> as_emitted;  // what LinuxCNC makes of each
  if (by_interpreter) {
    for (const Emitted& e : programs) as_emitted.push_back(events_of({e.text, e.table}));
  }
  for (std::size_t k = 0; k < all_classes.size(); ++k) {
    const Class& c = all_classes[k];
    Row row;
    row.of = c;
    for (std::size_t p = 0; p < programs.size(); ++p) {
      const Emitted& e = programs[p];
      for (int i = 0; i < options.edits; ++i) {
        const std::uint64_t seed = options.first_seed + static_cast<std::uint64_t>(i);
        Random random(seed * 1000003U + k * 101U + p);
        auto edit = c.make(e, random);
        const bool unpoints = std::string(c.name) == "length without its point";
        if (edit && !own && !unpoints && c.kind != Kind::kBenign)
          edit->text = with_points(edit->text, options.dialect);
        if (!edit || (edit->text == e.text && edit->table == e.table)) continue;
        const bool asks = c.kind == Kind::kUnknown || c.kind == Kind::kBenign;
        const bool alike =
            asks && by_interpreter ? same(events_of(*edit), as_emitted[p]) : c.kind == Kind::kBenign;
        if (c.kind == Kind::kUnknown && !by_interpreter) continue;
        const std::string name =
            std::string(c.name) + ", " + e.name + ", seed " + std::to_string(seed) + ": ";
        const Findings all = with_plan(e, *edit, options.whole);
        const std::string told_alone = said_alone(e, *edit);
        const bool alone = !told_alone.empty();
        ++row.edits;
        row.same += alike;
        row.found += any(all);
        row.found_alone += alone;
        const auto tell = [&](int& count, const std::string& what) {
          ++count;
          row.told.push_back(name + what);
        };
        if (c.kind == Kind::kBenign) {
          if (!alike) row.told.push_back(name + "not the same by LinuxCNC");
          if (any(all) || alone)
            tell(row.benign_blamed,
                 any(all) ? first(all) : "alone: " + told_alone + difference(e.text, edit->text));
        } else if (c.kind == Kind::kDangerous) {
          if (!any(all)) tell(row.dangerous_missed, "not found with the plan");
          if (c.in_any_program && !alone) tell(row.dangerous_missed, "not found alone");
        } else if (!alike && !any(all)) {
          tell(row.different_missed, "differs and is not found" + difference(e.text, edit->text));
        }
      }
    }
    rows.push_back(std::move(row));
  }
  return rows;
}

}  // namespace capstan::mutation
