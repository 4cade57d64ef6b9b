#include "planner/door/app/command/telling/telling.h"

#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <mutex>

#include "planner/ground/base/number.h"

namespace capstan::app {
namespace {

using Clock = std::chrono::steady_clock;

/// A bar on a terminal, once work has taken more than a second; nothing in a pipe.
class Bar {
 public:
  void show(std::string_view stage, double fraction) {
    const auto now = Clock::now();
    if (now - begun_ < std::chrono::seconds(1) || now - shown_ < std::chrono::milliseconds(100)) return;
    shown_ = now;
    constexpr int kWidth = 30;
    const double f = std::clamp(fraction, 0.0, 1.0);
    const auto full = static_cast<std::size_t>(f * kWidth);
    const std::string bar = std::string(full, '#') + std::string(kWidth - full, '.');
    std::fprintf(stderr, "\r%-20.*s [%s] %3d %%", static_cast<int>(stage.size()), stage.data(), bar.c_str(),
                 static_cast<int>(100.0 * f));
    std::fflush(stderr);
    visible = true;
  }
  bool visible = false;

 private:
  Clock::time_point begun_ = Clock::now();
  Clock::time_point shown_;
};

Bar& bar() {
  static Bar one;
  return one;
}

/// Lines of JSON, the first at once.
class Lines {
 public:
  void show(std::string_view stage, double fraction) {
    const std::scoped_lock lock(mutex_);
    const auto now = Clock::now();
    if (said_ && now - last_ < std::chrono::milliseconds(500)) return;
    said_ = true;
    last_ = now;
    // Names of stages are words of the program.
    std::fprintf(stderr, "{\"code\":\"PROGRESS\",\"stage\":\"%.*s\",\"fraction\":%s}\n",
                 static_cast<int>(stage.size()), stage.data(),
                 trimmed(std::clamp(fraction, 0.0, 1.0), 3).c_str());
    std::fflush(stderr);
  }

 private:
  std::mutex mutex_;
  bool said_ = false;
  Clock::time_point last_;
};

}  // namespace

std::function<void(std::string_view, double)> progress_teller(ProgressForm told, bool on_terminal) {
  if (told == ProgressForm::kJson) {
    return [lines = std::make_shared<Lines>()](std::string_view stage, double f) { lines->show(stage, f); };
  }
  if (told == ProgressForm::kNone || !on_terminal) return nullptr;
  return [](std::string_view stage, double f) { bar().show(stage, f); };
}

void end_progress() {
  if (bar().visible) std::fputs("\r\033[K", stderr);
}

bool in_colour() {
  const char* no = std::getenv("NO_COLOR");
  const char* term = std::getenv("TERM");
  return ::isatty(STDERR_FILENO) != 0 && (no == nullptr || *no == '\0') &&
         (term == nullptr || std::string_view(term) != "dumb");
}

std::string line_of(const Diagnostic& d, bool colour) {
  std::string text = to_text(d);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  if (!colour || d.severity == Severity::kNote) return text;
  const std::string word = std::string(to_text(d.severity)) + ":";
  const auto at = text.find(word);
  if (at == std::string::npos) return text;
  const char* const on = d.severity == Severity::kError ? "\033[1;31m" : "\033[1;35m";
  return text.substr(0, at) + on + word + "\033[0m" + text.substr(at + word.size());
}

}  // namespace capstan::app
