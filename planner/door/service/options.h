#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "planner/door/service/request.h"

namespace capstan::service {

/// The verbs that an option may belong to.
enum class Verb : std::uint8_t { kPlan, kBind, kCheck };
inline constexpr std::size_t kVerbs = 3;

/// The kinds of values of options.
enum class Value : std::uint8_t { kText, kWord, kWhole, kFlag };

/// The help of an option that one verb alone has.
[[nodiscard]] constexpr std::array<const char*, kVerbs> of_plan(const char* text) {
  return {text, nullptr, nullptr};
}
[[nodiscard]] constexpr std::array<const char*, kVerbs> of_bind(const char* text) {
  return {nullptr, text, nullptr};
}

/// One option of a request: a row of `options`. The command line, the C interface and other transports take
/// it by its name; the C++ library has a field for it.
struct Option {
  std::string_view name;
  Value value = Value::kText;
  /// One sentence for each verb that has the option, by Verb; null: that verb has it not.
  std::array<const char*, kVerbs> help = {};
  /// Sets it in the request. Gives what is wrong with the text, or nothing. A flag takes "yes" or "no".
  std::string (*set)(Request& request, const std::string& text) = nullptr;
  std::vector<std::string> words = {};  ///< Value::kWord: those it takes; kText: names among what it takes
  unsigned least = 0, most = 0;         ///< Value::kWhole
  std::string_view excludes = {};       ///< the option that excludes this one
  bool of_all_commands = false;         ///< the command line takes it in front of any command
  bool repeatable = false;              ///< each value adds to the others
  bool of_shop = false;                 ///< a shop file may give it (shop_file/shop_file.h)

  [[nodiscard]] const char* help_of(Verb v) const { return help[static_cast<std::size_t>(v)]; }
};

/// How a value of `assume` begins that says what tools are made of; the material follows.
inline constexpr const char* kAssumeToolMaterial = "tool-material=";

/// All options, in the order of help texts.
[[nodiscard]] std::span<const Option> options();
/// The option of that name; null if there is none.
[[nodiscard]] const Option* find_option(std::string_view name);

/// Sets an option by its name. Fails  OPTION-UNKNOWN with the nearest names; OPTION-VALUE: the text is empty,
/// or not a value of the option.
[[nodiscard]] Status set(Request& request, std::string_view name, const std::string& text);

/// The contradiction between options; empty: none. Profit needs a revenue, no other objective takes one;
/// --strict and --allow-findings exclude each other.
[[nodiscard]] std::string contradiction(const Request& request);

/// "200ms", "1.5s", "200" (milliseconds); nothing when it is no duration above 0.
[[nodiscard]] std::optional<std::chrono::milliseconds> parse_duration(const std::string& text);

/// "block:+2" sets the allowance, "box:x0,y0,z0,x1,y1,z1" the box; gives what is wrong, or nothing.
[[nodiscard]] std::string parse_stock(const std::string& text, Request& into);

}  // namespace capstan::service
