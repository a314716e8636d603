// Runs the program in a shell.
#pragma once

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <string>

#include "program/dragon.h"
#include "support/folder.h"
#include "support/text.h"

namespace viete::test {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string text;  ///< the text of stdout and stderr
};

inline Outcome outcome_of(const std::string& command) {
  Outcome outcome;
  FILE* pipe = popen(command.c_str(), "r");
  REQUIRE(pipe);
  std::array<char, 4096> buffer{};
  while (const std::size_t n = std::fread(buffer.data(), 1, buffer.size(), pipe))
    outcome.text.append(buffer.data(), n);
  const int status = pclose(pipe);
  outcome.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128;
  return outcome;
}

/// Runs `viete` in a folder.
inline Outcome run_of(const fs::path& folder, const std::string& arguments,
                      const std::string& environment = "") {
  return outcome_of(environment + " '" + folder.string() + "/viete' " + arguments + " 2>&1 </dev/null");
}

inline Outcome run(const std::string& arguments, const std::string& environment = "") {
  return run_of(build_dir(), arguments, environment);
}

inline std::string quoted(const fs::path& path) {
  return "'" + path.string() + "'";
}

/// Runs the program in a folder, and sends the signal when the file `until` exists. The file `said` contains
/// the program's output. If the program ends before the signal, deletes the files `made` and starts again.
inline Outcome ended_by(const std::string& signal, const fs::path& folder, const std::string& arguments,
                        const std::string& until, const std::string& made) {
  put_file(folder / "ended.sh",
           "cd " + quoted(folder) + "\nfor try in 1 2 3 4 5 6 7 8 9; do\nrm -rf " + made +
               "\nVIETE_PROGRESS=1 " + quoted(build_dir() / "viete") + " " + arguments +
               " > said 2>&1 &\np=$!\nwhile ! [ -s " + until +
               " ] && kill -0 $p 2>/dev/null; do sleep 0.01; done\nkill -" + signal +
               " $p\nwait $p\ncode=$?\n[ $code = 0 ] || break\ndone\ncat said\nexit $code\n");
  return outcome_of("sh " + quoted(folder / "ended.sh") + " 2>&1 </dev/null");
}

inline std::string without_display(const fs::path& folder) {
  return "cd " + quoted(folder) + " && env -u DISPLAY -u WAYLAND_DISPLAY";
}

inline bool mentions(const Outcome& outcome, const std::string& text) {
  return test::mentions(outcome.text, text);
}

const fs::path cage = dragon_cage, alert_pose = assets_dir() / "dragon" / "pose_alert.obj";
const std::string in_cage = quoted(dragon) + " " + quoted(cage),
                  posed = "deform " + in_cage + " --pose " + quoted(alert_pose);

/// A folder for running the program.
struct WorkFolder : TemporaryFolder {
  Outcome viete(const std::string& words) const { return run(words, "cd " + quoted(path()) + " &&"); }
  Outcome done(const std::string& words) const {
    const Outcome outcome = viete(words);
    CHECK_MESSAGE(outcome.code == 0, words << '\n' << outcome.text);
    return outcome;
  }
  void refused(const std::string& words, int code, const std::string& text) const {
    const Outcome outcome = viete(words);
    CHECK_MESSAGE(outcome.code == code, words << '\n' << outcome.text);
    CHECK_MESSAGE(mentions(outcome, text), words << '\n' << outcome.text);
  }
};

}  // namespace viete::test
