#include <capstan/capstan.h>

#include <iostream>

int main() {
  std::cout << capstan::version() << '\n';
  return 0;
}
