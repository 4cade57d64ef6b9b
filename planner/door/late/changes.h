#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "planner/ground/base/result.h"
#include "planner/model/plan/plan.h"

namespace capstan::late {

/// The kinds of decisions that a control may take. kOrder: which steps there are, and in which order.
/// kStrategy: the way of the cutter, at the depths that there are. kAlternatives: which element of a
/// selective is taken. kConditions: if and while statements, by what was measured.
enum class Choice : std::uint8_t { kTools, kFeeds, kDepths, kStrategy, kOrder, kAlternatives, kConditions };
inline constexpr std::size_t kChoices = 7;
[[nodiscard]] std::string_view to_text(Choice c);  ///< "tools", "feeds", ...

/// A set of them.
class Decisions {
 public:
  [[nodiscard]] static Decisions all();
  [[nodiscard]] bool has(Choice c) const { return (bits_ >> static_cast<unsigned>(c) & 1U) != 0; }
  void add(Choice c) { bits_ |= 1U << static_cast<unsigned>(c); }
  /// Those that both have.
  [[nodiscard]] Decisions within(Decisions other) const;
  /// "depths,feeds": by their names, with commas; "all"; "none". Fails  OPTION-VALUE.
  [[nodiscard]] static Result<Decisions> parse(const std::string& text);
  [[nodiscard]] std::string text() const;
  friend bool operator==(Decisions, Decisions) = default;

 private:
  [[nodiscard]] std::string names() const;
  unsigned bits_ = 0;
};

/// What changed in one step.
struct Change {
  std::string step;             ///< its name
  std::vector<Choice> decided;  ///< kinds of decisions that this needed, each once, in order
  std::string text;      ///< "T9 endmill 6 mm instead of T10 endmill 8 mm; feed 1200 instead of 1500 mm/min"
  double seconds = 0.0;  ///< that it takes longer now
};

/// What the steps of `after` do differently from those of `before`, in the order of `after`, then steps that
/// are gone. Steps are matched by name. What `before` left open and `after` has is a change, too. A tool that
/// is the same by its number, measured smaller, is no other tool: its new path is no decision, a new depth
/// is.
/// `part`: `after` has some of the steps, and the nouns of `before`; the others are not reported.
[[nodiscard]] std::vector<Change> changes(const model::Plan& before, const model::Plan& after,
                                          bool part = false);

/// The same in sentences for a screen, one a line, with what it does to the time in all; empty: nothing
/// changed.
[[nodiscard]] std::string words_of(const std::vector<Change>& changes,
                                   const std::vector<std::string>& reopened, const model::Plan& before,
                                   const model::Plan& after);

/// Why a plan may not be given that decides more than `may`, or that changes what the operator pinned.
[[nodiscard]] Status within_policy(const model::Plan& before, const model::Plan& after, Decisions may,
                                   bool part = false);

}  // namespace capstan::late
