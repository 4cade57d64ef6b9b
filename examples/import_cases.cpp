// Keeps what a machine's log shows of a plan's workingsteps as cases, and says what came of it:
//
//   g++ -std=c++20 import_cases.cpp -o import_cases $(pkg-config --cflags --libs capstan)
//   ./import_cases shop.db wear wear_sheet.csv wear.csv
//
// The base is made where there is none; a log that was imported before adds nothing. Plans lean on it by
// PlanOptions::cases.

#include <capstan/capstan.h>

#include <iostream>

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: import_cases BASE FORMAT PLAN LOG\n";
    return 2;
  }
  capstan::CaseImport what;
  what.cases = argv[1];
  what.format = argv[2];
  what.plan = argv[3];
  what.logs = {argv[4]};
  const capstan::CaseImportOutput out = capstan::import_cases(what);
  for (const capstan::PlanMessage& m : out.diagnostics) std::cerr << m.text << '\n';
  if (!out.imported) return 1;
  std::cout << out.cases << " cases, " << out.added << " of them new; the base holds " << out.held << '\n';
  return 0;
}
