#include <fcntl.h>
#include <openssl/bio.h>
#include <openssl/err.h>
#include <openssl/pem.h>
#include <openssl/ssl.h>
#include <openssl/x509.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "planner/door/transport/serve/wire/tls.h"
#include "planner/ground/base/loading/library.h"

// The one file that knows OpenSSL, which is opened by the first server over TCP: linked, it would add half to
// the start of every command. It never touches a socket: bytes lie in memory between it and the connection,
// which has the limits in time. Sessions are not resumed, so that each connection is verified anew;
// renegotiation is refused.

namespace capstan::transport {
namespace {

/// Ciphers of TLS 1.2: forward secret, authenticated ones alone (RFC 9325, 4.2). TLS 1.3 has no others.
constexpr const char* kCiphers = "ECDHE+AESGCM:ECDHE+CHACHA20";
/// Longest subject that is taken; a log and a metric have to show it. Default, unsourced.
constexpr std::size_t kLongestSubject = 256;
/// Largest key file that is read, bytes. Default, unsourced.
constexpr std::size_t kLargestKey = 64 << 10;

/// Its functions, of the types that its headers declare.
struct OpenSsl {
#define CAPSTAN_OPENSSL_FUNCTIONS(row)                                                                       \
  row(BIO_ctrl) row(BIO_free_all) row(BIO_new) row(BIO_new_mem_buf) row(BIO_read) row(BIO_s_mem) row(        \
      BIO_write) row(ERR_clear_error) row(ERR_get_error) row(ERR_peek_error) row(ERR_reason_error_string)    \
      row(EVP_PKEY_free) row(OPENSSL_cleanse) row(OPENSSL_sk_num) row(OPENSSL_sk_value)                      \
          row(PEM_read_bio_PrivateKey) row(SSL_CTX_check_private_key) row(SSL_CTX_ctrl) row(SSL_CTX_free)    \
              row(SSL_CTX_get0_certificate) row(SSL_CTX_load_verify_file) row(SSL_CTX_new)                   \
                  row(SSL_CTX_set_cipher_list) row(SSL_CTX_set_client_CA_list) row(SSL_CTX_set_num_tickets)  \
                      row(SSL_CTX_set_options) row(SSL_CTX_set_verify) row(SSL_CTX_use_PrivateKey)           \
                          row(SSL_CTX_use_certificate_chain_file) row(SSL_do_handshake) row(SSL_free)        \
                              row(SSL_get0_verified_chain) row(SSL_get1_peer_certificate) row(SSL_get_error) \
                                  row(SSL_get_verify_result) row(SSL_load_client_CA_file) row(SSL_new)       \
                                      row(SSL_read) row(SSL_set_accept_state) row(SSL_set_bio)               \
                                          row(SSL_shutdown) row(SSL_write) row(TLS_server_method)            \
                                              row(X509_NAME_print_ex) row(X509_cmp_current_time)             \
                                                  row(X509_free) row(X509_get0_notAfter)                     \
                                                      row(X509_get0_notBefore) row(X509_get_subject_name)    \
                                                          row(X509_verify_cert_error_string)
#define CAPSTAN_OPENSSL_ROW(name) decltype(&::name) name = nullptr;
  CAPSTAN_OPENSSL_FUNCTIONS(CAPSTAN_OPENSSL_ROW)
#undef CAPSTAN_OPENSSL_ROW
};

Result<OpenSsl> opened() {
  const auto library = Library::open(CAPSTAN_SSL_LIBRARY);  // what it needs itself is looked in, too
  if (!library) return tl::unexpected(library.error());
  OpenSsl out;
#define CAPSTAN_OPENSSL_ROW(name) \
  if (auto taken = library->take(#name, out.name); !taken) return tl::unexpected(taken.error());
  CAPSTAN_OPENSSL_FUNCTIONS(CAPSTAN_OPENSSL_ROW)
#undef CAPSTAN_OPENSSL_ROW
  return out;
}

const Result<OpenSsl>& openssl() {
  static const Result<OpenSsl> kOpened = opened();
  return kOpened;
}

/// After `openssl` gave it, without which there is no TlsContext.
const OpenSsl& f() { return *openssl(); }

struct Freeing {
  void operator()(SSL_CTX* p) const { f().SSL_CTX_free(p); }
  void operator()(SSL* p) const { f().SSL_free(p); }
  void operator()(BIO* p) const { f().BIO_free_all(p); }
  void operator()(EVP_PKEY* p) const { f().EVP_PKEY_free(p); }
  void operator()(X509* p) const { f().X509_free(p); }
};
using Context = std::unique_ptr<SSL_CTX, Freeing>;
using Ssl = std::unique_ptr<SSL, Freeing>;
using Bio = std::unique_ptr<BIO, Freeing>;
using Key = std::unique_ptr<EVP_PKEY, Freeing>;
using Certificate = std::unique_ptr<X509, Freeing>;

/// The oldest error of this thread in OpenSSL's words; its queue is empty then.
std::string openssl_says() {
  const unsigned long code = f().ERR_get_error();
  f().ERR_clear_error();
  const char* text = code == 0 ? nullptr : f().ERR_reason_error_string(code);
  return text == nullptr ? "no reason is told" : text;
}

tl::unexpected<Diagnostic> wrong(const std::string& file, std::string what, std::string expected,
                                 std::string hint = {}) {
  f().ERR_clear_error();
  return fail({.code = "SERVE-TLS",
               .message = std::move(what),
               .file = file,
               .expected = std::move(expected),
               .hint = std::move(hint)});
}

/// The bytes of a key's file that nobody else may read: looked at and read through one descriptor.
Result<std::string> read_private(const std::string& path) {
  constexpr const char* kExpected = "a private key in PEM that its user alone may read";
  const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (fd < 0) return wrong(path, "the key cannot be read: " + std::string(std::strerror(errno)), kExpected);
  struct stat there = {};
  const bool known = ::fstat(fd, &there) == 0 && S_ISREG(there.st_mode);
  if (!known || (there.st_mode & (S_IRWXG | S_IRWXO)) != 0) {
    ::close(fd);
    if (!known) return wrong(path, "the key is no file", kExpected);
    std::array<char, 8> mode = {};
    std::snprintf(mode.data(), mode.size(), "%04o", there.st_mode & 07777U);
    return wrong(path, "other users may read or write the key (mode " + std::string(mode.data()) + ")",
                 kExpected, "chmod 600 it; where others had it, make a new key and certificate");
  }
  std::string out(kLargestKey, '\0');
  std::size_t size = 0;
  for (ssize_t n = 1; n > 0 && size < out.size(); size += static_cast<std::size_t>(n)) {
    n = ::read(fd, out.data() + size, out.size() - size);
    if (n < 0) break;
  }
  ::close(fd);
  out.resize(size);
  return out;
}

int no_passphrase(char*, int, int, void*) { return -1; }

std::string subject_of(const X509* certificate) {
  const Bio text(f().BIO_new(f().BIO_s_mem()));
  if (!text ||
      f().X509_NAME_print_ex(text.get(), f().X509_get_subject_name(certificate), 0, XN_FLAG_RFC2253) < 0)
    return {};
  char* bytes = nullptr;
  const long size = f().BIO_ctrl(text.get(), BIO_CTRL_INFO, 0, &bytes);
  return size <= 0 ? std::string() : std::string(bytes, static_cast<std::size_t>(size));
}

/// The subjects of the certificates that vouch for the peer's, each behind a line's end, which no subject has
/// in this form (RFC 2253 escapes it).
std::string issuers_of(const SSL* ssl) {
  std::string out;
  const auto* chain = reinterpret_cast<const OPENSSL_STACK*>(f().SSL_get0_verified_chain(ssl));
  const int size = chain == nullptr ? 0 : f().OPENSSL_sk_num(chain);
  for (int i = 1; i < size; ++i)
    out += "\n" + subject_of(static_cast<const X509*>(f().OPENSSL_sk_value(chain, i)));
  return out;
}

void drain(BIO* from, std::string& into) {
  std::array<char, 16384> bytes;
  for (int n = 0; (n = f().BIO_read(from, bytes.data(), static_cast<int>(bytes.size()))) > 0;)
    into.append(bytes.data(), static_cast<std::size_t>(n));
}

}  // namespace

bool tls_is_built() { return true; }

struct TlsContext::Held {
  Context context;
};

Result<TlsContext> TlsContext::load(const TlsFiles& files) {
  if (!openssl())
    return fail({.code = "SERVE-TLS",
                 .message = openssl().error().message,
                 .hint = "install OpenSSL 3 (Debian: libssl3)"});
  f().ERR_clear_error();
  auto held = std::make_shared<Held>();
  held->context.reset(f().SSL_CTX_new(f().TLS_server_method()));
  SSL_CTX* const c = held->context.get();
  if (c == nullptr || f().SSL_CTX_ctrl(c, SSL_CTRL_SET_MIN_PROTO_VERSION, TLS1_2_VERSION, nullptr) != 1 ||
      f().SSL_CTX_set_cipher_list(c, kCiphers) != 1)
    return wrong({}, "TLS cannot begin: " + openssl_says(), "OpenSSL with TLS 1.2 and 1.3");
  f().SSL_CTX_set_options(c, SSL_OP_NO_RENEGOTIATION | SSL_OP_NO_TICKET | SSL_OP_NO_COMPRESSION |
                                 SSL_OP_CIPHER_SERVER_PREFERENCE);
  f().SSL_CTX_ctrl(c, SSL_CTRL_SET_SESS_CACHE_MODE, SSL_SESS_CACHE_OFF, nullptr);
  f().SSL_CTX_set_num_tickets(c, 0);

  if (f().SSL_CTX_use_certificate_chain_file(c, files.certificate.c_str()) != 1)
    return wrong(files.certificate, "no certificate can be read: " + openssl_says(),
                 "the server's certificate in PEM, the intermediate ones behind it");
  const X509* own = f().SSL_CTX_get0_certificate(c);
  if (f().X509_cmp_current_time(f().X509_get0_notBefore(own)) >= 0 ||
      f().X509_cmp_current_time(f().X509_get0_notAfter(own)) <= 0)
    return wrong(files.certificate, "the server's certificate '" + subject_of(own) + "' is not valid now",
                 "one whose time has begun and has not ended", "renew it, or set the clock");

  auto bytes = read_private(files.key);
  if (!bytes) return tl::unexpected(bytes.error());
  const Bio text(f().BIO_new_mem_buf(bytes->data(), static_cast<int>(bytes->size())));
  const Key key(text ? f().PEM_read_bio_PrivateKey(text.get(), nullptr, &no_passphrase, nullptr) : nullptr);
  f().OPENSSL_cleanse(bytes->data(), bytes->size());
  if (!key)
    return wrong(files.key, "no private key can be read: " + openssl_says(),
                 "a private key in PEM without a passphrase");
  if (f().SSL_CTX_use_PrivateKey(c, key.get()) != 1 || f().SSL_CTX_check_private_key(c) != 1)
    return wrong(files.key, "the key is not that of the certificate " + files.certificate,
                 "the private key of the server's certificate");

  auto* const names = f().SSL_CTX_load_verify_file(c, files.client_ca.c_str()) == 1
                          ? f().SSL_load_client_CA_file(files.client_ca.c_str())
                          : nullptr;
  if (names == nullptr)
    return wrong(files.client_ca, "no certificate can be read: " + openssl_says(),
                 "the certificates, in PEM, of who signs those of the clients");
  f().SSL_CTX_set_client_CA_list(c, names);
  f().SSL_CTX_set_verify(c, SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT, nullptr);
  return TlsContext(std::move(held));
}

struct TlsStream::Held {
  std::shared_ptr<const TlsContext::Held> context;
  Ssl ssl;
  BIO *in = nullptr, *out = nullptr;  ///< owned by `ssl`
  Fault fault = Fault::kNone;
  std::string subject, identity, why;

  State refuse(Fault what, std::string words) {
    fault = what;
    why = std::move(words);
    return State::kWrong;
  }
  void take(std::string_view came) const {
    if (!came.empty()) f().BIO_write(in, came.data(), static_cast<int>(came.size()));
  }
};

TlsStream::TlsStream(const TlsContext& context) : held_(std::make_unique<Held>()) {
  held_->context = context.held_;
  held_->ssl.reset(f().SSL_new(context.held_->context.get()));
  Bio in(f().BIO_new(f().BIO_s_mem())), out(f().BIO_new(f().BIO_s_mem()));
  if (!held_->ssl || !in || !out) {
    held_->ssl.reset();
    return;
  }
  held_->in = in.release();
  held_->out = out.release();
  f().SSL_set_bio(held_->ssl.get(), held_->in, held_->out);
  f().SSL_set_accept_state(held_->ssl.get());
}
TlsStream::~TlsStream() = default;

TlsStream::State TlsStream::handshake(std::string_view came, std::string& out) {
  Held& h = *held_;
  if (!h.ssl) return h.refuse(Fault::kProtocol, "no memory");
  f().ERR_clear_error();
  h.take(came);
  const int done = f().SSL_do_handshake(h.ssl.get());
  const int why = f().SSL_get_error(h.ssl.get(), done);
  drain(h.out, out);
  if (done == 1) {
    const Certificate peer(f().SSL_get1_peer_certificate(h.ssl.get()));
    const long verified = f().SSL_get_verify_result(h.ssl.get());
    if (!peer || verified != X509_V_OK) return h.refuse(Fault::kNoCertificate, "it has no certificate");
    h.subject = subject_of(peer.get());
    if (h.subject.empty() || h.subject.size() > kLongestSubject)
      return h.refuse(Fault::kCertificate, "the subject of its certificate has " +
                                               std::to_string(h.subject.size()) + " characters, not 1 to " +
                                               std::to_string(kLongestSubject));
    h.identity = h.subject + issuers_of(h.ssl.get());
    return State::kReady;
  }
  if (why == SSL_ERROR_WANT_READ || why == SSL_ERROR_WANT_WRITE) return State::kMore;
  const int reason = ERR_GET_REASON(f().ERR_peek_error());
  const std::string words = openssl_says();
  if (reason == SSL_R_PEER_DID_NOT_RETURN_A_CERTIFICATE)
    return h.refuse(Fault::kNoCertificate, "it has no certificate");
  if (const long verified = f().SSL_get_verify_result(h.ssl.get()); verified != X509_V_OK)
    return h.refuse(Fault::kCertificate,
                    std::string("its certificate: ") + f().X509_verify_cert_error_string(verified));
  return h.refuse(Fault::kProtocol, words);
}

TlsStream::State TlsStream::read(std::string_view came, std::string& plain, std::string& out) {
  Held& h = *held_;
  f().ERR_clear_error();
  h.take(came);
  std::array<char, 16384> bytes;
  int got = 0;
  while ((got = f().SSL_read(h.ssl.get(), bytes.data(), static_cast<int>(bytes.size()))) > 0)
    plain.append(bytes.data(), static_cast<std::size_t>(got));
  const int why = f().SSL_get_error(h.ssl.get(), got);
  drain(h.out, out);
  if (why == SSL_ERROR_WANT_READ || why == SSL_ERROR_WANT_WRITE) return State::kMore;
  f().ERR_clear_error();
  return why == SSL_ERROR_ZERO_RETURN ? State::kEnd : State::kWrong;
}

bool TlsStream::write(std::string_view plain, std::string& out) {
  Held& h = *held_;
  f().ERR_clear_error();
  while (!plain.empty()) {
    const int n = f().SSL_write(h.ssl.get(), plain.data(), static_cast<int>(plain.size()));
    if (n <= 0) return false;
    plain.remove_prefix(static_cast<std::size_t>(n));
  }
  drain(h.out, out);
  return true;
}

void TlsStream::end(std::string& out) {
  f().ERR_clear_error();
  (void)f().SSL_shutdown(held_->ssl.get());
  drain(held_->out, out);
}

const std::string& TlsStream::subject() const { return held_->subject; }
const std::string& TlsStream::identity() const { return held_->identity; }
TlsStream::Fault TlsStream::fault() const { return held_->fault; }
const std::string& TlsStream::why() const { return held_->why; }

}  // namespace capstan::transport
