// The main() of every test program. Tests use a temporary folder for settings, to keep the user's settings.
#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

#include <filesystem>

#include "support/folder.h"
#include "support/skip.h"

namespace {

constexpr int skipped_code = 77;  // the exit code of skipped tests, as in Automake
bool skipped = false, none_chosen = false;

// Counts the test cases that match the command line. If no case matches, the program fails.
struct CountsCases : doctest::IReporter {
  explicit CountsCases(const doctest::ContextOptions&) {}
  void report_query(const doctest::QueryData&) override {}
  void test_run_start() override {}
  void test_run_end(const doctest::TestRunStats& run) override {
    none_chosen = run.numTestCasesPassingFilters == 0;
  }
  void test_case_start(const doctest::TestCaseData&) override {}
  void test_case_reenter(const doctest::TestCaseData&) override {}
  void test_case_end(const doctest::CurrentTestCaseStats&) override {}
  void test_case_exception(const doctest::TestCaseException&) override {}
  void subcase_start(const doctest::SubcaseSignature&) override {}
  void subcase_end() override {}
  void log_assert(const doctest::AssertData&) override {}
  void log_message(const doctest::MessageData&) override {}
  void test_case_skipped(const doctest::TestCaseData&) override {}
};
REGISTER_LISTENER("counts_cases", 1, CountsCases);

int run(int argc, char** argv) {
  const int code = doctest::Context(argc, argv).run();
  if (code != 0) return code;
  return none_chosen ? 1 : skipped ? skipped_code : 0;
}

}  // namespace

void viete::test::skip(const std::string& why) {
  MESSAGE("skipped: " << why);
  skipped = true;
}

int main(int argc, char** argv) {
  const std::filesystem::path folder = viete::test::new_temporary_folder("viete_test_state_");
  viete::test::set_environment("XDG_STATE_HOME", folder.string());
  viete::test::set_environment("XDG_CACHE_HOME", (folder / "cache").string());
  const int process = viete::test::process_id();
  const int code = run(argc, argv);
  std::error_code ignored;
  if (viete::test::process_id() == process) std::filesystem::remove_all(folder, ignored);
  return code;
}
