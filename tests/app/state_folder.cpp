#include "app/autosave.h"

#include <doctest/doctest.h>

#include <cstdlib>
#include <optional>
#include <string>

using namespace viete;

namespace {

// Restores an environment variable at the end of the test.
class Variable {
public:
  explicit Variable(const char* name) : name_(name) {
    if (const char* value = std::getenv(name)) old_ = value;
  }
  ~Variable() { set(old_ ? old_->c_str() : nullptr); }
  void set(const char* value) {
    if (value) {
      setenv(name_, value, 1);
    } else {
      unsetenv(name_);
    }
  }

private:
  const char* name_;
  std::optional<std::string> old_;
};

}  // namespace

TEST_CASE("folders_are_where_the_variables_say_or_else_in_the_home_folder") {
  Variable home("HOME"), state("XDG_STATE_HOME");
  home.set("/home/ada");
  for (const char* none : {static_cast<const char*>(nullptr), "", "relative/path"}) {
    state.set(none);
    CHECK(app::state_folder() == "/home/ada/.local/state/viete");
  }
  state.set("/var/state");
  CHECK(app::state_folder() == "/var/state/viete");
}

TEST_CASE("without_a_home_folder_nothing_is_remembered") {
  Variable home("HOME"), state("XDG_STATE_HOME");
  home.set(nullptr);
  state.set(nullptr);
  CHECK(app::state_folder().empty());
  home.set("not/absolute");
  CHECK(app::state_folder().empty());
}
