#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/ground/geometry/vec.h"
#include "planner/model/plan/plan.h"

namespace capstan::service {

/// What a control tells while it runs a plan.
struct ControlEvent {
  enum class Kind : std::uint8_t { kStart, kEnd, kAt };
  Kind kind = Kind::kAt;            ///< a workingstep begins or ends; or where the tool is within it
  std::string workingstep;          ///< its id
  std::string time;                 ///< as the control says it, for what reports the time
  std::optional<double> elapsed_s;  ///< since any moment that is the same for all events
  std::optional<geometry::Vec3> location_mm;    ///< in the set-up's frame
  std::map<std::string, std::string> measured;  ///< by the names of AP238 ("spindle speed"), each as JSON
};

/// One broadcast, as it is sent.
struct BroadcastLine {
  std::string json;          ///< an object, without a line end
  bool waits = false;        ///< the control goes on when somebody has replied
  std::uint64_t number = 0;  ///< counts the lines of a run, from 1
};

/// What is sent where a plan states no broadcast: at start and end of each workingstep.
struct DefaultContent {
  bool start = true, end = true;
  std::vector<std::string> measured;  ///< empty: all that the control tells
  bool only_if_changed = false, wait_for_reply = false;
};

/// The broadcasts of a plan (ISO 10303-238 edition 4) as a control runs it: which lines are due, and what
/// stands in them.
///
/// Where   `start_content` and `end_content` of an executable and of each of its broadcasts, when it begins
/// and
///         ends; a workplan begins with the first of its workingsteps, and ends when one begins that is not
///         its own, or by `finish`. Within it: `broadcast_point`, once when the tool passes the point, within
///         what the control may round a path by; `broadcast_distance` and `broadcast_time`, whenever so much
///         way or time is over since the last; `broadcast_count`, at each such number of events within it.
/// What    the object has what the content asks for and nothing else: `message`; `measured` by name, null for
///         what the control did not tell; `context` of the program by name, null for what the plan does not
///         have; `time`, `sequence`. A content that asks for nothing is a time stamp: `time` alone.
/// only_if_changed  what is the same as this content sent last, but for time and sequence, is not sent.
/// Source  the attributes of the edition 4 mapping; its text was not at hand: where it says more than
///         the names, this may differ.
class Broadcasts {
 public:
  explicit Broadcasts(const model::Plan& plan, const std::optional<DefaultContent>& otherwise = {});

  /// The lines that are due by an event, in order. Fails  BROADCAST-STEP: there is no such workingstep;
  /// BROADCAST-ORDER: it has not begun.
  [[nodiscard]] Result<std::vector<BroadcastLine>> tell(const ControlEvent& event);
  /// Goes on where others were, of the same plan before it was bound further: what runs, what was sent last,
  /// the count of lines.
  void take_over(const Broadcasts& before);
  /// The lines that are due because the run is over.
  [[nodiscard]] std::vector<BroadcastLine> finish(const ControlEvent& event);
  /// Whether anything can be due.
  [[nodiscard]] bool any() const;

 private:
  struct Content {
    std::string id;
    std::optional<std::string> message, stream;
    std::vector<std::string> measured, contexts;
    bool all_measured = false, time = false, sequence = false, only_if_changed = false, wait = false;
    [[nodiscard]] bool empty() const;
  };
  struct Repeated {
    enum class By : std::uint8_t { kPoint, kCount, kDistance, kTime } by = By::kPoint;
    double every = 0.0;
    geometry::Vec3 point;
    std::size_t content = 0;
    double since = 0.0;  ///< way, time or events since the last
    bool passed = false;
  };
  struct Unit {  ///< an executable that may run
    std::string id;
    std::optional<std::size_t> parent;
    std::vector<std::size_t> at_start, at_end;  ///< of `contents_`
    std::vector<Repeated> within;
    std::map<std::string, std::string> context;  ///< by name, each as JSON
    bool runs = false;
  };

  void add_unit(const model::Plan& plan, model::AnyRef executable);
  void add_broadcasts(const model::Plan& plan, const model::RefList<model::Broadcast>& all, Unit& unit);
  std::optional<std::size_t> content(const model::Plan& plan, model::AnyRef at);
  void add_contexts(const model::Plan& plan);
  void begin(std::size_t unit, const ControlEvent& event, std::vector<BroadcastLine>& out);
  void end(std::size_t unit, const ControlEvent& event, std::vector<BroadcastLine>& out);
  void moved(Unit& unit, const ControlEvent& event, std::vector<BroadcastLine>& out);
  void send(std::size_t content, std::size_t unit, const ControlEvent& event,
            std::vector<BroadcastLine>& out);

  std::vector<Content> contents_;
  std::vector<Unit> units_;
  std::map<std::string, std::size_t> by_id_;     ///< workingsteps
  std::map<model::AnyRef, std::size_t> by_ref_;  ///< executables
  std::map<model::AnyRef, std::size_t> known_;   ///< contents
  std::map<std::size_t, std::string> last_;      ///< what a content sent last
  std::vector<std::size_t> running_;             ///< outermost first
  std::optional<geometry::Vec3> was_at_mm_;
  std::optional<double> was_s_;
  double reach_mm_ = 0.0;
  std::uint64_t sent_ = 0;
};

}  // namespace capstan::service
