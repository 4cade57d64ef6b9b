#include "planner/door/transport/serve/wire/tls.h"

// A build without OpenSSL: `serve` asks tls_is_built and refuses TCP, so that none of the others is called.

namespace capstan::transport {

struct TlsContext::Held {};
struct TlsStream::Held {
  std::string none;
};

bool tls_is_built() { return false; }

Result<TlsContext> TlsContext::load(const TlsFiles&) {
  return fail("SERVE-TLS", "this build has no TLS: it was configured without OpenSSL");
}

TlsStream::TlsStream(const TlsContext&) : held_(std::make_unique<Held>()) {}
TlsStream::~TlsStream() = default;
TlsStream::State TlsStream::handshake(std::string_view, std::string&) { return State::kWrong; }
TlsStream::State TlsStream::read(std::string_view, std::string&, std::string&) { return State::kWrong; }
bool TlsStream::write(std::string_view, std::string&) { return false; }
void TlsStream::end(std::string&) {}
const std::string& TlsStream::subject() const { return held_->none; }
const std::string& TlsStream::identity() const { return held_->none; }
TlsStream::Fault TlsStream::fault() const { return Fault::kProtocol; }
const std::string& TlsStream::why() const { return held_->none; }

}  // namespace capstan::transport
