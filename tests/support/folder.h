// A temporary folder, reading and writing of files, and a simulated full disk.
#pragma once

#include <doctest/doctest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#ifdef _WIN32
#include <process.h>
#else
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#endif

namespace viete::test {

#ifdef _WIN32
inline int process_id() {
  return _getpid();
}
inline void set_environment(const char* name, const std::string& value) {
  _putenv_s(name, value.c_str());
}
#else
inline int process_id() {
  return getpid();
}
inline void set_environment(const char* name, const std::string& value) {
  setenv(name, value.c_str(), 1);
}
#endif

inline std::filesystem::path new_temporary_folder(const std::string& name) {
  for (int i = 0;; ++i) {
    const std::filesystem::path folder = std::filesystem::temp_directory_path() /
                                         (name + std::to_string(process_id()) + "_" + std::to_string(i));
    if (std::filesystem::create_directory(folder)) return folder;
  }
}

/// A new folder. The destructor removes it.
class TemporaryFolder {
public:
  TemporaryFolder() : path_(new_temporary_folder("viete_test_")) {}
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
  std::size_t entries() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(path_), {}));
  }

private:
  std::filesystem::path path_;
};

inline std::string file_bytes(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

inline void put_file(const std::filesystem::path& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

#ifndef _WIN32
/// Simulates a full disk by a limit on file sizes. The destructor removes the limit.
class FullDisk {
public:
  explicit FullDisk(rlim_t bytes_a_file) {
    REQUIRE(getrlimit(RLIMIT_FSIZE, &before_) == 0);
    handler_ = std::signal(SIGXFSZ, SIG_IGN);
    const rlimit small{bytes_a_file, before_.rlim_max};
    REQUIRE(setrlimit(RLIMIT_FSIZE, &small) == 0);
  }
  ~FullDisk() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }
  FullDisk(const FullDisk&) = delete;
  FullDisk& operator=(const FullDisk&) = delete;

private:
  rlimit before_{};
  void (*handler_)(int) = SIG_DFL;
};
#endif

}  // namespace viete::test
