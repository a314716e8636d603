// The one main() of every test. What the program remembers between runs goes to a folder of the test's own:
// no test, and no program that a test starts, touches the user's.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <string>

int main(int argc, char** argv) {
  std::string folder = (std::filesystem::temp_directory_path() / "viete_test_state_XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return 1;
  if (setenv("XDG_STATE_HOME", folder.c_str(), 1) != 0) return 1;
  if (setenv("XDG_CACHE_HOME", (folder + "/cache").c_str(), 1) != 0) return 1;
  const pid_t here = getpid();
  const int code = doctest::Context(argc, argv).run();
  std::error_code ignored;
  if (getpid() == here) std::filesystem::remove_all(folder, ignored);
  return code;
}
