#include "planner/door/transport/serve/wire/tls.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "planner/door/transport/serve/wire/http.h"

#if __has_include(<openssl/ssl.h>)
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509v3.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdio>
#include <fstream>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "tests/door/transport/serve/running_server.h"

// A server over TCP and its clients, with certificates that the test makes: who has none that is valid is
// refused before a byte of a request is read, and the others are served on.

namespace capstan::transport {
namespace {

using std::chrono::milliseconds;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr long kDay = 86400;

/// A certificate with its key, in files.
struct Identity {
  X509* certificate = nullptr;
  EVP_PKEY* key = nullptr;
  std::string certificate_file, key_file;
};

class Certificates {
 public:
  Certificates() = default;
  Certificates(const Certificates&) = delete;
  Certificates& operator=(const Certificates&) = delete;
  ~Certificates() {
    for (const auto& one : all_) {
      X509_free(one->certificate);
      EVP_PKEY_free(one->key);
    }
  }
  struct How {
    const Identity* issuer = nullptr;  ///< null: itself
    bool is_ca = false;
    const char* use = "clientAuth";
    long from_s = -kDay, to_s = kDay;  ///< from now
  };
  const Identity& make(const std::string& name, const How& how) {
    auto& out = *all_.emplace_back(std::make_unique<Identity>());
    out.key = EVP_EC_gen("P-256");
    X509* c = out.certificate = X509_new();
    X509_set_version(c, 2);
    ASN1_INTEGER_set(X509_get_serialNumber(c), ++serial_);
    X509_gmtime_adj(X509_getm_notBefore(c), how.from_s);
    X509_gmtime_adj(X509_getm_notAfter(c), how.to_s);
    X509_set_pubkey(c, out.key);
    X509_NAME* subject = X509_get_subject_name(c);
    const auto add = [&](const char* field, const std::string& value) {
      X509_NAME_add_entry_by_txt(subject, field, MBSTRING_UTF8,
                                 reinterpret_cast<const unsigned char*>(value.c_str()), -1, -1, 0);
    };
    add("O", "Works");
    add("CN", name);
    const Identity& issuer = how.issuer == nullptr ? out : *how.issuer;
    X509_set_issuer_name(c, X509_get_subject_name(issuer.certificate));
    const auto extend = [&](int nid, const char* value) {
      X509V3_CTX context;
      X509V3_set_ctx(&context, issuer.certificate, c, nullptr, nullptr, 0);
      X509_EXTENSION* e = X509V3_EXT_conf_nid(nullptr, &context, nid, value);
      X509_add_ext(c, e, -1);
      X509_EXTENSION_free(e);
    };
    extend(NID_basic_constraints, how.is_ca ? "critical,CA:TRUE" : "CA:FALSE");
    if (how.is_ca) {
      extend(NID_key_usage, "critical,keyCertSign");
    } else {
      extend(NID_ext_key_usage, how.use);
    }
    X509_sign(c, issuer.key, EVP_sha256());
    const std::string at = folder_.file("of_" + std::to_string(serial_));
    out.certificate_file = at + ".pem";
    out.key_file = at + ".key";
    write(out.certificate_file, [&](FILE* f) { PEM_write_X509(f, c); });
    write(out.key_file,
          [&](FILE* f) { PEM_write_PrivateKey(f, out.key, nullptr, nullptr, 0, nullptr, nullptr); });
    ::chmod(out.key_file.c_str(), 0600);
    return out;
  }
  [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }

 private:
  template <class Body>
  static void write(const std::string& path, const Body& body) {
    FILE* f = std::fopen(path.c_str(), "w");
    ASSERT_NE(f, nullptr);
    body(f);
    std::fclose(f);
  }
  testing::ScratchFolder folder_;
  std::vector<std::unique_ptr<Identity>> all_;
  long serial_ = 0;
};

/// A client of OpenSSL's own; `who`: null: without a certificate.
class TlsClient {
 public:
  TlsClient(const std::string& address, const Identity& ca, const Identity* who, int only_version = 0)
      : context_(SSL_CTX_new(TLS_client_method())), fd_(Client::connected_to(address)) {
    SSL_CTX_load_verify_file(context_, ca.certificate_file.c_str());
    SSL_CTX_set_verify(context_, SSL_VERIFY_PEER, nullptr);
    if (who != nullptr) {
      SSL_CTX_use_certificate(context_, who->certificate);
      SSL_CTX_use_PrivateKey(context_, who->key);
    }
    if (only_version != 0) {
      SSL_CTX_set_security_level(context_, 0);
      SSL_CTX_set_min_proto_version(context_, only_version);
      SSL_CTX_set_max_proto_version(context_, only_version);
    }
    ssl_ = SSL_new(context_);
    SSL_set_fd(ssl_, fd_);
    met_ = SSL_connect(ssl_) == 1;
    ERR_clear_error();
  }
  TlsClient(const TlsClient&) = delete;
  TlsClient& operator=(const TlsClient&) = delete;
  ~TlsClient() {
    leave();
    SSL_free(ssl_);
    SSL_CTX_free(context_);
  }
  void leave() {
    if (fd_ >= 0) ::close(fd_);
    fd_ = -1;
  }
  bool send(const std::string& bytes) {
    const bool sent = met_ && SSL_write(ssl_, bytes.data(), static_cast<int>(bytes.size())) > 0;
    ERR_clear_error();
    return sent;
  }
  /// Says by TLS that no more comes.
  void send_no_more() { (void)SSL_shutdown(ssl_); }
  struct Reply {
    int status = 0;  ///< 0: none came
    std::string body;
    [[nodiscard]] nlohmann::json json() const { return nlohmann::json::parse(body, nullptr, false); }
  };
  Reply reply() {
    std::size_t end = 0, size = 0;
    while ((end = came_.find("\r\n\r\n")) == std::string::npos)
      if (!more()) return {};
    if (const auto at = came_.find("Content-Length: "); at < end) size = std::stoul(came_.substr(at + 16));
    while (came_.size() < end + 4 + size)
      if (!more()) return {};
    Reply out{std::stoi(came_.substr(9, 3)), came_.substr(end + 4, size)};
    came_.erase(0, end + 4 + size);
    return out;
  }
  Reply ask(const std::string& method, const std::string& path, const std::string& body = {}) {
    if (!send(method + " " + path + " HTTP/1.1\r\nContent-Length: " + std::to_string(body.size()) +
              "\r\n\r\n" + body))
      return {};
    return reply();
  }

 private:
  bool more() {
    std::array<char, 65536> bytes;
    const int n = met_ ? SSL_read(ssl_, bytes.data(), static_cast<int>(bytes.size())) : 0;
    ERR_clear_error();
    if (n <= 0) return false;
    came_.append(bytes.data(), static_cast<std::size_t>(n));
    return true;
  }
  SSL_CTX* context_;
  int fd_;
  SSL* ssl_ = nullptr;
  bool met_ = false;
  std::string came_;
};

class Tls : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!http_is_built() || !tls_is_built()) GTEST_SKIP() << "no Boost.Beast, or no OpenSSL";
  }
  [[nodiscard]] ServeSettings settings(const Limits& limits = {}, const std::string& socket = {}) {
    ServeSettings out;
    out.socket = socket;
    out.tcp = "127.0.0.1:0";
    out.tls = files();
    out.limits = limits;
    out.log = [this](const std::string& line) {
      const std::lock_guard lock(mutex_);
      lines_.push_back(line.substr(line.find(" is ") + 1));
      return true;
    };
    return out;
  }
  /// What the server's log told, without addresses.
  [[nodiscard]] std::vector<std::string> lines() const {
    const std::lock_guard lock(mutex_);
    return lines_;
  }
  [[nodiscard]] TlsFiles files() const { return {own.certificate_file, own.key_file, ca.certificate_file}; }
  [[nodiscard]] TlsClient::Reply ask(const RunningServer& server, const Identity* who,
                                     const std::string& method, const std::string& path,
                                     const std::string& body = {}, int only_version = 0) const {
    return TlsClient(server.tcp(), ca, who, only_version).ask(method, path, body);
  }
  [[nodiscard]] bool answers(const RunningServer& server) const {
    return ask(server, &mill, "GET", "/health").status == 200;
  }
  /// What a counter of the metrics stands at; -1: it is not there.
  [[nodiscard]] int counted(const RunningServer& server, const std::string& name) const {
    const std::string text = ask(server, &mill, "GET", "/metrics").body;
    const auto at = text.find("\n" + name + " ");
    return at == std::string::npos ? -1 : std::stoi(text.substr(at + name.size() + 2));
  }
  [[nodiscard]] int refused(const RunningServer& server, const std::string& reason) const {
    return counted(server, "capstan_refused_total{reason=\"" + reason + "\"}");
  }

  Certificates made;
  const Identity& ca = made.make("the CA", {.is_ca = true});
  const Identity& own = made.make("server", {.issuer = &ca, .use = "serverAuth"});
  const Identity& mill = made.make("mill \"3\"", {.issuer = &ca});
  const Identity& other = made.make("mill 4", {.issuer = &ca});

 private:
  mutable std::mutex mutex_;
  std::vector<std::string> lines_;
};

TEST_F(Tls, AClientWithACertificateIsServedInTls12AndTls13) {
  const RunningServer server(settings());
  EXPECT_EQ(ask(server, &mill, "GET", "/health", {}, TLS1_2_VERSION).status, 200);
  EXPECT_EQ(ask(server, &mill, "GET", "/health", {}, TLS1_3_VERSION).status, 200);
  EXPECT_EQ(ask(server, &mill, "GET", "/health", {}, TLS1_1_VERSION).status, 0);
  EXPECT_EQ(refused(server, "tls-protocol"), 1);
}

TEST_F(Tls, APeerIsTheSubjectOfItsCertificateInLogMetricsAndSessions) {
  const RunningServer server(settings());
  TlsClient client(server.tcp(), ca, &mill);
  const nlohmann::json state = {{"options", {{"machine", "generic_vmc"}}},
                                {"tool_table", testing::slurp(magazine_file())}};
  const auto opened = client.ask("POST", "/v1/sessions", state.dump());
  ASSERT_EQ(opened.status, 201) << opened.body;
  const std::string path = "/v1/sessions/" + opened.json()["session"].get<std::string>();
  EXPECT_EQ(client.ask("PUT", path + "/plan", plate()).status, 200);
  EXPECT_EQ(client.ask("POST", path + "/bind", R"({"deadline_ms": 600000})").status, 200);
  EXPECT_THAT(client.ask("GET", path + "/output/linuxcnc").body, HasSubstr("\nM2"));
  EXPECT_EQ(ask(server, &other, "GET", path + "/result").status, 404);
  EXPECT_EQ(ask(server, &mill, "GET", path + "/result").status, 200);
  EXPECT_EQ(ask(server, &mill, "POST", "/v1/sessions", R"({"options": {"tools": "/etc/passwd"}})").status,
            403);
  EXPECT_EQ(ask(server, &mill, "POST", "/v1/sessions", R"({"broadcast": {"file": "/var/x"}})").status, 403);
  EXPECT_THAT(lines(), Contains(R"(is 'CN=mill \"3\",O=Works')"));
  EXPECT_EQ(counted(server, R"(capstan_peer_requests_total{peer="CN=mill 4,O=Works"})"), 1);
  EXPECT_EQ(counted(server, R"(capstan_peer_requests_total{peer="CN=mill \\\"3\\\",O=Works"})"), 9);
}

TEST_F(Tls, TheSameSubjectOfAnotherSignerIsAnotherPeer) {
  const Identity& second_ca = made.make("the second CA", {.is_ca = true});
  const Identity& namesake = made.make("mill \"3\"", {.issuer = &second_ca});
  ServeSettings both = settings();
  both.tls.client_ca = made.file("both");
  std::ofstream(both.tls.client_ca) << testing::slurp(ca.certificate_file)
                                    << testing::slurp(second_ca.certificate_file);
  const RunningServer server(both);
  const auto opened = ask(server, &mill, "POST", "/v1/sessions", "{}");
  ASSERT_EQ(opened.status, 201) << opened.body;
  const std::string path = "/v1/sessions/" + opened.json()["session"].get<std::string>() + "/result";
  EXPECT_EQ(ask(server, &mill, "GET", path).status, 200);
  EXPECT_EQ(ask(server, &namesake, "GET", path).status, 404);
  EXPECT_EQ(ask(server, &namesake, "GET", "/v1/sessions").json()["sessions"], nlohmann::json::array());
  EXPECT_EQ(ask(server, &mill, "GET", path).status, 200);
  // Both are shown by their subject: five requests, and that of the metrics.
  EXPECT_EQ(counted(server, R"(capstan_peer_requests_total{peer="CN=mill \\\"3\\\",O=Works"})"), 6);
}

TEST_F(Tls, AClientWithoutAValidCertificateIsRefusedBeforeItsRequestIsRead) {
  const RunningServer server(settings());
  const Identity& stranger_ca = made.make("another CA", {.is_ca = true});
  const Identity& foreign = made.make("mill 3", {.issuer = &stranger_ca});
  const Identity& same_name = made.make("the CA", {.is_ca = true});
  const Identity& pretender = made.make("mill 3", {.issuer = &same_name});
  const Identity& own_word = made.make("mill 3", {});
  const Identity& expired = made.make("mill 3", {.issuer = &ca, .from_s = -3 * kDay, .to_s = -kDay});
  const Identity& early = made.make("mill 3", {.issuer = &ca, .from_s = kDay, .to_s = 2 * kDay});
  const Identity& of_server = made.make("mill 3", {.issuer = &ca, .use = "serverAuth"});
  int certificates = 0;
  for (const auto& [who, says] : {std::pair<const Identity*, std::string>{nullptr, "it has no certificate"},
                                  {&foreign, "unable to get local issuer certificate"},
                                  {&pretender, "signature failure"},
                                  {&own_word, "self-signed certificate"},
                                  {&expired, "certificate has expired"},
                                  {&early, "certificate is not yet valid"},
                                  {&of_server, "unsuitable certificate purpose"}}) {
    for (const int version : {TLS1_2_VERSION, TLS1_3_VERSION}) {
      EXPECT_EQ(ask(server, who, "DELETE", "/v1/sessions", {}, version).status, 0) << says;
      if (who != nullptr) ++certificates;
    }
    EXPECT_TRUE(answers(server)) << says;
    // Of a second one line is told.
    std::this_thread::sleep_for(milliseconds(1010));
    EXPECT_EQ(ask(server, who, "DELETE", "/v1/sessions").status, 0) << says;
    if (who != nullptr) ++certificates;
  }
  EXPECT_EQ(refused(server, "tls-no-certificate"), 3);
  EXPECT_EQ(refused(server, "tls-certificate"), certificates);
  EXPECT_THAT(ask(server, &mill, "GET", "/metrics").body, Not(HasSubstr("405")));
  const auto told = lines();
  for (const char* says :
       {"no certificate", "local issuer", "self-signed", "expired", "not yet valid", "purpose"})
    EXPECT_THAT(told, Contains(HasSubstr(says)));
}

TEST_F(Tls, PlainHttpOnThePortIsNotAnswered) {
  const RunningServer server(settings());
  for (const std::string& bytes :
       {std::string("GET /health HTTP/1.1\r\n\r\n"), std::string(5000, '\0'), std::string(300, '\x16')}) {
    Client raw = Client::tcp(server.tcp());
    raw.send(bytes);
    EXPECT_THAT(raw.until("the end"), Not(HasSubstr("HTTP")));
  }
  EXPECT_TRUE(answers(server));
  EXPECT_EQ(refused(server, "tls-protocol"), 3);
}

TEST_F(Tls, AHandshakeHasItsTimeAndNoMore) {
  const RunningServer server(settings({.handshake = milliseconds(300)}));
  Client silent = Client::tcp(server.tcp()), slow = Client::tcp(server.tcp());
  // The beginning of a ClientHello, a byte now and then.
  slow.send(std::string("\x16\x03\x01\x01\x00", 5));
  for (int i = 0; i < 20 && slow.send(std::string(1, '\x01')); ++i)
    std::this_thread::sleep_for(milliseconds(50));
  EXPECT_EQ(slow.until("the end"), "");
  EXPECT_EQ(silent.until("the end"), "");
  EXPECT_TRUE(answers(server));
  EXPECT_EQ(refused(server, "tls-slow"), 2);
  EXPECT_EQ(counted(server, "capstan_half_open"), 0);
}

TEST_F(Tls, ManyHalfOpenConnectionsKeepNobodyOut) {
  const RunningServer server(
      settings({.connections = 2, .handshake = std::chrono::minutes(10), .half_open = 4}));
  std::vector<int> silent;
  for (int i = 0; i < 60; ++i) {
    silent.push_back(Client::connected_to(server.tcp()));
    if (i % 20 == 0) {
      EXPECT_TRUE(answers(server)) << i;
    }
  }
  EXPECT_TRUE(answers(server));
  EXPECT_GT(refused(server, "half-open"), 40);
  EXPECT_LE(counted(server, "capstan_half_open"), 8);
  // Half open ones are none of the connections.
  EXPECT_EQ(counted(server, "capstan_connections"), 1);
  for (const int fd : silent) ::close(fd);
}

TEST_F(Tls, LimitsAreThoseOfTheSocket) {
  const RunningServer server(settings({.header_bytes = 500,
                                       .body_bytes = 1000,
                                       .json_bytes = 100,
                                       .request = milliseconds(300),
                                       .connections = 2}));
  const auto answered = [&](const std::string& bytes) {
    TlsClient client(server.tcp(), ca, &mill);
    client.send(bytes);
    return client.reply().status;
  };
  EXPECT_EQ(answered("GET /health HTTP/1.1\r\nX: " + std::string(5000, 'a')), 431);
  EXPECT_EQ(answered("PUT /v1/sessions/s1/plan HTTP/1.1\r\nContent-Length: 100000000000\r\n\r\n"), 413);
  EXPECT_EQ(answered("GET /health HTTP/1.1\r\n"), 408);
  EXPECT_EQ(answered("rubbish\r\n\r\n"), 400);
  TlsClient one(server.tcp(), ca, &mill), two(server.tcp(), ca, &other);
  EXPECT_EQ(one.ask("GET", "/health").status, 200);
  EXPECT_EQ(two.ask("GET", "/health").status, 200);
  EXPECT_EQ(TlsClient(server.tcp(), ca, &mill).reply().status, 503);
}

TEST_F(Tls, AClientThatSaysThatNoMoreComesIsAnsweredAndOneThatIsGoneEndsItsBind) {
  const RunningServer server(settings());
  TlsClient half(server.tcp(), ca, &mill);
  half.send("POST /v1/sessions HTTP/1.1\r\nContent-Length: 2\r\n\r\n{}");
  half.send_no_more();
  EXPECT_EQ(half.reply().status, 201);

  TlsClient client(server.tcp(), ca, &mill);
  const nlohmann::json state = {{"options", {{"machine", "generic_vmc"}}},
                                {"tool_table", testing::slurp(magazine_file())}};
  const std::string path =
      "/v1/sessions/" + client.ask("POST", "/v1/sessions", state.dump()).json()["session"].get<std::string>();
  ASSERT_EQ(client.ask("PUT", path + "/plan", testing::slurp(testing::source_dir() + "/examples/bracket.p21"))
                .status,
            200);
  TlsClient gone(server.tcp(), ca, &mill);
  gone.send("POST " + path + "/bind HTTP/1.1\r\nContent-Length: 23\r\n\r\n{\"deadline_ms\": 600000} ");
  while (!client.ask("GET", path + "/result").json()["busy"]) std::this_thread::sleep_for(milliseconds(1));
  gone.leave();
  for (int i = 0; i < 3000 && client.ask("GET", path + "/result").json()["busy"]; ++i)
    std::this_thread::sleep_for(milliseconds(10));
  EXPECT_EQ(client.ask("GET", path + "/result").json()["status"], "IMPOSSIBLE");
  EXPECT_EQ(refused(server, "gone"), 1);
}

TEST_F(Tls, ASocketAndTcpAreServedAtOnceAndEachHasItsPeers) {
  const std::string socket = made.file("s");
  const RunningServer server(settings({}, socket));
  Client local(socket);
  const std::string mine = opened(local);
  EXPECT_EQ(ask(server, &mill, "GET", mine + "/result").status, 404);
  EXPECT_EQ(local.ask("GET", mine + "/result").status, 200);
  EXPECT_TRUE(answers(server));
}

TEST_F(Tls, AnEndIsToldToWhoIsInTheMiddleOfAHandshake) {
  auto server = std::make_unique<RunningServer>(settings({.handshake = std::chrono::minutes(10)}));
  Client silent = Client::tcp(server->tcp());
  EXPECT_TRUE(answers(*server));
  server.reset();  // does not wait ten minutes
  EXPECT_EQ(silent.until("the end"), "");
}

TEST_F(Tls, FilesThatCannotServeAreRefusedByNameWithWhatWasExpected) {
  EXPECT_TRUE(TlsContext::load(files()));
  const auto says = [&](const TlsFiles& with, const std::string& file, const std::string& what) {
    const auto loaded = TlsContext::load(with);
    ASSERT_FALSE(loaded) << what;
    EXPECT_EQ(loaded.error().code, "SERVE-TLS");
    EXPECT_EQ(loaded.error().file, file);
    EXPECT_THAT(loaded.error().message, HasSubstr(what));
    EXPECT_NE(loaded.error().expected, "");
  };
  TlsFiles f = files();
  for (const unsigned mode : {0640U, 0604U, 0620U}) {
    ::chmod(own.key_file.c_str(), mode);
    says(
        f, own.key_file, "other users may read or write the key (mode 0" + [&] {
          std::array<char, 8> text = {};
          std::snprintf(text.data(), text.size(), "%o", mode);
          return std::string(text.data());
        }());
  }
  ::chmod(own.key_file.c_str(), 0400);
  EXPECT_TRUE(TlsContext::load(f));
  ::chmod(own.key_file.c_str(), 0600);

  f.key = mill.key_file;
  says(f, mill.key_file, "not that of the certificate");
  f.key = made.file("none");
  says(f, f.key, "cannot be read");
  f.key = made.file("locked");
  FILE* locked = std::fopen(f.key.c_str(), "w");
  PEM_write_PrivateKey(locked, own.key, EVP_aes_128_cbc(), reinterpret_cast<const unsigned char*>("secret"),
                       6, nullptr, nullptr);
  std::fclose(locked);
  ::chmod(f.key.c_str(), 0600);
  says(f, f.key, "no private key can be read");

  f = files();
  f.certificate = own.key_file;
  says(f, own.key_file, "no certificate can be read");
  const Identity& old =
      made.make("server", {.issuer = &ca, .use = "serverAuth", .from_s = -2 * kDay, .to_s = -kDay});
  f.certificate = old.certificate_file;
  f.key = old.key_file;
  says(f, old.certificate_file, "not valid now");

  f = files();
  f.client_ca = own.key_file;
  says(f, own.key_file, "no certificate can be read");
  f.client_ca = made.file("none");
  says(f, f.client_ca, "no certificate can be read");
}

}  // namespace
}  // namespace capstan::transport
#endif
