#include "app/autosave.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <string>

using namespace viete;

namespace {

// Restores an environment variable at the end of the test.
class Variable {
public:
  explicit Variable(const char* name) : name_(name), old_(std::getenv(name) ? std::getenv(name) : "") {}
  ~Variable() { set(old_.c_str()); }
  void set(const char* value) { value ? setenv(name_, value, 1) : unsetenv(name_); }

private:
  const char* name_;
  std::string old_;
};

}  // namespace

TEST_CASE("the_state_folder_is_where_the_variables_say_or_in_the_home_folder_if_there_is_one") {
  Variable home("HOME"), state("XDG_STATE_HOME");
  home.set("/home/ada");
  for (const char* none : {static_cast<const char*>(nullptr), "", "relative/path"}) {
    state.set(none);
    CHECK(app::state_folder() == "/home/ada/.local/state/viete");
  }
  state.set("/var/state");
  CHECK(app::state_folder() == "/var/state/viete");
  home.set(nullptr);
  state.set(nullptr);
  CHECK(app::state_folder().empty());
  home.set("not/absolute");
  CHECK(app::state_folder().empty());
}
