#include "planner/door/transport/serve/wire/socket_file.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/support/corpus.h"

namespace capstan::transport {
namespace {

namespace fs = std::filesystem;

/// What a server leaves that was killed: a socket that nobody listens at.
void leave_dead_socket(const std::string& path) {
  const int fd = ::socket(AF_UNIX, SOCK_STREAM, 0);
  sockaddr_un address = {};
  address.sun_family = AF_UNIX;
  std::memcpy(address.sun_path, path.c_str(), path.size());
  ASSERT_EQ(::bind(fd, reinterpret_cast<const sockaddr*>(&address), sizeof(address)), 0);
  ::close(fd);
  ASSERT_TRUE(fs::exists(path));
}

TEST(SocketFile, IsForItsUserAloneAndGoneAfterwards) {
  const testing::ScratchFolder folder;
  const std::string path = folder.file("s");
  {
    const auto made = SocketFile::listen(path, false);
    ASSERT_TRUE(made) << to_text(made.error());
    struct stat there = {};
    ASSERT_EQ(::stat(path.c_str(), &there), 0);
    EXPECT_EQ(there.st_mode & 0777U, 0600U);
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(SocketFile, OfADeadServerIsTakenOver) {
  const testing::ScratchFolder folder;
  const std::string path = folder.file("s");
  leave_dead_socket(path);
  EXPECT_TRUE(SocketFile::listen(path, false));
}

TEST(SocketFile, OfALivingServerStays) {
  const testing::ScratchFolder folder;
  const std::string path = folder.file("s");
  const auto first = SocketFile::listen(path, false);
  ASSERT_TRUE(first);
  const auto second = SocketFile::listen(path, false);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().code, "SERVE-SOCKET");
  EXPECT_TRUE(fs::exists(path));
  // Nor that of a program that knows of no lock.
  fs::remove(path + ".lock");
  EXPECT_FALSE(SocketFile::listen(path, false));
  EXPECT_TRUE(fs::exists(path));
}

TEST(SocketFile, NeverReplacesAFileThatIsNoSocket) {
  const testing::ScratchFolder folder;
  const std::string path = folder.file("plan.p21");
  std::ofstream(path) << "mine";
  const auto made = SocketFile::listen(path, false);
  ASSERT_FALSE(made);
  EXPECT_NE(made.error().message.find("no socket is there"), std::string::npos);
  EXPECT_EQ(testing::slurp(path), "mine");
}

TEST(SocketFile, RefusesAPathThatNoSocketCanHave) {
  EXPECT_FALSE(SocketFile::listen("", false));
  EXPECT_FALSE(SocketFile::listen("/tmp/" + std::string(200, 'x'), false));
  EXPECT_FALSE(SocketFile::listen("/no such folder/s", false));
}

}  // namespace
}  // namespace capstan::transport
