#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <nlohmann/json.hpp>
#include <regex>
#include <string>
#include <vector>

#include "tests/door/app/command/command.h"
#include "tests/support/corpus.h"

// examples/bracket.p21, planned at the command with a person's edits.

namespace capstan::app {

using nlohmann::json;

inline constexpr const char* kEm8 = "generic/endmill_3f_short/8";

class Edits : public CommandTest {
 protected:
  void SetUp() override {
    put("bracket.p21", slurp(::capstan::testing::source_dir() + "/examples/bracket.p21"));
  }
  /// Plans the bracket with these options into NAME.json and NAME.ngc.
  Ran plan(const std::string& name, const std::string& options) const {
    return run("plan bracket.p21 " + options + " -o " + name + ".json -o " + name + ".ngc");
  }
  [[nodiscard]] json read(const std::string& name) const {
    return json::parse(slurp(folder_ / (name + ".json")));
  }

  /// The steps of a plan by their names.
  [[nodiscard]] std::map<std::string, json> steps_of(const std::string& name) const {
    std::map<std::string, json> out;
    const json plan = read(name);
    for (const json& s : plan["steps"]) out[s["id"]] = s;
    return out;
  }
  /// The reason of one value, as explain tells it.
  [[nodiscard]] std::string why(const std::string& name, const std::string& step,
                                const std::string& value) const {
    return run("explain " + name + ".json '" + step + "' " + value).out;
  }
  /// All F words of a program, mm/min.
  [[nodiscard]] std::vector<double> feeds(const std::string& name) const {
    std::vector<double> out;
    const std::string text = slurp(folder_ / (name + ".ngc"));
    static const std::regex word(R"(F([0-9.]+))");
    static const std::regex comment(R"(\([^)]*\)|;[^\n]*)");
    const std::string bare = std::regex_replace(text, comment, "");
    for (auto it = std::sregex_iterator(bare.begin(), bare.end(), word); it != std::sregex_iterator(); ++it)
      out.push_back(std::stod((*it)[1]));
    return out;
  }
  /// What of a step must not change where nothing that it depends on did.
  [[nodiscard]] static json kept(json step) {
    for (const char* handle : {"step", "path", "sections", "schedule"}) step.erase(handle);
    return step;
  }
};

}  // namespace capstan::app
