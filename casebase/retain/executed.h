#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "casebase/record/held.h"
#include "casebase/retain/log.h"
#include "casebase/retain/program_marks.h"

namespace capstan::casebase::retain {

/// Summary of one number over time: weighted by how long it held, while the machine moved.
struct Statistic {
  double seconds = 0.0;  ///< it was known for; 0: never, and nothing below means anything
  double mean = 0.0;
  double peak = 0.0;  ///< largest amount
  double held = 0.0;  ///< the value that held longest (values within 0.5 % are one), and for how long:
  double held_s = 0.0;
};

/// A value that exceeded its limit.
struct Event {
  std::string_view item;  ///< `name_of`
  double above = 0.0, peak = 0.0;
  double t_s = 0.0, lasted_s = 0.0;
  std::uint64_t log_line = 0;
  long program_line = 0;
};

/// A limit on a number of the log: an event is kept when its amount exceeds `above` for `for_s`.
struct Trigger {
  Item item = Item::kLag;
  double above = 0.0;
  double for_s = 0.0;
};

/// A value at a time of its step, as kept: by change and by threshold.
struct Kept {
  double t_s = 0.0;  ///< moving time since the step began
  double value = 0.0;
};

/// What the log shows of one workingstep, or of one tool where no step is named, in one run of the program.
///
/// Units   as the names say; times in s.
struct Executed {
  int run = 1;  ///< of the program, counted in the log
  std::string workingstep, program;
  int tool = 0;
  std::string tool_instance;          ///< empty: not said
  double begin_s = 0.0, end_s = 0.0;  ///< as the log has them
  double active_s = 0.0;              ///< the program ran, and this step was its work
  double moving_s = 0.0;              ///< of it with a feed above zero, rapids included
  double longest_stop_s = 0.0;
  double gap_s = 0.0;    ///< moving, but the log said nothing for longer than `SplitOptions::gap_s`
  double path_mm = 0.0;  ///< by the feed, or where there is none by the positions
  std::array<Statistic, kNumbers> number = {};
  std::uint64_t readings = 0, first_log_line = 0, last_log_line = 0;
  long first_line = 0, last_line = 0;  ///< of the program; 0: not said
  bool tool_changed = false;           ///< the tool was changed for it: false, it was left from before
  bool cut_off = false;  ///< the log ends while the program runs, or where nothing says that: while it moves
  std::vector<Event> events;  ///< at most kMaxEvents, the first ones
  std::vector<Kept> load;     ///< spindle load, thinned

  [[nodiscard]] const Statistic& of(Item i) const { return number[index_of(i)]; }
};
inline constexpr std::size_t kMaxEvents = 1000;

struct SplitOptions {
  const ProgramMarks* marks = nullptr;  ///< lines of the program by workingstep; null: not known
  std::vector<Trigger> triggers = {};
  bool runs_unless_said = false;   ///< of logs that do not tell whether the program runs
  double gap_s = 10.0;             ///< default, unsourced: recorders speak at least once a second
  double threshold_percent = 1.0;  ///< loads that differ by less are one; of rated load
  std::size_t most_kept = 1024;    ///< loads per step; more, and every second one is dropped
};

/// Takes the readings of a log, one by one, and splits them by run, tool and workingstep. Memory grows with
/// the steps, not with the log.
class Splitter {
 public:
  explicit Splitter(SplitOptions options);
  void take(const Reading& r);
  /// What was executed, in order. Steps that took no time are left out, but for one that the log ends within.
  [[nodiscard]] std::vector<Executed> end();

 private:
  struct Open {
    Executed step;
    std::array<Held, 2> held;
    double stop_s = 0.0, keep_every_s = 0.0;
    std::vector<std::optional<Event>> rising;
  };
  void pass(double seconds, double way_mm, const Reading& next);
  [[nodiscard]] double way_to(const Reading& r) const;
  void weigh(double seconds);
  void keep_load();
  void watch(const Reading& r);
  void close();
  void open(const Reading& r);

  SplitOptions options_;
  std::vector<Executed> done_;
  std::optional<Open> open_;
  // The state that the log has stated so far.
  std::array<double, kNumbers> now_ = {};
  std::uint16_t known_ = 0;
  double last_s_ = 0.0;
  bool running_ = false, running_said_ = false, moving_ = false, tool_changed_ = false, tool_said_ = false;
  int run_ = 0, tool_ = 0;
  long line_ = 0;
  std::string workingstep_, said_workingstep_, program_, tool_instance_;
};

}  // namespace capstan::casebase::retain
