#include "planner/ground/base/file.h"

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "tests/support/corpus.h"

namespace capstan {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

class File : public ::testing::Test {
 protected:
  [[nodiscard]] std::string at(const std::string& name) const { return (folder_ / name).string(); }
  [[nodiscard]] std::size_t count() const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), fs::directory_iterator{}));
  }
  [[nodiscard]] std::string text(const std::string& name) const {
    return read_file(at(name)).value_or("(unreadable)");
  }

 private:
  ::capstan::testing::ScratchFolder scratch_;
  fs::path folder_ = scratch_.path();
};

TEST_F(File, IsReplacedWhole) {
  ASSERT_TRUE(write_file(at("a"), "long before"));
  ASSERT_TRUE(write_file(at("a"), "now"));
  EXPECT_EQ(text("a"), "now");
  EXPECT_EQ(count(), 1U);
}

TEST_F(File, StagedButNotPutLeavesNothing) {
  {
    const auto staged = StagedFile::make(at("a"), "never seen");
    ASSERT_TRUE(staged);
    EXPECT_FALSE(fs::exists(at("a")));
  }
  EXPECT_EQ(count(), 0U);
}

TEST_F(File, StagedByAProcessThatIsKilledLeavesNothing) {
  const pid_t child = ::fork();
  ASSERT_GE(child, 0);
  if (child == 0) {
    const auto staged = StagedFile::make(at("a"), "never seen");
    (void)std::raise(SIGKILL);
  }
  int status = 0;
  ASSERT_EQ(::waitpid(child, &status, 0), child);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(count(), 0U);
}

TEST_F(File, ThatALinkLeadsToIsReplacedAndNotTheLink) {
  ASSERT_TRUE(write_file(at("real"), "before"));
  fs::create_symlink("real", at("link"));
  ASSERT_TRUE(write_file(at("link"), "after"));
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(text("real"), "after");
}

TEST_F(File, ThatALinkLeadsToNeedNotBeThereYet) {
  fs::create_symlink("real", at("link"));
  ASSERT_TRUE(write_file(at("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(text("real"), "new");
}

TEST_F(File, IsNotWrittenInPlaceOfAPipeAFolderOrALinkToItself) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_directory(at("folder"));
  fs::create_symlink("link", at("link"));
  for (const char* name : {"pipe", "folder", "link"}) {
    const auto ok = write_file(at(name), "x");
    ASSERT_FALSE(ok) << name;
    EXPECT_EQ(ok.error().code, "FILE-WRITE");
    EXPECT_EQ(ok.error().file, at(name));
  }
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
  EXPECT_EQ(count(), 3U);
}

TEST_F(File, IsNotReadFromANamedPipeThatNobodyWrites) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  fs::create_symlink("pipe", at("link"));
  for (const char* name : {"pipe", "link"}) {
    const auto bytes = read_file(at(name));
    ASSERT_FALSE(bytes) << name;
    EXPECT_EQ(bytes.error().code, "FILE-READ");
    EXPECT_EQ(bytes.error().expected, "a regular file");
  }
}

TEST_F(File, IsReadFromAPipeOfTheShell) {
  int ends[2];
  ASSERT_EQ(::pipe(ends), 0);
  ASSERT_EQ(::write(ends[1], "text", 4), 4);
  ::close(ends[1]);
  const auto bytes = read_file("/dev/fd/" + std::to_string(ends[0]));
  ::close(ends[0]);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, "text");
}

TEST_F(File, IsReadFromANamedPipeThatTheShellOpened) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  const int both = ::open(at("pipe").c_str(), O_RDWR);  // neither end waits for the other
  const int read_end = ::open(at("pipe").c_str(), O_RDONLY | O_NONBLOCK);
  ASSERT_EQ(::write(both, "text", 4), 4);
  ::close(both);
  const auto bytes = read_file("/dev/fd/" + std::to_string(read_end));
  ::close(read_end);
  ASSERT_TRUE(bytes) << bytes.error().message;
  EXPECT_EQ(*bytes, "text");
}

TEST_F(File, IsWritableOnlyWhereItsFolderIs) {
  EXPECT_TRUE(writable(at("new")));
  EXPECT_FALSE(writable(at("no such folder/new")));
  EXPECT_FALSE(writable("/proc/capstan"));  // no file can be made there, whoever asks
  EXPECT_EQ(count(), 0U);
}

}  // namespace
}  // namespace capstan
