#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

#include "planner/ground/base/result.h"

/// @file TLS as bytes, without sockets: what a peer sent goes in, what it is to be sent comes out.
/// openssl_tls.cpp does it by OpenSSL; a build without has no_openssl_tls.cpp, and `--tcp` is refused there.

namespace capstan::transport {

/// Whether this build has TLS.
[[nodiscard]] bool tls_is_built();

/// Files in PEM.
struct TlsFiles {
  std::string certificate;  ///< the server's, with those between it and its root behind it
  std::string key;          ///< of that certificate, without a passphrase; no other user may read the file
  std::string client_ca;    ///< who signs the certificates of clients; nobody else is trusted
};

/// What all connections of a server share: its certificate and key, and whose clients it trusts. TLS 1.2 or
/// later; a client must show a certificate for the use of a client, signed by `client_ca` and valid now.
///
/// Thread safety  any thread.
class TlsContext {
 public:
  /// Fails  SERVE-TLS: a file cannot be read or holds no such thing, the key is another certificate's, has a
  ///        passphrase, or may be read by other users; the server's certificate is not valid now.
  [[nodiscard]] static Result<TlsContext> load(const TlsFiles& files);

 private:
  friend class TlsStream;
  struct Held;
  explicit TlsContext(std::shared_ptr<const Held> held) : held_(std::move(held)) {}
  std::shared_ptr<const Held> held_;
};

/// The server's side of one connection. It keeps `context` alive.
class TlsStream {
 public:
  explicit TlsStream(const TlsContext& context);
  TlsStream(const TlsStream&) = delete;
  TlsStream& operator=(const TlsStream&) = delete;
  ~TlsStream();

  /// kMore: more of the peer's bytes are wanted. kEnd: the peer sends no more. kWrong: it is no TLS, or is
  /// refused; what `out` has is sent all the same, and the connection ends.
  enum class State : std::uint8_t { kMore, kReady, kEnd, kWrong };
  /// Goes on with the handshake; kReady: the peer's certificate is verified.
  State handshake(std::string_view came, std::string& out);
  /// After the handshake: appends what the bytes hold to `plain`.
  State read(std::string_view came, std::string& plain, std::string& out);
  /// False: the connection is not to be used any more.
  bool write(std::string_view plain, std::string& out);
  /// The last bytes of this side.
  void end(std::string& out);

  /// The subject of the peer's certificate after the handshake (RFC 2253, ASCII: "CN=mill 3,O=Works").
  [[nodiscard]] const std::string& subject() const;
  /// Who the peer is: its subject, and behind it, each on a line, those of the certificates that vouch for
  /// it, up to that of `client_ca`. Two signers may give the same subject; they are two peers.
  [[nodiscard]] const std::string& identity() const;

  enum class Fault : std::uint8_t { kNone, kNoCertificate, kCertificate, kProtocol };
  /// After kWrong of a handshake: what is wrong, and that in words of our own or of OpenSSL, never the
  /// peer's.
  [[nodiscard]] Fault fault() const;
  [[nodiscard]] const std::string& why() const;

 private:
  struct Held;
  std::unique_ptr<Held> held_;
};

}  // namespace capstan::transport
