// One fuzzer per format: VIETE_FUZZ_READ is its reader. With VIETE_LIBFUZZER and clang, libFuzzer calls it;
// otherwise driver.cpp.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  viete::fuzz::check_reader(VIETE_FUZZ_READ, VIETE_FUZZ_PLACED, data, size);
  return 0;
}
