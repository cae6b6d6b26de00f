#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  spring_workbench::fuzz::FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
  return 0;
}
