#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/service/broadcast/run.h"
#include "planner/door/service/planning.h"
#include "planner/door/service/request.h"
#include "planner/ground/base/job.h"

namespace capstan::service {

/// A session of late binding in a shop that is opened once: what every transport (the C interface, lines on a
/// pipe, ...) keeps for its caller. Nothing is thrown, nothing is printed. With one thread
/// (the default) none outlives a call; others wait, signals blocked, until the process ends.
///
/// Thread safety  one thread at a time, but for `stop`, which any thread may call at any time.
class Session {
 public:
  explicit Session(std::string sign = {}) { request_.sign = std::move(sign); }

  /// Sets an option by its name (options.h). One that the shop depends on opens it anew at the next call, and
  /// reads the shop's settings (the option `shop`) anew. "axis-limits", "work-offset" and "profile" drop what
  /// is bound, for it was not held against them; `bind_next` goes on with it all the same.
  Code set(std::string_view name, const std::string& text);
  /// Sets what became of the loaded tools (late::parse_tool_states), in place of what was told before; the
  /// option "tool-state" does the same with a file. An empty text: nothing is told. What is bound is dropped,
  /// as above. Where workingsteps are bound one after the other, lives count from the one that is bound next.
  /// On kUsage nothing is changed.
  Code tell_tools(const std::string& states);
  /// Opens the shop, so that the first `bind` need not.
  Code open();
  /// Reads a plan, so that the first `bind_next`, without one, need not.
  Code take(std::string plan);
  /// Whether there is a plan at hand.
  [[nodiscard]] bool has_plan() const { return at_hand() != nullptr; }
  /// What the plan at hand (read last, or bound as far as it is; after a bind that was late, what that began
  /// with) leaves open, each in a few words ("its_tool
  /// of DRILLING 'x'").
  [[nodiscard]] std::vector<std::string> left_open() const;
  /// What of the plan at hand no longer holds with machine, material and tools as they are set, a sentence
  /// each (late::no_longer_valid): what a bind would open or check anew. Nothing is bound.
  Code no_longer_valid(std::vector<std::string>& out);
  /// What of the plan at hand does not suit the control (service::unsuited), a line each, errors first.
  Code unsuited(std::vector<std::string>& out);
  /// The broadcasts that are due by what the control tells (`over`: the run is); they go on while the plan is
  /// bound further, and begin anew with another one.
  Code tell(const ControlEvent& event, bool over, std::vector<BroadcastLine>& due);
  /// Binds a plan before the deadline (unset: that of the options, or none). After it the code is kLate,
  /// never kDone.
  Code bind(std::string plan, std::optional<std::chrono::milliseconds> deadline);
  /// The same of so many workingsteps only, against the stock that those before leave (late/next.h). `from`:
  /// the first of them, counted from 1; 0: the first of which something is open. An empty plan: the one that
  /// the last bind gave, so that a part is bound step by step without being read again.
  Code bind_next(std::string plan, std::size_t from, std::size_t count,
                 std::optional<std::chrono::milliseconds> deadline);
  /// Asks the running `bind` to end; it then returns its checked fallback, or kImpossible. A later one is not
  /// affected.
  void stop();
  /// Called with the stage's name and its fraction in [0, 1], by the thread that called `bind` or one of its
  /// workers; nothing: not called. It must not throw, and of this session call `stop` only.
  void set_progress(Job::Progress progress) { progress_ = std::move(progress); }

  /// The bound plan in a format (formats.h); null without a plan, or for an unknown format. Valid until the
  /// next call but `code`, `message` and this.
  const std::string* output(std::string_view format);
  /// What changed against the plan that was brought (Planned::changes); null without a plan.
  [[nodiscard]] const std::string* changes() const { return bound_ ? &bound_->changes : nullptr; }
  /// The broadcasts of the plan at hand; nothing without one.
  [[nodiscard]] std::optional<Broadcasts> broadcasts(const std::optional<DefaultContent>& otherwise) const;
  /// Of what was bound; 0 if nothing is.
  [[nodiscard]] double machining_s() const;
  /// How many workingsteps the bound plan has, those that are still open among them; 0 without a plan.
  [[nodiscard]] std::size_t steps() const;

  /// Code and diagnostics (lines of text) of the last call but `output`.
  [[nodiscard]] Code code() const { return code_; }
  [[nodiscard]] const std::string& message() const { return message_; }

  /// Ends a call in which the caller itself failed.
  void fault() noexcept {
    message_.clear();
    code_ = Code::kFault;
  }
  /// Ends a call that was used wrongly.
  Code wrong(std::string line);

 private:
  template <class Body>
  Code guarded(Body body);
  Code end(Code code, const std::string& line = {});
  Code opened(Job& job);
  /// Gives no output of what was bound any more; what `bind_next` goes on with is kept.
  void drop_bound();
  /// What follows from tools that were told: nothing that was bound before is given.
  void take_told();
  /// Whether `bind_next` goes on with what was bound last: after a late bind, whose steps nobody may have
  /// cut, and after another plan was taken it does not.
  [[nodiscard]] bool goes_on_from_bound() const;
  [[nodiscard]] const model::Plan* at_hand() const;
  /// Asks something of the plan at hand, in the shop: `ask(plan, job)` gives a code.
  template <class Ask>
  Code asked(Ask ask);
  Code bind_as(std::string plan, Request request);

  /// A plan as it was read: the next bind of the same bytes need not read them again.
  struct Read {
    std::string text;
    model::Plan plan;
    std::vector<Diagnostic> said;
  };
  [[nodiscard]] Outcome<const model::Plan*> read(std::string plan, Job& job);

  Request request_;                 ///< as the caller set it
  std::optional<Request> in_shop_;  ///< with what its shop file says beside it; nothing: not read yet
  Job::Progress progress_;
  std::optional<pipeline::Inputs> shop_;
  std::optional<rules::RuleBase> shipped_rules_;  ///< of a shop without its own that was open before
  std::shared_ptr<memo::Memo> memo_ = std::make_shared<memo::Memo>();    ///< of all shops that name no folder
  std::shared_ptr<memo::Memo> proofs_ = std::make_shared<memo::Memo>();  ///< Inputs::proofs
  std::shared_ptr<geometry::KeptOutlines> outlines_ = std::make_shared<geometry::KeptOutlines>();
  std::optional<Read> read_;
  bool failed_ = false;  ///< the shop did not open, and no option was set since
  std::optional<Planned> bound_;
  /// The plan that `bind_next` goes on with: as far as it is bound; without one the plan that was read, where
  /// steps of it are asked for one after the other.
  std::optional<model::Plan> last_;
  bool goes_on_ = false;
  bool taken_since_ = false;  ///< another plan was taken since that was bound
  std::map<std::string, std::string, std::less<>> outputs_;
  BroadcastRun run_;
  std::string message_;
  Code code_ = Code::kDone;
  std::mutex mutex_;  // of running_
  Job* running_ = nullptr;
};

}  // namespace capstan::service
