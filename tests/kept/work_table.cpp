// capstan_work_table [--large] [--only TEXT] COMMAND EXAMPLES [REPEATS]: CPU seconds (user and system) of
// whole commands with check and all outputs, and of long paths written, as the table of README ("Measured")
// has them. The least of the repeats counts, for other work on the machine only adds. Status 0: shown; 2:
// wrong usage; 3: the work failed.

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "planner/files/exchange/ap238/ap238.h"
#include "planner/files/json/json.h"
#include "planner/ground/base/file.h"
#include "planner/ground/base/number.h"
#include "tests/kept/measure.h"
#include "tests/support/corpus.h"
#include "tests/support/long_paths.h"
#include "tests/support/plate.h"

namespace {

using namespace capstan;  // a program of its own
using capstan::testing::ScratchFolder;

using Words = std::vector<std::string>;

/// A row of the table. `prepare` comes before each run and is not counted.
struct Work {
  std::string name, reach_s;
  std::function<kept::Taken()> run;
  std::function<void()> prepare = [] {};
};

void write(const std::string& path, const std::string& text) {
  if (text.empty()) throw std::runtime_error(path + " would be empty");
  if (const auto ok = write_file(path, text); !ok) throw std::runtime_error(ok.error().message);
}

class Table {
 public:
  Table(std::string command, std::string examples)
      : command_(std::move(command)), examples_(std::move(examples)) {}

  std::vector<Work> rows(bool large) {
    std::vector<Work> out;
    const std::string bracket = examples_ + "/bracket.p21", surface = examples_ + "/surface.stl";
    const std::string pocket = examples_ + "/reference_pocket.p21";
    out.push_back(planned("plan bracket.p21", "1.2", {bracket}));
    out.push_back(planned("plan two_setups.p21", "1.5", {examples_ + "/two_setups.p21"}));
    out.push_back(planned("plan reference_pocket.p21", "0.7", {pocket}));
    if (const std::string corpus = capstan::testing::corpus_folder(); corpus.empty()) {
      std::puts("The corpus is absent: the files of other makers are left out.");
    } else {
      out.push_back(planned("plan nist_ex1.stp --reopen all", "1.2",
                            {corpus + "/iso14649/nist_ex1.stp", "--reopen", "all"}));
      out.push_back(makers(corpus + "/iso14649"));
    }
    out.push_back(planned("plan surface.stl, EN AW-6061", "2", {surface, "--material", "EN AW-6061"}));
    out.push_back(
        planned("plan reference_pocket.p21, Inconel 718", "2", {pocket, "--material", "Inconel 718"}));
    const std::string plate = in("plate.p21", capstan::testing::plate(33).text);
    out.push_back(
        rebound("49 steps, a drill's length changed: bind --cache", "0.2", plate, "7.8 mm", "Z", 0.01));
    out.push_back(rebound("49 steps, the mill of 16 pocket steps 0.1 mm narrower", "0.2", plate, "end mill",
                          "D", -0.1));
    const std::string holes = in("holes.p21", capstan::testing::plate_of_holes(50).text);
    out.push_back(rebound("50 holes, the drill's length changed", "0.05", holes, "drill", "Z", 0.01));
    out.push_back(
        planned("plate of 100 features", "4", {in("hundred.p21", capstan::testing::plate(100).text)}));
    out.push_back(checked(bracket));
    out.push_back({"start-up: plan reference_pocket.p21 --bind none", "0.015", [this, pocket] {
                     return ran({"plan", pocket, "--bind", "none", "-o", in("open.json")});
                   }});
    out.push_back({"the same of the program alone: --version", "-", [this] { return ran({"--version"}); }});
    if (large)
      out.push_back({"plate of 1,000 features, .json and .ngc", "20",
                     [this, part = in("thousand.p21", capstan::testing::plate(1000).text)] {
                       return ran({"plan", part, "-o", in("o.json"), "-o", in("o.ngc")});
                     }});
    constexpr std::size_t kPoints = 1000000;
    const auto plan = std::make_shared<const model::Plan>(capstan::testing::long_paths_plan(kPoints));
    out.push_back({"10^6 path points written as JSON", "1.5", [plan] {
                     return kept::taken_by([&] { wanted(!json::write_json(*plan).empty(), "no JSON"); });
                   }});
    out.push_back({"10^6 path points written as AP238", "1.5", [plan] {
                     return kept::taken_by([&] {
                       Job job;
                       wanted(exchange::write_ap238(*plan, job).has_value(), "no AP238");
                     });
                   }});
    return out;
  }

 private:
  static void wanted(bool ok, const char* what) {
    if (!ok) throw std::runtime_error(what);
  }

  [[nodiscard]] std::string in(const std::string& name) const { return scratch_.file(name); }
  [[nodiscard]] std::string in(const std::string& name, const std::string& text) const {
    write(in(name), text);
    return in(name);
  }

  [[nodiscard]] kept::Taken ran(Words words) const {
    words.insert(words.begin(), command_);
    return kept::taken_by(words);
  }

  [[nodiscard]] Words with_outputs(Words words) const {
    words.insert(words.begin(), "plan");
    for (const char* form : {"json", "p21", "stpnc", "ngc", "tbl"})
      words.insert(words.end(), {"-o", in(std::string("o.") + form)});
    return words;
  }

  Work planned(const std::string& name, const std::string& reach_s, const Words& words) {
    return {name, reach_s, [this, all = with_outputs(words)] { return ran(all); }};
  }

  /// Every ISO 14649 file of a folder that planning reads.
  Work makers(const std::string& folder) {
    Words files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      if (entry.path().extension() == ".p21" || entry.path().extension() == ".stp")
        files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    const std::string name = std::to_string(files.size()) + " ISO 14649 files of other makers, --reopen all";
    return {name, "20", [this, files] {
              kept::Taken out;
              for (const std::string& file : files) {
                out.cpu_s += ran_whatever(with_outputs({file, "--reopen", "all"})).cpu_s;
              }
              return out;
            }};
  }

  /// A file of others may be one that nothing can be planned of.
  [[nodiscard]] kept::Taken ran_whatever(Words words) const {
    words.insert(words.begin(), command_);
    return kept::taken_by(words, kImpossible);
  }

  /// A plan is bound again with one size of one tool changed, from the results that planning kept.
  Work rebound(const std::string& name, const std::string& reach_s, const std::string& part,
               const std::string& tool, const std::string& key, double by_mm) {
    const std::string plan = in("first.json"), tools = in("first.tbl"), cache = in("cache");
    return {name, reach_s,
            [this, plan, cache] {
              return ran({"bind", plan, "--tools", in("changed.tbl"), "--cache", cache, "-o",
                          in("again.json"), "-o", in("again.ngc")});
            },
            [this, part, plan, tools, cache, tool, key, by_mm] {
              std::filesystem::remove_all(cache);
              (void)ran({"plan", part, "--cache", cache, "-o", plan, "-o", tools});
              write(in("changed.tbl"),
                    capstan::testing::with_tool_changed(capstan::testing::slurp(tools), tool, key, by_mm));
            }};
  }

  Work checked(const std::string& part) {
    return {"check of the bracket's plan, program and tool table", "0.8",
            [this] {
              return ran({"check", in("o.json"), in("o.ngc"), in("o.tbl")});
            },
            [this, part] { (void)ran(with_outputs({part})); }};
  }

  static constexpr int kImpossible = 4;  ///< the command's highest status that is no fault of its own
  std::string command_, examples_;
  ScratchFolder scratch_;
};

int shown(bool large, const std::string& only, const std::string& command, const std::string& examples,
          int repeats) {
  Table table(command, examples);
  std::puts("| work | asked, s | CPU s | of the kernel's |\n|---|---|---|---|");
  for (const Work& work : table.rows(large)) {
    if (work.name.find(only) == std::string::npos) continue;
    double least_s = 1e300, kernel_s = 1e300;
    for (int k = 0; k < repeats; ++k) {
      work.prepare();
      least_s = std::min(least_s, work.run().cpu_s);
      kernel_s = std::min(kernel_s, kept::reference_kernel().cpu_s);
    }
    std::printf("| %s | %s | %s | %s |\n", work.name.c_str(), work.reach_s.c_str(),
                trimmed(least_s, 3).c_str(), trimmed(least_s / kernel_s, 2).c_str());
    std::fflush(stdout);
  }
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  bool large = false;
  std::string only;
  Words names;
  for (int i = 1; i < argc; ++i) {
    const std::string a = argv[i];
    if (a == "--large") {
      large = true;
    } else if (a == "--only" && i + 1 < argc) {
      only = argv[++i];
    } else {
      names.push_back(a);
    }
  }
  const int repeats = names.size() == 3 ? std::atoi(names[2].c_str()) : 3;
  if (names.size() < 2 || names.size() > 3 || repeats < 1) {
    std::fputs("usage: capstan_work_table [--large] [--only TEXT] COMMAND EXAMPLES [REPEATS]\n", stderr);
    return 2;
  }
  try {
    return shown(large, only, names[0], names[1], repeats);
  } catch (const std::exception& e) {
    std::fprintf(stderr, "work: %s\n", e.what());
    return 3;
  }
}
