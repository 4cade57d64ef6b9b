#include <gtest/gtest.h>

#include <chrono>
#include <string>

#include "planner/door/service/check.h"
#include "planner/door/service/planning.h"
#include "tests/support/corpus.h"
#include "tests/support/witness.h"

// What the command does with a part (plan it, make all files, check their program; check the files again)
// gives the same bytes, findings and messages in the same order on any number of threads.

namespace capstan::service {
namespace {

const std::string kSource = capstan::testing::source_dir();

/// Runs `work` with a job of so many threads; true if others than the caller's did some of it.
template <class Work>
bool helped(unsigned threads, Job& job, Work work) {
  testing::Witness witness(threads > 1);
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
