#include "planner/ground/memo/memo.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <thread>

#include "planner/ground/memo/folder.h"
#include "planner/ground/memo/remembered.h"
#include "tests/support/scratch.h"

namespace capstan::memo {
namespace {

namespace fs = std::filesystem;

std::string new_folder(const std::string& name) {
  const std::string path = capstan::testing::scratch_file("memo_") + name;
  fs::remove_all(path);
  return path;
}

Key key(int i) { return key_of(Stage::kPath, i); }

template <class Make>
int asked(Memo* memo, int question, Make&& make) {
  return remembered<int>(memo, Stage::kPath, key(question), make, [](int) { return true; }).value();
}

std::string slurp(const fs::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

std::vector<fs::path> files_in(const std::string& folder) {
  std::vector<fs::path> out;
  for (const auto& e : fs::recursive_directory_iterator(folder))
    if (e.is_regular_file()) out.push_back(e.path());
  return out;
}

TEST(Memo, MakesAResultOnceForOneQuestion) {
  Memo memo;
  int made = 0;
  const auto ask = [&](int question) {
    return asked(&memo, question, [&] { return ++made, 10 * question; });
  };
  EXPECT_EQ(ask(1), 10);
  EXPECT_EQ(ask(1), 10);
  EXPECT_EQ(ask(2), 20);
  EXPECT_EQ(made, 2);
  EXPECT_EQ(memo.counts(Stage::kPath).found, 1U);
  EXPECT_EQ(memo.counts(Stage::kPath).made, 2U);
  EXPECT_EQ(memo.counts(Stage::kFeeds).made, 0U);
}

TEST(Memo, AFaultIsNotKept) {
  Memo memo;
  int made = 0;
  const auto fails = [&]() -> Result<int> { return ++made, fail("NO", "no"); };
  for (int i = 0; i < 2; ++i)
    EXPECT_FALSE(remembered<int>(&memo, Stage::kPath, key(1), fails, [](int) { return true; }));
  EXPECT_EQ(made, 2);
}

TEST(Memo, WhatIsNotSoundIsNeitherKeptNorTaken) {
  Memo memo;
  const auto even = [](int v) { return v % 2 == 0; };
  EXPECT_EQ(remembered<int>(
                &memo, Stage::kPath, key(1), [] { return 3; }, even),
            3);
  EXPECT_EQ(memo.counts(Stage::kPath).made, 0U);
  std::string odd;
  pack(odd, 5);
  memo.keep(Stage::kPath, key(1), odd);
  EXPECT_EQ(remembered<int>(
                &memo, Stage::kPath, key(1), [] { return 4; }, even),
            4);
}

TEST(Memo, WithoutAMemoEveryResultIsMade) {
  int made = 0;
  for (int i = 0; i < 2; ++i) EXPECT_EQ(asked(nullptr, 1, [&] { return ++made, 5; }), 5);
  EXPECT_EQ(made, 2);
}

TEST(Memo, LetsGoOfWhatWasNotUsedForLongest) {
  Memo memo(100);
  memo.keep(Stage::kPath, key(1), std::string(40, 'a'));
  memo.keep(Stage::kPath, key(2), std::string(40, 'b'));
  EXPECT_TRUE(memo.find(Stage::kPath, key(1)));
  memo.keep(Stage::kPath, key(3), std::string(40, 'c'));
  EXPECT_TRUE(memo.find(Stage::kPath, key(1)));
  EXPECT_FALSE(memo.find(Stage::kPath, key(2)));
  EXPECT_TRUE(memo.find(Stage::kPath, key(3)));
  EXPECT_LE(memo.bytes(), 100U);
  memo.keep(Stage::kPath, key(4), std::string(200, 'd'));  // larger than all of it
  EXPECT_FALSE(memo.find(Stage::kPath, key(4)));
  EXPECT_LE(memo.bytes(), 100U);
}

TEST(Memo, BytesThatAreNoValueAreMadeAnew) {
  Memo memo;
  memo.keep(Stage::kPath, key(1), "x");
  EXPECT_EQ(asked(&memo, 1, [] { return 3; }), 3);
  EXPECT_EQ(asked(&memo, 1, [] { return 4; }), 3);
}

TEST(Memo, ThreadsAskAndKeepAtOnce) {
  Memo memo(1000);
  std::vector<std::thread> threads;
  std::atomic<int> wrong{0};
  for (int t = 0; t < 8; ++t) {
    threads.emplace_back([&, t] {
      for (int i = 0; i < 2000; ++i) {
        const int question = (i * (t + 1)) % 50;
        if (asked(&memo, question, [&] { return question; }) != question) ++wrong;
      }
    });
  }
  for (auto& t : threads) t.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Folder, AnotherMemoFindsWhatOneKept) {
  const std::string folder = new_folder("kept");
  {
    auto memo = Memo::in_folder(folder);
    ASSERT_TRUE(memo) << to_text(memo.error());
    (*memo)->keep(Stage::kPath, key(1), "the result");
  }
  auto memo = Memo::in_folder(folder);
  ASSERT_TRUE(memo);
  const auto found = (*memo)->find(Stage::kPath, key(1));
  ASSERT_TRUE(found);
  EXPECT_EQ(*found, "the result");
  EXPECT_FALSE((*memo)->find(Stage::kPath, key(2)));
}

TEST(Folder, AFileThatIsDamagedAnywhereCountsAsNotThere) {
  const std::string folder = new_folder("damaged");
  {
    auto memo = Memo::in_folder(folder);
    (*memo)->keep(Stage::kPath, key(1), "the result");
  }
  const auto files = files_in(folder);
  ASSERT_EQ(files.size(), 1U);
  const std::string whole = slurp(files[0]);
  const auto found_with = [&](const std::string& bytes) {
    std::ofstream(files[0], std::ios::binary) << bytes;
    auto memo = Memo::in_folder(folder);
    return (*memo)->find(Stage::kPath, key(1)) != nullptr;
  };
  EXPECT_TRUE(found_with(whole));
  for (std::size_t i = 0; i < whole.size(); ++i) {
    for (const int bit : {0, 3, 7}) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(bytes[i] ^ (1 << bit));
      EXPECT_FALSE(found_with(bytes)) << "byte " << i << " bit " << bit;
    }
    EXPECT_FALSE(found_with(whole.substr(0, i))) << "cut off at " << i;
  }
  EXPECT_FALSE(found_with(whole + "x"));
  EXPECT_FALSE(found_with(""));
}

TEST(Folder, AFileUnderAnotherKeysNameCountsAsNotThere) {
  const std::string folder = new_folder("renamed");
  {
    auto memo = Memo::in_folder(folder);
    (*memo)->keep(Stage::kPath, key(1), "one");
    (*memo)->keep(Stage::kPath, key(2), "two");
  }
  const auto files = files_in(folder);
  ASSERT_EQ(files.size(), 2U);
  fs::copy_file(files[0], files[1], fs::copy_options::overwrite_existing);
  auto memo = Memo::in_folder(folder);
  int found = 0;
  for (const int i : {1, 2}) found += (*memo)->find(Stage::kPath, key(i)) != nullptr ? 1 : 0;
  EXPECT_EQ(found, 1);
}

TEST(Folder, ProcessesThatWriteAtOnceLeaveWholeFiles) {
  const std::string folder = new_folder("shared");
  std::vector<pid_t> children;
  for (int p = 0; p < 4; ++p) {
    const pid_t child = ::fork();
    if (child == 0) {
      {
        auto memo = Memo::in_folder(folder, 1);  // nothing stays in memory
        for (int i = 0; memo && i < 200; ++i) {
          const std::string want(static_cast<std::size_t>(1000 + i), static_cast<char>('a' + i % 26));
          if (const auto found = (*memo)->find(Stage::kPath, key(i)); found && *found != want) ::_exit(1);
          (*memo)->keep(Stage::kPath, key(i), want);
        }
      }
      ::_exit(0);
    }
    children.push_back(child);
  }
  for (const pid_t child : children) {
    int status = 0;
    ::waitpid(child, &status, 0);
    EXPECT_EQ(status, 0);
  }
  auto memo = Memo::in_folder(folder, 1);
  for (int i = 0; i < 200; ++i) {
    const auto found = (*memo)->find(Stage::kPath, key(i));
    ASSERT_TRUE(found) << i;
    EXPECT_EQ(found->size(), static_cast<std::size_t>(1000 + i));
  }
  for (const auto& f : files_in(folder)) EXPECT_EQ(f.extension(), "") << "nothing half written stays";
}

TEST(Folder, KeepsToItsBound) {
  const std::string folder = new_folder("bounded");
  for (int round = 0; round < 3; ++round) {
    auto memo = Memo::in_folder(folder, 1 << 20, 20000);
    for (int i = 0; i < 20; ++i) (*memo)->keep(Stage::kPath, key(100 * round + i), std::string(1000, 'x'));
    // As if each round were a day: files may be written within one tick of the clock.
    for (const auto& f : files_in(folder))
      fs::last_write_time(f, fs::last_write_time(f) - std::chrono::hours(24));
  }
  std::uintmax_t sum = 0;
  for (const auto& f : files_in(folder)) sum += fs::file_size(f);
  EXPECT_LE(sum, 20000U);
  auto memo = Memo::in_folder(folder);
  int newest = 0;
  for (int i = 0; i < 20; ++i) newest += (*memo)->find(Stage::kPath, key(200 + i)) != nullptr ? 1 : 0;
  EXPECT_GE(newest, 15) << "the oldest went first";
}

TEST(Folder, FilesOfOthersInItStay) {
  const std::string folder = new_folder("others");
  fs::create_directories(folder + "/photos");
  fs::permissions(folder, fs::perms::owner_all);
  std::ofstream(folder + "/photos/abcdef0123456789abcdef012345678") << std::string(5000, 'p');
  std::ofstream(folder + "/letter.txt") << std::string(5000, 'l');
  for (int round = 0; round < 2; ++round) {
    auto memo = Memo::in_folder(folder, 1 << 20, 3000);
    ASSERT_TRUE(memo) << to_text(memo.error());
    for (int i = 0; i < 20; ++i) (*memo)->keep(Stage::kPath, key(100 * round + i), std::string(1000, 'x'));
  }
  EXPECT_EQ(fs::file_size(folder + "/letter.txt"), 5000U);
  EXPECT_EQ(fs::file_size(folder + "/photos/abcdef0123456789abcdef012345678"), 5000U);
}

TEST(Folder, KeepsToItsBoundBesideAFolderThatMayNotBeRead) {
  const std::string folder = new_folder("locked");
  fs::create_directories(folder + "/lost+found");
  fs::permissions(folder, fs::perms::owner_all);
  fs::permissions(folder + "/lost+found", fs::perms::none);
  for (int round = 0; round < 2; ++round) {
    auto memo = Memo::in_folder(folder, 1 << 20, 3000);
    for (int i = 0; i < 20; ++i) (*memo)->keep(Stage::kPath, key(100 * round + i), std::string(1000, 'x'));
  }
  fs::permissions(folder + "/lost+found", fs::perms::owner_all);
  std::uintmax_t sum = 0;
  for (const auto& f : files_in(folder)) sum += fs::file_size(f);
  EXPECT_LE(sum, 3000U);
}

TEST(Folder, LetsNobodyElseWriteWhateverTheMaskOfThisProcess) {
  const std::string folder = new_folder("mask");
  const mode_t before = ::umask(0);
  {
    auto memo = Memo::in_folder(folder);
    (*memo)->keep(Stage::kPath, key(1), "x");
  }
  ::umask(before);
  int seen = 0;
  for (const auto& e : fs::recursive_directory_iterator(folder)) {
    EXPECT_EQ(e.status().permissions() & (fs::perms::group_write | fs::perms::others_write), fs::perms::none)
        << e.path();
    ++seen;
  }
  EXPECT_EQ(seen, 3) << "a folder of the build, one of 256, the file";
}

TEST(Folder, WithAFolderOfTheBuildThatLeadsElsewhereIsRefused) {
  const std::string folder = new_folder("link"), elsewhere = new_folder("elsewhere");
  {
    auto memo = Memo::in_folder(folder);
    ASSERT_TRUE(memo);
  }
  fs::path build;
  for (const auto& e : fs::directory_iterator(folder)) build = e.path();
  ASSERT_FALSE(build.empty());
  fs::create_directories(elsewhere);
  fs::remove_all(build);
  fs::create_directory_symlink(elsewhere, build);
  EXPECT_FALSE(Memo::in_folder(folder));
}

TEST(Folder, ThatOthersMayWriteIsRefused) {
  const std::string folder = new_folder("open");
  fs::create_directories(folder);
  fs::permissions(folder, fs::perms::all);
  const auto memo = Memo::in_folder(folder);
  ASSERT_FALSE(memo);
  EXPECT_EQ(memo.error().code, "MEM-FOLDER");
  EXPECT_NE(memo.error().message.find("others may write it"), std::string::npos) << memo.error().message;
}

TEST(Folder, WhereNoneCanBeMadeIsRefused) {
  const std::string file = new_folder("file");
  std::ofstream(file) << "not a folder";
  const auto memo = Memo::in_folder(file + "/below");
  ASSERT_FALSE(memo);
  EXPECT_EQ(memo.error().code, "MEM-FOLDER");
  EXPECT_EQ(memo.error().file, file + "/below");
}

TEST(Folder, ThatVanishesFailsNothing) {
  const std::string folder = new_folder("gone");
  auto memo = Memo::in_folder(folder, 0);
  ASSERT_TRUE(memo);
  fs::remove_all(folder);
  std::ofstream(folder) << "a file in its place";
  (*memo)->keep(Stage::kPath, key(1), "x");
  EXPECT_FALSE((*memo)->find(Stage::kPath, key(1)));
}

TEST(Folder, KnowsItsBuild) { EXPECT_GE(build_identity().size(), 16U); }

}  // namespace
}  // namespace capstan::memo
