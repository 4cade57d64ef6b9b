#include "planner/door/report/print.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <thread>

#include "tests/support/corpus.h"
#include "tests/support/processes/children.h"

namespace capstan::report {
namespace {

using ::testing::HasSubstr;

/// A program of the shell in the place of the browser, alone on PATH with what it needs; temporary files lie
/// beside it.
class Print : public ::testing::Test {
 protected:
  void SetUp() override {
    if (const char* path = std::getenv("PATH")) path_ = path;
    std::filesystem::create_directory(temporary());
    ::setenv("TMPDIR", temporary().c_str(), 1);
    ::setenv("PATH", folder_.path().c_str(), 1);
  }
  void TearDown() override {
    ::setenv("PATH", path_.c_str(), 1);
    ::unsetenv("TMPDIR");
    EXPECT_TRUE(std::filesystem::is_empty(temporary())) << "the browser's folder is gone";
    EXPECT_EQ(capstan::testing::children(), 0U);
  }
  [[nodiscard]] std::string temporary() const { return folder_.file("tmp"); }
  void browser(const std::string& text, const std::string& name = "chromium") const {
    const std::string file = folder_.file(name);
    std::ofstream(file) << "#!/bin/sh\nPATH=/usr/bin:/bin\nfor a in \"$@\"; do case \"$a\" in "
                           "--print-to-pdf=*) to=${a#*=};; file:*) from=${a#file://};; esac; done\n"
                        << text << "\n";
    ::chmod(file.c_str(), 0700);
  }
  capstan::testing::ScratchFolder folder_;
  std::string path_;
};

TEST_F(Print, GivesWhatTheBrowserWritesOfThePage) {
  browser("(printf '%%PDF-1.4\\n'; cat \"$from\") > \"$to\"");
  EXPECT_EQ(printed("<p>page</p>", Job()).value_or("none"), "%PDF-1.4\n<p>page</p>");
}

TEST_F(Print, TakesTheFirstBrowserOfPath) {
  browser("", "google-chrome");
  EXPECT_EQ(find_browser().value_or(""), folder_.file("google-chrome"));
  browser("", "chromium");
  EXPECT_EQ(find_browser().value_or(""), folder_.file("chromium"));
}

TEST_F(Print, WithoutABrowserSaysWhatToInstall) {
  const auto none = printed("page", Job());
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "OUT-BROWSER");
  EXPECT_THAT(none.error().hint, HasSubstr("apt install chromium"));
}

TEST_F(Print, ABrowserThatEndsWithoutPdfIsToldWithItsWords) {
  for (const char* text : {"echo no display >&2; exit 3", "echo no display >&2; exit 0",
                           "echo no display >&2; echo text > \"$to\""}) {
    browser(text);
    const auto none = printed("page", Job());
    ASSERT_FALSE(none) << text;
    EXPECT_EQ(none.error().code, "OUT-PRINT");
    EXPECT_THAT(none.error().message, HasSubstr("no display"));
  }
}

TEST_F(Print, IsStoppedWithItsJob) {
  browser("exec sleep 100");
  Job job;
  std::thread stop([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds{200});
    job.request_stop();
  });
  const auto none = printed("page", job);
  stop.join();
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().code, "APP-STOPPED");
}

TEST(Timeless, LeavesOutTheDatesAndMovesNothing) {
  const std::string pdf =
      "1 0 obj\n<</Title (a)\n/CreationDate (D:20260101120000+00'00')\n/ModDate "
      "(D:20260101120001+00'00')>>\nendobj\n";
  const std::string out = timeless(pdf);
  EXPECT_EQ(out.size(), pdf.size());
  EXPECT_EQ(out.find("2026"), std::string::npos);
  EXPECT_EQ(out.find("endobj"), pdf.find("endobj"));
  EXPECT_NE(out.find("/Title (a)"), std::string::npos);
  EXPECT_EQ(timeless("%PDF-1.4"), "%PDF-1.4");
}

}  // namespace
}  // namespace capstan::report
