#include "base/os.h"

#if defined(__linux__)
#include <fcntl.h>
#include <linux/audit.h>
#include <linux/filter.h>
#include <linux/landlock.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstddef>
#include <iterator>
#endif

namespace viete::base::os {

#if defined(__linux__)

namespace {

// Adds a rule that lets the process read the file, or the folder with everything below.
void allow_reading(int rules, const fs::path& path) {
  const int file = open(path.c_str(), O_PATH | O_CLOEXEC);
  if (file < 0) return;
  landlock_path_beneath_attr rule{};
  rule.allowed_access = LANDLOCK_ACCESS_FS_READ_FILE;
  if (fs::is_directory(path)) rule.allowed_access |= LANDLOCK_ACCESS_FS_READ_DIR;
  rule.parent_fd = file;
  syscall(SYS_landlock_add_rule, rules, LANDLOCK_RULE_PATH_BENEATH, &rule, 0);
  close(file);
}

// Landlock is in Linux since version 5.13.
void confine_files(const std::vector<fs::path>& readable) {
  landlock_ruleset_attr attributes{};
  attributes.handled_access_fs = (LANDLOCK_ACCESS_FS_MAKE_SYM << 1) - 1;  // all accesses of the first version
  const auto rules =
      static_cast<int>(syscall(SYS_landlock_create_ruleset, &attributes, sizeof attributes, 0));
  if (rules < 0) return;
  for (const fs::path& path : readable) allow_reading(rules, path);
  syscall(SYS_landlock_restrict_self, rules, 0);
  close(rules);
}

// These system calls fail with EPERM: network, other programs, and ways around this filter.
void confine_calls() {
#if defined(__x86_64__) || defined(__aarch64__)
#if defined(__x86_64__)
  constexpr unsigned machine = AUDIT_ARCH_X86_64;
#else
  constexpr unsigned machine = AUDIT_ARCH_AARCH64;
#endif
  constexpr unsigned forbidden[] = {SYS_socket,   SYS_socketpair, SYS_execve,
                                    SYS_execveat, SYS_ptrace,     SYS_io_uring_setup};
  constexpr unsigned other_numbering = 0x40000000;  // __X32_SYSCALL_BIT: the same calls for 32-bit pointers
  constexpr auto count = static_cast<std::uint8_t>(std::size(forbidden));
  std::vector<sock_filter> program = {
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, arch)),
      BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, machine, 1, 0), BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_KILL_PROCESS),
      BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
      BPF_JUMP(BPF_JMP | BPF_JGE | BPF_K, other_numbering, static_cast<std::uint8_t>(count + 1), 0)};
  for (std::uint8_t i = 0; i < count; ++i)
    program.push_back(
        BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, forbidden[i], static_cast<std::uint8_t>(count - i), 0));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW));
  program.push_back(BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ERRNO | EPERM));
  const sock_fprog filter{static_cast<unsigned short>(program.size()), program.data()};
  prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &filter);
#endif
}

}  // namespace

void confine_process(const std::vector<fs::path>& readable) {
  if (prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) != 0) return;
  confine_files(readable);
  confine_calls();
}

#else

void confine_process(const std::vector<fs::path>&) {}

#endif

}  // namespace viete::base::os
