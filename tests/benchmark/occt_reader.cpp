// Times OpenCASCADE on a Part 21 file: occt_reader file.stp
#include <STEPControl_Reader.hxx>
#include <StepData_StepModel.hxx>
#include <chrono>
#include <cstdio>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: occt_reader FILE\n", stderr);
    return 2;
  }
  const auto start = std::chrono::steady_clock::now();
  STEPControl_Reader reader;
  const bool good = reader.ReadFile(argv[1]) == IFSelect_RetDone;
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
  std::printf("%s: %d entities in %.3f s\n", good ? "read" : "not read",
              good ? reader.StepModel()->NbEntities() : 0, took.count());
  return good ? 0 : 1;
}
