// The fuzzer of one format. VIETE_FUZZ_READ is the reader. If VIETE_LIBFUZZER is set and the compiler is
// clang, libFuzzer calls it, otherwise driver.cpp.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  viete::fuzz::check_reader(VIETE_FUZZ_READ, VIETE_FUZZ_PLACED, data, size);
  return 0;
}
