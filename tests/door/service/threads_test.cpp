#include <gtest/gtest.h>

#include <condition_variable>
#include <mutex>
#include <set>
#include <string>
#include <thread>

#include "planner/door/service/check.h"
#include "planner/door/service/planning.h"
#include "tests/support/corpus.h"

// What the command does with a part (plan it, make all files, check their program; check the files again)
// gives the same bytes, findings and messages in the same order on any number of threads.

namespace capstan::service {
namespace {

const std::string kSource = capstan::testing::source_dir();

/// A clock that notes which threads read it. Where helpers are `awaited`, the caller's own questions take a
/// millisecond each until one is there, so that it does not do all the work before.
class Witness {
 public:
  explicit Witness(bool awaited) : awaited_(awaited) {}
  std::chrono::steady_clock::time_point read() {
    constexpr int kLongest = 20000;  // waited out only where none ever comes: the test fails then
    std::unique_lock lock(mutex_);
    if (std::this_thread::get_id() != caller_) {
      helpers_.insert(std::this_thread::get_id());
      arrived_.notify_all();
    } else if (awaited_ && helpers_.empty() && ++waited_ < kLongest) {
      arrived_.wait_for(lock, std::chrono::milliseconds(1));
    }
    return {};
  }
  [[nodiscard]] std::size_t helpers() const { return helpers_.size(); }

 private:
  bool awaited_;
  int waited_ = 0;
  std::thread::id caller_ = std::this_thread::get_id();
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::set<std::thread::id> helpers_;
};

/// Runs `work` with a job of so many threads; true if others than the caller's did some of it.
template <class Work>
bool helped(unsigned threads, Job& job, Work work) {
  Witness witness(threads > 1);
  job.threads = threads;
  job.set_deadline(std::chrono::steady_clock::time_point::max());  // so that the clock is read
  job.set_clock([&witness] { return witness.read(); });
  work();
  job.set_clock({});
  return witness.helpers() > 0;
}

std::string text_of(const std::vector<FileFinding>& findings, const Job& job) {
  std::string out;
  for (const FileFinding& f : findings)
    out += f.file + " " + f.finding.code + " " + f.finding.step + " " + std::to_string(f.finding.move) + " " +
           f.finding.message + "\n";
  for (const Diagnostic& d : job.diagnostics()) out += to_text(d) + "\n";
  return out;
}

struct Made {
  std::string text;
  bool files_helped = false, check_helped = false;
};

Made made_on(unsigned threads) {
  Made out;
  const Request request;
  Job job;
  job.threads = threads;
  const auto planned = plan(request, {kSource + "/examples/bracket.p21"}, job);
  EXPECT_TRUE(planned);
  auto outputs = outputs_of({"p.json", "p.p21", "p.stpnc", "p.ngc", "p.tbl"});
  out.files_helped = helped(threads, job, [&] { EXPECT_TRUE(make(planned->plan, *outputs, job)); });
  const auto verdict = judge(request, *planned, *outputs, job);
  EXPECT_TRUE(verdict);
  for (const Output& o : *outputs) out.text += o.bytes;
  out.text += text_of(verdict->findings, job);
  // Two programs, one of them of another plan: there is something to find, and an order to keep.
  std::vector<Source> sources;
  for (const std::size_t i : {0U, 1U, 3U, 4U}) sources.push_back({(*outputs)[i].path, (*outputs)[i].bytes});
  sources.push_back({"other.ngc", "G21 G90\nG0 X0 Y0 Z-5\nM2\n"});
  Job checking;
  out.check_helped = helped(threads, checking, [&] {
    std::string told;
    const auto tell = [&](const FileFinding& f) { told += f.file + " " + f.finding.code + "\n"; };
    const auto result = check(request, sources, tell, checking);
    EXPECT_TRUE(result);
    EXPECT_GT(result->count, 0U);
    out.text += told + text_of(result->findings, checking);
  });
  return out;
}

TEST(Threads, FilesFindingsAndMessagesAreTheSameOnOneTwoAndEight) {
  const Made one = made_on(1);
  EXPECT_FALSE(one.files_helped || one.check_helped) << "one thread is the caller's own";
  for (const unsigned threads : {2U, 8U}) {
    const Made many = made_on(threads);
    EXPECT_TRUE(many.files_helped && many.check_helped) << threads;
    EXPECT_TRUE(many.text == one.text) << "on " << threads;
  }
}

}  // namespace
}  // namespace capstan::service
