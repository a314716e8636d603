// A zombie: a child process that has ended but is still in the process list.
#pragma once

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <string>

#include "base/process.h"

namespace viete::test {

class Zombie {
public:
  Zombie() {
    int ends[2];
    REQUIRE(pipe(ends) == 0);
    process_ = fork();
    if (process_ == 0) {
      const std::string own = base::process_name();
      _exit(write(ends[1], own.data(), own.size()) > 0 ? 0 : 1);
    }
    char text[64];
    const ssize_t size = read(ends[0], text, sizeof text);
    close(ends[0]);
    close(ends[1]);
    REQUIRE(size > 0);
    name.assign(text, static_cast<std::size_t>(size));
    siginfo_t ended;
    REQUIRE(waitid(P_PID, static_cast<id_t>(process_), &ended, WEXITED | WNOWAIT) == 0);
  }
  ~Zombie() { bury(); }
  Zombie(const Zombie&) = delete;
  Zombie& operator=(const Zombie&) = delete;

  void bury() {
    if (process_ > 0) waitpid(process_, nullptr, 0);
    process_ = 0;
  }

  std::string name;  ///< the result of base::process_name() for the zombie

private:
  pid_t process_ = 0;
};

}  // namespace viete::test
