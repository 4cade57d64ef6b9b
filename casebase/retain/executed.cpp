#include "casebase/retain/executed.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace capstan::casebase::retain {
namespace {

constexpr double kLeastHeld = 1e-3;

// Feed and spindle speed: the numbers whose longest held value is asked for.
constexpr std::array kHeld = {Item::kFeed, Item::kSpindle};

}  // namespace

Splitter::Splitter(SplitOptions options) : options_(std::move(options)) {
  running_ = options_.runs_unless_said;
  run_ = running_ ? 1 : 0;
}

void Splitter::open(const Reading& r) {
  Open o;
  o.step.run = run_;
  o.step.workingstep = workingstep_;
  o.step.program = program_;
  o.step.tool = tool_;
  o.step.tool_instance = tool_instance_;
  o.step.begin_s = o.step.end_s = r.t_s;
  o.step.first_log_line = o.step.last_log_line = r.line;
  o.step.tool_changed = std::exchange(tool_changed_, false);
  o.rising.resize(options_.triggers.size());
  open_ = std::move(o);
}

void Splitter::close() {
  if (!open_) return;
  Executed& s = open_->step;
  s.longest_stop_s = std::max(s.longest_stop_s, open_->stop_s);
  for (std::size_t i = 0; i < kHeld.size(); ++i) {
    const Held::Longest longest = open_->held[i].longest();
    Statistic& n = s.number[index_of(kHeld[i])];
    n.held = longest.value;
    n.held_s = longest.seconds;
  }
  for (Statistic& n : s.number) {
    if (n.seconds > 0.0) n.mean /= n.seconds;
  }
  for (std::size_t i = 0; i < open_->rising.size(); ++i) {
    const auto& e = open_->rising[i];
    if (e && e->lasted_s >= options_.triggers[i].for_s && s.events.size() < kMaxEvents)
      s.events.push_back(*e);
  }
  if (s.active_s > 0.0 || s.cut_off) done_.push_back(std::move(s));
  open_.reset();
}

// Weighs what held since the last reading.
void Splitter::weigh(double seconds) {
  for (std::size_t i = 0; i < kNumbers; ++i) {
    if ((known_ >> i & 1U) == 0) continue;
    Statistic& s = open_->step.number[i];
    s.seconds += seconds;
    s.mean += now_[i] * seconds;
    if (std::abs(now_[i]) > std::abs(s.peak)) s.peak = now_[i];
  }
  for (std::size_t i = 0; i < kHeld.size(); ++i) {
    const std::size_t n = index_of(kHeld[i]);
    const double value = std::abs(now_[n]);
    if ((known_ >> n & 1U) == 0 || value < kLeastHeld) continue;
    open_->held[i].add(value, seconds);
  }
}

void Splitter::keep_load() {
  const std::size_t n = index_of(Item::kLoad);
  if ((known_ >> n & 1U) == 0) return;
  std::vector<Kept>& kept = open_->step.load;
  const double t = open_->step.moving_s;
  if (!kept.empty() && (std::abs(kept.back().value - now_[n]) < options_.threshold_percent ||
                        t - kept.back().t_s < open_->keep_every_s)) {
    return;
  }
  kept.push_back({t, now_[n]});
  if (kept.size() < options_.most_kept) return;
  for (std::size_t i = 0; 2 * i < kept.size(); ++i) kept[i] = kept[2 * i];
  kept.resize((kept.size() + 1) / 2);
  open_->keep_every_s = 2.0 * std::max(open_->keep_every_s, t / static_cast<double>(options_.most_kept));
}

// The time between the last reading and the next belongs to what the last one said.
void Splitter::pass(double seconds, double way_mm, const Reading& next) {
  Executed& s = open_->step;
  const bool by_feed = (known_ >> index_of(Item::kFeed) & 1U) != 0;
  const bool moving = by_feed ? now_[index_of(Item::kFeed)] > 0.0 : way_mm > 0.0;
  s.active_s += seconds;
  s.end_s = next.t_s;
  s.last_log_line = next.line;
  moving_ = moving;
  if (!moving) {
    open_->stop_s += seconds;
    return;
  }
  s.longest_stop_s = std::max(s.longest_stop_s, std::exchange(open_->stop_s, 0.0));
  if (seconds > options_.gap_s) s.gap_s += seconds;
  weigh(seconds);
  s.moving_s += seconds;
  s.path_mm += by_feed ? now_[index_of(Item::kFeed)] / 60.0 * seconds : way_mm;
  keep_load();
}

void Splitter::watch(const Reading& r) {
  for (std::size_t i = 0; i < options_.triggers.size(); ++i) {
    const Trigger& t = options_.triggers[i];
    const std::size_t n = index_of(t.item);
    const double amount = (known_ >> n & 1U) != 0 ? std::abs(now_[n]) : 0.0;
    std::optional<Event>& e = open_->rising[i];
    if (amount > t.above) {
      if (!e) {
        e = Event{.item = name_of(t.item),
                  .above = t.above,
                  .peak = amount,
                  .t_s = r.t_s,
                  .log_line = r.line,
                  .program_line = line_};
      }
      e->peak = std::max(e->peak, amount);
    } else if (e) {
      if (e->lasted_s >= t.for_s && open_->step.events.size() < kMaxEvents) {
        open_->step.events.push_back(*e);
      }
      e.reset();
    }
  }
}

// The way from the place that is known to the one that a reading says.
double Splitter::way_to(const Reading& r) const {
  if ((known_ & 7U) != 7U) return 0.0;
  double sum = 0.0;
  for (std::size_t i = 0; i < 3; ++i) {
    const double d = r.says(static_cast<Item>(i)) ? r.number[i] - now_[i] : 0.0;
    sum += d * d;
  }
  return std::sqrt(sum);
}

void Splitter::take(const Reading& r) {
  if (open_) {
    pass(r.t_s - last_s_, way_to(r), r);
    for (auto& e : open_->rising) {
      if (e) e->lasted_s = r.t_s - e->t_s;
    }
  }
  last_s_ = r.t_s;

  const bool was_running = running_;
  if (r.running) running_ = *r.running;
  running_said_ = running_said_ || r.running;
  if (r.program) program_ = *r.program;
  if (r.workingstep) said_workingstep_ = *r.workingstep;
  if (r.program_line) line_ = *r.program_line;
  std::string step = said_workingstep_;
  int tool = r.tool.value_or(tool_);
  if (step.empty() && options_.marks != nullptr) {
    if (const ProgramMark* m = options_.marks->at(line_)) {
      step = m->id;
      if (m->tool != 0 && !r.tool) tool = m->tool;
    }
  }
  if (running_ && !was_running) ++run_;
  std::string instance = tool != tool_ ? std::string() : tool_instance_;
  if (r.tool_instance) instance = *r.tool_instance;
  // A tool that says its serial number a moment after it was loaded is the same tool.
  const bool other_edge = instance != tool_instance_ && !tool_instance_.empty();
  const bool other = tool != tool_ || other_edge || step != workingstep_ || running_ != was_running;
  if (tool != tool_ && tool != 0) tool_changed_ = true;
  tool_ = tool;
  tool_instance_ = std::move(instance);
  workingstep_ = std::move(step);
  if (other) close();
  if (open_) open_->step.tool_instance = tool_instance_;

  for (std::size_t i = 0; i < kNumbers; ++i) {
    if (r.says(static_cast<Item>(i))) now_[i] = r.number[i];
  }
  known_ = static_cast<std::uint16_t>(known_ | r.has);

  // No tool in the spindle and no step named: the machine is changing tools, or is in the program's head.
  tool_said_ = tool_said_ || r.tool;
  const bool between = workingstep_.empty() && tool_ == 0 &&
                       (tool_said_ || options_.marks != nullptr || !options_.runs_unless_said);
  if (!running_ || between) return;
  if (!open_) open(r);
  Executed& s = open_->step;
  ++s.readings;
  if (r.program_line) {
    if (s.first_line == 0) s.first_line = line_;
    s.last_line = line_;
  }
  watch(r);
}

// Where a feed is known the last reading says whether the machine still moves; else the last way does.
std::vector<Executed> Splitter::end() {
  if (open_) {
    const bool by_feed = (known_ >> index_of(Item::kFeed) & 1U) != 0;
    open_->step.cut_off = running_said_ || (by_feed ? now_[index_of(Item::kFeed)] > 0.0 : moving_);
  }
  close();
  return std::move(done_);
}

}  // namespace capstan::casebase::retain
