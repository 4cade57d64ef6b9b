#pragma once

#include <arpa/inet.h>
#include <fcntl.h>
#include <pwd.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <initializer_list>
#include <iterator>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/casebase/sample.h"

namespace capstan::casebase {

/// A server of PostgreSQL of its own: a private folder and a socket in it. Where the tests run as root, who
/// must not run a server, it runs as `postgres` or `nobody`.
class PostgresServer {
 public:
  /// How the tests reach it: by the socket, without a password, and it has no port; or by TCP on 127.0.0.1,
  /// at a port that nobody had, with a password.
  enum class Way { kSocket, kTcp };
  static constexpr const char* kPassword = "loopback";

  /// Null where no server is installed.
  static std::unique_ptr<PostgresServer> make(Way way) {
    const std::string programs = programs_folder();
    if (programs.empty()) return nullptr;
    auto server = std::unique_ptr<PostgresServer>(new PostgresServer(programs, way));
    const std::string by_host = way == Way::kTcp ? "scram-sha-256" : "reject";
    if (!server->run({programs + "/initdb", "-D", server->data(), "--auth-local=trust",
                      "--auth-host=" + by_host, "-U", "shop", "-N"}) ||
        !server->start())
      return nullptr;
    if (way == Way::kTcp)
      server->sql("postgres", "ALTER ROLE shop PASSWORD '" + std::string(kPassword) + "'");
    return server;
  }
  ~PostgresServer() { stop(SIGINT); }
  PostgresServer(const PostgresServer&) = delete;
  PostgresServer& operator=(const PostgresServer&) = delete;

  /// The URI of a database; `more` behind the user, such as ":password"; where there is nothing, what lets
  /// in.
  [[nodiscard]] std::string uri(const std::string& database, const std::string& more = "") const {
    if (way_ == Way::kSocket)
      return "postgresql://shop" + more + "@/" + database + "?host=" + folder_.path().string();
    return "postgresql://shop" + (more.empty() ? ":" + std::string(kPassword) : more) +
           "@127.0.0.1:" + std::to_string(port_) + "/" + database;
  }
  /// Runs a statement as psql does; what it prints.
  std::string sql(const std::string& database, const std::string& statement) const {
    const std::string out = folder_.file("out");
    EXPECT_TRUE(run(
        {programs_ + "/psql", "-X", "-q", "-A", "-t", "-v", "ON_ERROR_STOP=1", "-h", folder_.path().string(),
         "-p", std::to_string(port_), "-U", "shop", "-d", database, "-c", statement},
        out))
        << statement;
    std::ifstream in(out);
    std::string text((std::istreambuf_iterator<char>(in)), {});
    while (!text.empty() && text.back() == '\n') text.pop_back();
    return text;
  }
  bool start() {
    for (int i = 0; i < kTurns; ++i) {
      // One that was killed leaves workers for a moment, and no other starts until they are gone.
      if (server_ <= 0 || waitpid(server_, nullptr, WNOHANG) == server_) {
        // Another program may have taken the port meanwhile: until it was reached once, the next one is asked
        // for.
        if (way_ == Way::kTcp && !reached_) port_ = free_port();
        server_ =
            launch({programs_ + "/postgres", "-D", data(), "-k", folder_.path().string(), "-c",
                    std::string("listen_addresses=") + (way_ == Way::kTcp ? "127.0.0.1" : ""), "-c",
                    "port=" + std::to_string(port_), "-c", "shared_buffers=8MB", "-c", "max_connections=40"},
                   folder_.file("log"));
      }
      if (run({programs_ + "/pg_isready", "-q", "-h", folder_.path().string(), "-p", std::to_string(port_)}))
        return reached_ = true;
      usleep(20'000);
    }
    return false;
  }
  /// SIGINT: it ends its connections and writes everything; SIGKILL: its workers end when they find it gone,
  /// and until then serve who is connected. Returns when they, too, have ended.
  void stop(int signal) {
    if (server_ <= 0) return;
    const std::vector<pid_t> workers = workers_of(server_);
    kill(server_, signal);
    waitpid(server_, nullptr, 0);
    server_ = 0;
    for (const pid_t worker : workers)
      for (int turn = 0; turn < kTurns && runs(worker); ++turn) usleep(20'000);
  }
  [[nodiscard]] std::string data() const { return folder_.file("data"); }

 private:
  static constexpr int kTurns = 3000;  // of 20 ms: a machine may be busy
  PostgresServer(std::string programs, Way way) : programs_(std::move(programs)), way_(way) {
    if (geteuid() == 0) {
      user_ = getpwnam("postgres");
      if (user_ == nullptr) user_ = getpwnam("nobody");
      if (user_ != nullptr) {
        EXPECT_EQ(chown(folder_.path().c_str(), user_->pw_uid, user_->pw_gid), 0);
      }
    }
    std::filesystem::permissions(folder_.path(), std::filesystem::perms::all);
  }

  /// Whether a process does anything yet: one that ended has no command line, also while nobody has asked for
  /// its end.
  static bool runs(pid_t process) {
    return std::ifstream("/proc/" + std::to_string(process) + "/cmdline").peek() != EOF;
  }
  static std::vector<pid_t> workers_of(pid_t server) {
    const std::string of = std::to_string(server);
    std::ifstream in("/proc/" + of + "/task/" + of + "/children");
    return {std::istream_iterator<pid_t>(in), {}};
  }
  /// A port of 127.0.0.1 that nobody has.
  static int free_port() {
    const int fd = socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in at{};
    at.sin_family = AF_INET;
    at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    socklen_t size = sizeof(at);
    auto* const address = reinterpret_cast<sockaddr*>(&at);
    const bool bound = bind(fd, address, size) == 0 && getsockname(fd, address, &size) == 0;
    EXPECT_TRUE(bound);
    close(fd);
    return ntohs(at.sin_port);
  }
  static std::string programs_folder() {
    std::vector<std::string> found;
    std::error_code none;
    for (const auto& version : std::filesystem::directory_iterator("/usr/lib/postgresql", none)) {
      if (std::filesystem::exists(version.path() / "bin/postgres", none))
        found.push_back((version.path() / "bin").string());
    }
    return found.empty() ? "" : *std::max_element(found.begin(), found.end());
  }

  pid_t launch(const std::vector<std::string>& words, const std::string& out) const {
    std::vector<char*> arguments;
    for (const std::string& w : words) arguments.push_back(const_cast<char*>(w.c_str()));
    arguments.push_back(nullptr);
    const pid_t child = fork();
    if (child != 0) return child;
    const int to = open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
    if (to < 0 || chdir(folder_.path().c_str()) != 0) _exit(126);
    dup2(to, 1);
    if (user_ != nullptr && (setgid(user_->pw_gid) != 0 || setuid(user_->pw_uid) != 0)) _exit(126);
    const int errors = open("errors", O_WRONLY | O_CREAT | O_APPEND, 0666);
    if (errors >= 0) dup2(errors, 2);
    prctl(PR_SET_PDEATHSIG, SIGQUIT);  // it ends with the tests, however they end
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  bool run(const std::vector<std::string>& words, const std::string& out = "/dev/null") const {
    const pid_t child = launch(words, out);
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) && WEXITSTATUS(status) == 0;
  }

  Folder folder_;
  std::string programs_;
  const Way way_;
  int port_ = 5432;  // the name of the socket, too
  bool reached_ = false;
  const passwd* user_ = nullptr;
  pid_t server_ = 0;
};

/// A server with databases of its own, and a private folder for the files beside; the tests of one program
/// share the server.
class PostgresPlace {
 public:
  /// Null where there is no server, or the program was built without PostgreSQL.
  static std::unique_ptr<PostgresPlace> make(PostgresServer::Way way = PostgresServer::Way::kSocket) {
    using Way = PostgresServer::Way;
    static std::map<Way, std::unique_ptr<PostgresServer>> servers;  // of the program
    if (!servers.contains(way)) servers[way] = PostgresServer::make(way);
    if (!servers[way]) return nullptr;
    auto place = std::unique_ptr<PostgresPlace>(new PostgresPlace(*servers[way]));
    Job job;
    const auto base = CaseBase::open(place->uri(), job);
    const bool built_without = !base && base.error().code == "CASE-URI";
    return built_without ? nullptr : std::move(place);
  }
  ~PostgresPlace() { unsetenv("CAPSTAN_CASES"); }
  PostgresPlace(const PostgresPlace&) = delete;
  PostgresPlace& operator=(const PostgresPlace&) = delete;

  [[nodiscard]] std::string uri(const std::string& more = "") const { return server_.uri(database_, more); }
  std::string sql(const std::string& statement) const { return server_.sql(database_, statement); }
  [[nodiscard]] PostgresServer& server() const { return server_; }
  [[nodiscard]] const Folder& beside() const { return beside_; }

 private:
  explicit PostgresPlace(PostgresServer& server) : server_(server) {
    static int made = 0;
    database_ = "cases" + std::to_string(++made);
    server_.sql("postgres", "CREATE DATABASE " + database_);
    setenv("CAPSTAN_CASES", beside_.path().c_str(), 1);
  }
  PostgresServer& server_;
  std::string database_;
  Folder beside_;
};

}  // namespace capstan::casebase
