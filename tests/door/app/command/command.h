#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "tests/door/app/programs.h"
#include "tests/support/corpus.h"

// The built program, run as a user runs it, in a folder of its own.

namespace capstan::app {

struct Ran {
  int code = -1;
  std::string out, err;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

class CommandTest : public ::testing::Test {
 protected:
  /// `arguments` as a shell takes them.
  [[nodiscard]] Ran run(const std::string& arguments) const {
    return run_line(command_quoted() + " " + arguments);
  }
  /// The same of a Python program, which finds the command by the variable CAPSTAN.
  [[nodiscard]] Ran run_python(const std::string& arguments) const {
    return run_line(python_quoted() + " -B " + arguments);
  }
  void put(const std::string& name, const std::string& bytes) const {
    std::ofstream(folder_ / name, std::ios::binary) << bytes;
  }
  /// Files of the folder but for the two streams.
  [[nodiscard]] std::vector<std::string> files() const {
    std::vector<std::string> out;
    for (const auto& e : std::filesystem::directory_iterator(folder_)) {
      const std::string name = e.path().filename().string();
      if (name != "stdout.txt" && name != "stderr.txt") out.push_back(name);
    }
    std::sort(out.begin(), out.end());
    return out;
  }

  [[nodiscard]] Ran run_line(const std::string& command) const {
    const std::filesystem::path out = folder_ / "stdout.txt";
    const std::filesystem::path err = folder_ / "stderr.txt";
    const std::string line =
        "cd '" + folder_.string() + "' && " + command + " >'" + out.string() + "' 2>'" + err.string() + "'";
    const int status = std::system(line.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, slurp(out), slurp(err)};
  }

  ::capstan::testing::ScratchFolder scratch_;
  std::filesystem::path folder_ = scratch_.path();
};

}  // namespace capstan::app
