#include <capstan/capstan.h>

#include <iostream>

/// opens PART CASES: what is said when the part is planned with that case base, which has the library look
/// for what it opens and runs.
int main(int, char** words) {
  capstan::PlanOptions options;
  options.cases = words[2];
  options.material = "6061";  // a CAD file names none
  options.bind = "none";
  for (const capstan::PlanMessage& m : capstan::plan_file(words[1], options).diagnostics)
    std::cout << m.code << ' ' << m.text << '\n';
  return 0;
}
