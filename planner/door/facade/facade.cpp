#include "capstan/capstan.h"

namespace capstan {

std::string version() { return CAPSTAN_VERSION; }

}  // namespace capstan
