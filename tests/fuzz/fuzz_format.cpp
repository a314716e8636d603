// The fuzzer of one format. VIETE_FUZZ_READ is the reader. The function below is called by libFuzzer if
// VIETE_LIBFUZZER is set, otherwise by driver.cpp.
#include "fuzz/fuzz_reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  viete::fuzz::check_reader(VIETE_FUZZ_READ, VIETE_FUZZ_PLACED, data, size);
  return 0;
}
