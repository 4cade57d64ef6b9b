#include "planner/door/transport/serve/metrics.h"

#include "planner/ground/base/number.h"

namespace capstan::transport {
namespace {

/// Upper bounds of the latencies that are counted, s.
constexpr std::array kBounds = {0.001, 0.0025, 0.005, 0.01, 0.025, 0.05, 0.1, 0.25, 0.5, 1.0, 5.0, 30.0};

void head(std::string& out, std::string_view name, std::string_view what, std::string_view kind) {
  out += "# HELP " + std::string(name) + " " + std::string(what) + "\n# TYPE " + std::string(name) + " " +
         std::string(kind) + "\n";
}

/// A label's value: a subject may have quotes and backslashes in it, but no line end (tls.h).
std::string escaped(const std::string& value) {
  std::string out;
  for (const char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out;
}

void counts(std::string& out, std::string_view name, std::string_view what, std::string_view label,
            const std::map<std::string, std::uint64_t, std::less<>>& of) {
  head(out, name, what, "counter");
  for (const auto& [value, n] : of)
    out += std::string(name) + "{" + std::string(label) + "=\"" + escaped(value) + "\"} " +
           std::to_string(n) + "\n";
}

}  // namespace

void Metrics::answered(std::string_view endpoint, unsigned status, double seconds) {
  static_assert(std::tuple_size_v<decltype(Latency::counts)> == kBounds.size());
  const std::lock_guard lock(mutex_);
  ++answered_[{std::string(endpoint), status}];
  Latency& latency = latency_[std::string(endpoint)];
  ++latency.count;
  latency.sum_s += seconds;
  for (std::size_t i = 0; i < kBounds.size(); ++i)
    if (seconds <= kBounds[i]) ++latency.counts[i];
}

void Metrics::refused(std::string_view reason) {
  const std::lock_guard lock(mutex_);
  ++refused_[std::string(reason)];
}

void Metrics::bound(std::string_view status) {
  const std::lock_guard lock(mutex_);
  ++bound_[std::string(status)];
}

void Metrics::broadcast(std::size_t lines) {
  const std::lock_guard lock(mutex_);
  lines_ += lines;
}

void Metrics::asked(const std::string& subject) {
  const std::lock_guard lock(mutex_);
  const bool room = peers_.contains(subject) || peers_.size() < kMostPeers;
  ++peers_[room ? subject : "other"];
}

std::string Metrics::text(const std::vector<Gauge>& gauges) const {
  const std::lock_guard lock(mutex_);
  std::string out;
  head(out, "capstan_requests_total", "Requests answered, by endpoint and HTTP status.", "counter");
  for (const auto& [key, n] : answered_)
    out += "capstan_requests_total{endpoint=\"" + key.first + "\",status=\"" + std::to_string(key.second) +
           "\"} " + std::to_string(n) + "\n";
  head(out, "capstan_request_seconds", "From a request's last byte to its reply.", "histogram");
  for (const auto& [endpoint, latency] : latency_) {
    const std::string of = "{endpoint=\"" + endpoint + "\"";
    for (std::size_t i = 0; i < kBounds.size(); ++i)
      out += "capstan_request_seconds_bucket" + of + ",le=\"" + shortest(kBounds[i]) + "\"} " +
             std::to_string(latency.counts[i]) + "\n";
    out += "capstan_request_seconds_bucket" + of + ",le=\"+Inf\"} " + std::to_string(latency.count) +
           "\ncapstan_request_seconds_sum" + of + "} " + shortest(latency.sum_s) +
           "\ncapstan_request_seconds_count" + of + "} " + std::to_string(latency.count) + "\n";
  }
  counts(out, "capstan_binds_total", "Binds ended, by status; LATE: past the deadline.", "status", bound_);
  counts(out, "capstan_refused_total", "Refused before an endpoint saw it.", "reason", refused_);
  counts(out, "capstan_peer_requests_total", "Requests over TCP, by the subject of the certificate.", "peer",
         peers_);
  head(out, "capstan_broadcast_lines_total", "Broadcasts sent.", "counter");
  out += "capstan_broadcast_lines_total " + std::to_string(lines_) + "\n";
  for (const Gauge& g : gauges) {
    head(out, g.name, g.what, "gauge");
    out += std::string(g.name) + " " + std::to_string(g.value) + "\n";
  }
  return out;
}

}  // namespace capstan::transport
