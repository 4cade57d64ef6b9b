#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace capstan::transport {

/// What a server counts, in the text format of Prometheus (0.0.4). Names that are ours are labels, and the
/// first `kMostPeers` subjects of certificates that were verified, so that no peer can make more of them.
///
/// Thread safety  any thread.
class Metrics {
 public:
  void answered(std::string_view endpoint, unsigned status, double seconds);
  /// A request or connection that was refused before an endpoint saw it: "queue", "uid", ...
  void refused(std::string_view reason);
  void bound(std::string_view status);  ///< "OK", "LATE", ...
  void broadcast(std::size_t lines);
  /// A request of the peer with a certificate of this subject.
  void asked(const std::string& subject);
  static constexpr std::size_t kMostPeers = 64;  ///< others are counted together. Default, unsourced.

  /// A value of this moment, for the text: name, what it is, value.
  struct Gauge {
    std::string_view name, what;
    std::size_t value = 0;
  };
  [[nodiscard]] std::string text(const std::vector<Gauge>& gauges) const;

 private:
  struct Latency {
    std::array<std::uint64_t, 12> counts = {};
    std::uint64_t count = 0;
    double sum_s = 0.0;
  };
  mutable std::mutex mutex_;
  std::map<std::pair<std::string, unsigned>, std::uint64_t> answered_;
  std::map<std::string, Latency, std::less<>> latency_;
  std::map<std::string, std::uint64_t, std::less<>> refused_, bound_, peers_;
  std::uint64_t lines_ = 0;
};

}  // namespace capstan::transport
