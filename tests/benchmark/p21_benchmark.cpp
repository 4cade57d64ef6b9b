#include <benchmark/benchmark.h>
#include <malloc.h>

#include <bit>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "planner/files/p21/print.h"
#include "planner/files/p21/read/parse.h"
#include "planner/ground/base/file.h"
#include "tests/support/amplify.h"
#include "tests/support/corpus.h"

namespace capstan::p21 {
namespace {

constexpr std::size_t kBytes = std::size_t{66} << 20;

// ---------------------------------------------------------------------------------------- checksum

/// Cheap, as the sum is not what is measured: Fibonacci hashing (Knuth, vol. 3, 6.4), folded.
std::uint64_t mix(std::uint64_t x) {
  x *= 0x9E3779B97F4A7C15U;
  return x ^ x >> 32U;
}

std::uint64_t hash(std::string_view text) {
  std::uint64_t h = text.size();
  std::size_t i = 0;
  for (; i + 8 <= text.size(); i += 8) {
    std::uint64_t word = 0;
    std::memcpy(&word, text.data() + i, 8);
    h = mix(h ^ word);
  }
  std::uint64_t rest = 0;
  for (; i < text.size(); ++i) rest = rest << 8U | static_cast<unsigned char>(text[i]);
  return mix(h ^ rest);
}

enum Salt : std::uint64_t { kReal = 1, kInteger, kText, kName, kId, kOpen, kMark };
std::uint64_t salted(Salt salt, std::uint64_t value) { return mix(value ^ salt << 56U); }

/// Every parameter of every instance, decoded; a sum, so that the order of the visit is free.
std::uint64_t checksum(const File& file) {
  std::uint64_t sum = 0;
  std::string buffer;
  std::vector<Value> lists;
  for (const Instance instance : file) {
    sum += salted(kId, instance.id());
    for (std::size_t i = 0; i < instance.part_count(); ++i) {
      const Record part = instance.part(i);
      sum += salted(kName, hash(part.keyword));
      lists.push_back(part.parameters);
    }
    while (!lists.empty()) {
      const Value list = lists.back();
      lists.pop_back();
      sum += salted(kOpen, 0);
      for (std::size_t i = 0, n = list.size(); i < n; ++i) {
        const Value v = list[i];
        switch (v.kind()) {
          case Kind::kReal:
            sum += salted(kReal, std::bit_cast<std::uint64_t>(v.as_real()));
            break;
          case Kind::kInteger:
            sum += salted(kInteger, static_cast<std::uint64_t>(v.as_integer()));
            break;
          case Kind::kString:
            sum += salted(kText, hash(v.as_text(buffer)));
            break;
          case Kind::kEnumeration:
          case Kind::kBinary:
            sum += salted(kName, hash(v.lexeme()));
            break;
          case Kind::kReference:
            sum += salted(kId, v.reference());
            break;
          case Kind::kOmitted:
          case Kind::kDerived:
            sum += salted(kMark, v.is(Kind::kOmitted) ? '$' : '*');
            break;
          case Kind::kTyped:
            sum += salted(kName, hash(v.keyword()));
            lists.push_back(v);
            break;
          case Kind::kList:
            lists.push_back(v);
            break;
        }
      }
    }
  }
  return sum;
}

/// The same sum from the bytes of an amplified file, token by token with the C library, without the
/// reader. Such files have no comments, escapes or binaries in their data.
std::uint64_t plain_checksum(const std::string& text) {
  std::uint64_t sum = 0;
  const char* p = text.c_str() + text.find("DATA;\n") + 6;
  const char* const end = text.c_str() + text.rfind("ENDSEC;");
  while (p < end) {
    char* after = nullptr;
    if (*p == '\'') {
      std::string inside;
      for (++p; *p != '\'' || p[1] == '\''; ++p) {
        if (*p == '\\') throw std::logic_error("an escape in the amplified file");
        if (*p == '\'') ++p;
        inside += *p;
      }
      ++p;
      sum += salted(kText, hash(inside));
    } else if (*p == '#') {
      sum += salted(kId, std::strtoull(p + 1, &after, 10));
      p = after;
    } else if ((*p >= '0' && *p <= '9') || *p == '-' || *p == '+') {
      const double real = std::strtod(p, &after);
      if (std::string_view(p, static_cast<std::size_t>(after - p)).find('.') != std::string_view::npos) {
        sum += salted(kReal, std::bit_cast<std::uint64_t>(real));
      } else {
        sum += salted(kInteger, static_cast<std::uint64_t>(std::strtoll(p, nullptr, 10)));
      }
      p = after;
    } else if (*p == '.' || (*p >= 'A' && *p <= 'Z')) {
      const char* const name = *p == '.' ? p + 1 : p;
      std::size_t n = 0;
      while ((name[n] >= 'A' && name[n] <= 'Z') || (name[n] >= '0' && name[n] <= '9') || name[n] == '_') ++n;
      sum += salted(kName, hash({name, n}));
      p = name + n + (*p == '.' ? 1 : 0);
    } else {
      if (*p == '(') sum += salted(kOpen, 0);
      if (*p == '$' || *p == '*') sum += salted(kMark, static_cast<std::uint64_t>(*p));
      ++p;
    }
  }
  return sum;
}

// ------------------------------------------------------------------------------------------- input

/// The amplified file on disk, and what must come out of it.
struct Input {
  std::string path;
  std::size_t bytes = 0;
  std::uint64_t sum = 0;
};

const Input& input() {
  static const Input made = [] {
    Input in;
    const std::string folder = capstan::testing::corpus_folder();
    if (folder.empty()) return in;
    const auto small = read_file(folder + "/iso14649/nist_ex1E.stp");
    if (!small) return in;
    const std::string large = capstan::testing::amplify_part21(*small, kBytes);
    in.path = (std::filesystem::temp_directory_path() / "capstan-p21-benchmark.stp").string();
    std::ofstream(in.path, std::ios::binary) << large;
    in.bytes = large.size();
    in.sum = plain_checksum(large);
    return in;
  }();
  return made;
}

/// Peak resident memory since the last `reset_peak`, in bytes (Linux).
double peak_memory() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) return std::strtod(line.c_str() + 6, nullptr) * 1024.0;
  }
  return 0.0;
}

void reset_peak() {
  ::malloc_trim(0);
  std::ofstream("/proc/self/clear_refs") << "5";
}

void finish(benchmark::State& state, const Input& in) {
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * in.bytes));
  state.counters["peak_per_input"] = peak_memory() / static_cast<double>(in.bytes);
}

File must_parse(std::string bytes) {
  Job job;
  auto file = parse(std::move(bytes), "amplified.stp", {}, job);
  if (!file) throw std::runtime_error(to_text(file.error()));
  return *std::move(file);
}

// -------------------------------------------------------------------------------------- benchmarks

/// From the file on disk to every parameter decoded.
void read_parse_decode(benchmark::State& state) {
  const Input& in = input();
  if (in.bytes == 0) return state.SkipWithError("the corpus is absent");
  reset_peak();
  std::uint64_t sum = 0;
  for (auto _ : state) {
    const File file = must_parse(*read_file(in.path));
    benchmark::DoNotOptimize(sum = checksum(file));
  }
  finish(state, in);
  if (sum != in.sum) state.SkipWithError("the checksum differs");
}
BENCHMARK(read_parse_decode)->Unit(benchmark::kMillisecond)->UseRealTime();

void parse_and_decode(benchmark::State& state) {
  const Input& in = input();
  if (in.bytes == 0) return state.SkipWithError("the corpus is absent");
  reset_peak();
  std::uint64_t sum = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::string bytes = *read_file(in.path);
    state.ResumeTiming();
    const File file = must_parse(std::move(bytes));
    benchmark::DoNotOptimize(sum = checksum(file));
  }
  finish(state, in);
  if (sum != in.sum) state.SkipWithError("the checksum differs");
}
BENCHMARK(parse_and_decode)->Unit(benchmark::kMillisecond)->UseRealTime();

void parse_alone(benchmark::State& state) {
  const Input& in = input();
  if (in.bytes == 0) return state.SkipWithError("the corpus is absent");
  reset_peak();
  std::uint64_t sum = 0;
  for (auto _ : state) {
    state.PauseTiming();
    std::string bytes = *read_file(in.path);
    state.ResumeTiming();
    const File file = must_parse(std::move(bytes));
    state.PauseTiming();
    sum = checksum(file);
    state.ResumeTiming();
  }
  finish(state, in);
  if (sum != in.sum) state.SkipWithError("the checksum differs");
}
BENCHMARK(parse_alone)->Unit(benchmark::kMillisecond)->UseRealTime();

void print_alone(benchmark::State& state) {
  const Input& in = input();
  if (in.bytes == 0) return state.SkipWithError("the corpus is absent");
  const File file = must_parse(*read_file(in.path));
  std::string text;
  for (auto _ : state) text = print(file);
  state.SetBytesProcessed(static_cast<std::int64_t>(state.iterations() * text.size()));
  if (checksum(must_parse(text)) != in.sum) state.SkipWithError("the checksum differs");
}
BENCHMARK(print_alone)->Unit(benchmark::kMillisecond)->UseRealTime();

}  // namespace
}  // namespace capstan::p21
